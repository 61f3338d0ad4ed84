//! Evaluation of textures: colours at a point, mapped materials, and slopes of bump maps.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DAffine2, DAffine3, DMat2, DVec2, DVec3};

use geometry::Chart;
use scene::{
    Bump, Highlight, Image, Images, Maps, Material, Pattern, Rgb, Side, Size, Texture, Tinted,
};

/// Replaces images that cannot be read.
const MAGENTA: Rgb = Rgb::new(1.0, 0.0, 1.0);

/// Weights of luminance (Rec. 709).
pub(crate) const LUMINANCE: Rgb = Rgb::new(0.2126, 0.7152, 0.0722);

/// The textures of a scene with their images.
#[derive(Clone, Debug, Default)]
pub(crate) struct Textures(Vec<Ready>);

/// Maps uv to the coordinates of the pattern.
type Ready = (DAffine2, Texels);

#[derive(Clone, Debug)]
enum Texels {
    Checker([Tinted; 2], Side),
    Image(Arc<Image>),
    /// Not repeated.
    Clamped(Arc<Image>),
    Missing,
}

impl Textures {
    /// Prepares textures; images missing from `images` become magenta.
    pub(crate) fn new(textures: &[Texture], images: &Images) -> Self {
        let texels = |pattern: &Pattern| match pattern {
            Pattern::Checker { squares, side } => Texels::Checker(*squares, *side),
            Pattern::Image(path) => {
                let image = images.get(path).cloned();
                image.map_or(Texels::Missing, Texels::Image)
            }
            Pattern::Clamped(path) => {
                let image = images.get(path).cloned();
                image.map_or(Texels::Missing, Texels::Clamped)
            }
        };
        let ready = |texture: &Texture| {
            let DAffine3 {
                matrix3,
                translation,
            } = texture.inverse;
            let [u, v] = [matrix3.x_axis, matrix3.y_axis].map(DVec3::truncate);
            let inverse = DAffine2::from_cols(u, v, translation.truncate());
            (inverse, texels(&texture.pattern))
        };
        Self(textures.iter().map(ready).collect())
    }

    /// Whether these textures have the same images and patterns as others.
    pub(crate) fn are_those_of(&self, other: &Self) -> bool {
        let is_same = |((map, texels), (other_map, other)): (&Ready, &Ready)| {
            let is_same = match (texels, other) {
                (Texels::Checker(squares, side), Texels::Checker(others, other_side)) => {
                    squares == others && side == other_side
                }
                (Texels::Image(image), Texels::Image(other))
                | (Texels::Clamped(image), Texels::Clamped(other)) => Arc::ptr_eq(image, other),
                (Texels::Missing, Texels::Missing) => true,
                _ => false,
            };
            is_same && map == other_map
        };
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(is_same)
    }

    /// The size of the image that a colour is made of, if that fills the unit square.
    pub(crate) fn filling_image(&self, tinted: Tinted) -> Option<Size> {
        let (inverse, texels) = self.0.get(tinted.texture? as usize)?;
        match texels {
            Texels::Image(image) if *inverse == DAffine2::IDENTITY => Some(image.size()),
            _ => None,
        }
    }

    /// Applies maps to a material at uv; the result has no maps.
    pub(crate) fn applied(&self, maps: &Maps, material: &Material, place: DVec2) -> Material {
        let mut at = Samples {
            textures: self,
            place,
            last: None,
        };
        let mut material = Material {
            maps: None,
            ..*material
        };
        if let Some(ambient) = &mut material.ambient {
            at.tint(ambient, maps.ambient);
        }
        at.tint(&mut material.diffuse, maps.diffuse);
        match &mut material.highlight {
            Highlight::None => {}
            Highlight::Phong(gloss)
            | Highlight::ModifiedPhong(gloss)
            | Highlight::Blinn(gloss)
            | Highlight::PlainBlinn(gloss) => {
                at.tint(&mut gloss.specular, maps.specular);
                at.scale(&mut gloss.exponent, maps.exponent);
            }
            Highlight::Microfacet {
                roughness,
                metallic,
            } => {
                at.scale(roughness, maps.roughness);
                at.scale(metallic, maps.metallic);
            }
        }
        at.tint(&mut material.mirror.tint, maps.mirror);
        at.tint(&mut material.dielectric.tint, maps.dielectric);
        at.tint(&mut material.emission, maps.emission);
        material
    }

    /// Evaluates a texture at uv; `None` if it leads to another texture.
    fn sample(&self, texture: u32, place: DVec2) -> Option<Rgb> {
        let Some((inverse, texels)) = self.0.get(texture as usize) else {
            return Some(MAGENTA);
        };
        let place = inverse.transform_point2(place);
        match texels {
            Texels::Image(image) => Some(image.at(place.x, place.y)),
            Texels::Clamped(image) => Some(image.clamped_at(place.x, place.y)),
            Texels::Missing => Some(MAGENTA),
            Texels::Checker([first, second], side) => {
                let square = if is_first(*side, place) {
                    first
                } else {
                    second
                };
                square.texture.is_none().then_some(square.colour)
            }
        }
    }

