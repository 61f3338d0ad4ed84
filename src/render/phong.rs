//! Light on a surface of `.ray` or `.dat`: Phong's model (Phong, "Illumination for Computer Generated
//! Pictures", 1975).

use super::optics::power;
use crate::scene::{Phong, Rgb};

/// How much is sent back of light that comes at an angle of some cosine above 0, where a mirror would
/// send it at an angle of some cosine to the view.
#[inline]
pub(crate) fn reflected(material: &Phong, cosine: f64, mirrored: f64) -> Rgb {
    let highlight = power(mirrored, material.exponent);
    material.diffuse * cosine + material.specular * highlight
}
