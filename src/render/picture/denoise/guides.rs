//! The first surfaces under the pixels of a picture.

use rayon::prelude::*;

use crate::integrators::{FrameContext, Guide, guide};
use geometry::IsCancelled;

/// Most samples of a pixel that its surfaces are averaged over: more change them little.
const MOST_SAMPLES: u32 = 16;

/// The surfaces under the pixels of a picture, at the places of its first samples.
#[derive(Debug, Default)]
pub(crate) struct Guides {
    /// Samples taken of each pixel.
    pub(crate) samples: u32,
    /// The sums of each pixel, in rows.
    pub(crate) sums: Vec<Guide>,
}

impl Guides {
    /// Traces as many samples of each pixel as its light has, on the current thread pool. Returns
    /// false, and forgets all, once `cancelled` returns true or if memory is short.
    pub(crate) fn extend(
        &mut self,
        spp: u32,
        context: &FrameContext<'_>,
        cancelled: IsCancelled<'_>,
    ) -> bool {
        let size = context.settings.traced().size();
        let integrator = context.settings.integrator;
        if self.sums.is_empty() {
            if self.sums.try_reserve_exact(size.pixels()).is_err() {
                return false;
            }
            self.sums.resize(size.pixels(), Guide::default());
        }
        let indices = self.samples..spp.min(MOST_SAMPLES).max(self.samples);
        let rows = self.sums.par_chunks_exact_mut(size.width as usize);
        rows.enumerate()
            .for_each_init(Vec::new, |samples, (y, row)| {
                let pixels: Vec<_> = (0..size.width).map(|x| [x, y as u32]).collect();
                for index in indices.clone() {
                    if cancelled() {
                        return;
                    }
                    context.samples(&pixels, index, samples);
                    for (sum, sample) in row.iter_mut().zip(samples.iter()) {
                        let skipped = (sample.ray.origin - context.eye).dot(sample.ray.direction);
                        sum.add(guide(context.world, sample, skipped, integrator));
                    }
                }
            });
        if cancelled() {
            *self = Self::default();
            return false;
        }
        self.samples = indices.end;
        true
    }
}
