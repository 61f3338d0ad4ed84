//! Unsaved edits kept from one run to the next, readable by their owner only.
//!
//! Every run keeps its edits in a journal of its own, `recovery/STEM-HASH-N.EXTENSION` below the
//! [state folder](folder), locked while it runs: edits that are undecided stay, and those
//! of a run that is not over are not offered. The hash is that of the scene's canonical path, so
//! that one scene has the same journals under all its names.
//!
//! A journal holds the text that the edits started from as well as the edits, in the format that
//! [`record`] describes. If the file holds something else when they are restored, both sets of
//! changes are merged. If there is no file, the journal's text stands in for it.
//!
//! ```text
//! App ──Effect──▶ Keeper, a thread ──▶ Journal ──▶ Claim ──▶ Folder
//!  ▲                     └──Msg::Kept──┐
//!  └───────────────────────────────────┴──Msg::Recovered── look_for, a thread
//! ```

mod claim;
mod folder;
mod identity;
mod journal;
mod keeper;
mod missing;
mod offer;
mod record;
#[cfg(test)]
pub(crate) mod tests;

pub use claim::Claim;
pub(crate) use folder::place;
pub(crate) use journal::Edits;
pub(crate) use keeper::{End, Keeper, Order};
pub(crate) use missing::{base_of, note};
pub(crate) use offer::look_for;
pub use offer::{Found, Offer, Since, Sought, Way};
