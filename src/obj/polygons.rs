//! Polygons that are not the fans they were read as.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::ears;
use geometry::MeshParts;

/// The most polygons in a run, so that several threads look at long ones.
const RUN: u32 = 1 << 12;

/// The work allowed per corner, in nodes that the cutter looks at: stars, combs and spirals of 100,000
/// corners take a third of it. What is left of a polygon that takes more, which crosses
/// itself, is cut without looking.
const EFFORT: usize = 1 << 7;

/// Small polygons may take as much as those of this many corners.
const SMALL: usize = 100;

/// The work allowed for all polygons of a mesh: a few seconds. Each has the same part of it per corner, so
/// that what one takes changes nothing about another, whichever is cut first.
const WHOLE: usize = 1 << 25;

/// A fan may leave its polygon by this fraction of the area, which rounding explains.
const ROUNDING: f64 = 1e-9;

/// The polygons of a mesh that have more than three corners, in the order of their triangles.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygons(Vec<Run>);

/// Consecutive polygons with the same number of corners.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// The first triangle of the first polygon.
    first: u32,
    /// The number of corners of each.
    corners: u32,
    /// The number of polygons.
    count: u32,
}

/// The corners of the triangles of a polygon, by their numbers in it, with the first triangle.
type Patch = (usize, Vec<[u32; 3]>);

impl Polygons {
    /// Adds a polygon of more than three corners whose fan begins with triangle `first`.
    #[inline]
    pub(super) fn push(&mut self, first: usize, corners: usize) {
        let [first, corners] = [first, corners].map(|number| number as u32);
        match self.0.last_mut() {
            Some(run) if run.is_followed_by(first, corners) => run.count += 1,
            _ => self.0.push(Run {
                first,
                corners,
                count: 1,
            }),
        }
    }

    /// Appends the polygons of a part whose first triangle is `first`.
    pub(super) fn append(&mut self, part: &Self, first: usize) {
        self.0.extend(part.0.iter().map(|run| Run {
            first: run.first + first as u32,
            ..*run
        }));
    }

    /// Cuts polygons into other triangles where the fan around their first corner covers what is
    /// outside of them. The indices of the mesh must exist.
    pub(super) fn reshape(&self, parts: &mut MeshParts) {
        let (positions, triangles) = (&parts.positions, &parts.triangles);
        let bent_of = |run: &Run| {
            let is_bent =
                |fan: &Range<usize>| View::of(positions, &triangles[fan.clone()]).is_some();
            run.fans().filter(is_bent)
        };
        let bent: Vec<Range<usize>> = self.0.par_iter().flat_map_iter(bent_of).collect();
        let all = bent.iter().map(|fan| fan.len() + 2).sum();
        let patches = bent.into_par_iter().filter_map(|fan| {
            let first = fan.start;
            let fan = &triangles[fan];
            let view = View::of(positions, fan)?;
            let corners = corners(fan).into_iter();
            let flat: Vec<_> = corners
                .map(|corner| view.flat(positions[corner as usize]))
                .collect();
            let cut = ears::triangles(&flat, &mut effort(flat.len(), all));
            Some((first, cut))
        });
        let patches: Vec<Patch> = patches.collect();
        for (first, cut) in patches {
            for list in [
                &mut parts.triangles,
                &mut parts.uvs.corners,
                &mut parts.normals.corners,
            ] {
                // A list of indices may be empty.
                if let Some(fan) = list.get_mut(first..first + cut.len()) {
                    let corners = corners(fan);
                    for (triangle, cut) in fan.iter_mut().zip(&cut) {
                        *triangle = cut.map(|corner| corners[corner as usize]);
                    }
                }
            }
        }
    }
}

impl Run {
    fn is_followed_by(&self, first: u32, corners: u32) -> bool {
        let end = self.first + self.count * (self.corners - 2);
        (first, corners) == (end, self.corners) && self.count < RUN
    }

    /// The triangles of each polygon.
    fn fans(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (first, length) = (self.first as usize, self.corners as usize - 2);
        let starts = (0..self.count as usize).map(move |number| first + number * length);
        starts.map(move |start| start..start + length)
    }
}

/// The work allowed for a polygon, where those to be cut have `all` corners: at least what any of four
/// corners takes.
pub(super) fn effort(corners: usize, all: usize) -> usize {
    let share = WHOLE as u64 * corners as u64 / all as u64;
    (EFFORT * corners.max(SMALL)).min((share as usize).max(2 * corners))
}

/// How a polygon is seen as one of the plane.
struct View {
    origin: DVec3,
    /// The greatest distance of a corner from the origin along an axis.
    size: f64,
    /// The normal of the polygon.
    normal: DVec3,
}

impl View {
    /// The view of a polygon; `None` if its fan covers only the polygon, as it does wherever that is
    /// convex.
    fn of(positions: &[DVec3], fan: &[[u32; 3]]) -> Option<Self> {
        let position = |corner: u32| positions[corner as usize];
        let origin = position(fan[0][0]);
        let reach = |triangle: &[u32; 3]| {
            let [_, b, c] = triangle.map(|corner| (position(corner) - origin).abs().max_element());
            b.max(c)
        };
        let size = fan.iter().map(reach).fold(0.0, f64::max);
        if size == 0.0 {
            return None;
        }
        // Lengths near 1, so that no product is too large or too small.
        let place = |corner: u32| (position(corner) - origin) / size;
        let cross = |triangle: &[u32; 3]| place(triangle[1]).cross(place(triangle[2]));
        // Twice the area of the polygon.
        let normal: DVec3 = fan.iter().map(cross).sum();
        let outside = -ROUNDING * normal.length_squared();
        let is_covered = fan.iter().all(|part| outside <= cross(part).dot(normal));
        (!is_covered).then_some(Self {
            origin,
            size,
            normal,
        })
    }

    fn flat(&self, position: DVec3) -> DVec2 {
        along(self.normal, (position - self.origin) / self.size)
    }
}

/// The corners of a polygon that is a fan.
fn corners(fan: &[[u32; 3]]) -> Vec<u32> {
    let two = fan.iter().take(1).flat_map(|first| [first[0], first[1]]);
    two.chain(fan.iter().map(|triangle| triangle[2])).collect()
}

/// A point seen along the axis that is nearest to a normal, whose side is in front: what turns
/// counter-clockwise about the normal does so in the plane.
fn along(normal: DVec3, DVec3 { x, y, z }: DVec3) -> DVec2 {
    let size = normal.abs();
    let (u, v, is_seen_from_front) = if size.x >= size.y && size.x >= size.z {
        (y, z, 0.0 < normal.x)
    } else if size.y >= size.z {
        (z, x, 0.0 < normal.y)
    } else {
        (x, y, 0.0 < normal.z)
    };
    if is_seen_from_front {
        DVec2::new(u, v)
    } else {
        DVec2::new(v, u)
    }
}
