//! A tree over many emitters by which one of them is chosen for a point, about in proportion to the
//! light it may send there (Conty Estévez and Kulla, "Importance Sampling of Many Lights with
//! Adaptive Tree Splitting", 2018; Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th
//! edition, 2023, §12.6.3).

use glam::DVec3;

use super::cone::{Cone, Reach};
use super::split;

/// From this depth on the tree halves the number of emitters at each node.
const DEEP: u32 = 64;

/// Cancellation is polled for nodes over at least this many emitters.
const POLLED: usize = 256;

/// Emitters of a node are chosen by strength alone where the square of its radius over its distance is
/// below this, ...
const FAR: f64 = 1.0 / 16.0;

/// ... and the cosine of the half angle of its cone above this.
const NARROW: f64 = 0.7;

/// The tree, in depth-first order: the first child of a node follows it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The emitters in the order of the leaves.
    order: Vec<u32>,
    /// The place of each emitter in that order.
    places: Vec<u32>,
    /// The sums of their strengths, in that order.
    sums: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The sphere around the box.
    centre: DVec3,
    square_radius: f64,
    cone: Cone,
    strength: f64,
    /// Where its emitters end in the order.
    end: u32,
    /// The second child; 0 for a leaf.
    second: u32,
}

/// A node with the place of its first emitter.
type At = (usize, usize);

impl Tree {
    /// Builds the tree; `None` once `cancelled` returns true.
    pub(crate) fn build(emitters: &[Reach], cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let count = emitters.len();
        let mut tree = Self {
            nodes: Vec::with_capacity((2 * count).saturating_sub(1)),
            places: vec![0; count],
            ..Self::default()
        };
        let mut order: Vec<u32> = (0..count as u32).collect();
        if !order.is_empty() {
            tree.grow(emitters, &mut order, (0, 0), cancelled)?;
        }
        let mut sum = 0.0;
        for (place, &emitter) in (0..).zip(&order) {
            sum += emitters[emitter as usize].strength;
            tree.sums.push(sum);
            tree.places[emitter as usize] = place;
        }
        tree.order = order;
        Some(tree)
    }

    /// Adds the node over some emitters, of which the first has a place; returns what it covers.
    fn grow(
        &mut self,
        emitters: &[Reach],
        order: &mut [u32],
        (place, depth): (usize, u32),
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Reach> {
        if POLLED <= order.len() && cancelled() {
            return None;
        }
        let own = self.nodes.len();
        let end = (place + order.len()) as u32;
        if let [emitter] = *order {
            let reach = emitters[emitter as usize];
            self.nodes.push(Node::new(&reach, end, 0));
            return Some(reach);
        }
        let middle = if depth < DEEP {
            split::partition(emitters, order)
        } else {
            order.len() / 2
        };
        let (first, second) = order.split_at_mut(middle);
        // Replaced when the children are known.
        let any = &emitters[first[0] as usize];
        self.nodes.push(Node::new(any, end, 0));
        let first = self.grow(emitters, first, (place, depth + 1), cancelled)?;
        let child = self.nodes.len() as u32;
        let second = self.grow(emitters, second, (place + middle, depth + 1), cancelled)?;
        let reach = Reach {
            bounds: first.bounds.union(second.bounds),
            cone: first.cone.union(&second.cone),
            strength: first.strength + second.strength,
        };
        self.nodes[own] = Node::new(&reach, end, child);
        Some(reach)
    }

    /// Chooses an emitter for a surface at a point with a normal, by a number in 0..1; returns it with
    /// its probability. `None` if none of those that the number leads to can light the point.
    pub(crate) fn choose(&self, from: DVec3, normal: DVec3, mut number: f64) -> Option<(u32, f64)> {
        let mut at = (0, 0);
        let mut chance = 1.0;
        loop {
            let node = self.nodes.get(at.0)?;
            let Some([first, second]) = self.children(at).filter(|_| !node.is_alike(from)) else {
                let sums = &self.sums[at.1..node.end as usize];
                let before = at.1.checked_sub(1).map_or(0.0, |last| self.sums[last]);
                let sought = before + number * (sums[sums.len() - 1] - before);
                let place = sums.partition_point(|&sum| sum <= sought);
                let place = at.1 + place.min(sums.len() - 1);
                let share = self.share(at, place);
                return (0.0 < share).then(|| (self.order[place], chance * share));
            };
            let share = self.first_share(first.0, second.0, from, normal)?;
            if number < share {
                number /= share;
                chance *= share;
                at = first;
            } else {
                number = (number - share) / (1.0 - share);
                chance *= 1.0 - share;
                at = second;
            }
        }
    }

    /// The probability of [`Tree::choose`] for an emitter.
    pub(crate) fn chance(&self, emitter: u32, from: DVec3, normal: DVec3) -> f64 {
        let place = self.places[emitter as usize] as usize;
        let mut at = (0, 0);
        let mut chance = 1.0;
        loop {
            let node = &self.nodes[at.0];
            let Some([first, second]) = self.children(at).filter(|_| !node.is_alike(from)) else {
                return chance * self.share(at, place);
            };
            let Some(share) = self.first_share(first.0, second.0, from, normal) else {
                return 0.0;
            };
            if place < second.1 {
                chance *= share;
                at = first;
            } else {
                chance *= 1.0 - share;
                at = second;
            }
        }
    }

    /// A node's children; `None` for a leaf.
    fn children(&self, (node, place): At) -> Option<[At; 2]> {
        let second = self.nodes[node].second as usize;
        (second != 0).then(|| {
            let first = node + 1;
            [(first, place), (second, self.nodes[first].end as usize)]
        })
    }

    /// The share of the emitter at a place among those of a node, by strength.
    fn share(&self, (node, first): At, place: usize) -> f64 {
        let before = |place: usize| place.checked_sub(1).map_or(0.0, |last| self.sums[last]);
        let all = self.sums[self.nodes[node].end as usize - 1] - before(first);
        if first + 1 == self.nodes[node].end as usize {
            1.0
        } else {
            (self.sums[place] - before(place)) / all
        }
    }

    /// The probability of the first of two children; `None` if no light of them can arrive.
    fn first_share(&self, first: usize, second: usize, from: DVec3, normal: DVec3) -> Option<f64> {
        let importance = |child: usize| self.nodes[child].importance(from, normal);
        let (first, second) = (importance(first), importance(second));
        let sum = first + second;
        if sum == 0.0 {
            None
        } else if sum.is_finite() {
            Some(first / sum)
        } else {
            Some(0.5)
        }
    }
}

impl Node {
    fn new(reach: &Reach, end: u32, second: u32) -> Self {
        let radius = reach.bounds.half_diagonal();
        Self {
            centre: reach.bounds.centre(),
            square_radius: radius * radius,
            cone: reach.cone,
            strength: reach.strength,
            end,
            second,
        }
    }

    /// Whether the emitters look alike from a point but for their strength.
    fn is_alike(&self, from: DVec3) -> bool {
        let square = self.centre.distance_squared(from);
        self.square_radius < FAR * square && NARROW < self.cone.cosine
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
