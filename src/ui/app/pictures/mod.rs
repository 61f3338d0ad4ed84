//! The pictures on screen, the preview, the full-size trace and what is compared: what they show, and from
//! where.

pub(crate) mod cell_image;
pub(crate) mod frame_window;
pub(crate) mod histogram;
pub(crate) mod picture;
pub(crate) mod region;
pub(crate) mod saved_setting;
pub(crate) mod solo;
pub(crate) mod until;
pub(crate) mod viewport;
pub(crate) mod wireframe;

use std::sync::Arc;

use frame_window::Grid;
use histogram::ShownHistogram;
use picture::Picture;
use region::Drawing;
use saved_setting::SavedSetting;
use solo::Solo;
use until::Until;
use wireframe::ShownWireframe;

use crate::keymap::Mode;
use crate::msg::Target;
use document::StateId;
use render::{Aov, Display, Frame, Region};
use scene::{Camera, Integrator, Rendering, Scene, Size};

/// The pictures on screen, what they show and how: the preview, the full-size trace, and what is compared.
#[derive(Debug, Default)]
pub struct Pictures {
    /// The preview beside the list, restarted at each change.
    pub preview: Picture,
    /// The full-size trace, once requested.
    pub trace: Option<Picture>,
    /// The working view, if it differs from the scene's camera.
    pub view: Option<Camera>,
    /// The user's render settings, which take precedence over the scene's.
    pub rendering: Rendering,
    /// Those of them that the program was started with, for any scene.
    asked: Rendering,
    /// The settings that were written into the text.
    pub(crate) written: Vec<SavedSetting>,
    /// Pixels in each cell.
    pub grid: Grid,
    /// What traced pictures show instead of light.
    pub aov: Option<Aov>,
    /// How light is displayed.
    pub display: Display,
    /// The histogram, if it is shown.
    pub histogram: Option<ShownHistogram>,
    /// The wireframe, if it is shown instead of the preview.
    pub wireframe: Option<ShownWireframe>,
    /// Whether the selected object is outlined in SELECT mode.
    pub(crate) outline: Outline,
    /// Which symbols are shown of what has no surface.
    pub(crate) symbols: Symbols,
    /// Bytes sent to the terminal during the last second, while a picture waits for a slow link.
    pub net: Option<usize>,
    /// Whether the pictures must be traced again.
    pub(crate) due: bool,
    /// Whether that was found in this step, so that everything traced from the scene starts again.
    pub(crate) has_changed: bool,
    /// What the preview shows alone.
    pub solo: Option<Solo>,
    /// The only part of the picture that the full-size trace traces, if not all of it.
    pub(crate) region: Option<Region>,
    /// A region that is being drawn.
    pub(crate) drawing: Option<Drawing>,
    /// When the full-size trace is complete, if not with the samples of exports.
    pub(crate) until: Option<Until>,
    /// Whether an earlier run left more samples of the full-size trace than it is to have.
    pub(crate) more_kept: bool,
    /// The pointer's cell when the camera or a thing was last dragged.
    pub(crate) drag: Option<(u16, u16)>,
    /// The mode to return to from the full-size trace.
    pub(crate) before_trace: Option<Mode>,
    /// The pictures that are compared, as seen.
    pub compared: Picture,
    /// The size of what is compared, whose aspect ratio it has on screen; `None` if that is the scene's own.
    pub(crate) compared_size: Option<Size>,
    /// The mode to return to from a comparison.
    pub(crate) before_comparison: Option<Mode>,
}

/// Whether the selected object is outlined in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Outline {
    /// Not yet: the user has selected nothing.
    #[default]
    Unasked,
    /// It is outlined in SELECT and MOVE mode.
    Shown,
    /// It is never outlined.
    Hidden,
}

/// Which symbols are shown of what has no surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Symbols {
    /// The symbols of the selected kind.
    #[default]
    Selected,
    /// All.
    All,
}

impl Pictures {
    /// Creates the state without any picture.
    pub(crate) fn new(rendering: Rendering) -> Self {
        Self {
            rendering,
            asked: rendering,
            ..Self::default()
        }
    }

