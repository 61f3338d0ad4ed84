//! What a cell of a sketch shows.

use crate::app::CellImage;
use crate::view::oklab::luma;

/// The difference in luma of a cell's quarters from which they are two areas, such as tiles.
const CONTRAST: f32 = 60.0;

/// The indices of a cell's pixels, row by row; `None` beyond the picture.
type Pixels = [Option<usize>; 8];

type Colour = [u8; 3];

/// What a cell shows.
pub(super) struct Cell {
    /// The mean colour of the object that covers most of it.
    pub(super) colour: Colour,
    /// Where it shows two areas.
    pub(super) areas: Option<Areas>,
    pub(super) is_outlined: bool,
}

/// Two areas of a cell.
#[derive(Clone, Copy)]
pub(super) struct Areas {
    /// The mean colours of both.
    pub(super) colours: [Colour; 2],
    /// The quarters of the first, row by row from the lowest bit.
    pub(super) quarters: usize,
}

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
        let is_most = |at: usize| object(at) == object(most);
        let colour = mean(shown, known().filter(|&at| is_most(at)))?;
        let areas = if known().all(is_most) {
            by_brightness(shown, &pixels)
        } else {
            areas(shown, &pixels, is_most)
        };
        Some(Self {
            colour,
            areas,
            is_outlined: known().any(|at| shown.is_outlined(at)),
        })
    }
}

/// The index of a pixel, if it is inside the picture.
pub(super) fn index(shown: &CellImage, x: u32, y: u32) -> Option<usize> {
    let is_inside = x < shown.size.width && y < shown.size.height;
    is_inside.then_some(y as usize * shown.size.width as usize + x as usize)
}

/// The areas of pixels for which `is_first` holds and of the others, if there are both. The first
/// has the quarters that it touches.
fn areas(shown: &CellImage, pixels: &Pixels, is_first: impl Fn(usize) -> bool) -> Option<Areas> {
    let mut quarters = 0;
    for (at, pixel) in pixels.iter().enumerate() {
        if pixel.is_none_or(&is_first) {
            quarters |= 1 << (at / 4 * 2 + at % 2);
        }
    }
    let known = || pixels.iter().copied().flatten();
    let first = mean(shown, known().filter(|&at| is_first(at)))?;
    let second = mean(shown, known().filter(|&at| !is_first(at)))?;
    Some(Areas {
        colours: [first, second],
        quarters,
    })
}

/// The bright and the dark area of a cell whose quarters differ much.
fn by_brightness(shown: &CellImage, pixels: &Pixels) -> Option<Areas> {
    // The pixels of a quarter are one above the other.
    let quarter = |at: usize| pixels[at / 2 * 4 + at % 2..].iter().step_by(2).take(2);
    let mut lumas = [0.0; 4];
    for (at, shade) in lumas.iter_mut().enumerate() {
        *shade = luma(mean(shown, quarter(at).copied().flatten())?);
    }
    let brightest = lumas.into_iter().fold(0.0, f32::max);
    let darkest = lumas.into_iter().fold(255.0, f32::min);
    if brightest - darkest < CONTRAST {
        return None;
    }
    let middle = f32::midpoint(brightest, darkest);
    let bright = |at: usize| {
        let place = pixels.iter().position(|&pixel| pixel == Some(at));
        place.is_some_and(|place| middle < lumas[place / 4 * 2 + place % 2])
    };
    areas(shown, pixels, bright)
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
