//! What a text shows of its picture before it is traced: that it can only be black, that it grows
//! brighter with every bounce, or that a setting has no effect.

mod darkness;

use glam::DVec3;

use super::{Node, Source};
use geometry::{Shape, normalise};
use scene::{
    Camera, Emitter, Faces, FalloffRule, Integrator, LEAST_ADAPTIVE_SPP, Light, Material,
    Rendering, Rgb, Scene, Shadows,
};
use text::{Diagnostic, Span, concise};

/// The number of objects or materials up to which they are looked at one by one: more are made by a
/// program.
const MOST_SEARCHED: usize = 100_000;

/// The rounding error up to which a surface counts as sending back all that it receives.
const ROUNDING: f64 = 1e-6;

/// What a text shows of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// A warning, at the place that causes it.
    pub warning: Diagnostic,
    /// What comes of it.
    pub prospect: Prospect,
}

/// What a text shows to become of its picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prospect {
    /// It can only be black.
    Black,
    /// Only what glows or mirrors is seen: no light reaches a surface by the integrator.
    Unlit,
    /// Lights emit no photons that `falloff square` would let emit some.
    WithoutPhotons,
    /// Something else.
    Other,
}

/// What a source, as last lowered to `scene`, shows of its picture by this camera with these render
/// settings. Takes time linear in the scene.
pub fn outlook(source: &Source, scene: &Scene, camera: &Camera, asked: &Rendering) -> Vec<Outlook> {
    let view = Judge {
        source,
        scene,
        camera,
        asked,
    };
    let mut found = Vec::new();
    if scene.objects.is_empty() {
        // Meshes that could not be read are left out.
        let message = if source.nodes().objects == 0 {
            "the scene has no object"
        } else {
            "no object of the scene can be shown"
        };
        let place = view.nowhere();
        found.push(if view.is_black_without_objects() {
            black(place, message, "an object")
        } else {
            plain(place, message, "an object")
        });
        return found;
    }
    found.extend(view.never_adaptive());
    found.extend(view.clipped());
    let dark = view.unlit().or_else(|| view.enclosed());
    found.extend(dark.or_else(|| view.sealed()));
    if asked.integrator().traces_paths() {
        found.extend(view.gains());
    }
    if asked.integrator() == Integrator::Photon {
        found.extend(view.without_photons());
        found.extend(view.glowing());
    }
    found
}

struct Judge<'a> {
    source: &'a Source,
    scene: &'a Scene,
    camera: &'a Camera,
    asked: &'a Rendering,
}

