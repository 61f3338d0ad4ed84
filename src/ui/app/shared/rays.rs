//! The ways of light that the lines of an explanation show.

use glam::DVec3;

use explain::RayLine;
use render::{Explanation, RayEnd, TracedRay};
use scene::Rgb;

/// How far rays that hit nothing are drawn, relative to the distance of their start from the eye.
const FAR: f64 = 100.0;

/// A part of a path in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    /// Its ends.
    pub ends: [DVec3; 2],
    /// Whether no light comes along it.
    pub is_dark: bool,
}

/// The path of light from the eye to what a line shows.
pub(crate) fn path(explanation: &Explanation, line: &RayLine) -> Vec<Segment> {
    let mut chain = Vec::new();
    let mut next = Some(line.ray);
    while let Some(ray) = next.and_then(|ray| explanation.rays.get(ray)) {
        chain.push(ray);
        next = ray.parent;
    }
    let eye = chain.last().map_or(DVec3::ZERO, |camera| camera.origin);
    let rays = chain.iter().rev().map(|ray| Segment {
        ends: [ray.origin, end_of(ray, eye)],
        is_dark: false,
    });
    let light = line.light(explanation);
    let light = light.filter(|light| light.toward.is_finite()).map(|light| {
        let mut crossed = light.crossed.iter();
        let blocked = crossed.find(|crossing| crossing.transmittance == 0.0);
        let length = blocked.map_or(light.distance, |crossing| crossing.t);
        (light.toward, length, light.radiance)
    });
    let emitter = line.emitter(explanation);
    let emitter = emitter.map(|emitter| (emitter.toward, emitter.distance, emitter.radiance));
    let last = light.or(emitter).zip(line.ray(explanation).shading());
    let last = last.map(|((toward, length, radiance), shading)| {
        let point = shading.hit.point;
        Segment {
            ends: [point, along(point, toward, length, eye)],
            is_dark: radiance == Rgb::ZERO,
        }
    });
    rays.chain(last).collect()
}

/// Where a ray ends.
fn end_of(ray: &TracedRay, eye: DVec3) -> DVec3 {
    let length = match &ray.end {
        RayEnd::Surface(shading) => return shading.hit.point,
        RayEnd::Light(hit) => hit.t,
        RayEnd::Missed { .. } | RayEnd::OverBudget => f64::INFINITY,
    };
    along(ray.origin, ray.direction, length, eye)
}

/// The end of a line, which is cut if it is infinite.
fn along(from: DVec3, direction: DVec3, length: f64, eye: DVec3) -> DVec3 {
    let far = FAR * (1.0 + (from - eye).length());
    from + length.min(far) * direction
}
