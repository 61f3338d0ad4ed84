//! The inputs of tracing a picture, and its camera samples.

use glam::{DVec2, DVec3};

use super::photon::PhotonMaps;
use super::probe::Sample;
use crate::job::Settings;
use crate::light::light_sphere;
use crate::sampling::{FilterSampler, Purpose, Sampler};
use crate::world::{Projection, World};
use geometry::lanes::{Eight, Lanes, Row, Simd, SimdBase, WIDTH, dispatch};
use scene::{Camera, Integrator};

/// The inputs of tracing a tile.
#[derive(Clone, Debug)]
pub(crate) struct FrameContext<'w> {
    /// The scene with its structures.
    pub(crate) world: &'w World,
    /// The camera.
    pub(crate) projection: Projection,
    /// Position of the camera.
    pub(crate) eye: DVec3,
    /// Render settings.
    pub(crate) settings: Settings,
    /// The pixel filter.
    pub(crate) filter: FilterSampler,
    /// The photons of the samples, if there are to be any.
    pub(crate) photons: Option<&'w PhotonMaps>,
}

impl<'w> FrameContext<'w> {
    /// The inputs of tracing a world from a camera.
    pub(crate) fn new(world: &'w World, camera: &Camera, settings: Settings) -> Self {
        Self {
            world,
            projection: Projection::new(camera, settings.size),
            eye: camera.eye,
            settings,
            filter: FilterSampler::of(settings.filter),
            photons: None,
        }
    }

    /// The same with the light of photons, which must be traced for all samples taken.
    pub(crate) fn with_photons<'p>(&self, photons: Option<&'p PhotonMaps>) -> FrameContext<'p>
    where
        'w: 'p,
    {
        FrameContext {
            photons,
            ..self.clone()
        }
    }
}

impl FrameContext<'_> {
    /// Replaces the contents of `samples` by one sample of each of these pixels of the traced
    /// region.
    pub(crate) fn samples(&self, pixels: &[[u32; 2]], index: u32, samples: &mut Vec<Sample>) {
        samples.clear();
        dispatch!(self.world.level, simd => {
            for pixels in pixels.chunks(WIDTH) {
                self.sample_together(simd, pixels, index, samples);
            }
        });
    }

    /// Generates a sample of each of up to eight pixels.
    #[inline(always)]
    fn sample_together<S: Simd>(
        &self,
        simd: S,
        pixels: &[[u32; 2]],
        index: u32,
        samples: &mut Vec<Sample>,
    ) {
        let Settings { size, seed, .. } = self.settings;
        let [left, top] = self.settings.traced().corner();
        let placed = |&[x, y]: &[u32; 2]| [left + x, top + y];
        let (mut corners, mut places) = ([Row::all(0.0); 2], [Row::all(0.0); 2]);
        for (lane, [x, y]) in pixels.iter().map(placed).enumerate() {
            let sampler = Sampler::new(x, y, index, seed);
            let place = self.filter.place(sampler.place_in_pixel());
            for (axis, pixel) in [x, y].into_iter().enumerate() {
                corners[axis].0[lane] = pixel.into();
                places[axis].0[lane] = f64::from(pixel) + place[axis];
            }
        }
        let [x, y] = [places[0].load(simd), places[1].load(simd)];
        let (rays, reach) = self.projection.rays(x, y);
        let half = Eight::splat(simd, 0.5);
        let screen = [
            (corners[0].load(simd) + half) / half.all(size.width.into()),
            (corners[1].load(simd) + half) / half.all(size.height.into()),
        ];
        for (lane, [column, row]) in pixels.iter().map(placed).enumerate() {
            let sampler = Sampler::new(column, row, index, seed);
            let (ray, reach) = if self.projection.has_lens() {
                let lens = || self.lens(sampler);
                self.projection.ray(x[lane], y[lane], lens)
            } else {
                (rays.ray(lane), reach[lane])
            };
            samples.push(Sample {
                ray,
                reach,
                screen: DVec2::new(screen[0][lane], screen[1][lane]),
                sampler,
            });
        }
    }

    /// Whether Whitted ray tracing samples more than places in pixels: a lens, lights with a size or
    /// the spread of rays.
    pub(crate) fn blurs(&self) -> bool {
        let mut lights = self.world.lights().iter();
        let mut materials = self.world.scene.materials.iter();
        self.projection.has_lens()
            || lights.any(|light| light_sphere(light).is_some())
            || materials.any(|material| {
                material.mirror.spread != 0.0
                    || material.dielectric.spread != 0.0
                    || material.facets(self.world.gloss).is_some()
            })
    }

    /// The point of a sample on the lens; `None` for its centre.
    fn lens(&self, sampler: Sampler) -> Option<[f64; 2]> {
        match (self.settings.integrator, self.settings.surface()) {
            // An unbiased sample must not use the centre.
            (Integrator::Path | Integrator::Photon, None) => {
                let [u, v, ..] = sampler.four(Sampler::ROOT, Purpose::Lens);
                Some([u, v])
            }
            _ => sampler.pair(Sampler::ROOT, Purpose::Lens),
        }
    }
}
