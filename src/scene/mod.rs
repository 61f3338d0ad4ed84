//! What a scene is: plain comparable data, in no language.

mod mesh;
pub(crate) mod objects;
mod surface;
mod texture;

use glam::DVec3;

use crate::geometry::{Aabb, Hit, Shape};

pub use mesh::{Meshes, NoMesh, beside};
pub use objects::Objects;
pub use surface::{
    Finish, Gloss, Integrator, MappedPattern, MappedTexture, Material, Phong, Setting, Textured,
    Tinted, Transfer, Utah,
};
pub use texture::{Image, Images, Pattern, Texture};

/// A linear colour: red, green, blue, unclamped.
pub type Rgb = DVec3;

/// Everything a picture is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// From where it is seen.
    pub camera: Camera,
    /// Ambient light, all of it.
    pub ambient: Rgb,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Materials; objects name them by index.
    pub materials: Vec<Material>,
    /// Textures; materials name them by index.
    pub textures: Vec<Texture>,
    /// Objects, in file order.
    pub objects: Objects,
    /// What stands around them, and how the picture is meant to be made.
    pub setting: Setting,
}

impl Scene {
    /// The tight box around all objects, but for those without bounds.
    pub fn bounds(&self) -> Aabb {
        bounds(self.objects.iter())
    }
}

/// The tight box around objects, but for those without bounds.
pub(crate) fn bounds<'o>(objects: impl Iterator<Item = &'o Object>) -> Aabb {
    objects
        .map(|object| object.shape.bounds())
        .filter(|bounds| bounds.is_bounded())
        .fold(Aabb::EMPTY, Aabb::union)
}

/// Width and height in pixels, each at least 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Size {
    /// Reads a size as people say it: `800x600`, or with a blank between.
    pub fn parse(said: &str) -> Option<Self> {
        let number = |digits: &str| {
            let digits = digits.trim();
            let plain = digits.bytes().all(|b| b.is_ascii_digit());
            digits.parse().ok().filter(|&n: &u32| plain && 0 < n)
        };
        let (width, height) = said.trim().split_once(['x', 'X', '×', ' '])?;
        Some(Self {
            width: number(width)?,
            height: number(height)?,
        })
    }

    /// How many pixels it has.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// From where and how a scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: DVec3,
    /// The point it looks at; differs from `eye`.
    pub target: DVec3,
    /// Which way is up; of any length.
    pub up: DVec3,
    /// How it sees.
    pub lens: Lens,
    /// The shape of a pixel: its width over its height on the image plane, above 0.
    pub pixel_aspect: f64,
    /// What the picture shows of the distances along the view: nothing nearer than the first, 0 or
    /// more, and nothing farther than the second, which may be infinite.
    pub depths: [f64; 2],
    /// What it shows sharp.
    pub focus: Focus,
    /// Size of the output picture; its ratio is the picture's, whatever size is traced.
    pub size: Size,
}

impl Camera {
    /// Below this sine of the angle between them, the direction of view leaves `up` no meaning, and
    /// the world axis most across the view stands in for it.
    pub const LEAST_SINE: f64 = 1e-9;

    /// All distances along the view.
    pub const ALL_DEPTHS: [f64; 2] = [0.0, f64::INFINITY];
}

/// What a camera shows sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// How far along the view what is sharp stands, above 0.
    pub distance: f64,
    /// The radius of its lens, 0 or more: 0 shows everything sharp.
    pub lens_radius: f64,
}

impl Focus {
    /// Everything is sharp.
    pub const PINHOLE: Self = Self {
        distance: 1.0,
        lens_radius: 0.0,
    };
}

/// How a camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Rays go out from the eye; the vertical full angle in degrees, above 0 and below 180.
    Perspective(f64),
    /// Rays go side by side; the height of what is seen, in world units, above 0.
    Orthographic(f64),
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where its light comes from.
    pub source: Source,
    /// What it sends.
    pub colour: Rgb,
    /// Whether objects keep it from others.
    pub shadows: Shadows,
    /// Of a point, how large it is: the radius, 0 or more.
    pub radius: f64,
}

impl Light {
    /// A point light without falloff that casts shadows.
    pub const fn point(position: DVec3, colour: Rgb) -> Self {
        Self {
            source: Source::Point {
                position,
                falloff: Falloff::NONE,
            },
            colour,
            shadows: Shadows::Cast,
            radius: 0.0,
        }
    }
}

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A point.
    Point {
        /// Where it stands.
        position: DVec3,
        /// How it falls off.
        falloff: Falloff,
    },
    /// Infinitely far away; the unit vector toward it.
    Distant(DVec3),
    /// Everywhere: it counts in [`Scene::ambient`] already.
    Everywhere,
}

/// How the light of a point falls off. SPEC of `.dat`: with distance d by 1 / (a0 + a1 d + a2 d²),
/// or not at all where that is not above 0; with the angle α from a direction by (cos α)^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Falloff {
    /// a0, a1, a2.
    pub radial: [f64; 3],
    /// The unit vector of a spot light's direction, and its exponent.
    pub spot: Option<(DVec3, f64)>,
}

impl Falloff {
    /// The same light at any distance, in any direction.
    pub const NONE: Self = Self {
        radial: [1.0, 0.0, 0.0],
        spot: None,
    };
}

/// Whether objects keep a light from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadows {
    /// They do.
    Cast,
    /// They do not.
    Off,
}

/// A shape and what it is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Where it is.
    pub shape: Shape,
    /// Index of its material in [`Scene::materials`]; the parts of a CSG solid name their own.
    pub material: u32,
}

impl Object {
    /// Index of the material at a hit.
    pub fn material_at(&self, hit: Hit) -> u32 {
        self.shape.tag(hit).unwrap_or(self.material)
    }
}
