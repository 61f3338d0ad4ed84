//! Cuts a polygon of the plane into triangles by ear clipping: a corner whose triangle with its two
//! neighbours lies within the polygon is cut off, until three corners are left.
//!
//! G. H. Meisters, "Polygons have ears", 1975. Only corners that are not convex can lie in an ear's
//! triangle. They are found in a k-d tree, which makes the work about n log n for outlines that do not
//! cross themselves.

use glam::DVec2;

/// The corners in a leaf of the tree.
const LEAF: usize = 8;

/// The work allowed per corner, in nodes looked at: stars, combs and spirals of 100,000 corners take a
/// third of it. What is left of a polygon that takes more, which crosses itself, is cut without looking.
const EFFORT: usize = 1 << 7;

/// Small polygons may take as much as those of this many corners.
const SMALL: usize = 100;

/// A polygon being cut.
struct Outline<'c> {
    corners: &'c [DVec2],
    /// The neighbours of each corner that is left.
    before: Vec<u32>,
    after: Vec<u32>,
    /// Whether a corner is left and not convex.
    is_open: Vec<bool>,
    /// The corners in the order of the leaves, and the place of each in this order.
    order: Vec<u32>,
    rank: Vec<u32>,
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
pub(super) fn triangles(corners: &[DVec2]) -> Vec<[u32; 3]> {
    let mut outline = Outline::new(corners);
    let mut triangles = Vec::with_capacity(corners.len() - 2);
    // Where a fan would begin.
    let mut tip = 1;
    let mut failed = 0;
    let mut left = corners.len();
    while 3 < left {
        let triangle = outline.around(tip);
        tip = triangle[2];
        // If there is no ear, the outline crosses itself.
        if failed == left || outline.effort == 0 || outline.is_ear(triangle) {
            triangles.push(triangle);
            outline.cut(triangle);
            left -= 1;
            failed = 0;
        } else {
            failed += 1;
        }
    }
    triangles.push(outline.around(tip));
    triangles
}

impl<'c> Outline<'c> {
    fn new(corners: &'c [DVec2]) -> Self {
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
            is_open: vec![false; corners.len()],
            order,
            rank,
            nodes: vec![nothing; 2 * leaves],
            leaves,
            effort: EFFORT * corners.len().max(SMALL),
        };
        for corner in 0..count {
            outline.judge(corner);
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

    /// Notes whether a corner that is left is convex.
    fn judge(&mut self, corner: u32) {
        let is_open = !is_left_turn(self.places(self.around(corner)));
        self.note(corner, is_open);
    }

    fn note(&mut self, corner: u32, is_open: bool) {
        let corner = corner as usize;
        if self.is_open[corner] == is_open {
            return;
        }
        self.is_open[corner] = is_open;
        let place = self.corners[corner];
        let mut number = self.leaves + self.rank[corner] as usize / LEAF;
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

    /// Removes the corner in the middle of a triangle.
    fn cut(&mut self, [before, tip, after]: [u32; 3]) {
        self.note(tip, false);
        self.after[before as usize] = after;
        self.before[after as usize] = before;
        self.judge(before);
        self.judge(after);
    }

    /// Whether a triangle of three consecutive corners has an area and contains no other corner.
    fn is_ear(&mut self, triangle: [u32; 3]) -> bool {
        let places = self.places(triangle);
        is_left_turn(places) && !self.is_entered(&places, 1)
    }

    /// Whether an open corner below a node lies in a triangle, and not at one of its corners.
    fn is_entered(&mut self, triangle: &[DVec2; 3], number: usize) -> bool {
        self.effort = self.effort.saturating_sub(1);
        let node = self.nodes[number];
        if node.open == 0 || !node.meets(triangle) {
            return false;
        }
        if number < self.leaves {
            return self.is_entered(triangle, 2 * number)
                || self.is_entered(triangle, 2 * number + 1);
        }
        let own = self.order.chunks(LEAF).nth(number - self.leaves);
        own.unwrap_or_default().iter().any(|&corner| {
            let place = self.corners[corner as usize];
            self.is_open[corner as usize]
                && !triangle.contains(&place)
                && is_within(place, triangle)
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
