//! Adaptive sampling: which pixels take part in a doubling of the samples.
//!
//! Squares of 4×4 pixels stop once their noise and that of the adjoining squares is low. Squares of
//! different blocks do not adjoin, so that each block of a picture decides alone.

use rayon::prelude::*;

use super::blocks::{BLOCK, Blocks};

/// Edge length of a square in pixels.
const SQUARE: u32 = 4;

/// Squares along the edge of a block, as many as bits in a byte.
const ACROSS: u32 = BLOCK / SQUARE;

/// Squares of a block.
pub(crate) const SQUARES: usize = (ACROSS * ACROSS) as usize;

/// A set of squares of a block, one bit each, in rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Squares(u64);

impl Squares {
    /// The squares whose indices satisfy a condition.
    pub(crate) fn of(holds: impl Fn(usize) -> bool) -> Self {
        let bits = (0..SQUARES).filter(|&index| holds(index));
        Self(bits.fold(0, |set, index| set | 1 << index))
    }

    /// Whether the square with this index is one of them.
    pub(crate) fn has(self, index: usize) -> bool {
        self.0 >> index & 1 != 0
    }

    /// These squares and those that adjoin them, at edges or corners.
    fn grown(self) -> Self {
        const FIRST: u64 = u64::MAX / 0xff;
        const LAST: u64 = FIRST << (ACROSS - 1);
        let across = self.0 | (self.0 & !LAST) << 1 | (self.0 & !FIRST) >> 1;
        Self(across | across << ACROSS | across >> ACROSS)
    }

    fn and(self, others: Self) -> Self {
        Self(self.0 & others.0)
    }
}

/// The index of the square of a pixel in its block.
pub(crate) fn square([x, y]: [u32; 2]) -> usize {
    (y % BLOCK / SQUARE * ACROSS + x % BLOCK / SQUARE) as usize
}

/// Of the squares `taking` samples so far, those that take more: unless the noise of the square and
/// of all adjoining ones is below the limit. Given the squared errors of the pixels of a block, in rows,
/// each with the index of its square.
pub(crate) fn unconverged(
    limit: f64,
    taking: Squares,
    pixels: impl Iterator<Item = (usize, f32)>,
) -> Squares {
    let (mut sums, mut counts) = ([0.0; SQUARES], [0_u32; SQUARES]);
    for (square, squared_error) in pixels {
        sums[square] += f64::from(squared_error);
        counts[square] += 1;
    }
    let noise = |square: usize| (sums[square] / f64::from(counts[square])).sqrt();
    // Beyond the picture's edge there are no pixels.
    let is_noisy = |square: usize| counts[square] != 0 && limit <= noise(square);
    taking.and(Squares::of(is_noisy).grown())
}

/// The pixels of a picture that take part in a step.
#[derive(Debug)]
pub(crate) struct Selection {
    blocks: Blocks,
    /// The squares of each block.
    squares: Vec<Squares>,
    pixels: usize,
}

impl Selection {
    /// Selects the squares of each block by its number, on the current thread pool. `select` returns
    /// also the number of pixels that have the samples of the step after it.
    pub(crate) fn new(blocks: Blocks, select: impl Fn(u32) -> (Squares, usize) + Sync) -> Self {
        let numbers = (0..blocks.count()).into_par_iter();
        let selected = numbers.map(&select);
        let (squares, pixels): (Vec<_>, Vec<_>) = selected.unzip();
        Self {
            blocks,
            squares,
            pixels: pixels.into_iter().sum(),
        }
    }

    /// The number of pixels that have the samples of the step after it.
    pub(crate) fn pixels(&self) -> usize {
        self.pixels
    }

    /// Whether a pixel takes part.
    pub(crate) fn has(&self, [x, y]: [u32; 2]) -> bool {
        let block = y / BLOCK * self.blocks.across() + x / BLOCK;
        self.squares[block as usize].has(square([x, y]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Squares = Squares(u64::MAX);
    const NONE: Squares = Squares(0);

    /// The squares drawn as `#`.
    fn drawn(picture: [&str; 8]) -> Squares {
        let rows = picture.concat();
        Squares::of(|index| rows.as_bytes()[index] == b'#')
    }

    fn errors(noisy: Squares) -> impl Iterator<Item = (usize, f32)> {
        let pixels = (0..BLOCK * BLOCK).map(|at| square([at % BLOCK, at / BLOCK]));
        pixels.map(move |square| (square, if noisy.has(square) { 0.0101 } else { 0.0099 }))
    }

    #[test]
    fn a_square_goes_on_while_it_or_one_that_adjoins_it_is_noisy() {
        let noisy = drawn([
            "#.......", "........", "........", "...#....", "........", "........", ".......#",
            "........",
        ]);
        let expected = drawn([
            "##......", "##......", "..###...", "..###...", "..###...", "......##", "......##",
            "......##",
        ]);
        assert_eq!(unconverged(0.1, ALL, errors(noisy)), expected);
    }

    #[test]
    fn a_square_that_stopped_does_not_begin_again() {
        let taking = drawn([
            "########", "########", "........", "........", "........", "........", "........",
            "........",
        ]);
        assert_eq!(unconverged(0.1, taking, errors(ALL)), taking);
        assert_eq!(unconverged(0.1, ALL, errors(NONE)), NONE);
    }

    #[test]
    fn a_square_has_the_root_of_its_mean_squared_error_and_pixels_beyond_the_edge_have_none() {
        // One noisy pixel of 16: the mean is 0.04 / 16, and its root .05.
        let pixels = || (0..16).map(|at| (9, if at == 5 { 0.04 } else { 0.0 }));
        assert_eq!(unconverged(0.051, ALL, pixels()), NONE);
        let expected = Squares::of(|index| [0, 1, 2, 8, 9, 10, 16, 17, 18].contains(&index));
        assert_eq!(unconverged(0.049, ALL, pixels()), expected);
        assert_eq!(square([36, 39]), 9);
    }
}
