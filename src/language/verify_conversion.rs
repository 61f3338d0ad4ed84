//! Where two scenes could give different pictures by the default settings: what a conversion changed
//! without saying so.
//!
//! Scenes that are alike need not be equal: what cannot be seen, such as the colour of a highlight
//! without strength, may differ.

use super::losses::{Loss, Losses, Of};
use super::surroundings::is_all_before;
use scene::{
    Camera, Dielectric, Emitter, Gloss, Highlight, Light, Material, Mirror, Pattern, RenderKey,
    Rgb, Scene, Shadow, Texture, Tinted,
};

const ROUNDED: Loss = Loss {
    keys: &[],
    lost: "the last digits of its numbers",
    instead: "written with numbers that differ by rounding: single pixels may differ",
};

/// Reports what differs between a scene and what was written for it, unless something of it is
/// reported already.
pub(super) fn report(scene: &Scene, written: &Scene, losses: &mut Losses<'_>) {
    let mut lose = |of: Of, is_alike: bool| {
        if !is_alike && !losses.has(of) {
            losses.add(of, &ROUNDED);
        }
    };
    lose(Of::View, has_same_view(scene, written));
    let [around, other] = [scene, written].map(|scene| scene.setting.background);
    lose(
        Of::Background,
        is_tinted_alike([scene, written], [around, other]),
    );
    let [around, other] = [scene, written].map(|scene| scene.setting.environment);
    lose(
        Of::Environment,
        is_tinted_alike([scene, written], [around, other]),
    );
    for (light, is_alike) in lights(scene, written) {
        lose(Of::Light(light), is_alike);
    }
    objects(scene, written, losses);
}

fn has_same_view(scene: &Scene, written: &Scene) -> bool {
    let [a, b] = [&scene.camera, &written.camera];
    let [near, far] = a.depths;
    let has_same_depths =
        near == b.depths[0] && (far == b.depths[1] || is_all_before(scene, far.min(b.depths[1])));
    let has_same_focus =
        a.focus == b.focus || (a.focus.lens_radius == 0.0 && b.focus.lens_radius == 0.0);
    let rest = Camera {
        depths: a.depths,
        focus: a.focus,
        ..*b
    };
    let [x, y] = [scene, written].map(|scene| scene.setting.rendering);
    let has_same_settings = RenderKey::of_text().all(|key| key.in_use(&x) == key.in_use(&y));
    rest == *a && has_same_depths && has_same_focus && has_same_settings
}

/// The lights of a scene that shed light, each with whether the one written for it is alike.
fn lights(scene: &Scene, written: &Scene) -> Vec<(usize, bool)> {
    let shines = |light: &&Light| light.emitter != Emitter::Ambient && light.colour != Rgb::ZERO;
    let mut others = written.lights.iter().filter(shines);
    let own = scene.lights.iter().enumerate();
    let own = own.filter(|(_, light)| shines(light));
    own.map(|(index, light)| {
        let other = others.next();
        let is_alike = other.is_some_and(|other| {
            light.emitter == other.emitter
                && light.colour == other.colour
                && light.shadows == other.shadows
        });
        (index, is_alike)
    })
    .collect()
}

fn objects(scene: &Scene, written: &Scene, losses: &mut Losses<'_>) {
    let ambient = [scene, written].map(Scene::ambient_light);
    let mut next = 0;
    // Neighbours often share a material.
    let mut alike = None;
    for (index, object) in scene.objects.iter().enumerate() {
        let pieces = losses.pieces(index);
        let first = written.objects.get(next);
        next += pieces;
        let Some(other) = first.filter(|_| pieces == 1) else {
            continue;
        };
        if object.shape != other.shape && !losses.has(Of::Object(index)) {
            losses.add(Of::Object(index), &ROUNDED);
        }
        let of = Of::Material(object.material);
        let pair = (object.material, other.material);
        if alike == Some(pair) || losses.has(of) {
            continue;
        }
        let [a, b] = [(scene, pair.0), (written, pair.1)]
            .map(|(scene, material)| scene.materials.get(material as usize));
        let is_alike = match (a, b) {
            (Some(a), Some(b)) => is_material_alike([scene, written], [a, b], ambient),
            _ => false,
        };
        if is_alike {
            alike = Some(pair);
        } else {
            losses.add(of, &ROUNDED);
        }
    }
}

