//! A part file that is written.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::header::{Difference, Header};
use super::record::{Damage, Record};
use file::{Lock, lock};
use render::{Block, Blocks, Counts};

/// A part file open for writing, locked against other writers.
#[derive(Debug)]
pub struct Part {
    file: File,
    blocks: Blocks,
    header_crc: u32,
    /// The newest record of each block.
    index: BTreeMap<u32, Place>,
    /// The samples that blocks are traced to.
    goal: Option<u32>,
    /// Bytes that were cut off because they hold no whole record.
    cut: u64,
    /// Where the next record begins.
    end: u64,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    /// Where it begins.
    offset: u64,
    samples: u32,
    most_samples: u32,
    counts: Counts,
}

impl Place {
    fn of(block: &Block, offset: u64) -> Self {
        Self {
            offset,
            samples: block.samples,
            most_samples: block.most_samples(),
            counts: block.counts,
        }
    }
}

/// Why a part file cannot be continued.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// The file system reported an error.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// Another process is writing it.
    #[error("another process is writing it")]
    Busy,
    /// It exists, and is not to be continued.
    #[error("it exists; continue it with --resume, or delete it")]
    Exists,
    /// A symbolic link that leads nowhere is in its place.
    #[error("it is a dangling symbolic link; delete it")]
    Dangling,
    /// It is not a part file, or its header is damaged.
    #[error("it is not a part file, or its header is damaged; delete it to start over")]
    NoPart,
    /// It is a part of another picture.
    #[error(
        "it belongs to another picture: {} {}, not {}; delete it to start over",
        .0.what, .0.theirs, .0.ours
    )]
    Other(Difference),
}

