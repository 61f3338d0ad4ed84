//! Lights.

use glam::DVec3;

use super::{element, value, xyz};
use crate::losses::{Losses, Of};
use crate::surroundings::{FADING, SHADOWLESS, SPOT, faded};
use geometry::direction_of;
use scene::{Emitter, Falloff, Light, Rgb, Scene, Shadows};

/// Writes the lights of a scene, without ambient ones if the materials emit their light.
pub(super) fn write(text: &mut String, scene: &Scene, is_baked: bool, losses: &mut Losses<'_>) {
    if !is_baked && scene.ambient != Rgb::ZERO {
        let label = losses.label(Of::Ambient);
        super::light(text, "ambient", label.as_deref(), scene.ambient);
        text.push_str("    </light>\n");
    }
    for (index, light) in scene.lights.iter().enumerate() {
        let label = losses.label(Of::Light(index));
        let label = label.as_deref();
        match &light.emitter {
            Emitter::Ambient if is_baked => continue,
            Emitter::Ambient => super::light(text, "ambient", label, light.colour),
            Emitter::Distant(toward) => {
                super::light(text, "direct", label, light.colour);
                element(text, 6, "direction", |text| {
                    xyz(text, direction_of(-*toward));
                });
            }
            Emitter::Point {
                position,
                radius,
                falloff,
            } => {
                let (colour, attenuation) =
                    faded_as(index, light, (*position, falloff), scene, losses);
                super::light(text, "point", label, colour);
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

/// The intensity and the attenuation of a point light.
fn faded_as(
    index: usize,
    light: &Light,
    (position, falloff): (DVec3, &Falloff),
    scene: &Scene,
    losses: &mut Losses<'_>,
) -> (Rgb, f64) {
    if falloff.spot.is_some() {
        losses.add(Of::Light(index), &SPOT);
    }
    match falloff.radial {
        [1.0, 0.0, 0.0] => (light.colour, 0.0),
        [0.0, 0.0, square] if 0.0 < square => {
            let root = libm::sqrt(square);
            let mut near = [root, root.next_up(), root.next_down()].into_iter();
            let exact = near.find(|root| root * root == square);
            (light.colour, exact.unwrap_or(root))
        }
        _ => {
            losses.add(Of::Light(index), &FADING);
            (faded(light, position, falloff, scene.bounds()), 0.0)
        }
    }
}
