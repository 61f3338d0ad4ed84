//! Why parts cannot be merged, and which shards to trace on.

use std::io;
use std::path::PathBuf;

use super::header::{Difference, OldForm};
use super::shard::Shard;
use render::Refusal;

/// Why parts cannot be merged.
#[derive(Debug, thiserror::Error)]
pub enum Unmerged {
    /// A part cannot be read.
    #[error("{path}: {source}", path = path.display())]
    Io {
        /// The part.
        path: PathBuf,
        /// The error of the file system.
        source: io::Error,
    },
    /// A part is a pipe, a device or a folder.
    #[error("{path} is {kind}: parts must be files", path = path.display())]
    NotRegular {
        /// The part.
        path: PathBuf,
        /// Its type with an article.
        kind: &'static str,
    },
    /// A file is not a part, or its header is damaged.
    #[error("{path} is not a part file, or its header is damaged", path = path.display())]
    NoPart {
        /// The file.
        path: PathBuf,
    },
    /// A part has the form of an earlier version.
    #[error("{path} {form}", path = path.display())]
    Old {
        /// The part.
        path: PathBuf,
        /// Its form.
        form: OldForm,
    },
    /// A part is not as it was written.
    #[error("{path} is damaged from byte {offset} on; continue it with --resume", path = path.display())]
    Damaged {
        /// The part.
        path: PathBuf,
        /// Where its first damaged record begins.
        offset: u64,
    },
    /// A part ends within a record.
    #[error("{path} ends early, in the record at byte {offset}; continue it with --resume", path = path.display())]
    Short {
        /// The part.
        path: PathBuf,
        /// Where its last record begins.
        offset: u64,
    },
    /// Two parts belong to different pictures.
    #[error(
        "{path} and {first} belong to different pictures: {} {} and {}",
        difference.what, difference.ours, difference.theirs,
        path = path.display(), first = first.display()
    )]
    Mismatch {
        /// The part.
        path: PathBuf,
        /// The first part.
        first: PathBuf,
        /// What differs.
        difference: Difference,
    },
    /// Two parts are of one shard.
    #[error("{path} and {first} are both shard {shard}", path = path.display(), first = first.display())]
    Twice {
        /// The part.
        path: PathBuf,
        /// The other part.
        first: PathBuf,
        /// Their shard.
        shard: Shard,
    },
    /// Parts are traced to different numbers of samples.
    #[error(
        "{path} has {samples} spp and {most_path} has {most} spp; rerun {shards} with --spp {most} \
         --resume",
        path = path.display(), most_path = most_path.display(), shards = shards_of(shards, *count)
    )]
    Uneven {
        /// The part with the fewest samples.
        path: PathBuf,
        /// Its samples of each pixel.
        samples: u32,
        /// A part with the most samples.
        most_path: PathBuf,
        /// Its samples of each pixel.
        most: u32,
        /// The shards that have fewer, in ascending order.
        shards: Vec<u32>,
        /// How many shards there are.
        count: u32,
    },
    /// Blocks of the picture are not traced to the end.
    #[error(
        "incomplete: {blocks} of {all} blocks {are} missing; rerun {shards} with --resume",
        are = if *blocks == 1 { "is" } else { "are" }, shards = shards_of(shards, *count)
    )]
    Holes {
        /// How many blocks are missing.
        blocks: u32,
        /// How many there are.
        all: u32,
        /// The shards that they belong to, in ascending order.
        shards: Vec<u32>,
        /// How many shards there are.
        count: u32,
    },
    /// The picture does not fit into memory.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

/// Formats ascending numbers as ranges: `3,7-9`.
pub fn ranges(numbers: &[u32]) -> String {
    let chunks = numbers.chunk_by(|before, after| before + 1 == *after);
    let ranges = chunks.map(|chunk| match chunk {
        [one] => one.to_string(),
        [first, .., last] => format!("{first}-{last}"),
        [] => String::new(),
    });
    ranges.collect::<Vec<_>>().join(",")
}

/// Some of `count` shards in words: `shard 3 (of 8)`.
fn shards_of(shards: &[u32], count: u32) -> String {
    match (shards, count) {
        (_, 1) => "the render".to_owned(),
        ([one], _) => format!("shard {one} (of {count})"),
        _ => format!("shards {} (of {count})", ranges(shards)),
    }
}
