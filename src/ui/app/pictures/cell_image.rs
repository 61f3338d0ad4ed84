//! Pixels on screen.

use std::ops::Range;

use super::frame_window::{Extent, FrameWindow, Marked, Reason, Window};
use render::{Frame, NO_OBJECT, Region};
use scene::Size;

/// Pixels as shown on screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellImage {
    /// Size in pixels.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
    /// The object under each pixel, or [`NO_OBJECT`].
    pub objects: Vec<u32>,
    /// Whether each pixel is on the outline of the selected object; empty without an outline.
    pub outline: Vec<bool>,
}

impl Default for CellImage {
    fn default() -> Self {
        Self::black(Size {
            width: 0,
            height: 0,
        })
    }
}

impl CellImage {
    /// A black picture without objects.
    pub(crate) fn black(size: Size) -> Self {
        Self {
            size,
            pixels: vec![[0; 3]; size.pixels()],
            objects: vec![NO_OBJECT; size.pixels()],
            outline: Vec::new(),
        }
    }

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
    pub(crate) fn outline_of(&self, objects: &[u32]) -> Vec<bool> {
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
        let layer = Layer {
            colours: &self.pixels,
            objects: &self.objects,
            part: Region::whole(self.size),
            whole: self.size,
        };
        Self::seen(&[layer], &FrameWindow::whole(size))
    }

    /// The picture as it is seen: from the first of the layers that has what a pixel shows; black
    /// outside all of them. Averages when shrinking, repeats the nearest pixels when enlarging. A
    /// marked region has a dim border.
    pub(crate) fn seen(layers: &[Layer<'_>], frame_window: &FrameWindow) -> Self {
        let to = frame_window.size;
        let Some(first) = layers.first() else {
            return Self::default();
        };
        let size = first.part.size();
        let is_plain = frame_window.window.is_none() && frame_window.marked.is_none();
        if size.pixels() == 0 || is_plain && size == first.whole && size == to {
            return Self {
                size,
                pixels: first.colours.to_vec(),
                objects: first.objects.to_vec(),
                outline: Vec::new(),
            };
        }
        let window = frame_window.window_of(first.whole);
        let placed: Vec<_> = layers
            .iter()
            .map(|layer| (layer, covered(window, to, layer.whole, layer.part)))
            .collect();
        let mut shown = Self::black(to);
        for y in 0..to.height as usize {
            for x in 0..to.width as usize {
                let mut known = placed.iter().filter_map(|(layer, [columns, rows])| {
                    Some(layer.mean(columns[x].clone()?, rows[y].clone()?))
                });
                if let Some((colour, object)) = known.next() {
                    let at = y * to.width as usize + x;
                    (shown.pixels[at], shown.objects[at]) = (colour, object);
                }
            }
        }
        for at in border(frame_window, Reason::Traced) {
            shown.pixels[at] = shown.pixels[at].map(|channel| channel / 2 + 64);
        }
        shown
    }
}

/// A frame to see, or what another frame leaves to see.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layer<'f> {
    /// The colours of its pixels.
    pub(crate) colours: &'f [[u8; 3]],
    /// The objects under its pixels.
    pub(crate) objects: &'f [u32],
    /// The part of the whole picture that it has.
    pub(crate) part: Region,
    /// The size of the whole picture.
    pub(crate) whole: Size,
}

impl<'f> Layer<'f> {
    /// A frame in these colours.
    pub(crate) fn of(frame: &'f Frame, colours: &'f [[u8; 3]]) -> Self {
        let ([x, y], Size { width, height }) = (frame.corner, frame.size);
        Self {
            colours,
            objects: &frame.objects,
            part: Region {
                x,
                y,
                width,
                height,
            },
            whole: frame.whole(),
        }
    }

    /// The mean colour of some pixels, and the object in their middle.
    fn mean(&self, columns: Range<usize>, rows: Range<usize>) -> ([u8; 3], u32) {
        let width = self.part.width as usize;
        let mut sum = [0u64; 3];
        for row in rows.clone() {
            for pixel in &self.colours[row * width + columns.start..row * width + columns.end] {
                for (sum, channel) in sum.iter_mut().zip(pixel) {
                    *sum += u64::from(*channel);
                }
            }
        }
        let count = (rows.len() * columns.len()) as u64;
        let object = self.objects[middle(&rows) * width + middle(&columns)];
        (sum.map(|sum| ((sum + count / 2) / count) as u8), object)
    }
}

/// The indices of the pixels on screen around the region, if one is marked for this reason.
pub(crate) fn border(frame_window: &FrameWindow, reason: Reason) -> Vec<usize> {
    let marked = frame_window.marked.filter(|marked| marked.reason == reason);
    let Some(Marked { whole, region, .. }) = marked else {
        return Vec::new();
    };
    let Size { width, height } = frame_window.size;
    let window = frame_window.window_of(whole);
    let [across, down] = covered(window, frame_window.size, whole, region);
    let near = |covered: &[Option<_>], at: usize| {
        let beside = at.saturating_sub(1)..covered.len().min(at + 2);
        covered[beside].iter().any(Option::is_some)
    };
    let is_inside = |x: usize, y: usize| across[x].is_some() && down[y].is_some();
    let is_border =
        |&(x, y): &(usize, usize)| near(&across, x) && near(&down, y) && !is_inside(x, y);
    (0..height as usize)
        .flat_map(|y| (0..width as usize).map(move |x| (x, y)))
        .filter(is_border)
        .map(|(x, y)| y * width as usize + x)
        .collect()
}

