//! Writes any scene as a `.ray` text.

use std::fmt::Write;

use glam::DVec3;

use super::schema::VIEW;
use super::view;
use crate::approximations::solids;
use crate::coefficients::Coefficients;
use crate::losses::{Loss, Losses, Of};
use crate::rendering::words;
use crate::spelling::{groups, numbers};
use crate::surroundings::{DISTANT, FADING, SHADOWLESS, SIZE, SPOT, angle, faded, report_plain};
use crate::view::take;
use crate::whitted::whitted;
use geometry::{Affine, Solid};
use scene::{Camera, Emitter, Falloff, FalloffRule, Lens, Light, Rgb, Scene, Shadows};

/// The distance of a point light that stands for one infinitely far away, in radii of the scene.
const FAR_AWAY: f64 = 1e4;

const TEXTURED: Loss = Loss {
    keys: &[],
    lost: "textures",
    instead: "written in its plain colour",
};

const NO_OBJECT: Loss = Loss {
    keys: &[],
    lost: "a scene without objects",
    instead: "written with a black sphere behind the eye",
};

/// Writes a scene and reports what it loses.
pub(crate) fn write(scene: &Scene, losses: &mut Losses<'_>) -> String {
    report_plain(scene, losses);
    let mut text = String::new();
    let lens = Lens::Perspective(angle(scene, losses));
    let camera = scene.camera;
    view(&mut text, &Camera { lens, ..camera });
    let settings = words(&scene.setting.rendering);
    if !settings.is_empty() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "// render:{settings}");
    }
    let whitted = whitted(scene, losses);
    for (index, material) in (0..).zip(scene.materials.iter()) {
        if material.maps.is_some() {
            losses.add(Of::Material(index), &TEXTURED);
        }
    }
    text.push('\n');
    groups(&mut text, &[&whitted.ambient.to_array()]);
    text.push_str("  // ambient light\n\n");
    lights(&mut text, scene, losses);
    objects(&mut text, scene, &whitted.materials, losses);
    text
}

fn view(text: &mut String, camera: &Camera) {
    text.push_str("// view:");
    let all = view::numbers(camera);
    let mut rest = &all[..];
    for field in VIEW.fields() {
        text.push(' ');
        text.push_str(field.key);
        numbers(text, take(&mut rest, field).iter().copied());
    }
    text.push('\n');
}

fn lights(text: &mut String, scene: &Scene, losses: &mut Losses<'_>) {
    let mut count = 0_usize;
    let mut written = String::new();
    for (index, light) in scene.lights.iter().enumerate() {
        let Some((position, colour)) = point(index, light, scene, losses) else {
            continue;
        };
        count += 1;
        groups(&mut written, &[&position.to_array(), &colour.to_array()]);
        if let Some(label) = losses.label(Of::Light(index)) {
            let _ = write!(written, "  // {}", label.trim());
        }
        written.push('\n');
    }
    if count == 0 {
        // At least one is required.
        count = 1;
        let eye = scene.camera.eye.to_array();
        groups(&mut written, &[&eye, &Rgb::ZERO.to_array()]);
        written.push('\n');
    }
    let _ = writeln!(text, "{count}  // lights: position, colour\n{written}");
}

/// The position and colour of a light; `None` for ambient light.
fn point(
    index: usize,
    light: &Light,
    scene: &Scene,
    losses: &mut Losses<'_>,
) -> Option<(DVec3, Rgb)> {
    let of = Of::Light(index);
    if light.shadows == Shadows::Off && light.emitter != Emitter::Ambient {
        losses.add(of, &SHADOWLESS);
    }
    match &light.emitter {
        Emitter::Point {
            position,
            radius,
            falloff,
        } => {
            if *radius != 0.0 {
                losses.add(of, &SIZE);
            }
            if falloff.spot.is_some() {
                losses.add(of, &SPOT);
            }
            let mut colour = light.colour;
            let is_by_rule = falloff.radial == [0.0, 0.0, 1.0]
                && scene.setting.rendering.falloff == Some(FalloffRule::Square);
            if falloff.radial != Falloff::NONE.radial && !is_by_rule {
                losses.add(of, &FADING);
                colour = faded(light, *position, falloff, scene.bounds());
            }
            Some((*position, colour))
        }
        Emitter::Distant(toward) => {
            losses.add(of, &DISTANT);
            let bounds = scene.bounds();
            let (centre, radius) = if bounds.is_empty() {
                (DVec3::ZERO, 1.0)
            } else {
                (bounds.centre(), bounds.half_diagonal())
            };
            let position = centre + FAR_AWAY * radius * *toward;
            let is_known = position.is_finite();
            Some((if is_known { position } else { *toward }, light.colour))
        }
        Emitter::Ambient => None,
    }
}

fn objects(text: &mut String, scene: &Scene, materials: &[Coefficients], losses: &mut Losses<'_>) {
    let mut written = String::new();
    let mut count = 0_usize;
    for (index, object) in scene.objects.iter().enumerate() {
        solids(index, object, losses, |solid, material, losses| {
            count += 1;
            let label = losses.label(Of::Object(index));
            shape(&mut written, solid, label.as_deref());
            one_material(&mut written, &materials[material as usize]);
        });
    }
    if count == 0 {
        count = 1;
        losses.add(Of::View, &NO_OBJECT);
        let Camera { eye, target, .. } = scene.camera;
        let behind = eye + 4.0 * (eye - target);
        written.push_str("\nsphere\n");
        let sphere = behind.extend(eye.distance(target));
        groups(&mut written, &[&sphere.to_array()]);
        let black = Coefficients {
            index: 1.0,
            ..Coefficients::default()
        };
        one_material(&mut written, &black);
    }
    let _ = write!(text, "{count}  // objects\n{written}");
}

/// The keyword and the numbers of a solid; its quadrics have stand-ins.
fn shape(text: &mut String, solid: &Solid, label: Option<&str>) {
    let (keyword, frame): (_, Option<&Affine>) = match solid {
        Solid::Sphere(_) | Solid::Quadric(_) => ("sphere", None),
        Solid::Ellipsoid(ellipsoid) => ("ellipsoid", Some(&ellipsoid.0)),
        Solid::Cuboid(cuboid) => ("box", Some(&cuboid.0)),
        Solid::Cylinder(cylinder) => ("cylinder", Some(&cylinder.0)),
        Solid::Cone(cone) => ("cone", Some(&cone.0)),
    };
    let _ = write!(text, "\n{keyword}");
    if let Some(label) = label {
        let _ = write!(text, "  // {}", label.trim());
    }
    text.push('\n');
    if let Solid::Sphere(sphere) = solid {
        groups(text, &[&sphere.centre.to_array(), &[sphere.radius]]);
    }
    if let Some(frame) = frame {
        let numbers = frame.numbers();
        let [a, b, c] = numbers.directions;
        let parts = [numbers.origin, a, b, c, numbers.lengths].map(|part| part.to_array());
        groups(text, &parts.each_ref().map(|part| &part[..]));
    }
}

/// The numbers of a material, on a line of their own.
fn one_material(text: &mut String, of: &Coefficients) {
    text.push('\n');
    groups(
        text,
        &[
            &of.ambient.to_array(),
            &of.diffuse.to_array(),
            &of.specular.to_array(),
            &[of.exponent],
            &[of.reflection, of.transmission, of.index],
        ],
    );
    text.push('\n');
}
