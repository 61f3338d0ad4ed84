//! What pictures are read from.

use std::io::{Read, Seek};

/// A file, whole or filtered. As a trait object, so that all decoders are compiled only once.
pub(super) trait Input: Read + Seek {}

impl<R: Read + Seek> Input for R {}
