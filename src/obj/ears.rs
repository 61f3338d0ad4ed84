//! Cuts a polygon of the plane into triangles by ear clipping: a corner whose triangle with its two
//! neighbours lies within the polygon is cut off, until three corners are left.
//!
//! G. H. Meisters, "Polygons have ears", 1975. Only corners that are not convex can lie in an ear's
//! triangle. They are found in a k-d tree, which makes the work about n log n for outlines that do not
//! cross themselves.

use glam::DVec2;

/// The corners in a leaf of the tree.
const LEAF: usize = 8;

/// A polygon being cut.
struct Outline<'c> {
    corners: &'c [DVec2],
    /// The neighbours of each corner that is left.
    before: Vec<u32>,
    after: Vec<u32>,
    /// The corners that may be cut, in a ring with its start: those that are left and convex, or where a
    /// neighbour is. Each has the number of the one before it, and of the one after it.
    ring: Vec<[u32; 2]>,
    is_candidate: Vec<bool>,
    candidates: usize,
    /// A corner that is left.
    last: u32,
    /// The place of each corner in the order of the leaves.
    rank: Vec<u32>,
    /// In this order: the corners, and whether each is left and not convex.
    ordered: Vec<DVec2>,
    is_open: Vec<bool>,
    /// The tree in the order of a binary heap: node i has the children 2i and 2i + 1.
    nodes: Vec<Node>,
    leaves: usize,
    /// The work left.
    effort: usize,
}

/// The box around corners that are, or were, left and not convex.
#[derive(Clone, Copy)]
struct Node {
    min: DVec2,
    max: DVec2,
    /// How many are.
    open: u32,
}

/// The triangles of a polygon of at least three corners, listed counter-clockwise: two fewer than
/// corners, each counter-clockwise. A polygon that touches or crosses itself gives as many, of which
/// some may overlap.
///
/// `effort` is the greatest number of nodes to look at; what is left of it is returned there. Once it is
/// spent, the rest is cut without looking.
pub(super) fn triangles(corners: &[DVec2], effort: &mut usize) -> Vec<[u32; 3]> {
    let mut outline = Outline::new(corners, *effort);
    let mut triangles = Vec::with_capacity(corners.len() - 2);
    // Where a fan would begin.
    let mut tip = outline.candidate(0);
    let mut failed = 0;
    let mut left = corners.len();
    while 3 < left && 0 < outline.effort && 0 < outline.candidates {
        // If there is no ear, the outline crosses itself.
        if failed == outline.candidates || outline.is_ear(tip) {
            triangles.push(outline.around(tip));
            tip = outline.cut(tip);
            left -= 1;
            failed = 0;
        } else {
            tip = outline.candidate(tip);
            failed += 1;
        }
    }
    *effort = outline.effort;
    let mut tip = outline.last;
    while 3 < left {
        let triangle = outline.around(tip);
        triangles.push(triangle);
        outline.link(triangle);
        tip = triangle[2];
        left -= 1;
    }
    triangles.push(outline.around(tip));
    triangles
}

impl<'c> Outline<'c> {
    fn new(corners: &'c [DVec2], effort: usize) -> Self {
        let count = corners.len() as u32;
        let leaves = corners.len().div_ceil(LEAF).next_power_of_two();
        let mut order: Vec<_> = (0..count).collect();
        arrange(corners, &mut order, leaves * LEAF);
        let mut rank = vec![0; corners.len()];
        for (place, &corner) in (0..).zip(&order) {
            rank[corner as usize] = place;
        }
        let nothing = Node {
            min: DVec2::INFINITY,
            max: DVec2::NEG_INFINITY,
            open: 0,
        };
        let mut outline = Self {
            corners,
            before: (0..count).map(|at| (at + count - 1) % count).collect(),
            after: (0..count).map(|at| (at + 1) % count).collect(),
            ring: vec![[count; 2]; corners.len() + 1],
            is_candidate: vec![false; corners.len()],
            candidates: 0,
            last: 1,
            rank,
            ordered: order
                .iter()
                .map(|&corner| corners[corner as usize])
                .collect(),
            is_open: vec![false; corners.len()],
            nodes: vec![nothing; 2 * leaves],
            leaves,
            effort,
        };
        let start = count;
        for corner in 0..count {
            outline.judge(corner, start);
        }
        outline
    }

    /// A corner between its neighbours.
    fn around(&self, tip: u32) -> [u32; 3] {
        let at = tip as usize;
        [self.before[at], tip, self.after[at]]
    }

    fn places(&self, triangle: [u32; 3]) -> [DVec2; 3] {
        triangle.map(|corner| self.corners[corner as usize])
    }

    /// The next corner that may be cut after one, in the order of the outline.
    fn candidate(&self, after: u32) -> u32 {
        let start = self.corners.len() as u32;
        match self.ring[after as usize][1] {
            next if next == start => self.ring[next as usize][1],
            next => next,
        }
    }

    /// Notes what a corner is that is left. If it may be cut, it gets its place in the ring before
    /// another.
    fn judge(&mut self, corner: u32, follower: u32) {
        let places = self.places(self.around(corner));
        let [before, place, after] = places;
        let is_open = !is_left_turn(places);
        self.note(corner, is_open);
        // A corner where a neighbour is covers nothing.
        let may_be_cut = !is_open || place == before || place == after;
        if self.is_candidate[corner as usize] == may_be_cut {
            return;
        }
        if may_be_cut {
            self.is_candidate[corner as usize] = true;
            self.candidates += 1;
            let before = self.ring[follower as usize][0];
            self.ring[corner as usize] = [before, follower];
            self.ring[before as usize][1] = corner;
            self.ring[follower as usize][0] = corner;
        } else {
            self.leave_ring(corner);
        }
    }

