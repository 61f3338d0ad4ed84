//! Intersections of rays and shapes.

use smallvec::SmallVec;

use super::lanes::{Eight, Simd, SimdBase, WIDTH, bits, each_bit};
use super::line::{End, Ends};

/// A crossing of a ray and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in units of its direction.
    pub t: f64,
    /// The part of the shape's surface; each shape numbers its own.
    pub part: u32,
}

/// The hits of eight rays, one per lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hits {
    /// A mask of the rays that hit, lowest bit first.
    pub lanes: u32,
    distances: [f64; WIDTH],
    parts: [f64; WIDTH],
}

impl Hits {
    /// No ray hits.
    pub const NONE: Self = Self {
        lanes: 0,
        distances: [0.0; WIDTH],
        parts: [0.0; WIDTH],
    };

    /// The hits of the given lanes, by distances and parts.
    #[inline(always)]
    pub fn of<S: Simd>(lanes: u32, distances: Eight<S>, parts: Eight<S>) -> Self {
        Self {
            lanes,
            distances: *distances,
            parts: *parts,
        }
    }

    /// Collects the hits of all lanes.
    #[cfg(test)]
    pub(super) fn new(mut hit: impl FnMut(usize) -> Option<Hit>) -> Self {
        let mut hits = Self::NONE;
        for lane in 0..WIDTH {
            hits.put(lane, hit(lane));
        }
        hits
    }

    /// The hits in some lanes only.
    #[must_use]
    #[inline(always)]
    pub fn within(self, lanes: u32) -> Self {
        Self {
            lanes: self.lanes & lanes,
            ..self
        }
    }

    /// Collects the hits of the given lanes, one by one; `None` if none of them hits.
    #[inline(always)]
    pub fn one_by_one(lanes: u32, hit: impl FnMut(usize) -> Option<Hit>) -> Option<Self> {
        Self::NONE.and(lanes, hit)
    }

    /// Adds the hits of further lanes, one by one; `None` if no lane hits at all.
    #[inline(always)]
    pub(super) fn and(
        mut self,
        lanes: u32,
        mut hit: impl FnMut(usize) -> Option<Hit>,
    ) -> Option<Self> {
        for lane in each_bit(lanes) {
            let lane = lane % WIDTH;
            self.put(lane, hit(lane));
        }
        (self.lanes != 0).then_some(self)
    }

    /// Replaces the hit of a lane.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, hit: Option<Hit>) {
        self.lanes &= !(1 << lane);
        if let Some(Hit { t, part }) = hit {
            self.lanes |= 1 << lane;
            self.distances[lane] = t;
            self.parts[lane] = f64::from(part);
        }
    }

    /// The distances along the rays.
    #[inline(always)]
    pub fn distances<S: Simd>(&self, simd: S) -> Eight<S> {
        Eight::load_array(simd, self.distances)
    }

    /// The parts of the surface.
    #[inline(always)]
    pub fn parts<S: Simd>(&self, simd: S) -> Eight<S> {
        Eight::load_array(simd, self.parts)
    }

    /// Distances and parts as SIMD vectors.
    #[inline(always)]
    pub(super) fn ends<S: Simd>(&self, simd: S) -> End<Eight<S>> {
        End {
            t: self.distances(simd),
            part: self.parts(simd),
        }
    }

    /// The hit of a ray whose bit is set in `lanes`.
    #[inline]
    pub fn hit(&self, lane: usize) -> Hit {
        Hit {
            t: self.distances[lane % WIDTH],
            part: self.parts[lane % WIDTH] as u32,
        }
    }
}

impl From<Hit> for End<f64> {
    #[inline(always)]
    fn from(Hit { t, part }: Hit) -> Self {
        Self {
            t,
            part: part.into(),
        }
    }
}

impl From<End<f64>> for Hit {
    #[inline(always)]
    fn from(End { t, part }: End<f64>) -> Self {
        Self {
            t,
            part: part as u32,
        }
    }
}

impl From<Ends<f64>> for Crossings {
    #[inline(always)]
    fn from(Ends { enter, exit, .. }: Ends<f64>) -> Self {
        Self {
            enter: enter.into(),
            exit: exit.into(),
        }
    }
}

impl<S: Simd> End<Eight<S>> {
    /// The crossings as hits of the given lanes.
    #[inline(always)]
    pub(super) fn hits(self, lanes: u32) -> Hits {
        Hits::of(lanes, self.t, self.part)
    }
}

impl<S: Simd> Ends<Eight<S>> {
    /// The nearer crossings with 0 < t < limit, in the given lanes.
    #[inline(always)]
    pub(super) fn hits(self, limits: Eight<S>, lanes: u32) -> Option<Hits> {
        let (end, hit) = self.nearest(limits);
        let lanes = bits(hit) & lanes;
        (lanes != 0).then(|| end.hits(lanes))
    }
}

/// Where a line enters and leaves a solid. Distances along the ray may be negative, and are
/// infinite if no surface bounds that end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossings {
    /// Where the line enters the solid.
    pub enter: Hit,
    /// Where it leaves the solid, not before `enter`.
    pub exit: Hit,
}

/// The parts of a line inside a solid, disjoint and in ascending order.
pub type Spans = SmallVec<[Crossings; 4]>;

impl Crossings {
    /// The whole line, which no surface bounds.
    pub(super) const EVERYWHERE: Self = Self {
        enter: Hit {
            t: f64::NEG_INFINITY,
            part: 0,
        },
        exit: Hit {
            t: f64::INFINITY,
            part: 0,
        },
    };

    /// The nearer crossing with `0 < t < limit`.
    #[inline]
    pub fn nearest(self, limit: f64) -> Option<Hit> {
        [self.enter, self.exit]
            .into_iter()
            .find(|hit| 0.0 < hit.t && hit.t < limit)
    }

    /// The interval inside both solids, if any.
    #[inline]
    pub(super) fn overlap(self, other: Self) -> Option<Self> {
        let enter = if self.enter.t < other.enter.t {
            other.enter
        } else {
            self.enter
        };
        let exit = if other.exit.t < self.exit.t {
            other.exit
        } else {
            self.exit
        };
        (enter.t <= exit.t).then_some(Self { enter, exit })
    }

    /// Moves the origin of distances back by `start`; `None` if a distance is NaN.
    #[inline]
    pub(super) fn shifted(mut self, start: f64) -> Option<Self> {
        self.enter.t += start;
        self.exit.t += start;
        (self.enter.t <= self.exit.t).then_some(self)
    }
}
