//! Unsaved edits kept from one run to the next, readable by their owner only.
//!
//! Every run keeps its edits in its own journal, `recovery/STEM-HASH-N.EXTENSION` below the
//! [state folder](file::state_folder), locked while the run lasts: undecided edits stay, and those of running
//! processes are not offered. The hash is of the scene's canonical path, so that a scene has the
//! same journals under all its names.
//!
//! A journal holds both the base text and the edits, in the format described in [`record`]. If the
//! file has changed when they are restored, both sets of changes are merged. If the file is
//! missing, the journal's base replaces it.
//!
//! ```text
//! App ──Effect──▶ Keeper, a thread ──▶ Journal ──▶ Claim ──▶ state::Folder
//!  ▲                     └──Outcome───┐
//!  └──────────────────────────────────┴──Found── look_for, a thread
//! ```

mod claim;
mod identity;
mod journal;
mod keeper;
mod missing;
mod offer;
mod record;
#[cfg(test)]
pub(crate) mod tests;

pub use claim::Claim;
pub(crate) use journal::Edits;
pub(crate) use keeper::{End, Keeper, Outcome, Request};
pub(crate) use missing::{base_of, note_for_missing, note_for_unreadable};
pub(crate) use offer::look_for;
pub use offer::{Found, Offer, Since, Sought, Way};
