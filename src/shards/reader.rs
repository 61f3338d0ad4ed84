//! A part file that is read from its beginning to its end.

use std::fs::File;
use std::io::{self, BufReader, Seek};

use super::header::{Found, Header, OldForm};
use super::record::{Damage, Record};

/// The size of the buffer that parts are read through, in bytes.
const CHUNK: usize = 1 << 20;

/// The header and the records of a part, one after the other.
pub(super) struct Reader {
    from: BufReader<File>,
    header: Header,
    header_crc: u32,
    /// Where the record begins that was read last, or could not be.
    offset: u64,
}

/// Why a file is not read as a part.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// The file system reported an error.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It is not a part file, or its header is damaged.
    #[error("it is not a part file, or its header is damaged")]
    NoPart,
    /// It has the form of an earlier version.
    #[error("it {0}")]
    Old(OldForm),
}

impl Reader {
    /// Reads the header of a file.
    pub(super) fn of(file: File) -> Result<Self, Unreadable> {
        let mut from = BufReader::with_capacity(CHUNK, file);
        let (header, header_crc) = match Header::read(&mut from)? {
            Found::Header(header, crc) => (header, crc),
            Found::Old(form) => return Err(Unreadable::Old(form)),
            Found::Nothing => return Err(Unreadable::NoPart),
        };
        Ok(Self {
            offset: from.stream_position()?,
            from,
            header,
            header_crc,
        })
    }

    pub(super) fn header(&self) -> &Header {
        &self.header
    }

    /// Where the record begins that was read last, or could not be.
    pub(super) fn offset(&self) -> u64 {
        self.offset
    }

    /// Reads the next record; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Record>, Damage> {
        self.offset = self.from.stream_position().map_err(Damage::Io)?;
        Record::read(&mut self.from, self.header.blocks(), self.header_crc)
    }

    /// The file, its header and the checksum of that.
    pub(super) fn into_parts(self) -> (File, Header, u32) {
        (self.from.into_inner(), self.header, self.header_crc)
    }
}
