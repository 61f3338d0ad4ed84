//! Solids made of solids: union, intersection and difference.
//!
//! S. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18 (1982): a
//! line is cut into spans by each operand, and the operation is done on the spans. Operations are
//! regularised: what they leave has volume, and its boundary.

mod evaluate;
mod merge;

use glam::DVec3;
use smallvec::SmallVec;

use super::{Aabb, Chart, Crossings, Hit, Ray, Shape, Spans, Surface, ulp};

/// A set operation on two closed solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in either.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first and not in the second.
    Difference,
}

/// A solid in a list of solids, made of earlier ones or of a shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A shape.
    Leaf {
        /// It.
        shape: Shape,
        /// What its owner knows it by.
        tag: u32,
    },
    /// A solid made of two others.
    Operation {
        /// How.
        operation: Operation,
        /// The place of the first operand in the list, before this one.
        first: u32,
        /// The place of the second operand in the list, before this one.
        second: u32,
    },
}

/// A solid made of shapes by set operations. A part of it is a part of one of the shapes, as it is
/// or turned inside out.
#[derive(Clone, Debug, PartialEq)]
pub struct Csg {
    steps: Vec<Step>,
    leaves: Vec<Leaf>,
    /// How many steps are operands more than once.
    shared: u32,
    bounds: Aabb,
    /// The largest of the leaves'.
    magnitude: f64,
}

/// A node ready for rays.
#[derive(Clone, Debug, PartialEq)]
struct Step {
    /// The box, widened by more than a leaf's rounding.
    bounds: Aabb,
    kind: Kind,
    /// Which of the shared steps it is, if it is an operand more than once.
    shared: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The index of a leaf.
    Leaf(u32),
    /// An operation on two steps.
    Operation(Operation, [u32; 2]),
}

#[derive(Clone, Debug, PartialEq)]
struct Leaf {
    shape: Shape,
    tag: u32,
    /// The number of its first part among the parts of all leaves.
    first_part: u32,
    /// The largest finite coordinate of its box.
    magnitude: f64,
}

/// Where a line crosses the boundary of a solid, in ascending order; in and out alternate.
type Boundaries = SmallVec<[Hit; 32]>;

impl Csg {
    /// Makes the last of the nodes. Each operand stands before its users; one may have several, and
    /// is computed once for all of them. There is a node, and none that the last is not made of.
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
            bounds: Aabb::EMPTY,
            magnitude: 0.0,
        };
        let mut boxes: Vec<Aabb> = Vec::with_capacity(nodes.len());
        let mut parts = 0;
        for (node, uses) in nodes.into_iter().zip(uses) {
            let (kind, bounds) = match node {
                Node::Leaf { shape, tag } => {
                    let bounds = shape.bounds();
                    let leaf = Leaf {
                        first_part: parts,
                        magnitude: magnitude(bounds),
                        shape,
                        tag,
                    };
                    parts += leaf.shape.parts();
                    csg.magnitude = csg.magnitude.max(leaf.magnitude);
                    csg.leaves.push(leaf);
                    (Kind::Leaf(csg.leaves.len() as u32 - 1), bounds)
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
                    (Kind::Operation(operation, [first, second]), bounds)
                }
            };
            let shared = (1 < uses).then_some(csg.shared);
            csg.shared += u32::from(shared.is_some());
            boxes.push(bounds);
            csg.bounds = bounds;
            csg.steps.push(Step {
                bounds: widened(bounds),
                kind,
                shared,
            });
        }
        csg
    }

    /// A box around the solid, with infinite sides where it may have no end: the operands' combined
    /// by the operation, the union of both, the overlap of both, or the first.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Adds the parts of the ray's line that are inside.
    pub fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let boundaries = self.boundaries(ray, [f64::NEG_INFINITY, f64::INFINITY]);
        spans.extend(boundaries.chunks_exact(2).map(|ends| Crossings {
            enter: ends[0],
            exit: ends[1],
        }));
    }

    /// The nearest boundary with `0 < t < limit`.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        self.boundaries(ray, [0.0, limit])
            .into_iter()
            .find(|hit| 0.0 < hit.t && hit.t < limit)
    }

    /// The surface at a hit; what was taken away is turned inside out.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let (leaf, own) = self.leaf(hit);
        let mut surface = leaf.shape.surface(ray, own);
        if is_turned(hit) {
            surface.normal = -surface.normal;
            surface.shading = -surface.shading;
        }
        surface
    }

    /// The texture coordinates at a hit: the leaf's.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        let (leaf, own) = self.leaf(hit);
        leaf.shape.chart(ray, own)
    }

    /// The tag of the leaf whose surface was hit.
    pub fn tag(&self, hit: Hit) -> u32 {
        self.leaf(hit).0.tag
    }

    /// How many numbers there are for parts: two for each of the leaves'.
    pub(super) fn parts(&self) -> u32 {
        self.leaves
            .last()
            .map_or(0, |last| 2 * (last.first_part + last.shape.parts()))
    }

    /// The leaf that was hit, and the hit as the leaf numbers it.
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

/// Whether the surface is that of a solid taken away.
fn is_turned(hit: Hit) -> bool {
    hit.part % 2 == 1
}

/// The largest finite coordinate.
fn magnitude(bounds: Aabb) -> f64 {
    [bounds.min, bounds.max]
        .iter()
        .flat_map(DVec3::to_array)
        .filter(|coordinate| coordinate.is_finite())
        .fold(0.0, |largest, coordinate| largest.max(coordinate.abs()))
}

fn widened(bounds: Aabb) -> Aabb {
    let margin = 64.0 * ulp(magnitude(bounds));
    Aabb {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}
