//! The interface's state and its transitions: a pure step from (state, message) to (state,
//! effects).
//!
//! [`App`] is the text and one part for each concern: cursor, disk, assets, pictures, overlays,
//! jobs. A part owns its state and knows no other; the steps, which handle messages, pass between
//! them what they need. Nothing here touches files, threads or clocks.

mod adding;
mod another;
mod arithmetic;
mod assets;
mod assigning;
mod camera;
mod choosing;
mod colouring;
mod colours;
mod command;
mod compared;
mod comparing;
mod completing;
mod contrast;
mod cures;
mod curing;
mod cursor;
mod derived;
mod disk;
mod drawing;
mod edit;
mod explaining;
mod exports;
mod filter;
mod filtering;
mod hints;
mod hsv;
mod inspecting;
mod inspection;
mod jobs;
mod journal;
mod keying;
mod leaving;
mod line;
mod list;
mod literals;
mod looking;
mod menu;
mod messages;
mod model;
mod naming;
mod next;
mod opening;
mod overlays;
mod page;
mod palette;
mod picker;
mod picture;
mod pictures;
mod pixel;
mod places;
mod pointer;
mod rays;
mod recover;
mod regions;
mod reload;
mod rows;
mod saving;
mod sequence;
mod sequencing;
mod setting;
mod shown;
mod sight;
mod sliding;
mod solo;
mod soloed;
mod steps;
mod structure;
mod symbols;
mod tally;
#[cfg(test)]
pub(super) mod tests;
mod thumbnails;
mod timeline;
mod tracing;
mod transform;
mod transforming;
mod trial;
mod trying;
mod typed;
mod typing;
mod until;
mod update;
mod viewing;
mod viewport;
mod wires;
mod written;
mod zooming;

use std::time::Duration;

pub use compared::{Compared, Reference, Wipe};
pub use contrast::Contrast;
pub use cures::Cures;
pub use cursor::{Cursor, Names, Typing};
pub use derived::{FieldRow, Provenance};
pub use disk::{Disk, FirstReading, OnDisk};
pub use explaining::RayPanels;
pub use filter::Filter;
pub use hsv::Hsv;
pub use inspection::{Cross, Explained, Inspection};
pub use jobs::{Export, Jobs, Pending, Stage};
pub use menu::{Entry, Menu, Purpose};
pub use messages::{Message, Messages};
pub use model::App;
pub use next::Next;
pub use opening::{Opening, OpeningText, Preferences};
pub use overlays::{Dialog, Help, Outside, Overlays, Prompt, PromptKind};
pub use page::{List, Page, PageFocus};
pub use palette::{Completion, Palette};
pub use picker::{ColourPicker, PickerRow};
pub use picture::Picture;
pub use pictures::Pictures;
pub use pixel::Pixel;
pub use rays::{RayLine, RayPart};
pub use rows::Rows;
pub use sequence::{OpenTrack, Sequence};
pub use shown::Shown;
pub use sight::{Grid, Marked, Reason, Sight, Window};
pub use soloed::Solo;
pub use steps::Steps;
pub use symbols::{Symbol, SymbolKind};
pub use tally::Tally;
pub use thumbnails::{Rank, Thumbnail, Thumbnails};
pub use transform::Transform;
pub use viewport::Viewport;
pub use wires::Wires;

/// A second Ctrl-C within this time ends the program.
const INTERRUPT_AGAIN: Duration = Duration::from_secs(2);
/// A second click within this time counts as a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);
