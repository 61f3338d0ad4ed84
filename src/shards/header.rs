//! The header of a part file: a text that says which picture it is a part of.
//!
//! ```text
//! halflight part 2
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

use std::fmt;
use std::io::{self, BufRead, Read};

use super::shard::Shard;
use render::{Blocks, PictureMetadata, Provenance};

/// The first line, with the version of the format.
const MAGIC: &str = "halflight part 2";

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

    /// Reads a header and its checksum.
    pub(super) fn read(from: &mut impl BufRead) -> io::Result<Found> {
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
        let text = String::from_utf8_lossy(&text);
        Ok(match (Self::of(&text), OldForm::of(&text)) {
            (Some((header, crc)), _) => Found::Header(header, crc),
            (None, Some(old)) => Found::Old(old),
            (None, None) => Found::Nothing,
        })
    }

    fn of(text: &str) -> Option<(Self, u32)> {
        let (_, picture) = text.split_once('\n')?;
        let (picture, behind) = picture.rsplit_once("\nshard ")?;
        let picture = PictureMetadata::read(&format!("{picture}\nspp 1\n")).provenance()?;
        let header = Self {
            picture,
            shard: Shard::parse(behind.lines().next()?)?,
        };
        // Whatever was read is only right if it is written so.
        let (written, crc) = header.text();
        (written == text).then_some((header, crc))
    }

    /// The blocks of its picture.
    pub(super) fn blocks(&self) -> Blocks {
        Blocks::of(self.picture.settings.traced().size())
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

/// What is at the beginning of a file.
pub(super) enum Found {
    /// A header with its checksum.
    Header(Header, u32),
    /// The header of an earlier form.
    Old(OldForm),
    /// No header, or not all of it is as it was written.
    Nothing,
}

/// A form in which earlier versions kept unfinished pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OldForm {
    /// Its name, such as `halflight part 1`.
    pub name: String,
    /// The version of the program that wrote it.
    pub version: String,
}

impl OldForm {
    /// The forms of parts, and of the traces that the interface kept apart from them.
    const PART: &str = "halflight part 1";
    pub(super) const TRACES: [&str; 2] = ["halflight trace 1", "halflight trace 2"];

    /// The old form that this text begins with, if any.
    pub(super) fn of(text: &str) -> Option<Self> {
        let mut lines = text.lines();
        let name = lines.next()?;
        if name != Self::PART && !Self::TRACES.contains(&name) {
            return None;
        }
        let version = lines.next()?.strip_prefix("version ")?;
        let is_version_byte = |byte: &u8| byte.is_ascii_alphanumeric() || b".-+".contains(byte);
        version
            .as_bytes()
            .iter()
            .all(is_version_byte)
            .then(|| Self {
                name: name.to_owned(),
                version: version.to_owned(),
            })
    }
}

/// As the end of a sentence about a file.
impl fmt::Display for OldForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, version } = self;
        write!(
            f,
            "was written by an earlier build of version {version} in a form that is no longer read \
             ({name}); finish it with that build, or delete it"
        )
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
