//! Which frames of a sequence are finished.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Error;
use crate::file::{self, Digest, ReadError};

/// The first line of every list, with the version of the format.
const HEADER: &str = "halflight frames 1\n";

/// A list of finished frames beside their pictures: after [`HEADER`] a line `INPUTS PICTURE NAME` for
/// each, with the SHA-256 of what it was made of and of its file, whose name is escaped as in Rust.
/// Lines are only appended; what is no such line is skipped.
#[derive(Debug)]
pub(super) struct Ledger {
    path: PathBuf,
    /// The digests that the file of a frame may have, by its inputs and name.
    finished: BTreeMap<[String; 2], BTreeSet<String>>,
    /// What is to be written before the next line.
    lead: &'static str,
    file: Option<File>,
}

impl Ledger {
    /// Reads a list, which need not exist, to append to it; and what other lists name, as far as they
    /// are lists.
    pub(super) fn read(path: PathBuf, others: &[PathBuf]) -> Result<Self, Error> {
        let unusable = |source| Error::Create {
            path: path.clone(),
            source,
        };
        let text = text(&path).map_err(unusable)?;
        let lead = if let Some(rest) = HEADER.strip_prefix(&text) {
            // A process that was killed at once leaves a part of it.
            rest
        } else if !text.starts_with(HEADER) {
            return Err(unusable(io::Error::other(
                "exists, but is not a list of finished frames; move it away, or name the pictures \
                 differently",
            )));
        } else if text.ends_with('\n') {
            ""
        } else {
            "\n"
        };
        let mut ledger = Self {
            path,
            finished: BTreeMap::new(),
            lead,
            file: None,
        };
        ledger.learn(&text);
        for other in others {
            ledger.learn(&self::text(other).unwrap_or_default());
        }
        Ok(ledger)
    }

    /// Notes the frames that a list names.
    fn learn(&mut self, text: &str) {
        let lines = text.strip_prefix(HEADER).unwrap_or_default().lines();
        for line in lines {
            let mut words = line.splitn(3, ' ').map(str::to_owned);
            if let (Some(inputs), Some(picture), Some(name)) =
                (words.next(), words.next(), words.next())
            {
                let pictures = self.finished.entry([inputs, name]).or_default();
                pictures.insert(picture);
            }
        }
    }

    /// Whether a frame is made of these inputs, and its file is as it was written.
    pub(super) fn has(&self, inputs: &str, picture: &Path) -> bool {
        let key = [inputs.to_owned(), name_of(picture)];
        self.finished.get(&key).is_some_and(|written| {
            Digest::of_file(picture).is_ok_and(|found| written.contains(&found))
        })
    }

    /// Notes that a frame is finished, and what its file holds.
    pub(super) fn add(&mut self, inputs: &str, picture: &Path, bytes: &[u8]) -> Result<(), Error> {
        let digest = Digest::of([bytes]);
        let line = format!("{}{inputs} {digest} {}\n", self.lead, name_of(picture));
        self.append(&line).map_err(|source| Error::Create {
            path: self.path.clone(),
            source,
        })?;
        self.lead = "";
        Ok(())
    }

    fn append(&mut self, line: &str) -> io::Result<()> {
        let file = if let Some(file) = &mut self.file {
            file
        } else {
            let mut options = OpenOptions::new();
            let opened = options.append(true).create(true).open(&self.path)?;
            self.file.insert(opened)
        };
        file.write_all(line.as_bytes())
    }
}

/// The text of a list; empty if there is none. What is not UTF-8 is no part of a list.
fn text(path: &Path) -> io::Result<String> {
    match file::read_bytes(path, file::MAX_BYTES) {
        Ok(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
        Err(ReadError::NotFound { .. }) => Ok(String::new()),
        Err(ReadError::Io { source, .. }) => Err(source),
        Err(ReadError::NotRegular { kind, .. }) => Err(io::Error::other(format!(
            "is {kind}, where the list of finished frames belongs"
        ))),
        Err(error) => Err(io::Error::other(error.to_string())),
    }
}

/// The name of a file, on one line.
fn name_of(picture: &Path) -> String {
    let name = picture.file_name().unwrap_or_default();
    name.to_string_lossy().escape_debug().to_string()
}
