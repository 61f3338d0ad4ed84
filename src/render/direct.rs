//! Light that comes from lights straight to points, one by one or eight side by side.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lights::{self, Incoming};
use super::probe::{Point, Probe};
use crate::geometry::lanes::{Lanes, Vector};
use crate::geometry::{Ray, Rays, Surfaces};
use crate::scene::{Light, Rgb, Shadows};

/// Points that light is asked for, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Points<N> {
    pub(crate) surface: Surfaces<N>,
    /// The normals to shade with.
    pub(crate) normal: Vector<N>,
    /// Unit vectors toward where the rays came from.
    pub(crate) view: Vector<N>,
}

/// How a light stands to points, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facing<N: Lanes> {
    /// Unit vectors toward where its light comes from.
    pub(crate) toward: Vector<N>,
    /// The cosines to the normals.
    pub(crate) cosine: N,
    /// The cosines between the view and where a mirror would send its light.
    pub(crate) mirrored: N,
    /// Whether it is before the surface: the rest is of no use where it is not.
    pub(crate) is_lit: N::Mask,
    /// The ways on which something may keep its light away.
    pub(crate) shadow: Option<Shadow<N>>,
}

/// Ways to a light, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shadow<N> {
    pub(crate) rays: Rays<N>,
    /// How far along them something is in the way.
    pub(crate) ends: N,
}

impl From<&Point> for Points<f64> {
    fn from(point: &Point) -> Self {
        Self {
            surface: point.surface.into(),
            normal: point.normal.into(),
            view: point.view.into(),
        }
    }
}

impl<N: Lanes> Facing<N> {
    /// How a light stands to points that its light comes to.
    #[inline(always)]
    pub(crate) fn new(points: &Points<N>, light: &Light, incoming: Incoming<N>) -> Self {
        let toward = incoming.toward;
        let cosine = points.normal.dot(toward);
        let mirrored = points.normal.scaled(cosine.all(2.0) * cosine) - toward;
        Self {
            toward,
            cosine,
            mirrored: mirrored.dot(points.view),
            // A light that stands at the point itself has a cosine that is NaN.
            is_lit: cosine.all(0.0).below(cosine),
            shadow: shadow(&points.surface, light, incoming),
        }
    }
}

/// The ways from surfaces to a light, unless nothing keeps that light from others.
#[inline(always)]
pub(crate) fn shadow<N: Lanes>(
    surface: &Surfaces<N>,
    light: &Light,
    incoming: Incoming<N>,
) -> Option<Shadow<N>> {
    if light.shadows == Shadows::Off {
        return None;
    }
    let toward = incoming.toward;
    let origin = surface.leave(toward);
    let Some(source) = incoming.source else {
        return Some(Shadow {
            rays: Rays {
                origin,
                direction: toward,
            },
            ends: toward.x.all(f64::INFINITY),
        });
    };
    let way = source - origin;
    let distance = way.length();
    // The surface that a light lies on does not block it: the way ends before that surface, by
    // as much as rounding may displace it.
    let reach = origin.abs().larger(source.abs()).largest();
    let rays = Rays {
        origin,
        direction: way.over(distance),
    };
    let ends = distance - distance.all(32.0) * reach.larger(distance).ulp();
    Some(Shadow { rays, ends })
}

/// What a point sends back of a light's light if nothing is in the way, when it sends back a part
/// of what comes from `toward`; `None` if that is nothing.
#[inline]
pub(crate) fn sent_back(
    light: &Light,
    point: DVec3,
    toward: impl FnOnce() -> DVec3,
    reflected: Rgb,
) -> Option<Rgb> {
    if reflected == Rgb::ZERO {
        return None;
    }
    let attenuation = lights::attenuation(light, point, toward());
    (attenuation != 0.0).then(|| reflected * (attenuation * light.colour))
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// What a surface sends back of a light's light, from its middle if it has a size: `reflected`
    /// gives how much of what comes from where it stands.
    pub(crate) fn direct(
        &mut self,
        point: &Point,
        light: &Light,
        reflected: impl FnOnce(&Facing<f64>) -> Rgb,
    ) -> Rgb {
        let place = point.surface.point;
        let Some(incoming) = lights::incoming(light, place.into()) else {
            return Rgb::ZERO;
        };
        let facing = Facing::new(&point.into(), light, incoming);
        if !facing.is_lit {
            return Rgb::ZERO;
        }
        let reflected = reflected(&facing);
        match sent_back(light, place, || facing.toward.into(), reflected) {
            Some(unblocked) => self.visibility(facing.shadow) * unblocked,
            None => Rgb::ZERO,
        }
    }

    /// The part of light that passes along a way; all of it without one.
    pub(crate) fn visibility(&mut self, shadow: Option<Shadow<f64>>) -> f64 {
        let Some(Shadow { rays, ends }) = shadow else {
            return 1.0;
        };
        self.counts.rays += 1;
        self.counts.shadow_rays += 1;
        let ray = Ray {
            origin: rays.origin.into(),
            direction: rays.direction.into(),
        };
        let transmittance = self.world.transmittance(&ray, ends, &mut self.crossed);
        self.touched |= self.crossed.touched.first().copied().unwrap_or_default();
        transmittance
    }
}
