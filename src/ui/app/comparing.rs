//! Comparing pictures: pins and loads a reference, traces what corresponds to it, and looks at both.

use std::path::PathBuf;
use std::sync::Arc;

use super::compared::{LIGHT, Origin, Reference, Wipe};
use super::contrast::Contrast;
use super::{Cross, Shared};
use crate::image_file::ImageFormat;
use crate::render::{Aov, Frame, Frames, Job, Settings};
use crate::scene::{Camera, Images, Rendering, Scene, Size};
use crate::text::Severity;
use crate::ui::keymap::{Context, Mode};
use crate::ui::msg::{Effect, Target};
use crate::ui::reference::{ReferenceId, ReferenceRead, ReferenceSource};

impl Shared {
    /// Makes the picture on screen the reference.
    pub(super) fn pin(&mut self) -> Vec<Effect> {
        let pinned = match self.pinned() {
            Ok(pinned) => pinned,
            Err(reason) => {
                self.overlays.warn(reason);
                return Vec::new();
            }
        };
        let size = pinned.frame.as_ref().map_or_else(String::new, |frame| {
            format!(", {}×{}", frame.size.width, frame.size.height)
        });
        let how = self.keymap.key(self.context(), "compare");
        let how = how.unwrap_or_else(|| ":compare".to_owned());
        let name = &pinned.name;
        self.overlays
            .say(format!("pinned the {name}{size}; {how} compares with it"));
        self.refer(pinned)
    }

    /// The picture on screen as a reference, or the reason why it cannot be one.
    fn pinned(&self) -> Result<Reference, String> {
        if self.wireframe().is_some() {
            let light = self.key_for("show-light");
            return Err(format!(
                "a wireframe cannot be pinned: {light} shows a picture"
            ));
        }
        let picture = self.picture();
        let frame = match self.mode {
            Mode::Compare => self.compared.live(),
            _ => picture.latest.as_ref(),
        };
        let is_whole = |frame: &&Arc<Frame>| {
            1 <= frame.progress.spp && picture.wanted == Some(frame.generation)
        };
        let untraced = || "cannot pin the picture: it is still being traced".to_owned();
        let frame = frame.filter(is_whole).ok_or_else(untraced)?;
        if frame.whole() != frame.size {
            return Err("only a whole picture can be pinned, not a part of it".to_owned());
        }
        let spp = frame.progress.spp;
        let grid = self.pictures.grid;
        let (kind, origin) = match (self.mode, &self.compared.reference) {
            (Mode::Compare, Some(reference)) => match &reference.origin {
                Origin::Preview(halves, grid, _, output) => {
                    ("preview", Origin::Preview(*halves, *grid, spp, *output))
                }
                _ => ("trace", Origin::Traced(spp)),
            },
            (Mode::Trace | Mode::Compare, _) => ("trace", Origin::Traced(spp)),
            _ => {
                let screen = self.preview_screen();
                let screen = screen.filter(|screen| grid.size(screen.halves) == frame.size);
                let halves = screen.ok_or_else(untraced)?.halves;
                ("preview", Origin::Preview(halves, grid, spp, self.output()))
            }
        };
        let shows = shown(self.pictures.aov);
        Ok(Reference {
            name: format!("{kind}, {shows}, {spp} spp"),
            shows: Some(shows),
            origin,
            frame: Some(Arc::clone(frame)),
        })
    }

    fn refer(&mut self, reference: Reference) -> Vec<Effect> {
        let former = self.compared.refer(reference);
        let free = former.map(|former| Effect::Free(Arc::new(former)));
        free.into_iter().collect()
    }

    /// Compares with something else, or with the reference; SEQUENCE is left first for that.
    pub(super) fn compare_command(&mut self, words: Option<PathBuf>) -> Vec<Effect> {
        if words.is_some() {
            return self.compare_with(words);
        }
        let mode = self.step_outside();
        let effects = self.compare_with(None);
        self.return_if_failed(mode);
        effects
    }

