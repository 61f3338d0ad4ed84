//! Surfaces that paths met, eight side by side: light sampling and BSDF sampling in lanes.
//!
//! Glossy lobes, mirrors and boundaries are evaluated one surface at a time: the surfaces of a batch
//! rarely share a kind, and glossy lobes take 3 % of the time of scenes that have them.

use std::f64::consts::PI;

use glam::DVec3;

use crate::integrators::direct::{Shadow, shadow_rays};
use crate::integrators::probe::BounceStage;
use crate::integrators::vertex::Vertex;
use crate::light::{Spheres, incoming_each, light_sphere};
use crate::material::{BsdfSample, Component, Diffuse, LobeSamples, Point, power_each};
use crate::sampling::{Fours, warp, weight_over_density};
use geometry::lanes::{
    Eight, Lanes, Level, Row, Simd, Vector, WIDTH, bits, dispatch, each_bit, mask,
};
use geometry::{Rays, Surfaces};
use scene::Light;

/// Up to eight surfaces.
pub(crate) struct Vertices<'v, 'm> {
    all: &'v [Vertex<'m>],
    surface: Surfaces<Row>,
    /// Shading normals.
    normal: Vector<Row>,
    diffuse: Diffuse<Row>,
    lobes_chance: Row,
    /// The lanes with a glossy lobe.
    glossy: u32,
    highlights: Highlights,
}

/// The highlights of surfaces that are not part of their BRDFs.
struct Highlights {
    /// The lanes that have one.
    lanes: u32,
    /// Unit vectors toward the viewer.
    view: Vector<Row>,
    specular: Vector<Row>,
    exponent: Row,
}

/// Emitters sampled at surfaces, before their shadow rays are traced.
pub(crate) struct Aimed {
    /// The lanes in which light may arrive.
    pub(crate) lanes: u32,
    pub(crate) rays: Rays<Row>,
    /// The fraction that the surface reflects, the cosine of incidence included.
    pub(crate) reflected: Vector<Row>,
    /// The densities of the directions by sampling the emitters, and by continuing the path.
    pub(crate) by_light: Row,
    pub(crate) by_path: Row,
    /// The multiple importance sampling weight over the density.
    pub(crate) weight_over_density: Row,
}

/// Lights without a radiance sampled at surfaces, before their shadow rays are traced.
pub(crate) struct PointSamples {
    /// The lanes in which light is reflected.
    pub(crate) lanes: u32,
    /// The fraction that the surface reflects, the cosine of incidence included.
    pub(crate) reflected: Vector<Row>,
    /// Unit vectors toward the lights.
    pub(crate) toward: Vector<Row>,
    pub(crate) shadow: Shadow<Row>,
}

/// Lights with a radiance sampled at surfaces, before their shadow rays are traced.
pub(crate) struct SphereSamples {
    /// The lanes in which light may arrive.
    pub(crate) lanes: u32,
    /// The unshadowed light.
    pub(crate) light: Vector<Row>,
    /// The points on the lights.
    pub(crate) places: Vector<Row>,
    /// The rays toward them from the surfaces.
    pub(crate) rays: Rays<Row>,
    pub(crate) shadow: Shadow<Row>,
}

/// Continuations by the lobes.
pub(crate) struct Continuations {
    /// The lanes continued by a lobe.
    pub(crate) lobes: u32,
    /// The lanes among them whose sampled direction can be followed.
    pub(crate) lead_on: u32,
    pub(crate) rays: Rays<Row>,
    /// Factors on the throughput.
    pub(crate) weight: Vector<Row>,
    pub(crate) density: Row,
}

impl Continuations {
    /// The continuation in a lane continued by a lobe, at a point; `None` if its direction leads nowhere.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize, point: &Point) -> Option<BsdfSample> {
        (self.lead_on >> lane & 1 == 1).then(|| {
            let (ray, weight) = (self.rays.get(lane), self.weight.get(lane));
            BsdfSample::by_lobes(point, ray, weight, self.density.0[lane])
        })
    }
}

