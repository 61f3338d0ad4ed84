//! The range of a picture's light, stretched to what few shades can show.

use crate::view::oklab::luma;

/// The share of pixels at either end that may be cut off.
const CUT: usize = 50;

/// The brightest luma that may become black, and the darkest that may become white: a dark picture
/// stays dark, and noise in it is not blown up.
const LIMITS: (usize, usize) = (48, 128);

/// The gain of hues, which few colours would lose.
const VIVID: f32 = 1.15;

/// From the luma that becomes black to that which becomes white.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    black: f32,
    white: f32,
}

impl Range {
    /// The range of a picture.
    pub(super) fn of(pixels: &[[u8; 3]]) -> Self {
        let mut counts = [0_usize; 256];
        for &pixel in pixels {
            counts[luma(pixel) as usize] += 1;
        }
        let mut left = pixels.len() / CUT;
        let mut is_cut = |count: &usize| {
            let is_cut = *count <= left;
            left = left.saturating_sub(*count);
            is_cut
        };
        let black = counts.iter().take_while(|count| is_cut(count)).count();
        left = pixels.len() / CUT;
        let mut is_cut = |count: &usize| {
            let is_cut = *count <= left;
            left = left.saturating_sub(*count);
            is_cut
        };
        let above = counts
            .iter()
            .rev()
            .take_while(|count| is_cut(count))
            .count();
        Self {
            black: black.min(LIMITS.0) as f32,
            white: 255_usize.saturating_sub(above).max(LIMITS.1) as f32,
        }
    }

    /// The brightness of a colour, from black at 0 to white at 1.
    pub(super) fn share(self, colour: [u8; 3]) -> f32 {
        ((luma(colour) - self.black) / (self.white - self.black)).clamp(0.0, 1.0)
    }

    /// The colour in the whole range.
    pub(super) fn stretched(self, colour: [u8; 3]) -> [u8; 3] {
        let (before, after) = (luma(colour), 255.0 * self.share(colour));
        colour.map(|channel| (after + VIVID * (f32::from(channel) - before)) as u8)
    }
}
