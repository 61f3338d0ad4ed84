//! A projection map: the directions from a light in which a photon may first meet a mirror or a
//! boundary (Jensen, "Global Illumination using Photon Maps", 1996).
//!
//! Directions are divided into cells of equal solid angle; those in which a target may lie are
//! chosen uniformly, so that the density is the same in all of them.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::sampling::warp;
use geometry::Aabb;

/// The cells of directions in which targets may lie.
#[derive(Clone, Debug)]
pub(super) struct Aim {
    /// The axis toward which longitudes are 0, that of 90°, and the pole.
    frame: [DVec3; 3],
    /// Rows of cells, of equal height from pole to pole; there are twice as many columns.
    rows: u32,
    /// The numbers of the cells, in ascending order.
    cells: Vec<u32>,
}

impl Aim {
    /// Finds the cells in which boxes may lie as seen from any point of a sphere. `rows` is above 0.
    pub(super) fn new(centre: DVec3, radius: f64, targets: &[Aabb], rows: u32) -> Self {
        let bounded = targets.iter().filter(|target| target.is_bounded());
        let toward = bounded.map(|target| (target.centre() - centre).normalize_or_zero());
        // Cells are narrowest away from the poles.
        let axis = toward.sum::<DVec3>().normalize_or(DVec3::Z);
        let [pole, across] = warp::basis(axis);
        let mut aim = Self {
            frame: [axis, across, pole],
            rows,
            cells: Vec::new(),
        };
        let mut is_met = vec![false; (2 * rows * rows) as usize];
        for target in targets {
            aim.mark(centre, radius, target, &mut is_met);
        }
        let cells = is_met.iter().zip(0..).filter(|(is_met, _)| **is_met);
        aim.cells = cells.map(|(_, cell)| cell).collect();
        aim
    }

    /// The solid angle of all cells, in steradians.
    pub(super) fn solid_angle(&self) -> f64 {
        let all = 2.0 * f64::from(self.rows) * f64::from(self.rows);
        4.0 * PI * (self.cells.len() as f64 / all)
    }

    /// Chooses a direction uniformly in the cells, of which there must be one, by three numbers in
    /// 0..1.
    pub(super) fn choose(&self, [number, u, v]: [f64; 3]) -> DVec3 {
        let chosen = (number * self.cells.len() as f64) as usize;
        let cell = self.cells[chosen.min(self.cells.len() - 1)];
        self.direction(cell, [u, v])
    }

    /// A direction in a cell, by its height and its longitude as fractions.
    fn direction(&self, cell: u32, [u, v]: [f64; 2]) -> DVec3 {
        let columns = 2 * self.rows;
        let (row, column) = (f64::from(cell / columns), f64::from(cell % columns));
        let height = 1.0 - 2.0 * (row + u) / f64::from(self.rows);
        let around = (1.0 - height * height).max(0.0).sqrt();
        let (sine, cosine) = libm::sincos(TAU * (column + v) / f64::from(columns));
        let [axis, across, pole] = self.frame;
        (around * (cosine * axis + sine * across) + height * pole).normalize()
    }

    /// Marks the cells in which a box may lie.
    fn mark(&self, centre: DVec3, radius: f64, target: &Aabb, is_met: &mut [bool]) {
        let offset = target.centre() - centre;
        let (distance, half) = (offset.length(), target.half_diagonal());
        // Whoever is inside the sphere around the box sees it everywhere.
        let sine = (half + radius) / distance;
        if !(target.is_bounded() && sine < 1.0) {
            is_met.fill(true);
            return;
        }
        let angle = libm::asin(sine);
        let toward = offset / distance;
        let columns = (2 * self.rows) as usize;
        for (row, cells) in is_met.chunks_mut(columns).enumerate() {
            let first = (row * columns) as u32;
            let middle = self.direction(first, [0.5; 2]);
            let corners = [[0.0, 0.0], [1.0, 0.0]];
            // No point of a cell is farther from its middle than its corners; a little more
            // covers rounding.
            let reach = corners.map(|corner| between(middle, self.direction(first, corner)));
            let reach = 1e-6 + reach[0].max(reach[1]);
            let least = libm::cos((angle + reach).min(PI));
            let margin = radius + (distance + half) * reach;
            let grown = Aabb {
                min: target.min - margin,
                max: target.max + margin,
            };
            for (cell, is_met) in (first..).zip(cells) {
                let middle = self.direction(cell, [0.5; 2]);
                *is_met = *is_met || least <= middle.dot(toward) && meets(&grown, centre, middle);
            }
        }
    }
}

