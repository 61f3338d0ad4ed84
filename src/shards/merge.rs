//! Merges parts into one picture, or says which shards are incomplete.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

use super::header::Header;
use super::reader::{Reader, Unreadable};
use super::record::{Damage, Record};
use super::shard::deal;
use super::unmerged::Unmerged;
use file::ReadError;
use render::{Assembly, Block, Frame, Frames, Provenance};

/// A picture put together of parts.
#[derive(Debug)]
pub struct Merged {
    /// The picture.
    pub frame: Frame,
    /// What it is made from.
    pub picture: Provenance,
}

/// Puts parts together, one after the other, in the memory of one picture, which is taken only once they
/// are known to make a whole one. Its last frame has what `frames` says.
pub fn merge(parts: &[PathBuf], frames: Frames) -> Result<Merged, Unmerged> {
    let survey = survey(parts)?;
    survey.check()?;
    let mut assembly = Assembly::new(survey.header.picture.settings, frames)?;
    for path in parts {
        let mut reader = open(path)?;
        if reader.header().difference(&survey.header).is_some() {
            return Err(Unmerged::Io {
                path: path.clone(),
                source: io::Error::other(
                    "another process has changed it meanwhile; run the merge again",
                ),
            });
        }
        while let Some(record) = next(&mut reader, path)? {
            if let Record::Block(block) = record {
                assembly.place(&block);
            }
        }
    }
    let frame = assembly.finish(survey.goal());
    Ok(Merged {
        picture: survey.header.picture.in_frame(&frame),
        frame,
    })
}

/// What parts hold. Fails at the first that is damaged or belongs to another picture.
fn survey(parts: &[PathBuf]) -> Result<Survey, Unmerged> {
    let mut survey: Option<Survey> = None;
    for path in parts {
        let mut reader = open(path)?;
        let header = reader.header().clone();
        let survey = survey.get_or_insert_with(|| Survey::new(header.clone()));
        survey.add(path, &header)?;
        while let Some(record) = next(&mut reader, path)? {
            survey.note(header.shard.index, &record);
        }
    }
    survey.ok_or_else(no_parts)
}

fn no_parts() -> Unmerged {
    Unmerged::Io {
        path: PathBuf::new(),
        source: io::Error::other("no parts"),
    }
}

/// The shards that lack blocks, given all parts there are, as ranges such as `3,7-9`; and what is
/// wrong with parts that are damaged, whose shards count as lacking.
pub fn missing(parts: &[PathBuf]) -> Result<(Vec<u32>, Vec<Unmerged>), Unmerged> {
    let mut survey: Option<Survey> = None;
    let mut damaged = Vec::new();
    for path in parts {
        let mut reader = match open(path) {
            Err(no_part @ Unmerged::NoPart { .. }) => {
                damaged.push(no_part);
                continue;
            }
            opened => opened?,
        };
        let header = reader.header().clone();
        let survey = survey.get_or_insert_with(|| Survey::new(header.clone()));
        survey.add(path, &header)?;
        loop {
            match next(&mut reader, path) {
                Ok(Some(record)) => survey.note(header.shard.index, &record),
                Ok(None) => break,
                Err(error @ Unmerged::Io { .. }) => return Err(error),
                Err(damage) => {
                    survey.damaged.insert(header.shard.index);
                    damaged.push(damage);
                    break;
                }
            }
        }
    }
    match survey {
        Some(survey) => {
            let (_, shards) = survey.lacking();
            Ok((shards.into_iter().collect(), damaged))
        }
        // How many shards there are is not known.
        None => Err(damaged.pop().unwrap_or_else(no_parts)),
    }
}

/// Opens a part, which must be a file.
fn open(path: &Path) -> Result<Reader, Unmerged> {
    let path = || path.to_owned();
    let io = |source| Unmerged::Io {
        path: path(),
        source,
    };
    let file = file::open(&path()).map_err(|error| match error {
        ReadError::NotRegular { path, kind } => Unmerged::NotRegular { path, kind },
        ReadError::Io { source, .. } => io(source),
        ReadError::NotFound { .. } => io(io::Error::new(io::ErrorKind::NotFound, "no such file")),
        other => io(io::Error::other(other.to_string())),
    })?;
    Reader::of(file).map_err(|unreadable| match unreadable {
        Unreadable::Io(source) => io(source),
        Unreadable::NoPart => Unmerged::NoPart { path: path() },
        Unreadable::Old(form) => Unmerged::Old { path: path(), form },
    })
}

