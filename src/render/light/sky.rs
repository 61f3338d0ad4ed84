//! Importance sampling of the environment: directions are chosen with a density about proportional
//! to its luminance.
//!
//! The density is that of a bilinear interpolation between the corners of a grid over uv, so that
//! it follows the interpolation of an image exactly. It need not be proportional to radiance to be
//! right, only known.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::material::{LUMINANCE, Textures, environment_place};
use geometry::IsCancelled;
use scene::{Scene, Size, Tinted};

/// Most cells of a grid along an edge; larger images are averaged.
const MOST_CELLS_ACROSS: u32 = 1024;

/// Cells along an edge for textures that are not one image that fills the square.
const COARSE: u32 = 256;

/// Lookups along an edge of each cell of those.
const FINE: u32 = 4;

/// Skies whose luminance varies less than this, as the mean square over the squared mean, are left to
/// BSDF sampling: sampling them costs more than it gains.
const EVEN: f64 = 2.0;

/// An environment from which directions are chosen.
#[derive(Clone, Debug)]
pub(crate) struct Sky {
    made_of: Tinted,
    grid: Option<Grid>,
}

/// A density over the unit square of uv.
#[derive(Clone, Debug)]
struct Grid {
    size: Size,
    /// Luminance at the corners of cells, in rows of width + 1.
    corners: Vec<f32>,
    /// For each row of cells the sums of their weights up to each column.
    columns: Vec<f64>,
    /// The sums of the weights of rows.
    rows: Vec<f64>,
}

impl Sky {
    /// Prepares the environment of a scene, or returns that known if it is the same; `None` once
    /// `cancelled` returns true.
    pub(crate) fn build(
        scene: &Scene,
        textures: &Textures,
        known: Option<(&Arc<Self>, &Textures)>,
        cancelled: IsCancelled<'_>,
    ) -> Option<Arc<Self>> {
        let environment = scene.setting.environment;
        if let Some((sky, before)) = known
            && sky.made_of == environment
            && (environment.texture.is_none() || textures.are_those_of(before))
        {
            return Some(Arc::clone(sky));
        }
        // BSDF sampling finds an even one as well.
        let grid = match environment.texture {
            Some(_) => Grid::build(environment, textures, cancelled)?,
            None => None,
        };
        Some(Arc::new(Self {
            made_of: environment,
            grid,
        }))
    }

    /// An environment that is left to BSDF sampling.
    pub(crate) fn unsampled() -> Self {
        Self {
            made_of: Tinted::default(),
            grid: None,
        }
    }

    /// Whether it is left to BSDF sampling.
    #[inline]
    pub(crate) fn is_unsampled(&self) -> bool {
        self.grid.is_none()
    }

    /// Chooses a direction by two numbers in 0..1.
    pub(crate) fn choose(&self, place: [f64; 2]) -> Option<DVec3> {
        direction(self.grid.as_ref()?.choose(place))
    }

    /// The density of [`Sky::choose`] per steradian; 0 where directions are left to BSDF sampling.
    #[inline(never)]
    pub(crate) fn density(&self, direction: DVec3) -> f64 {
        let Some(grid) = &self.grid else {
            return 0.0;
        };
        let place = environment_place(direction);
        let density = grid.density(place) / spread(direction);
        if density.is_finite() { density } else { 0.0 }
    }
}

