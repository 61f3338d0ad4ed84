//! Constructive solid geometry: union, intersection and difference.
//!
//! S. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18 (1982):
//! each operand cuts a line into spans, and the operation is applied to the spans. Operations are
//! regularised: results have no parts of zero thickness.
//!
//! Most lines cross no two surfaces at nearly the same point. They are evaluated side by side, on
//! unordered lists ([`side_by_side`]), by a flat [`program`]; the others one by one, with coincident
//! boundaries resolved ([`exact`]).

mod exact;
mod merge;
mod program;
mod side_by_side;
mod slopes;
mod uncut;

use std::ptr;

use self::program::Program;
use super::lanes::{Eight, Simd, Vector, WIDTH, bits, mask};
use super::{Aabb, Chart, Crossings, Hit, Hits, Ray, Rays, Solid, Spans, Surface, Surfaces, ulp};

/// A set operation on two closed solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// All points in either.
    Union,
    /// All points in both.
    Intersection,
    /// All points in the first and not in the second.
    Difference,
}

/// A node in a list: a solid, or an operation on earlier nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A single solid.
    Leaf {
        /// The solid.
        solid: Solid,
        /// The owner's tag for it.
        tag: u32,
    },
    /// An operation on two nodes.
    Operation {
        /// The operation.
        operation: Operation,
        /// The index of the first operand, below its own.
        first: u32,
        /// The index of the second operand, below its own.
        second: u32,
    },
}

/// Solids combined by set operations. Its parts are those of the solids, each as it is or turned
/// inside out.
#[derive(Clone, Debug, PartialEq)]
pub struct Csg {
    steps: Vec<Prepared>,
    leaves: Vec<Leaf>,
    /// The number of steps that are operands more than once.
    shared: u32,
    /// The steps as instructions, if none is shared and all leaves are simple solids, hit in at most
    /// one span.
    program: Option<Program>,
    bounds: Aabb,
    /// The largest magnitude of the leaves.
    magnitude: f64,
}

/// A node prepared for intersection.
#[derive(Clone, Debug, PartialEq)]
struct Prepared {
    /// The box, widened by more than a leaf's rounding; `None` if other boxes make it redundant.
    bounds: Option<Aabb>,
    kind: PreparedKind,
    /// The index among the shared steps, if it is an operand more than once.
    shared: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PreparedKind {
    /// The index of a leaf.
    Leaf(u32),
    /// An operation on two steps.
    Operation(Operation, [u32; 2]),
}

#[derive(Clone, Debug, PartialEq)]
struct Leaf {
    solid: Solid,
    tag: u32,
    /// The index of its first part among the parts of all leaves.
    first_part: u32,
    /// The largest finite coordinate of its box.
    magnitude: f64,
}

impl Csg {
    /// Creates the solid of the last node. Operands precede their users; a shared operand is
    /// evaluated once. `nodes` must not be empty, and the last must use all others.
    pub fn new(nodes: Vec<Node>) -> Self {
        let mut uses = vec![0_u32; nodes.len()];
        for node in &nodes {
            if let Node::Operation { first, second, .. } = node {
                uses[*first as usize] += 1;
                uses[*second as usize] += 1;
            }
        }
        let mut csg = Self {
            steps: Vec::with_capacity(nodes.len()),
            leaves: Vec::new(),
            shared: 0,
            program: None,
            bounds: Aabb::EMPTY,
            magnitude: 0.0,
        };
        let mut boxes: Vec<Aabb> = Vec::with_capacity(nodes.len());
        let mut parts = 0;
        for (node, uses) in nodes.into_iter().zip(uses) {
            let (kind, bounds) = match node {
                Node::Leaf { solid, tag } => {
                    let bounds = solid.bounds();
                    let leaf = Leaf {
                        first_part: parts,
                        magnitude: bounds.magnitude(),
                        solid,
                        tag,
                    };
                    parts += leaf.solid.parts();
                    csg.magnitude = csg.magnitude.max(leaf.magnitude);
                    csg.leaves.push(leaf);
                    (PreparedKind::Leaf(csg.leaves.len() as u32 - 1), bounds)
                }
                Node::Operation {
                    operation,
                    first,
                    second,
                } => {
                    let [a, b] = [boxes[first as usize], boxes[second as usize]];
                    let bounds = match operation {
                        Operation::Union => a.union(b),
                        Operation::Intersection => a.intersection(b),
                        Operation::Difference => a,
                    };
                    (PreparedKind::Operation(operation, [first, second]), bounds)
                }
            };
            let shared = (1 < uses).then_some(csg.shared);
            csg.shared += u32::from(shared.is_some());
            boxes.push(bounds);
            csg.bounds = bounds;
            csg.steps.push(Prepared {
                bounds: Some(widened(bounds)),
                kind,
                shared,
            });
        }
        csg.drop_redundant_boxes(&boxes);
        if csg.shared == 0 && csg.solids().all(Solid::is_simple) {
            csg.program = Some(Program::new(&csg.steps));
        }
        csg
    }

    /// Drops boxes that are surely hit by a line that hits another: a difference has the box of its
    /// first operand, and the overlap of two boxes lies in both.
    fn drop_redundant_boxes(&mut self, boxes: &[Aabb]) {
        for index in (0..self.steps.len()).rev() {
            let PreparedKind::Operation(operation, operands) = self.steps[index].kind else {
                continue;
            };
            let redundant: &[u32] = match operation {
                Operation::Union => &[],
                Operation::Intersection if boxes[index].is_empty() => &[],
                Operation::Intersection => &operands,
                Operation::Difference => match self.steps[index].bounds.take() {
                    Some(_) => &[],
                    None => &operands[..1],
                },
            };
            for &operand in redundant {
                let step = &mut self.steps[operand as usize];
                // An unbounded box may be widened less than the overlap.
                if step.shared.is_none() && boxes[operand as usize].is_bounded() {
                    step.bounds = None;
                }
            }
        }
    }

