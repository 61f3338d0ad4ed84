//! Where the explanations of a pixel in two scenes part: the ray or the term that differs most, as a
//! sentence about the first of them.

use super::names::{Names, colour, number, vector};
use super::{Subject, wording};
use render::{Explanation, LightTerm, RayEnd, Shading, TracedRay};
use scene::Rgb;

/// Relative differences up to this are rounding.
const ROUNDING: f64 = 1e-9;

/// Says why a pixel differs from the same pixel of a reference: what the ray or the term does that differs
/// most, and what it does in the reference. `None` if no ray of the samples differs.
pub fn parting(
    [of, reference]: [&Explanation; 2],
    [subject, its_subject]: [&Subject<'_>; 2],
) -> Option<String> {
    let sides = [Side::new(of, subject), Side::new(reference, its_subject)];
    let [a, b] = [of, reference].map(|side| side.rays.first());
    let (a, b) = a.zip(b)?;
    if !near(a.direction.to_array(), b.direction.to_array())
        || !near(a.origin.to_array(), b.origin.to_array())
    {
        return Some(camera([subject, its_subject]));
    }
    let mut found = Found::default();
    descend(&sides, [0, 0], &mut found);
    found.best.map(|(_, sentence)| sentence)
}

/// The explanation of one scene.
struct Side<'s> {
    explanation: &'s Explanation,
    children: Vec<Vec<usize>>,
    names: Names<'s>,
}

impl<'s> Side<'s> {
    fn new(explanation: &'s Explanation, subject: &'s Subject<'s>) -> Self {
        Self {
            explanation,
            children: explanation.children(),
            names: Names::new(subject),
        }
    }

    fn ray(&self, index: usize) -> &TracedRay {
        &self.explanation.rays[index]
    }

    /// What a ray and all that start at its end add to the sample.
    fn sum(&self, index: usize) -> Rgb {
        let mut sum = Rgb::ZERO;
        let mut open = vec![index];
        while let Some(index) = open.pop() {
            sum += self.ray(index).contribution;
            open.extend(&self.children[index]);
        }
        sum
    }
}

/// The largest difference so far. Of equal ones the first.
#[derive(Default)]
struct Found {
    best: Option<(f64, String)>,
}

impl Found {
    fn add(&mut self, difference: Rgb, sentence: impl FnOnce() -> String) {
        let size = difference.abs().max_element();
        let is_more = self.best.as_ref().is_none_or(|(most, _)| *most < size);
        // Neither rounding nor what is undefined on both sides.
        if 1e-12 < size && is_more {
            self.best = Some((size, sentence()));
        }
    }
}

