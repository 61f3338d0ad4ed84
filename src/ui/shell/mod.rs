//! The loop: waits in the inbox, performs steps and their effects, and draws; the terminal, or a page
//! for scripts of keys; how it begins and how it ends.

mod beginning;
mod continuing;
mod editor;
mod effects;
pub(crate) mod ending;
mod screen;
pub(crate) mod script;
pub(crate) mod session;
pub(crate) mod snapshot;
mod traces;
mod tty_session;
