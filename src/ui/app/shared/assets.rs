//! The pictures and meshes that the scene names: which are requested, and which have arrived.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::history_scene::KnownFiles;
use crate::msg::Effect;
use assets::{Loaded, Wanted};
use language::Source;
use text::{Findings, counted};

/// The state of the files that the scene names.
#[derive(Debug, Default)]
pub struct Assets {
    /// The files that were read last, with the problems with pictures; those with meshes are in its
    /// `meshes`.
    pub(crate) loaded: Loaded,
    /// How many readings have changed what pictures show.
    pub(crate) changes: u64,
    /// The files requested last: those of the last text without errors.
    asked: Option<Wanted>,
    /// Whether the request is still to be made.
    due: bool,
    /// Whether any requested file is still awaited.
    awaited: bool,
    /// Where files were found other than where first looked for, by name; each was announced.
    elsewhere: BTreeMap<String, PathBuf>,
}

/// Changes brought by files that were read.
pub(crate) struct News {
    /// Whether pictures have changed.
    pub(crate) images: bool,
    /// Whether the lowered scene or its diagnostics may have changed.
    pub(crate) meaning: bool,
    pub(crate) notice: Option<Notice>,
}

/// What to tell the user about files that were read.
pub(crate) enum Notice {
    /// Different files cannot be read than before: [`Assets::faults`].
    Faults,
    /// Where files were found, other than where first looked for.
    Elsewhere(String),
    /// Files have changed on disk and were read again.
    Reloaded,
}

impl Assets {
    /// Whether files that the scene names have yet to arrive.
    pub fn are_awaited(&self) -> bool {
        self.awaited
    }

    /// The files that were read, to be used for other texts of the scene.
    pub(crate) fn known(&self) -> KnownFiles {
        KnownFiles {
            names: self.asked.clone(),
            images: self.loaded.images.clone(),
            meshes: self.loaded.meshes.clone(),
        }
    }

    /// The paths of the scene's files that were read.
    pub(crate) fn files(&self) -> &[PathBuf] {
        &self.loaded.files
    }

    /// The path of the file read that diagnostics cite by this name.
    pub(crate) fn file(&self, cited: &str) -> Option<PathBuf> {
        let mut files = self.loaded.files.iter();
        files.find(|file| file.ends_with(cited)).cloned()
    }

    /// Whether a mesh that the scene names has neither been read nor failed to be.
    pub(crate) fn lack_meshes(&self) -> bool {
        let is_missing = |name: &String| self.loaded.meshes.get(name).is_none();
        let asked = self.asked.as_ref();
        asked.is_some_and(|asked| asked.meshes.iter().any(is_missing))
    }

    /// Adds the problems with the files of a text, and requests the files if it has no errors.
    pub(crate) fn report(
        &mut self,
        path: Option<&Path>,
        source: &Source,
        found: Findings,
    ) -> Findings {
        let files = source.files();
        if found.errors() == 0 {
            let path = path.filter(|_| !files.is_empty());
            self.want(path.map(|path| Wanted::new(path, &files)));
        }
        assets::report(&self.loaded.picture_errors, &files, &self.elsewhere, found)
    }

    fn want(&mut self, wanted: Option<Wanted>) {
        if self.asked == wanted {
            return;
        }
        let is_known = match (&self.asked, &wanted) {
            (Some(asked), Some(wanted)) => wanted.is_among(asked),
            (None, Some(_)) => false,
            (_, None) => true,
        };
        // An awaited file that is still wanted remains awaited.
        self.awaited = wanted.is_some() && (self.awaited || !is_known);
        self.due = wanted.is_some();
        if wanted.is_none() {
            self.loaded = Loaded::default();
        }
        self.asked = wanted;
    }

    /// Reads the files if others were requested in this step.
    pub(crate) fn follow(&mut self) -> Vec<Effect> {
        if std::mem::take(&mut self.due) {
            self.read()
        } else {
            Vec::new()
        }
    }

    /// Reads the files, which may have changed.
    pub(crate) fn read(&self) -> Vec<Effect> {
        let asked = self.asked.iter().cloned();
        asked.map(Effect::ReadAssets).collect()
    }

    /// Takes files that were read, unless others have been requested since.
    pub(crate) fn take(&mut self, wanted: &Wanted, mut loaded: Loaded) -> Option<News> {
        if self.asked.as_ref() != Some(wanted) {
            return None;
        }
        let is_first = std::mem::take(&mut self.awaited);
        let meshes = self.loaded.meshes != loaded.meshes;
        let images = self.loaded.images != loaded.images;
        let unreadable = self.loaded.meshes.unreadable() + loaded.meshes.unreadable();
        let faults =
            self.loaded.picture_errors != loaded.picture_errors || meshes && 0 < unreadable;
        // Files that are used no longer, or again, have not changed.
        let is_other = !is_first && self.differ(wanted, &loaded);
        let reloaded = is_other.then_some(Notice::Reloaded);
        let elsewhere = self.found_elsewhere(std::mem::take(&mut loaded.elsewhere));
        let notice = match elsewhere {
            _ if faults => Some(Notice::Faults),
            Some(words) => Some(Notice::Elsewhere(words)),
            None => reloaded,
        };
        self.loaded = loaded;
        let meaning = meshes || faults;
        if images || meaning {
            self.changes += 1;
        }
        Some(News {
            images,
            meaning,
            notice,
        })
    }

    /// Whether a file that was read before has other contents now.
    fn differ(&self, wanted: &Wanted, loaded: &Loaded) -> bool {
        let is_other_picture = |name: &String| {
            let read = self.loaded.images.get(name).zip(loaded.images.get(name));
            read.is_some_and(|(old, new)| old != new)
        };
        let is_other_mesh = |name: &String| {
            let read = self.loaded.meshes.get(name).zip(loaded.meshes.get(name));
            read.is_some_and(|read| !matches!(read, (Ok(old), Ok(new)) if Arc::ptr_eq(old, new)))
        };
        wanted.pictures.iter().any(is_other_picture) || wanted.meshes.iter().any(is_other_mesh)
    }

    fn found_elsewhere(&mut self, found: BTreeMap<String, PathBuf>) -> Option<String> {
        let announced = &self.elsewhere;
        let mut new = found
            .iter()
            .filter(|(name, place)| announced.get(*name) != Some(place));
        let (name, place) = new.next()?;
        let more = match new.count() {
            0 => String::new(),
            count => format!(" (and {} from elsewhere)", counted(count, "more file")),
        };
        let words = format!("{name} is read from {}{more}", place.display());
        self.elsewhere.extend(found);
        Some(words)
    }

    /// Whether files cannot be read.
    pub(crate) fn have_faults(&self) -> bool {
        0 < self.count_faults()
    }

    /// The warning that counts the unreadable files, if there are any; `errors` lists the reasons.
    pub(crate) fn faults(&self, errors: &str) -> Option<String> {
        let files = counted(self.count_faults(), "file");
        let words = format!("cannot read {files}: press {errors} to see why");
        self.have_faults().then_some(words)
    }

    fn count_faults(&self) -> usize {
        self.loaded.meshes.unreadable() + self.loaded.picture_errors.len()
    }
}
