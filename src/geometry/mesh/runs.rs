//! The triangles of a mesh in the order in which they are tested. Most of those that a line misses are
//! rejected by vertices in single precision: eight triangles at once for a single line, or eight lines
//! at once for a triangle.
//!
//! Rejected: copies of the vertices in double precision, for exact tests in lanes (rays through a million
//! triangles took a tenth to a fifth less time, but the copies take 36 bytes more per triangle, and
//! the page faults for them cost as much as a frame gains); vertex indices beside the rows (12 bytes
//! more per triangle; scattered rays, which wait for memory, take an eighth less time, others no less);
//! reading the vertices of all candidates of a run before the first is tested, to overlap the waits (no
//! less time).

use std::ops::Range;

use super::{Mesh, MeshLine};
use crate::lanes::{Rows, Run, Several, Simd, Singles, each_bit};
use crate::triangle::Roughly;
use crate::{Hit, IsCancelled};

/// Three coordinates of three vertices.
const NUMBERS: usize = 9;

/// The triangles of a mesh, and their vertices in unit space, in an order in which they are tested in
/// runs.
#[derive(Debug)]
pub struct TriangleRuns(Rows<f32, NUMBERS>);

/// The triangles of a run.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRun<'r> {
    vertices: Run<'r, f32, NUMBERS>,
    /// Their numbers.
    pub(super) triangles: &'r [u32],
}

impl TriangleRuns {
    /// Stores the triangles with these numbers. The runs are consecutive parts of that order, of at
    /// most eight triangles each. `None` once `cancelled` returns true.
    pub fn new(
        mesh: &Mesh,
        order: &[u32],
        runs: &[Range<usize>],
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        let numbers = |place: usize| {
            let [a, b, c] = mesh.vertices(order[place]);
            let [a, b, c] = [a.as_vec3(), b.as_vec3(), c.as_vec3()];
            [a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z]
        };
        Rows::new(runs, numbers, cancelled).map(Self)
    }

    /// The run with these places in `order`, both as given to [`TriangleRuns::new`].
    #[inline(always)]
    pub fn run<'r>(&'r self, order: &'r [u32], places: Range<usize>) -> TriangleRun<'r> {
        TriangleRun {
            vertices: self.0.run(&places),
            triangles: &order[places],
        }
    }
}

impl TriangleRun<'_> {
    /// A mask of the lines that may cross the triangle at a place of the run: all but those that surely
    /// do not.
    #[inline(always)]
    pub(super) fn may_cross_at<S: Simd>(&self, lines: &Roughly<S>, at: usize) -> u32 {
        lines.may_cross([
            self.corner(lines, 0, at),
            self.corner(lines, 3, at),
            self.corner(lines, 6, at),
        ])
    }

    /// A mask of the triangles that a line, in all lanes, may cross.
    #[inline(always)]
    pub(crate) fn may_be_crossed_by<S: Simd>(&self, line: &RoughLine<S>) -> u32 {
        let line = &line.0;
        let may_cross = line.may_cross([
            self.corners(line, 0),
            self.corners(line, 3),
            self.corners(line, 6),
        ]);
        may_cross & ((1 << self.triangles.len()) - 1)
    }

    /// The vertices of all triangles whose first coordinates are in a row.
    #[inline(always)]
    fn corners<S: Simd>(&self, line: &Roughly<S>, row: usize) -> [Singles<S>; 3] {
        let (simd, [i, j, k]) = (line.simd(), line.axes);
        [
            self.vertices.row(simd, row + i),
            self.vertices.row(simd, row + j),
            self.vertices.row(simd, row + k),
        ]
    }

    /// The vertex of the triangle at a place, in all lanes.
    #[inline(always)]
    fn corner<S: Simd>(&self, line: &Roughly<S>, row: usize, at: usize) -> [Singles<S>; 3] {
        let (simd, [i, j, k]) = (line.simd(), line.axes);
        [
            Several::splat(simd, self.vertices.number(row + i, at)),
            Several::splat(simd, self.vertices.number(row + j, at)),
            Several::splat(simd, self.vertices.number(row + k, at)),
        ]
    }
}

impl MeshLine<'_> {
    /// Runs [`MeshLine::meet`] for the triangles of a run, given the line by [`MeshLine::roughly`].
    #[inline(always)]
    pub fn meet_run<S: Simd>(
        &self,
        roughly: &RoughLine<S>,
        run: &TriangleRun<'_>,
        limit: f64,
        nearest: &mut Option<Hit>,
    ) -> f64 {
        let mut farthest = nearest.map_or(limit, |hit| hit.t);
        for at in each_bit(run.may_be_crossed_by(roughly)) {
            farthest = self.meet(run.triangles[at], limit, nearest);
        }
        farthest
    }

    /// Prepares the line for tests in single precision.
    #[inline(always)]
    pub fn roughly<S: Simd>(&self, simd: S) -> RoughLine<S> {
        RoughLine(Roughly::all(simd, self.sheared()))
    }
}

/// A line prepared for tests in single precision.
#[derive(Clone, Copy, Debug)]
pub struct RoughLine<S: Simd>(Roughly<S>);
