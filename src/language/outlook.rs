//! What a text shows of its picture before it is traced: that it can only be black, that it grows
//! brighter with every bounce, or that a setting has no effect.

use glam::DVec3;

use super::rendering::RenderKey;
use super::{Node, Source};
use crate::geometry::{Ray, Shape, normalise};
use crate::scene::{
    Camera, Emitter, FalloffRule, Highlight, Integrator, LEAST_ADAPTIVE_SPP, Lens, Light, Material,
    Object, Rendering, Rgb, Scene, Shadows, Size, Tinted,
};
use crate::text::{Diagnostic, Span, concise};

/// The number of objects or materials up to which they are looked at one by one: more are made by a
/// program.
const MOST_SEARCHED: usize = 100_000;

/// How much more than it receives a surface may send back by rounding.
const ROUNDING: f64 = 1e-6;

/// How much brighter a picture may become by surfaces that send back more than they receive.
const GROWTH: f64 = 2.0;

/// What a text shows of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// A warning, at the place that causes it.
    pub warning: Diagnostic,
    /// The render setting that helps, and its value, if one does.
    pub cure: Option<(RenderKey, String)>,
}

/// What a source, as last lowered to `scene`, shows of its picture with these render settings. Takes
/// time linear in the scene.
pub fn outlook(source: &Source, scene: &Scene, asked: &Rendering) -> Vec<Outlook> {
    let view = Judge {
        source,
        scene,
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
        found.push(plain(view.nowhere(), message, "an object"));
        return found;
    }
    found.extend(view.never_adaptive());
    found.extend(view.clipped());
    found.extend(view.unlit().or_else(|| view.enclosed()));
    if asked.integrator().traces_paths() {
        found.extend(view.gains());
    }
    if asked.integrator() == Integrator::Photon {
        found.extend(view.without_photons());
    }
    found
}

struct Judge<'a> {
    source: &'a Source,
    scene: &'a Scene,
    asked: &'a Rendering,
}

