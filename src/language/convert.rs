//! Conversion of a scene to another language.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::Arc;

use super::losses::{Loss, Losses, Of};
use super::{Language, Source, fits, verify_conversion};
use memory::OutOfMemory;
use scene::{Emitter, Meshes, Object, Rgb, Scene};
use text::{Diagnostic, Findings, Span};

/// A scene in another language.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The text; meaningless if there are errors.
    pub text: Arc<String>,
    /// A warning for all that the other language cannot hold, at its place in the source, with the
    /// nearest that was written instead. Without any, pictures by the default settings are the same.
    pub losses: Findings,
}

/// Converts a source, as last lowered to `scene`, to a language. A source in that language is copied
/// as it is. Takes time linear in the scene.
///
/// # Errors
///
/// Fails if the other text does not fit into memory.
pub fn convert(source: &Source, scene: &Scene, to: Language) -> Result<Converted, OutOfMemory> {
    if source.language() == to {
        return Ok(Converted {
            text: Arc::clone(source.text()),
            losses: Findings::default(),
        });
    }
    let own = scene;
    let mut scene = numbered(without_gamma(own));
    let asked = scene.setting.rendering;
    if asked.default_depths.is_some() {
        // Other languages have other defaults.
        scene.to_mut().setting.rendering.depth = Some(asked.depth());
    }
    let scene = &*scene;
    let mut losses = Losses::new(source, scene, to);
    if let Some(loss) = gamma_loss(own) {
        losses.add(Of::Gamma, loss);
    }
    let text = Arc::new(to.write(scene, &mut losses));
    fits(to, &text, 0)?;
    let mut written = Source::new(to, text);
    let lowered = written.lower(&Meshes::default())?;
    if let Some(other) = &lowered.scene {
        verify_conversion::report(scene, other, &mut losses);
    }
    let mut findings = losses.into_findings();
    if let Some(error) = lowered.diagnostics.first_error() {
        findings.error(|| {
            let message = format!("the scene cannot be written: {}", error.message);
            Diagnostic::error(
                Span::at(0),
                message,
                "numbers that the other language allows",
            )
        });
    }
    for view in source.saved_views() {
        let camera = view.camera(&scene.camera);
        let edits = written.saved_view_edits(&view.name, Some(&camera));
        written.change(&edits);
    }
    Ok(Converted {
        text: Arc::clone(written.text()),
        losses: findings,
    })
}

const PATHS_KEPT: Loss = Loss {
    keys: &["gamma"],
    lost: "light that path tracing does not multiply by π",
    instead: "written divided by π: by path tracing it is the same, by Whitted ray tracing darker",
};

const WHITTED_KEPT: Loss = Loss {
    instead: "written as it is: by Whitted ray tracing it is the same, by path tracing brighter by a factor of π",
    ..PATHS_KEPT
};

/// What is lost with `gamma` of the lights of a scene.
fn gamma_loss(scene: &Scene) -> Option<&'static Loss> {
    let mut lights = scene.lights.iter();
    let is_scaled = lights.any(|light| {
        light.scale != PI && light.emitter != Emitter::Ambient && light.colour != Rgb::ZERO
    });
    let is_path = scene.setting.rendering.integrator().traces_paths();
    is_scaled.then_some(if is_path { &PATHS_KEPT } else { &WHITTED_KEPT })
}

/// The scene with the materials numbered without gaps. Only scenes of single solids have any.
fn numbered(scene: Cow<'_, Scene>) -> Cow<'_, Scene> {
    let materials = &scene.materials;
    if materials.iter().count() == materials.len() {
        return scene;
    }
    let mut numbers = vec![0; materials.len()];
    for (new, (old, _)) in (0..).zip(materials.numbered()) {
        numbers[old] = new;
    }
    let objects = scene.objects.iter().map(|object| Object {
        material: numbers[object.material as usize],
        ..object.clone()
    });
    let (materials, objects) = (materials.iter().cloned().collect(), objects.collect());
    Cow::Owned(Scene {
        materials,
        objects,
        ..scene.into_owned()
    })
}

/// The scene with lights as in texts that do not set gamma, where path tracing multiplies them by π, and
/// where lights with a size have a radiance only if they fall off. Its picture by its own integrator is
/// the same, up to rounding. Paths do not see ambient light.
pub(super) fn without_gamma(scene: &Scene) -> Cow<'_, Scene> {
    if scene.lights.iter().all(|light| light.scale == PI) {
        return Cow::Borrowed(scene);
    }
    let mut scene = scene.clone();
    let is_path = scene.setting.rendering.integrator().traces_paths();
    for light in &mut scene.lights {
        if is_path && light.emitter != Emitter::Ambient {
            light.colour *= light.scale / PI;
            if let Emitter::Point {
                radius, falloff, ..
            } = &mut light.emitter
                && 0.0 < *radius
                && light.scale == 1.0
            {
                falloff.radial = [0.0, 0.0, 1.0];
            }
        }
        light.scale = PI;
    }
    Cow::Owned(scene)
}
