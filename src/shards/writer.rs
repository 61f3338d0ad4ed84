//! A part file that is written.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::iter;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::contents::{Contents, Place};
use super::header::{Difference, Header, OldForm};
use super::reader::Unreadable;
use super::record::{Goal, Record};
use super::shard::Shard;
use file::{Lock, lock};
use render::{Block, Provenance};

/// A part file open for writing, locked against other writers.
#[derive(Debug)]
pub struct Part {
    contents: Contents,
    /// Bytes that were cut off because they hold no whole record.
    cut: u64,
}

impl Deref for Part {
    type Target = Contents;

    fn deref(&self) -> &Contents {
        &self.contents
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
    /// It has the form of an earlier version.
    #[error("it {0}")]
    Old(OldForm),
    /// It is a part of another picture.
    #[error(
        "it belongs to another picture: {} {}, not {}; delete it to start over",
        .0.what, .0.theirs, .0.ours
    )]
    Other(Difference),
}

impl From<Unreadable> for Refused {
    fn from(unreadable: Unreadable) -> Self {
        match unreadable {
            Unreadable::Io(error) => Self::Io(error),
            Unreadable::NoPart => Self::NoPart,
            Unreadable::Old(form) => Self::Old(form),
        }
    }
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
        let end = text.len() as u64;
        Ok(Self {
            contents: Contents::none(file, header.clone(), header_crc, end),
            cut: 0,
        })
    }

    /// Reads what was written before.
    fn scan(file: File, header: &Header) -> Result<Self, Refused> {
        let contents = Contents::of(file)?;
        let found = contents.header();
        if let Some(difference) = header.difference(found) {
            return Err(Refused::Other(difference));
        }
        if found.shard != header.shard {
            return Err(Refused::Other(Difference {
                what: "shard",
                ours: header.shard.to_string(),
                theirs: found.shard.to_string(),
            }));
        }
        let cut = contents.file.metadata()?.len() - contents.end;
        contents.file.set_len(contents.end)?;
        Ok(Self { contents, cut })
    }

    /// Bytes that were cut off when it was opened.
    pub fn cut(&self) -> u64 {
        self.cut
    }

    /// States how many samples the blocks are traced to from now on.
    pub fn aim(&mut self, spp: u32) -> io::Result<()> {
        let time = self.goal().time;
        self.set_goal(Goal { spp, time })
    }

    /// States how much time was spent on the blocks up to now, in all processes.
    pub fn spend(&mut self, time: Duration) -> io::Result<()> {
        let spp = self.goal().spp;
        self.set_goal(Goal { spp, time })
    }

    fn set_goal(&mut self, goal: Goal) -> io::Result<()> {
        if self.contents.goal != Some(goal) {
            self.append(&Record::Goal(goal))?;
            self.contents.goal = Some(goal);
        }
        Ok(())
    }

    /// Appends a block. If that fails, the file ends as before.
    pub fn put(&mut self, block: Block) -> io::Result<()> {
        let number = block.number;
        let place = Place::of(&block, self.blocks(), self.end);
        self.append(&Record::Block(block))?;
        self.contents.index.insert(number, place);
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
        let mut file = &self.file;
        let written = file
            .seek(SeekFrom::Start(begin))
            .and_then(|_| file.write_all(&bytes));
        if let Err(error) = written {
            // If this fails too, opening the file cuts it off.
            let _ = self.file.set_len(begin);
            return Err(error);
        }
        self.contents.end += bytes.len() as u64;
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

/// Writes all of a part that is the whole picture.
pub(super) fn write_whole(
    picture: &Provenance,
    goal: Goal,
    blocks: impl Iterator<Item = Block>,
    out: &mut impl Write,
) -> io::Result<()> {
    let header = Header {
        picture: picture.clone(),
        shard: Shard::WHOLE,
    };
    let (text, header_crc) = header.text();
    out.write_all(text.as_bytes())?;
    for record in iter::once(Record::Goal(goal)).chain(blocks.map(Record::Block)) {
        out.write_all(&record.bytes(header_crc))?;
    }
    Ok(())
}

/// The part file beside a picture, such as `out.part` or `out.3-8.part` beside `out.png`.
pub fn path_beside(picture: &Path, shard: Shard) -> PathBuf {
    let Shard { index, count } = shard;
    picture.with_extension(match count {
        1 => "part".to_owned(),
        _ => format!("{index}-{count}.part"),
    })
}