impl<'v, 'm> Vertices<'v, 'm> {
    /// Collects all surfaces.
    pub(crate) fn collect(all: &'v [Vertex<'m>]) -> Vec<Self> {
        all.chunks(WIDTH).map(Self::new).collect()
    }

    fn new(all: &'v [Vertex<'m>]) -> Self {
        let zero = Vector::repeat(DVec3::ZERO);
        let mut vertices = Self {
            all,
            surface: Surfaces {
                point: zero,
                normal: zero,
                scale: Row::all(0.0),
            },
            normal: zero,
            diffuse: Diffuse {
                colour: zero,
                even: Row::all(1.0),
            },
            lobes_chance: Row::all(0.0),
            glossy: 0,
            highlights: Highlights {
                lanes: 0,
                view: zero,
                specular: zero,
                exponent: Row::all(0.0),
            },
        };
        for (lane, Vertex { point, bsdf, .. }) in all.iter().enumerate() {
            let surface = &mut vertices.surface;
            surface.point.set(lane, point.surface.point);
            surface.normal.set(lane, point.surface.normal);
            surface.scale.0[lane] = point.surface.scale;
            vertices.normal.set(lane, point.normal);
            let diffuse = bsdf.lobes.diffuse();
            vertices.diffuse.colour.set(lane, diffuse.colour.into());
            vertices.diffuse.even.0[lane] = diffuse.even;
            vertices.lobes_chance.0[lane] = bsdf.lobes_chance;
            vertices.glossy |= u32::from(bsdf.lobes.is_glossy()) << lane;
            if let Some(gloss) = bsdf.lobes.gloss() {
                let highlights = &mut vertices.highlights;
                highlights.lanes |= 1 << lane;
                highlights.view.set(lane, point.view);
                highlights.specular.set(lane, gloss.specular);
                highlights.exponent.0[lane] = gloss.exponent;
            }
        }
        vertices
    }

    /// The surfaces.
    pub(crate) fn all(&self) -> &'v [Vertex<'m>] {
        self.all
    }

    /// Their points and shading normals.
    pub(crate) fn places(&self) -> (&Vector<Row>, &Vector<Row>) {
        (&self.surface.point, &self.normal)
    }

    /// Weighs the directions to emitters in lanes, chosen with these densities.
    #[inline(always)]
    pub(crate) fn aim<S: Simd>(
        &self,
        simd: S,
        lanes: u32,
        toward: &Vector<Row>,
        by_light: &Row,
    ) -> Aimed {
        let (toward, by_light) = (toward.load(simd), by_light.load(simd));
        let (reflected, density) = self.scatter(simd, lanes, toward);
        let by_path = self.lobes_chance.load(simd) * density;
        let weight_over_density = weight_over_density(by_light, by_path);
        let is_dark = reflected.is_zero() | by_light.equals(by_light.all(0.0));
        Aimed {
            lanes: lanes & !bits::<S>(is_dark),
            rays: self.leave(simd, toward),
            reflected: reflected.store(),
            by_light: by_light.into(),
            by_path: by_path.into(),
            weight_over_density: weight_over_density.into(),
        }
    }

    /// Samples lights without a radiance, given the indices of those that light the lanes: either all of
    /// them are one, or all are at a finite distance.
    pub(crate) fn sample_points(
        &self,
        level: Level,
        (lights, indices, lanes): (&[Light], &[usize; WIDTH], u32),
        numbers: &Fours,
    ) -> Option<PointSamples> {
        dispatch!(level, simd => {
            self.sample_points_together(simd, (lights, indices, lanes), numbers)
        })
    }

    #[inline(always)]
    fn sample_points_together<S: Simd>(
        &self,
        simd: S,
        (lights, indices, lanes): (&[Light], &[usize; WIDTH], u32),
        numbers: &Fours,
    ) -> Option<PointSamples> {
        let surface = self.surface.load(simd);
        let mut incoming = incoming_each(simd, lights, (indices, lanes), surface.point)?;
        for lane in each_bit(lanes) {
            let [u, v, ..] = numbers.lane(lane);
            if let Some(sphere) = light_sphere(&lights[indices[lane]])
                && let Some(chosen) = sphere.choose(self.surface.point.get(lane), [u, v])
            {
                incoming.put(lane, chosen);
            }
        }
        let toward = incoming.toward;
        let (scattered, _) = self.scatter(simd, lanes, toward);
        let reflected = scattered + self.highlight(simd, lanes, toward);
        let shadow = shadow_rays(&surface, incoming);
        Some(PointSamples {
            lanes: lanes & !bits::<S>(reflected.is_zero()),
            reflected: reflected.store(),
            toward: toward.store(),
            shadow: shadow.store(),
        })
    }

    /// Samples lights with a radiance, chosen with these probabilities.
    pub(crate) fn sample_spheres(
        &self,
        level: Level,
        (spheres, chances, lanes): (&Spheres<Row>, &Row, u32),
        numbers: &Fours,
        stage: BounceStage,
    ) -> SphereSamples {
        dispatch!(level, simd => {
            self.sample_spheres_together(simd, (spheres, chances, lanes), numbers, stage)
        })
    }

    #[inline(always)]
    fn sample_spheres_together<S: Simd>(
        &self,
        simd: S,
        (spheres, chances, lanes): (&Spheres<Row>, &Row, u32),
        numbers: &Fours,
        stage: BounceStage,
    ) -> SphereSamples {
        let (spheres, chance) = (spheres.load(simd), chances.load(simd));
        let surface = self.surface.load(simd);
        let (incoming, is_outside) = spheres.choose(surface.point, numbers.pair(simd));
        let toward = incoming.toward;
        let (scattered, density) = self.scatter(simd, lanes, toward);
        let highlight = self.highlight(simd, lanes, toward);
        let by_path = match stage {
            BounceStage::Inner => self.lobes_chance.load(simd) * density,
            BounceStage::Last => density.all(0.0),
        };
        let scattering = (scattered, by_path);
        let light = spheres.reflected(surface.point, chance, scattering, highlight);
        let is_dark = scattered.is_zero() & highlight.is_zero();
        let shadow = shadow_rays(&surface, incoming);
        let places = incoming.source.unwrap_or(surface.point);
        SphereSamples {
            lanes: lanes & bits::<S>(is_outside) & !bits::<S>(is_dark),
            light: light.over(chance).store(),
            places: places.store(),
            rays: self.leave(simd, toward),
            shadow: shadow.store(),
        }
    }

    /// Samples continuations by the lobes, where the numbers choose these.
    pub(crate) fn sample(&self, level: Level, numbers: &Fours) -> Continuations {
        dispatch!(level, simd => self.sample_together(simd, numbers))
    }

    #[inline(always)]
    fn sample_together<S: Simd>(&self, simd: S, numbers: &Fours) -> Continuations {
        let mut lobes = 0;
        let mut glossy = 0;
        let mut directions = Vector::repeat(DVec3::ZERO);
        for (lane, Vertex { point, bsdf, .. }) in self.all.iter().enumerate() {
            let [u, v, choice, _] = numbers.lane(lane);
            if let Some(Component::Lobes(choice)) = bsdf.component(choice) {
                lobes |= 1 << lane;
                if !bsdf.lobes.is_diffuse(choice) {
                    glossy |= 1 << lane;
                    directions.set(lane, bsdf.lobes.choose(point, choice, [u, v]));
                }
            }
        }
        let normal = self.normal.load(simd);
        let toward = warp::by_cosine(normal, numbers.pair(simd));
        let toward = Vector::select(mask(simd, glossy), directions.load(simd), toward);
        let scattered = self.scatter(simd, lobes, toward);
        let by_lobes = LobeSamples::new(self.lobes_chance.load(simd), scattered);
        Continuations {
            lobes,
            lead_on: lobes & bits::<S>(by_lobes.leads_on),
            rays: self.leave(simd, toward),
            weight: by_lobes.weight.store(),
            density: by_lobes.density.into(),
        }
    }

    /// The light scattered from directions by the lobes, the cosine of incidence included, and the
    /// densities of the directions; without glossy lobes outside the lanes.
    #[inline(always)]
    fn scatter<S: Simd>(
        &self,
        simd: S,
        lanes: u32,
        toward: Vector<Eight<S>>,
    ) -> (Vector<Eight<S>>, Eight<S>) {
        let cosine = self.normal.load(simd).dot(toward);
        let mut values = Vector::repeat(DVec3::ZERO);
        let mut densities = Row::all(0.0);
        let glossy = self.glossy & lanes & bits::<S>(cosine.all(0.0).below(cosine));
        if glossy != 0 {
            let toward = toward.store();
            for lane in each_bit(glossy) {
                let Vertex { point, bsdf, .. } = &self.all[lane];
                let (value, density) = bsdf.lobes.scatter_glossy(point, toward.get(lane));
                values.set(lane, value);
                densities.0[lane] = density;
            }
        }
        let diffuse = Diffuse {
            colour: self.diffuse.colour.load(simd),
            even: self.diffuse.even.load(simd),
        };
        diffuse.scatter(cosine, (values.load(simd), densities.load(simd)))
    }

    /// The highlights, in lanes, of light from directions that are not part of the BRDF.
    #[inline(always)]
    fn highlight<S: Simd>(
        &self,
        simd: S,
        lanes: u32,
        toward: Vector<Eight<S>>,
    ) -> Vector<Eight<S>> {
        let (zero, normal) = (toward.x.all(0.0), self.normal.load(simd));
        let none = Vector::all(zero, DVec3::ZERO);
        let cosine = normal.dot(toward);
        let lanes = self.highlights.lanes & lanes & bits::<S>(zero.below(cosine));
        if lanes == 0 {
            return none;
        }
        let mirrored = normal.scaled(zero.all(2.0) * cosine) - toward;
        let cosine = mirrored.dot(self.highlights.view.load(simd));
        let power = power_each(cosine, &self.highlights.exponent.0, lanes);
        let specular = self.highlights.specular.load(simd);
        let highlight = specular.scaled(power).over(zero.all(PI));
        Vector::select(mask(simd, lanes), highlight, none)
    }

    /// Rays that leave the surfaces.
    #[inline(always)]
    fn leave<S: Simd>(&self, simd: S, toward: Vector<Eight<S>>) -> Rays<Row> {
        let origin = self.surface.load(simd).leave(toward);
        Rays {
            origin: origin.store(),
            direction: toward.store(),
        }
    }
}
