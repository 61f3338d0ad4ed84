//! The buffer that an editor has of the scene: what is heard of it, and the edits that it is sent. Its text
//! is read as the file's is, by [`files`](super::files).

mod following;
mod pushing;

pub(crate) use following::heard;
pub(crate) use pushing::{follow_edits, push};