    /// Compares with the reference, or reads another one first, for `:compare`.
    pub(super) fn compare_with(&mut self, words: Option<PathBuf>) -> Vec<Effect> {
        let Some(path) = words else {
            return self.go(Mode::Compare);
        };
        let line = path.to_string_lossy().into_owned();
        let (first, rest) = line.split_once(' ').unwrap_or((&line, ""));
        let revision = match (first, rest.trim()) {
            ("git", "") => Some("HEAD"),
            ("git", revision) => Some(revision),
            (revision, "") if is_head(revision) => Some(revision),
            _ => None,
        };
        let is_own = revision.is_some() || line == "saved";
        let own = self.disk.path.clone();
        let (name, source) = match (revision, own) {
            (_, None) if is_own => {
                self.overlays.fail("the scene has no file yet: :w FILE");
                return Vec::new();
            }
            // Git would take it for an option.
            (Some(revision), _) if revision.starts_with('-') => {
                self.overlays.fail(format!("{revision} is not a revision"));
                return Vec::new();
            }
            (Some(revision), Some(own)) => (
                format!("{} in {revision}", self.disk.name()),
                ReferenceSource::Revision(revision.to_owned(), own),
            ),
            (None, Some(own)) if is_own => (
                format!("{} as saved", self.disk.name()),
                ReferenceSource::File(own),
            ),
            (None, _) => (line, ReferenceSource::File(path)),
            (Some(_), None) => return Vec::new(),
        };
        let id = self.compared.ask(name);
        vec![Effect::ReadReference(id, source)]
    }

    /// Takes a reference that was read, and compares with it unless the user does something else. One
    /// that cannot be compared leaves the one before.
    pub(super) fn reference_read(
        &mut self,
        id: ReferenceId,
        read: Result<ReferenceRead, String>,
    ) -> Vec<Effect> {
        let Some(name) = self.compared.answered(id) else {
            return vec![Effect::Free(Arc::new(read))];
        };
        let reference = match read {
            Ok(read) => Reference::read(name, read),
            Err(reason) => {
                self.overlays.fail(reason);
                return Vec::new();
            }
        };
        let is_early = self.assets.are_awaited();
        if let Err(reason) = self.comparison_jobs(&reference)
            && !is_early
        {
            self.refuse_picture(Severity::Error, &reason);
            return vec![Effect::Free(Arc::new(reference))];
        }
        let is_free = matches!(self.context(), Context::In(mode) if mode != Mode::Move)
            && self.typed_line().is_none();
        let name = reference.name.clone();
        let how = match (&reference.origin, &reference.frame) {
            (Origin::File(made), Some(frame)) => self.grading(&name, made, frame.size),
            _ => String::new(),
        };
        let mut effects = self.refer(reference);
        if is_early {
            let words = format!(":compare compares with {name} once the scene's files are read");
            self.overlays.say(words);
        } else if !is_free {
            self.overlays.say(format!(":compare compares with {name}"));
        } else if self.mode != Mode::Compare {
            self.leave_sequence();
            effects.extend(self.go(Mode::Compare));
        }
        if !how.is_empty() {
            self.overlays.say(how);
        }
        effects
    }

    /// Starts to compare, or stops.
    pub(super) fn start_comparison(&mut self) -> Vec<Effect> {
        if self.mode == Mode::Compare {
            self.end_comparison();
            return Vec::new();
        }
        if let Err(reason) = self.comparison() {
            self.refuse_picture(Severity::Error, &reason);
            return Vec::new();
        }
        self.compared.before = Some(self.mode);
        self.mode = Mode::Compare;
        self.compared.due = true;
        let own = self.output();
        let pinned = self.compared.pinned_size();
        if let Some(size) = pinned.filter(|size| *size != own) {
            let [theirs, own] =
                [size, own].map(|Size { width, height }| format!("{width}×{height}"));
            self.overlays.say(format!(
                "traced at {theirs}, the size of the pinned picture; the scene's own is {own}"
            ));
        }
        Vec::new()
    }

    /// Returns to the mode before the comparison.
    pub(super) fn end_comparison(&mut self) {
        self.mode = self.compared.before.take().unwrap_or(Mode::Select);
    }

