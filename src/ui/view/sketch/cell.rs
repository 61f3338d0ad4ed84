//! What a cell of a sketch shows.

use crate::app::CellImage;

/// What a cell shows.
pub(super) struct Cell {
    /// The mean colour of the object that covers most of it, and of the rest, if there is any.
    pub(super) colours: (Colour, Option<Colour>),
    /// Its quarters that the object touches, row by row from the lowest bit.
    pub(super) quarters: usize,
    pub(super) is_outlined: bool,
}

type Colour = [u8; 3];

impl Cell {
    /// The cell at a place; `None` beyond the picture.
    pub(super) fn at(shown: &CellImage, (column, row): (u16, u16)) -> Option<Self> {
        let mut pixels = [None; 8];
        for (at, pixel) in (0_u32..).zip(&mut pixels) {
            let x = u32::from(column) * 2 + at % 2;
            let y = u32::from(row) * 4 + at / 2;
            *pixel = index(shown, x, y);
        }
        let object = |at: usize| shown.objects.get(at);
        let known = || pixels.into_iter().flatten();
        let count = |at: usize| known().filter(|&other| object(other) == object(at)).count();
        let mut most = known().next()?;
        for at in known() {
            if count(most) < count(at) {
                most = at;
            }
        }
        let is_most = |&at: &usize| object(at) == object(most);
        let quarters = (0..)
            .zip(pixels)
            .filter(|(_, pixel)| pixel.as_ref().is_none_or(is_most))
            .fold(0, |quarters, (at, _): (usize, _)| {
                quarters | 1 << (at / 4 * 2 + at % 2)
            });
        let near = mean(shown, known().filter(is_most))?;
        let rest = mean(shown, known().filter(|at| !is_most(at)));
        Some(Self {
            colours: (near, rest),
            quarters,
            is_outlined: known().any(|at| shown.is_outlined(at)),
        })
    }
}

/// The index of a pixel, if it is inside the picture.
pub(super) fn index(shown: &CellImage, x: u32, y: u32) -> Option<usize> {
    let is_inside = x < shown.size.width && y < shown.size.height;
    is_inside.then_some(y as usize * shown.size.width as usize + x as usize)
}

fn mean(shown: &CellImage, pixels: impl Iterator<Item = usize>) -> Option<Colour> {
    let (mut sum, mut count) = ([0_u32; 3], 0);
    for at in pixels {
        for (sum, channel) in sum.iter_mut().zip(shown.pixels[at]) {
            *sum += u32::from(channel);
        }
        count += 1;
    }
    (0 < count).then(|| sum.map(|sum| (sum / count) as u8))
}
