//! The scene: plain comparable data, independent of any scene language.

pub mod blocks;
mod light;
mod material;
mod mesh;
mod rendering;
mod setting;
mod texture;
mod viewpoint;

use glam::DVec3;

use geometry::{Aabb, Hit, Shape};

pub use blocks::Blocks;
pub use light::{Emitter, Falloff, Light, Shadows};
pub use material::{
    Bump, Dielectric, Faces, Gloss, Highlight, Maps, Material, Mirror, Reflectance, Shadow,
};
pub use mesh::{Meshes, NoMesh, beside};

pub use rendering::{
    CommandOption, DEFAULT_DEPTH, DEFAULT_SPP, EXPOSURES, FalloffRule, Filter, GlossRule,
    Integrator, LEAST_ADAPTIVE_SPP, MAX_DEPTH, MAX_SPP, RenderKey, RenderSetting, Rendering,
    Transfer, Values,
};
pub use setting::Setting;
pub use texture::{Image, Images, Pattern, Side, Texture, Tinted};
pub use viewpoint::Viewpoint;

/// The objects of a scene.
pub type Objects = Blocks<Object>;

/// The materials of a scene. Where each object states its own, block `k` holds the materials of the
/// objects in block `k`: a new material leaves the numbers in other blocks as they are.
pub type Materials = Blocks<Material>;

/// A linear colour: red, green and blue, unclamped.
pub type Rgb = DVec3;

/// All that determines a picture, apart from render settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Ambient light other than [`Emitter::Ambient`].
    pub ambient: Rgb,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Materials, which objects refer to by index.
    pub materials: Materials,
    /// Textures, which materials, the setting and other textures refer to by index.
    pub textures: Vec<Texture>,
    /// Objects, in file order.
    pub objects: Objects,
    /// Surroundings and output settings.
    pub setting: Setting,
}

impl Scene {
    /// The tight bounding box of all bounded objects.
    pub fn bounds(&self) -> Aabb {
        bounds(self.objects.iter())
    }

    /// The sum of all ambient light.
    pub fn ambient_light(&self) -> Rgb {
        let lights = self.lights.iter();
        let ambient = lights.filter(|light| light.emitter == Emitter::Ambient);
        ambient.fold(self.ambient, |sum, light| sum + light.colour)
    }
}

/// The tight bounding box of those objects that are bounded.
pub fn bounds<'o>(objects: impl Iterator<Item = &'o Object>) -> Aabb {
    objects
        .map(|object| object.shape.bounds())
        .filter(|bounds| bounds.is_bounded())
        .fold(Aabb::EMPTY, Aabb::union)
}

/// The maximum number of pixels of a picture. Tracing takes about 40 bytes per pixel: 10 GB at this limit.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Width and height in pixels, each at least 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Size {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Size {
    /// Parses a size such as `800x600`, also with a space as the separator.
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

    /// The number of pixels.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// The position, orientation and lens of the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position.
    pub eye: DVec3,
    /// The point looked at; differs from `eye`.
    pub target: DVec3,
    /// The up direction, of any nonzero length.
    pub up: DVec3,
    /// Projection.
    pub lens: Lens,
    /// Width over height of a pixel on the image plane, above 0.
    pub pixel_aspect: f64,
    /// Near and far limits of the visible distances along the view: the near limit is 0 or more,
    /// the far limit may be infinite.
    pub depths: [f64; 2],
    /// Depth of field.
    pub focus: Focus,
    /// Size of the output picture; its aspect ratio applies at every traced size.
    pub size: Size,
}

impl Camera {
    /// Below this sine of the angle between view and `up`, `up` is undefined and replaced by the
    /// world axis most nearly perpendicular to the view.
    pub const LEAST_SINE: f64 = 1e-9;

    /// Depth limits that clip nothing.
    pub const ALL_DEPTHS: [f64; 2] = [0.0, f64::INFINITY];

    /// The camera turned about the axis through its target in the up direction, counter-clockwise as
    /// seen from above, by an angle in radians (Rodrigues' formula). It still looks at the target.
    #[must_use]
    pub fn about_target(&self, angle: f64) -> Self {
        let axis = self.up.normalize();
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let from = self.eye - self.target;
        let turned =
            cosine * from + sine * axis.cross(from) + (1.0 - cosine) * axis.dot(from) * axis;
        Self {
            eye: self.target + turned,
            ..*self
        }
    }
}

/// The depth of field of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// Distance of the plane in focus along the view, above 0.
    pub distance: f64,
    /// Radius of the lens, 0 or more; at 0 everything is in focus.
    pub lens_radius: f64,
}

impl Focus {
    /// A camera without depth of field.
    pub const PINHOLE: Self = Self {
        distance: 1.0,
        lens_radius: 0.0,
    };
}

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Rays diverge from the eye; vertical field of view in degrees, between 0 and 180 exclusive.
    Perspective(f64),
    /// Rays are parallel; height of the visible area in world units, above 0.
    Orthographic(f64),
}

/// A shape with a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Geometry.
    pub shape: Shape,
    /// Index of the material in [`Scene::materials`]. Parts of CSG solids and meshes may have their
    /// own; for a CSG solid this is then that of the first part.
    pub material: u32,
}

impl Object {
    /// Returns the index of the material at a hit.
    #[inline]
    pub fn material_at(&self, hit: Hit) -> u32 {
        self.shape.tag(hit).unwrap_or(self.material)
    }
}
