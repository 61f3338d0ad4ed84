//! What a scene means: plain comparable data, and how each language's tree is lowered to it.
//!
//! [`fields`] is the one table of what can be said about a thing; lowering reads its grammar from
//! it, the editor its types, ranges and steps, the help its words. Scene values hold no spans:
//! [`Origins`] sits beside a scene and says where in the text each field stands.

pub mod fields;
mod lower;
mod origins;

use glam::DVec3;

use crate::geometry::{Aabb, Shape};

pub use lower::{Lowered, lower, view_edits};
pub use origins::{Node, Origins, Placed};

/// A linear colour: red, green, blue, unclamped.
pub type Rgb = DVec3;

/// Everything a picture is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// From where it is seen.
    pub camera: Camera,
    /// Ambient light.
    pub ambient: Rgb,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Materials; objects name them by index.
    pub materials: Vec<Material>,
    /// Objects, in file order.
    pub objects: Vec<Object>,
}

impl Scene {
    /// The tight box around all objects.
    pub fn bounds(&self) -> Aabb {
        bounds(&self.objects)
    }
}

/// The tight box around objects.
fn bounds(objects: &[Object]) -> Aabb {
    objects
        .iter()
        .fold(Aabb::EMPTY, |all, object| all.union(object.shape.bounds()))
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

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: DVec3,
    /// The point it looks at; differs from `eye`.
    pub target: DVec3,
    /// Which way is up; of any length.
    pub up: DVec3,
    /// Vertical full angle in degrees, above 0 and below 180.
    pub fov: f64,
    /// Size of the output picture; its ratio is the picture's, whatever size is traced.
    pub size: Size,
}

impl Camera {
    /// Below this sine of the angle between them, the direction of view leaves `up` no meaning, and
    /// the world axis most across the view stands in for it.
    pub const LEAST_SINE: f64 = 1e-9;

    /// Its numbers in the order of [`fields::VIEW`]: of each entry, as many as the field has.
    pub fn numbers(&self) -> [[f64; 3]; fields::VIEW.len()] {
        let Size { width, height } = self.size;
        [
            self.eye.to_array(),
            self.target.to_array(),
            self.up.to_array(),
            [self.fov, 0.0, 0.0],
            [width.into(), height.into(), 0.0],
        ]
    }
}

/// A point light without falloff.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it stands.
    pub position: DVec3,
    /// What it sends.
    pub colour: Rgb,
}

/// How a surface answers light (Whitted's model with Phong highlights).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Share of ambient light sent back, ka.
    pub ambient: Rgb,
    /// Share of light sent back diffusely, kd.
    pub diffuse: Rgb,
    /// Strength of the highlight, ks.
    pub specular: Rgb,
    /// Exponent of the highlight, ns; below 0 reads as 0.
    pub exponent: f64,
    /// Weight of the mirrored ray, kr.
    pub reflection: f64,
    /// Weight of the refracted ray and of light in shadow rays, kt.
    pub transmission: f64,
    /// Index of refraction; 0 or less reads as 1.
    pub index: f64,
}

/// A shape and what it is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Where it is.
    pub shape: Shape,
    /// Index of its material in [`Scene::materials`].
    pub material: u32,
}
