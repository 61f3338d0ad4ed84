//! The lines of an explanation in the few words that the interface has room for, with their numbers
//! beside them.

use super::lines::{RayLine, RayPart};
use super::names::{channels, exact_percent, number, numbers};
use super::wording;
use render::{Densities, EmitterTerm, Explanation, LightTerm, RayEnd, Shading, UnlitReason};

/// A value of a line, and what it is.
pub type Value = (&'static str, String);

/// The words of a line, given the name of the object or light that it tells of.
pub fn label(explanation: &Explanation, line: &RayLine, name: String) -> String {
    let ray = line.ray(explanation);
    match line.part {
        RayPart::Whole => {
            let end = match &ray.end {
                RayEnd::Surface(_) | RayEnd::Light(_) => name,
                RayEnd::Missed { .. } => "nothing".to_owned(),
                RayEnd::OverBudget => "not traced: over budget".to_owned(),
            };
            format!("{} → {end}", wording::kind(ray.kind).short)
        }
        RayPart::Emission => "emission".to_owned(),
        RayPart::Ambient => "ambient light".to_owned(),
        RayPart::Caustics => "photons".to_owned(),
        RayPart::Light(_) => {
            let dark = line.light(explanation).and_then(|light| light.dark);
            with_reason(name, dark)
        }
        RayPart::Emitter(_) => line.emitter(explanation).map_or(String::new(), |emitter| {
            let of = match emitter.object {
                Some(_) => format!("emission of {name}"),
                None => "environment".to_owned(),
            };
            with_reason(of, emitter.dark)
        }),
        RayPart::Unlisted => {
            let count = ray.shading().map_or(0, |shading| shading.unlisted.lights);
            format!("{count} more lights")
        }
        RayPart::Stop => match ray.shading().and_then(|shading| shading.stop) {
            Some(stop) => wording::stop(stop, explanation.depth).short,
            None => String::new(),
        },
        // Properties of the surface are among the values of the ray.
        _ => String::new(),
    }
}

/// The name of a light, and why it adds nothing, if so.
fn with_reason(name: String, dark: Option<UnlitReason>) -> String {
    match dark {
        Some(dark) => format!("{name}: {}", wording::unlit(dark).short),
        None => name,
    }
}

/// The numbers of a line, apart from what it adds. `name` names an object, if its name is known.
pub fn values(
    explanation: &Explanation,
    line: &RayLine,
    name: impl Fn(u32) -> Option<String>,
) -> Vec<Value> {
    let ray = line.ray(explanation);
    let mut values = Vec::new();
    match (line.part, &ray.end) {
        (RayPart::Light(_), _) => {
            if let Some(light) = line.light(explanation) {
                values.extend(light_values(light, name));
            }
        }
        (RayPart::Emitter(_), _) => {
            let emitter = line.emitter(explanation).into_iter();
            values.extend(emitter.flat_map(emitter_values));
        }
        (RayPart::Emission, RayEnd::Surface(shading)) => {
            values.extend(shading.densities.map(weight));
        }
        (RayPart::Whole, end) => {
            values.push(("weight", channels(ray.weight)));
            if let Some(chosen) = ray.chosen {
                values.push(("chance", exact_percent(chosen.chance * chosen.survival)));
                values.extend(chosen.density.map(|of| ("density", number(of))));
            }
            match end {
                RayEnd::Surface(shading) => values.extend(surface_values(shading)),
                RayEnd::Light(hit) => {
                    values.push(("t", number(hit.t)));
                    values.push(("radiance", channels(hit.radiance)));
                    values.extend(hit.densities.map(weight));
                }
                RayEnd::Missed { densities, .. } => values.extend(densities.map(weight)),
                RayEnd::OverBudget => {}
            }
        }
        _ => {}
    }
    values
}

fn surface_values(shading: &Shading) -> Vec<Value> {
    let hit = &shading.hit;
    let mut values = Vec::new();
    if let Some(boundary) = shading.boundary {
        let share = exact_percent(boundary.reflectance);
        let indices = boundary.indices.map(number).join(" to ");
        values.push(("reflects", format!("{share}, n {indices}")));
    }
    values.extend([
        ("side", wording::side_of(hit).short),
        ("t", number(hit.t)),
        ("point", numbers(&hit.point.to_array())),
        ("normal", numbers(&hit.normal.to_array())),
    ]);
    values
}

fn light_values(light: &LightTerm, name: impl Fn(u32) -> Option<String>) -> Vec<Value> {
    let mut crossed = light.crossed.iter();
    let blocker = crossed.find(|crossing| crossing.transmittance == 0.0);
    let blocker = blocker.and_then(|crossing| name(crossing.object));
    let visible = match (light.transmittance, blocker) {
        (_, Some(blocker)) => format!("no: {blocker}"),
        (Some(share), None) => exact_percent(share),
        (None, None) => "not traced".to_owned(),
    };
    let mut values = vec![
        ("visible", visible),
        ("N·L", number(light.cosine)),
        ("reflects", channels(light.reflected)),
        ("distance", number(light.distance)),
        ("falloff", number(light.radial)),
    ];
    if light.chance != 1.0 {
        values.push(("chosen with", exact_percent(light.chance)));
    }
    if light.spot != 1.0 {
        values.push(("cone", number(light.spot)));
    }
    values.extend(light.densities.map(weight));
    values
}

fn emitter_values(emitter: &EmitterTerm) -> Vec<Value> {
    let mut values = vec![
        ("N·L", number(emitter.cosine)),
        ("reflects", channels(emitter.reflected)),
        ("distance", number(emitter.distance)),
    ];
    values.extend(emitter.emitted.map(|of| ("radiance", channels(of))));
    values.push(weight(emitter.densities));
    values
}

/// The weight of a technique in multiple importance sampling, with the densities of both.
fn weight(densities: Densities) -> Value {
    let [share, by_light, by_path] =
        [densities.weight, densities.by_light, densities.by_path].map(number);
    ("MIS", format!("{share}, light {by_light}, path {by_path}"))
}
