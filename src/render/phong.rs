//! Light on a surface of `.ray` or `.dat`: Phong's model (Phong, "Illumination for Computer Generated
//! Pictures", 1975).

use super::optics::power;
use super::tracer::{Point, Tracer};
use crate::scene::{Phong, Rgb};

impl<C: Fn() -> bool> Tracer<'_, C> {
    /// What a surface sends back of `ambient` light and that of all lights, in file order.
    pub(crate) fn light_on_phong(&mut self, point: &Point, material: &Phong, ambient: Rgb) -> Rgb {
        let world = self.world;
        let mut radiance = material.ambient * ambient;
        for (number, light) in world.scene.lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            radiance += self.direct(point, light, None, |toward, cosine| {
                let mirrored = 2.0 * cosine * point.normal - toward;
                let highlight = power(mirrored.dot(point.view), material.exponent);
                material.diffuse * cosine + material.specular * highlight
            });
        }
        radiance
    }
}
