//! A picture as far as it is traced.

use std::time::Duration;

use super::overexposure::Overexposure;
use super::query::Query;
use crate::job::Settings;
use scene::Size;

/// A picture as far as it is traced.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The [`Renderer::restart`](crate::Renderer::restart) call it belongs to.
    pub generation: u64,
    /// Size in pixels: that of the traced region.
    pub size: Size,
    /// The place of the top left pixel in the whole picture.
    pub corner: [u32; 2],
    /// Red, green, blue of each pixel, in rows from the top left, as exported; empty in frames
    /// without pixels, see [`Frames`](crate::Frames).
    pub pixels: Vec<[u8; 3]>,
    /// Number of the object under each pixel's centre, see [`Job::numbers`](crate::Job::numbers), or [`NO_OBJECT`](crate::NO_OBJECT); only
    /// with [`Frames::Live`](crate::Frames::Live).
    pub objects: Vec<u32>,
    /// Linear radiance after exposure, or AOV, of each pixel, unclamped; only with
    /// [`Frames::Live`](crate::Frames::Live) and [`Frames::LastWithValues`](crate::Frames::LastWithValues).
    pub values: Vec<[f32; 3]>,
    /// [`Frame::values`] with less noise; only with [`Frames::Live`](crate::Frames::Live) if [`Job::denoise`](crate::Job::denoise) asks for
    /// it, of light and its shares for up to 4194304 pixels, and once each pixel has a sample.
    pub denoised: Vec<[f32; 3]>,
    /// Estimated error of each pixel's displayed light in its worst channel, 0 to 1 (the root of
    /// what [`Progress::noise`] averages). Only with [`Frames::Live`](crate::Frames::Live) for up to 4194304 pixels, and
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

    /// The progress of a picture of which nothing is traced.
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
    /// Total number of passes, if no [`Limit`](crate::Limit) is met earlier.
    pub passes: u32,
    /// Samples of every pixel, or with adaptive sampling of those that take most; 0 while the picture
    /// is coarse.
    pub spp: u32,
    /// Samples taken, divided by the number of pixels.
    pub mean_spp: f64,
    /// Fraction of the work done, 0 to 1: of all samples, or as estimated of a [`Limit`](crate::Limit).
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
    /// Whether all samples are taken, or the [`Limit`](crate::Limit) is met.
    pub complete: bool,
}
