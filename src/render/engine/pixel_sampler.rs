//! Samples of pixels, taken together by one thread.

use crate::integrators::{FrameContext, Sample, SampleResult, Tracer, first_hit};
use scene::Rgb;

/// A thread's tracer, with scratch space reused between tiles.
pub(crate) struct PixelSampler<'w> {
    pub(crate) tracer: Tracer<'w>,
    /// Pixels to sample.
    pub(crate) pixels: Vec<[u32; 2]>,
    /// A sample of each pixel.
    samples: Vec<Sample>,
    /// Results of the samples.
    pub(crate) seen: Vec<SampleResult>,
}

impl<'w> PixelSampler<'w> {
    pub(crate) fn new(tracer: Tracer<'w>) -> Self {
        Self {
            tracer,
            pixels: Vec::new(),
            samples: Vec::new(),
            seen: Vec::new(),
        }
    }

    /// Takes the sample with this index of each of the pixels. Meaningless once the tracer is
    /// cancelled.
    pub(crate) fn sample(&mut self, index: u32, context: &FrameContext<'_>) {
        let Self {
            tracer,
            pixels,
            samples,
            seen,
        } = self;
        context.samples(pixels, index, samples);
        match context.settings.surface() {
            None => {
                tracer.trace(samples, seen);
                if 0.0 < context.settings.clamp {
                    for seen in seen {
                        seen.radiance = clamped(seen.radiance, context.settings.clamp);
                    }
                }
            }
            Some(aov) => {
                tracer.count(samples.len());
                seen.clear();
                seen.extend(samples.iter().map(|&Sample { ray, reach, .. }| {
                    let skipped = (ray.origin - context.eye).dot(ray.direction);
                    first_hit(context.world, &ray, reach, skipped, aov)
                }));
            }
        }
    }
}

/// Radiance scaled down so that its largest channel is at most this.
fn clamped(radiance: Rgb, most: f64) -> Rgb {
    let largest = radiance.max_element();
    if largest <= most {
        radiance
    } else if largest.is_finite() {
        radiance * (most / largest)
    } else {
        radiance.min(Rgb::splat(most))
    }
}