    /// Evaluates a colour at uv. The textures of a checker are looked up at its own coordinates.
    pub(crate) fn colour(&self, tinted: Tinted, mut place: DVec2) -> Rgb {
        let Tinted {
            mut colour,
            mut texture,
        } = tinted;
        while let Some(index) = texture {
            let Some((inverse, texels)) = self.0.get(index as usize) else {
                return colour * MAGENTA;
            };
            place = inverse.transform_point2(place);
            match texels {
                Texels::Image(image) => return colour * image.at(place.x, place.y),
                Texels::Clamped(image) => return colour * image.clamped_at(place.x, place.y),
                Texels::Missing => return colour * MAGENTA,
                Texels::Checker([first, second], side) => {
                    let square = if is_first(*side, place) {
                        first
                    } else {
                        second
                    };
                    colour *= square.colour;
                    texture = square.texture;
                }
            }
        }
        colour
    }

    /// Returns the texture without an image that a texture's colour at uv comes from; `None` if it
    /// comes from none such.
    pub(crate) fn missing(&self, texture: u32, mut place: DVec2) -> Option<u32> {
        let mut texture = Some(texture);
        while let Some(index) = texture {
            let Some((inverse, texels)) = self.0.get(index as usize) else {
                return Some(index);
            };
            place = inverse.transform_point2(place);
            texture = match texels {
                Texels::Image(_) | Texels::Clamped(_) => None,
                Texels::Missing => return Some(index),
                Texels::Checker([first, second], side) => {
                    let square = if is_first(*side, place) {
                        first
                    } else {
                        second
                    };
                    square.texture
                }
            };
        }
        None
    }

    /// Perturbs an outward unit normal by a bump map.
    pub(crate) fn bumped(&self, bump: Bump, chart: &Chart, normal: DVec3) -> DVec3 {
        let slope = bump.height * self.slope(bump.texture, chart);
        let tangential = slope - slope.dot(normal) * normal;
        (normal - tangential).normalize()
    }

    /// The gradient of a texture's luminance along the surface, by central differences of half a
    /// texel. Zero for a checker.
    fn slope(&self, texture: u32, chart: &Chart) -> DVec3 {
        let Some((inverse, Texels::Image(image))) = self.0.get(texture as usize) else {
            return DVec3::ZERO;
        };
        let place = inverse.transform_point2(chart.uv);
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
        let DMat2 { x_axis, y_axis } = inverse.matrix2;
        x_axis.dot(grows) * along_u + y_axis.dot(grows) * along_v
    }
}

/// Samples of textures at one place. Slots often share a texture, which is then sampled once.
struct Samples<'t> {
    textures: &'t Textures,
    place: DVec2,
    /// The last texture and its sample; `None` if it leads to another texture.
    last: Option<(u32, Option<Rgb>)>,
}

impl Samples<'_> {
    /// Multiplies a colour by that of a texture.
    fn tint(&mut self, colour: &mut Rgb, texture: Option<u32>) {
        let Some(index) = texture else {
            return;
        };
        let sample = match self.last {
            Some((last, sample)) if last == index => sample,
            _ => self.textures.sample(index, self.place),
        };
        self.last = Some((index, sample));
        *colour = if let Some(sample) = sample {
            *colour * sample
        } else {
            // Nested colours are multiplied from the outside in, which rounds differently.
            let colour = *colour;
            self.textures.colour(Tinted { colour, texture }, self.place)
        };
    }

    /// Multiplies a number by the red channel of a texture.
    fn scale(&mut self, number: &mut f64, texture: Option<u32>) {
        if texture.is_some() {
            let mut colour = Rgb::ONE;
            self.tint(&mut colour, texture);
            *number *= colour.x;
        }
    }
}

/// Whether a point lies in the first kind of square.
fn is_first(side: Side, place: DVec2) -> bool {
    match side {
        Side::One => (place.x.floor() + place.y.floor()).rem_euclid(2.0) == 0.0,
        Side::Half => {
            let low = place.map(|x| x - x.floor()).cmple(DVec2::splat(0.5));
            low.x == low.y
        }
    }
}

