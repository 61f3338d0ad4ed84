//! Input and output of a renderer: jobs and frames.

use std::sync::{Arc, Weak};
use std::time::Duration;

use super::overexposure::Overexposure;
use super::photons::{PhotonRules, Photons};
use super::region::Region;
use super::world::{Rules, World};
use crate::scene::{self, Camera, Images, Integrator, Rendering, Scene, Size, render_settings};

/// Marks a pixel without an object in [`Frame::objects`].
pub const NO_OBJECT: u32 = u32::MAX;

macro_rules! settings {
    ($($(#[$doc:meta])* $key:ident: $type:ty = $default:expr, $setting:expr;)+) => {
        /// Render settings; with scene, images and camera they determine every pixel.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Settings {
            /// Resolution of the whole picture; does not affect the framing.
            pub size: Size,
            /// The only part of the picture to trace, if not all of it. Its pixels are the same as in
            /// the whole picture, except that the 8-bit values of depth span the distances in the
            /// region.
            pub region: Option<Region>,
            /// Random seed.
            pub seed: u32,
            /// The AOV to render instead of light.
            pub aov: Option<Aov>,
            $($(#[$doc])* pub $key: $type,)+
        }

        impl Settings {
            /// Those of a whole picture of light, with defaults for what is not asked for.
            pub fn new(size: Size, asked: &Rendering) -> Self {
                Self {
                    size,
                    region: None,
                    seed: 0,
                    aov: None,
                    $($key: asked.$key(),)+
                }
            }

            /// What asks for these settings.
            pub(super) fn asked(&self) -> Rendering {
                Rendering {
                    $($key: Some(self.$key),)+
                }
            }
        }
    };
}

render_settings!(settings);

impl Settings {
    /// What is traced: the region, or the whole picture.
    pub fn traced(&self) -> Region {
        self.region.unwrap_or_else(|| Region::whole(self.size))
    }

    /// What the preparation of a scene depends on.
    pub(crate) fn rules(&self) -> Rules {
        Rules {
            integrator: self.integrator,
            falloff: self.falloff,
            gloss: self.gloss,
        }
    }

    /// What photons depend on; `None` without any.
    pub(crate) fn photon_rules(&self) -> Option<PhotonRules> {
        let has_photons = self.integrator == Integrator::Photon && self.surface().is_none();
        has_photons.then(|| PhotonRules {
            count: PhotonRules::count(self.size.pixels()),
            depth: self.depth,
            seed: self.seed,
            falloff: self.falloff,
            gloss: self.gloss,
        })
    }

    /// The number of passes to all samples: 1, 1, 2, 4 …
    pub fn passes(&self) -> u32 {
        1 + self.spp.next_power_of_two().ilog2()
    }

    /// The AOV of the surfaces to trace instead of light.
    pub(crate) fn surface(&self) -> Option<Aov> {
        self.aov.filter(|aov| !aov.is_of_light() && !aov.is_share())
    }

    /// The noise below which pixels take no more samples: AOVs of surfaces have none, and shares of the
    /// light must add up.
    pub(crate) fn adaptive(&self) -> Option<f64> {
        let is_light = self.aov.is_none_or(Aov::is_of_light);
        (is_light && 0.0 < self.noise).then_some(self.noise)
    }

    /// The settings that a film depends on, apart from the samples, which are 1: what is known from
    /// tracing light is shown of the film of light.
    #[must_use]
    pub fn of_film(&self) -> Self {
        Self {
            aov: self.aov.filter(|aov| !aov.is_of_light()),
            spp: 1,
            ..*self
        }
    }

    /// Whether a film traced with these settings holds what others show, or the first samples of
    /// it.
    pub(crate) fn trace_alike(&self, other: &Self) -> bool {
        self.of_film() == other.of_film()
    }
}

/// When a job is complete with fewer samples than its settings ask for: always after a whole pass,
/// so that the picture is the one with that many samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The time for the job: a pass that would exceed it, judging by those before, is not begun.
    Time(Duration),
    /// The [`Progress::noise`] below which the picture is good enough.
    Noise(f64),
}

/// An arbitrary output variable: a property of the first surface under a pixel, of the samples of
/// its light, or a share of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aov {
    /// Distance from the eye in world units, infinite without a surface. In 8 bits the nearest is
    /// white, the farthest black.
    Depth,
    /// Unit shading normal including bumps, turned toward the eye; 0 without a surface. In 8 bits
    /// −1 to 1 become 0 to 255.
    Normal,
    /// Number of the object in the scene, from 1; 0 without an object. In 8 bits each object has
    /// its own colour.
    Object,
    /// Diffuse albedo including textures; the emission of surfaces without diffuse or highlight.
    Albedo,
    /// Texture coordinates u and v of the surface; 0 without one. In 8 bits red and green, repeated
    /// beyond 0 to 1.
    Uv,
    /// Side of the surface seen, by its geometric normal: 1 its front, −1 its back, 0 without a
    /// surface. In 8 bits blue and orange.
    Side,
    /// Rays traced for a sample of light, including shadow rays, as the mean of the samples. In 8
    /// bits dark to bright on a logarithmic scale, as [`Frame::range`] says.
    Cost,
    /// Samples taken of the light. In 8 bits dark to bright on a logarithmic scale.
    Samples,
    /// Estimated error of the displayed light, 0 to 1, in its worst channel; 0 before samples were
    /// first doubled. In 8 bits dark to bright.
    Noise,
    /// Light that the first surface reflects of the light with this index in the scene. Together
    /// with [`Aov::Emission`] and [`Aov::Indirect`], such shares of all lights add up to the light.
    Direct(u32),
    /// Light seen to glow: emission and ambient light of the first surface, the background, and
    /// lights with a size.
    Emission,
    /// Light that arrives over further surfaces: by mirrors and glass, with path tracing by all.
    Indirect,
}

impl Aov {
    /// The name, such as `depth`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Object => "object",
            Self::Albedo => "albedo",
            Self::Uv => "uv",
            Self::Side => "side",
            Self::Cost => "cost",
            Self::Samples => "samples",
            Self::Noise => "noise",
            Self::Direct(_) => "direct",
            Self::Emission => "emission",
            Self::Indirect => "indirect",
        }
    }

    /// The number of channels that its values differ in; the others repeat the first or are 0.
    pub fn channels(self) -> usize {
        match self {
            Self::Normal | Self::Albedo | Self::Direct(_) | Self::Emission | Self::Indirect => 3,
            Self::Uv => 2,
            Self::Depth | Self::Object | Self::Side | Self::Cost | Self::Samples | Self::Noise => 1,
        }
    }

    /// Whether it is known from tracing light, which makes switching between it and light free.
    pub fn is_of_light(self) -> bool {
        matches!(self, Self::Cost | Self::Samples | Self::Noise)
    }

    /// Whether it is a share of the light.
    pub fn is_share(self) -> bool {
        matches!(self, Self::Direct(_) | Self::Emission | Self::Indirect)
    }

    /// The number of samples per pixel to take if `asked` are requested. Distances, numbers of
    /// objects, texture coordinates and sides cannot be averaged: they take one, at the centre.
    pub fn samples(self, asked: u32) -> u32 {
        match self {
            Self::Depth | Self::Object | Self::Uv | Self::Side => 1,
            _ => asked,
        }
    }
}

