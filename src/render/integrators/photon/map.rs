//! A photon map: the flux that arrived at surfaces, and its density around a point (Jensen, "Global
//! Illumination using Photon Maps", 1996).
//!
//! Photons lie in a hashed grid of cells as wide as the kernel, so that the kernel around a point
//! meets eight cells at most. Cells and the photons of each are visited in a fixed order.

use std::f64::consts::FRAC_2_PI;

use glam::DVec3;

/// A photon where it arrived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Photon {
    pub(crate) point: DVec3,
    /// The unit vector toward where it came from.
    pub(crate) toward: [f32; 3],
    /// The geometric unit normal, on the side at which it arrived.
    pub(crate) normal: [f32; 3],
    /// Flux, as a multiple of the map's unit.
    pub(crate) power: [f32; 3],
    /// The bounces by which a path that arrives here meets its light, at least 1.
    pub(crate) bounces: u16,
}

/// Photons by place.
#[derive(Clone, Debug)]
pub(crate) struct PhotonMap {
    /// In the order of their buckets, those of a bucket in the order of their emission.
    photons: Vec<Photon>,
    /// The first photon of each bucket, and the end of the last; a power of two of buckets.
    starts: Vec<u32>,
    /// The radius of the kernel.
    pub(crate) radius: f64,
    /// The unit of photons' powers.
    pub(crate) unit: f64,
}

impl PhotonMap {
    /// Sorts photons, of which there are fewer than 2³², for a kernel with a radius above 0.
    pub(crate) fn new(photons: &[Photon], radius: f64, unit: f64) -> Self {
        let buckets = photons.len().next_power_of_two();
        let mask = buckets - 1;
        let inverse = 0.5 / radius;
        let bucket = |photon: &Photon| hash(cell(photon.point * inverse)) & mask;
        let mut starts = vec![0u32; buckets + 1];
        for photon in photons {
            starts[bucket(photon) + 1] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let mut next = starts.clone();
        let mut sorted = photons.to_vec();
        for photon in photons {
            let place = &mut next[bucket(photon)];
            sorted[*place as usize] = *photon;
            *place += 1;
        }
        Self {
            photons: sorted,
            starts,
            radius,
            unit,
        }
    }

    /// The number of photons.
    pub(crate) fn count(&self) -> usize {
        self.photons.len()
    }

    /// Whether there are no photons.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }

    /// Visits the photons within a radius of a point, up to the kernel's own, each with the value per
    /// unit of area of a kernel of that radius: 2/πr² (1 − d²/r²) at distance d (Epanechnikov).
    pub(crate) fn around(&self, point: DVec3, radius: f64, mut visit: impl FnMut(&Photon, f64)) {
        let square = radius * radius;
        let mask = self.starts.len() - 2;
        let middle = point * (0.5 / self.radius);
        let [low, high] = [cell(middle - 0.5), cell(middle + 0.5)];
        let mut visited = [usize::MAX; 8];
        for corner in 0..8usize {
            let of = |axis: usize| [low, high][corner >> axis & 1][axis];
            let bucket = hash([of(0), of(1), of(2)]) & mask;
            // Different cells may share a bucket, and equal ones do.
            if visited[..corner].contains(&bucket) {
                continue;
            }
            visited[corner] = bucket;
            let [from, to] = [self.starts[bucket], self.starts[bucket + 1]];
            for photon in &self.photons[from as usize..to as usize] {
                let distance = photon.point.distance_squared(point);
                if distance < square {
                    let kernel = FRAC_2_PI / square * (1.0 - distance / square);
                    visit(photon, kernel);
                }
            }
        }
    }
}

/// The cell of a point in units of cells.
fn cell(point: DVec3) -> [i64; 3] {
    point.floor().to_array().map(|along| along as i64)
}

/// Mixes the coordinates of a cell (constants of Vigna's splitmix64).
pub(crate) fn hash(cell: [i64; 3]) -> usize {
    let mut bits = 0u64;
    for along in cell {
        bits = (bits ^ along as u64).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits ^= bits >> 31;
    }
    bits as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photon(point: DVec3, number: usize) -> Photon {
        Photon {
            point,
            toward: [0.0, 0.0, 1.0],
            normal: [0.0, 0.0, 1.0],
            power: [number as f32, 0.0, 0.0],
            bounces: 1,
        }
    }

    /// Points in a cube of width 2 around the origin, low in discrepancy.
    fn points(count: usize) -> Vec<DVec3> {
        let along = |index: usize, root: f64| 2.0 * (index as f64 * root).fract() - 1.0;
        let point = |index| {
            let roots = [2.0f64, 3.0, 5.0].map(f64::sqrt);
            DVec3::from_array(roots.map(|root| along(index, root)))
        };
        (1..=count).map(point).collect()
    }

    /// Those within the radius, each once, with a kernel that integrates to 1 over a disc.
    #[test]
    fn a_search_finds_what_comparing_all_distances_finds() {
        let points = points(3000);
        let photons: Vec<_> = points.iter().zip(0..).map(|(&p, n)| photon(p, n)).collect();
        for radius in [1e-3, 0.05, 0.3, 10.0] {
            let map = PhotonMap::new(&photons, radius, 1.0);
            for &at in points.iter().step_by(97) {
                let mut found = Vec::new();
                map.around(at, radius, |photon, kernel| {
                    let distance = photon.point.distance(at) / radius;
                    let expected = 2.0 / (std::f64::consts::PI * radius * radius);
                    let expected = expected * (1.0 - distance * distance);
                    assert!((kernel - expected).abs() <= 1e-9 * expected.abs() + 1e-12);
                    found.push(photon.power[0] as usize);
                });
                found.sort_unstable();
                let within = |&n: &usize| points[n].distance_squared(at) < radius * radius;
                let expected: Vec<_> = (0..points.len()).filter(within).collect();
                assert_eq!(found, expected, "{radius} at {at}");
            }
        }
    }

    #[test]
    fn no_photons_are_none_anywhere() {
        let map = PhotonMap::new(&[], 1.0, 1.0);
        assert!(map.is_empty());
        map.around(DVec3::ZERO, 1.0, |_, _| unreachable!("there are none"));
    }
}
