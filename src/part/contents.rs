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
    /// Those of a file that holds a header only, which ends there.
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

    /// The rays of all blocks, in this process and before.
    pub fn counts(&self) -> Counts {
        let counts = self.index.values().map(|place| place.counts);
        counts.fold(Counts::default(), Counts::and)
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

/// How far a picture is traced of which these files hold parts, if of each block the furthest counts.
pub struct Furthest<'p>(pub &'p [Contents]);

impl<'p> Furthest<'p> {
    /// The blocks of which something is traced.
    pub fn blocks(&self) -> impl Iterator<Item = io::Result<Block>> + use<'p> {
        let best = best_of(self.0);
        best.map(|(number, contents)| contents.block(number))
    }

    /// The mean number of samples of a pixel, rounded down.
    pub fn spp(&self) -> u32 {
        let taken = best_of(self.0).map(|(number, contents)| contents.taken(number));
        let pixels = self.0.first().map_or(1, |first| {
            let blocks = first.blocks();
            let areas = (0..blocks.count()).map(|number| blocks.area(number) as u64);
            areas.sum()
        });
        (taken.sum::<u64>() / pixels) as u32
    }

    /// The largest goal.
    pub fn goal(&self) -> Goal {
        let goals = self.0.iter().map(Contents::goal);
        goals
            .max_by_key(|goal| (goal.spp, goal.time))
            .unwrap_or_default()
    }
}

/// The numbers of the blocks of which something is traced, each with the file that has most of it.
fn best_of(files: &[Contents]) -> impl Iterator<Item = (u32, &Contents)> {
    let count = files.first().map_or(0, |first| first.blocks().count());
    (0..count).filter_map(|number| {
        // The first of equals.
        let best = files
            .iter()
            .rev()
            .max_by_key(|contents| contents.taken(number));
        let best = best.filter(|contents| 0 < contents.taken(number))?;
        Some((number, best))
    })
}
