//! Noise reduction of finished values: an edge-avoiding à-trous wavelet transform (Dammertz et al.,
//! "Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering", 2010), guided by
//! the first surfaces and by the variance of the pixels (Schied et al., "Spatiotemporal
//! Variance-Guided Filtering", 2017, without its temporal part), which compares patches rather than
//! pixels (Rousselle et al., "Adaptive Rendering with Non-Local Means Filtering", 2012).
//!
//! Light is divided by the albedo of its surface before and multiplied after, so that textures stay
//! sharp. Pixels mix as far as their surfaces are alike and the light around them differs no more
//! than the noise explains: the less noise, the closer to the input. Where there is none, every bit stays.
//!
//! Everything is computed in `f32`, pixel by pixel in a fixed order: the result does not depend on
//! the number of threads or the vectors of the machine.

mod alike;
mod features;
mod guides;
mod mean;
mod mix;
mod neighbours;
mod plane;

use rayon::prelude::*;

use self::features::Features;
pub(crate) use self::guides::Guides;
use self::mean::{Around, mean};
use self::mix::{Kernel, mix};
use self::neighbours::{REACH, bounds, slack};
use self::plane::{Layout, Plane, stride};
use crate::integrators::Guide;
use geometry::IsCancelled;
use geometry::lanes::Level;
use scene::Size;

/// The variance of a pixel with a single sample, whose noise only its neighbours tell.
pub(crate) const UNKNOWN: f32 = -1.0;

/// About how many bytes of memory denoising a picture takes.
pub(crate) fn bytes(size: Size) -> u64 {
    /// Ten of surfaces, four of light before it is mixed and four after, and one of noise.
    const PLANES: u64 = 10 + 2 * 4 + 1;
    let plane = stride(size.width as usize) as u64 * u64::from(size.height) * 4;
    let pixel = size_of::<Guide>() + size_of::<f32>() + size_of::<[f32; 3]>();
    (PLANES * plane).saturating_add((size.pixels() * pixel) as u64)
}

/// Weights by distance: those of a linear B-spline. The cubic one, of 25 pixels rather than 9, has 2 %
/// less error and takes two and a half times as long.
const SPLINE: &[f32] = &[0.5, 0.25];

/// Pixels between those that mix, by iteration. A fifth, of 16, changes errors by less than 1 %.
const STEPS: [usize; 4] = [1, 2, 4, 8];

/// Pixels near each other whose light is this many standard deviations apart or fewer share their
/// variance: that of a lamp in a mirror is not that of the mirror around it.
const ALIKE: f32 = 1.25;

/// Rows and columns on either side that tell the variance of pixels with a single sample.
const UNKNOWN_REACH: usize = 3;

/// Numbers from here on are left out, as are those that are none: their squares may overflow.
const TOO_LARGE: f32 = 1e15;

/// What is mixed: light divided by albedo, and a number beside it.
#[derive(Clone, Debug)]
struct Mixed {
    light: [Plane; 3],
    /// The variance of the light, as the mean of its channels, or another number.
    beside: Plane,
}

impl Mixed {
    /// Zero everywhere.
    fn zero(layout: Layout<'_>) -> Self {
        let plane = || layout.plane(0.0);
        Self {
            light: [plane(), plane(), plane()],
            beside: plane(),
        }
    }

    /// So many rows of each plane at a time, or as many as are left.
    fn bands(
        &mut self,
        layout: Layout<'_>,
        rows: usize,
    ) -> impl IndexedParallelIterator<Item = [&mut [f32]; 4]> {
        let [red, green, blue] = &mut self.light;
        let planes = [red, green, blue, &mut self.beside];
        let [red, green, blue, beside] =
            planes.map(|plane| plane.par_chunks_mut(rows * layout.stride));
        let bands = (red, green, blue, beside).into_par_iter();
        bands.map(|(red, green, blue, beside)| [red, green, blue, beside])
    }
}

/// A picture with noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noisy<'p> {
    /// The vector instructions to use.
    pub(crate) level: Level,
    /// Its width in pixels.
    pub(crate) width: usize,
    /// Linear light of each pixel, in rows.
    pub(crate) values: &'p [[f32; 3]],
    /// The variance of each value, as the mean of the channels, or [`UNKNOWN`].
    pub(crate) variances: &'p [f32],
    /// Its first surfaces.
    pub(crate) guides: &'p Guides,
}

