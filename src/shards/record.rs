//! What follows the header of a part file: records, each with a checksum of its bytes.
//!
//! | record | bytes, integers and floats in little-endian order |
//! |---|---|
//! | goal | `G`, samples of each pixel as u32, time spent up to then as nanoseconds in u64, CRC |
//! | block | `B`, which of the lists after the objects there are as bits of u8 in their order, number and samples as u32, rays, shadow rays and samples over budget as u64, of each pixel the sums as 3 f64, squared errors as f32, variances as f32 and objects as u32, sums at half as 3 f64, the touched sets as u64 with rays as u32, the samples of 64 squares apart as u32, CRC |
//!
//! Each CRC is the CRC-32 of the bytes of its record, begun with that of the header: records do not
//! fit into another file. A later record replaces an earlier one of the same kind and number.

use std::io::{self, Read};
use std::time::Duration;

use crc32fast::Hasher;
use glam::DVec3;

use render::{Block, Blocks, Counts, PixelHistory};

const GOAL: u8 = b'G';
const BLOCK: u8 = b'B';

/// Bytes of a goal.
const GOAL_BYTES: usize = 1 + 4 + 8;

/// Bytes before the pixels of a block.
const BLOCK_HEAD: usize = 1 + 1 + 4 + 4 + 3 * 8;

/// Bytes of a pixel in the lists that each block has.
const PIXEL: usize = SUM + 4 + 4 + 4;

/// Bytes of a pixel's sum, and of what it depends on.
const SUM: usize = 3 * 8;
const HISTORY: usize = 8 + 4;

/// The bits of the lists that some blocks have.
const HALF: u8 = 1;
const HISTORIES: u8 = 2;
const APART: u8 = 4;

/// Squares of a block that take samples together.
const SQUARES: usize = 64;

/// Bytes of a checksum.
const CRC: usize = 4;

/// A record.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Record {
    /// What the blocks after it are traced to.
    Goal(Goal),
    /// A block as far as it is traced.
    Block(Block),
}

/// How far blocks are traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Goal {
    /// Samples of each pixel.
    pub spp: u32,
    /// The time spent up to then, in all processes.
    pub time: Duration,
}

/// Why no record can be read.
#[derive(Debug)]
pub(super) enum Damage {
    /// It ends early: it was not completely written.
    Short,
    /// Its bytes are not those that were written.
    Corrupt,
    /// The file cannot be read.
    Io(io::Error),
}

impl Record {
    /// The bytes of a record of a file whose header has this checksum.
    pub(super) fn bytes(&self, header: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        match self {
            Self::Goal(Goal { spp, time }) => {
                bytes.push(GOAL);
                bytes.extend(spp.to_le_bytes());
                // More than five centuries.
                let time = u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
                bytes.extend(time.to_le_bytes());
            }
            Self::Block(block) => put_block(block, &mut bytes),
        }
        let crc = checksum(header, &bytes);
        bytes.extend(crc.to_le_bytes());
        bytes
    }

    /// Reads the next record of a part of a picture with these blocks; `None` at the end of the
    /// file.
    pub(super) fn read(
        from: &mut impl Read,
        blocks: Blocks,
        header: u32,
    ) -> Result<Option<Self>, Damage> {
        let mut bytes = Vec::new();
        if !fill(from, &mut bytes, 1)? {
            return if bytes.is_empty() {
                Ok(None)
            } else {
                Err(Damage::Short)
            };
        }
        let head = match bytes[0] {
            GOAL => GOAL_BYTES,
            BLOCK => BLOCK_HEAD,
            _ => return Err(Damage::Corrupt),
        };
        let missing = head - bytes.len();
        let mut more = |bytes: &mut Vec<u8>, count| {
            fill(from, bytes, count)?.then_some(()).ok_or(Damage::Short)
        };
        more(&mut bytes, missing)?;
        if bytes[0] == BLOCK {
            let (lists, number) = (bytes[1], u32_at(&bytes, 2));
            if blocks.count() <= number || HALF | HISTORIES | APART < lists {
                return Err(Damage::Corrupt);
            }
            let area = blocks.area(number);
            more(
                &mut bytes,
                PIXEL * area + lengths(lists, area).iter().sum::<usize>(),
            )?;
        }
        more(&mut bytes, CRC)?;
        let (said, crc) = bytes.split_at(bytes.len() - CRC);
        if checksum(header, said).to_le_bytes() != crc {
            return Err(Damage::Corrupt);
        }
        Ok(Some(match said[0] {
            GOAL => Self::Goal(Goal {
                spp: u32_at(said, 1),
                time: Duration::from_nanos(u64_at(said, 5)),
            }),
            _ => Self::Block(block(said, blocks)),
        }))
    }
}

