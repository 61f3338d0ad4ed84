//! The pixels of a film as frames show them.

use std::collections::TryReserveError;

use rayon::prelude::*;

use crate::engine::tile::Remembers;
use crate::job::Frames;
use crate::picture::{DisplayTransform, Overexposure, Tone};
use scene::{Rgb, Transfer};

/// Pixels in rows, with the index of the object under each.
#[derive(Debug, Default)]
pub(crate) struct Raster {
    pub(crate) pixels: Vec<[u8; 3]>,
    pub(crate) objects: Vec<u32>,
    /// Unclamped values of the pixels, if requested.
    pub(crate) values: Vec<[f32; 3]>,
    /// Estimated errors of the pixels, if recorded and requested.
    pub(crate) errors: Vec<f32>,
    /// How much of it exceeds 1, if counted.
    pub(crate) overexposure: Overexposure,
    /// The ends of the scale of [`Raster::pixels`], if it has one.
    pub(crate) range: Option<[f64; 2]>,
}

impl Raster {
    /// Reserves memory for the pixels that frames of this kind show.
    pub(super) fn with_room(
        count: usize,
        frames: Frames,
        remembers: Remembers,
    ) -> Result<Self, TryReserveError> {
        let mut room = Self::default();
        room.pixels.try_reserve_exact(count)?;
        match frames {
            Frames::Live => {
                room.objects.try_reserve_exact(count)?;
                room.values.try_reserve_exact(count)?;
                if remembers == Remembers::Histories {
                    room.errors.try_reserve_exact(count)?;
                }
            }
            Frames::Last => {}
            Frames::LastWithValues => room.values.try_reserve_exact(count)?,
        }
        Ok(room)
    }

    /// Replaces values by denoised ones, and the pixels in which they differ.
    pub(crate) fn replace(&mut self, denoised: Vec<[f32; 3]>, transfer: Transfer) {
        let tone = Tone::Colour(DisplayTransform::new(0.0, transfer));
        let pixels = self.pixels.par_iter_mut().zip(&self.values).zip(&denoised);
        pixels.for_each(|((pixel, before), after)| {
            if before != after {
                *pixel = tone.bytes(Rgb::from(after.map(f64::from)));
            }
        });
        self.values = denoised;
    }
}
