//! Textures on surfaces: the colour of a place, and the slope of what stands on it.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::geometry::Chart;
use crate::scene::{Image, Images, Pattern, Phong, Rgb, Texture};

/// What stands for a picture that can't be read.
pub(crate) const MAGENTA: Rgb = Rgb::new(1.0, 0.0, 1.0);

/// How bright a colour is (Rec. 709).
const LUMINANCE: Rgb = Rgb::new(0.2126, 0.7152, 0.0722);

/// The textures of a scene, with their pictures.
#[derive(Clone, Debug, Default)]
pub(crate) struct Textures(Vec<(DVec2, Texels)>);

#[derive(Clone, Debug)]
enum Texels {
    Checker([Rgb; 2]),
    Image(Arc<Image>),
    Missing,
}

impl Textures {
    /// Makes textures ready; those whose picture is not among `images` are magenta.
    pub(crate) fn new(textures: &[Texture], images: &Images) -> Self {
        let texels = |pattern: &Pattern| match pattern {
            Pattern::Checker(colours) => Texels::Checker(*colours),
            Pattern::Image(path) => {
                let image = images.get(path).cloned();
                image.map_or(Texels::Missing, Texels::Image)
            }
        };
        let ready = textures.iter();
        Self(
            ready
                .map(|texture| (texture.repeat, texels(&texture.pattern)))
                .collect(),
        )
    }

    /// Gives a material its colour at a place of a surface, and an outward unit normal its bumps.
    pub(crate) fn apply(&self, chart: &Chart, material: &mut Phong, normal: &mut DVec3) {
        if let Some(texture) = material.colour_texture {
            let colour = self.colour(texture, chart.uv);
            material.ambient *= colour;
            material.diffuse *= colour;
            material.specular *= colour;
        }
        if let Some((texture, height)) = material.bump {
            let slope = height * self.slope(texture, chart);
            let tangential = slope - slope.dot(*normal) * *normal;
            *normal = (*normal - tangential).normalize();
        }
    }

    fn colour(&self, texture: u32, uv: DVec2) -> Rgb {
        let Some((repeat, texels)) = self.0.get(texture as usize) else {
            return MAGENTA;
        };
        let place = *repeat * uv;
        match texels {
            Texels::Checker([first, second]) => {
                let cell = place.x.floor() + place.y.floor();
                if cell.rem_euclid(2.0) == 0.0 {
                    *first
                } else {
                    *second
                }
            }
            Texels::Image(image) => image.at(place.x, place.y),
            Texels::Missing => MAGENTA,
        }
    }

    /// How the brightness of a texture grows along the surface, by central differences of half a
    /// texel. A checker is flat.
    fn slope(&self, texture: u32, chart: &Chart) -> DVec3 {
        let Some((repeat, Texels::Image(image))) = self.0.get(texture as usize) else {
            return DVec3::ZERO;
        };
        let place = *repeat * chart.uv;
        let brightness = |place: DVec2| image.at(place.x, place.y).dot(LUMINANCE);
        let size = DVec2::new(image.size().width.into(), image.size().height.into());
        let half = 0.5 / size;
        let across = DVec2::new(half.x, 0.0);
        let down = DVec2::new(0.0, half.y);
        let grows = DVec2::new(
            (brightness(place + across) - brightness(place - across)) / (2.0 * half.x),
            (brightness(place + down) - brightness(place - down)) / (2.0 * half.y),
        );
        let [along_u, along_v] = chart.gradients;
        repeat.x * grows.x * along_u + repeat.y * grows.y * along_v
    }
}
