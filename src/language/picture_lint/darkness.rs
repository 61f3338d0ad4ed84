//! Scenes that can only be dark: without light, or with the camera or all lights inside opaque solids.

use glam::DVec3;

use super::{Judge, MOST_SEARCHED, Outlook, Prospect, black, forward, plain};
use crate::Node;
use geometry::{Aabb, Ray, Shape, Solid, normalise};
use scene::{
    Camera, Emitter, Highlight, Integrator, Lens, Light, Material, Object, Rgb, Shadows, Size,
};

impl Judge<'_> {
    /// No light reaches any surface by the integrator.
    pub(super) fn unlit(&self) -> Option<Outlook> {
        let scene = self.scene;
        let integrator = self.asked.integrator();
        let shines = |light: &&Light| light.colour != Rgb::ZERO;
        let is_lit = match integrator {
            Integrator::Whitted => {
                let reflects = |material: &Material| material.ambience(Rgb::ONE) != Rgb::ZERO;
                let is_ambient = scene.ambient != Rgb::ZERO && self.used().any(reflects);
                is_ambient || scene.lights.iter().any(|light| shines(&light))
            }
            Integrator::Path | Integrator::Photon => scene
                .lights
                .iter()
                .any(|light| is_lamp(light) && shines(&light)),
        };
        if is_lit {
            return None;
        }
        let background = !self.is_backdrop_black();
        let around = scene.setting.environment.colour != Rgb::ZERO;
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

    /// The materials of objects.
    fn used(&self) -> impl Iterator<Item = &Material> {
        self.scene.objects.iter().flat_map(|object| self.of(object))
    }

    /// The materials that an object's surface may have.
    fn of(&self, object: &Object) -> impl Iterator<Item = &Material> {
        let numbers: Vec<_> = match &object.shape {
            Shape::Mesh(instance) => {
                let tags = instance.tags();
                tags.map(|tag| tag.unwrap_or(object.material)).collect()
            }
            Shape::Csg(csg) => csg.tags().collect(),
            Shape::Solid(_) | Shape::Plane(_) => vec![object.material],
        };
        let materials = &self.scene.materials;
        let numbers = numbers.into_iter();
        numbers.filter_map(|number| materials.get(number as usize))
    }

    fn has_ambient(&self) -> bool {
        self.scene.ambient_light() != Rgb::ZERO
    }

    /// The camera is inside an opaque solid that no light gets into.
    pub(super) fn enclosed(&self) -> Option<Outlook> {
        let objects = &self.scene.objects;
        let starts = Starts::of(self.camera)?;
        let shining = self.scene.lights.iter().filter(|light| shines(light));
        if MOST_SEARCHED < objects.len() || shining.clone().any(passes_all) {
            return None;
        }
        let is_lit = |object: &Object| {
            shining.clone().any(|light| gets_into(light, &object.shape))
                || objects.iter().any(|other| {
                    let overlap = |other: &Object| {
                        let [own, other] = [object, other].map(|object| object.shape.bounds());
                        own.intersection(other)
                    };
                    self.glows(other) && !overlap(other).is_empty()
                })
        };
        let is_dark = |object: &Object| {
            holds(&object.shape, self.camera.eye)
                && starts.are_within(&object.shape)
                && self.encloses(object)
                && self.ends_view(&object.shape)
                && !is_lit(object)
        };
        let index = objects.iter().position(is_dark)?;
        let node = Node::Object(self.source.object(index as u32));
        let message = format!(
            "the camera is inside {}, which is opaque and holds no light",
            self.source.name(node)
        );
        let expected = "an eye outside, or a light inside";
        Some(black(self.nowhere(), &message, expected))
    }

    /// Whether no light passes through any part of an object's surface, and the surface bounds a part
    /// of space.
    fn encloses(&self, object: &Object) -> bool {
        let blocks = |material: &Material| {
            material.shadow.transmittance() == 0.0 && material.dielectric.tint == Rgb::ZERO
        };
        object.shape.bounds().is_bounded() && self.of(object).all(blocks)
    }

    /// Whether rays within a shape meet it before the far limit, or end in black.
    fn ends_view(&self, shape: &Shape) -> bool {
        let [_, far] = self.camera.depths;
        let depths = forward(self.camera).and_then(|forward| self.depths(shape, forward));
        self.is_backdrop_black() || depths.is_some_and(|[_, end]| end < far)
    }

    /// Whether an object is seen without any light that has a place or direction.
    fn glows(&self, object: &Object) -> bool {
        let is_ambient = self.asked.integrator() == Integrator::Whitted && self.has_ambient();
        self.of(object).any(|material| {
            let reflected = material.ambient.unwrap_or(material.diffuse);
            material.emission != Rgb::ZERO || is_ambient && reflected != Rgb::ZERO
        })
    }

    /// Every light that shines is inside an opaque solid that the camera is not in.
    pub(super) fn sealed(&self) -> Option<Outlook> {
        let scene = self.scene;
        let shining = scene.lights.iter().filter(|light| shines(light)).count();
        let searched = scene.objects.len().saturating_mul(shining);
        if MOST_SEARCHED < searched || self.is_seen_without_lights() {
            return None;
        }
        let mut first = None;
        for (index, light) in scene.lights.iter().enumerate() {
            if shines(light) {
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
        let around = scene.setting.environment.colour != Rgb::ZERO;
        around || !self.is_backdrop_black() || scene.objects.iter().any(|object| self.glows(object))
    }

    /// The opaque solid that a light without a size is in and the camera is not.
    fn solid_around(&self, light: &Light) -> Option<usize> {
        let Emitter::Point {
            position, radius, ..
        } = light.emitter
        else {
            return None;
        };
        if radius != 0.0 || passes_all(light) {
            return None;
        }
        let starts = Starts::of(self.camera)?;
        let is_outside = |shape: &Shape| match &starts {
            Starts::At(eye) => !holds(shape, *eye),
            Starts::Within(_) => {
                let [near, _] = self.camera.depths;
                let depths = forward(self.camera).and_then(|forward| self.depths(shape, forward));
                depths.is_some_and(|[start, end]| near < start || end < near)
            }
        };
        self.scene.objects.iter().position(|object| {
            let shape = &object.shape;
            holds(shape, position) && self.encloses(object) && is_outside(shape)
        })
    }
}

/// Whether a light has a place or a direction.
fn is_lamp(light: &Light) -> bool {
    light.emitter != Emitter::Ambient
}

/// Whether a light adds any that has a place or a direction.
fn shines(light: &Light) -> bool {
    is_lamp(light) && light.colour != Rgb::ZERO
}

/// Whether nothing holds up a light.
fn passes_all(light: &Light) -> bool {
    light.shadows == Shadows::Off
}

/// Whether a light that casts shadows may light the inside of an opaque solid.
fn gets_into(light: &Light, shape: &Shape) -> bool {
    match light.emitter {
        Emitter::Point {
            position,
            radius: 0.0,
            ..
        } => holds(shape, position),
        Emitter::Point {
            position, radius, ..
        } => {
            let ball = Aabb {
                min: position - radius,
                max: position + radius,
            };
            !ball.intersection(shape.bounds()).is_empty()
        }
        Emitter::Distant(_) | Emitter::Ambient => false,
    }
}

/// Where the camera's rays start.
enum Starts {
    /// At one point.
    At(DVec3),
    /// Within a rectangle with these corners.
    Within([DVec3; 4]),
}

impl Starts {
    /// `None` if the camera's axes are not known.
    fn of(camera: &Camera) -> Option<Self> {
        let [near, _] = camera.depths;
        let half = match camera.lens {
            Lens::Perspective(angle) => near * libm::tan(0.5 * angle.to_radians()),
            Lens::Orthographic(height) => 0.5 * height,
        };
        let around = camera.focus.lens_radius;
        if half == 0.0 && around == 0.0 {
            return Some(Self::At(camera.eye));
        }
        let forward = forward(camera)?;
        let right = forward.cross(normalise(camera.up)?);
        if right.length() < Camera::LEAST_SINE {
            return None;
        }
        let right = normalise(right)?;
        let up = right.cross(forward);
        let Size { width, height } = camera.size;
        let aspect = camera.pixel_aspect * f64::from(width) / f64::from(height);
        let [right, up] = [(half * aspect + around) * right, (half + around) * up];
        let middle = camera.eye + near * forward;
        let corners = [right + up, right - up, up - right, -right - up];
        Some(Self::Within(corners.map(|corner| middle + corner)))
    }

    /// Whether all are within a solid; false if that is not known.
    fn are_within(&self, shape: &Shape) -> bool {
        match self {
            Self::At(eye) => holds(shape, *eye),
            Self::Within(corners) => {
                let is_convex = match shape {
                    Shape::Solid(solid) => !matches!(solid, Solid::Quadric(_)),
                    Shape::Csg(_) | Shape::Plane(_) | Shape::Mesh(_) => false,
                };
                is_convex && corners.iter().all(|corner| holds(shape, *corner))
            }
        }
    }
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
        Highlight::Phong(gloss)
        | Highlight::ModifiedPhong(gloss)
        | Highlight::Blinn(gloss)
        | Highlight::PlainBlinn(gloss) => gloss.specular,
        Highlight::None => Rgb::ZERO,
        Highlight::Microfacet { .. } => Rgb::ONE,
    };
    material.diffuse + glossy
}