impl Grid {
    /// The inner `None` is an environment that is dark or even.
    #[expect(clippy::option_option, reason = "cancelled, and not sampled")]
    fn build(
        environment: Tinted,
        textures: &Textures,
        cancelled: IsCancelled<'_>,
    ) -> Option<Option<Self>> {
        let filling = textures.filling_image(environment);
        let fills = filling.is_some_and(|size| size.width.max(size.height) <= MOST_CELLS_ACROSS);
        let size = match filling {
            Some(size) => Size {
                width: size.width.min(MOST_CELLS_ACROSS),
                height: size.height.min(MOST_CELLS_ACROSS),
            },
            None => Size {
                width: COARSE,
                height: COARSE,
            },
        };
        let look = |place: DVec2| {
            let luminance = textures.colour(environment, place).dot(LUMINANCE);
            if luminance.is_finite() {
                luminance.abs()
            } else {
                0.0
            }
        };
        let cell = 1.0 / DVec2::new(size.width.into(), size.height.into());
        // Of larger images all pixels count, but at most sixteen along an edge of a cell.
        let fine = filling.map_or(FINE, |filling| {
            let pixels = (filling.width / size.width).max(filling.height / size.height);
            (pixels + 1).min(16)
        });
        let corner = |column: u32, row: u32| {
            let at = DVec2::new(column.into(), row.into()) * cell;
            if fills {
                return look(at);
            }
            let mut sum = 0.0;
            for y in 0..fine {
                for x in 0..fine {
                    let aside = (DVec2::new(x.into(), y.into()) + 0.5) / f64::from(fine) - 0.5;
                    sum += look(at + aside * cell);
                }
            }
            sum / f64::from(fine * fine)
        };
        let rows: Vec<Vec<f32>> = (0..=size.height)
            .into_par_iter()
            .map(|row| {
                if row % 16 == 15 && cancelled() {
                    return Vec::new();
                }
                (0..=size.width)
                    .map(|column| corner(column, row) as f32)
                    .collect()
            })
            .collect();
        if cancelled() {
            return None;
        }
        Some(Self::of_corners(size, rows.concat()))
    }

    /// The density of these luminances; `None` if they are dark or even.
    fn of_corners(size: Size, corners: Vec<f32>) -> Option<Self> {
        let mut grid = Self {
            size,
            corners,
            columns: Vec::with_capacity(size.pixels()),
            rows: Vec::with_capacity(size.height as usize),
        };
        let (mut sum, mut square) = (0.0, 0.0);
        let area = 1.0 / size.pixels() as f64;
        let [across, down] = [size.width, size.height].map(middles);
        for row in 0..size.height {
            let mut in_row = 0.0;
            for column in 0..size.width {
                let mean = grid.corners(column, row).iter().sum::<f64>() / 4.0;
                let angle = area * spread_at(across[column as usize], down[row as usize]);
                square += mean * mean * angle;
                in_row += mean * angle;
                grid.columns.push(in_row);
            }
            sum += in_row;
            grid.rows.push(sum);
        }
        let is_uneven = EVEN < square * (4.0 * PI) / (sum * sum);
        (is_uneven && sum.is_finite()).then_some(grid)
    }

    /// The luminances at the corners of a cell: two above, two below.
    fn corners(&self, column: u32, row: u32) -> [f64; 4] {
        let wide = self.size.width as usize + 1;
        let at = row as usize * wide + column as usize;
        [at, at + 1, at + wide, at + wide + 1].map(|at| self.corners[at].into())
    }

    fn weight(&self, column: u32, row: u32) -> f64 {
        let at = row as usize * self.size.width as usize;
        let sums = &self.columns[at..];
        let before = column
            .checked_sub(1)
            .map_or(0.0, |last| sums[last as usize]);
        sums[column as usize] - before
    }

    fn choose(&self, [u, v]: [f64; 2]) -> DVec2 {
        let wide = self.size.width as usize;
        let (row, v) = pick(&self.rows, v);
        let (column, u) = pick(&self.columns[row * wide..(row + 1) * wide], u);
        let [a, b, c, d] = self.corners(column as u32, row as u32);
        let y = along([a + b, c + d], v);
        let x = along([a + y * (c - a), b + y * (d - b)], u);
        let size = DVec2::new(self.size.width.into(), self.size.height.into());
        (DVec2::new(column as f64, row as f64) + DVec2::new(x, y)) / size
    }

