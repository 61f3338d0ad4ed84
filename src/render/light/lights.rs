//! Light arriving from lights: direction, attenuation, and sampling of lights with a size.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;

use crate::material::power;
use crate::sampling::{power_heuristic, warp};
use crate::simd_level::level;
use accel::Bvh;
use geometry::lanes::{Eight, Lanes, Level, Row, Simd, Vector, WIDTH, dispatch, each_bit};
use geometry::{Aabb, IsCancelled, Ray, Rays};
use scene::{Emitter, Falloff, FalloffRule, Light, Rgb};

/// The light arriving at points, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incoming<N> {
    /// Unit vectors toward the light; NaN for a light at the point itself.
    pub(crate) toward: Vector<N>,
    /// Origin of the light, unless it is infinitely far away.
    pub(crate) source: Option<Vector<N>>,
}

/// Returns the light arriving at points, from its centre if it has a size; `None` for ambient
/// light.
#[inline(always)]
pub(crate) fn incoming<N: Lanes>(light: &Light, points: Vector<N>) -> Option<Incoming<N>> {
    match light.emitter {
        Emitter::Point { position, .. } => Some(Incoming::from_sources(
            Vector::all(points.x, position),
            points,
        )),
        Emitter::Distant(toward) => Some(Incoming {
            toward: Vector::all(points.x, toward),
            source: None,
        }),
        Emitter::Ambient => None,
    }
}

/// The same in lanes, each for the light with the index there: either all of them are one, or all are at
/// a finite distance.
#[inline(always)]
pub(crate) fn incoming_each<S: Simd>(
    simd: S,
    lights: &[Light],
    (indices, lanes): (&[usize; WIDTH], u32),
    points: Vector<Eight<S>>,
) -> Option<Incoming<Eight<S>>> {
    let mut used = each_bit(lanes).map(|lane| indices[lane]);
    let first = used.next()?;
    if used.all(|index| index == first) {
        return incoming(&lights[first], points);
    }
    let mut sources = Vector::repeat(DVec3::ZERO);
    for lane in each_bit(lanes) {
        let light = &lights[indices[lane]];
        let Emitter::Point { position, .. } = light.emitter else {
            unreachable!("only point lights differ from lane to lane");
        };
        sources.set(lane, position);
    }
    Some(Incoming::from_sources(sources.load(simd), points))
}

/// The fraction of a light that arrives at a point from a direction, ignoring occlusion. For a
/// light with a size, the distance to its centre counts.
#[inline]
pub(crate) fn attenuation(light: &Light, point: DVec3, toward: DVec3) -> f64 {
    match &light.emitter {
        Emitter::Point { falloff, .. } if *falloff == Falloff::NONE => 1.0,
        Emitter::Point {
            position, falloff, ..
        } => falloff_share(falloff, position.distance(point), toward),
        Emitter::Distant(_) | Emitter::Ambient => 1.0,
    }
}

impl<N: Lanes> Incoming<N> {
    /// The light that arrives at points from sources.
    #[inline(always)]
    pub(crate) fn from_sources(source: Vector<N>, points: Vector<N>) -> Self {
        Self {
            toward: (source - points).unit(),
            source: Some(source),
        }
    }
}

impl<S: Simd> Incoming<Eight<S>> {
    /// Replaces the direction and origin of the light in a lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, incoming: Incoming<f64>) {
        self.toward.put(lane, incoming.toward.into());
        if let (Some(sources), Some(source)) = (&mut self.source, incoming.source) {
            sources.put(lane, source.into());
        }
    }
}

/// The lights under a rule for those whose own falloff is constant; `None` if it changes none.
pub(crate) fn faded(lights: &[Light], rule: FalloffRule) -> Option<Vec<Light>> {
    let is_constant = |light: &Light| match &light.emitter {
        Emitter::Point { falloff, .. } => falloff.radial[1..] == [0.0; 2],
        Emitter::Distant(_) | Emitter::Ambient => false,
    };
    if rule == FalloffRule::None || !lights.iter().any(is_constant) {
        return None;
    }
    let mut faded = lights.to_vec();
    for light in faded.iter_mut().filter(|light| is_constant(light)) {
        if let Emitter::Point { falloff, .. } = &mut light.emitter {
            let [a0, ..] = falloff.radial;
            // Without a positive sum, the light is not attenuated.
            let constant = if 0.0 < a0 { a0 } else { 1.0 };
            falloff.radial = [0.0, 0.0, constant];
        }
    }
    Some(faded)
}

