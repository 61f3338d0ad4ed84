//! Where pictures are read from.

use std::io::{Read, Seek};

/// The bytes of a picture file, whole or filtered. Taken as a trait object, so that each decoder is
/// compiled only once.
pub trait Input: Read + Seek {}

impl<R: Read + Seek> Input for R {}
