//! Part files: blocks of a picture as far as they are traced, and the pictures they make together.
//!
//! A part file is written while its blocks are traced, and only ever appended to: a [`header`] says
//! which picture it is a part of, [`record`]s hold its blocks. Whatever ends the writing, all but the
//! last record are good, and the tracing [continues](Part::open) from them. A picture traced by one
//! process has one part; for several, [`shard`]s say whose blocks are whose, and a [merge](mod@merge) puts
//! their parts together.
//!
//! The interface keeps its full-size [`traces`] as parts, too: a trace and a render of the same film
//! continue each other.

mod contents;
mod header;
mod merge;
mod reader;
mod record;
mod shard;
#[cfg(test)]
mod tests;
mod traces;
mod unmerged;
mod writer;

pub use contents::Contents;
pub use header::{Difference, Header, OldForm};
pub use merge::{Merged, merge, missing};
pub use reader::Unreadable;
pub use record::Goal;
pub use shard::{MOST_SHARDS, Shard};
pub use traces::{NoTrace, Traces, find_part};
pub use unmerged::{Unmerged, ranges};
pub use writer::{Part, Refused, path_beside};
