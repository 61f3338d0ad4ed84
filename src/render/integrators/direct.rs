//! Direct light from lights, for single points or eight lanes.

use glam::DVec3;

use crate::light::{Incoming, lights};
use crate::material::Point;
use geometry::lanes::{Eight, Lanes, Row, Simd, Vector};
use geometry::{Ray, Rays, Surfaces};
use scene::{Light, Rgb, Shadows};

/// Points to light, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadingPoints<N> {
    pub(crate) surface: Surfaces<N>,
    /// Shading normals.
    pub(crate) normal: Vector<N>,
    /// Unit vectors toward the viewer.
    pub(crate) view: Vector<N>,
}

/// The geometry of a light relative to points, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightGeometry<N: Lanes> {
    /// Unit vectors toward the light.
    pub(crate) toward: Vector<N>,
    /// Cosines to the shading normals.
    pub(crate) cosine: N,
    /// Cosines between the view and the mirrored light direction.
    pub(crate) mirrored: N,
    /// Whether the light is in front of the surface; otherwise the other fields are meaningless.
    pub(crate) is_lit: N::Mask,
    /// Shadow rays; `None` if the light casts no shadows.
    pub(crate) shadow: Option<Shadow<N>>,
}

/// Shadow rays, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shadow<N> {
    pub(crate) rays: Rays<N>,
    /// Distances up to which occluders count.
    pub(crate) ends: N,
}

impl From<&Point> for ShadingPoints<f64> {
    fn from(point: &Point) -> Self {
        Self {
            surface: point.surface.into(),
            normal: point.normal.into(),
            view: point.view.into(),
        }
    }
}

impl<N: Lanes> LightGeometry<N> {
    /// Relates points to the light that arrives at them.
    #[inline(always)]
    pub(crate) fn new(points: &ShadingPoints<N>, light: &Light, incoming: Incoming<N>) -> Self {
        let toward = incoming.toward;
        let cosine = points.normal.dot(toward);
        let mirrored = points.normal.scaled(cosine.all(2.0) * cosine) - toward;
        Self {
            toward,
            cosine,
            mirrored: mirrored.dot(points.view),
            // The cosine is NaN for a light at the point itself.
            is_lit: cosine.all(0.0).below(cosine),
            shadow: shadow(&points.surface, light, incoming),
        }
    }
}

/// Returns the shadow rays from surfaces to a light; `None` if it casts no shadows.
#[inline(always)]
pub(crate) fn shadow<N: Lanes>(
    surface: &Surfaces<N>,
    light: &Light,
    incoming: Incoming<N>,
) -> Option<Shadow<N>> {
    if light.shadows == Shadows::Off {
        return None;
    }
    Some(shadow_rays(surface, incoming))
}

/// The same for a light that casts shadows.
#[inline(always)]
pub(crate) fn shadow_rays<N: Lanes>(surface: &Surfaces<N>, incoming: Incoming<N>) -> Shadow<N> {
    let toward = incoming.toward;
    let origin = surface.leave(toward);
    let Some(source) = incoming.source else {
        return Shadow {
            rays: Rays {
                origin,
                direction: toward,
            },
            ends: toward.x.all(f64::INFINITY),
        };
    };
    let offset = source - origin;
    let distance = offset.length();
    // The surface that contains the light must not block it: the ray ends before that surface by
    // more than its rounding error.
    let reach = origin.abs().larger(source.abs()).largest();
    let rays = Rays {
        origin,
        direction: offset.over(distance),
    };
    let ends = distance - distance.all(32.0) * reach.larger(distance).ulp();
    Shadow { rays, ends }
}

/// Returns the unoccluded light reflected from a light, given the reflectance `reflected` for light
/// from `toward`; `None` if it is zero.
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

/// What remains of unshadowed light, given the transmittance of its shadow ray.
pub(crate) fn shadowed(light: Rgb, transmittance: f64) -> Rgb {
    // Occluded light adds nothing, even if infinite.
    if transmittance == 0.0 {
        Rgb::ZERO
    } else {
        transmittance * light
    }
}

impl<S: Simd> Shadow<Eight<S>> {
    /// Stores them in rows.
    #[inline(always)]
    pub(crate) fn store(self) -> Shadow<Row> {
        Shadow {
            rays: self.rays.store(),
            ends: self.ends.into(),
        }
    }
}

impl Shadow<Row> {
    /// Returns the shadow ray in a lane.
    #[inline]
    pub(crate) fn lane(&self, lane: usize) -> Shadow<f64> {
        Shadow {
            rays: (&self.rays.get(lane)).into(),
            ends: self.ends.0[lane],
        }
    }
}

impl Shadow<f64> {
    /// The ray.
    pub(crate) fn ray(&self) -> Ray {
        Ray {
            origin: self.rays.origin.into(),
            direction: self.rays.direction.into(),
        }
    }
}
