//! Lights.

use super::{element, open, rgb, value, word, xyz};
use crate::losses::{Losses, Of};
use crate::surroundings::{FADING, SHADOWLESS, SPOT, faded};
use geometry::direction_of;
use scene::{Emitter, Falloff, Light, Rgb, Scene, Shadows};

/// Writes the lights of a scene, without ambient ones if the materials emit their light.
pub(super) fn write(text: &mut String, scene: &Scene, is_baked: bool, losses: &mut Losses<'_>) {
    if !is_baked && scene.ambient != Rgb::ZERO {
        begin(text, "ambient", losses.label(Of::Ambient).as_deref());
        element(text, 6, "intensity", |text| rgb(text, scene.ambient));
        text.push_str("    </light>\n");
    }
    for (index, light) in scene.lights.iter().enumerate() {
        let label = losses.label(Of::Light(index));
        match &light.emitter {
            Emitter::Ambient if is_baked => continue,
            Emitter::Ambient => {
                begin(text, "ambient", label.as_deref());
                element(text, 6, "intensity", |text| rgb(text, light.colour));
            }
            Emitter::Distant(toward) => {
                begin(text, "direct", label.as_deref());
                element(text, 6, "intensity", |text| rgb(text, light.colour));
                element(text, 6, "direction", |text| {
                    xyz(text, direction_of(-*toward));
                });
            }
            Emitter::Point {
                position,
                radius,
                falloff,
            } => {
                begin(text, "point", label.as_deref());
                let (colour, attenuation) = faded_as(index, light, falloff, scene, losses);
                element(text, 6, "intensity", |text| rgb(text, colour));
                element(text, 6, "position", |text| xyz(text, *position));
                for (word, number) in [("size", *radius), ("attenuation", attenuation)] {
                    if number != 0.0 {
                        element(text, 6, word, |text| value(text, number));
                    }
                }
            }
        }
        if light.shadows == Shadows::Off && light.emitter != Emitter::Ambient {
            losses.add(Of::Light(index), &SHADOWLESS);
        }
        text.push_str("    </light>\n");
    }
}

fn begin(text: &mut String, kind: &str, label: Option<&str>) {
    open(text, 4, "light");
    word(text, "type", kind);
    if let Some(label) = label {
        word(text, "name", label);
    }
    text.push_str(">\n");
}

/// The intensity and the attenuation of a point light.
fn faded_as(
    index: usize,
    light: &Light,
    falloff: &Falloff,
    scene: &Scene,
    losses: &mut Losses<'_>,
) -> (Rgb, f64) {
    if falloff.spot.is_some() {
        losses.add(Of::Light(index), &SPOT);
    }
    let [a0, a1, a2] = falloff.radial;
    if falloff.radial == Falloff::NONE.radial {
        return (light.colour, 0.0);
    }
    if a0 == 0.0 && a1 == 0.0 && 0.0 < a2 {
        let root = libm::sqrt(a2);
        let near = [root, root.next_up(), root.next_down()];
        let exact = near.into_iter().find(|root| root * root == a2);
        return (light.colour, exact.unwrap_or(root));
    }
    losses.add(Of::Light(index), &FADING);
    let Emitter::Point { position, .. } = light.emitter else {
        return (light.colour, 0.0);
    };
    (faded(light, position, falloff, scene.bounds()), 0.0)
}
