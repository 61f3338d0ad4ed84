//! An explanation as JSON. The keys are part of the interface of the command.

use std::path::Path;

use glam::DVec3;
use serde_json::{Value, json};

use explain::{Place, Sentence, Subject, Words, wording};
use language::Node;
use render::{
    Crossing, Densities, EmitterTerm, Explanation, LightTerm, RayEnd, Shading, Stop, TracedRay,
    UnlitReason,
};

/// The explanation as an object; numbers that are infinite or undefined are null.
pub(super) fn object(
    scene: &Path,
    explanation: &Explanation,
    words: &Words,
    subject: &Subject<'_>,
) -> Value {
    let rays = explanation.rays.iter();
    let rays = rays.map(|traced| ray(traced, subject, explanation.depth));
    json!({
        "scene": scene.to_string_lossy(),
        "pixel": explanation.pixel,
        "sample": explanation.sample,
        "integrator": explanation.integrator.name(),
        "depth": explanation.depth,
        "radiance": vector(explanation.radiance),
        "displayed": explanation.displayed,
        "verdict": words.verdicts.first().map(|sentence| sentence.name),
        "verdicts": words.verdicts.iter().map(|sentence| verdict(sentence, subject)).collect::<Value>(),
        "rays": rays.collect::<Value>(),
    })
}

fn verdict(sentence: &Sentence, subject: &Subject<'_>) -> Value {
    json!({
        "name": sentence.name,
        "text": sentence.text,
        "help": sentence.help,
        "about": sentence.node.map(|node| subject.source.name(node)),
        "place": sentence.place.map(place),
        "ray": sentence.ray,
    })
}

fn place(place: Place) -> Value {
    json!({ "line": place.line, "column": place.column, "field": place.field })
}

fn ray(ray: &TracedRay, subject: &Subject<'_>, depth: u32) -> Value {
    json!({
        "parent": ray.parent,
        "kind": wording::kind(ray.kind).name,
        "bounce": ray.bounce,
        "weight": vector(ray.weight),
        "origin": vector(ray.origin),
        "direction": vector(ray.direction),
        "reach": ray.reach,
        "absorption": vector(ray.absorption),
        "chosen": ray.chosen.map(|chosen| json!({
            "chance": chosen.chance,
            "density": chosen.density,
            "factor": vector(chosen.factor),
            "survival": chosen.survival,
        })),
        "contribution": vector(ray.contribution),
        "end": end(&ray.end, subject, depth),
    })
}

fn end(end: &RayEnd, subject: &Subject<'_>, depth: u32) -> Value {
    match end {
        RayEnd::Missed {
            radiance,
            densities: of,
            ..
        } => json!({ "missed": {
            "radiance": vector(*radiance),
            "densities": of.map(densities),
        }}),
        RayEnd::OverBudget => json!("over budget"),
        RayEnd::Light(hit) => json!({ "light": {
            "light": light(hit.light, subject),
            "t": hit.t,
            "transmitted": vector(hit.transmitted),
            "radiance": vector(hit.radiance),
            "densities": hit.densities.map(densities),
        }}),
        RayEnd::Surface(shading) => json!({ "surface": surface(shading, subject, depth) }),
    }
}

fn surface(shading: &Shading, subject: &Subject<'_>, depth: u32) -> Value {
    let hit = &shading.hit;
    let lights = shading.lights.iter().map(|shown| term(shown, subject));
    let emitters = shading.emitters.iter();
    let emitters = emitters.map(|shown| emitter(shown, subject));
    json!({
        "object": object_name(hit.object, subject),
        "material": hit.material,
        "t": hit.t,
        "point": vector(hit.point),
        "geometric_normal": vector(hit.geometric),
        "normal": vector(hit.normal),
        "uv": hit.uv.to_array(),
        "side": wording::side_of(hit).name,
        "transmitted": vector(shading.transmitted),
        "lit": shading.lit,
        "missing_texture": shading.missing,
        "emission": vector(shading.emission),
        "densities": shading.densities.map(densities),
        "ambient": vector(shading.ambient),
        "lights": lights.collect::<Value>(),
        "unlisted_lights": shading.unlisted.lights,
        "unlisted_radiance": vector(shading.unlisted.radiance),
        "emitters": emitters.collect::<Value>(),
        "photons": vector(shading.caustics),
        "radiance": vector(shading.radiance),
        "mirror": vector(shading.mirror),
        "boundary": shading.boundary.map(|boundary| json!({
            "tint": vector(boundary.tint),
            "indices": boundary.indices,
            "reflectance": boundary.reflectance,
            "total": boundary.total,
        })),
        "stop": shading.stop.map(|reason| stop(reason, depth)),
    })
}

fn term(term: &LightTerm, subject: &Subject<'_>) -> Value {
    let crossed = term.crossed.iter().map(|crossing| {
        let Crossing {
            object,
            material,
            t,
            transmittance,
        } = *crossing;
        json!({
            "object": object_name(object, subject),
            "material": material,
            "t": t,
            "transmittance": transmittance,
        })
    });
    json!({
        "light": light(term.light, subject),
        "chance": term.chance,
        "toward": vector(term.toward),
        "distance": term.distance,
        "cosine": term.cosine,
        "falloff": term.radial,
        "cone": term.spot,
        "arriving": vector(term.arriving),
        "reflected": vector(term.reflected),
        "densities": term.densities.map(densities),
        "transmittance": term.transmittance,
        "crossed": crossed.collect::<Value>(),
        "radiance": vector(term.radiance),
        "dark": term.dark.map(dark),
    })
}

fn emitter(term: &EmitterTerm, subject: &Subject<'_>) -> Value {
    json!({
        "object": term.object.map(|object| object_name(object, subject)),
        "toward": vector(term.toward),
        "distance": term.distance,
        "cosine": term.cosine,
        "emitted": term.emitted.map(vector),
        "reflected": vector(term.reflected),
        "densities": densities(term.densities),
        "radiance": vector(term.radiance),
        "dark": term.dark.map(dark),
    })
}

fn object_name(object: u32, subject: &Subject<'_>) -> String {
    let node = Node::Object(subject.source.object(object));
    subject.source.name(node)
}

fn light(light: u32, subject: &Subject<'_>) -> String {
    subject.source.name(Node::Light(light as usize))
}

fn densities(densities: Densities) -> Value {
    json!({
        "by_light": densities.by_light,
        "by_path": densities.by_path,
        "weight": densities.weight,
    })
}

fn vector(vector: DVec3) -> Value {
    json!(vector.to_array())
}

fn stop(stop: Stop, depth: u32) -> Value {
    let name = wording::stop(stop, depth).name;
    match stop {
        Stop::Roulette { survival } => json!({ name: survival }),
        Stop::Depth | Stop::Budget | Stop::Nowhere | Stop::Overflow => json!(name),
    }
}

fn dark(dark: UnlitReason) -> &'static str {
    wording::unlit(dark).name
}