    /// Traces what is compared if it is not up to date, and nothing outside of [`Mode::Compare`].
    pub(super) fn follow_comparison(&mut self, has_changed: bool) -> Vec<Effect> {
        if self.seen() != Target::Compared {
            return if self.compared.end() {
                vec![
                    Effect::Stop(Target::Compared),
                    Effect::Stop(Target::Reference),
                ]
            } else {
                Vec::new()
            };
        }
        self.compared.inspect(self.mode == Mode::Inspect);
        if !std::mem::take(&mut self.compared.due) && !has_changed {
            return self.measure();
        }
        match self.comparison() {
            Ok((live, reference)) => {
                self.compared.begin();
                let other = match reference {
                    Some(job) => Effect::Trace(Target::Reference, job),
                    None => Effect::Stop(Target::Reference),
                };
                vec![Effect::Trace(Target::Compared, live), other]
            }
            Err(reason) => {
                self.refuse_picture(Severity::Error, &reason);
                self.end_comparison();
                self.follow_comparison(has_changed)
            }
        }
    }

    fn measure(&mut self) -> Vec<Effect> {
        let pair = self.compared.next_to_measure();
        pair.map(Effect::Compare).into_iter().collect()
    }

    /// What to trace of the present scene, and of its reference if that is a scene.
    fn comparison(&self) -> Result<(Job, Option<Job>), String> {
        let reference = self.compared.reference.as_ref().ok_or_else(|| {
            let pin = self.key_for("pin");
            format!("nothing to compare with: {pin} pins the picture, :compare FILE loads one")
        })?;
        self.comparison_jobs(reference)
    }

    /// What to trace of the present scene, and of a reference if that is a scene; the error says why
    /// they cannot be compared.
    fn comparison_jobs(&self, reference: &Reference) -> Result<(Job, Option<Job>), String> {
        let (size, spp) = match (&reference.origin, &reference.frame) {
            (&Origin::Preview(halves, grid, spp, size), _) => {
                let job = self.shown_job(grid.size(halves), spp);
                let job = job.ok_or_else(|| self.no_picture())?;
                let camera = Camera { size, ..job.camera };
                return Ok((Job { camera, ..job }, None));
            }
            (Origin::File(made), Some(frame)) => {
                return Ok((self.graded_job(made, frame.size)?, None));
            }
            (Origin::Traced(spp), Some(frame)) => (frame.size, *spp),
            _ => (self.output(), self.rendering().spp()),
        };
        if let Some(reason) = ImageFormat::Bmp.refuses(size) {
            return Err(reason);
        }
        let live = self.final_job(size, spp)?;
        // As exports of this size are framed.
        let camera = Camera {
            size,
            ..live.camera
        };
        let live = Job { camera, ..live };
        let other = match &reference.origin {
            Origin::Scene(scene, images, _) => Some(self.reference_job(scene, images, &live)),
            Origin::Preview(..) | Origin::Traced(_) | Origin::File(_) => None,
        };
        Ok((live, other))
    }

    /// What to trace of a scene that is compared with the present one: the same, except for what the
    /// scene itself says.
    fn reference_job(&self, scene: &Arc<Scene>, images: &Images, live: &Job) -> Job {
        let rendering = Rendering {
            spp: Some(live.settings.spp),
            ..self.pictures.rendering(Some(scene))
        };
        let camera = self.pictures.view.unwrap_or(scene.camera);
        Job {
            scene: Arc::clone(scene),
            images: images.clone(),
            camera: Camera {
                size: live.settings.size,
                ..camera
            },
            settings: Settings {
                aov: live.settings.aov,
                ..Settings::new(live.settings.size, &rendering)
            },
            limit: None,
            frames: Frames::Live,
            denoise: false,
            numbers: None,
        }
    }

    /// What is unlike about the two pictures, if they show different things: `light against depth`.
    pub fn compares_unlike(&self) -> Option<String> {
        let reference = self.compared.reference.as_ref()?;
        let shows = reference.shows?;
        let aov = match &reference.origin {
            Origin::File(made) => self.graded_aov(made),
            _ => self.pictures.aov,
        };
        let live = shown(aov);
        (live != shows).then(|| format!("{live} against {shows}"))
    }

