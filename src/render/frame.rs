//! What goes into a renderer and what comes out: jobs and frames.

use std::sync::Arc;
use std::time::Duration;

use super::filter::Filter;
use crate::scene::{Camera, Images, Integrator, Scene, Size, Transfer};

/// Samples a pixel of full-size pictures unless the user says otherwise.
pub const DEFAULT_SPP: u32 = 16;

/// Bounces of Whitted's rays unless the user says otherwise.
pub const DEFAULT_DEPTH: u32 = 8;

/// Bounces of paths unless the user says otherwise: most end by themselves before.
const DEFAULT_PATH_DEPTH: u32 = 64;

/// Bounces unless the user says otherwise.
pub fn default_depth(integrator: Integrator) -> u32 {
    match integrator {
        Integrator::Whitted => DEFAULT_DEPTH,
        Integrator::Path => DEFAULT_PATH_DEPTH,
    }
}

/// The most samples a pixel: the length of the sample sequence.
pub const MAX_SPP: u32 = 65_536;

/// The marker of a pixel under which no object lies, in [`Frame::objects`].
pub const NO_OBJECT: u32 = u32::MAX;

/// How a picture is traced: with the scene and the camera, all that its pixels depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pixels traced; the framing is the camera's own, whatever their number.
    pub size: Size,
    /// Samples a pixel, 1 to [`MAX_SPP`].
    pub spp: u32,
    /// Bounces; primary rays are bounce 0.
    pub depth: u32,
    /// Chooses among equally good sample patterns.
    pub seed: u32,
    /// What the pixels show instead of light.
    pub aov: Option<Aov>,
    /// How light is gathered.
    pub integrator: Integrator,
    /// What of its surroundings a pixel is the mean of.
    pub filter: Filter,
    /// How colours become 8-bit values.
    pub transfer: Transfer,
}

/// What the first surface under a pixel is, apart from light: an arbitrary output variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aov {
    /// How far the first surface is from the eye, in world units, infinite where there is none. In
    /// 8 bits the nearest is white, the farthest black.
    Depth,
    /// The unit normal of the first surface with its bumps, turned toward the eye, 0 where there is
    /// none. In 8 bits −1 to 1 become 0 to 255.
    Normal,
    /// The place of the object in the scene, counted from 1, 0 where there is none. In 8 bits each
    /// has a colour of its own.
    Object,
    /// The share of light that the first surface sends back evenly, with its textures.
    Albedo,
}

impl Aov {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Object => "object",
            Self::Albedo => "albedo",
        }
    }

    /// Samples a pixel to take where so many are asked for. Several distances, or places in the
    /// scene, have no mean that means anything: one is taken, at the centre.
    pub fn samples(self, asked: u32) -> u32 {
        match self {
            Self::Depth | Self::Object => 1,
            Self::Normal | Self::Albedo => asked,
        }
    }
}

/// Which frames of a job show pixels. All tell the progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Every one: the picture is watched as it comes about.
    Live,
    /// The last one, which is complete: pixels before that would be made for nobody.
    Last,
    /// The last one, which tells [`Frame::values`] besides.
    LastWithValues,
}

/// A picture to trace.
#[derive(Clone, Debug)]
pub struct Job {
    /// What is seen.
    pub scene: Arc<Scene>,
    /// The pictures its textures show.
    pub images: Images,
    /// From where: the scene's own camera, or the working view.
    pub camera: Camera,
    /// How.
    pub settings: Settings,
    /// What is shown of it on the way.
    pub frames: Frames,
}

/// A picture as far as it is traced.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Which [`Renderer::restart`](super::Renderer::restart) it belongs to.
    pub generation: u64,
    /// Its size.
    pub size: Size,
    /// Red, green, blue of each pixel, row by row from the top left, as an export writes them; none
    /// in a frame that shows no pixels, see [`Frames`].
    pub pixels: Vec<[u8; 3]>,
    /// Index of the object under each pixel's centre, or [`NO_OBJECT`]. Only in [`Frames::Live`].
    pub objects: Vec<u32>,
    /// What the pixels were made of: linear light, or the output variable. Only where it was asked
    /// for, see [`Frames`].
    pub values: Vec<[f32; 3]>,
    /// How far it is.
    pub progress: Progress,
}

/// How far a picture is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The pass under way, from 1; passes double the samples: 1, 1, 2, 4 …
    pub pass: u32,
    /// Passes in all.
    pub passes: u32,
    /// Samples that every pixel has; 0 while the picture is still coarse.
    pub spp: u32,
    /// Share of all samples taken, 0 to 1.
    pub done: f64,
    /// Time since the job was begun.
    pub elapsed: Duration,
    /// Rays traced, shadow rays included.
    pub rays: u64,
    /// Shadow rays among them.
    pub shadow_rays: u64,
    /// Samples that ran out of their ray budget and lack the light of the rays not traced.
    pub over_budget: u64,
    /// How far pixels are, as a root mean square, from what more samples would show: an estimate,
    /// of displayed values from 0 to 1. `None` before the samples were first doubled, and of what is
    /// no light.
    pub noise: Option<f64>,
    /// Whether every sample is taken.
    pub complete: bool,
}
