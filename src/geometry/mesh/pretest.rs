//! Rejects most of the triangles that a line misses, by vertices in single precision: eight triangles
//! at once for a single line, or eight lines at once for a triangle.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::{Mesh, MeshLine};
use crate::geometry::lanes::{Simd, SimdBase, Singles, WIDTH};
use crate::geometry::triangle::Roughly;

/// Numbers per triangle: three coordinates of three vertices.
const NUMBERS: usize = 9;

/// Triangles filled by one thread at a time.
const CHUNK: usize = 1 << 12;

/// The vertices of a mesh's triangles in unit space, in an order in which they are tested in runs.
///
/// A run of n triangles is stored as nine rows of n: the first coordinates of their first vertices, the
/// second ones, and so on. Rows are loaded whole, with what follows them.
#[derive(Debug)]
pub struct Pretest(Vec<f32>);

impl Pretest {
    /// Stores the triangles with these numbers. The runs are consecutive parts of that order, of at
    /// most eight triangles each. `None` once `cancelled` returns true.
    pub fn new(
        mesh: &Mesh,
        order: &[u32],
        runs: &[Range<usize>],
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let mut numbers = vec![0.0; NUMBERS * order.len() + WIDTH];
        let mut rest = &mut numbers[..];
        let mut start = 0;
        let mut chunks = Vec::new();
        for runs in runs.chunks(CHUNK / WIDTH) {
            let end = runs.last().map_or(start, |run| run.end);
            let (own, after) = rest.split_at_mut(NUMBERS * (end - start));
            chunks.push((own, start, runs));
            (rest, start) = (after, end);
        }
        let filled = chunks.into_par_iter().map(|(numbers, start, runs)| {
            for run in runs {
                let rows = &mut numbers[NUMBERS * (run.start - start)..NUMBERS * (run.end - start)];
                for (place, &triangle) in order[run.clone()].iter().enumerate() {
                    let corners = mesh.vertices(triangle);
                    let coordinates = corners.iter().flat_map(DVec3::to_array);
                    for (row, coordinate) in rows.chunks_mut(run.len()).zip(coordinates) {
                        row[place] = coordinate as f32;
                    }
                }
            }
            (!cancelled()).then_some(())
        });
        filled.collect::<Option<()>>()?;
        Some(Self(numbers))
    }

    /// A mask of the triangles of a run that a line may meet by [`MeshLine::meet`]: all but those that
    /// it surely misses.
    #[inline(always)]
    pub fn of_line<S: Simd>(&self, line: &RoughLine<S>, run: &Range<usize>) -> u32 {
        let rows = Rows {
            simd: line.0.simd(),
            numbers: &self.0[NUMBERS * run.start..],
            length: run.len(),
        };
        let corners = [rows.corners(0), rows.corners(3), rows.corners(6)];
        line.0.may_cross(corners) & ((1 << run.len()) - 1)
    }

    /// A mask of the lines that may meet the triangle at a place of a run.
    #[inline(always)]
    pub(super) fn of_triangle<S: Simd>(
        &self,
        lines: &Roughly<S>,
        run: &Range<usize>,
        place: usize,
    ) -> u32 {
        let rows = Rows {
            simd: lines.simd(),
            numbers: &self.0[NUMBERS * run.start..NUMBERS * run.end],
            length: run.len(),
        };
        let at = place - run.start;
        lines.may_cross([rows.corner(0, at), rows.corner(3, at), rows.corner(6, at)])
    }
}

/// The rows of a run.
#[derive(Clone, Copy)]
struct Rows<'n, S: Simd> {
    simd: S,
    numbers: &'n [f32],
    length: usize,
}

impl<S: Simd> Rows<'_, S> {
    /// The vertices of all triangles whose first coordinates are in a row.
    #[inline(always)]
    fn corners(self, row: usize) -> [Singles<S>; 3] {
        [self.row(row), self.row(row + 1), self.row(row + 2)]
    }

    #[inline(always)]
    fn row(self, row: usize) -> Singles<S> {
        let row = &self.numbers[row * self.length..];
        let row = row.first_chunk();
        Singles::load_array(self.simd, *row.expect("the last row is followed by more"))
    }

    /// The vertex of the triangle at a place of the run, in all lanes.
    #[inline(always)]
    fn corner(self, row: usize, at: usize) -> [Singles<S>; 3] {
        [
            self.number(row, at),
            self.number(row + 1, at),
            self.number(row + 2, at),
        ]
    }

    #[inline(always)]
    fn number(self, row: usize, at: usize) -> Singles<S> {
        Singles::splat(self.simd, self.numbers[row * self.length + at])
    }
}

/// A line prepared for [`Pretest::of_line`].
#[derive(Clone, Copy, Debug)]
pub struct RoughLine<S: Simd>(Roughly<S>);

impl MeshLine<'_> {
    /// Prepares the line for [`Pretest::of_line`].
    #[inline(always)]
    pub fn roughly<S: Simd>(&self, simd: S) -> RoughLine<S> {
        RoughLine(Roughly::all(simd, self.sheared()))
    }
}
