//! The event loop: takes messages from the inbox, performs the effects of steps, and draws, to the
//! terminal or, for scripts of keys, to a page; how it starts and how it ends.

mod beginning;
mod continuing;
mod editor;
mod effects;
pub(crate) mod ending;
mod screen;
pub(crate) mod script;
pub(crate) mod session;
pub(crate) mod snapshot;
mod tty_session;

#[cfg(test)]
pub(super) use continuing::tests::job;
