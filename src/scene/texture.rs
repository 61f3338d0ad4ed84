//! Textures and their images, as values.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use glam::{DAffine3, DVec2};

use super::{Rgb, Size};

/// A colour, optionally multiplied by a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tinted {
    /// The colour or factor.
    pub colour: Rgb,
    /// Index in [`super::Scene::textures`].
    pub texture: Option<u32>,
}

/// A colour for each point uv of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Maps (u, v, 0) to pattern coordinates.
    pub inverse: DAffine3,
    /// The pattern.
    pub pattern: Pattern,
}

impl Texture {
    /// A pattern repeated this many times along u and v of the unit square.
    pub fn repeated(repeat: DVec2, pattern: Pattern) -> Self {
        Self {
            inverse: DAffine3::from_scale(repeat.extend(1.0)),
            pattern,
        }
    }
}

/// The pattern of a texture.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Alternating squares, the first at (0, 0). Their textures come later in
    /// [`super::Scene::textures`] and are looked up at the pattern's own coordinates.
    Checker {
        /// The colours of the two kinds of squares.
        squares: [Tinted; 2],
        /// Edge length.
        side: Side,
    },
    /// An image, by its path as written in the text; fills the unit square and repeats.
    Image(String),
    /// The same, but beyond the unit square its edge goes on.
    Clamped(String),
}

/// The edge length of a checker's squares, and which square its lines belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// 1: the first square where ⌊u⌋ + ⌊v⌋ is even.
    One,
    /// ½: the first square where the fractional parts of both or neither of u and v are at most ½.
    Half,
}

/// A decoded image: red, green, blue of each pixel, in rows from the top left.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    size: Size,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    /// Creates an image; `None` if the size is empty or does not match the number of pixels.
    pub fn new(size: Size, pixels: Vec<[u8; 3]>) -> Option<Self> {
        (0 < size.pixels() && size.pixels() == pixels.len()).then_some(Self { size, pixels })
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Red, green, blue of each pixel, in rows from the top left.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// The bilinearly interpolated colour at (u, v): u to the right, v down, 1 for the whole image,
    /// which repeats. A pixel's own colour is at its upper left corner. Channels are bytes / 255.
    pub fn at(&self, u: f64, v: f64) -> Rgb {
        let Size { width, height } = self.size;
        self.mixed(between(u, width), between(v, height))
    }

    /// The same, but beyond the image, and between the middle of its last pixels and its end, the
    /// colour of its edge.
    pub fn clamped_at(&self, u: f64, v: f64) -> Rgb {
        let Size { width, height } = self.size;
        self.mixed(among(u, width), among(v, height))
    }

    /// The colour between four pixels, by the neighbours in a row and in a column and the offset
    /// between them.
    fn mixed(&self, (left, right, x): (u32, u32, f64), (top, bottom, y): (u32, u32, f64)) -> Rgb {
        let pixel = |column: u32, row: u32| {
            let at = row as usize * self.size.width as usize + column as usize;
            Rgb::from_array(self.pixels[at].map(f64::from)) / 255.0
        };
        let across = |row| pixel(left, row) * (1.0 - x) + pixel(right, row) * x;
        across(top) * (1.0 - y) + across(bottom) * y
    }
}

impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Size { width, height } = self.size;
        write!(f, "Image({width}×{height})")
    }
}

/// The two neighbours of a coordinate among `count` that repeat, and its offset between them, 0 to
/// 1. A coordinate that is not finite counts as 0.
fn between(place: f64, count: u32) -> (u32, u32, f64) {
    let place = (place - place.floor()) * f64::from(count);
    let place = if place.is_finite() { place } else { 0.0 };
    let first = place.floor();
    let index = first as u32 % count;
    (index, (index + 1) % count, place - first)
}

/// The two neighbours of a coordinate among `count` that end, and its offset between them, 0 to 1. A
/// coordinate that is not a number counts as 0.
fn among(place: f64, count: u32) -> (u32, u32, f64) {
    let last = count - 1;
    let place = (place * f64::from(count)).clamp(0.0, f64::from(last));
    let place = if place.is_finite() { place } else { 0.0 };
    let first = place.floor();
    let index = first as u32;
    (index, last.min(index + 1), place - first)
}

/// The images of a scene's textures, by their paths as written in the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images(Arc<HashMap<String, Arc<Image>>>);

impl Images {
    /// Returns the image at a path, if it has been read.
    pub fn get(&self, path: &str) -> Option<&Arc<Image>> {
        self.0.get(path)
    }
}

impl FromIterator<(String, Arc<Image>)> for Images {
    fn from_iter<I: IntoIterator<Item = (String, Arc<Image>)>>(images: I) -> Self {
        Self(Arc::new(images.into_iter().collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2×2 pixels: black, red; green, blue.
    fn image() -> Image {
        let size = Size {
            width: 2,
            height: 2,
        };
        let pixels = vec![[0, 0, 0], [255, 0, 0], [0, 255, 0], [0, 0, 255]];
        Image::new(size, pixels).expect("as many pixels as the size says")
    }

    #[test]
    fn colours_are_interpolated_and_repeat() {
        for (u, v, colour) in [
            (0.0, 0.0, [0.0, 0.0, 0.0]),
            (0.5, 0.0, [1.0, 0.0, 0.0]),
            (0.0, 0.5, [0.0, 1.0, 0.0]),
            (0.25, 0.0, [0.5, 0.0, 0.0]),
            (0.75, 0.0, [0.5, 0.0, 0.0]),
            (0.25, 0.25, [0.25, 0.25, 0.25]),
            (1.5, -1.0, [1.0, 0.0, 0.0]),
            (-0.5, 7.0, [1.0, 0.0, 0.0]),
            (f64::NAN, f64::INFINITY, [0.0, 0.0, 0.0]),
        ] {
            assert_eq!(image().at(u, v), Rgb::from_array(colour), "{u} {v}");
        }
    }

    #[test]
    fn the_edge_of_a_clamped_image_goes_on() {
        for (u, v, colour) in [
            (0.0, 0.0, [0.0, 0.0, 0.0]),
            (0.25, 0.0, [0.5, 0.0, 0.0]),
            (0.5, 0.0, [1.0, 0.0, 0.0]),
            (0.75, 0.0, [1.0, 0.0, 0.0]),
            (9.0, -1.0, [1.0, 0.0, 0.0]),
            (-9.0, f64::INFINITY, [0.0, 1.0, 0.0]),
            (1.0, 0.25, [0.5, 0.0, 0.5]),
            (f64::NAN, 0.0, [0.0, 0.0, 0.0]),
        ] {
            let seen = image().clamped_at(u, v);
            assert_eq!(seen, Rgb::from_array(colour), "{u} {v}");
        }
    }

    #[test]
    fn an_image_needs_as_many_pixels_as_its_size() {
        let size = Size {
            width: 2,
            height: 1,
        };
        assert_eq!(Image::new(size, vec![[0; 3]]), None);
    }
}