/// Compares two rays and those that start at their ends, without recursion: paths are long.
fn descend(sides: &[Side<'_>; 2], first: [usize; 2], found: &mut Found) {
    let mut open = vec![first];
    while let Some(pair) = open.pop() {
        let [a, b] = [0, 1].map(|side| sides[side].ray(pair[side]));
        let place = if a.parent.is_none() {
            String::new()
        } else {
            format!("in the {}: ", wording::kind(a.kind).long)
        };
        let said = |sentence: String| format!("{place}{sentence}");
        let sums = || sides[0].sum(pair[0]) - sides[1].sum(pair[1]);
        match (&a.end, &b.end) {
            (RayEnd::Surface(of), RayEnd::Surface(its)) if is_same(of, its) => {
                terms(
                    [&sides[0].names, &sides[1].names],
                    [of, its],
                    a.weight,
                    &said,
                    found,
                );
                open.extend(pairs(sides, pair, &said, found));
            }
            (RayEnd::Missed { radiance: of, .. }, RayEnd::Missed { radiance: its, .. }) => {
                found.add(a.weight * (*of - *its), || {
                    said(against("the background is", &colour(*of), &colour(*its)))
                });
            }
            (RayEnd::Light(of), RayEnd::Light(its)) if of.light == its.light => {
                found.add(a.weight * (of.radiance - its.radiance), || {
                    let light = sides[0].names.light(of.light);
                    said(against(
                        &format!("{light}, seen itself, shines with"),
                        &colour(of.radiance),
                        &colour(its.radiance),
                    ))
                });
            }
            _ => found.add(sums(), || {
                let [of, its] = [(0, a), (1, b)].map(|(side, ray)| end(&sides[side].names, ray));
                said(format!("shows {of}: the reference shows {its}"))
            }),
        }
    }
}

/// The pairs of rays that go on from a pair. What goes on in one alone, or weighs more, is a difference.
fn pairs(
    sides: &[Side<'_>; 2],
    pair: [usize; 2],
    said: &dyn Fn(String) -> String,
    found: &mut Found,
) -> Vec<[usize; 2]> {
    let [of, its] = [0, 1].map(|side| &sides[side].children[pair[side]]);
    let mut pairs = Vec::new();
    let mut left: Vec<usize> = its.clone();
    for &child in of {
        let ray = sides[0].ray(child);
        let twin = left
            .iter()
            .position(|&other| sides[1].ray(other).kind == ray.kind);
        let Some(twin) = twin.map(|at| left.remove(at)) else {
            let kind = wording::kind(ray.kind).long;
            found.add(sides[0].sum(child), || {
                said(format!(
                    "a {kind} goes on from here, but not in the reference"
                ))
            });
            continue;
        };
        let other = sides[1].ray(twin);
        if near(ray.weight.to_array(), other.weight.to_array()) {
            pairs.push([child, twin]);
            continue;
        }
        found.add(sides[0].sum(child) - sides[1].sum(twin), || {
            let kind = wording::kind(ray.kind).long;
            let [of, its] = [ray.weight, other.weight].map(colour);
            said(against(&format!("the {kind} counts"), &of, &its))
        });
    }
    for other in left {
        let kind = wording::kind(sides[1].ray(other).kind).long;
        found.add(sides[1].sum(other), || {
            said(format!(
                "no {kind} goes on from here: one does in the reference"
            ))
        });
    }
    pairs
}

/// Whether two rays hit the same place of the same shape.
fn is_same(a: &Shading, b: &Shading) -> bool {
    near(a.hit.point.to_array(), b.hit.point.to_array()) && a.hit.side == b.hit.side
}

/// Compares what a surface sends toward a ray of this weight.
fn terms(
    names: [&Names<'_>; 2],
    [of, its]: [&Shading; 2],
    weight: Rgb,
    said: &dyn Fn(String) -> String,
    found: &mut Found,
) {
    let plain = [
        ("emission adds", of.emission, its.emission),
        ("ambient light adds", of.ambient, its.ambient),
        ("photons add", of.caustics, its.caustics),
        (
            "more lights add",
            of.unlisted.radiance,
            its.unlisted.radiance,
        ),
    ];
    for (name, of, its) in plain {
        found.add(weight * (of - its), || {
            said(against(name, &colour(of), &colour(its)))
        });
    }
    let absorbed = weight * (of.transmitted - its.transmitted) * of.radiance;
    found.add(absorbed, || {
        let [of, its] = [of.transmitted, its.transmitted].map(colour);
        said(against("what is inside lets through", &of, &its))
    });
    let count = of.lights.len().max(its.lights.len());
    for at in 0..count {
        match (of.lights.get(at), its.lights.get(at)) {
            (Some(a), Some(b)) => found.add(weight * (a.radiance - b.radiance), || {
                said(light(names, [a, b]))
            }),
            (Some(a), None) => found.add(weight * a.radiance, || {
                let light = names[0].light(a.light);
                said(format!("lit by {light}, which the reference does not have"))
            }),
            (None, Some(b)) => found.add(weight * b.radiance, || {
                let light = names[1].light(b.light);
                said(format!(
                    "a light is missing: the reference is lit by its {light}"
                ))
            }),
            (None, None) => {}
        }
    }
}

/// Why a light adds something else than in the reference.
fn light([names, its_names]: [&Names<'_>; 2], [a, b]: [&LightTerm; 2]) -> String {
    let light = names.light(a.light);
    match (dark(names, a), dark(its_names, b)) {
        (Some(reason), None) => format!("{reason}: the reference is lit by {light}"),
        (None, Some(reason)) => format!("lit by {light}: in the reference {reason}"),
        _ => {
            let differ = |a: f64, b: f64| !near([a], [b]);
            let leaves = |what: &str, [of, its]: [String; 2]| {
                format!("{what} {of} of {light}, in the reference {its}")
            };
            let [through, its_through] = [a, b].map(|term| term.transmittance.unwrap_or(1.0));
            if differ(through, its_through) {
                leaves("objects let through", [through, its_through].map(number))
            } else if differ(a.radial, b.radial) {
                leaves("attenuation leaves", [a.radial, b.radial].map(number))
            } else if differ(a.spot, b.spot) {
                leaves("the cone leaves", [a.spot, b.spot].map(number))
            } else if !near(a.arriving.to_array(), b.arriving.to_array()) {
                let [of, its] = [a, b].map(|term| colour(term.arriving));
                against(&format!("{light} sends"), &of, &its)
            } else if differ(a.cosine, b.cosine) {
                let [of, its] = [a, b].map(|term| number(term.cosine));
                against(&format!("N·L to {light} is"), &of, &its)
            } else {
                let reflected = [a, b].map(|term| colour(term.reflected));
                leaves("the surface reflects", reflected)
            }
        }
    }
}

/// Why a light adds nothing, if it does not.
fn dark(names: &Names<'_>, term: &LightTerm) -> Option<String> {
    let reason = term.dark?;
    let blocker = term
        .crossed
        .iter()
        .find(|crossed| crossed.transmittance == 0.0);
    let light = names.light(term.light);
    Some(match blocker {
        Some(blocker) => format!("in shadow of {}", names.object(blocker.object)),
        None => format!("{light} adds nothing ({})", wording::unlit(reason).long),
    })
}

/// What a ray led to.
fn end(names: &Names<'_>, ray: &TracedRay) -> String {
    match &ray.end {
        RayEnd::Missed { .. } => "the background".to_owned(),
        RayEnd::OverBudget => "nothing, as there were too many rays".to_owned(),
        RayEnd::Light(hit) => names.light(hit.light),
        RayEnd::Surface(shading) => {
            let hit = &shading.hit;
            format!("{} at {}", names.object(hit.object), vector(hit.point))
        }
    }
}

/// What of the cameras differs.
fn camera([of, its]: [&Subject<'_>; 2]) -> String {
    let [eye, its_eye] = [of, its].map(|subject| subject.camera.eye);
    if near(eye.to_array(), its_eye.to_array()) {
        "seen in another direction than in the reference: the cameras differ".to_owned()
    } else {
        against("seen from", &vector(eye), &vector(its_eye))
    }
}

fn against(what: &str, of: &str, its: &str) -> String {
    format!("{what} {of}, in the reference {its}")
}

/// Whether numbers are equal up to rounding.
fn near<const N: usize>(a: [f64; N], b: [f64; N]) -> bool {
    let size = a
        .iter()
        .chain(&b)
        .fold(0.0, |most: f64, of| most.max(of.abs()));
    a.iter()
        .zip(&b)
        .all(|(a, b)| (a - b).abs() <= ROUNDING * size || a == b || a.is_nan() && b.is_nan())
}
