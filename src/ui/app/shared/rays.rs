//! The lines of an explanation: rays, and below each what its end adds and the rays that start there.

use std::collections::BTreeSet;

use glam::DVec3;

use render::{EmitterTerm, Explanation, LightTerm, RayEnd, TracedRay};
use scene::Rgb;

/// How far rays that hit nothing are drawn, relative to the distance of their start from the eye.
const FAR: f64 = 100.0;

/// A line of an explanation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayLine {
    /// The number of the ray.
    pub ray: usize,
    /// What of it the line shows.
    pub part: RayPart,
    /// The number of lines that it is inside of.
    pub depth: usize,
}

/// What a line shows of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayPart {
    /// The ray itself, with everything that comes back along it.
    Whole,
    /// What the surface emits.
    Emission,
    /// Reflected ambient light.
    Ambient,
    /// Reflected light of photons.
    Caustics,
    /// The reflected light of one light, by its place in the list.
    Light(usize),
    /// Lights too many to list.
    Unlisted,
    /// The reflected light of an object that emits light, by its place in the list.
    Emitter(usize),
    /// Why no rays go on.
    Stop,
}

/// A part of a path in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    /// Its ends.
    pub ends: [DVec3; 2],
    /// Whether no light comes along it.
    pub is_dark: bool,
}

/// The lines of an explanation, without those inside of folded rays.
pub(crate) fn lines(explanation: &Explanation, folded: &BTreeSet<usize>) -> Vec<RayLine> {
    let mut lines = Vec::new();
    let children = explanation.children();
    let mut left: Vec<_> = (!explanation.rays.is_empty())
        .then_some((0, 0))
        .into_iter()
        .collect();
    while let Some((ray, depth)) = left.pop() {
        let line = |part, depth| RayLine { ray, part, depth };
        lines.push(line(RayPart::Whole, depth));
        if folded.contains(&ray) {
            continue;
        }
        let parts = parts(&explanation.rays[ray]);
        lines.extend(parts.into_iter().map(|part| line(part, depth + 1)));
        left.extend(children[ray].iter().rev().map(|&child| (child, depth + 1)));
    }
    lines
}

/// What the end of a ray consists of, apart from the rays that start there.
fn parts(ray: &TracedRay) -> Vec<RayPart> {
    let Some(shading) = ray.shading() else {
        return Vec::new();
    };
    let mut parts = Vec::new();
    parts.extend((shading.emission != Rgb::ZERO).then_some(RayPart::Emission));
    parts.extend((shading.ambient != Rgb::ZERO).then_some(RayPart::Ambient));
    parts.extend((0..shading.lights.len()).map(RayPart::Light));
    parts.extend((0 < shading.unlisted.lights).then_some(RayPart::Unlisted));
    parts.extend((0..shading.emitters.len()).map(RayPart::Emitter));
    parts.extend((shading.caustics != Rgb::ZERO).then_some(RayPart::Caustics));
    parts.extend(shading.stop.map(|_| RayPart::Stop));
    parts
}

/// Whether a ray has lines inside of it.
pub(crate) fn is_foldable(explanation: &Explanation, ray: usize) -> bool {
    let mut rays = explanation.rays.iter();
    !parts(&explanation.rays[ray]).is_empty() || rays.any(|child| child.parent == Some(ray))
}

impl RayLine {
    /// The ray.
    pub fn ray<'e>(&self, explanation: &'e Explanation) -> &'e TracedRay {
        &explanation.rays[self.ray]
    }

    /// The light of a line that shows one.
    pub fn light<'e>(&self, explanation: &'e Explanation) -> Option<&'e LightTerm> {
        match self.part {
            RayPart::Light(at) => self.ray(explanation).shading()?.lights.get(at),
            _ => None,
        }
    }

    /// The emitter of a line that shows one.
    pub fn emitter<'e>(&self, explanation: &'e Explanation) -> Option<&'e EmitterTerm> {
        match self.part {
            RayPart::Emitter(at) => self.ray(explanation).shading()?.emitters.get(at),
            _ => None,
        }
    }

    /// What it adds to the sample.
    pub fn adds(&self, explanation: &Explanation) -> Rgb {
        let ray = self.ray(explanation);
        let Some(shading) = ray.shading().filter(|_| self.part != RayPart::Whole) else {
            return total(explanation, self.ray);
        };
        let radiance = match self.part {
            RayPart::Whole | RayPart::Stop => Rgb::ZERO,
            RayPart::Emission => shading.emission,
            RayPart::Ambient => shading.ambient,
            RayPart::Caustics => shading.caustics,
            RayPart::Unlisted => shading.unlisted.radiance,
            RayPart::Light(_) => {
                let light = self.light(explanation);
                light.map_or(Rgb::ZERO, |light| light.radiance)
            }
            RayPart::Emitter(_) => {
                let emitter = self.emitter(explanation);
                emitter.map_or(Rgb::ZERO, |emitter| emitter.radiance)
            }
        };
        ray.weight * shading.transmitted * radiance
    }

    /// The path of light from the eye to what the line shows.
    pub(crate) fn path(&self, explanation: &Explanation) -> Vec<Segment> {
        let mut chain = Vec::new();
        let mut next = Some(self.ray);
        while let Some(ray) = next.and_then(|ray| explanation.rays.get(ray)) {
            chain.push(ray);
            next = ray.parent;
        }
        let eye = chain.last().map_or(DVec3::ZERO, |camera| camera.origin);
        let rays = chain.iter().rev().map(|ray| Segment {
            ends: [ray.origin, end_of(ray, eye)],
            is_dark: false,
        });
        let light = self.light(explanation);
        let light = light.filter(|light| light.toward.is_finite()).map(|light| {
            let mut crossed = light.crossed.iter();
            let blocked = crossed.find(|crossing| crossing.transmittance == 0.0);
            let length = blocked.map_or(light.distance, |crossing| crossing.t);
            (light.toward, length, light.radiance)
        });
        let emitter = self.emitter(explanation);
        let emitter = emitter.map(|emitter| (emitter.toward, emitter.distance, emitter.radiance));
        let last = light.or(emitter).zip(self.ray(explanation).shading());
        let last = last.map(|((toward, length, radiance), shading)| {
            let point = shading.hit.point;
            Segment {
                ends: [point, along(point, toward, length, eye)],
                is_dark: radiance == Rgb::ZERO,
            }
        });
        rays.chain(last).collect()
    }
}

/// What a ray and the rays behind it add to the sample.
fn total(explanation: &Explanation, ray: usize) -> Rgb {
    let rays = &explanation.rays;
    let mut is_inside = vec![false; rays.len()];
    let mut sum = Rgb::ZERO;
    for (number, of) in rays.iter().enumerate().skip(ray) {
        is_inside[number] = number == ray || of.parent.is_some_and(|parent| is_inside[parent]);
        if is_inside[number] {
            sum += of.contribution;
        }
    }
    sum
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
