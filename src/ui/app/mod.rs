//! The interface's state and its transitions: a pure step from (state, message) to (state,
//! effects).
//!
//! [`App`] is the text and one part for each concern: cursor, disk, assets, pictures, overlays,
//! jobs. A part owns its state and knows no other; the steps, which handle messages, pass between
//! them what they need. Nothing here touches files, threads or clocks.

mod arithmetic;
mod assets;
mod camera;
mod command;
mod cursor;
mod derived;
mod disk;
mod edit;
mod jobs;
mod journal;
mod line;
mod list;
mod literals;
mod model;
mod opening;
mod overlays;
mod picture;
mod pictures;
mod places;
mod pointer;
mod quit;
mod recover;
mod reload;
mod saving;
#[cfg(test)]
pub(super) mod tests;
mod tracing;
mod typed;
mod typing;
mod update;
mod viewing;

use std::time::Duration;

pub use cursor::{Cursor, Typing};
pub use derived::{FieldRow, Provenance};
pub use disk::{Disk, FirstReading, OnDisk};
pub use jobs::{Export, Jobs, Stage};
pub use model::App;
pub use opening::{Opening, OpeningText};
pub use overlays::{Dialog, Help, HelpFocus, Message, Outside, Overlays, Prompt, PromptKind};
pub use picture::{Picture, Shown};
pub use pictures::{Pictures, Quality};

/// A second Ctrl-C within this time ends the program.
const INTERRUPT_AGAIN: Duration = Duration::from_secs(2);
/// A second click within this time counts as a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);
