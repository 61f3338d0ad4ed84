//! Splits emitters in two, so that each part is bright, small and shines to one side.

use std::f64::consts::PI;

use glam::DVec3;

use super::cone::Reach;
use geometry::Aabb;

/// Intervals along each axis between which emitters are split.
const BINS: usize = 12;

/// What a number of emitters cover together.
#[derive(Clone, Copy)]
struct Sum {
    bounds: Aabb,
    /// The axes of their cones, each times its strength.
    axes: DVec3,
    strength: f64,
    count: usize,
}

impl Sum {
    const EMPTY: Self = Self {
        bounds: Aabb::EMPTY,
        axes: DVec3::ZERO,
        strength: 0.0,
        count: 0,
    };

    fn of(reach: &Reach) -> Self {
        let Reach {
            bounds,
            cone,
            strength,
        } = *reach;
        // Opposite normals of emitters that shine to both sides must not cancel.
        let is_turned = cone.is_two_sided && cone.axis.dot(DVec3::new(1.0, 0.7, 0.4)) < 0.0;
        let axis = if is_turned { -cone.axis } else { cone.axis };
        // A cone of all directions has no axis.
        let narrow = 0.5 * (1.0 + cone.cosine);
        Self {
            bounds,
            axes: strength * narrow * axis,
            strength,
            count: 1,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            bounds: self.bounds.union(other.bounds),
            axes: self.axes + other.axes,
            strength: self.strength + other.strength,
            count: self.count + other.count,
        }
    }

    /// Strength × extent × solid angle lit. The mean resultant length of the axes stands for the cone
    /// around them: 1 for one direction, which lights π steradians weighted by the cosine, 0 for all.
    fn cost(&self) -> f64 {
        let narrow = self.axes.length() / self.strength;
        let angle = PI * (4.0 - 3.0 * narrow * narrow);
        self.strength * self.bounds.size().length_squared() * angle
    }
}

/// Reorders emitters, two or more, into two parts that are not empty; returns the size of the first.
/// Minimises the surface area orientation heuristic over equal intervals along each axis.
pub(super) fn partition(emitters: &[Reach], order: &mut [u32]) -> usize {
    let of = |emitter: u32| &emitters[emitter as usize];
    let centres = order.iter().fold(Aabb::EMPTY, |all, &emitter| {
        let centre = of(emitter).bounds.centre();
        all.union(Aabb {
            min: centre,
            max: centre,
        })
    });
    let size = centres.size();
    let bin = |emitter: u32, axis: usize| {
        let place = (of(emitter).bounds.centre() - centres.min)[axis] / size[axis];
        ((place * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in (0..3).filter(|&axis| 0.0 < size[axis]) {
        let mut bins = [Sum::EMPTY; BINS];
        for &emitter in &*order {
            let bin = &mut bins[bin(emitter, axis)];
            *bin = bin.and(Sum::of(of(emitter)));
        }
        let mut below = [Sum::EMPTY; BINS];
        let mut sum = Sum::EMPTY;
        for (below, bin) in below.iter_mut().zip(&bins) {
            *below = sum;
            sum = sum.and(*bin);
        }
        // Thin parts are bad.
        let thinness = size.max_element() / size[axis];
        let mut above = Sum::EMPTY;
        for first in (1..BINS).rev() {
            above = above.and(bins[first]);
            if above.count == 0 || below[first].count == 0 {
                continue;
            }
            let cost = thinness * (below[first].cost() + above.cost());
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, first));
            }
        }
    }
    let Some((_, axis, first)) = best else {
        return order.len() / 2;
    };
    let mut placed = 0;
    for at in 0..order.len() {
        if bin(order[at], axis) < first {
            order.swap(placed, at);
            placed += 1;
        }
    }
    placed
}