/// The sphere of a light that has a size, toward which shadows and highlights sample it.
pub(crate) fn light_sphere(light: &Light) -> Option<SphereLight> {
    match light.emitter {
        Emitter::Point {
            position, radius, ..
        } if 0.0 < radius => Some(SphereLight {
            centre: position,
            radius,
            intensity: light.colour,
            scale: light.scale,
        }),
        Emitter::Point { .. } | Emitter::Distant(_) | Emitter::Ambient => None,
    }
}

/// The sphere of a light that has a size, as path tracing sees it: with a radiance that follows
/// from its intensity. A light that is no radiometric quantity and does not fade has none: there
/// is no radiance with which it would light all distances alike.
pub(crate) fn luminous_sphere(light: &Light) -> Option<SphereLight> {
    let sphere = light_sphere(light)?;
    let Emitter::Point { falloff, .. } = &light.emitter else {
        return None;
    };
    let [.., square] = falloff.radial;
    if light.scale == 1.0 {
        Some(sphere)
    } else if 0.0 < square {
        Some(SphereLight {
            intensity: sphere.intensity / square,
            ..sphere
        })
    } else {
        None
    }
}

/// The power per steradian that it sends out along the axis of its spot, or in all directions, as
/// path tracing sees it; `None` if it emits no photons.
pub(crate) fn radiant_intensity(light: &Light) -> Option<Rgb> {
    if !light.emits_photons(FalloffRule::None) {
        return None;
    }
    let Emitter::Point { falloff, .. } = &light.emitter else {
        return None;
    };
    Some(match luminous_sphere(light) {
        Some(sphere) => sphere.scale * sphere.intensity,
        None => light.scale * light.colour / falloff.radial[2],
    })
}

/// The fraction of the light at a distance, in the direction opposite to `toward`, a unit
/// vector.
fn falloff_share(falloff: &Falloff, distance: f64, toward: DVec3) -> f64 {
    let [radial, angular] = falloff_shares(falloff, distance, toward);
    radial * angular
}

/// The factors of [`falloff_share`] that stem from the distance and from the direction.
pub(crate) fn falloff_shares(falloff: &Falloff, distance: f64, toward: DVec3) -> [f64; 2] {
    let [a0, a1, a2] = falloff.radial;
    let spread = a0 + a1 * distance + a2 * distance * distance;
    let radial = if 0.0 < spread { 1.0 / spread } else { 1.0 };
    let angular = falloff.spot.map_or(1.0, |(direction, exponent)| {
        let cosine = -direction.dot(toward);
        // Behind a spot light it is dark, regardless of the exponent.
        if cosine <= 0.0 {
            0.0
        } else {
            power(cosine, exponent)
        }
    });
    [radial, angular]
}

/// A light with a size: a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SphereLight {
    centre: DVec3,
    /// Above 0.
    radius: f64,
    intensity: Rgb,
    /// See [`Light::scale`].
    pub(crate) scale: f64,
}

impl SphereLight {
    /// Samples the part of the sphere visible from a point, uniformly over directions. `None` if
    /// the point is inside.
    pub(crate) fn choose(&self, point: DVec3, place: [f64; 2]) -> Option<Incoming<f64>> {
        let (incoming, is_outside) = Spheres::from(self).choose(point.into(), place);
        is_outside.then_some(incoming)
    }

    /// The density of [`SphereLight::choose`] per steradian where it hits the sphere; 0 inside.
    pub(crate) fn density(&self, point: DVec3) -> f64 {
        Spheres::from(self).density(point.into())
    }

    /// Emitted radiance: I / (π r²).
    pub(crate) fn radiance(&self) -> Rgb {
        self.intensity / self.radius / (PI * self.radius)
    }

    /// Radiance over density: the contribution of a sampled direction.
    pub(crate) fn irradiance(&self, point: DVec3) -> Rgb {
        Spheres::from(self).irradiance(point.into()).into()
    }

