//! A tree over many emitters by which one of them is chosen for a point, about in proportion to the
//! light it may send there (Conty Estévez and Kulla, "Importance Sampling of Many Lights with
//! Adaptive Tree Splitting", 2018; Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th
//! edition, 2023, §12.6.3).

use std::ops::Range;

use glam::DVec3;

use super::cone::{Cone, Reach};
use super::{Picked, split};
use geometry::IsCancelled;
use geometry::lanes::{Eight, Lanes, Row, Simd, Vector, WIDTH, each_bit};

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
    pub(crate) fn build(emitters: &[Reach], cancelled: IsCancelled<'_>) -> Option<Self> {
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
        cancelled: IsCancelled<'_>,
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
    #[cfg(test)]
    pub(crate) fn choose(&self, from: DVec3, normal: DVec3, number: f64) -> Option<(u32, f64)> {
        if self.nodes.is_empty() {
            return None;
        }
        let mut search = Search::new(number);
        while let Some([first, second]) = self.children(&search, from) {
            let importance = |child: At| {
                let node = Spot::from(&self.nodes[child.0]);
                node.importance(from.into(), normal.into())
            };
            let share = share_of(importance(first), importance(second))?;
            search.descend([first, second], share);
        }
        self.among_alike(&search)
    }

    /// The same for several surfaces, by the numbers in their lanes.
    #[inline(always)]
    pub(crate) fn choose_together<S: Simd>(
        &self,
        simd: S,
        (from, normal): (&Vector<Row>, &Vector<Row>),
        numbers: &Row,
        lanes: u32,
    ) -> [Option<Picked>; WIDTH] {
        let mut alike = 0;
        let mut searches = [Search::new(0.0); WIDTH];
        for lane in each_bit(lanes) {
            searches[lane] = Search::new(numbers.0[lane]);
        }
        let (points, normals) = (from.load(simd), normal.load(simd));
        let mut active = if self.nodes.is_empty() { 0 } else { lanes };
        let mut children = [[(0, 0); 2]; WIDTH];
        loop {
            let mut spots = [SpotRows::default(); 2];
            for lane in each_bit(active) {
                if let Some(pair) = self.children(&searches[lane], from.get(lane)) {
                    children[lane] = pair;
                    for (rows, (node, _)) in spots.iter_mut().zip(pair) {
                        rows.put(lane, &self.nodes[node]);
                    }
                } else {
                    alike |= 1 << lane;
                    active &= !(1 << lane);
                }
            }
            if active == 0 {
                break;
            }
            let [first, second] = spots;
            let first = first.load(simd).importance(points, normals);
            let second = second.load(simd).importance(points, normals);
            for lane in each_bit(active) {
                match share_of(first[lane], second[lane]) {
                    Some(share) => searches[lane].descend(children[lane], share),
                    None => active &= !(1 << lane),
                }
            }
        }
        self.among_alike_together(&searches, alike)
    }

    /// The children of the node that a search has reached; `None` if its emitters, seen from the point,
    /// differ only in strength.
    fn children(&self, search: &Search, from: DVec3) -> Option<[At; 2]> {
        let node = &self.nodes[search.at.0];
        self.children_of(search.at).filter(|_| !node.is_alike(from))
    }

    /// Chooses among the emitters of the node that a search has reached, by strength.
    #[cfg(test)]
    fn among_alike(&self, search: &Search) -> Option<(u32, f64)> {
        let (places, sought) = self.sought(search);
        let place = self.sums[places.clone()].partition_point(|&sum| sum <= sought);
        self.found(search, places.start + place)
    }

    /// The same for the searches in several lanes, side by side so that the waits for memory overlap.
    #[inline(always)]
    fn among_alike_together(
        &self,
        searches: &[Search; WIDTH],
        lanes: u32,
    ) -> [Option<Picked>; WIDTH] {
        let (mut starts, mut counts, mut sought) = ([0; WIDTH], [0; WIDTH], [0.0; WIDTH]);
        let mut most = 0;
        for lane in each_bit(lanes) {
            let places;
            (places, sought[lane]) = self.sought(&searches[lane]);
            (starts[lane], counts[lane]) = (places.start, places.len());
            most = most.max(places.len());
        }
        // Of a node's emitters, the first whose sum is above the one sought is among the `counts` from
        // `starts` on, or follows them.
        while most != 0 {
            for lane in each_bit(lanes) {
                let half = counts[lane] / 2;
                let middle = starts[lane] + half;
                if counts[lane] != 0 && self.sums[middle] <= sought[lane] {
                    starts[lane] = middle + 1;
                    counts[lane] -= half + 1;
                } else {
                    counts[lane] = half;
                }
            }
            most /= 2;
        }
        let mut chosen = [None; WIDTH];
        for lane in each_bit(lanes) {
            chosen[lane] = self.found(&searches[lane], starts[lane]).map(Picked::from);
        }
        chosen
    }

    /// The places of the emitters of the node that a search has reached, and the sum that is sought there.
    #[inline(always)]
    fn sought(&self, search: &Search) -> (Range<usize>, f64) {
        let (node, first) = search.at;
        let end = self.nodes[node].end as usize;
        let before = first.checked_sub(1).map_or(0.0, |last| self.sums[last]);
        let sought = before + search.number * (self.sums[end - 1] - before);
        (first..end, sought)
    }

    /// The emitter at a place or, beyond the end of the node that a search has reached, its last.
    #[inline(always)]
    fn found(&self, search: &Search, place: usize) -> Option<(u32, f64)> {
        let last = self.nodes[search.at.0].end as usize - 1;
        let place = place.min(last);
        let share = self.share(search.at, place);
        (0.0 < share).then(|| (self.order[place], search.chance * share))
    }

    /// The probability with which an emitter is chosen.
    pub(crate) fn chance(&self, emitter: u32, from: DVec3, normal: DVec3) -> f64 {
        let place = self.places[emitter as usize] as usize;
        let mut at = (0, 0);
        let mut chance = 1.0;
        loop {
            let node = &self.nodes[at.0];
            let Some([first, second]) = self.children_of(at).filter(|_| !node.is_alike(from))
            else {
                return chance * self.share(at, place);
            };
            let importance = |child: At| {
                let node = Spot::from(&self.nodes[child.0]);
                node.importance(from.into(), normal.into())
            };
            let Some(share) = share_of(importance(first), importance(second)) else {
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
    fn children_of(&self, (node, place): At) -> Option<[At; 2]> {
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
}

/// The probability of the first of two children, by importance; `None` if no light of them can arrive.
fn share_of(first: f64, second: f64) -> Option<f64> {
    let sum = first + second;
    if sum == 0.0 {
        None
    } else if sum.is_finite() {
        Some(first / sum)
    } else {
        Some(0.5)
    }
}

/// A descent through the tree so far.
#[derive(Clone, Copy)]
struct Search {
    at: At,
    /// The probability of getting there.
    chance: f64,
    /// What is left of the number, in 0..1.
    number: f64,
}

impl Search {
    fn new(number: f64) -> Self {
        Self {
            at: (0, 0),
            chance: 1.0,
            number,
        }
    }

    /// Descends to one of two children; `share` is the probability of the first.
    fn descend(&mut self, [first, second]: [At; 2], share: f64) {
        if self.number < share {
            self.number /= share;
            self.chance *= share;
            self.at = first;
        } else {
            self.number = (self.number - share) / (1.0 - share);
            self.chance *= 1.0 - share;
            self.at = second;
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
}

/// What the importance of a node depends on, in each lane.
#[derive(Clone, Copy)]
struct Spot<N> {
    centre: Vector<N>,
    square_radius: N,
    axis: Vector<N>,
    /// The cosine of the half angle of the cone.
    cosine: N,
    /// 1 if the emitters shine to both sides, else 0.
    is_two_sided: N,
    strength: N,
}

impl From<&Node> for Spot<f64> {
    fn from(node: &Node) -> Self {
        Self {
            centre: node.centre.into(),
            square_radius: node.square_radius,
            axis: node.cone.axis.into(),
            cosine: node.cone.cosine,
            is_two_sided: f64::from(node.cone.is_two_sided),
            strength: node.strength,
        }
    }
}

impl<N: Lanes> Spot<N> {
    /// A bound of the light that may arrive at a surface, up to occlusion and distances within the
    /// node: strength × cosines / distance².
    #[inline(always)]
    fn importance(&self, from: Vector<N>, normal: Vector<N>) -> N {
        let (zero, one) = (self.strength.all(0.0), self.strength.all(1.0));
        let offset = self.centre - from;
        let square = offset.length_squared();
        let is_inside = square.up_to(self.square_radius);
        let toward = offset.over(square.sqrt());
        // The angle that the sphere subtends.
        let square_sine = self.square_radius / square;
        let wide = Angle {
            sine: square_sine.sqrt(),
            cosine: positive(one - square_sine).sqrt(),
        };
        let received = Angle::of_cosine(normal.dot(toward)).less(wide).cosine;
        let along = -self.axis.dot(toward);
        let along = N::select(self.is_two_sided.equals(one), along.abs(), along);
        let sent = Angle::of_cosine(along)
            .less(Angle::of_cosine(self.cosine))
            .less(wide)
            .cosine;
        let outside = self.strength * positive(sent) * received / square;
        let outside = N::select(received.up_to(zero), zero, outside);
        N::select(is_inside, self.strength / self.square_radius, outside)
    }
}

/// The nodes of eight lanes.
#[derive(Clone, Copy)]
struct SpotRows {
    vectors: [Vector<Row>; 2],
    numbers: [Row; 4],
}

impl Default for SpotRows {
    fn default() -> Self {
        Self {
            vectors: [Vector::repeat(DVec3::ZERO); 2],
            numbers: [Row::all(0.0); 4],
        }
    }
}

impl SpotRows {
    #[inline(always)]
    fn put(&mut self, lane: usize, node: &Node) {
        self.vectors[0].set(lane, node.centre);
        self.vectors[1].set(lane, node.cone.axis);
        self.numbers[0].0[lane] = node.square_radius;
        self.numbers[1].0[lane] = node.cone.cosine;
        self.numbers[2].0[lane] = f64::from(node.cone.is_two_sided);
        self.numbers[3].0[lane] = node.strength;
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S) -> Spot<Eight<S>> {
        Spot {
            centre: self.vectors[0].load(simd),
            square_radius: self.numbers[0].load(simd),
            axis: self.vectors[1].load(simd),
            cosine: self.numbers[1].load(simd),
            is_two_sided: self.numbers[2].load(simd),
            strength: self.numbers[3].load(simd),
        }
    }
}

/// An angle from 0 to π, in each lane.
#[derive(Clone, Copy)]
struct Angle<N> {
    sine: N,
    cosine: N,
}

impl<N: Lanes> Angle<N> {
    #[inline(always)]
    fn of_cosine(cosine: N) -> Self {
        Self {
            sine: positive(cosine.all(1.0) - cosine * cosine).sqrt(),
            cosine,
        }
    }

    /// The difference of two angles, 0 if negative.
    #[inline(always)]
    fn less(self, other: Self) -> Self {
        let (zero, one) = (self.sine.all(0.0), self.sine.all(1.0));
        let is_negative = other.cosine.below(self.cosine);
        let sine = self.sine * other.cosine - self.cosine * other.sine;
        let cosine = self.cosine * other.cosine + self.sine * other.sine;
        Self {
            sine: N::select(is_negative, zero, sine),
            cosine: N::select(is_negative, one, cosine),
        }
    }
}

/// A number, or 0 if it is below.
#[inline(always)]
fn positive<N: Lanes>(number: N) -> N {
    let zero = number.all(0.0);
    N::select(zero.below(number), number, zero)
}
