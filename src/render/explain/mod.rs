//! Why a pixel has its colour: the whole tree of rays behind a sample, recorded part by part.
//!
//! The steps that trace pictures are run for one sample, by [paths](path) or [Whitted's rays](whitted),
//! and what they leave is read between them. So the record does not drift from the picture, and costs
//! nothing where no one asks.

mod judge;
mod lights;
mod path;
mod ray_kind;
mod record;
mod recorder;
mod surface;
mod verdict;
mod whitted;

use std::sync::{Arc, Weak};

use glam::DVec3;

use super::integrators::{FrameContext, PhotonRules, Photons, Sample};
use super::job::{Job, Settings};
use super::picture::{DisplayTransform, Query, Tone};
use super::world::{Projection, World, WorldSettings};
use geometry::IsCancelled;
use judge::Case;
use scene::{Integrator, MAX_SPP};

pub use ray_kind::RayKind;
pub use record::{
    Boundary, Chosen, Crossing, EmitterTerm, Explanation, LightHit, LightTerm, RayEnd, Shading,
    Stop, SurfaceHit, TracedRay, Unlisted, UnlitReason,
};
pub use verdict::{DepthLimit, Finding, Term, TermSource, Verdict};

/// A scene prepared for questions without a renderer.
#[derive(Debug)]
pub struct PreparedScene {
    query: Query,
    /// Kept alive for the query.
    _world: Arc<World>,
    _photons: Option<Arc<Photons>>,
}

impl PreparedScene {
    /// Prepares the scene of a job; `None` once `cancelled` returns true.
    pub fn new(job: &Job, cancelled: IsCancelled<'_>) -> Option<Self> {
        let scene = Arc::clone(&job.scene);
        let world = World::build(
            scene,
            &job.images,
            WorldSettings::of(&job.settings),
            None,
            cancelled,
        )?;
        let photons = match PhotonRules::of(&job.settings) {
            Some(rules) => Some(Photons::build(&world, rules, None, cancelled)?),
            None => None,
        };
        let world = Arc::new(world);
        Some(Self {
            query: Query::new(&world, photons.as_ref(), job),
            _world: world,
            _photons: photons,
        })
    }

    /// What answers the questions; it does so as long as this value lives.
    pub fn query(&self) -> &Query {
        &self.query
    }
}

/// The first surface under the centre of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// Where the ray through the pixel starts: at the near limit.
    pub origin: DVec3,
    /// Its direction, of unit length.
    pub direction: DVec3,
    /// The surface, if there is one up to the far limit.
    pub surface: Option<SurfaceHit>,
    /// The distance of the surface from the eye, as [`Aov::Depth`](super::Aov::Depth) has it; else
    /// infinite.
    pub depth: f64,
}

impl Query {
    /// Creates the handle of a job's frames.
    pub(super) fn new(world: &Arc<World>, photons: Option<&Arc<Photons>>, job: &Job) -> Self {
        Self {
            world: Arc::downgrade(world),
            photons: photons.map_or_else(Weak::new, Arc::downgrade),
            camera: job.camera,
            // Its pixels are those of the whole picture.
            settings: Settings {
                region: None,
                ..job.settings
            },
            numbers: job.numbers.clone(),
        }
    }

    /// Traces a sample of a pixel again and records its rays. The light is explained even where the
    /// frame shows an AOV. `None` outside the picture, for an index of [`MAX_SPP`] or above, if the
    /// scene is no longer prepared, and once `cancelled` returns true.
    ///
    /// It takes far less than a millisecond for most pixels, but as long as a few thousand rays and
    /// their shadow rays to all lights for the worst, so it belongs on a thread of its own.
    pub fn explain(
        &self,
        pixel: [u32; 2],
        sample: u32,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Explanation> {
        let world = self.world.upgrade()?;
        let settings = self.settings;
        let traced = self.sample(&world, pixel, sample)?;
        let (radiance, rays) = match settings.integrator {
            Integrator::Whitted => whitted::record(&world, settings.depth, traced, cancelled)?,
            Integrator::Path => path::record(&world, settings.depth, None, traced, cancelled)?,
            Integrator::Photon => {
                let photons = self.photons.upgrade()?;
                let map = photons.map_alone(&world, sample, cancelled)?;
                path::record(&world, settings.depth, Some(&map), traced, cancelled)?
            }
        };
        let case = Case {
            world: &world,
            projection: &Projection::new(&self.camera, settings.size),
            rays: &rays,
            display: DisplayTransform::of(&settings),
            stops: settings.exposure,
            integrator: settings.integrator,
            depth: settings.depth,
        };
        let mut explanation = Explanation {
            pixel,
            sample,
            integrator: settings.integrator,
            depth: settings.depth,
            radiance,
            displayed: Tone::Colour(case.display).bytes(radiance),
            verdicts: judge::judge(&case),
            rays,
        };
        if let Some(numbers) = &self.numbers {
            explanation.rename(|index| named(numbers, index));
        }
        Some(explanation)
    }

    /// Describes the first surface under the centre of a pixel, in a few microseconds. `None` outside
    /// the picture and if the scene is no longer prepared.
    pub fn first_hit(&self, pixel: [u32; 2]) -> Option<FirstHit> {
        let world = self.world.upgrade()?;
        let Sample { ray, reach, .. } = self.sample(&world, pixel, 0)?;
        let nearest = world.nearest(&ray, reach);
        let mut mapped = None;
        let surface = nearest.map(|nearest| {
            let (point, _) = world.shading_point(&ray, nearest, &mut mapped);
            let mut hit = surface::surface_hit(&world, &ray, nearest, &point);
            if let Some(numbers) = &self.numbers {
                hit.object = named(numbers, hit.object);
            }
            hit
        });
        let depth = |hit: SurfaceHit| surface::depth(self.camera.eye, &ray, hit.t);
        Some(FirstHit {
            origin: ray.origin,
            direction: ray.direction,
            surface,
            depth: surface.map_or(f64::INFINITY, depth),
        })
    }

    /// A camera sample.
    fn sample(&self, world: &World, pixel: [u32; 2], index: u32) -> Option<Sample> {
        let size = self.settings.size;
        if size.width <= pixel[0] || size.height <= pixel[1] || MAX_SPP <= index {
            return None;
        }
        let settings = Settings {
            aov: None,
            ..self.settings
        };
        let context = FrameContext::new(world, &self.camera, settings);
        let mut samples = Vec::new();
        context.samples(&[pixel], index, &mut samples);
        samples.pop()
    }
}

/// What frames call an object.
fn named(numbers: &[u32], index: u32) -> u32 {
    numbers
        .get(index as usize)
        .copied()
        .unwrap_or(super::NO_OBJECT)
}