impl Part {
    /// Creates a part file, which must not exist; nor may a link be in its place.
    pub fn create(path: &Path, header: &Header) -> Result<Self, Refused> {
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .create_new(true)
            .open(path);
        let file = file.map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists if path.exists() => Refused::Exists,
            io::ErrorKind::AlreadyExists => Refused::Dangling,
            _ => Refused::Io(error),
        })?;
        if lock(&file) == Lock::Busy {
            return Err(Refused::Busy);
        }
        Self::begin(file, header)
    }

    /// Opens a part file to continue it, or creates it. Cuts off what is no whole record at its end,
    /// and everything from the first damaged record on; begins anew where only a beginning of this
    /// header was written.
    pub fn open(path: &Path, header: &Header) -> Result<Self, Refused> {
        let found = match fs::metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Self::create(path, header).map_err(|refused| match refused {
                    // It was not there a moment ago.
                    Refused::Exists => Refused::Busy,
                    refused => refused,
                });
            }
            found => found?,
        };
        // Opening a pipe could wait for ever.
        if !found.is_file() {
            return Err(Refused::NoPart);
        }
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        if lock(&file) == Lock::Busy {
            return Err(Refused::Busy);
        }
        if is_begun(&file, header)? {
            return Self::begin(file, header);
        }
        Self::scan(file, header)
    }

    /// Writes the header into a file that holds at most the beginning of it.
    fn begin(mut file: File, header: &Header) -> Result<Self, Refused> {
        let (text, header_crc) = header.text();
        file.rewind()?;
        file.write_all(text.as_bytes())?;
        Ok(Self {
            file,
            blocks: blocks(header),
            header_crc,
            index: BTreeMap::new(),
            goal: None,
            cut: 0,
            end: text.len() as u64,
        })
    }

    /// Reads what was written before.
    fn scan(file: File, header: &Header) -> Result<Self, Refused> {
        let mut from = BufReader::with_capacity(1 << 18, &file);
        let (found, header_crc) = Header::read(&mut from)?.ok_or(Refused::NoPart)?;
        if let Some(difference) = header.difference(&found) {
            return Err(Refused::Other(difference));
        }
        if found.shard != header.shard {
            return Err(Refused::Other(Difference {
                what: "shard",
                ours: header.shard.to_string(),
                theirs: found.shard.to_string(),
            }));
        }
        let blocks = blocks(header);
        let (mut index, mut goal) = (BTreeMap::new(), None);
        let mut offset = from.stream_position()?;
        loop {
            match Record::read(&mut from, blocks, header_crc) {
                Ok(Some(Record::Goal(spp))) => goal = Some(spp),
                Ok(Some(Record::Block(block))) => {
                    index.insert(block.number, Place::of(&block, offset));
                }
                Err(Damage::Io(error)) => return Err(error.into()),
                Ok(None) | Err(Damage::Short | Damage::Corrupt) => break,
            }
            offset = from.stream_position()?;
        }
        let cut = file.metadata()?.len() - offset;
        file.set_len(offset)?;
        Ok(Self {
            file,
            blocks,
            header_crc,
            index,
            goal,
            cut,
            end: offset,
        })
    }

    /// Bytes that were cut off when it was opened.
    pub fn cut(&self) -> u64 {
        self.cut
    }

    /// The blocks of its picture.
    pub fn blocks(&self) -> Blocks {
        self.blocks
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

    /// The rays of all blocks, in this process and before.
    pub fn counts(&self) -> Counts {
        let counts = self.index.values().map(|place| place.counts);
        counts.fold(Counts::default(), Counts::and)
    }

    /// A block as far as it was written.
    pub fn block(&self, number: u32) -> io::Result<Block> {
        let Some(place) = self.index.get(&number) else {
            return Ok(Block::new(number, self.blocks));
        };
        let mut file = &self.file;
        file.seek(SeekFrom::Start(place.offset))?;
        match Record::read(&mut BufReader::new(file), self.blocks, self.header_crc) {
            Ok(Some(Record::Block(block))) => Ok(block),
            Err(Damage::Io(error)) => Err(error),
            _ => Err(io::Error::other("it was changed by another process")),
        }
    }

    /// States how many samples the blocks are traced to from now on.
    pub fn aim(&mut self, spp: u32) -> io::Result<()> {
        if self.goal != Some(spp) {
            self.append(&Record::Goal(spp))?;
            self.goal = Some(spp);
        }
        Ok(())
    }

    /// Appends a block. If that fails, the file ends as before.
    pub fn put(&mut self, block: Block) -> io::Result<()> {
        let (number, place) = (block.number, Place::of(&block, self.end));
        self.append(&Record::Block(block))?;
        self.index.insert(number, place);
        Ok(())
    }

    /// Waits until all that was appended is on the disk.
    pub fn sync(&self) -> io::Result<()> {
        self.file.sync_data()
    }

    /// Appends a record.
    fn append(&mut self, record: &Record) -> io::Result<()> {
        let bytes = record.bytes(self.header_crc);
        let begin = self.end;
        let written = self
            .file
            .seek(SeekFrom::Start(begin))
            .and_then(|_| self.file.write_all(&bytes));
        if let Err(error) = written {
            // If this fails too, opening the file cuts it off.
            let _ = self.file.set_len(begin);
            return Err(error);
        }
        self.end += bytes.len() as u64;
        Ok(())
    }
}

/// Whether a process was killed before it had written all of this header.
fn is_begun(mut file: &File, header: &Header) -> io::Result<bool> {
    let (text, _) = header.text();
    let mut found = Vec::new();
    file.take(text.len() as u64).read_to_end(&mut found)?;
    file.rewind()?;
    Ok(found.len() < text.len() && text.as_bytes().starts_with(&found))
}

/// The blocks of the picture that a part belongs to.
pub(super) fn blocks(header: &Header) -> Blocks {
    Blocks::of(header.picture.settings.traced().size())
}

/// The part file beside a picture, such as `out.part` or `out.3-8.part` beside `out.png`.
pub fn path_beside(picture: &Path, shard: super::Shard) -> PathBuf {
    let super::Shard { index, count } = shard;
    picture.with_extension(match count {
        1 => "part".to_owned(),
        _ => format!("{index}-{count}.part"),
    })
}
