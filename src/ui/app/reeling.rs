//! Exporting the track that is played, all frames of it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::jobs::{Asking, ExportWork, Pending};
use super::{App, Export, Stage};
use crate::image_file::{DEFAULT_RATE, ImageFormat};
use crate::scene::Size;
use crate::ui::keymap::{Context, Mode};
use crate::ui::msg::{Destination, Effect, ExportId};
use crate::ui::reel::{Reel, ReelForm, ReelProgress, Shot};

impl App {
    /// The scene's path with the extension of a file that holds a sequence.
    fn reel_path(&self) -> PathBuf {
        self.export_path().with_extension("gif")
    }

    /// Exports the sequence that is played, after the exports that were started before.
    pub(super) fn export_sequence(
        &mut self,
        path: Option<PathBuf>,
        size: Option<Size>,
        spp: Option<u32>,
        asking: Asking,
    ) -> Vec<Effect> {
        let path = path.unwrap_or_else(|| self.reel_path());
        let wanted = size.unwrap_or_else(|| self.output());
        let reel = self.form_of(&path, wanted).and_then(|form| {
            let shot = Shot {
                rendering: self.pictures.rendering,
                aov: self.pictures.aov,
                view: self.pictures.view,
                size,
                spp,
            };
            self.reel(form, shot)
        });
        let reel = match reel {
            Ok(reel) => reel,
            Err(reason) => {
                self.overlays.fail(reason);
                return Vec::new();
            }
        };
        let track = self.sequence.open.as_ref().map(|open| open.path.clone());
        let samples = spp.unwrap_or_else(|| self.rendering().spp());
        let export = Export {
            id: self.jobs.next_export(),
            stage: Stage::Tracing,
            destination: Destination {
                path: path.clone(),
                existing: asking.existing(),
                scene: self.disk.path.clone(),
                named: self.assets.files().iter().cloned().chain(track).collect(),
                origin: None,
            },
            size: wanted,
            spp: self.pictures.samples(samples),
            aov: self.pictures.aov,
            frames: Some(reel.track.frames),
            reel: None,
            progress: None,
            written_for: 0,
        };
        self.announce_export(export.aov, &path);
        self.begin_or_queue(Pending {
            export,
            making: ExportWork::Film(Box::new(reel)),
            asking,
        })
    }

    /// What a sequence of pictures of this size is written as, or why it cannot be.
    fn form_of(&self, path: &Path, size: Size) -> Result<ReelForm, String> {
        let form = ReelForm::of_path(path).map_err(|reason| {
            let keep = self.keymap.key(Context::In(Mode::Sequence), "accept");
            let keep = keep.map_or_else(String::new, |key| {
                format!("; to export this frame alone, press {key} first")
            });
            format!("{reason}{keep}")
        })?;
        let rate = self.sequence.open.as_ref().and_then(|open| open.track.rate);
        let refused = match &form {
            ReelForm::Movie(format) => format
                .refuses(rate.unwrap_or(DEFAULT_RATE))
                .or_else(|| ImageFormat::Gif.refuses(size)),
            ReelForm::Pictures(_, format) => format.refuses(size),
        };
        refused.map_or(Ok(form), Err)
    }

    /// The sequence that is played, with the text as it is without a frame.
    fn reel(&mut self, form: ReelForm, shot: Shot) -> Result<Reel, String> {
        if self.assets.are_awaited() {
            return Err(self.no_picture());
        }
        let open = self.sequence.open.as_ref().ok_or("no track is open")?;
        if open.is_refused {
            return Err(format!(
                "{} cannot be played as it is on disk: correct it first",
                open.name()
            ));
        }
        if open.held.is_none() {
            return Err(format!("nothing to export yet: {}", self.how_to_key(open)));
        }
        let track = open.track.clone();
        self.suspend_frame();
        let text = self.document.shared_text();
        self.resume_frame();
        Ok(Reel {
            language: self.document.language(),
            text,
            scene: self.disk.path.clone().unwrap_or_default(),
            track,
            form,
            shot,
            written: HashMap::new(),
        })
    }

    /// Takes how far the export of a sequence is.
    pub(super) fn filmed(&mut self, id: ExportId, progress: ReelProgress) {
        let running = self.jobs.export.as_mut();
        if let Some(export) = running.filter(|export| export.id == id) {
            export.reel = Some(progress);
        }
    }
}

/// Why a picture of this name cannot be exported outside of SEQUENCE mode, if it names a sequence.
pub(super) fn names_sequence(path: &Path, play: &str) -> Option<String> {
    let is_gif = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("gif"));
    let form = ReelForm::of_path(path).ok()?;
    let is_pattern = matches!(form, ReelForm::Pictures(..));
    (is_pattern || !is_gif).then(|| {
        format!(
            "{} names a sequence: press {play}, then :export",
            path.display()
        )
    })
}