    /// The density per area of uv.
    fn density(&self, place: DVec2) -> f64 {
        let size = DVec2::new(self.size.width.into(), self.size.height.into());
        let at = place * size;
        let cell = at.floor().max(DVec2::ZERO).min(size - 1.0);
        let DVec2 { x, y } = (at - cell).clamp(DVec2::ZERO, DVec2::ONE);
        let (column, row) = (cell.x as u32, cell.y as u32);
        let corners = self.corners(column, row);
        let [a, b, c, d] = corners;
        let here = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
        let mean = corners.iter().sum::<f64>() / 4.0;
        let total = self.rows[self.rows.len() - 1];
        if mean == 0.0 {
            return 0.0;
        }
        self.weight(column, row) / total * (size.x * size.y) * (here / mean)
    }
}

/// The middle of each of `count` intervals from −1 to 1, and sin θ / θ at a polar angle of as much of π.
fn middles(count: u32) -> Vec<[f64; 2]> {
    let middle = |at: u32| {
        let aside = (f64::from(2 * at) + 1.0) / f64::from(count) - 1.0;
        let angle = PI * aside.abs();
        let ratio = if angle == 0.0 {
            1.0
        } else {
            libm::sin(angle) / angle
        };
        [aside, ratio]
    };
    (0..count).map(middle).collect()
}

/// [`spread`] at a place of the square, given by [`middles`] for u and v.
fn spread_at([u, across]: [f64; 2], [v, down]: [f64; 2]) -> f64 {
    let (longest, ratio) = if u.abs() < v.abs() {
        (v, down)
    } else {
        (u, across)
    };
    let flat = 0.5 * (u * u + v * v) / (longest * longest);
    // The centre is up or down whatever way it is seen.
    let flat = if flat.is_finite() { flat } else { 1.0 };
    2.0 * PI * PI * ratio / flat
}

/// The interval among increasing sums, from 0, that a number in 0..1 falls in, and where in it.
fn pick(sums: &[f64], number: f64) -> (usize, f64) {
    let sought = number * sums[sums.len() - 1];
    let at = sums
        .partition_point(|&sum| sum <= sought)
        .min(sums.len() - 1);
    let before = at.checked_sub(1).map_or(0.0, |last| sums[last]);
    let place = (sought - before) / (sums[at] - before);
    (
        at,
        if place.is_finite() {
            place.clamp(0.0, 1.0)
        } else {
            0.5
        },
    )
}

/// Maps a number in 0..1 to one with a density that grows linearly from one value to another.
fn along([from, to]: [f64; 2], number: f64) -> f64 {
    if from == to {
        return number;
    }
    let root = (from * from + number * (to * to - from * from))
        .max(0.0)
        .sqrt();
    (number * (from + to) / (from + root)).clamp(0.0, 1.0)
}

/// The unit direction that [`environment_place`] maps to uv; `None` for the centre, which all
/// directions straight up or down map to.
fn direction(place: DVec2) -> Option<DVec3> {
    let aside = 2.0 * (place - 0.5);
    let down = aside.abs().max_element();
    let [x, y] = [
        0.5 * (aside.x + aside.y) / down,
        0.5 * (aside.y - aside.x) / down,
    ];
    let (sine, cosine) = libm::sincos(PI * down);
    let flat = DVec2::new(x, y).try_normalize()?;
    Some((sine * flat).extend(cosine).normalize())
}