/// The next record of a part.
fn next(reader: &mut Reader, path: &Path) -> Result<Option<Record>, Unmerged> {
    let path = || path.to_owned();
    reader.next().map_err(|damage| {
        let offset = reader.offset();
        match damage {
            Damage::Io(source) => Unmerged::Io {
                path: path(),
                source,
            },
            Damage::Short => Unmerged::Short {
                path: path(),
                offset,
            },
            Damage::Corrupt => Unmerged::Damaged {
                path: path(),
                offset,
            },
        }
    })
}

/// What the parts hold.
struct Survey {
    header: Header,
    /// The file of each shard.
    paths: BTreeMap<u32, PathBuf>,
    /// The samples that each shard is traced to.
    goals: BTreeMap<u32, u32>,
    /// The samples of the blocks that there are.
    samples: BTreeMap<u32, u32>,
    damaged: BTreeSet<u32>,
}

impl Survey {
    /// Begins with the header of the first part.
    fn new(header: Header) -> Self {
        Self {
            header,
            paths: BTreeMap::new(),
            goals: BTreeMap::new(),
            samples: BTreeMap::new(),
            damaged: BTreeSet::new(),
        }
    }

    /// Adds a part, if it belongs to the others.
    fn add(&mut self, path: &Path, header: &Header) -> Result<(), Unmerged> {
        let first = || self.paths.values().next().cloned().unwrap_or_default();
        if let Some(difference) = header.difference(&self.header) {
            return Err(Unmerged::Mismatch {
                path: path.to_owned(),
                first: first(),
                difference,
            });
        }
        let shard = header.shard;
        match self.paths.insert(shard.index, path.to_owned()) {
            Some(first) => Err(Unmerged::Twice {
                path: path.to_owned(),
                first,
                shard,
            }),
            None => Ok(()),
        }
    }

    fn note(&mut self, shard: u32, record: &Record) {
        match record {
            Record::Goal(goal) => {
                self.goals.insert(shard, goal.spp);
            }
            Record::Block(Block {
                number, samples, ..
            }) => {
                self.samples.insert(*number, *samples);
            }
        }
    }

    /// The samples that the picture is traced to.
    fn goal(&self) -> u32 {
        self.goals.values().copied().max().unwrap_or(0)
    }

    /// How many blocks are not traced to the end, and the shards that have to be traced on for them.
    fn lacking(&self) -> (u32, BTreeSet<u32>) {
        let goal = self.goal();
        let owners = deal(self.header.blocks(), self.header.shard.count);
        let mut shards = BTreeSet::new();
        let mut count = 0;
        for (number, owner) in (0..).zip(owners) {
            let samples = self.samples.get(&number).copied().unwrap_or(0);
            if samples < goal || goal == 0 || self.damaged.contains(&owner) {
                count += 1;
                shards.insert(owner);
            }
        }
        (count, shards)
    }

    /// Fails unless all blocks are traced to the end.
    fn check(&self) -> Result<(), Unmerged> {
        let count = self.header.shard.count;
        let by_samples = |&(_, &samples): &(&u32, &u32)| samples;
        let fewest = self.goals.iter().min_by_key(by_samples);
        let most = self.goals.iter().max_by_key(by_samples);
        if let Some(((fewest, &samples), (at, &most))) = fewest.zip(most)
            && samples < most
        {
            let fewer = self.goals.iter().filter(|&(_, &samples)| samples < most);
            return Err(Unmerged::Uneven {
                path: self.paths[fewest].clone(),
                samples,
                most_path: self.paths[at].clone(),
                most,
                shards: fewer.map(|(&shard, _)| shard).collect(),
                count,
            });
        }
        let (lacking, shards) = self.lacking();
        if lacking == 0 {
            return Ok(());
        }
        Err(Unmerged::Holes {
            blocks: lacking,
            all: self.header.blocks().count(),
            shards: shards.into_iter().collect(),
            count,
        })
    }
}
