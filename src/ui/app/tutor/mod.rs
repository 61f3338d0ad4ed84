//! Lessons beside the picture: each step is noticed when it is done, with a hint after a while. A lesson
//! works on a scene that the program carries, which has no file until the user saves it. A lesson is a
//! file of [`lessons`], and a step one of its rows.

mod goals;
mod lessons;
mod place;
mod teaching;

pub(crate) use lessons::LESSONS;
pub(crate) use place::{Begun, begun};
pub use teaching::Tutor;
pub(crate) use teaching::{Order, begin, hint, obey, shown};
