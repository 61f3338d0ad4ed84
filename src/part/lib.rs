//! Part files: blocks of a picture as far as they are traced, and the pictures they make together.
//!
//! A part file is written while its blocks are traced, and only ever appended to: a [`header`] says
//! which picture it is a part of, [`record`]s hold its blocks. Whatever ends the writing, all but the
//! last record are good, and the tracing [continues](Part::open) from them. A picture traced by one
//! process has one part; for several, [`shard`]s say whose blocks are whose, and a [merge](mod@merge) puts
//! their parts together.

mod header;
mod merge;
mod record;
mod shard;
#[cfg(test)]
mod tests;
mod writer;

pub use header::{Difference, Header};
pub use merge::{Merged, Unmerged, merge, missing, ranges};
pub use shard::{MOST_SHARDS, Shard};
pub use writer::{Part, Refused, path_beside};