/// Appends `count` bytes; whether there were as many.
fn fill(from: &mut impl Read, bytes: &mut Vec<u8>, count: usize) -> Result<bool, Damage> {
    let read = from.by_ref().take(count as u64).read_to_end(bytes);
    Ok(read.map_err(Damage::Io)? == count)
}

fn checksum(header: u32, bytes: &[u8]) -> u32 {
    let mut hasher = Hasher::new_with_initial(header);
    hasher.update(bytes);
    hasher.finalize()
}

/// The bytes of each list that some blocks have, in a block of this many pixels, by their bits.
fn lengths(bits: u8, area: usize) -> [usize; 3] {
    let lists = [
        (HALF, SUM * area),
        (HISTORIES, HISTORY * area),
        (APART, 4 * SQUARES),
    ];
    lists.map(|(bit, bytes)| if bits & bit == 0 { 0 } else { bytes })
}

fn put_block(block: &Block, bytes: &mut Vec<u8>) {
    let bit = |bit: u8, is_empty: bool| if is_empty { 0 } else { bit };
    let lists = bit(HALF, block.half.is_empty())
        | bit(HISTORIES, block.histories.is_empty())
        | bit(APART, block.apart.is_empty());
    let area = block.sums.len();
    bytes.reserve(BLOCK_HEAD + PIXEL * area + lengths(lists, area).iter().sum::<usize>() + CRC);
    bytes.extend([BLOCK, lists]);
    bytes.extend(block.number.to_le_bytes());
    bytes.extend(block.samples.to_le_bytes());
    let Counts {
        rays,
        shadow_rays,
        over_budget,
    } = block.counts;
    let counts = [rays, shadow_rays, over_budget].map(u64::to_le_bytes);
    bytes.extend(counts.as_flattened());
    put_sums(&block.sums, bytes);
    for floats in [&block.squared_errors, &block.variances] {
        bytes.extend(floats.iter().flat_map(|float| float.to_le_bytes()));
    }
    bytes.extend(block.objects.iter().flat_map(|object| object.to_le_bytes()));
    put_sums(&block.half, bytes);
    for PixelHistory { touched, rays } in &block.histories {
        bytes.extend(touched.to_le_bytes());
        bytes.extend(rays.to_le_bytes());
    }
    bytes.extend(block.apart.iter().flat_map(|samples| samples.to_le_bytes()));
}

fn put_sums(sums: &[DVec3], bytes: &mut Vec<u8>) {
    for sum in sums {
        bytes.extend(sum.to_array().map(f64::to_le_bytes).as_flattened());
    }
}

/// The block of a record whose checksum is right.
fn block(bytes: &[u8], blocks: Blocks) -> Block {
    let (lists, number) = (bytes[1], u32_at(bytes, 2));
    let area = blocks.area(number);
    let [half, histories, apart] = lengths(lists, area);
    let mut rest = &bytes[BLOCK_HEAD..];
    let mut next = |count: usize| {
        let (list, others) = rest.split_at(count);
        rest = others;
        list
    };
    let sums_of = |bytes: &[u8]| {
        let channel = |sum: &[u8], at| f64::from_le_bytes(array_at(sum, at));
        let sums = bytes.chunks_exact(SUM);
        sums.map(|sum| DVec3::new(channel(sum, 0), channel(sum, 8), channel(sum, 16)))
            .collect()
    };
    let floats = |bytes: &[u8]| {
        let floats = bytes.chunks_exact(4);
        floats
            .map(|float| f32::from_le_bytes(array_at(float, 0)))
            .collect()
    };
    let integers = |bytes: &[u8]| {
        let integers = bytes.chunks_exact(4);
        integers.map(|integer| u32_at(integer, 0)).collect()
    };
    let history = |bytes: &[u8]| PixelHistory {
        touched: u64_at(bytes, 0),
        rays: u32_at(bytes, 8),
    };
    Block {
        number,
        samples: u32_at(bytes, 6),
        counts: Counts {
            rays: u64_at(bytes, 10),
            shadow_rays: u64_at(bytes, 18),
            over_budget: u64_at(bytes, 26),
        },
        sums: sums_of(next(SUM * area)),
        squared_errors: floats(next(4 * area)),
        variances: floats(next(4 * area)),
        objects: integers(next(4 * area)),
        half: sums_of(next(half)),
        histories: next(histories).chunks_exact(HISTORY).map(history).collect(),
        apart: integers(next(apart)),
    }
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(array_at(bytes, at))
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(array_at(bytes, at))
}

fn array_at<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    let bytes = bytes[at..].first_chunk();
    *bytes.expect("the length of the record was checked")
}
