//! The pictures of the scene's textures: which are wanted, and which have come.

use super::App;
use crate::assets::{self, Loaded, Troubles, Wanted};
use crate::scene::Images;
use crate::text::{Findings, counted};
use crate::ui::msg::Effect;

/// Said where a picture would lack what is still being read.
pub(super) const STILL_READING: &str = "the scene's textures are still being read";

/// How the pictures of the scene's textures stand.
#[derive(Debug, Default)]
pub(super) struct Textures {
    /// What was asked for last: the files of the last text that had no errors.
    asked: Option<Wanted>,
    /// It is yet to be asked for.
    due: bool,
    /// Among it are files of which nothing has come yet.
    awaited: bool,
    /// What is wrong with the files.
    troubles: Troubles,
}

impl App {
    /// Whether the scene's textures are yet to come.
    pub fn awaits_textures(&self) -> bool {
        self.textures.awaited
    }

    /// Adds what is wrong with the files that a text without errors names, and wants them.
    pub(super) fn with_files(&mut self, found: Findings) -> Findings {
        let (text, tree) = (self.document.text(), self.document.tree());
        let files = self.origins.files(text, tree);
        if found.errors() == 0 {
            let wanted = self.path.as_ref().filter(|_| !files.is_empty());
            self.want(wanted.map(|path| Wanted::new(path, &files)));
        }
        assets::report(&self.textures.troubles, &files, found)
    }

    fn want(&mut self, wanted: Option<Wanted>) {
        let textures = &mut self.textures;
        if textures.asked == wanted {
            return;
        }
        let is_known = match (&textures.asked, &wanted) {
            (Some(asked), Some(wanted)) => {
                asked.scene == wanted.scene && wanted.names.is_subset(&asked.names)
            }
            (None, Some(_)) => false,
            (_, None) => true,
        };
        // What was awaited and is still wanted goes on being awaited.
        textures.awaited = wanted.is_some() && (textures.awaited || !is_known);
        textures.due = wanted.is_some();
        if wanted.is_none() {
            self.images = Images::default();
            textures.troubles.clear();
        }
        textures.asked = wanted;
    }

    /// Has the textures read that are wanted since the last step.
    pub(super) fn follow_textures(&mut self) -> Vec<Effect> {
        if std::mem::take(&mut self.textures.due) {
            self.read_textures()
        } else {
            Vec::new()
        }
    }

    /// Has the textures read, which may have changed.
    pub(super) fn read_textures(&self) -> Vec<Effect> {
        let asked = self.textures.asked.iter().cloned();
        asked.map(Effect::ReadTextures).collect()
    }

    /// Takes what was read, unless something else is wanted by now.
    pub(super) fn textures_read(&mut self, wanted: &Wanted, loaded: Loaded) {
        if self.textures.asked.as_ref() != Some(wanted) {
            return;
        }
        let is_first = std::mem::take(&mut self.textures.awaited);
        if self.images != loaded.images {
            self.images = loaded.images;
            self.pending.scene = true;
            if !is_first {
                self.say("textures read again");
            }
        }
        if self.textures.troubles != loaded.troubles {
            self.textures.troubles = loaded.troubles;
            self.relower();
            match self.textures.troubles.len() {
                0 => self.say("all textures are there again"),
                count => {
                    let textures = counted(count, "texture");
                    self.warn(format!("{textures} can't be read: ! says why"));
                }
            }
        }
    }
}