/// The angle between unit vectors.
fn between(a: DVec3, b: DVec3) -> f64 {
    2.0 * libm::asin((0.5 * (a - b).length()).min(1.0))
}

/// Whether a ray meets a box that it may start in.
fn meets(bounds: &Aabb, origin: DVec3, direction: DVec3) -> bool {
    let inverse = direction.map(|along| 1.0 / if along == 0.0 { 1e-300 } else { along });
    let [first, second] = [bounds.min, bounds.max].map(|corner| (corner - origin) * inverse);
    let enters = first.min(second).max_element();
    let leaves = first.max(second).min_element();
    enters.max(0.0) <= leaves
}

#[cfg(test)]
mod tests {
    use super::*;

    fn middle(number: u32, count: u32) -> f64 {
        (f64::from(number) + 0.5) / f64::from(count)
    }

    /// Directions from points of the light to points of the boxes must be in a cell.
    #[test]
    fn no_direction_to_a_target_is_missed() {
        let boxes = [
            ([0.0, 0.0, -4.0], [1.0, 1.0, 1.0]),
            ([3.0, -2.0, 5.0], [0.0, 2.0, 0.1]),
            ([-40.0, 0.0, 1.0], [10.0, 0.5, 0.5]),
        ];
        for ((at, half), radius) in boxes
            .into_iter()
            .flat_map(|target| [(target, 0.0), (target, 0.5)])
        {
            let (at, half) = (DVec3::from(at), DVec3::from(half));
            let target = Aabb {
                min: at - half,
                max: at + half,
            };
            for rows in [1, 8, 64] {
                let aim = Aim::new(DVec3::ZERO, radius, &[target], rows);
                let [axis, across, pole] = aim.frame;
                for number in 0..4000 {
                    let part = |root: f64| 2.0 * (f64::from(number) * root.sqrt()).fract() - 1.0;
                    let end = at + half * DVec3::new(part(2.0), part(3.0), part(5.0));
                    let start = DVec3::new(part(7.0), part(11.0), part(13.0));
                    let toward = (end - radius * start.normalize_or_zero()).normalize();
                    let height = 0.5 * (1.0 - toward.dot(pole));
                    let turn = libm::atan2(toward.dot(across), toward.dot(axis)) / TAU;
                    let row = (height * f64::from(rows)) as u32;
                    let column = (turn.rem_euclid(1.0) * f64::from(2 * rows)) as u32;
                    let cell = row.min(rows - 1) * 2 * rows + column.min(2 * rows - 1);
                    let found = aim.cells.binary_search(&cell);
                    assert!(found.is_ok(), "{toward} in {rows} rows, radius {radius}");
                }
                assert!(aim.solid_angle() <= 4.0 * PI);
            }
        }
    }

    /// Uniform in the cells: the mean of a function over them equals that over fine midpoints, and a
    /// distant box takes little more than its own solid angle.
    #[test]
    fn directions_are_uniform_in_the_cells() {
        let target = Aabb {
            min: DVec3::new(-1.0, -1.0, -11.0),
            max: DVec3::new(1.0, 1.0, -10.0),
        };
        let aim = Aim::new(DVec3::ZERO, 0.0, &[target], 128);
        assert!(aim.solid_angle() < 2.0 * 0.04, "{}", aim.solid_angle());
        let mut mean = DVec3::ZERO;
        for number in 0..64 * 64 {
            let (i, j) = (number / 64, number % 64);
            let part = [
                (f64::from(number) * 0.618_034).fract(),
                middle(i, 64),
                middle(j, 64),
            ];
            mean += aim.choose(part) / 4096.0;
        }
        assert!((mean.normalize() + DVec3::Z).length() < 0.02, "{mean}");
    }

    #[test]
    fn a_light_within_a_target_sees_it_everywhere() {
        let all = Aabb {
            min: DVec3::splat(-1.0),
            max: DVec3::splat(1.0),
        };
        let aim = Aim::new(DVec3::ZERO, 0.0, &[all], 4);
        assert_eq!(aim.cells.len(), 32);
        let none = Aim::new(DVec3::ZERO, 0.0, &[], 4);
        assert_eq!(none.solid_angle(), 0.0);
    }
}
