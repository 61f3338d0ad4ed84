//! Textures, and the pictures they show, as values.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use glam::DVec2;

use super::{Rgb, Size};

/// A colour at every place uv of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// How often it repeats over the unit square of uv.
    pub repeat: DVec2,
    /// What is repeated.
    pub pattern: Pattern,
}

/// What a texture repeats.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Squares in two colours, one repetition each: the first at uv 0, 0.
    Checker([Rgb; 2]),
    /// A picture, by its path as the text says it.
    Image(String),
}

/// A picture in memory: red, green, blue of each pixel, row by row from the top left.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    size: Size,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    /// A picture of some size; `None` unless there are as many pixels.
    pub fn new(size: Size, pixels: Vec<[u8; 3]>) -> Option<Self> {
        (0 < size.pixels() && size.pixels() == pixels.len()).then_some(Self { size, pixels })
    }

    /// Its size.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Red, green, blue of each pixel, row by row from the top left.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// The colour at a place, interpolated between the four pixels around it: u goes across and v
    /// down, 1 over the whole picture, which repeats; a pixel's own colour is at its upper left
    /// corner. Each channel is its byte over 255.
    pub fn at(&self, u: f64, v: f64) -> Rgb {
        let (left, right, x) = between(u, self.size.width);
        let (top, bottom, y) = between(v, self.size.height);
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

/// The two neighbours of a place among `count` that repeat, and how far it is from the first to the
/// second. A place that is not a number is 0.
fn between(place: f64, count: u32) -> (u32, u32, f64) {
    let place = (place - place.floor()) * f64::from(count);
    let place = if place.is_finite() { place } else { 0.0 };
    let first = place.floor();
    let index = first as u32 % count;
    (index, (index + 1) % count, place - first)
}

/// The pictures of a scene's textures, by the paths that its text says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images(Arc<HashMap<String, Arc<Image>>>);

impl Images {
    /// The picture of a path, if it is there.
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

    /// Two by two: black, red; green, blue.
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
    fn a_picture_has_all_its_pixels() {
        let size = Size {
            width: 2,
            height: 1,
        };
        assert_eq!(Image::new(size, vec![[0; 3]]), None);
    }
}