    /// The distance at which a ray hits the sphere; `None` if it misses or starts inside.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<f64> {
        let (distance, is_hit) = Spheres::from(self).hit(&ray.into());
        is_hit.then_some(distance)
    }

    fn bounds(&self) -> Aabb {
        Aabb {
            min: self.centre - self.radius,
            max: self.centre + self.radius,
        }
    }
}

/// The spheres of lights with a size, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spheres<N> {
    centre: Vector<N>,
    radius: N,
    intensity: Vector<N>,
}

impl From<&SphereLight> for Spheres<f64> {
    #[inline(always)]
    fn from(light: &SphereLight) -> Self {
        Self {
            centre: light.centre.into(),
            radius: light.radius,
            intensity: light.intensity.into(),
        }
    }
}

impl<N: Lanes> Spheres<N> {
    /// See [`SphereLight::choose`]; the mask selects points outside.
    #[inline(always)]
    pub(crate) fn choose(&self, points: Vector<N>, place: [N; 2]) -> (Incoming<N>, N::Mask) {
        let (versine, is_outside) = self.versine(points);
        let offset = self.centre - points;
        let rays = Rays {
            origin: points,
            direction: warp::in_cone(offset.unit(), versine, place),
        };
        let toward = rays.direction;
        // A ray along the rim may just miss the sphere.
        let (distance, is_hit) = self.hit(&rays);
        let distance = N::select(is_hit, distance, toward.dot(offset));
        let incoming = Incoming {
            toward,
            source: Some(rays.at(distance)),
        };
        (incoming, is_outside)
    }

    /// See [`SphereLight::density`].
    #[inline(always)]
    pub(crate) fn density(&self, points: Vector<N>) -> N {
        let (versine, is_outside) = self.versine(points);
        let density = versine.all(1.0) / (versine.all(TAU) * versine);
        N::select(is_outside, density, versine.all(0.0))
    }

    /// See [`SphereLight::irradiance`].
    #[inline(always)]
    pub(crate) fn irradiance(&self, points: Vector<N>) -> Vector<N> {
        // 1 − cos is sin² / (1 + cos), and the sine is the radius over the distance, so that the
        // radius, which may be arbitrarily small, cancels.
        let one = self.radius.all(1.0);
        let distance = (self.centre - points).length();
        let sine = self.radius / distance;
        let square = one - sine * sine;
        let cosine = square.larger(one.all(0.0)).sqrt();
        let doubled = self.intensity.scaled(one.all(2.0));
        doubled.over(distance).over(distance).over(one + cosine)
    }

    /// The light that surfaces at points reflect of the lights from sampled directions: given the
    /// probability with which each light was chosen, the light scattered from the direction, with the
    /// density by which a path goes on there, and the highlight.
    #[inline(always)]
    pub(crate) fn reflected(
        &self,
        points: Vector<N>,
        chance: N,
        (scattered, by_path): (Vector<N>, N),
        highlight: Vector<N>,
    ) -> Vector<N> {
        let irradiance = self.irradiance(points);
        let weight = power_heuristic(chance * self.density(points), by_path);
        // BSDF samples never include the highlight.
        scattered.times(irradiance.scaled(weight)) + highlight.times(irradiance)
    }

    /// See [`SphereLight::hit`]; the mask selects rays that hit.
    #[inline(always)]
    fn hit(&self, rays: &Rays<N>) -> (N, N::Mask) {
        let offset = self.centre - rays.origin;
        let along = offset.dot(rays.direction);
        let aside = (offset - rays.direction.scaled(along)).length_squared();
        let square = self.radius * self.radius;
        let half = square - aside;
        let zero = square.all(0.0);
        let is_outside = square.below(offset.length_squared());
        let is_hit = is_outside & zero.below(along) & zero.up_to(half);
        (along - half.sqrt(), is_hit)
    }

    /// 1 − cos of the half angles that the spheres subtend at points; the mask selects points
    /// outside.
    #[inline(always)]
    fn versine(&self, points: Vector<N>) -> (N, N::Mask) {
        let one = self.radius.all(1.0);
        let sine = self.radius / (self.centre - points).length();
        let square = sine * sine;
        let versine = square / (one + (one - square).sqrt());
        (versine, sine.below(one))
    }
}

