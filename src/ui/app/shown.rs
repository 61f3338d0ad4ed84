//! Pixels on screen.

use std::ops::Range;

use super::sight::Part;
use crate::render::NO_OBJECT;
use crate::scene::Size;

/// Pixels as shown on screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Size in pixels.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
    /// The object under each pixel, or [`NO_OBJECT`].
    pub objects: Vec<u32>,
    /// Whether each pixel is on the outline of the selected object; empty without an outline.
    pub outline: Vec<bool>,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            size: Size {
                width: 0,
                height: 0,
            },
            pixels: Vec::new(),
            objects: Vec::new(),
            outline: Vec::new(),
        }
    }
}

impl Shown {
    /// Returns the object under a pixel.
    pub fn object_at(&self, x: u32, y: u32) -> Option<u32> {
        if self.size.width <= x {
            return None;
        }
        let at = y as usize * self.size.width as usize + x as usize;
        let object = self.objects.get(at).copied()?;
        (object != NO_OBJECT).then_some(object)
    }

    /// Whether the pixel with this index is on the outline.
    pub fn is_outlined(&self, at: usize) -> bool {
        self.outline.get(at) == Some(&true)
    }

    /// Computes the outline of objects, ascending: their pixels that border on others. The edge of
    /// the picture does not count as a border, so that an object extending beyond it is not framed
    /// there.
    pub(super) fn outline_of(&self, objects: &[u32]) -> Vec<bool> {
        let Size { width, height } = self.size;
        let is_object = |x: u32, y: u32| {
            let inside = x < width && y < height;
            let at = y as usize * width as usize + x as usize;
            let is_outlined = |object: &u32| objects.binary_search(object).is_ok();
            !inside || self.objects.get(at).is_some_and(is_outlined)
        };
        let is_border = |x: u32, y: u32| {
            let neighbours = [
                (x.wrapping_sub(1), y),
                (x + 1, y),
                (x, y.wrapping_sub(1)),
                (x, y + 1),
            ];
            is_object(x, y) && !neighbours.iter().all(|&(x, y)| is_object(x, y))
        };
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| is_border(x, y))
            .collect()
    }

    /// Resamples the picture, without its outline.
    #[must_use]
    pub fn resampled(&self, size: Size) -> Self {
        let whole = Part {
            left: 0,
            top: 0,
            size: self.size,
        };
        Self::of((&self.pixels, &self.objects), self.size, whole, size)
    }

    /// Resamples a part of a picture of size `from`, given the colours of its pixels and the
    /// objects under them, to size `to`: averages when shrinking, repeats the nearest pixels when
    /// enlarging.
    pub(super) fn of(
        (pixels, objects): (&[[u8; 3]], &[u32]),
        from: Size,
        part: Part,
        to: Size,
    ) -> Self {
        if from == to && part.size == from || part.size.pixels() == 0 {
            return Self {
                size: from,
                pixels: pixels.to_vec(),
                objects: objects.to_vec(),
                outline: Vec::new(),
            };
        }
        let width = from.width as usize;
        let mut shown = Self {
            size: to,
            pixels: Vec::with_capacity(to.pixels()),
            objects: Vec::with_capacity(to.pixels()),
            outline: Vec::new(),
        };
        for y in 0..to.height {
            let rows = covered(y, to.height, part.top, part.size.height);
            for x in 0..to.width {
                let columns = covered(x, to.width, part.left, part.size.width);
                let mut sum = [0u64; 3];
                for row in rows.clone() {
                    for pixel in &pixels[row * width + columns.start..row * width + columns.end] {
                        for (sum, channel) in sum.iter_mut().zip(pixel) {
                            *sum += u64::from(*channel);
                        }
                    }
                }
                let count = (rows.len() * columns.len()) as u64;
                shown
                    .pixels
                    .push(sum.map(|sum| ((sum + count / 2) / count) as u8));
                let middle = |range: &Range<usize>| range.start + range.len() / 2;
                shown
                    .objects
                    .push(objects[middle(&rows) * width + middle(&columns)]);
            }
        }
        shown
    }
}

/// The pixels that pixel `at` of `to` covers, at least one, where all cover `length` from `start`.
fn covered(at: u32, to: u32, start: u32, length: u32) -> Range<usize> {
    let scaled = |at: u32| (u64::from(at) * u64::from(length) / u64::from(to)) as usize;
    let (first, end) = (scaled(at), scaled(at + 1));
    start as usize + first..start as usize + end.max(first + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    #[test]
    fn shrinking_averages_and_enlarging_repeats_pixels() {
        let shown = Shown {
            size: size(2, 2),
            pixels: vec![[0, 0, 0], [100, 0, 0], [0, 50, 0], [101, 51, 8]],
            objects: vec![1, 2, 3, 4],
            outline: Vec::new(),
        };
        let one = shown.resampled(size(1, 1));
        // 201/4, 101/4 and 8/4, rounded.
        assert_eq!(one.pixels, [[50, 25, 2]]);
        let four = shown.resampled(size(4, 4));
        assert_eq!(four.objects[..8], [1, 1, 2, 2, 1, 1, 2, 2]);
        assert_eq!(four.resampled(size(2, 2)), shown);
        assert_eq!(shown.resampled(size(2, 2)), shown);
    }

    #[test]
    fn a_part_fills_the_screen() {
        let pixels: Vec<_> = (0..12).map(|at| [at; 3]).collect();
        let objects: Vec<_> = (0..12).collect();
        let part = Part {
            left: 1,
            top: 1,
            size: size(2, 2),
        };
        let seen = |to| Shown::of((&pixels, &objects), size(4, 3), part, to).objects;
        assert_eq!(seen(size(2, 2)), [5, 6, 9, 10]);
        assert_eq!(seen(size(4, 2)), [5, 5, 6, 6, 9, 9, 10, 10]);
        assert_eq!(seen(size(1, 1)), [10]);
    }
}