/// Which frames of a job contain pixels. All contain the progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Every frame, with [`Frame::values`], for a picture watched while it is traced.
    Live,
    /// Only the last, complete frame.
    Last,
    /// Only the last frame, with [`Frame::values`].
    LastWithValues,
}

/// A picture to trace.
#[derive(Clone, Debug)]
pub struct Job {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The images of its textures.
    pub images: Images,
    /// The scene's own camera, or the working view.
    pub camera: Camera,
    /// Render settings.
    pub settings: Settings,
    /// When to stop earlier, if ever.
    pub limit: Option<Limit>,
    /// Which frames contain pixels.
    pub frames: Frames,
    /// Whether to reduce noise of light: in [`Frame::denoised`] of live frames, and otherwise in
    /// the pixels and values of the last frame themselves.
    pub denoise: bool,
    /// What frames call the objects of the scene, by index; `None` calls them by their indices. A
    /// scene with a part of another's objects is shown as that one.
    pub numbers: Option<Arc<[u32]>>,
}

/// Whether the noise of pictures of this can be reduced.
pub fn denoises(aov: Option<Aov>) -> bool {
    aov.is_none_or(Aov::is_share)
}

impl Job {
    /// Whether its pixels are denoised: AOVs of surfaces have no noise to tell from detail.
    pub(crate) fn denoises(&self) -> bool {
        self.denoise && denoises(self.settings.aov)
    }
}