impl Judge<'_> {
    /// Every object is behind the camera, nearer than the near limit or beyond the far limit, and
    /// nothing else is seen.
    fn clipped(&self) -> Option<Outlook> {
        if !self.is_black_without_objects() {
            return None;
        }
        let [near, far] = self.camera.depths;
        let forward = forward(self.camera)?;
        let mut objects = self.scene.objects.iter();
        let [start, end] = objects.try_fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[least, most], object| {
                let [start, end] = self.depths(&object.shape, forward)?;
                Some([start.min(least), end.max(most)])
            },
        )?;
        let depths = "a range of depths that includes an object";
        let (key, side, expected) = if end < 0.0 {
            ("target", "behind the camera", "a view toward an object")
        } else if end < near {
            ("near", "nearer than the near limit", depths)
        } else if far < start {
            ("far", "beyond the far limit", depths)
        } else {
            return None;
        };
        let view = |camera: &Camera| (camera.eye, camera.target, camera.depths);
        let span = if view(self.camera) == view(&self.scene.camera) {
            self.place(Node::View, key)
        } else {
            self.nowhere()
        };
        let message = format!("every object is {side}: the picture is black");
        Some(black(span, &message, expected))
    }

    /// The least and greatest depth of a shape's box along the view; `None` if they are not known.
    fn depths(&self, shape: &Shape, forward: DVec3) -> Option<[f64; 2]> {
        let bounds = shape.bounds();
        let depth = (bounds.centre() - self.camera.eye).dot(forward);
        let half = 0.5 * bounds.size().dot(forward.abs());
        let [start, end] = [depth - half, depth + half];
        (bounds.is_bounded() && start <= end).then_some([start, end])
    }

    /// Whether camera rays that meet nothing end in black.
    fn is_backdrop_black(&self) -> bool {
        self.scene.setting.background.colour == Rgb::ZERO
    }

    /// Whether all is black where no object is: lights with a size are seen.
    fn is_black_without_objects(&self) -> bool {
        let is_seen = |light: &Light| {
            let is_ball = matches!(light.emitter, Emitter::Point { radius, .. } if radius != 0.0);
            is_ball && light.colour != Rgb::ZERO
        };
        self.is_backdrop_black() && !self.scene.lights.iter().any(is_seen)
    }

    /// The text asks for adaptive sampling, but for so few samples that no pixel can stop early.
    fn never_adaptive(&self) -> Option<Outlook> {
        let own = &self.scene.setting.rendering;
        let (noise, spp) = (own.noise.filter(|noise| 0.0 < *noise)?, own.spp?);
        let is_used = self.asked.noise == own.noise && self.asked.spp == own.spp;
        if LEAST_ADAPTIVE_SPP < spp || !is_used {
            return None;
        }
        let message = format!(
            "`noise {noise}` has no effect: it cannot stop a pixel before {LEAST_ADAPTIVE_SPP} samples, and `spp` is {spp}"
        );
        let span = self.place(Node::Render, "noise");
        let expected = format!("`spp` above {LEAST_ADAPTIVE_SPP}");
        Some(plain(span, &message, &expected))
    }

    /// Lights that emit no photons.
    fn without_photons(&self) -> Vec<Outlook> {
        let lights = &self.scene.lights;
        if MOST_SEARCHED < lights.len() {
            return Vec::new();
        }
        let rule = self.asked.falloff.unwrap_or_default();
        let lights = lights.iter().enumerate();
        let others = lights
            .filter(|(_, light)| light.emitter != Emitter::Ambient && !light.emits_photons(rule));
        let found = others.map(|(index, light)| {
            let node = Node::Light(index);
            let (reason, expected) = if light.shadows == Shadows::Off {
                ("it casts no shadows", "a light that casts shadows")
            } else {
                let expected = match light.emitter {
                    Emitter::Distant(_) => "a point light",
                    _ if light.emits_photons(FalloffRule::Square) => "`falloff square`",
                    _ => "a falloff by the squared distance alone",
                };
                ("it does not fall off with the squared distance", expected)
            };
            let name = self.source.name(node);
            let message = format!("{name} emits no photons: {reason}");
            let helps = light.emits_photons(FalloffRule::Square);
            Outlook {
                prospect: if helps {
                    Prospect::WithoutPhotons
                } else {
                    Prospect::Other
                },
                ..plain(self.source.span(node), &message, expected)
            }
        });
        found.collect()
    }

    /// Materials that glow: they emit no photons.
    fn glowing(&self) -> Vec<Outlook> {
        let found = self.materials_in_use().into_iter();
        // Without a material an object is white on both sides, which nobody asked for.
        let found = found.filter(|(node, material)| {
            let is_meant = matches!(node, Node::Material(_)) || material.lit == Faces::Front;
            is_meant && material.emission != Rgb::ZERO
        });
        let found = found.map(|(node, _)| {
            let name = self.source.name(node);
            let message = format!("{name} emits no photons: it glows, but only lights emit them");
            plain(self.source.span(node), &message, "a point light")
        });
        found.collect()
    }

    /// Materials that send back more than they receive.
    fn gains(&self) -> Vec<Outlook> {
        let found = self.materials_in_use().into_iter();
        let found = found.filter_map(|(node, material)| {
            let (gain, words) = gain(material);
            (1.0 + ROUNDING < gain).then(|| {
                let message = format!(
                    "{}: {words} add up to {}: the picture grows brighter with every bounce",
                    self.source.name(node),
                    concise((1000.0 * gain).round() / 1000.0)
                );
                plain(self.source.span(node), &message, "a sum of at most 1")
            })
        });
        found.collect()
    }

    /// The materials of objects, each as its node or, if it is not listed, as its first object; none
    /// where there are too many.
    fn materials_in_use(&self) -> Vec<(Node, &Material)> {
        let materials = &self.scene.materials;
        if MOST_SEARCHED < materials.iter().count() {
            return Vec::new();
        }
        let mut users = vec![None; materials.len()];
        for (number, object) in (0_u32..).zip(self.scene.objects.iter()) {
            if let Some(user) = users.get_mut(object.material as usize) {
                user.get_or_insert(number);
            }
        }
        let used = materials.numbered().filter_map(|(index, material)| {
            let user = users[index]?;
            let listed = index < self.source.nodes().materials;
            let node = if listed {
                Node::Material(index)
            } else {
                Node::Object(self.source.object(user))
            };
            Some((node, material))
        });
        used.collect()
    }

    /// The place of what the text lacks: its view, or its beginning.
    fn nowhere(&self) -> Span {
        self.source.span(Node::View)
    }

    /// The place of a field that the text states, otherwise of its node.
    fn place(&self, node: Node, key: &str) -> Span {
        let fields = self.source.fields(node);
        let field = fields
            .iter()
            .find(|placed| placed.field.key == key && placed.is_explicit());
        let spans = field.and_then(|placed| placed.spans.iter().copied().reduce(Span::to));
        spans.unwrap_or_else(|| self.source.span(node))
    }
}

/// The unit vector along a camera's view.
fn forward(camera: &Camera) -> Option<DVec3> {
    normalise(0.5 * camera.target - 0.5 * camera.eye)
}

fn plain(span: Span, message: &str, expected: &str) -> Outlook {
    Outlook {
        warning: Diagnostic::warning(span, message, expected),
        prospect: Prospect::Other,
    }
}

fn black(span: Span, message: &str, expected: &str) -> Outlook {
    Outlook {
        prospect: Prospect::Black,
        ..plain(span, message, expected)
    }
}

/// The largest sum of shares by which path tracing goes on at a surface, and its name. What a
/// texture darkens by an unknown amount is left out.
fn gain(material: &Material) -> (f64, &'static str) {
    let maps = material.maps.as_deref().copied().unwrap_or_default();
    let plain = |colour: Rgb, map: Option<u32>| map.map_or(colour, |_| Rgb::ZERO);
    let glossy = plain(material.glossy_albedo(), maps.specular);
    let mirror = plain(material.mirror.tint, maps.mirror);
    let diffuse = plain(material.diffuse, maps.diffuse);
    let opaque = diffuse + glossy;
    let clear = plain(material.dielectric.tint, maps.dielectric);
    let words = if clear == Rgb::ZERO {
        "diffuse, specular and mirror reflectance"
    } else if opaque == Rgb::ZERO {
        "mirror reflectance and transmittance"
    } else {
        "diffuse, specular and mirror reflectance and transmittance"
    };
    ((opaque + mirror + clear).max_element(), words)
}
