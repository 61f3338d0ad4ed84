//! Files named by folders: everything in them, nested, in the order of their names.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::Messages;
use text::counted;

/// A file named by an argument, or found in a folder named by one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// Where it is.
    pub(super) path: PathBuf,
    /// Where it is inside the folder; of a file named itself, its name.
    pub(super) inside: PathBuf,
}

/// What arguments name.
#[derive(Debug, Default)]
pub(super) struct Listing {
    /// The files, those of each folder in the order of their names.
    pub(super) files: Vec<Found>,
    /// Folders that cannot be read, and why.
    pub(super) unreadable: Vec<(PathBuf, io::Error)>,
    /// Links in folders, which are not followed: they may lead out of what was handed in.
    links: usize,
}

impl Listing {
    /// Lists files, and what is wanted of the files in folders. Hidden files and links in folders are
    /// left out; a link that is itself an argument is followed.
    pub(super) fn of(arguments: &[PathBuf], is_wanted: impl Fn(&Path) -> bool) -> Self {
        let mut listing = Self::default();
        for argument in arguments {
            if argument.is_dir() {
                listing.add_folder(argument, &is_wanted);
            } else {
                listing.files.push(Found {
                    path: argument.clone(),
                    inside: argument.file_name().unwrap_or_default().into(),
                });
            }
        }
        listing
    }

    fn add_folder(&mut self, top: &Path, is_wanted: &impl Fn(&Path) -> bool) {
        let mut found = Vec::new();
        // Not by recursion: folders may be nested deeper than the stack.
        let mut folders = vec![top.to_owned()];
        while let Some(folder) = folders.pop() {
            let entries = fs::read_dir(&folder).and_then(Iterator::collect::<io::Result<Vec<_>>>);
            let entries = match entries {
                Ok(entries) => entries,
                Err(error) => {
                    self.unreadable.push((folder, error));
                    continue;
                }
            };
            for entry in entries {
                let is_hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
                let (path, kind) = (entry.path(), entry.file_type());
                match kind {
                    Ok(_) if is_hidden => {}
                    Ok(kind) if kind.is_dir() => folders.push(path),
                    Ok(kind) if kind.is_symlink() => self.links += 1,
                    Ok(kind) if kind.is_file() && is_wanted(&path) => found.push(path),
                    Ok(_) => {}
                    Err(error) => self.unreadable.push((path, error)),
                }
            }
        }
        found.sort();
        self.files.extend(found.into_iter().map(|path| Found {
            inside: path.strip_prefix(top).unwrap_or(&path).to_owned(),
            path,
        }));
    }

    /// Says what was left out.
    pub(super) fn tell_links(&self) {
        if 0 < self.links {
            let links = counted(self.links, "link");
            Messages::Text.note(&format!("{links} in the folders not followed"));
        }
    }
}