/// Whether two materials of two scenes look alike under their ambient light.
fn is_material_alike(scenes: [&Scene; 2], both: [&Material; 2], ambient: [Rgb; 2]) -> bool {
    let [a, b] = both;
    let glow = [0, 1].map(|at| {
        let (material, ambient) = (both[at], ambient[at]);
        material.emission + ambient * material.ambient.unwrap_or(material.diffuse)
    });
    let plain = both.map(without_unseen);
    let is_same = |slot: fn(&Material) -> Tinted| is_tinted_alike(scenes, both.map(slot));
    glow[0] == glow[1]
        && plain[0] == plain[1]
        && a.maps.is_some() == b.maps.is_some()
        && (a.maps.is_none()
            || (SLOTS.into_iter().all(is_same)
                && (both.iter().all(|one| glow_map(one).is_none())
                    || is_same(|one| Tinted {
                        colour: Rgb::ONE,
                        texture: glow_map(one),
                    }))))
}

/// The textures of a material that multiply colours.
const SLOTS: [fn(&Material) -> Tinted; 4] = [
    |one| textured(one, one.diffuse, |maps| maps.diffuse),
    |one| textured(one, gloss(one).specular, |maps| maps.specular),
    |one| textured(one, one.mirror.tint, |maps| maps.mirror),
    |one| textured(one, one.dielectric.tint, |maps| maps.dielectric),
];

fn textured(material: &Material, colour: Rgb, slot: fn(&scene::Maps) -> Option<u32>) -> Tinted {
    Tinted {
        colour,
        texture: material.maps.as_deref().and_then(slot),
    }
}

/// The texture of what a material glows with.
fn glow_map(material: &Material) -> Option<u32> {
    let maps = material.maps.as_deref()?;
    let reflected = match material.ambient {
        Some(_) => maps.ambient,
        None => maps.diffuse,
    };
    maps.emission.or(reflected)
}

fn gloss(material: &Material) -> Gloss {
    match material.highlight {
        Highlight::Phong(gloss)
        | Highlight::ModifiedPhong(gloss)
        | Highlight::Blinn(gloss)
        | Highlight::PlainBlinn(gloss) => gloss,
        Highlight::None | Highlight::Microfacet { .. } => Gloss::default(),
    }
}

/// The material without what cannot be seen of it, and without its glow and its textures.
fn without_unseen(material: &Material) -> Material {
    let is_facets = matches!(material.highlight, Highlight::Microfacet { .. });
    let is_clear = material.dielectric.tint != Rgb::ZERO;
    Material {
        ambient: None,
        emission: Rgb::ZERO,
        maps: None,
        highlight: if is_facets || gloss(material).specular != Rgb::ZERO {
            material.highlight
        } else {
            Highlight::None
        },
        mirror: if material.mirror.tint == Rgb::ZERO {
            Mirror::default()
        } else {
            material.mirror
        },
        dielectric: if is_clear || is_facets {
            material.dielectric
        } else {
            Dielectric::OPAQUE
        },
        shadow: if is_clear {
            material.shadow
        } else {
            Shadow::Blocks
        },
        ..material.clone()
    }
}

/// Whether two colours with textures, of two scenes, are alike.
fn is_tinted_alike([a, b]: [&Scene; 2], both: [Tinted; 2]) -> bool {
    let mut pending = vec![both];
    while let Some([one, other]) = pending.pop() {
        if one.colour != other.colour {
            return false;
        }
        if one.colour == Rgb::ZERO {
            continue;
        }
        let texture = |scene: &Scene, of: Tinted| -> Option<Texture> {
            scene.textures.get(of.texture? as usize).cloned()
        };
        match (texture(a, one), texture(b, other)) {
            (None, None) => {}
            (Some(one), Some(other)) if one.inverse == other.inverse => {
                match (one.pattern, other.pattern) {
                    (Pattern::Image(one), Pattern::Image(other))
                    | (Pattern::Clamped(one), Pattern::Clamped(other))
                        if one == other => {}
                    (
                        Pattern::Checker { squares, side },
                        Pattern::Checker {
                            squares: others,
                            side: other,
                        },
                    ) if side == other => {
                        pending.extend([0, 1].map(|at| [squares[at], others[at]]));
                    }
                    _ => return false,
                }
            }
            _ => return false,
        }
    }
    true
}
