//! COMPARE: pins and loads a reference, traces what corresponds to it, and looks at both.

mod asking;
mod comparing;
mod contrast;
mod grading;
mod keys;
mod referring;
mod room;
mod state;

pub(crate) use comparing::{cross_on_screen, end, start, take_frame, unlike, wipe_on_screen};
pub use contrast::Contrast;
pub(crate) use keys::{ENTRIES, KEYS};
pub(crate) use referring::{read_reference, reference_read};
pub use state::{Compare, Reference, Wipe};
