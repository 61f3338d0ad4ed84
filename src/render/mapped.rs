//! Textures of `.xml`: colours at places that are seen through maps.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::texture::MAGENTA;
use crate::scene::{Image, Images, MappedPattern, MappedTexture, Rgb, Textured, Tinted};

/// The mapped textures of a scene, with their pictures.
#[derive(Clone, Debug, Default)]
pub(crate) struct MappedTextures(Vec<(DAffine3, Texels)>);

#[derive(Clone, Debug)]
enum Texels {
    Checkerboard([Tinted; 2]),
    Image(Arc<Image>),
    Missing,
}

impl MappedTextures {
    /// Makes textures ready; those whose picture is not among `images` are magenta.
    pub(crate) fn new(textures: &[MappedTexture], images: &Images) -> Self {
        let texels = |pattern: &MappedPattern| match pattern {
            MappedPattern::Checkerboard(colours) => Texels::Checkerboard(*colours),
            MappedPattern::Image(path) => {
                let image = images.get(path).cloned();
                image.map_or(Texels::Missing, Texels::Image)
            }
        };
        let ready = textures.iter();
        Self(
            ready
                .map(|texture| (texture.inverse, texels(&texture.pattern)))
                .collect(),
        )
    }

    /// A colour at a place of a surface. The textures of a checkerboard see the place as the
    /// checkerboard does.
    pub(crate) fn colour(&self, tinted: Tinted, mut place: DVec2) -> Rgb {
        let Tinted {
            mut colour,
            mut texture,
        } = tinted;
        while let Some(index) = texture {
            let Some((inverse, texels)) = self.0.get(index as usize) else {
                return colour * MAGENTA;
            };
            place = inverse.transform_point3(place.extend(0.0)).truncate();
            match texels {
                Texels::Image(image) => return colour * image.at(place.x, place.y),
                Texels::Missing => return colour * MAGENTA,
                Texels::Checkerboard([first, second]) => {
                    let low = place.map(|x| x - x.floor()).cmple(DVec2::splat(0.5));
                    let square = if low.x == low.y { first } else { second };
                    colour *= square.colour;
                    texture = square.texture;
                }
            }
        }
        colour
    }

    /// A number at a place of a surface.
    pub(crate) fn number(&self, textured: Textured, place: DVec2) -> f64 {
        let tinted = Tinted {
            colour: Rgb::ONE,
            texture: textured.texture,
        };
        match textured.texture {
            None => textured.value,
            Some(_) => textured.value * self.colour(tinted, place).x,
        }
    }
}

/// The place in an environment's picture that a unit direction looks at.
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
    use crate::scene::Size;

    const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);
    const BLUE: Rgb = Rgb::new(0.0, 0.0, 1.0);

    fn tinted(colour: Rgb, texture: Option<u32>) -> Tinted {
        Tinted { colour, texture }
    }

    fn board(colours: [Tinted; 2], inverse: DAffine3) -> MappedTexture {
        MappedTexture {
            inverse,
            pattern: MappedPattern::Checkerboard(colours),
        }
    }

    fn plain_board(inverse: DAffine3) -> MappedTexture {
        board([tinted(RED, None), tinted(BLUE, None)], inverse)
    }

    /// (u ≤ ½) = (v ≤ ½) of the fractional parts gives the first colour.
    #[test]
    fn squares_of_a_checkerboard() {
        let textures = MappedTextures::new(&[plain_board(DAffine3::IDENTITY)], &Images::default());
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

    /// Scaled by ½ it repeats twice; what is inside sees that, and its own map besides.
    #[test]
    fn maps_act_one_in_another() {
        let twice = DAffine3::from_scale(DVec3::new(0.5, 0.5, 1.0)).inverse();
        let moved = DAffine3::from_translation(DVec3::new(0.25, 0.0, 0.0)).inverse();
        let outer = board(
            [tinted(Rgb::splat(0.5), Some(1)), tinted(BLUE, None)],
            twice,
        );
        let textures = MappedTextures::new(&[outer, plain_board(moved)], &Images::default());
        for (u, v, colour) in [
            // Twice this is (.2, .2), within; and a quarter less is (−.05, .2).
            (0.1, 0.1, 0.5 * BLUE),
            // (.4, .2), and (.15, .2).
            (0.2, 0.1, 0.5 * RED),
            (0.3, 0.1, BLUE),
        ] {
            let seen = textures.colour(tinted(Rgb::ONE, Some(0)), DVec2::new(u, v));
            assert_eq!(seen, colour, "{u} {v}");
        }
    }

    /// One by two: red above blue. Texel centres are not shifted, the seam is half of each.
    #[test]
    fn pictures_repeat_and_are_interpolated() {
        let size = Size {
            width: 1,
            height: 2,
        };
        let image = Image::new(size, vec![[255, 0, 0], [0, 0, 255]]).expect("two pixels");
        let images = Images::from_iter([("a.ppm".to_owned(), Arc::new(image))]);
        let picture = |path: &str| MappedTexture {
            inverse: DAffine3::IDENTITY,
            pattern: MappedPattern::Image(path.to_owned()),
        };
        let textures = MappedTextures::new(&[picture("a.ppm"), picture("b.ppm")], &images);
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
        let number = |texture| Textured {
            value: 20.0,
            texture,
        };
        assert_eq!(textures.number(number(Some(0)), DVec2::ZERO), 20.0);
        assert_eq!(textures.number(number(Some(0)), DVec2::new(0.0, 0.5)), 0.0);
        assert_eq!(textures.number(number(None), DVec2::ZERO), 20.0);
    }

    /// By hand from the formula: up is the middle, straight down too; the horizon lies halfway out.
    #[test]
    fn directions_have_places_in_the_environment() {
        for (direction, place) in [
            (DVec3::Z, [0.5, 0.5]),
            (DVec3::NEG_Z, [0.5, 0.5]),
            (DVec3::X, [0.75, 0.75]),
            (DVec3::Y, [0.25, 0.75]),
            (DVec3::NEG_X, [0.25, 0.25]),
            (DVec3::NEG_Y, [0.75, 0.25]),
            // asin(.6) / π + ½ = 0.704833 down; x and y share the sum as 3 to 1.
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