    /// Shows the two pictures in another way.
    pub(super) fn contrast(&mut self, view: Contrast) {
        self.compared.look(view, self.compared.wipe);
    }

    /// Moves the line of the wipe by some cells to the right.
    pub(super) fn slide_wipe(&mut self, cells: i16) {
        let Some(((area, halves), frame_window)) = self.raster().zip(self.frame_window()) else {
            return;
        };
        // The cells across the whole picture.
        let width = f64::from(area.width) * frame_window.magnification(halves);
        let column = (self.compared.wipe.0 * width).round() + f64::from(cells);
        let wipe = Wipe(column.clamp(0.0, width) / width);
        self.compared.look(Contrast::Wipe, wipe);
    }

    /// Points at one of the worst pixels.
    pub(super) fn go_to_worst(&mut self, step: isize) {
        if let Err(reason) = self.compared.go_to_worst(step) {
            self.overlays.say(reason);
        } else if let Some(place) = self.cross_on_screen() {
            self.centre_on(place);
        }
    }

    /// Explains the pixel of the present picture that is pointed at, otherwise the worst one.
    pub(super) fn explain_compared(&mut self) {
        if self.compared.cross.is_none() {
            self.go_to_worst(1);
        }
        let place = self.compared.live().map(|live| (live.corner, live.whole()));
        if let Some(((x, y), ([left, top], size))) = self.compared.cross.zip(place) {
            self.compared.inspect(true);
            self.explain_at(Cross {
                pixel: [left + x, top + y],
                size,
            });
        }
    }

    /// Where the pixel that is pointed at is on screen, in half blocks from the picture's upper left
    /// corner.
    pub fn cross_on_screen(&self) -> Option<[f64; 2]> {
        let here = self.compared.at_cross()?;
        let size = self.compared.pair()?.size()?;
        let (_, halves) = self.raster()?;
        let scaled = |at: u32, pixels: u32, shown: u32| {
            (f64::from(at) + 0.5) / f64::from(pixels) * f64::from(shown)
        };
        let place = [
            scaled(here.x, size.width, halves.width),
            scaled(here.y, size.height, halves.height),
        ];
        Some(self.frame_window()?.on_screen(place, halves))
    }

    /// Where the line of the wipe is on screen, in half blocks from the picture's left edge, if it is
    /// seen.
    pub fn wipe_on_screen(&self) -> Option<f64> {
        let (_, halves) = self.raster()?;
        let at = self.compared.wipe.0 * f64::from(halves.width);
        let [column, _] = self.frame_window()?.on_screen([at, 0.0], halves);
        (self.compared.view == Contrast::Wipe).then_some(column)
    }

    /// Moves the line of the wipe to a cell of the screen; in other views, points at the pixel there.
    pub(super) fn press_comparison(&mut self, at: (u16, u16)) {
        let Some((cells, _)) = self.raster().filter(|(cells, _)| cells.contains(at.into())) else {
            return;
        };
        let cell = (at.0 - cells.x, at.1 - cells.y);
        let Some([x, y]) = self.pixel_at(cell) else {
            return;
        };
        let seen = self.compared.seen.latest.as_ref();
        match (self.compared.view, seen) {
            (Contrast::Wipe, Some(seen)) => {
                let wipe = Wipe(f64::from(x) / f64::from(seen.size.width));
                self.compared.look(Contrast::Wipe, wipe);
            }
            _ => self.compared.cross = Some((x, y)),
        }
    }
}

/// What a picture shows, in a word.
fn shown(aov: Option<Aov>) -> &'static str {
    aov.map_or(LIGHT, Aov::name)
}

/// Whether these are words of git for the newest commit or one before it.
fn is_head(word: &str) -> bool {
    let rest = word.strip_prefix("HEAD");
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['~', '^', '@']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn revisions_before_the_newest_are_recognised() {
        for (word, is) in [
            ("HEAD", true),
            ("HEAD~3", true),
            ("HEAD^", true),
            ("HEAD@{1}", true),
            ("HEADS.ppm", false),
            ("a.ray", false),
        ] {
            assert_eq!(is_head(word), is, "{word}");
        }
    }
}
