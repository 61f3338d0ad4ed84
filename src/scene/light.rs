//! Light sources.

use std::f64::consts::PI;

use glam::DVec3;

use super::{FalloffRule, Rgb};

/// A light source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its shape and position.
    pub emitter: Emitter,
    /// Intensity; irradiance for distant and ambient light.
    pub colour: Rgb,
    /// The factor on the colour in path tracing: π if a white matte surface facing the light should
    /// reflect exactly its colour, 1 if the colour is a radiometric quantity.
    pub scale: f64,
    /// Whether objects cast shadows in its light.
    pub shadows: Shadows,
}

impl Light {
    /// A point light that casts shadows, without size or falloff.
    pub const fn point(position: DVec3, colour: Rgb) -> Self {
        Self {
            emitter: Emitter::Point {
                position,
                radius: 0.0,
                falloff: Falloff::NONE,
            },
            colour,
            scale: PI,
            shadows: Shadows::Cast,
        }
    }

    /// Whether it sends out light that photons can carry: fading with the square of the distance, by
    /// its own terms, by a rule for those without, or by a radiance, and casting shadows.
    pub fn emits_photons(&self, rule: FalloffRule) -> bool {
        let Emitter::Point {
            radius, falloff, ..
        } = &self.emitter
        else {
            return false;
        };
        let [constant, linear, square] = falloff.radial;
        let fades = match rule {
            FalloffRule::Square if [linear, square] == [0.0; 2] => true,
            _ => constant == 0.0 && linear == 0.0 && 0.0 < square,
        };
        let has_radiance = 0.0 < *radius && (self.scale == 1.0 || 0.0 < square);
        self.shadows == Shadows::Cast && (fades || has_radiance)
    }
}

/// The shape and position of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter {
    /// A point or a sphere.
    Point {
        /// Centre.
        position: DVec3,
        /// Radius; 0 for a point.
        radius: f64,
        /// Attenuation with distance and angle.
        falloff: Falloff,
    },
    /// Infinitely far away, in the direction of this unit vector.
    Distant(DVec3),
    /// Ambient light, from all directions.
    Ambient,
}

/// The falloff of a point light: 1 / (a0 + a1 d + a2 d²) at distance d, or none where that sum is
/// not positive; (cos α)^exponent at angle α from a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Falloff {
    /// The coefficients a0, a1, a2.
    pub radial: [f64; 3],
    /// The unit vector of a spot light's direction, and the exponent.
    pub spot: Option<(DVec3, f64)>,
}

impl Falloff {
    /// No falloff, in all directions.
    pub const NONE: Self = Self {
        radial: [1.0, 0.0, 0.0],
        spot: None,
    };
}

/// Whether objects cast shadows in a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadows {
    /// Objects block the light.
    Cast,
    /// Objects let the light pass.
    Off,
}
