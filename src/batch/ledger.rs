//! Which frames of a sequence are finished.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::file::Digest;

/// A list of finished frames beside their pictures: a line `FRAME INPUTS PICTURE` for each, with the
/// SHA-256 of what it was made of and of its file. Lines are only appended; a later one of the same
/// frame counts, and what is no such line is skipped.
#[derive(Debug)]
pub(super) struct Ledger {
    path: PathBuf,
    /// The digests of each frame.
    finished: BTreeMap<u32, [String; 2]>,
    file: Option<File>,
}

impl Ledger {
    /// Reads a list, which need not exist.
    pub(super) fn read(path: PathBuf) -> io::Result<Self> {
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            text => text?,
        };
        let entry = |line: &str| {
            let mut words = line.split(' ');
            let frame = words.next()?.parse().ok()?;
            let digests = [words.next()?.to_owned(), words.next()?.to_owned()];
            words.next().is_none().then_some((frame, digests))
        };
        Ok(Self {
            finished: text.lines().filter_map(entry).collect(),
            path,
            file: None,
        })
    }

    /// Whether a frame is made of these inputs, and its file is as it was written.
    pub(super) fn has(&self, frame: u32, inputs: &str, picture: &Path) -> bool {
        self.finished.get(&frame).is_some_and(|[made_of, written]| {
            made_of == inputs && Digest::of_file(picture).is_ok_and(|found| found == *written)
        })
    }

    /// Notes that a frame is finished, and what its file holds.
    pub(super) fn add(&mut self, frame: u32, inputs: &str, picture: &[u8]) -> io::Result<()> {
        let file = if let Some(file) = &mut self.file {
            file
        } else {
            let mut options = OpenOptions::new();
            let opened = options.append(true).create(true).open(&self.path)?;
            self.file.insert(opened)
        };
        let line = format!("{frame} {inputs} {}\n", Digest::of([picture]));
        file.write_all(line.as_bytes())
    }
}
