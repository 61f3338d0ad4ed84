//! What surfaces are made of, and what stands around everything.

use glam::DAffine3;

use super::Rgb;

/// What a surface is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Of `.ray` and `.dat`: Whitted's model with Phong highlights.
    Phong(Phong),
    /// Of `.xml`.
    Utah(Box<Utah>),
    /// One colour, whatever light there is.
    Flat(Rgb),
}

impl Material {
    /// The colour that it is known by.
    pub fn colour(&self) -> Rgb {
        match self {
            Self::Phong(phong) => phong.diffuse,
            Self::Utah(utah) => match &utah.finish {
                Finish::Blinn(gloss) | Finish::Phong(gloss) => gloss.diffuse.colour,
                Finish::Microfacet { colour, .. } => colour.colour,
            },
            Self::Flat(colour) => *colour,
        }
    }
}

/// How a surface answers light (Whitted's model with Phong highlights).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phong {
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
    /// Index in [`super::Scene::textures`] of what multiplies its ambient, diffuse and specular colours.
    pub colour_texture: Option<u32>,
    /// Index in [`super::Scene::textures`] of what raises its surface, and how high the brightest
    /// places stand, in world units.
    pub bump: Option<(u32, f64)>,
}

/// How a surface of the University of Utah's course answers light.
#[derive(Clone, Debug, PartialEq)]
pub struct Utah {
    /// What it does with light from outside.
    pub finish: Finish,
    /// What it mirrors.
    pub reflection: Tinted,
    /// How much mirrored rays are spread: the tangent of an angle is this.
    pub reflection_spread: f64,
    /// What it lets through.
    pub refraction: Tinted,
    /// How much refracted rays are spread.
    pub refraction_spread: f64,
    /// Index of refraction; 0 or less reads as 1.
    pub index: f64,
    /// What is lost inside, per unit of length.
    pub absorption: Rgb,
    /// What shines by itself.
    pub emission: Tinted,
}

/// What a surface does with light from outside.
#[derive(Clone, Debug, PartialEq)]
pub enum Finish {
    /// A highlight around the normal (Blinn, "Models of light reflection for computer synthesized
    /// pictures", 1977).
    Blinn(Gloss),
    /// A highlight around the mirrored direction.
    Phong(Gloss),
    /// Little mirrors (Walter and others, "Microfacet models for refraction through rough
    /// surfaces", 2007).
    Microfacet {
        /// Its colour.
        colour: Tinted,
        /// How rough it is; 0 mirrors perfectly.
        roughness: Textured,
        /// How much of it is metal.
        metallic: Textured,
    },
}

/// Even and shiny light.
#[derive(Clone, Debug, PartialEq)]
pub struct Gloss {
    /// Light sent back evenly.
    pub diffuse: Tinted,
    /// The highlight.
    pub specular: Tinted,
    /// Its exponent.
    pub glossiness: Textured,
}

/// A colour, multiplied by a texture where it has one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tinted {
    /// The colour.
    pub colour: Rgb,
    /// Index in [`Setting::textures`].
    pub texture: Option<u32>,
}

/// A number, multiplied by the red of a texture where it has one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Textured {
    /// The number.
    pub value: f64,
    /// Index in [`Setting::textures`].
    pub texture: Option<u32>,
}

/// A colour at every place uv, seen through a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MappedTexture {
    /// From (u, v, 0) to the place in the pattern.
    pub inverse: DAffine3,
    /// What is seen there.
    pub pattern: MappedPattern,
}

/// What a mapped texture shows.
#[derive(Clone, Debug, PartialEq)]
pub enum MappedPattern {
    /// Of the fractional u and v: the first where both or neither are at most ½, else the second.
    /// Their textures come later in [`Setting::textures`] and see the mapped uv.
    Checkerboard([Tinted; 2]),
    /// A picture, by its path as the text says it.
    Image(String),
}

/// What stands around everything, and how the picture is meant to be made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// What the camera sees behind everything, over the whole picture.
    pub background: Tinted,
    /// What other rays meet there.
    pub environment: Tinted,
    /// What the mapped colours of the scene name by index.
    pub textures: Vec<MappedTexture>,
    /// How light is gathered.
    pub integrator: Integrator,
    /// What is done to values before they become bytes.
    pub transfer: Transfer,
}

/// How light is gathered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// By Whitted's rays.
    #[default]
    Whitted,
    /// By random paths.
    Path,
}

/// What is done to values before they become bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// Nothing.
    #[default]
    Linear,
    /// The curve of sRGB.
    Srgb,
}
