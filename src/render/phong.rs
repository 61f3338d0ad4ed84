//! Light on a surface of `.ray` or `.dat`: Phong's model (Phong, "Illumination for Computer Generated
//! Pictures", 1975).

use glam::DVec3;

use super::optics::power;
use super::probe::Point;
use crate::scene::{Phong, Rgb};

/// How much of the light that comes from the unit vector `toward`, at an angle of some cosine above
/// 0, is sent back.
#[inline]
pub(crate) fn reflected(material: &Phong, point: &Point, toward: DVec3, cosine: f64) -> Rgb {
    let mirrored = 2.0 * cosine * point.normal - toward;
    let highlight = power(mirrored.dot(point.view), material.exponent);
    material.diffuse * cosine + material.specular * highlight
}