    /// A box around the solid, with infinite sides where it may be unbounded: the union of the
    /// operands' boxes, their overlap, or the first operand's box.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Adds the parts of the ray's line inside the solid.
    pub fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let boundaries = self.boundaries(ray, [f64::NEG_INFINITY, f64::INFINITY]);
        spans.extend(boundaries.chunks_exact(2).map(|ends| Crossings {
            enter: ends[0],
            exit: ends[1],
        }));
    }

    /// The nearest boundary with `0 < t < limit`.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        if let Some(program) = &self.program {
            let nearest = self.nearest(program, &ray.into(), limit, true);
            if !nearest.close {
                return nearest.hit.then(|| nearest.end.into());
            }
        }
        self.exact_hit(ray, limit)
    }

    /// The same for the rays of a packet whose bit in `lanes` is 1.
    #[inline(always)]
    pub fn hits<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        limits: Eight<S>,
        lanes: u32,
    ) -> Option<Hits> {
        let simd = limits.simd;
        let mut hits = Hits::NONE;
        let mut rest = lanes;
        if let Some(program) = &self.program {
            // Not inlined: every shape would reserve stack space for the boundaries.
            simd.vectorize(
                #[inline(always)]
                || {
                    let nearest = self.nearest(program, rays, limits, mask(simd, lanes));
                    rest = bits::<S>(nearest.close);
                    hits = nearest.end.hits(bits::<S>(nearest.hit) & !rest);
                },
            );
        }
        hits.and(rest, |lane| self.exact_hit(&rays.ray(lane), limits[lane]))
    }

    /// The same for a single ray, with coincident boundaries resolved.
    pub(super) fn exact_hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let boundaries = self.boundaries(ray, [0.0, limit]);
        let mut hits = boundaries.iter();
        hits.find(|hit| 0.0 < hit.t && hit.t < limit).copied()
    }

    /// The surface at a hit; surfaces of subtracted solids are turned inside out.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let (leaf, own) = self.leaf(hit);
        let mut surface = leaf.solid.surface(ray, own);
        if is_inverted(hit) {
            surface.normal = -surface.normal;
            surface.shading = -surface.shading;
        }
        surface
    }

    /// The same for a packet of eight rays; lanes without a hit are undefined. `None` if a leaf that was
    /// hit supports single rays only.
    #[inline(always)]
    pub fn surfaces<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        hits: &Hits,
    ) -> Option<Surfaces<Eight<S>>> {
        let simd = rays.origin.x.simd;
        let (mut leaves, mut inverted) = ([&self.leaves[0]; WIDTH], 0);
        let own = Hits::one_by_one(
            hits.lanes,
            #[inline(always)]
            |lane| {
                let hit = hits.hit(lane);
                inverted |= u32::from(is_inverted(hit)) << lane;
                let (leaf, own) = self.leaf(hit);
                leaves[lane % WIDTH] = leaf;
                Some(own)
            },
        )?;
        let mut surfaces = None;
        let mut rest = hits.lanes;
        while rest != 0 {
            let leaf = leaves[rest.trailing_zeros() as usize % WIDTH];
            let mut lanes = 0;
            for (lane, other) in leaves.into_iter().enumerate() {
                lanes |= u32::from(ptr::eq(leaf, other)) << lane;
            }
            let lanes = lanes & rest;
            let found = leaf.solid.surfaces(rays, &own.within(lanes))?;
            let others = surfaces.unwrap_or(found);
            surfaces = Some(Surfaces::select(mask(simd, lanes), found, others));
            rest &= !lanes;
        }
        let mut surfaces = surfaces?;
        let normal = surfaces.normal;
        surfaces.normal = Vector::select(mask(simd, inverted), -normal, normal);
        Some(surfaces)
    }

    /// The texture coordinates of the leaf at a hit.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        let (leaf, own) = self.leaf(hit);
        leaf.solid.chart(ray, own)
    }

    /// The solids that are combined.
    pub(super) fn solids(&self) -> impl Iterator<Item = &Solid> {
        self.leaves.iter().map(|leaf| &leaf.solid)
    }

    /// The tags of the leaves.
    pub fn tags(&self) -> impl Iterator<Item = u32> {
        self.leaves.iter().map(|leaf| leaf.tag)
    }

    /// The tag of the leaf whose surface was hit.
    pub fn tag(&self, hit: Hit) -> u32 {
        self.leaf(hit).0.tag
    }

    /// The leaf that was hit, and the hit with the leaf's own part number.
    fn leaf(&self, hit: Hit) -> (&Leaf, Hit) {
        let part = hit.part / 2;
        let after = self.leaves.partition_point(|leaf| leaf.first_part <= part);
        let leaf = &self.leaves[after.saturating_sub(1)];
        let own = Hit {
            part: part - leaf.first_part,
            ..hit
        };
        (leaf, own)
    }
}

/// Whether the surface belongs to a subtracted solid.
fn is_inverted(hit: Hit) -> bool {
    hit.part % 2 == 1
}

fn widened(bounds: Aabb) -> Aabb {
    let margin = 64.0 * ulp(bounds.magnitude());
    Aabb {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}