/// Steradians per area of uv: of a square ring at a polar angle, π sin θ dθ dφ over the length of
/// its sides, on which the angle grows unevenly.
fn spread(direction: DVec3) -> f64 {
    let DVec3 { x, y, z } = direction;
    let sine = (x * x + y * y).sqrt();
    let angle = libm::atan2(sine, z);
    let sum = x.abs() + y.abs();
    let flat = sine * sine / (sum * sum);
    2.0 * PI * PI * (sine / angle) / flat
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A dim sky with a bright spot, and dark below.
    fn grid(width: u32, height: u32) -> Sky {
        let size = Size { width, height };
        let corner = |at: u32| {
            let (column, row) = (at % (width + 1), at / (width + 1));
            match (column, row) {
                (3, 2) => 500.0,
                _ if width < 2 * column && height < 2 * row => 0.0,
                _ => 0.1 + 0.05 * (column % 3) as f32,
            }
        };
        let corners = (0..(width + 1) * (height + 1)).map(corner).collect();
        Sky {
            made_of: Tinted::default(),
            grid: Grid::of_corners(size, corners),
        }
    }

    /// Directions over the sphere, evenly.
    fn sphere(side: u32) -> impl Iterator<Item = DVec3> {
        let middle = move |i: u32| (f64::from(i) + 0.5) / f64::from(side);
        let places = (0..side).flat_map(move |i| (0..side).map(move |j| [middle(i), middle(j)]));
        places.map(|place| crate::sampling::in_cone(DVec3::X.into(), 2.0, place).into())
    }

    #[test]
    fn directions_and_uv_are_inverse() {
        for toward in sphere(40) {
            let back = direction(environment_place(toward)).expect("not straight up or down");
            assert!((back - toward).length() < 1e-7, "{toward} {back}");
        }
    }

    /// The areas of uv, each times its steradians, sum to the sphere.
    #[test]
    fn the_square_covers_the_sphere() {
        let side = 400;
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
        let places = (0..side * side).map(|i| DVec2::new(middle(i % side), middle(i / side)));
        let angles = places.filter_map(|place| direction(place).map(spread));
        let sum = angles.sum::<f64>() / f64::from(side * side);
        assert!((sum / (4.0 * PI) - 1.0).abs() < 1e-4, "{sum}");
        let middles = middles(side);
        let angles = middles
            .iter()
            .flat_map(|u| middles.iter().map(|v| spread_at(*u, *v)));
        let same = angles.sum::<f64>() / f64::from(side * side);
        assert!((same / sum - 1.0).abs() < 1e-12, "{same}");
    }

    #[test]
    fn the_density_integrates_to_one() {
        for (width, height) in [(8, 8), (16, 5), (7, 12)] {
            let sky = grid(width, height);
            assert!(!sky.is_unsampled());
            let side = 1500;
            let sum: f64 = sphere(side).map(|toward| sky.density(toward)).sum();
            let integral = sum * 4.0 * PI / f64::from(side * side);
            assert!(
                (integral - 1.0).abs() < 2e-3,
                "{width} {height}: {integral}"
            );
        }
    }

    /// Chosen directions are spread by the density: 1 / density has the mean of the solid angle where
    /// the density is above 0, in each octant.
    #[test]
    fn directions_have_their_density() {
        let sky = grid(8, 8);
        let octant = |toward: DVec3| toward.cmplt(DVec3::ZERO).bitmask() as usize;
        let mut found = [0.0; 8];
        let mut expected = [0.0; 8];
        let side = 700u32;
        for i in 0..side * side {
            let place = [i % side, i / side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
            let toward = sky.choose(place).expect("it is sampled");
            found[octant(toward)] += 1.0 / f64::from(side * side);
        }
        for toward in sphere(side) {
            let angle = 4.0 * PI / f64::from(side * side);
            expected[octant(toward)] += sky.density(toward) * angle;
        }
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 4e-3, "{found} {expected}");
        }
    }

    #[test]
    fn even_and_dark_skies_are_unsampled() {
        let size = Size {
            width: 4,
            height: 4,
        };
        for corners in [vec![0.0; 25], vec![1.0; 25]] {
            assert!(Grid::of_corners(size, corners).is_none());
        }
    }

    #[test]
    fn picks_follow_the_sums() {
        let sums = [0.0, 2.0, 2.0, 3.0, 4.0];
        for (number, at, place) in [
            (0.0, 1, 0.0),
            (0.25, 1, 0.5),
            (0.499, 1, 0.998),
            (0.5, 3, 0.0),
            (0.875, 4, 0.5),
        ] {
            let (picked, within) = pick(&sums, number);
            assert_eq!(picked, at);
            assert!((within - place).abs() < 1e-12);
        }
        assert_eq!(along([0.0, 1.0], 0.25), 0.5);
        assert_eq!(along([1.0, 0.0], 0.75), 0.5);
        assert_eq!(along([1.0, 1.0], 0.3), 0.3);
    }
}
