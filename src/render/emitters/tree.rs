//! A tree over many emitters by which one of them is chosen for a point, about in proportion to the
//! light it may send there (Conty Estévez and Kulla, "Importance Sampling of Many Lights with
//! Adaptive Tree Splitting", 2018; Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th
//! edition, 2023, §12.6.3).

use glam::DVec3;

use super::cone::Cone;
use super::split;
use crate::geometry::Aabb;

/// Marks the root's parent.
const NONE: u32 = u32::MAX;

/// From this depth on the tree halves the number of emitters at each node.
const DEEP: u32 = 64;

/// Cancellation is polled for nodes over at least this many emitters.
const POLLED: usize = 256;

/// Where an emitter is, where it shines to and how much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) bounds: Aabb,
    pub(crate) cone: Cone,
    /// Radiant intensity at its brightest, as a weight.
    pub(crate) strength: f64,
}

/// The tree, in depth-first order: the first child of a node follows it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The leaf of each emitter.
    leaves: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The sphere around the box.
    centre: DVec3,
    square_radius: f64,
    cone: Cone,
    strength: f64,
    parent: u32,
    /// The second child, or the emitter of a leaf.
    link: u32,
    is_leaf: bool,
}

impl Tree {
    /// Builds the tree; `None` once `cancelled` returns true.
    pub(crate) fn build(emitters: &[Reach], cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let mut tree = Self {
            nodes: Vec::with_capacity((2 * emitters.len()).saturating_sub(1)),
            leaves: vec![0; emitters.len()],
        };
        let mut order: Vec<u32> = (0..emitters.len() as u32).collect();
        if !order.is_empty() {
            tree.grow(emitters, &mut order, (NONE, 0), cancelled)?;
        }
        Some(tree)
    }

    /// Adds the node over some emitters; returns what it covers.
    fn grow(
        &mut self,
        emitters: &[Reach],
        order: &mut [u32],
        (parent, depth): (u32, u32),
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Reach> {
        if POLLED <= order.len() && cancelled() {
            return None;
        }
        let own = self.nodes.len() as u32;
        if let [emitter] = *order {
            let reach = emitters[emitter as usize];
            self.leaves[emitter as usize] = own;
            self.nodes.push(Node::new(&reach, parent, emitter, true));
            return Some(reach);
        }
        let middle = if depth < DEEP {
            split::partition(emitters, order)
        } else {
            order.len() / 2
        };
        let (first, second) = order.split_at_mut(middle);
        // Replaced when the children are known.
        self.nodes
            .push(Node::new(&emitters[first[0] as usize], parent, 0, false));
        let below = (own, depth + 1);
        let first = self.grow(emitters, first, below, cancelled)?;
        let link = self.nodes.len() as u32;
        let second = self.grow(emitters, second, below, cancelled)?;
        let reach = Reach {
            bounds: first.bounds.union(second.bounds),
            cone: first.cone.union(&second.cone),
            strength: first.strength + second.strength,
        };
        self.nodes[own as usize] = Node::new(&reach, parent, link, false);
        Some(reach)
    }

    /// Chooses an emitter for a surface at a point with a normal, by a number in 0..1; returns it with
    /// its probability. `None` if none of those that the number leads to can light the point.
    pub(crate) fn choose(&self, from: DVec3, normal: DVec3, mut number: f64) -> Option<(u32, f64)> {
        let mut at = 0;
        let mut chance = 1.0;
        loop {
            let node = self.nodes.get(at)?;
            if node.is_leaf {
                return Some((node.link, chance));
            }
            let [first, second] = self.shares(at, from, normal)?;
            if number < first {
                number /= first;
                chance *= first;
                at += 1;
            } else {
                // A second child without a share is only reached by rounding.
                number = (number - first) / second;
                chance *= second;
                at = node.link as usize;
            }
            if !(0.0 < chance) {
                return None;
            }
        }
    }

    /// The probability of [`Tree::choose`] for an emitter.
    pub(crate) fn chance(&self, emitter: u32, from: DVec3, normal: DVec3) -> f64 {
        let mut chance = 1.0;
        let mut at = self.leaves[emitter as usize];
        loop {
            let parent = self.nodes[at as usize].parent;
            if parent == NONE {
                return chance;
            }
            let Some([first, second]) = self.shares(parent as usize, from, normal) else {
                return 0.0;
            };
            chance *= if at == parent + 1 { first } else { second };
            at = parent;
        }
    }

    /// The probabilities of a node's children; `None` if no light of them can arrive.
    fn shares(&self, parent: usize, from: DVec3, normal: DVec3) -> Option<[f64; 2]> {
        let children = [parent + 1, self.nodes[parent].link as usize];
        let [first, second] = children.map(|child| self.nodes[child].importance(from, normal));
        let sum = first + second;
        if sum == 0.0 {
            None
        } else if sum.is_finite() {
            Some([first / sum, second / sum])
        } else {
            Some([0.5; 2])
        }
    }
}

impl Node {
    fn new(reach: &Reach, parent: u32, link: u32, is_leaf: bool) -> Self {
        let radius = reach.bounds.half_diagonal();
        Self {
            centre: reach.bounds.centre(),
            square_radius: radius * radius,
            cone: reach.cone,
            strength: reach.strength,
            parent,
            link,
            is_leaf,
        }
    }

    /// A bound of the light that may arrive at a surface, up to occlusion and distances within the
    /// node: strength × cosines / distance².
    fn importance(&self, from: DVec3, normal: DVec3) -> f64 {
        let offset = self.centre - from;
        let square = offset.length_squared();
        if square <= self.square_radius {
            return self.strength / self.square_radius;
        }
        let toward = offset / square.sqrt();
        // The angle that the sphere subtends.
        let square_sine = self.square_radius / square;
        let wide = Angle {
            sine: square_sine.sqrt(),
            cosine: (1.0 - square_sine).max(0.0).sqrt(),
        };
        let received = Angle::of_cosine(normal.dot(toward)).less(wide).cosine;
        if received <= 0.0 {
            return 0.0;
        }
        let along = -self.cone.axis.dot(toward);
        let along = if self.cone.both { along.abs() } else { along };
        let sent = Angle::of_cosine(along)
            .less(Angle::of_cosine(self.cone.cosine))
            .less(wide)
            .cosine;
        self.strength * sent.max(0.0) * received / square
    }
}

/// An angle from 0 to π.
#[derive(Clone, Copy)]
struct Angle {
    sine: f64,
    cosine: f64,
}

impl Angle {
    fn of_cosine(cosine: f64) -> Self {
        Self {
            sine: (1.0 - cosine * cosine).max(0.0).sqrt(),
            cosine,
        }
    }

    /// The difference of two angles, 0 if negative.
    fn less(self, other: Self) -> Self {
        if other.cosine < self.cosine {
            return Self {
                sine: 0.0,
                cosine: 1.0,
            };
        }
        Self {
            sine: self.sine * other.cosine - self.cosine * other.sine,
            cosine: self.cosine * other.cosine + self.sine * other.sine,
        }
    }
}