/// Of a part of a picture, from its corner, the columns that each pixel in a row on screen covers and the
/// rows that each pixel in a column covers, if it covers any. The screen has the size `to` and the whole
/// picture the size `whole`.
fn covered(window: Window, to: Size, whole: Size, part: Region) -> [Vec<Option<Range<usize>>>; 2] {
    let [columns, rows] = window.extents();
    let along = |shown: u32, extent: Extent, whole: u32, own: (u32, u32)| {
        let scale = (extent.whole, whole);
        let covered = (0..shown).map(|at| scaled(extent.covered(at)?, scale, own));
        covered.collect()
    };
    [
        along(to.width, columns, whole.width, (part.x, part.width)),
        along(to.height, rows, whole.height, (part.y, part.height)),
    ]
}

/// A range of pixels in a picture of another length, from the start of a part of that; `None` if its
/// middle is outside the part.
fn scaled(
    range: Range<usize>,
    (from, to): (u32, u32),
    (start, length): (u32, u32),
) -> Option<Range<usize>> {
    let (start, end) = (start as usize, start as usize + length as usize);
    let range = if from == to {
        range
    } else {
        let scaled = |at: usize| (at as u64 * u64::from(to) / u64::from(from.max(1))) as usize;
        let first = scaled(range.start);
        first..scaled(range.end).max(first + 1)
    };
    (start..end).contains(&middle(&range)).then(|| {
        let first = range.start.max(start);
        first - start..range.end.min(end) - start
    })
}

fn middle(range: &Range<usize>) -> usize {
    range.start + range.len() / 2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    #[test]
    fn shrinking_averages_and_enlarging_repeats_pixels() {
        let shown = CellImage {
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

    /// Pixels numbered row by row.
    fn numbers(count: u32) -> (Vec<[u8; 3]>, Vec<u32>) {
        let colours = (0..count).map(|at| [at as u8; 3]).collect();
        (colours, (0..count).collect())
    }

    fn window(whole: Size, part: &str, fills: Size) -> Window {
        Window {
            whole,
            part: Region::parse(part).expect("a region"),
            fills,
        }
    }

    #[test]
    fn a_part_fills_the_screen() {
        let (colours, objects) = numbers(12);
        let whole = size(4, 3);
        let layer = Layer {
            colours: &colours,
            objects: &objects,
            part: Region::whole(whole),
            whole,
        };
        let seen = |to, window| {
            let frame_window = FrameWindow {
                window: Some(window),
                ..FrameWindow::whole(to)
            };
            CellImage::seen(&[layer], &frame_window).objects
        };
        let part = |fills| window(whole, "1,1,2,2", fills);
        assert_eq!(seen(size(2, 2), part(size(2, 2))), [5, 6, 9, 10]);
        assert_eq!(
            seen(size(4, 2), part(size(4, 2))),
            [5, 5, 6, 6, 9, 9, 10, 10]
        );
        assert_eq!(seen(size(1, 1), part(size(1, 1))), [10]);
        // Blocks that do not fit are cut off, and what is beyond the picture is black.
        assert_eq!(seen(size(3, 2), part(size(4, 4))), [5, 5, 6, 5, 5, 6]);
        let none = NO_OBJECT;
        assert_eq!(
            seen(size(3, 2), part(size(2, 2))),
            [5, 6, none, 9, 10, none]
        );
    }

    /// A region, over another frame of a smaller picture.
    #[test]
    fn what_a_layer_lacks_is_seen_in_the_next() {
        let (colours, objects) = numbers(4);
        let region = Layer {
            colours: &colours,
            objects: &objects,
            part: Region::parse("2,0,2,2").expect("a region"),
            whole: size(4, 4),
        };
        let under = Layer {
            part: Region::whole(size(2, 2)),
            whole: size(2, 2),
            objects: &[6, 7, 8, 9],
            ..region
        };
        let frame_window = FrameWindow::whole(size(4, 4));
        let seen = CellImage::seen(&[region, under], &frame_window);
        let rows: Vec<_> = seen.objects.chunks(4).collect();
        assert_eq!(
            rows,
            [[6, 6, 0, 1], [6, 6, 2, 3], [8, 8, 9, 9], [8, 8, 9, 9]]
        );
        let marked = Marked {
            whole: size(4, 4),
            region: region.part,
            reason: Reason::Traced,
        };
        let frame_window = FrameWindow {
            marked: Some(marked),
            ..frame_window
        };
        let border = border(&frame_window, Reason::Traced);
        assert_eq!(border, [1, 5, 9, 10, 11]);
    }
}
