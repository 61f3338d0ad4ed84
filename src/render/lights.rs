//! Light as it comes from lights: where it is from, how much, and from which part of one that has a
//! size.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;

use super::optics::power;
use super::warp;
use crate::accel::Bvh;
use crate::geometry::lanes::{Eight, Lanes, Level, Simd, Vector, dispatch};
use crate::geometry::{Aabb, Ray};
use crate::scene::{Falloff, Integrator, Light, Rgb, Scene, Source};

/// From where light comes to points, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incoming<N> {
    /// The unit vectors toward it; NaN for a light at the point itself.
    pub(crate) toward: Vector<N>,
    /// Where it starts, unless that is infinitely far away.
    pub(crate) source: Option<Vector<N>>,
}

/// From where a light comes to points: from the middle of one that has a size. `None` if it comes
/// from nowhere.
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
#[inline(always)]
pub(crate) fn incoming<N: Lanes>(light: &Light, points: Vector<N>) -> Option<Incoming<N>> {
    match light.source {
        Source::Point { position, .. } => {
            let source = Vector::all(points.x, position);
            Some(Incoming {
                toward: (source - points).unit(),
                source: Some(source),
            })
        }
        Source::Distant(toward) => Some(Incoming {
            toward: Vector::all(points.x, toward),
            source: None,
        }),
        Source::Everywhere => None,
    }
}

/// The part of a light that comes to a point in a direction, whatever is in its way. Of a light with
/// a size its centre's distance counts.
#[inline]
pub(crate) fn attenuation(light: &Light, point: DVec3, toward: DVec3) -> f64 {
    match &light.source {
        Source::Point { falloff, .. } if *falloff == Falloff::NONE => 1.0,
        Source::Point { position, falloff } => falloff.share(position.distance(point), toward),
        Source::Distant(_) | Source::Everywhere => 1.0,
    }
}

impl<S: Simd> Incoming<Eight<S>> {
    /// Lets the light in a lane come from elsewhere.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, incoming: Incoming<f64>) {
        self.toward.put(lane, incoming.toward.into());
        if let (Some(sources), Some(source)) = (&mut self.source, incoming.source) {
            sources.put(lane, source.into());
        }
    }
}

impl Light {
    /// What it is where it is seen, if it has a size.
    pub(crate) fn sphere(&self) -> Option<SphereLight> {
        match self.source {
            Source::Point { position, .. } if 0.0 < self.radius => Some(SphereLight {
                centre: position,
                radius: self.radius,
                intensity: self.colour,
            }),
            _ => None,
        }
    }
}

impl Falloff {
    /// The part of the light that goes a distance in the direction from `toward`, a unit vector.
    fn share(&self, distance: f64, toward: DVec3) -> f64 {
        let [a0, a1, a2] = self.radial;
        let spread = a0 + a1 * distance + a2 * distance * distance;
        let radial = if 0.0 < spread { 1.0 / spread } else { 1.0 };
        let angular = self.spot.map_or(1.0, |(direction, exponent)| {
            let cosine = -direction.dot(toward);
            // Behind a spot light it is dark, whatever the exponent.
            if cosine <= 0.0 {
                0.0
            } else {
                power(cosine, exponent)
            }
        });
        radial * angular
    }
}

/// A light that has a size: a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SphereLight {
    centre: DVec3,
    /// Above 0.
    radius: f64,
    intensity: Rgb,
}

impl SphereLight {
    /// Chooses a place of what is seen of it from a point, each direction as likely as any other.
    /// `None` from inside.
    pub(crate) fn choose(&self, point: DVec3, place: [f64; 2]) -> Option<Incoming<f64>> {
        let versine = self.versine(point)?;
        let axis = (self.centre - point).normalize();
        let toward = warp::in_cone(axis, versine, place);
        let ray = Ray {
            origin: point,
            direction: toward,
        };
        // A ray along the rim may just miss it.
        let distance = self
            .hit(&ray)
            .unwrap_or_else(|| toward.dot(self.centre - point));
        Some(Incoming {
            toward: toward.into(),
            source: Some(ray.at(distance).into()),
        })
    }