    /// Forgets the scene's pictures, its view, and what was set while it was seen; what pictures show, the
    /// render settings that the program was started with, and the grid stay.
    pub(crate) fn renew(&mut self) {
        *self = Self {
            grid: self.grid,
            aov: self.aov.filter(|aov| !matches!(aov, Aov::Direct(_))),
            display: self.display,
            histogram: self.histogram.take().map(|_| ShownHistogram::default()),
            wireframe: self.wireframe.take().map(|_| ShownWireframe::default()),
            outline: self.outline,
            symbols: self.symbols,
            net: self.net,
            ..Self::new(self.asked)
        };
    }

    /// The picture on screen.
    pub fn seen(&self, target: Target) -> &Picture {
        match (target, &self.trace) {
            (Target::Trace, Some(trace)) => trace,
            (Target::Compared, _) => &self.compared,
            _ => &self.preview,
        }
    }

    /// The picture on screen, mutable in order to advance it.
    pub(crate) fn seen_mut(&mut self, target: Target) -> &mut Picture {
        match (target, &mut self.trace) {
            (Target::Trace, Some(trace)) => trace,
            (Target::Compared, _) => &mut self.compared,
            _ => &mut self.preview,
        }
    }

    /// Whether a sample of the preview or the trace is still to be taken, without being told to.
    pub fn are_awaited(&self) -> bool {
        let goes_on = |trace: &Picture| trace.is_awaited() && !trace.paused;
        self.preview.is_awaited() || self.trace.as_ref().is_some_and(goes_on)
    }

    /// The picture that receives a target's frames.
    fn of(&mut self, target: Target) -> Option<&mut Picture> {
        match target {
            Target::Preview => Some(&mut self.preview),
            Target::Trace => self.trace.as_mut(),
            Target::Export
            | Target::Thumbnail
            | Target::Trial
            | Target::Compared
            | Target::Reference => None,
        }
    }

    /// Records the generation of a new picture, or `None` if the picture will not be finished.
    pub(crate) fn want(&mut self, target: Target, generation: Option<u64>) {
        if let Some(picture) = self.of(target) {
            picture.wanted = generation;
        }
    }

    pub(crate) fn take(&mut self, target: Target, frame: Arc<Frame>) {
        if let Some(picture) = self.of(target)
            // Otherwise it is of a scene that was left.
            && (picture.latest.is_some() || picture.wanted.is_none_or(|wanted| wanted <= frame.generation))
        {
            picture.take(frame);
        }
    }

    /// When the full-size trace of a scene is complete.
    pub(crate) fn until(&self, scene: Option<&Scene>) -> Until {
        let samples = || Until::Samples(self.rendering(scene).spp());
        self.until.unwrap_or_else(samples)
    }

    /// Whether the full-size trace was started and has not been stopped.
    pub(crate) fn is_tracing(&self) -> bool {
        let trace = self.trace.as_ref();
        trace.is_some_and(|trace| trace.wanted.is_some())
    }

    pub(crate) fn toggle_outline(&mut self) {
        self.outline = match self.outline {
            Outline::Shown => Outline::Hidden,
            Outline::Hidden | Outline::Unasked => Outline::Shown,
        };
    }

    /// Outlines what is selected from now on, unless the user has switched that off.
    pub(crate) fn outline_selection(&mut self) {
        if self.outline == Outline::Unasked {
            self.outline = Outline::Shown;
        }
    }

    /// The camera in use: the working view, otherwise the scene's own.
    pub(crate) fn camera(&self, own: Option<Camera>) -> Option<Camera> {
        self.view.or(own)
    }

    /// Sets the working view, or drops it if it equals the scene's own camera.
    pub(crate) fn set_view(&mut self, camera: Camera, own: Option<Camera>) {
        let view = Some(camera).filter(|camera| Some(*camera) != own);
        self.due |= view != self.view;
        self.view = view;
    }

    /// Returns to the scene's own view.
    pub(crate) fn reset_view(&mut self) {
        self.due |= self.view.take().is_some();
    }

