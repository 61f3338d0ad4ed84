//! Lights that are too many for each to be sampled at every surface: one is chosen through a tree.

use std::sync::Arc;

use glam::DVec3;

use super::cone::{Cone, Reach};
use super::tree::Tree;
use super::{Picked, strength};
use crate::light::radiant_intensity;
use crate::sampling::Fours;
use geometry::lanes::{Row, Simd, Vector, WIDTH};
use geometry::{Aabb, IsCancelled};
use scene::{Emitter, Light};

/// Up to this number of lights that fade with the square of the distance, each is sampled at every
/// surface.
const MOST_SAMPLED_EACH: usize = 16;

/// The lights that fade with the square of the distance, if there are many. Each of the others is
/// sampled at every surface: their distance does not tell how much light arrives.
#[derive(Clone, Debug, Default)]
pub(crate) struct ManyLights {
    /// Their indices in the scene, in ascending order.
    numbers: Vec<u32>,
    /// The indices of all other lights.
    others: Vec<u32>,
    reaches: Vec<Reach>,
    tree: Tree,
}

impl ManyLights {
    /// Collects the lights, or returns those known if they are the same; `None` once `cancelled`
    /// returns true.
    pub(crate) fn build(
        lights: &[Light],
        known: Option<&Arc<Self>>,
        cancelled: IsCancelled<'_>,
    ) -> Option<Arc<Self>> {
        let numbered = (0_u32..).zip(lights);
        let found = numbered.filter_map(|(number, light)| Some((number, reach(light)?)));
        let (numbers, reaches): (Vec<_>, Vec<_>) = found.unzip();
        if numbers.len() <= MOST_SAMPLED_EACH {
            return Some(Arc::new(Self::none(lights)));
        }
        let is_other = |number: &u32| numbers.binary_search(number).is_err();
        let others: Vec<_> = (0..lights.len() as u32).filter(is_other).collect();
        let is_known = |known: &&Arc<Self>| {
            (&known.numbers, &known.others, &known.reaches) == (&numbers, &others, &reaches)
        };
        if let Some(known) = known.filter(is_known) {
            return Some(Arc::clone(known));
        }
        let tree = Tree::build(&reaches, cancelled)?;
        Some(Arc::new(Self {
            numbers,
            others,
            reaches,
            tree,
        }))
    }

    /// None: each light is sampled at every surface.
    pub(crate) fn none(lights: &[Light]) -> Self {
        Self {
            others: (0..lights.len() as u32).collect(),
            ..Self::default()
        }
    }

    /// Whether there are none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The index of the first of them.
    pub(crate) fn first(&self) -> usize {
        self.numbers[0] as usize
    }

    /// The indices of all other lights in the scene, each of which is sampled at every surface.
    pub(crate) fn others(&self) -> impl Iterator<Item = usize> {
        self.others.iter().map(|&number| number as usize)
    }

    /// The choice of [`Self::choose_together`] for one surface.
    #[cfg(test)]
    pub(crate) fn choose(
        &self,
        (from, normal): (DVec3, DVec3),
        [_, _, number, _]: [f64; 4],
    ) -> Option<(usize, f64)> {
        let chosen = self.tree.choose(from, normal, number);
        chosen.map(|chosen| self.light(chosen.into()))
    }

    /// Chooses one of the lights for each surface in lanes, at points with normals, by the third of its
    /// numbers in 0..1; returns its index and the probability. `None` if none lights it.
    #[inline(always)]
    pub(crate) fn choose_together<S: Simd>(
        &self,
        simd: S,
        at: (&Vector<Row>, &Vector<Row>),
        Fours([_, _, numbers, _]): &Fours,
        lanes: u32,
    ) -> [Option<(usize, f64)>; WIDTH] {
        let picked = self.tree.choose_together(simd, at, numbers, lanes);
        picked.map(|picked| Some(self.light(picked?)))
    }

    /// The index of a light that was picked, and the probability.
    fn light(&self, Picked { emitter, chance }: Picked) -> (usize, f64) {
        (self.numbers[emitter as usize] as usize, chance)
    }

    /// The probability with which the light with this index is sampled at a surface at a point with a
    /// normal.
    pub(crate) fn chance(&self, number: u32, (from, normal): (DVec3, DVec3)) -> f64 {
        let found = self.numbers.binary_search(&number);
        found.map_or(1.0, |emitter| {
            self.tree.chance(emitter as u32, from, normal)
        })
    }
}

/// What a light may reach; `None` if it does not fade with the square of the distance, or is dark.
fn reach(light: &Light) -> Option<Reach> {
    let Emitter::Point {
        position, radius, ..
    } = light.emitter
    else {
        return None;
    };
    let strength = strength(radiant_intensity(light)?);
    (0.0 < strength).then_some(Reach {
        bounds: Aabb {
            min: position - radius,
            max: position + radius,
        },
        cone: Cone::ALL,
        strength,
    })
}
