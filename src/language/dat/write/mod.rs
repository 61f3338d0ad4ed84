//! Writes any scene as a `.dat` text.

mod camera;
mod factors;
mod shapes;
mod textures;

use std::fmt::Write;

use glam::DVec3;

use crate::approximations::solids;
use crate::losses::{Losses, Of};
use crate::rendering::words;
use crate::spelling::{numbers, vector};
use crate::surroundings::{SIZE, report_plain};
use crate::whitted::{Whitted, whitted};
use geometry::direction_of;
use scene::{Emitter, Falloff, Light, Rgb, Scene, Shadows};

/// Writes a scene and reports what it loses.
pub(crate) fn write(scene: &Scene, losses: &mut Losses<'_>) -> String {
    report_plain(scene, losses);
    let mut text = String::new();
    let settings = words(&scene.setting.rendering);
    if !settings.is_empty() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# render:{settings}");
    }
    camera::write(&mut text, scene, losses);
    let whitted = whitted(scene, losses);
    lights(&mut text, scene, &whitted, losses);
    text.push('\n');
    for (index, material) in whitted.materials.iter().enumerate() {
        comment(&mut text, losses, Of::Material(index as u32));
        factors::write(&mut text, index, material, whitted.ambient, losses);
    }
    textures::write(&mut text, scene, losses);
    text.push('\n');
    let mut id = 0;
    for (index, object) in scene.objects.iter().enumerate() {
        let mut is_first = true;
        solids(index, object, losses, |solid, material, losses| {
            id += 1;
            if std::mem::take(&mut is_first) {
                comment(&mut text, losses, Of::Object(index));
            }
            shapes::write(
                &mut text,
                (index, solid),
                [id, material as usize + 1],
                losses,
            );
        });
    }
    text
}

/// Writes what the text calls a thing as the comment before it.
fn comment(text: &mut String, losses: &Losses<'_>, of: Of) {
    if let Some(label) = losses.label(of) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {}", label.trim());
    }
}

fn lights(text: &mut String, scene: &Scene, whitted: &Whitted, losses: &mut Losses<'_>) {
    let mut id = 0;
    let mut one = |text: &mut String, light: &Light| {
        id += 1;
        // Writing to a string cannot fail.
        let _ = write!(text, "light ID {id}");
        one_light(text, light);
    };
    let ambient = |colour: Rgb| Light {
        emitter: Emitter::Ambient,
        shadows: Shadows::Off,
        ..Light::point(DVec3::ZERO, colour)
    };
    text.push('\n');
    if whitted.is_baked {
        one(text, &ambient(Rgb::ONE));
    } else if scene.ambient != Rgb::ZERO {
        comment(text, losses, Of::Ambient);
        one(text, &ambient(scene.ambient));
    }
    for (index, light) in scene.lights.iter().enumerate() {
        if whitted.is_baked && light.emitter == Emitter::Ambient {
            continue;
        }
        if let Emitter::Point { radius, .. } = light.emitter
            && radius != 0.0
        {
            losses.add(Of::Light(index), &SIZE);
        }
        comment(text, losses, Of::Light(index));
        one(text, light);
    }
}

/// A light's record after its ID.
fn one_light(text: &mut String, light: &Light) {
    let (word, position, direction, falloff) = match light.emitter {
        Emitter::Point {
            position, falloff, ..
        } => ("pnt", position, falloff.spot, falloff),
        Emitter::Distant(toward) => ("inf", DVec3::ZERO, Some((-toward, 0.0)), Falloff::NONE),
        Emitter::Ambient => ("amb", DVec3::ZERO, None, Falloff::NONE),
    };
    let (direction, exponent) = direction.unwrap_or_default();
    text.push(' ');
    text.push_str(word);
    vector(text, position);
    vector(text, direction_of(direction));
    vector(text, light.colour);
    vector(text, falloff.radial.into());
    text.push(' ');
    numbers(text, [exponent]);
    text.push_str(match light.shadows {
        Shadows::Cast => " shadow_on\n",
        Shadows::Off => " shadow_off\n",
    });
}