    /// The density of [`SphereLight::choose`] over directions that meet it, per steradian; 0 from inside.
    pub(crate) fn density(&self, point: DVec3) -> f64 {
        self.versine(point)
            .map_or(0.0, |versine| 1.0 / (TAU * versine))
    }

    /// What it shows where it is seen: I / (π r²).
    pub(crate) fn radiance(&self) -> Rgb {
        self.intensity / self.radius / (PI * self.radius)
    }

    /// Radiance over density: what its light counts in one direction that was chosen.
    pub(crate) fn irradiance(&self, point: DVec3) -> Rgb {
        // 1 − cos is sin² / (1 + cos), and the sine is the radius over the distance, so that the
        // radius, which may be as small as numbers are, cancels.
        let distance = self.centre.distance(point);
        let sine = self.radius / distance;
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        2.0 * self.intensity / distance / distance / (1.0 + cosine)
    }

    /// How far along a ray it is; `None` if it is missed, or from inside.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<f64> {
        let way = self.centre - ray.origin;
        let along = way.dot(ray.direction);
        let aside = (way - along * ray.direction).length_squared();
        let square = self.radius * self.radius;
        let half = square - aside;
        let is_outside = square < way.length_squared();
        (is_outside && 0.0 < along && 0.0 <= half).then(|| along - half.sqrt())
    }

    fn bounds(&self) -> Aabb {
        Aabb {
            min: self.centre - self.radius,
            max: self.centre + self.radius,
        }
    }

    /// 1 − cos of half the angle that it takes as seen from a point outside.
    fn versine(&self, point: DVec3) -> Option<f64> {
        let sine = self.radius / self.centre.distance(point);
        (sine < 1.0).then(|| {
            let square = sine * sine;
            square / (1.0 + (1.0 - square).sqrt())
        })
    }
}

/// All lights of a scene that have a size.
#[derive(Clone, Debug)]
pub(crate) struct SphereLights {
    all: Vec<SphereLight>,
    tree: Arc<Bvh>,
}

impl SphereLights {
    /// `None` if `cancelled` said so.
    pub(crate) fn new(lights: &[Light], cancelled: impl Fn() -> bool + Sync) -> Option<Self> {
        let all: Vec<_> = lights.iter().filter_map(Light::sphere).collect();
        let boxes: Vec<_> = all.iter().map(SphereLight::bounds).collect();
        let tree = Arc::new(Bvh::build(&boxes, cancelled)?);
        Some(Self { all, tree })
    }

    /// The nearest one that a ray meets before a distance, and where; of several at the same place
    /// the first in file order.
    pub(crate) fn nearest(&self, ray: &Ray, distance: f64) -> Option<(SphereLight, f64)> {
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
        nearest.map(|(hit, number)| (self.all[number as usize], hit))
    }

    /// Whether a ray meets one other than its own target before a distance.
    pub(crate) fn hide(&self, target: &SphereLight, ray: &Ray, distance: f64) -> bool {
        let mut hidden = false;
        self.visit(ray, distance, |number| {
            let sphere = &self.all[number as usize];
            hidden = sphere != target && sphere.hit(ray).is_some_and(|hit| hit < distance);
            if hidden { -1.0 } else { distance }
        });
        hidden
    }

    /// Visits those that the ray may meet; `visit` gives the limit from there on, below 0 to end.
    fn visit(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(u32) -> f64) {
        if self.all.is_empty() {
            return;
        }
        dispatch!(Level::new(), simd => {
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

/// What the intensities of a scene's lights are multiplied by where paths gather them. Those of a
/// scene of `.xml` that was not made for it shine on even surfaces as they do without paths. (Light
/// on other materials is weighed as without paths.)
pub(crate) fn path_gain(scene: &Scene) -> f64 {
    match scene.setting.integrator {
        Integrator::Path => 1.0,
        Integrator::Whitted => PI,
    }
}
