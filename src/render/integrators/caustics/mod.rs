//! The light of photons at the surfaces that a path meets.

mod disc;

use glam::{DVec3, Vec3};

use self::disc::{Disc, Extent, SAME};
use super::photon::{Photon, PhotonMap};
use super::probe::Probe;
use super::vertex::Vertex;
use scene::Rgb;

/// The radius of the smallest disc, as a share of the kernel's: a smaller one has fewer photons.
const SMALLEST: f64 = 1.0 / 64.0;

/// The same in a gap. Where a ball touches the ground, every disc is hidden, and light that comes through
/// the ball is as even as beside it.
const SMALLEST_IN_GAP: f64 = 1.0 / 8.0;

/// The light that photons carry to a surface at a bounce, reflected along the path.
#[inline(never)]
pub(crate) fn caustics(probe: &mut Probe<'_>, vertex: &Vertex<'_>, bounce: u32) -> Rgb {
    let Some(map) = probe.photon_map.filter(|map| !map.is_empty()) else {
        return Rgb::ZERO;
    };
    if !vertex.bsdf.scatters() || !probe.component.caustics() {
        return Rgb::ZERO;
    }
    let mut radius = map.radius;
    let mut first = None;
    // Where too little of a disc is left to be measured, a smaller one is taken.
    loop {
        let whole = gathered(probe, (map, radius), vertex, bounce, |_| 1.0);
        let first = *first.get_or_insert(whole);
        if whole == Rgb::ZERO {
            return whole;
        }
        let disc = Disc::new(probe.world, vertex, radius);
        let part = disc.part();
        let is_smallest = |share: f64| radius <= share * map.radius;
        let sum = part.map_or(Some(whole), |part| {
            let is_last = match part.extent() {
                Extent::Measured => true,
                Extent::Hidden { is_gone: true } if is_smallest(SMALLEST_IN_GAP) => {
                    return Some(first);
                }
                Extent::Hidden { .. } => is_smallest(SMALLEST_IN_GAP),
                Extent::Ended => is_smallest(SMALLEST),
            };
            let factor = |photon: &Photon| part.factor(photon);
            is_last.then(|| gathered(probe, (map, radius), vertex, bounce, factor))
        });
        probe.counts.add_shadow_rays(disc.rays());
        if let Some(sum) = sum {
            return sum;
        }
        radius *= 0.5;
    }
}

/// The light of photons within a radius around a surface, each times a factor.
fn gathered(
    probe: &Probe<'_>,
    (map, radius): (&PhotonMap, f64),
    vertex: &Vertex<'_>,
    bounce: u32,
    factor: impl Fn(&Photon) -> f64,
) -> Rgb {
    let Vertex { point, bsdf, .. } = vertex;
    let facing = point.side.turn(point.surface.normal);
    let vector = |stored: [f32; 3]| DVec3::from(Vec3::from(stored));
    let mut sum = Rgb::ZERO;
    map.around(point.surface.point, radius, |photon, kernel| {
        let toward = vector(photon.toward);
        let cosine = toward.dot(facing);
        let is_gathered = bounce + u32::from(photon.bounces) <= probe.depth
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
