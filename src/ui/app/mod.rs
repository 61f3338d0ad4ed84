//! What the interface knows, and how it changes: a pure step from (state, message) to (state,
//! effects).
//!
//! The step is split by concern; nothing here touches files, threads or clocks.

mod assets;
mod command;
mod cursor;
mod derived;
mod disk;
mod edit;
mod jobs;
mod keeping;
mod line;
mod list;
mod literals;
mod making;
mod model;
mod navigate;
mod opening;
mod picture;
mod places;
mod pointer;
mod quit;
mod recovering;
mod saving;
#[cfg(test)]
pub(super) mod tests;
mod typing;
mod update;

use std::time::Duration;

pub use model::{
    App, Broken, Dialog, Disk, Export, FieldRow, Help, HelpFocus, Message, Mode, Outline, Outside,
    Prompt, PromptKind, Provenance, Quality, Stage, Stride, Typing,
};
pub use opening::{Opening, OpeningText, Unread};
pub use picture::{Picture, Shown};

/// How soon a second Ctrl-C ends the program.
const INTERRUPT_AGAIN: Duration = Duration::from_secs(2);
/// How soon a second click is the same as the first one's.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);
