//! What a part file holds: the newest record of each block.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, Seek, SeekFrom};

use super::header::Header;
use super::reader::{Reader, Unreadable};
use super::record::{Damage, Goal, Record};
use render::{Block, Blocks, Counts};

/// The blocks of an open part file.
#[derive(Debug)]
pub struct Contents {
    pub(super) file: File,
    header: Header,
    pub(super) header_crc: u32,
    /// The newest record of each block.
    pub(super) index: BTreeMap<u32, Place>,
    pub(super) goal: Option<Goal>,
    /// Where the good records end.
    pub(super) end: u64,
    is_whole: bool,
}

/// Where a block is, and how far it is traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Where it begins.
    offset: u64,
    samples: u32,
    most_samples: u32,
    /// The sum of the numbers of samples of its pixels.
    taken: u64,
    counts: Counts,
}

impl Contents {
    /// The contents of a file that ends after its header.
    pub(super) fn none(file: File, header: Header, header_crc: u32, end: u64) -> Self {
        Self {
            file,
            header,
            header_crc,
            index: BTreeMap::new(),
            goal: None,
            end,
            is_whole: true,
        }
    }

    /// Reads a file up to its end or the first damaged record.
    pub(super) fn of(file: File) -> Result<Self, Unreadable> {
        let mut reader = Reader::of(file)?;
        let blocks = reader.header().blocks();
        let (mut index, mut goal) = (BTreeMap::new(), None);
        let is_whole = loop {
            match reader.next() {
                Ok(Some(Record::Goal(newer))) => goal = Some(newer),
                Ok(Some(Record::Block(block))) => {
                    index.insert(block.number, Place::of(&block, blocks, reader.offset()));
                }
                Ok(None) => break true,
                Err(Damage::Short | Damage::Corrupt) => break false,
                Err(Damage::Io(error)) => return Err(error.into()),
            }
        };
        let end = reader.offset();
        let (file, header, header_crc) = reader.into_parts();
        Ok(Self {
            index,
            goal,
            is_whole,
            ..Self::none(file, header, header_crc, end)
        })
    }

    /// Whether all of the file is as it was written.
    pub(super) fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Which picture it is a part of, and which part.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The blocks of its picture.
    pub fn blocks(&self) -> Blocks {
        self.header.blocks()
    }

    /// How far the blocks are to be traced; zeros if that is not known.
    pub fn goal(&self) -> Goal {
        self.goal.unwrap_or_default()
    }

    /// Samples of each pixel of a block.
    pub fn samples(&self, number: u32) -> u32 {
        self.index.get(&number).map_or(0, |place| place.samples)
    }

    /// Samples of the pixels of a block that have most: fewer if all of them stopped.
    pub fn most_samples(&self, number: u32) -> u32 {
        let place = self.index.get(&number);
        place.map_or(0, |place| place.most_samples)
    }

    /// The sum of the numbers of samples of the pixels of a block.
    pub fn taken(&self, number: u32) -> u64 {
        self.index.get(&number).map_or(0, |place| place.taken)
    }

    /// The sum of the numbers of samples of all pixels.
    pub fn all_taken(&self) -> u64 {
        self.index.values().map(|place| place.taken).sum()
    }

    /// The mean number of samples of a pixel, rounded down.
    pub fn mean_samples(&self) -> u32 {
        let pixels = self.header.picture.settings.traced().size().pixels();
        (self.all_taken() / pixels as u64) as u32
    }

    /// The rays of all blocks, in this process and before.
    pub fn counts(&self) -> Counts {
        let counts = self.index.values().map(|place| place.counts);
        counts.fold(Counts::default(), Counts::and)
    }

    /// The blocks of which something is written.
    pub fn written(&self) -> impl Iterator<Item = io::Result<Block>> {
        self.index.keys().map(|&number| self.block(number))
    }

    /// A block as far as it was written.
    pub fn block(&self, number: u32) -> io::Result<Block> {
        let Some(place) = self.index.get(&number) else {
            return Ok(Block::new(number, self.blocks()));
        };
        let mut file = &self.file;
        file.seek(SeekFrom::Start(place.offset))?;
        match Record::read(&mut BufReader::new(file), self.blocks(), self.header_crc) {
            Ok(Some(Record::Block(block))) => Ok(block),
            Err(Damage::Io(error)) => Err(error),
            _ => Err(io::Error::other("it was changed by another process")),
        }
    }
}

impl Place {
    pub(super) fn of(block: &Block, blocks: Blocks, offset: u64) -> Self {
        Self {
            offset,
            samples: block.samples,
            most_samples: block.most_samples(),
            taken: block.total(blocks),
            counts: block.counts,
        }
    }
}
