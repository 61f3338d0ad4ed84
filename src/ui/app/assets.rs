//! The files that the scene names, pictures and meshes: which are wanted, and which have come.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::App;
use crate::assets;
use crate::assets::{Loaded, Troubles, Wanted};
use crate::scene::{Images, Meshes};
use crate::text::{Findings, counted};
use crate::ui::msg::Effect;

/// Said where a picture would lack what is still being read.
pub(super) const STILL_READING: &str = "the scene's files are still being read";

/// How the files that the scene names stand.
#[derive(Debug, Default)]
pub(super) struct Assets {
    /// What was asked for last: the files of the last text that had no errors.
    asked: Option<Wanted>,
    /// It is yet to be asked for.
    due: bool,
    /// Among it are files of which nothing has come yet.
    awaited: bool,
    /// What is wrong with pictures; what is with meshes, the meshes say.
    troubles: Troubles,
    /// Where files were found that were looked for elsewhere first, by name: each was said.
    elsewhere: BTreeMap<String, PathBuf>,
    /// Where those that were read stand.
    files: Vec<PathBuf>,
}

impl App {
    /// Whether files that the scene names are yet to come.
    pub fn awaits_assets(&self) -> bool {
        self.assets.awaited
    }

    /// Adds what is wrong with the files that a text without errors names, and wants them.
    pub(super) fn with_files(&mut self, found: Findings) -> Findings {
        let files = self.source().files();
        if found.errors() == 0 {
            let wanted = self.path.as_ref().filter(|_| !files.is_empty());
            self.want(wanted.map(|path| Wanted::new(path, &files)));
        }
        assets::report(&self.assets.troubles, &files, found)
    }

    /// The files that the scene names, as far as they are read.
    pub(super) fn named_files(&self) -> &[PathBuf] {
        &self.assets.files
    }

    /// Whether nothing is known yet of a mesh that the scene names.
    pub(super) fn lacks_meshes(&self) -> bool {
        let is_missing = |name: &String| self.meshes.get(name).is_none();
        let asked = self.assets.asked.as_ref();
        asked.is_some_and(|asked| asked.meshes.iter().any(is_missing))
    }

    fn want(&mut self, wanted: Option<Wanted>) {
        let assets = &mut self.assets;
        if assets.asked == wanted {
            return;
        }
        let is_known = match (&assets.asked, &wanted) {
            (Some(asked), Some(wanted)) => wanted.is_among(asked),
            (None, Some(_)) => false,
            (_, None) => true,
        };
        // What was awaited and is still wanted goes on being awaited.
        assets.awaited = wanted.is_some() && (assets.awaited || !is_known);
        assets.due = wanted.is_some();
        if wanted.is_none() {
            self.images = Images::default();
            self.meshes = Meshes::default();
            assets.troubles.clear();
            assets.files.clear();
        }
        assets.asked = wanted;
    }

    /// Has the files read that are wanted since the last step.
    pub(super) fn follow_assets(&mut self) -> Vec<Effect> {
        if std::mem::take(&mut self.assets.due) {
            self.read_assets()
        } else {
            Vec::new()
        }
    }

    /// Has the files read, which may have changed.
    pub(super) fn read_assets(&self) -> Vec<Effect> {
        let asked = self.assets.asked.iter().cloned();
        asked.map(Effect::ReadAssets).collect()
    }

    /// Takes what was read, unless something else is wanted by now.
    pub(super) fn assets_read(&mut self, wanted: &Wanted, loaded: Loaded) {
        if self.assets.asked.as_ref() != Some(wanted) {
            return;
        }
        let is_first = std::mem::take(&mut self.assets.awaited);
        let are_meshes_new = self.meshes != loaded.meshes;
        let are_faults_new = self.assets.troubles != loaded.troubles
            || are_meshes_new && 0 < self.meshes.unreadable() + loaded.meshes.unreadable();
        let are_images_new = self.images != loaded.images;
        self.images = loaded.images;
        self.pending.scene |= are_images_new;
        self.meshes = loaded.meshes;
        self.assets.troubles = loaded.troubles;
        self.assets.files = loaded.files;
        if are_meshes_new || are_faults_new {
            // Meshes may name pictures, which are wanted then.
            self.relower();
        }
        let found = self.found_elsewhere(loaded.elsewhere);
        if are_faults_new {
            self.tell_of_files();
        } else if let Some(words) = found {
            self.say(words);
        } else if !is_first && (are_meshes_new || are_images_new) {
            self.say("files reloaded");
        }
    }

    /// The notice about files found elsewhere than first looked for.
    fn found_elsewhere(&mut self, found: BTreeMap<String, PathBuf>) -> Option<String> {
        let said = &self.assets.elsewhere;
        let mut new = found
            .iter()
            .filter(|(name, place)| said.get(*name) != Some(place));
        let (name, place) = new.next()?;
        let more = match new.count() {
            0 => String::new(),
            count => format!(" (and {} from elsewhere)", counted(count, "more file")),
        };
        let words = format!("{name} is read from {}{more}", place.display());
        self.assets.elsewhere.extend(found);
        Some(words)
    }

    fn tell_of_files(&mut self) {
        let meshes = self.meshes.unreadable();
        match meshes + self.assets.troubles.len() {
            0 => self.say("all files can be read now"),
            count => {
                let words = format!("{} can't be read: ! shows why", counted(count, "file"));
                if meshes == 0 {
                    self.warn(words);
                } else {
                    self.fail(words);
                }
            }
        }
    }
}
