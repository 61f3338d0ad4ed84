//! The interface's state and its transitions: a pure step from (state, message) to (state,
//! effects).
//!
//! [`App`] is what all modes share, and each mode's own state. [`Shared`] is the text and one part for
//! each concern: cursor, disk, assets, pictures, overlays, jobs. A part owns its state and knows no
//! other; the steps, which handle messages, pass between them what they need. A mode that is a room
//! stands in a folder, which no other knows: its state, its keys, its steps; one line of
//! [`modes`] joins it to the rest. Nothing here touches files, threads or clocks.

pub(crate) mod back;
pub(crate) mod camera;
pub(crate) mod command;
pub(crate) mod compare;
pub mod display;
pub(crate) mod edit;
pub(crate) mod exports;
pub(crate) mod files;
pub(crate) mod history;
pub(crate) mod inspect;
pub(crate) mod keyboard;
pub(crate) mod keys;
pub(crate) mod list;
pub(crate) mod modes;
pub(crate) mod mouse;
pub(crate) mod panels;
pub(crate) mod pasting;
pub(crate) mod pictures;
pub(crate) mod room;
pub(crate) mod select;
pub(crate) mod sequence;
pub(crate) mod shared;
pub(crate) mod suggesting;
#[cfg(test)]
pub(super) mod tests;
pub(crate) mod text;
pub(crate) mod trace;
pub(crate) mod transform;
pub(crate) mod update;
pub(crate) mod values;

pub use compare::{Compare, Contrast, Reference, Wipe};
pub use display::{Symbol, SymbolKind};
pub use files::{Opening, OpeningText, Preferences};
pub use history::{Rank, Thumbnail, Thumbnails};
pub use inspect::Pixel;
pub use inspect::RayPanels;
pub use modes::App;
pub use pictures::Pictures;
pub use pictures::cell_image::CellImage;
pub use pictures::frame_window::{FrameWindow, Grid, Marked, Reason, Window};
pub use pictures::histogram::ShownHistogram;
pub use pictures::picture::Picture;
pub use pictures::solo::Solo;
pub use pictures::viewport::Viewport;
pub use pictures::wireframe::ShownWireframe;
pub(super) use sequence::DopeSheet;
pub use sequence::{OpenTrack, Sequence};
pub use shared::Shared;
pub use shared::after_leaving::AfterLeaving;
pub use shared::cursor::{Cursor, Names, Stride, Typing};
pub use shared::disk::{Disk, FirstReading, OnDisk};
pub use shared::field_row::{FieldRow, Provenance};
pub use shared::filter::Filter;
pub use shared::inspection::{Cross, Explained, Inspection};
pub use shared::jobs::{Export, Jobs, Pending, Stage};
pub use shared::menu::{Entry, Menu, Purpose};
pub use shared::messages::{Message, Messages};
pub use shared::overlays::{Dialog, Help, MergeSource, Overlays, Prompt, PromptKind, Whose};
pub use shared::page::{List, Page, PageFocus};
pub use shared::palette::{Completion, Palette};
pub use shared::picker::{ColourPicker, PickerRow};
pub use shared::rays::{RayLine, RayPart};
pub use shared::rows::{Fold, Rows};
pub use shared::steps::Steps;
pub use shared::suggestions::Suggestions;
pub use shared::transform::{Tool, Transform};
pub use values::hsv::Hsv;