impl Noisy<'_> {
    /// The values with less noise. Meaningless once `cancelled` returns true.
    pub(crate) fn denoised(self, cancelled: IsCancelled<'_>) -> Vec<[f32; 3]> {
        if self.variances.iter().all(|&variance| variance == 0.0) {
            return self.values.to_vec();
        }
        let layout = Layout::new(self.width, self.values.len(), cancelled);
        let Guides { sums, samples } = self.guides;
        let mut features = Features::new(layout, sums, *samples);
        let mut mixed = self.divided(&mut features);
        features.slack = slack(&features, self.level);
        mixed.beside = self.estimated(&mixed, &features);
        let noise = mixed.beside.clone();
        for step in STEPS {
            let kernel = Kernel {
                level: self.level,
                taps: SPLINE,
                step,
            };
            mixed = mix(&mixed, &features, kernel);
        }
        let value = |pixel: usize| {
            let at = features.layout.place(pixel);
            let divisor = features.divisor(at);
            let value = [0, 1, 2].map(|channel| mixed.light[channel][at] * divisor[channel]);
            if 0.0 < noise[at] {
                value
            } else {
                self.values[pixel]
            }
        };
        (0..self.values.len()).into_par_iter().map(value).collect()
    }

    /// The light divided by albedo, and its variance. Pixels with larger numbers than
    /// [`TOO_LARGE`] are left out.
    fn divided(self, features: &mut Features<'_>) -> Mixed {
        let layout = features.layout;
        let is_usual = |pixel: usize| {
            let Guide {
                normal,
                albedo,
                nearness,
            } = self.guides.sums[pixel];
            let values = [self.values[pixel], normal, albedo];
            let numbers = values.as_flattened().iter();
            let mut numbers = numbers.chain([&self.variances[pixel], &nearness]);
            numbers.all(|number| number.abs() < TOO_LARGE)
        };
        let light = |channel: usize| {
            layout.filled(0.0, |pixel| {
                let value = self.values[pixel][channel];
                let light = value / features.divisor(layout.place(pixel))[channel];
                if is_usual(pixel) { light } else { 0.0 }
            })
        };
        let variance = |pixel: usize| {
            let divisor = features.divisor(layout.place(pixel));
            let square = divisor.iter().map(|channel| channel * channel).sum::<f32>() / 3.0;
            match self.variances[pixel] {
                _ if !is_usual(pixel) => 0.0,
                UNKNOWN => UNKNOWN,
                variance => variance / square,
            }
        };
        let mixed = Mixed {
            light: [0, 1, 2].map(light),
            beside: layout.filled(0.0, variance),
        };
        for pixel in (0..self.values.len()).filter(|&pixel| !is_usual(pixel)) {
            features.nearness[layout.place(pixel)] = f32::NAN;
        }
        mixed
    }

    /// Better variances: those of single pixels tell little.
    fn estimated(&self, mixed: &Mixed, features: &Features<'_>) -> Plane {
        let around = |reach, tolerance| Around {
            level: self.level,
            reach,
            tolerance,
        };
        let is_known = |variance: &f32| *variance != UNKNOWN;
        if mixed.beside.iter().all(is_known) {
            let most = bounds(&mixed.beside, features, self.level);
            let mean = mean(mixed, &most, features, around(REACH, Some(ALIKE))).beside;
            let both = mean.into_iter().zip(&mixed.beside);
            return both.map(|(mean, own)| mean.max(*own)).collect();
        }
        // The mean of squares less the square of the mean.
        let square = |light: &[Plane; 3], at: usize| {
            let squares = light.iter().map(|plane| plane[at] * plane[at]);
            squares.sum::<f32>() / 3.0
        };
        let places = 0..mixed.beside.len();
        let squares = Mixed {
            beside: places.clone().map(|at| square(&mixed.light, at)).collect(),
            ..mixed.clone()
        };
        let most = features.layout.plane(f32::INFINITY);
        let mean = mean(&squares, &most, features, around(UNKNOWN_REACH, None));
        let variance = |at: usize| match mixed.beside[at] {
            UNKNOWN => (mean.beside[at] - square(&mean.light, at)).max(0.0),
            known => known,
        };
        places.map(variance).collect()
    }
}

#[cfg(test)]
mod tests;