    fn leave_ring(&mut self, corner: u32) {
        self.is_candidate[corner as usize] = false;
        self.candidates -= 1;
        let [before, after] = self.ring[corner as usize];
        self.ring[before as usize][1] = after;
        self.ring[after as usize][0] = before;
    }

    fn note(&mut self, corner: u32, is_open: bool) {
        let rank = self.rank[corner as usize] as usize;
        if self.is_open[rank] == is_open {
            return;
        }
        self.is_open[rank] = is_open;
        let place = self.ordered[rank];
        let mut number = self.leaves + rank / LEAF;
        while 0 < number {
            let node = &mut self.nodes[number];
            if is_open {
                node.min = node.min.min(place);
                node.max = node.max.max(place);
                node.open += 1;
            } else {
                node.open -= 1;
            }
            number /= 2;
        }
    }

    /// Removes the corner in the middle of a triangle from the outline.
    fn link(&mut self, [before, _, after]: [u32; 3]) {
        self.after[before as usize] = after;
        self.before[after as usize] = before;
    }

    /// Removes a corner that may be cut. Returns the next one that may be.
    fn cut(&mut self, tip: u32) -> u32 {
        let triangle = self.around(tip);
        let [before, _, after] = triangle;
        self.link(triangle);
        self.last = after;
        self.note(tip, false);
        self.judge(before, tip);
        self.judge(after, self.ring[tip as usize][1]);
        let next = self.candidate(tip);
        self.leave_ring(tip);
        next
    }

    /// Whether the triangle of a corner that may be cut contains no other corner.
    fn is_ear(&mut self, tip: u32) -> bool {
        let places = self.places(self.around(tip));
        !is_left_turn(places) || !self.is_entered(&places, 1)
    }

    /// Whether an open corner below a node lies in a triangle, and not at one of its corners. It is said
    /// to once the effort is spent.
    fn is_entered(&mut self, triangle: &[DVec2; 3], number: usize) -> bool {
        let Some(left) = self.effort.checked_sub(1) else {
            return true;
        };
        self.effort = left;
        let node = self.nodes[number];
        if node.open == 0 || !node.meets(triangle) {
            return false;
        }
        if number < self.leaves {
            return self.is_entered(triangle, 2 * number)
                || self.is_entered(triangle, 2 * number + 1);
        }
        let first = LEAF * (number - self.leaves);
        let own = first..self.ordered.len().min(first + LEAF);
        let mut open = self.ordered[own.clone()].iter().zip(&self.is_open[own]);
        open.any(|(place, is_open)| {
            *is_open && !triangle.contains(place) && is_within(*place, triangle)
        })
    }
}

/// Arranges corners for a tree whose leaves have room for `room` corners, filled from the first on.
fn arrange(corners: &[DVec2], order: &mut [u32], room: usize) {
    if order.len() <= LEAF {
        return;
    }
    let half = room / 2;
    if order.len() <= half {
        return arrange(corners, order, half);
    }
    let place = |corner: u32| corners[corner as usize];
    let low = order
        .iter()
        .map(|&corner| place(corner))
        .fold(DVec2::INFINITY, DVec2::min);
    let high = order
        .iter()
        .map(|&corner| place(corner))
        .fold(DVec2::NEG_INFINITY, DVec2::max);
    let is_tall = high.x - low.x < high.y - low.y;
    let key = |corner: u32| {
        if is_tall {
            place(corner).y
        } else {
            place(corner).x
        }
    };
    order.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    let (first, second) = order.split_at_mut(half);
    arrange(corners, first, half);
    arrange(corners, second, half);
}

impl Node {
    /// Whether the box may overlap a counter-clockwise triangle.
    fn meets(&self, triangle: &[DVec2; 3]) -> bool {
        let [a, b, c] = *triangle;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let overlaps = self.min.cmple(high).all() && low.cmple(self.max).all();
        overlaps && sides(triangle).all(|(from, to)| self.reaches_left(from, to))
    }

    /// Whether a corner of the box is not to the right of a line.
    fn reaches_left(&self, from: DVec2, to: DVec2) -> bool {
        let along = to - from;
        let x = if along.y < 0.0 {
            self.max.x
        } else {
            self.min.x
        };
        let y = if along.x < 0.0 {
            self.min.y
        } else {
            self.max.y
        };
        0.0 <= along.perp_dot(DVec2::new(x, y) - from)
    }
}

fn sides([a, b, c]: &[DVec2; 3]) -> impl Iterator<Item = (DVec2, DVec2)> {
    [(*a, *b), (*b, *c), (*c, *a)].into_iter()
}

/// Whether three points turn counter-clockwise.
fn is_left_turn([a, b, c]: [DVec2; 3]) -> bool {
    0.0 < (b - a).perp_dot(c - a)
}

/// Whether a point lies in a counter-clockwise triangle or on its sides.
fn is_within(point: DVec2, triangle: &[DVec2; 3]) -> bool {
    sides(triangle).all(|(from, to)| 0.0 <= (to - from).perp_dot(point - from))
}
