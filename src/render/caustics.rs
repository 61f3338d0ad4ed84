//! The light of photons at the surfaces that a path meets.

use glam::{DVec3, Vec3};

use super::disc::{Disc, SAME};
use super::path::Vertex;
use super::photon_map::{Photon, PhotonMap};
use super::probe::Probe;
use crate::scene::Rgb;

impl<C: Fn() -> bool> Probe<'_, C> {
    /// The light that photons carry to a surface at a bounce, reflected along the path.
    #[inline(never)]
    pub(super) fn caustics(&mut self, vertex: &Vertex<'_>, bounce: u32) -> Rgb {
        let Some(map) = self.photon_map.filter(|map| !map.is_empty()) else {
            return Rgb::ZERO;
        };
        if !vertex.bsdf.scatters() || !self.gather.caustics() {
            return Rgb::ZERO;
        }
        let whole = self.gathered(map, vertex, bounce, |_| 1.0);
        if whole == Rgb::ZERO {
            return whole;
        }
        let disc = Disc::new(self.world, &vertex.point, map.radius);
        let part = disc.part();
        let sum = part.map_or(whole, |part| {
            self.gathered(map, vertex, bounce, |photon| part.factor(photon))
        });
        let rays = disc.rays();
        self.counts.rays += rays;
        self.counts.shadow_rays += rays;
        sum
    }

    /// The light of photons around a surface, each times a factor.
    fn gathered(
        &self,
        map: &PhotonMap,
        vertex: &Vertex<'_>,
        bounce: u32,
        factor: impl Fn(&Photon) -> f64,
    ) -> Rgb {
        let Vertex { point, bsdf, .. } = vertex;
        let facing = point.side.turn(point.surface.normal);
        let vector = |stored: [f32; 3]| DVec3::from(Vec3::from(stored));
        let mut sum = Rgb::ZERO;
        map.around(point.surface.point, |photon, kernel| {
            let toward = vector(photon.toward);
            let cosine = toward.dot(facing);
            let is_gathered = bounce + u32::from(photon.bounces) <= self.depth
                && 0.0 < cosine
                && SAME <= facing.dot(vector(photon.normal));
            if is_gathered {
                let scattered = bsdf.lobes.scatter(point, toward).value;
                let sent_back = scattered + bsdf.lobes.highlight(point, toward);
                let kernel = factor(photon) * kernel;
                sum += sent_back * vector(photon.power) * (kernel / cosine);
            }
        });
        map.unit * sum
    }
}