impl Judge<'_> {
    /// Every object is behind the camera, nearer than the near limit or beyond the far limit.
    fn clipped(&self) -> Option<Outlook> {
        let Camera { eye, target, .. } = self.scene.camera;
        let [near, far] = self.scene.camera.depths;
        let forward = normalise(0.5 * target - 0.5 * eye)?;
        let depths = |object: &Object| {
            let bounds = object.shape.bounds();
            let depth = (bounds.centre() - eye).dot(forward);
            let half = 0.5 * bounds.size().dot(forward.abs());
            [depth - half, depth + half]
        };
        let all = |is: &dyn Fn([f64; 2]) -> bool| {
            let mut objects = self.scene.objects.iter();
            objects.all(|object| object.shape.bounds().is_bounded() && is(depths(object)))
        };
        let depths = "a range of depths that includes an object";
        let (key, side, expected) = if self.scene.objects.is_empty() {
            return None;
        } else if all(&|[_, end]| end < 0.0) {
            ("target", "behind the camera", "a view toward an object")
        } else if all(&|[_, end]| end < near) {
            ("near", "nearer than the near limit", depths)
        } else if all(&|[start, _]| far < start) {
            ("far", "beyond the far limit", depths)
        } else {
            return None;
        };
        let span = self.place(Node::View, key);
        let message = format!("every object is {side}: the picture is black");
        Some(plain(span, &message, expected))
    }

    /// The text asks for adaptive sampling, but for so few samples that no pixel can stop early.
    fn never_adaptive(&self) -> Option<Outlook> {
        let own = &self.scene.setting.rendering;
        let (noise, spp) = (own.noise()?, own.spp?);
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

    /// No light reaches any surface by the integrator.
    fn unlit(&self) -> Option<Outlook> {
        let scene = self.scene;
        let integrator = self.asked.integrator();
        let shines = |light: &&Light| light.colour != Rgb::ZERO;
        let is_lamp = |light: &&Light| light.emitter != Emitter::Ambient;
        let is_lit = match integrator {
            Integrator::Whitted => {
                scene.ambient != Rgb::ZERO || scene.lights.iter().any(|light| shines(&light))
            }
            Integrator::Path | Integrator::Photon => scene
                .lights
                .iter()
                .any(|light| is_lamp(&light) && shines(&light)),
        };
        if is_lit {
            return None;
        }
        let [background, around] = [scene.setting.background, scene.setting.environment]
            .map(|Tinted { colour, .. }| colour != Rgb::ZERO);
        // What reflects the light of no light looks the same without any.
        let is_seen_unlit = |material: &Material| {
            let glows = material.emission != Rgb::ZERO;
            let leads_on =
                material.mirror.tint != Rgb::ZERO || material.dielectric.tint != Rgb::ZERO;
            reflectance(material) == Rgb::ZERO && (glows || (leads_on && around))
        };
        if background || self.used().all(is_seen_unlit) {
            return None;
        }
        let glows = |material: &Material| material.emission != Rgb::ZERO;
        if around || self.used().any(glows) {
            // By path that lights; otherwise it is only seen.
            if integrator.traces_paths() {
                return None;
            }
            let message = "the only light is emission or the environment, which only path tracing carries to other surfaces";
            let finding = plain(self.nowhere(), message, "`integrator path`, or a light");
            return Some(Outlook {
                cure: setting("integrator", Integrator::Path.name()),
                ..finding
            });
        }
        let lamps = || scene.lights.iter().filter(is_lamp);
        Some(if lamps().next().is_some() {
            let first = scene.lights.iter().position(|light| is_lamp(&light));
            let span = self.source.span(Node::Light(first.unwrap_or_default()));
            let message = "all lights are off: they emit nothing";
            let finding = plain(span, message, "a light that emits");
            // Path tracing leaves out ambient light.
            let helps = integrator.traces_paths() && self.has_ambient();
            Outlook {
                cure: helps
                    .then(|| setting("integrator", Integrator::Whitted.name()))
                    .flatten(),
                ..finding
            }
        } else if integrator.traces_paths() && self.has_ambient() {
            let message =
                "the only light is ambient, which path tracing leaves out: the picture is black";
            let finding = plain(self.nowhere(), message, "a light, or `integrator whitted`");
            Outlook {
                cure: setting("integrator", Integrator::Whitted.name()),
                ..finding
            }
        } else {
            let message = "the scene has no light: the picture is black";
            plain(self.nowhere(), message, "a light")
        })
    }

    /// The materials of objects; all where trees combine several.
    fn used(&self) -> Box<dyn Iterator<Item = &Material> + '_> {
        let scene = self.scene;
        let is_tree = |object: &Object| matches!(object.shape, Shape::Csg(_));
        if scene.objects.iter().any(is_tree) {
            return Box::new(scene.materials.iter());
        }
        let of_object = |object: &Object| match &object.shape {
            Shape::Mesh(instance) => {
                let tags = instance.tags();
                tags.map(|tag| tag.unwrap_or(object.material)).collect()
            }
            _ => vec![object.material],
        };
        let used = scene.objects.iter().flat_map(of_object);
        Box::new(used.filter_map(|material| scene.materials.get(material as usize)))
    }

    fn has_ambient(&self) -> bool {
        self.scene.ambient_light() != Rgb::ZERO
    }

    /// The camera is inside an opaque solid that no light is in.
    fn enclosed(&self) -> Option<Outlook> {
        let scene = self.scene;
        let Camera { eye, .. } = scene.camera;
        if MOST_SEARCHED < scene.objects.len() {
            return None;
        }
        let starts = starts(&scene.camera)?;
        let is_ambient = self.asked.integrator() == Integrator::Whitted && self.has_ambient();
        let is_within = |place: DVec3, object: &Object| holds(&object.shape, place);
        let is_dark = |object: &Object| {
            let material = scene.materials.get(object.material as usize);
            let is_opaque = material.is_some_and(|material| {
                let glows = material.emission != Rgb::ZERO
                    || is_ambient && material.ambient.unwrap_or(material.diffuse) != Rgb::ZERO;
                material.dielectric.tint == Rgb::ZERO && !glows
            });
            let is_lit = scene.lights.iter().any(|light| match light.emitter {
                Emitter::Point { position, .. } => is_within(position, object),
                Emitter::Distant(_) | Emitter::Ambient => false,
            });
            is_opaque && !is_lit
        };
        let mut objects = scene.objects.iter().enumerate();
        let (index, _) = objects.find(|(_, object)| {
            let is_around = |start: &DVec3| is_within(*start, object);
            is_within(eye, object) && starts.iter().all(is_around) && is_dark(object)
        })?;
        let node = Node::Object(self.source.object(index as u32));
        let message = format!(
            "the camera is inside {}, which is opaque and holds no light",
            self.source.name(node)
        );
        Some(plain(
            self.nowhere(),
            &message,
            "an eye outside, or a light inside",
        ))
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
                cure: helps
                    .then(|| setting("falloff", FalloffRule::Square.name()))
                    .flatten(),
                ..plain(self.source.span(node), &message, expected)
            }
        });
        found.collect()
    }

    /// Materials that send back more than they receive.
    fn gains(&self) -> Vec<Outlook> {
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
        let found = materials.numbered().filter_map(|(index, material)| {
            let (gain, words) = gain(material);
            let user = users[index].filter(|_| 1.0 + ROUNDING < gain)?;
            let listed = index < self.source.nodes().materials;
            let node = if listed {
                Node::Material(index)
            } else {
                Node::Object(self.source.object(user))
            };
            let message = format!(
                "{}: {words} add up to {}: the picture grows brighter with every bounce",
                self.source.name(node),
                concise((1000.0 * gain).round() / 1000.0)
            );
            let finding = plain(self.source.span(node), &message, "a sum of at most 1");
            // The number of bounces in which it grows to twice the brightness.
            let depth = (libm::log(GROWTH) / libm::log(gain)).clamp(1.0, 64.0) as u32;
            let helps = depth < self.asked.depth();
            Some(Outlook {
                cure: helps
                    .then(|| setting("depth", &depth.to_string()))
                    .flatten(),
                ..finding
            })
        });
        found.collect()
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

/// The corners of what the camera sees at its near limit, where its rays start; the eye without a limit.
/// A convex solid that holds them holds all rays' starts.
fn starts(camera: &Camera) -> Option<Vec<DVec3>> {
    let [near, _] = camera.depths;
    if near == 0.0 {
        return Some(vec![camera.eye]);
    }
    let forward = normalise(0.5 * camera.target - 0.5 * camera.eye)?;
    let right = normalise(forward.cross(camera.up))?;
    let up = right.cross(forward);
    let half = match camera.lens {
        Lens::Perspective(angle) => near * libm::tan(0.5 * angle.to_radians()),
        Lens::Orthographic(height) => 0.5 * height,
    };
    let Size { width, height } = camera.size;
    let aspect = camera.pixel_aspect * f64::from(width) / f64::from(height);
    let corner = |x: f64, y: f64| {
        let aside = x * half * aspect * right + y * half * up;
        camera.eye + near * forward + aside
    };
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    Some(corners.map(|(x, y)| corner(x, y)).to_vec())
}

fn plain(span: Span, message: &str, expected: &str) -> Outlook {
    Outlook {
        warning: Diagnostic::warning(span, message, expected),
        cure: None,
    }
}

/// A render setting and its value.
pub(super) fn setting(key: &str, value: &str) -> Option<(RenderKey, String)> {
    Some((RenderKey::named(key)?, value.to_owned()))
}

/// Whether a closed shape holds a point: the first hit of any ray from it is a back face.
fn holds(shape: &Shape, point: DVec3) -> bool {
    let bounds = shape.bounds();
    let is_near = bounds.min.cmple(point).all() && point.cmple(bounds.max).all();
    if !is_near || matches!(shape, Shape::Mesh(_) | Shape::Plane(_)) {
        return false;
    }
    let ray = Ray {
        origin: point,
        // Along no axis, in which solids have edges.
        direction: DVec3::new(0.48, 0.6, 0.64),
    };
    let hit = shape.hit(&ray, f64::INFINITY);
    hit.is_some_and(|hit| 0.0 < shape.surface(&ray, hit).normal.dot(ray.direction))
}

/// What a material reflects of the light of lights.
fn reflectance(material: &Material) -> Rgb {
    let glossy = match material.highlight {
        Highlight::Phong(gloss) | Highlight::ModifiedPhong(gloss) | Highlight::Blinn(gloss) => {
            gloss.specular
        }
        Highlight::None => Rgb::ZERO,
        Highlight::Microfacet { .. } => Rgb::ONE,
    };
    material.diffuse + glossy
}

/// The largest sum of shares by which path tracing goes on at a surface, and its name. What a
/// texture darkens by an unknown amount is left out.
fn gain(material: &Material) -> (f64, &'static str) {
    let maps = material.maps.as_deref().copied().unwrap_or_default();
    let plain = |colour: Rgb, map: Option<u32>| map.map_or(colour, |_| Rgb::ZERO);
    // The albedos of the normalised lobes, as means over directions of incidence by their cosine.
    let glossy = match material.highlight {
        Highlight::ModifiedPhong(gloss) => 2.0 / 3.0 * gloss.specular,
        Highlight::Blinn(gloss) => {
            let exponent = gloss.exponent.max(0.0);
            0.5 * (exponent + 2.0) / (exponent + 4.0) * gloss.specular
        }
        Highlight::None | Highlight::Phong(_) | Highlight::Microfacet { .. } => Rgb::ZERO,
    };
    let glossy = plain(glossy, maps.specular);
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
