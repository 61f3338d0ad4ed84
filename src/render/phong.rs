//! Light on a surface of `.ray` or `.dat`: Phong's model (Phong, "Illumination for Computer Generated
//! Pictures", 1975).

use super::lights;
use super::tracer::{Point, Tracer};
use crate::scene::{Light, Phong, Rgb};

impl Tracer<'_> {
    /// What a surface sends back of `ambient` light and that of all lights, in file order.
    pub(crate) fn light_on_phong(&mut self, point: &Point, material: &Phong, ambient: Rgb) -> Rgb {
        let world = self.world;
        let mut radiance = material.ambient * ambient;
        for light in &world.scene.lights {
            radiance += self.of_light(point, material, light);
        }
        radiance
    }

    fn of_light(&mut self, point: &Point, material: &Phong, light: &Light) -> Rgb {
        let Some(incoming) = lights::incoming(light, point.surface.point, None) else {
            return Rgb::ZERO;
        };
        let toward = incoming.toward;
        let cosine = point.normal.dot(toward);
        // It is NaN where the light stands at the point itself.
        if cosine <= 0.0 || cosine.is_nan() {
            return Rgb::ZERO;
        }
        let mirrored = 2.0 * cosine * point.normal - toward;
        let highlight = power(mirrored.dot(point.view), material.exponent);
        let reflected = material.diffuse * cosine + material.specular * highlight;
        if reflected == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let share = lights::share(light, point.surface.point, toward);
        if share == 0.0 {
            return Rgb::ZERO;
        }
        self.visibility(&point.surface, light, incoming) * (reflected * (share * light.colour))
    }
}

/// The power of a highlight: cosineⁿ, 0 for a negative cosine; 0⁰ = 1, and n < 0 reads as 0. Whole
/// exponents to 4096 go by repeated squaring, which is exact to a few ulp, the same on every
/// machine and ten times as fast as the general power.
pub(crate) fn power(cosine: f64, exponent: f64) -> f64 {
    if cosine < 0.0 {
        return 0.0;
    }
    let exponent = exponent.max(0.0);
    let whole = exponent as u32;
    if f64::from(whole) != exponent || 4096 < whole {
        return libm::pow(cosine, exponent);
    }
    let (mut power, mut square, mut rest) = (1.0, cosine, whole);
    while rest != 0 {
        if rest & 1 == 1 {
            power *= square;
        }
        square *= square;
        rest >>= 1;
    }
    power
}
