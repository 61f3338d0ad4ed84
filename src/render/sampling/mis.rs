//! Multiple importance sampling of two techniques.

use geometry::lanes::Lanes;

/// The probability densities, per steradian, with which two techniques choose a direction to what
/// emits light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Densities {
    /// By sampling what emits light.
    pub by_light: f64,
    /// By continuing the path.
    pub by_path: f64,
    /// The multiple importance sampling weight of the technique used.
    pub weight: f64,
}

impl Densities {
    /// For a direction that was chosen by sampling what emits light.
    pub(crate) fn for_light(by_light: f64, by_path: f64) -> Self {
        Self {
            by_light,
            by_path,
            weight: power_heuristic(by_light, by_path),
        }
    }

    /// For a direction in which a path went on.
    pub(crate) fn for_path(by_path: f64, by_light: f64) -> Self {
        Self {
            by_light,
            by_path,
            weight: power_heuristic(by_path, by_light),
        }
    }
}

/// Veach's power heuristic: the weight of a sample with density `own` that another technique would
/// produce with density `other`, in each lane.
#[inline(always)]
pub(crate) fn power_heuristic<N: Lanes>(own: N, other: N) -> N {
    let ratio = other / own;
    let one = own.all(1.0);
    one / (one + ratio * ratio)
}

/// The multiple importance sampling weight over the density of a direction that was chosen by
/// sampling what emits light, in each lane.
#[inline(always)]
pub(crate) fn weight_over_density<N: Lanes>(by_light: N, by_path: N) -> N {
    power_heuristic(by_light, by_path) / by_light
}