/// A picture as far as it is traced.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The [`Renderer::restart`](super::Renderer::restart) call it belongs to.
    pub generation: u64,
    /// Size in pixels: that of the traced region.
    pub size: Size,
    /// The place of the top left pixel in the whole picture.
    pub corner: [u32; 2],
    /// Red, green, blue of each pixel, in rows from the top left, as exported; empty in frames
    /// without pixels, see [`Frames`].
    pub pixels: Vec<[u8; 3]>,
    /// Number of the object under each pixel's centre, see [`Job::numbers`], or [`NO_OBJECT`]; only
    /// with [`Frames::Live`].
    pub objects: Vec<u32>,
    /// Linear radiance after exposure, or AOV, of each pixel, unclamped; only with
    /// [`Frames::Live`] and [`Frames::LastWithValues`].
    pub values: Vec<[f32; 3]>,
    /// [`Frame::values`] with less noise; only with [`Frames::Live`] if [`Job::denoise`] asks for
    /// it, of light and its shares for up to 4194304 pixels, and once each pixel has a sample.
    pub denoised: Vec<[f32; 3]>,
    /// Estimated error of each pixel's displayed light in its worst channel, 0 to 1 (the root of
    /// what [`Progress::noise`] averages). Only with [`Frames::Live`] for up to 4194304 pixels, and
    /// once it is estimated.
    pub errors: Vec<f32>,
    /// The values that the ends of a scale stand for, with an AOV that has one: depth, cost,
    /// samples and noise.
    pub range: Option<[f64; 2]>,
    /// How much of it exceeds 1 after the exposure; only in complete frames.
    pub overexposure: Overexposure,
    /// Progress of the job.
    pub progress: Progress,
    /// Answers what its pixels show; `None` if it was not traced.
    pub query: Option<Query>,
}

/// A handle by which pixels of a frame are traced again and explained.
///
/// It keeps nothing alive: it answers as long as the renderer holds the scene prepared, which may end
/// once a later job is given.
#[derive(Clone, Debug)]
pub struct Query {
    pub(crate) world: Weak<World>,
    /// Where photons are traced.
    pub(crate) photons: Weak<Photons>,
    pub(crate) camera: Camera,
    pub(crate) settings: Settings,
    pub(crate) numbers: Option<Arc<[u32]>>,
}

impl Frame {
    /// The settings it was traced with; `None` if it was not traced.
    pub fn settings(&self) -> Option<&Settings> {
        self.query.as_ref().map(|query| &query.settings)
    }

    /// The size of the whole picture, of which the frame may be a region.
    pub fn whole(&self) -> Size {
        self.settings().map_or(self.size, |settings| settings.size)
    }

    /// The index of a pixel of the whole picture in the frame's lists, if it is in its region.
    pub fn index_of(&self, [x, y]: [u32; 2]) -> Option<usize> {
        let [left, top] = self.corner;
        let (x, y) = (x.checked_sub(left)?, y.checked_sub(top)?);
        let inside = x < self.size.width && y < self.size.height;
        inside.then_some(y as usize * self.size.width as usize + x as usize)
    }

    /// A picture that was not traced, without values: red, green, blue of each pixel, in rows from
    /// the top left.
    pub fn drawn(size: Size, pixels: Vec<[u8; 3]>) -> Self {
        Self {
            generation: 0,
            size,
            corner: [0; 2],
            pixels,
            objects: Vec::new(),
            values: Vec::new(),
            denoised: Vec::new(),
            errors: Vec::new(),
            range: None,
            overexposure: Overexposure::default(),
            progress: Progress::COMPLETE,
            query: None,
        }
    }
}

impl Progress {
    /// Whether pixels have different numbers of samples.
    pub fn is_adaptive(&self) -> bool {
        self.mean_spp < f64::from(self.spp)
    }

    /// The samples per pixel: `64 spp`, or the mean of the most, `41 of 64 spp`.
    pub fn samples(&self) -> String {
        if self.is_adaptive() {
            format!("{:.0} of {} spp", self.mean_spp, self.spp)
        } else {
            format!("{} spp", self.spp)
        }
    }

    /// That of a picture of which nothing is traced.
    const COMPLETE: Self = Self {
        pass: 1,
        passes: 1,
        spp: 1,
        mean_spp: 1.0,
        done: 1.0,
        elapsed: Duration::ZERO,
        rays: 0,
        shadow_rays: 0,
        over_budget: 0,
        noise: None,
        complete: true,
    };
}

/// The progress of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Current pass, from 1; each pass doubles the samples: 1, 1, 2, 4 …
    pub pass: u32,
    /// Total number of passes, if no [`Limit`] is met earlier.
    pub passes: u32,
    /// Samples of every pixel, or with adaptive sampling of those that take most; 0 while the picture
    /// is coarse.
    pub spp: u32,
    /// Samples taken, divided by the number of pixels.
    pub mean_spp: f64,
    /// Fraction of the work done, 0 to 1: of all samples, or as estimated of a [`Limit`].
    pub done: f64,
    /// Time since the start of the job, without pauses.
    pub elapsed: Duration,
    /// Rays traced, including shadow rays.
    pub rays: u64,
    /// Shadow rays traced.
    pub shadow_rays: u64,
    /// Samples that exceeded their ray budget and lack the light of the rays not traced.
    pub over_budget: u64,
    /// Estimated root mean square error of the pixels against the converged picture, in displayed
    /// values from 0 to 1. `None` before samples were first doubled, and for AOVs.
    pub noise: Option<f64>,
    /// Whether all samples are taken, or the [`Limit`] is met.
    pub complete: bool,
}
