//! The header of a part file: a text that says which picture it is a part of.
//!
//! ```text
//! halflight part 1
//! version 0.1.0
//! scene 9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0bd3ee0e1f5a3f0b6b9c1d
//! view own
//! layers none
//! size 800x600
//! …
//! shard 3/8
//! crc 1a2b3c4d
//! ```
//!
//! The last line has the CRC-32 of those above it.

use std::io::{self, BufRead, Read};

use super::shard::Shard;
use render::{Provenance, Record};

/// The first line, with the version of the format.
const MAGIC: &str = "halflight part 1";

/// More bytes than any header has.
const LONGEST: u64 = 4096;

/// Which picture a part file is a part of, and which part.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The picture. Its number of samples does not matter: a part can be continued.
    pub picture: Provenance,
    /// Its place among the parts.
    pub shard: Shard,
}

impl Header {
    /// The text, which ends with a line break, and its checksum.
    pub(super) fn text(&self) -> (String, u32) {
        let text = format!("{MAGIC}\n{}shard {}\n", self.picture.lines(), self.shard);
        let crc = crc32fast::hash(text.as_bytes());
        (format!("{text}crc {crc:08x}\n"), crc)
    }

    /// Reads a header and its checksum. `None` if there is none, or not all of it is as it was
    /// written.
    pub(super) fn read(from: &mut impl BufRead) -> io::Result<Option<(Self, u32)>> {
        let mut from = from.take(LONGEST);
        let mut text = Vec::new();
        loop {
            let begin = text.len();
            from.read_until(b'\n', &mut text)?;
            let line = &text[begin..];
            if line.starts_with(b"crc ") || !line.ends_with(b"\n") {
                break;
            }
        }
        Ok(String::from_utf8(text)
            .ok()
            .and_then(|text| Self::of(&text)))
    }

    fn of(text: &str) -> Option<(Self, u32)> {
        let (_, picture) = text.split_once('\n')?;
        let (picture, behind) = picture.rsplit_once("\nshard ")?;
        let picture = Record::read(&format!("{picture}\nspp 1\n")).provenance()?;
        let header = Self {
            picture,
            shard: Shard::parse(behind.lines().next()?)?,
        };
        // Whatever was read is only right if it is written so.
        let (written, crc) = header.text();
        (written == text).then_some((header, crc))
    }

    /// What differs between two parts of what should be one picture, such as `scene`; `None` if
    /// they belong together. Their shards are not compared.
    pub fn difference(&self, other: &Self) -> Option<Difference> {
        let lines = |header: &Self| {
            let mut lines = header.picture.written();
            lines.push(("number of shards", header.shard.count.to_string()));
            lines
        };
        let pairs = lines(self).into_iter().zip(lines(other));
        let mut differing = pairs.filter(|(ours, theirs)| ours != theirs);
        let ((what, ours), (_, theirs)) = differing.next()?;
        Some(Difference { what, ours, theirs })
    }
}

/// A setting in which two parts differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Its name.
    pub what: &'static str,
    /// Its value in the one.
    pub ours: String,
    /// Its value in the other.
    pub theirs: String,
}