    /// Adapts to the new scene; returns whether it differs from the one before.
    pub(crate) fn follow(&mut self, before: Option<&Scene>, scene: &Scene) -> bool {
        if let Some(view) = &mut self.view {
            view.size = scene.camera.size;
        }
        if self.view == Some(scene.camera) {
            self.view = None;
        }
        if before.is_some_and(|before| before.objects.len() != scene.objects.len()) {
            self.preview.forget_objects();
        }
        let is_new = before != Some(scene);
        if let Some(Aov::Direct(light)) = self.aov
            && scene.lights.len() <= light as usize
        {
            self.aov = None;
        }
        self.due |= is_new;
        is_new
    }

    /// The render settings for a scene: the user's, completed by its own.
    pub(crate) fn rendering(&self, scene: Option<&Scene>) -> Rendering {
        let own = scene.map(|scene| scene.setting.rendering);
        self.rendering.or(own.unwrap_or_default())
    }

    /// Crosses the step to a text: if it wrote a setting, swaps what takes precedence over that setting for
    /// what did on the other side of the step.
    pub(crate) fn cross(&mut self, state: StateId) {
        let mut written = self.written.iter_mut();
        if let Some(written) = written.find(|written| written.state == state) {
            let rendering = written.cross(&self.rendering);
            self.due |= rendering != self.rendering;
            self.rendering = rendering;
        }
    }

    /// Switches all pictures to the next integrator and returns its name. Switching to the scene's own
    /// integrator follows the scene again.
    pub(crate) fn next_integrator(&mut self, scene: Option<&Scene>) -> &'static str {
        let (next, words) = match self.rendering(scene).integrator() {
            Integrator::Whitted => (Integrator::Path, "path tracing"),
            Integrator::Path => (Integrator::Photon, "path tracing with photons"),
            Integrator::Photon => (Integrator::Whitted, "Whitted ray tracing"),
        };
        self.rendering.integrator = None;
        if self.rendering(scene).integrator() != next {
            self.rendering.integrator = Some(next);
        }
        self.due = true;
        words
    }

    /// Selects what all pictures show, light or an AOV, and returns its description.
    pub(crate) fn show(&mut self, aov: Option<Aov>) -> &'static str {
        self.due |= self.wireframe.take().is_some() || self.aov != aov;
        self.aov = aov;
        match aov {
            None => "light",
            Some(Aov::Depth) => "depth: nearest white, farthest black",
            Some(Aov::Normal) => "normals: -1 to 1 as 0 to 255",
            Some(Aov::Object) => "objects: one colour each",
            Some(Aov::Albedo) => "albedo: unlit colours",
            Some(Aov::Uv) => "texture coordinates: u red, v green",
            Some(Aov::Side) => "sides: front blue, back orange",
            Some(Aov::Cost) => "cost: rays traced for a sample, few dark, many bright",
            Some(Aov::Samples) => "samples taken: few dark, many bright",
            Some(Aov::Noise) => "noise: estimated error of the light, small dark, large bright",
            Some(Aov::Direct(_)) => "direct light of one light",
            Some(Aov::Emission) => "emission, ambient light and background alone",
            Some(Aov::Indirect) => "indirect light alone: by way of other surfaces",
        }
    }

    /// Shows the preview as a wireframe, and returns its description. Only the objects under its
    /// pixels are traced, because they can be picked.
    pub(crate) fn show_wireframe(&mut self) -> &'static str {
        self.due |= self.wireframe.is_none();
        self.aov = None;
        self.wireframe.get_or_insert_default();
        "wireframe: the objects' edges and curves"
    }

    /// What the preview traces instead of light.
    pub(crate) fn preview_aov(&self) -> Option<Aov> {
        self.wireframe.as_ref().map(|_| Aov::Object).or(self.aov)
    }

    /// The number of samples per pixel to take if `asked` are requested.
    pub(crate) fn samples(&self, asked: u32) -> u32 {
        self.aov.map_or(asked, |aov| aov.samples(asked))
    }
}
