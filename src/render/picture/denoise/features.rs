//! What tells surfaces apart, and the albedo that light is divided by.

use super::plane::{Layout, Plane};
use crate::integrators::Guide;

/// The albedo that light is divided by at least, unless the surface is black.
const LEAST_ALBEDO: f32 = 0.1;

/// The surfaces of a picture.
pub(super) struct Features<'c> {
    pub(super) layout: Layout<'c>,
    /// Mean normals.
    pub(super) normal: [Plane; 3],
    /// Mean albedos.
    pub(super) albedo: [Plane; 3],
    /// Mean reciprocals of distances; not a number where there is no pixel, or one to leave out.
    pub(super) nearness: Plane,
    /// The change of nearness from a pixel to the next, across and down.
    pub(super) slope: [Plane; 2],
    /// How far the surfaces of each pixel may be from others in space and still count as the same.
    pub(super) slack: Plane,
}

impl<'c> Features<'c> {
    /// The features of a picture, given sums of so many samples.
    pub(super) fn new(layout: Layout<'c>, sums: &[Guide], samples: u32) -> Self {
        let share = 1.0 / samples.max(1) as f32;
        let mean =
            |of: fn(&Guide) -> f32, beyond| layout.filled(beyond, |at| share * of(&sums[at]));
        let nearness = mean(|guide| guide.nearness, f32::NAN);
        Self {
            layout,
            normal: [
                mean(|guide| guide.normal[0], 0.0),
                mean(|guide| guide.normal[1], 0.0),
                mean(|guide| guide.normal[2], 0.0),
            ],
            albedo: [
                mean(|guide| guide.albedo[0], 0.0),
                mean(|guide| guide.albedo[1], 0.0),
                mean(|guide| guide.albedo[2], 0.0),
            ],
            slope: [1, layout.stride].map(|stride| slope(layout, &nearness, stride)),
            nearness,
            slack: layout.plane(0.0),
        }
    }

    /// What the light at a place is divided by, before surfaces mix.
    pub(super) fn divisor(&self, place: usize) -> [f32; 3] {
        let albedo = self.albedo.each_ref().map(|plane| plane[place]);
        if albedo.iter().all(|&channel| channel <= 0.0) {
            return [1.0; 3];
        }
        albedo.map(|channel| channel.clamp(LEAST_ALBEDO, f32::MAX))
    }
}

/// The change of nearness over a stride: of two neighbours that to the flatter one, as the other may
/// be of another surface.
fn slope(layout: Layout<'_>, nearness: &Plane, stride: usize) -> Plane {
    layout.filled(0.0, |pixel| {
        let at = layout.place(pixel);
        let near = |at: Option<usize>| at.and_then(|at| nearness.get(at)).copied();
        let before = near(at.checked_sub(stride)).map(|before| nearness[at] - before);
        let after = near(Some(at + stride)).map(|after| after - nearness[at]);
        let known = [before, after].into_iter().flatten();
        let flatter = |a: f32, b: f32| if a.abs() < b.abs() { a } else { b };
        known
            .filter(|change| change.is_finite())
            .reduce(flatter)
            .unwrap_or(0.0)
    })
}
