//! The light of photons at the surfaces that a path meets.

use glam::{DVec3, Vec3};

use super::path::Vertex;
use super::probe::Probe;
use crate::scene::Rgb;

/// The least cosine between the normals where a photon arrived and where it is looked for: beyond,
/// it lies on another surface.
const SAME: f64 = 0.7;

impl<C: Fn() -> bool> Probe<'_, C> {
    /// The light that photons carry to a surface at a bounce, reflected along the path.
    #[inline(never)]
    pub(super) fn caustics(&self, vertex: &Vertex<'_>, bounce: u32) -> Rgb {
        let Vertex { point, bsdf, .. } = vertex;
        let mut sum = Rgb::ZERO;
        let Some(map) = self.photon_map.filter(|map| !map.is_empty()) else {
            return sum;
        };
        if !bsdf.scatters() || !self.gather.caustics() {
            return sum;
        }
        let facing = point.side.turn(point.surface.normal);
        let vector = |stored: [f32; 3]| DVec3::from(Vec3::from(stored));
        map.around(point.surface.point, |photon, kernel| {
            let toward = vector(photon.toward);
            let cosine = toward.dot(facing);
            let is_gathered = bounce + u32::from(photon.bounces) <= self.depth
                && 0.0 < cosine
                && SAME <= facing.dot(vector(photon.normal));
            if is_gathered {
                let scattered = bsdf.lobes.scatter(point, toward).value;
                let sent_back = scattered + bsdf.lobes.highlight(point, toward);
                sum += sent_back * vector(photon.power) * (kernel / cosine);
            }
        });
        map.unit * sum
    }
}
