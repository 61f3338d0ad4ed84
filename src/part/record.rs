//! What follows the header of a part file: records, each with a checksum of its bytes.
//!
//! | record | bytes, integers and floats in little-endian order |
//! |---|---|
//! | goal | `G`, samples of each pixel as u32, CRC |
//! | block | `B`, or `A` if some squares stopped, number and samples as u32, rays, shadow rays and samples over budget as u64, the number of pixels of `half` as u32 (all or none), sums as 3 f64 a pixel, squared errors as f32, sums at half as 3 f64, with `A` the samples of each of 64 squares as u32, CRC |
//!
//! Each CRC is the CRC-32 of the bytes of its record, begun with that of the header: records do not
//! fit into another file. A later record replaces an earlier one of the same kind and number.

use std::io::{self, Read};

use crc32fast::Hasher;
use glam::DVec3;

use render::{Block, Blocks, Counts};

const GOAL: u8 = b'G';
const BLOCK: u8 = b'B';
const ADAPTIVE: u8 = b'A';

/// Bytes before the pixels of a block.
const BLOCK_HEAD: usize = 1 + 4 + 4 + 3 * 8 + 4;

/// Squares of a block that stop together, each with its samples.
const SQUARES: usize = 64;

/// Bytes of a checksum.
const CRC: usize = 4;

/// A record.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Record {
    /// The samples of each pixel that the blocks after it are traced to.
    Goal(u32),
    /// A block as far as it is traced.
    Block(Block),
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
            Self::Goal(spp) => {
                bytes.push(GOAL);
                bytes.extend(spp.to_le_bytes());
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
            GOAL => 5,
            BLOCK | ADAPTIVE => BLOCK_HEAD,
            _ => return Err(Damage::Corrupt),
        };
        let missing = head - bytes.len();
        let mut more = |bytes: &mut Vec<u8>, count| {
            fill(from, bytes, count)?.then_some(()).ok_or(Damage::Short)
        };
        more(&mut bytes, missing)?;
        if bytes[0] != GOAL {
            let (number, half) = (u32_at(&bytes, 1), u32_at(&bytes, 33));
            if blocks.count() <= number {
                return Err(Damage::Corrupt);
            }
            let area = blocks.area(number);
            if half != 0 && half as usize != area {
                return Err(Damage::Corrupt);
            }
            let stopped = if bytes[0] == ADAPTIVE { 4 * SQUARES } else { 0 };
            more(&mut bytes, area * (24 + 4) + half as usize * 24 + stopped)?;
        }
        more(&mut bytes, CRC)?;
        let (said, crc) = bytes.split_at(bytes.len() - CRC);
        if checksum(header, said).to_le_bytes() != crc {
            return Err(Damage::Corrupt);
        }
        Ok(Some(match said[0] {
            GOAL => Self::Goal(u32_at(said, 1)),
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

fn put_block(block: &Block, bytes: &mut Vec<u8>) {
    let pixels = block.sums.len() * (24 + 4) + block.half.len() * 24;
    bytes.reserve(BLOCK_HEAD + pixels + 4 * block.stopped.len() + CRC);
    bytes.push(if block.stopped.is_empty() {
        BLOCK
    } else {
        ADAPTIVE
    });
    bytes.extend(block.number.to_le_bytes());
    bytes.extend(block.samples.to_le_bytes());
    let Counts {
        rays,
        shadow_rays,
        over_budget,
    } = block.counts;
    bytes.extend(
        [rays, shadow_rays, over_budget]
            .map(u64::to_le_bytes)
            .concat(),
    );
    bytes.extend((block.half.len() as u32).to_le_bytes());
    put_sums(&block.sums, bytes);
    let errors = block.squared_errors.iter();
    bytes.extend(errors.flat_map(|error| error.to_le_bytes()));
    put_sums(&block.half, bytes);
    let stopped = block.stopped.iter();
    bytes.extend(stopped.flat_map(|samples| samples.to_le_bytes()));
}

fn put_sums(sums: &[DVec3], bytes: &mut Vec<u8>) {
    for sum in sums {
        bytes.extend(sum.to_array().map(f64::to_le_bytes).as_flattened());
    }
}

/// The block of a record whose checksum is right.
fn block(bytes: &[u8], blocks: Blocks) -> Block {
    let u64_at = |at: usize| u64::from_le_bytes(array_at(bytes, at));
    let number = u32_at(bytes, 1);
    let area = blocks.area(number);
    let (sums, rest) = bytes[BLOCK_HEAD..].split_at(24 * area);
    let (errors, rest) = rest.split_at(4 * area);
    let (half, stopped) = rest.split_at(24 * u32_at(bytes, 33) as usize);
    let sums_of = |bytes: &[u8]| {
        let sums = bytes.chunks_exact(24);
        let channel = |sum: &[u8], at| f64::from_le_bytes(array_at(sum, at));
        sums.map(|sum| DVec3::new(channel(sum, 0), channel(sum, 8), channel(sum, 16)))
            .collect()
    };
    let errors = errors.chunks_exact(4);
    Block {
        number,
        samples: u32_at(bytes, 5),
        stopped: stopped
            .chunks_exact(4)
            .map(|samples| u32_at(samples, 0))
            .collect(),
        sums: sums_of(sums),
        half: sums_of(half),
        squared_errors: errors
            .map(|error| f32::from_le_bytes(array_at(error, 0)))
            .collect(),
        counts: Counts {
            rays: u64_at(9),
            shadow_rays: u64_at(17),
            over_budget: u64_at(25),
        },
    }
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(array_at(bytes, at))
}

fn array_at<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    let bytes = bytes[at..].first_chunk();
    *bytes.expect("the length of the record was checked")
}
