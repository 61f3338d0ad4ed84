//! Scenes that can only be dark: without light, or with the camera or all lights inside opaque solids.

use glam::DVec3;

use super::{Judge, MOST_SEARCHED, Outlook, Prospect, black, plain};
use crate::geometry::{Ray, Shape, normalise};
use crate::language::Node;
use crate::scene::{
    Camera, Emitter, Highlight, Integrator, Lens, Light, Material, Object, Rgb, Shadows, Size,
    Tinted,
};

impl Judge<'_> {
    /// No light reaches any surface by the integrator.
    pub(super) fn unlit(&self) -> Option<Outlook> {
        let scene = self.scene;
        let integrator = self.asked.integrator();
        let shines = |light: &&Light| light.colour != Rgb::ZERO;
        let is_lit = match integrator {
            Integrator::Whitted => {
                scene.ambient != Rgb::ZERO || scene.lights.iter().any(|light| shines(&light))
            }
            Integrator::Path | Integrator::Photon => scene
                .lights
                .iter()
                .any(|light| is_lamp(light) && shines(&light)),
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
            return Some(Outlook {
                prospect: Prospect::Unlit,
                ..plain(self.nowhere(), message, "a light")
            });
        }
        let first = scene.lights.iter().position(is_lamp);
        Some(if let Some(first) = first {
            let span = self.source.span(Node::Light(first));
            let message = "all lights are off: they emit nothing";
            black(span, message, "a light that emits")
        } else if integrator.traces_paths() && self.has_ambient() {
            let message =
                "the only light is ambient, which path tracing leaves out: the picture is black";
            black(self.nowhere(), message, "a light")
        } else {
            let message = "the scene has no light: the picture is black";
            black(self.nowhere(), message, "a light")
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
    pub(super) fn enclosed(&self) -> Option<Outlook> {
        let scene = self.scene;
        let eye = self.camera.eye;
        if MOST_SEARCHED < scene.objects.len() {
            return None;
        }
        let starts = starts(self.camera)?;
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
        let expected = "an eye outside, or a light inside";
        Some(black(self.nowhere(), &message, expected))
    }

    /// Every light that shines is inside an opaque solid that the camera is not in.
    pub(super) fn sealed(&self) -> Option<Outlook> {
        let scene = self.scene;
        let shines = |light: &&Light| light.colour != Rgb::ZERO && is_lamp(light);
        let shining = scene.lights.iter().filter(shines).count();
        let searched = scene.objects.len().saturating_mul(shining);
        if MOST_SEARCHED < searched || self.is_seen_without_lights() {
            return None;
        }
        let mut first = None;
        for (index, light) in scene.lights.iter().enumerate() {
            if shines(&light) {
                let solid = self.solid_around(light)?;
                first.get_or_insert((index, solid));
            }
        }
        let (index, solid) = first?;
        let (light, solid) = (
            Node::Light(index),
            Node::Object(self.source.object(solid as u32)),
        );
        let [name, solid] = [light, solid].map(|node| self.source.name(node));
        let message = if shining == 1 {
            format!("{name} is inside {solid}, which is opaque: the picture is black")
        } else {
            format!("all lights are inside opaque solids ({name} in {solid}): the picture is black")
        };
        let expected = "a light outside, or a transparent solid";
        Some(black(self.source.span(light), &message, expected))
    }

    /// Whether something can be seen without any light that has a place or direction.
    fn is_seen_without_lights(&self) -> bool {
        let scene = self.scene;
        let is_ambient = self.asked.integrator() == Integrator::Whitted && self.has_ambient();
        let around = [scene.setting.background, scene.setting.environment];
        around.iter().any(|around| around.colour != Rgb::ZERO)
            || self.used().any(|material| {
                let reflected = material.ambient.unwrap_or(material.diffuse);
                material.emission != Rgb::ZERO || is_ambient && reflected != Rgb::ZERO
            })
    }

    /// The opaque solid that a light without a size is in and the camera is not.
    fn solid_around(&self, light: &Light) -> Option<usize> {
        let Emitter::Point {
            position, radius, ..
        } = light.emitter
        else {
            return None;
        };
        if radius != 0.0 || light.shadows == Shadows::Off {
            return None;
        }
        let is_whitted = self.asked.integrator() == Integrator::Whitted;
        let blocks = |material: &Material| {
            let is_clear = material.dielectric.tint != Rgb::ZERO && !is_whitted;
            material.shadow.transmittance() == 0.0 && !is_clear
        };
        let starts = starts(self.camera)?;
        let is_outside = |shape: &Shape| {
            let mut seen = starts.iter().chain([&self.camera.eye]);
            !seen.any(|start| holds(shape, *start))
        };
        self.scene
            .objects
            .iter()
            .position(|Object { shape, material }| {
                let material = self.scene.materials.get(*material as usize);
                material.is_some_and(blocks) && holds(shape, position) && is_outside(shape)
            })
    }
}

/// Whether a light has a place or a direction.
fn is_lamp(light: &Light) -> bool {
    light.emitter != Emitter::Ambient
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
