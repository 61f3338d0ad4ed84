//! The interface's state and its transitions: a pure step from (state, message) to (state,
//! effects).
//!
//! [`App`] is what all modes share, and each mode's own state. [`Shared`] is the text and one part for
//! each concern: cursor, disk, assets, pictures, overlays, jobs. A part owns its state and knows no
//! other; the steps, which handle messages, pass between them what they need. A mode that is a room
//! stands in a folder, which no other knows: its state, its keys, its steps; one line of
//! [`modes`] joins it to the rest. Nothing here touches files, threads or clocks.

mod adding;
mod after_leaving;
mod arithmetic;
mod assets;
mod assigning;
mod camera;
mod cell_image;
mod choosing;
mod colouring;
mod colours;
mod command;
mod compared;
mod comparing;
mod completing;
mod contrast;
mod cursor;
mod disk;
mod display;
mod drawing;
mod edit;
mod explaining;
mod exports;
mod filter;
mod filtering;
mod frame_window;
mod grading;
mod hints;
mod histogram;
mod history;
mod hsv;
mod inputs;
mod inspecting;
mod inspection;
mod jobs;
mod journal;
mod keys;
mod leaving;
mod line;
mod list;
mod literals;
mod live_edit;
mod live_editing;
mod location_names;
mod menu;
mod messages;
mod modes;
mod mouse;
mod naming;
mod open_scene;
mod opening;
mod overlays;
mod page;
mod palette;
mod picker;
mod picture;
mod pictures;
mod pixel;
mod polling;
mod queries;
mod rays;
mod recover;
mod regions;
mod reload;
mod room;
mod rows;
mod saved_setting;
mod saved_views;
mod saving;
mod sequence;
mod setting;
mod shared;
mod sliding;
mod solo;
mod soloing;
mod steps;
mod structure;
mod suggesting;
mod suggestions;
mod symbols;
#[cfg(test)]
pub(super) mod tests;
mod timeline;
mod tracing;
mod transform;
mod transforming;
mod typed;
mod typing;
mod until;
mod update;
mod viewport;
mod wireframe;
mod zooming;

use std::time::Duration;

pub use after_leaving::AfterLeaving;
pub use cell_image::CellImage;
pub use compared::{Compared, Reference, Wipe};
pub use contrast::Contrast;
pub use cursor::{Cursor, Names, Stride, Typing};
pub use disk::{Disk, FirstReading, OnDisk};
pub use explaining::RayPanels;
pub use filter::Filter;
pub use frame_window::{FrameWindow, Grid, Marked, Reason, Window};
pub use histogram::ShownHistogram;
pub use history::{Rank, Thumbnail, Thumbnails};
pub use hsv::Hsv;
pub use inspection::{Cross, Explained, Inspection};
pub use jobs::{Export, Jobs, Pending, Stage};
pub use menu::{Entry, Menu, Purpose};
pub use messages::{Message, Messages};
pub use modes::App;
pub use opening::{Opening, OpeningText, Preferences};
pub use overlays::{Dialog, Help, MergeSource, Overlays, Prompt, PromptKind, Whose};
pub use page::{List, Page, PageFocus};
pub use palette::{Completion, Palette};
pub use picker::{ColourPicker, PickerRow};
pub use picture::Picture;
pub use pictures::Pictures;
pub use pixel::Pixel;
pub use queries::{FieldRow, Provenance};
pub use rays::{RayLine, RayPart};
pub use rows::{Fold, Rows};
pub(super) use sequence::DopeSheet;
pub use sequence::{OpenTrack, Sequence};
pub use shared::Shared;
pub use solo::Solo;
pub use steps::Steps;
pub use suggestions::Suggestions;
pub use symbols::{Symbol, SymbolKind};
pub use transform::{Tool, Transform};
pub use viewport::Viewport;
pub use wireframe::ShownWireframe;

/// A second Ctrl-C within this time ends the program.
const INTERRUPT_AGAIN: Duration = Duration::from_secs(2);
/// A second click within this time counts as a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);
