//! Arbitrary output variables: what a picture can show other than light.

/// Declares the AOVs that are named without a number, with these names, and lists them.
///
/// A new one also needs its choice in `cli/choices.rs`, and its value in `first_hit.rs` or
/// `light_component.rs` if it is not one of light's samples. The compiler asks for its tone
/// (`picture/tone.rs`), its channels (here and in `image_file/exr.rs`) and its words in the interface
/// (`ui/app/pictures/mod.rs`), but not for the words about its range (`ui/app/display/light.rs`).
macro_rules! aovs {
    ($($(#[$doc:meta])* $aov:ident: $name:literal,)+) => {
        /// An arbitrary output variable: a property of the first surface under a pixel, of the samples of
        /// its light, or a share of the light.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Aov {
            $($(#[$doc])* $aov,)+
            /// Light that the first surface reflects of the light with this index in the scene. Together
            /// with [`Aov::Emission`] and [`Aov::Indirect`], such shares of all lights add up to the light.
            Direct(u32),
        }

        /// The AOVs that are named without a number.
        pub(crate) const AOVS: &[Aov] = &[$(Aov::$aov,)+];

        impl Aov {
            /// The name, such as `depth`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$aov => $name,)+
                    Self::Direct(_) => "direct",
                }
            }
        }
    };
}

aovs! {
    /// Distance from the eye in world units, infinite without a surface. In 8 bits the nearest is
    /// white, the farthest black.
    Depth: "depth",
    /// Unit shading normal including bumps, turned toward the eye; 0 without a surface. In 8 bits
    /// −1 to 1 become 0 to 255.
    Normal: "normal",
    /// Number of the object in the scene, from 1; 0 without an object. In 8 bits each object has
    /// its own colour.
    Object: "object",
    /// Diffuse albedo including textures; the emission of surfaces without diffuse or highlight.
    Albedo: "albedo",
    /// Texture coordinates u and v of the surface; 0 without one. In 8 bits red and green, repeated
    /// beyond 0 to 1.
    Uv: "uv",
    /// Side of the surface seen, by its geometric normal: 1 its front, −1 its back, 0 without a
    /// surface. In 8 bits blue and orange.
    Side: "side",
    /// Rays traced for a sample of light, including shadow rays, as the mean of the samples. In 8
    /// bits dark to bright on a logarithmic scale, as [`Frame::range`](crate::Frame::range) says.
    Cost: "cost",
    /// Samples taken of the light. In 8 bits dark to bright on a logarithmic scale.
    Samples: "samples",
    /// Estimated error of the displayed light, 0 to 1, in its worst channel; 0 before samples were
    /// first doubled. In 8 bits dark to bright.
    Noise: "noise",
    /// Light seen to glow: emission and ambient light of the first surface, the background, and
    /// lights with a size.
    Emission: "emission",
    /// Light that arrives over further surfaces: by mirrors and glass, with path tracing by all.
    Indirect: "indirect",
}

impl Aov {
    /// The number of channels that its values differ in; the others repeat the first or are 0.
    pub fn channels(self) -> usize {
        match self {
            Self::Normal | Self::Albedo | Self::Direct(_) | Self::Emission | Self::Indirect => 3,
            Self::Uv => 2,
            Self::Depth | Self::Object | Self::Side | Self::Cost | Self::Samples | Self::Noise => 1,
        }
    }

    /// Whether it is known from tracing light, which makes switching between it and light free.
    pub fn is_of_light(self) -> bool {
        matches!(self, Self::Cost | Self::Samples | Self::Noise)
    }

    /// Whether it is a share of the light.
    pub fn is_share(self) -> bool {
        matches!(self, Self::Direct(_) | Self::Emission | Self::Indirect)
    }

    /// The number of samples per pixel to take if `asked` are requested. Distances, numbers of
    /// objects, texture coordinates and sides cannot be averaged: they take one, at the centre.
    pub fn samples(self, asked: u32) -> u32 {
        match self {
            Self::Depth | Self::Object | Self::Uv | Self::Side => 1,
            _ => asked,
        }
    }
}
