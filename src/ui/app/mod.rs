//! The interface's state and its transitions: a pure step from (state, message) to (state, effects). Nothing
//! here touches files, threads or clocks.
//!
//! [`App`] is what all modes share, [`Shared`], and the state of each mode that has its own, which a line of
//! [`modes`] joins. A step is a function of what it changes: `fn(&mut Shared)`, or
//! `fn(&mut Compare, &mut Shared)`. Each room lists in its `mod.rs` what others may call. Calls run down this
//! table, and to the right in a row.
//!
//! | room | what it is for |
//! |---|---|
//! | [`update`], [`keyboard`], [`pasting`], [`mouse`] | take a message, and hand it to the room whose business it is; the mouse also drags what all modes share |
//! | [`command`] | the command line: its rows, completions, and the help page |
//! | [`modes`] | the modes joined: their states and keys, who handles a press, how one is entered |
//! | [`keys`], [`list`], [`back`] | keys that are the same in many modes; cursors of lists; Esc where no mode binds it |
//! | [`edit`], [`select`], [`sequence`], [`trace`] | EDIT: values of fields; SELECT: the list and the selected things; SEQUENCE: a track, played and keyed; TRACE: the full-size trace and its region |
//! | [`exports`], [`history`], [`files`], [`buffer`] | pictures written; undo, redo and their page; the scene's files, and an editor's buffer in place of its own |
//! | [`samples`], [`tutor`] | the sample scenes as pictures; lessons beside the picture |
//! | [`compare`], [`camera`], [`transform`], [`inspect`], [`whereabouts`] | COMPARE; VIEW and FLY; MOVE; INSPECT and the rays behind a pixel; where a row is in the picture |
//! | [`suggesting`], [`text`] | what is wrong with a picture, and the setting that would help; every change of the text |
//! | [`display`], [`panels`] | what pictures show and ask for; how much of the screen they take |
//! | [`room`] | how a room reacts to steps, presses and drags; what a row of keys is |
//! | [`refusing`] | showing the user why something failed |
//! | [`shared`] | the state that all modes share, one part for each concern |
//! | [`pictures`], [`values`] | pictures as state; numbers, words and colours as they are typed |

mod back;
pub(crate) mod buffer;
mod camera;
pub(crate) mod command;
pub(crate) mod compare;
pub mod display;
pub(crate) mod edit;
pub(crate) mod exports;
pub(crate) mod files;
pub(crate) mod history;
pub(crate) mod inspect;
mod keyboard;
mod keys;
mod list;
mod modes;
mod mouse;
mod panels;
mod pasting;
mod pictures;
mod refusing;
mod room;
pub(crate) mod samples;
pub(crate) mod select;
mod sequence;
mod shared;
mod suggesting;
#[cfg(test)]
pub(super) mod tests;
pub(crate) mod text;
pub(crate) mod trace;
mod transform;
pub(crate) mod tutor;
mod update;
mod values;
pub(crate) mod whereabouts;

pub use camera::View;
pub use command::commands;
pub use compare::{Compare, Contrast, Reference, Wipe};
pub use display::{Symbol, SymbolKind};
pub use files::{Opening, OpeningText, Preferences};
pub use history::{Rank, Thumbnail, Thumbnails};
pub use inspect::{Inspect, Pixel, RayPanels};
pub use modes::App;
pub(super) use modes::ranked_hints;
pub use pictures::Pictures;
pub use pictures::cell_image::CellImage;
pub use pictures::frame_window::{FrameWindow, Grid, Marked, Reason, Window};
pub use pictures::histogram::ShownHistogram;
pub use pictures::picture::Picture;
pub use pictures::solo::Solo;
pub use pictures::viewport::Viewport;
pub use pictures::wireframe::ShownWireframe;
pub use samples::Gallery;
pub(super) use sequence::DopeSheet;
pub use sequence::{OpenTrack, Sequence};
pub use shared::Shared;
pub use shared::after_leaving::{AfterLeaving, CarriedScene};
pub use shared::buffer::Buffer;
pub use shared::cursor::{Cursor, Names, Stride, Typing};
pub use shared::disk::{Disk, FirstReading, OnDisk};
pub use shared::field_row::{FieldRow, Provenance};
pub use shared::filter::Filter;
pub use shared::inspection::{Cross, Explained, Inspection};
pub use shared::jobs::{Export, Jobs, Pending, Stage};
pub use shared::menu::{Entry, Menu, Purpose};
pub use shared::messages::{Message, Messages};
pub use shared::overlays::{Dialog, MergeSource, Overlays, Prompt, PromptKind, Question, Whose};
pub use shared::page::{Page, PageFocus};
pub use shared::palette::{Completion, Palette};
pub use shared::picker::{ColourPicker, PickerRow};
pub use shared::rows::{Fold, Rows};
pub use shared::suggestions::Suggestions;
pub use trace::Trace;
pub use transform::{Moving, Tool, Transform};
pub use tutor::Tutor;
pub use values::hsv::Hsv;
pub use whereabouts::Whereabouts;