/// Maps a unit direction to uv in an environment image.
pub(crate) fn environment_place(direction: DVec3) -> DVec2 {
    let DVec3 { x, y, z } = direction;
    let sum = x.abs() + y.abs();
    let (x, y) = if sum == 0.0 {
        (0.0, 0.0)
    } else {
        (x / sum, y / sum)
    };
    let down = libm::asin(-z.clamp(-1.0, 1.0)) / PI + 0.5;
    DVec2::splat(0.5) + down * (x * DVec2::new(0.5, 0.5) + y * DVec2::new(-0.5, 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Gloss;

    const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);
    const BLUE: Rgb = Rgb::new(0.0, 0.0, 1.0);

    fn tinted(colour: Rgb, texture: Option<u32>) -> Tinted {
        Tinted { colour, texture }
    }

    fn board(colours: [Tinted; 2], inverse: DAffine3) -> Texture {
        Texture {
            inverse,
            pattern: Pattern::Checker {
                squares: colours,
                side: Side::Half,
            },
        }
    }

    fn plain_board(inverse: DAffine3) -> Texture {
        board([tinted(RED, None), tinted(BLUE, None)], inverse)
    }

    /// The first colour is where (u ≤ ½) = (v ≤ ½) for the fractional parts.
    #[test]
    fn squares_of_a_checkerboard() {
        let textures = Textures::new(&[plain_board(DAffine3::IDENTITY)], &Images::default());
        for (u, v, colour) in [
            (0.0, 0.0, RED),
            (0.5, 0.5, RED),
            (0.500_001, 0.5, BLUE),
            (0.25, 0.75, BLUE),
            (0.75, 0.75, RED),
            (1.0, 0.75, BLUE),
            (-0.25, 0.25, BLUE),
            (-0.25, -0.25, RED),
            (7.75, -3.75, BLUE),
        ] {
            let seen = textures.colour(tinted(Rgb::ONE, Some(0)), DVec2::new(u, v));
            assert_eq!(seen, colour, "{u} {v}");
        }
    }

    /// A scale of ½ repeats twice; nested textures start from these coordinates.
    #[test]
    fn nested_textures_apply_their_own_maps() {
        let twice = DAffine3::from_scale(DVec3::new(0.5, 0.5, 1.0)).inverse();
        let moved = DAffine3::from_translation(DVec3::new(0.25, 0.0, 0.0)).inverse();
        let outer = board(
            [tinted(Rgb::splat(0.5), Some(1)), tinted(BLUE, None)],
            twice,
        );
        let textures = Textures::new(&[outer, plain_board(moved)], &Images::default());
        for (u, v, colour) in [
            // Doubled, this is (.2, .2), in the first square; a quarter less is (−.05, .2).
            (0.1, 0.1, 0.5 * BLUE),
            // (.4, .2), and (.15, .2).
            (0.2, 0.1, 0.5 * RED),
            (0.3, 0.1, BLUE),
        ] {
            let seen = textures.colour(tinted(Rgb::ONE, Some(0)), DVec2::new(u, v));
            assert_eq!(seen, colour, "{u} {v}");
        }
    }

    /// 1×2 pixels: red above blue. Texel centres are not offset; at the seam both count half.
    #[test]
    fn images_repeat_and_are_interpolated() {
        let size = Size {
            width: 1,
            height: 2,
        };
        let image = Image::new(size, vec![[255, 0, 0], [0, 0, 255]]).expect("two pixels");
        let images = Images::from_iter([("a.ppm".to_owned(), Arc::new(image))]);
        let picture = |path: &str| Texture {
            inverse: DAffine3::IDENTITY,
            pattern: Pattern::Image(path.to_owned()),
        };
        let textures = Textures::new(&[picture("a.ppm"), picture("b.ppm")], &images);
        let white = |texture| tinted(Rgb::splat(0.5), Some(texture));
        for (v, colour) in [
            (0.0, 0.5 * RED),
            (0.5, 0.5 * BLUE),
            (0.25, 0.25 * (RED + BLUE)),
            (0.75, 0.25 * (RED + BLUE)),
            (-0.5, 0.5 * BLUE),
            (1.0, 0.5 * RED),
        ] {
            let seen = textures.colour(white(0), DVec2::new(0.3, v));
            assert_eq!(seen, colour, "{v}");
        }
        assert_eq!(textures.colour(white(1), DVec2::ZERO), 0.5 * MAGENTA);
        let material = Material {
            highlight: Highlight::Blinn(Gloss {
                specular: Rgb::ONE,
                exponent: 20.0,
            }),
            ..Material::BLACK
        };
        for (exponent, place, expected) in [
            (Some(0), DVec2::ZERO, 20.0),
            (Some(0), DVec2::new(0.0, 0.5), 0.0),
            (None, DVec2::ZERO, 20.0),
        ] {
            let maps = Maps {
                exponent,
                ..Maps::default()
            };
            let expected = Gloss {
                specular: Rgb::ONE,
                exponent: expected,
            };
            let found = textures.applied(&maps, &material, place).highlight;
            assert_eq!(found, Highlight::Blinn(expected));
        }
    }

    /// By hand from the formula: up maps to the middle, as does down; the horizon lies halfway out.
    #[test]
    fn directions_map_to_the_environment() {
        for (direction, place) in [
            (DVec3::Z, [0.5, 0.5]),
            (DVec3::NEG_Z, [0.5, 0.5]),
            (DVec3::X, [0.75, 0.75]),
            (DVec3::Y, [0.25, 0.75]),
            (DVec3::NEG_X, [0.25, 0.25]),
            (DVec3::NEG_Y, [0.75, 0.25]),
            // asin(.6) / π + ½ = 0.704833 down; x and y divide the sum 3 to 1.
            (
                DVec3::new(0.758_946_6, 0.252_982_2, -0.6),
                [0.676_208_2, 0.852_416_4],
            ),
        ] {
            let found = environment_place(direction);
            assert!(
                (found - DVec2::from(place)).length() < 1e-6,
                "{direction}: {found}"
            );
        }
    }
}