impl Spheres<Row> {
    /// Gathers lights; the other lanes are undefined.
    #[inline]
    pub(crate) fn gather(lights: &[Option<SphereLight>; WIDTH]) -> Self {
        let mut spheres = Self {
            centre: Vector::repeat(DVec3::ZERO),
            radius: Row::all(1.0),
            intensity: Vector::repeat(Rgb::ZERO),
        };
        for (lane, light) in lights.iter().enumerate() {
            if let Some(light) = light {
                spheres.centre.set(lane, light.centre);
                spheres.radius.0[lane] = light.radius;
                spheres.intensity.set(lane, light.intensity);
            }
        }
        spheres
    }

    /// Loads the lights into SIMD vectors.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S) -> Spheres<Eight<S>> {
        Spheres {
            centre: self.centre.load(simd),
            radius: self.radius.load(simd),
            intensity: self.intensity.load(simd),
        }
    }
}

/// Up to this number of lights, a ray is tested against each instead of descending the tree, which
/// takes a tenth of the time of `lamp.xml` with its single light.
const MOST_WITHOUT_TREE: usize = 4;

/// All lights of a scene with a size that path tracing sees.
#[derive(Clone, Debug)]
pub(crate) struct SphereLights {
    all: Vec<SphereLight>,
    /// Their indices among all lights.
    numbers: Vec<u32>,
    tree: Arc<Bvh>,
    level: Level,
}

impl SphereLights {
    /// Collects the lights; `None` once `cancelled` returns true.
    pub(crate) fn new(lights: &[Light], cancelled: IsCancelled<'_>) -> Option<Self> {
        let spheres = (0..).zip(lights.iter().map(luminous_sphere));
        let spheres = spheres.filter_map(|(number, sphere)| Some((number, sphere?)));
        let (numbers, all): (Vec<_>, Vec<_>) = spheres.unzip();
        let boxes: Vec<_> = all.iter().map(SphereLight::bounds).collect();
        let tree = Arc::new(Bvh::build(&boxes, cancelled)?);
        let level = level();
        Some(Self {
            all,
            numbers,
            tree,
            level,
        })
    }

    /// Returns the nearest light that a ray hits before a distance, with its index among all lights,
    /// and where; of several at the same distance, the first in the file.
    #[inline]
    pub(crate) fn nearest(&self, ray: &Ray, distance: f64) -> Option<(u32, SphereLight, f64)> {
        let mut nearest: Option<(f64, u32)> = None;
        self.visit(ray, distance, |number| {
            if let Some(hit) = self.all[number as usize].hit(ray)
                && hit < distance
                && nearest.is_none_or(|nearest| (hit, number) < nearest)
            {
                nearest = Some((hit, number));
            }
            nearest.map_or(distance, |(hit, _)| hit)
        });
        nearest.map(|(hit, number)| {
            let number = number as usize;
            (self.numbers[number], self.all[number], hit)
        })
    }

    /// Whether a ray to a point on one of them, its target, hits another one first.
    #[inline]
    pub(crate) fn hide(&self, target: &SphereLight, ray: &Ray, place: DVec3) -> bool {
        if self.all.len() <= 1 {
            return false;
        }
        let distance = place.distance(ray.origin);
        let mut hidden = false;
        self.visit(ray, distance, |number| {
            let sphere = &self.all[number as usize];
            hidden = sphere != target && sphere.hit(ray).is_some_and(|hit| hit < distance);
            if hidden { -1.0 } else { distance }
        });
        hidden
    }

    /// Visits the lights that the ray may hit; `visit` returns the new limit, negative to stop.
    #[inline(always)]
    fn visit(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(u32) -> f64) {
        if self.all.len() <= MOST_WITHOUT_TREE {
            for number in 0..self.all.len() as u32 {
                if visit(number) < 0.0 {
                    break;
                }
            }
        } else {
            self.traverse(ray, limit, visit);
        }
    }

    #[inline(never)]
    fn traverse(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(u32) -> f64) {
        dispatch!(self.level, simd => {
            self.tree.traverse(simd, ray, limit, |places| {
                let mut limit = limit;
                for &number in &self.tree.order()[places] {
                    limit = visit(number);
                    if limit < 0.0 {
                        break;
                    }
                }
                limit
            });
        });
    }
}
