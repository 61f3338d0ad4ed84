//! Pictures as characters, for terminals without colours.
//!
//! Dark areas are letters and dots, bright ones blocks, so that the ramp goes from black to white;
//! edges are sharpened and follow the halves of cells.

use super::dither;
use super::oklab::light;
use crate::app::CellImage;

/// Characters, and the coverage of their upper and lower halves: exact for blocks, for the others
/// an average over common fonts (`DejaVu` Sans Mono, Noto Sans Mono).
const GLYPHS: [(&str, [f32; 2]); 13] = [
    (" ", [0.0, 0.0]),
    (".", [0.0, 0.04]),
    ("'", [0.06, 0.0]),
    (":", [0.04, 0.04]),
    ("\"", [0.11, 0.0]),
    ("=", [0.1, 0.1]),
    ("%", [0.19, 0.19]),
    ("░", [0.25, 0.25]),
    ("▒", [0.5, 0.5]),
    ("▓", [0.75, 0.75]),
    ("█", [1.0, 1.0]),
    ("▀", [1.0, 0.0]),
    ("▄", [0.0, 1.0]),
];

/// Amount of sharpening: the factor applied to a pixel's difference in lightness from its
/// neighbours.
const SHARPNESS: f32 = 1.5;

/// Amplitude of the dither pattern in lightness: the last step of the ramp, so that white stays
/// white.
const NOISE: f32 = 0.09;

/// The lightness of a picture's pixels, ready to be drawn.
#[derive(Debug)]
pub(super) struct Characters {
    /// One value per pixel from 0 to 1, row by row.
    lightness: Vec<f32>,
    width: usize,
    glyphs: [Glyph; GLYPHS.len()],
}

/// A character, and the lightness of its halves and of the whole.
#[derive(Clone, Copy, Debug)]
struct Glyph {
    symbol: &'static str,
    lightness: [f32; 3],
}

impl Characters {
    /// Computes the lightness of a picture's pixels.
    pub(super) fn of(shown: &CellImage) -> Self {
        let lights: [f32; 256] = std::array::from_fn(|value| light([value as u8; 3])[0]);
        let lightness = shown.pixels.iter().map(|&pixel| {
            let [red, green, blue] = pixel.map(|value| lights[usize::from(value)]);
            // Rec. 709.
            fourth_root(0.2126 * red + 0.7152 * green + 0.0722 * blue)
        });
        Self {
            lightness: lightness.collect(),
            width: shown.size.width as usize,
            glyphs: GLYPHS.map(|(symbol, [upper, lower])| Glyph {
                symbol,
                lightness: [upper, lower, f32::midpoint(upper, lower)].map(f32::cbrt),
            }),
        }
    }

    /// The character of a cell inside the picture; the half below an odd last row is black.
    pub(super) fn at(&self, column: u32, row: u32) -> &'static str {
        let x = column as usize;
        let [upper, lower] = [2 * row, 2 * row + 1].map(|y| self.sharpened(x, y as usize));
        let whole = fourth_root(f32::midpoint(upper.powi(4), lower.powi(4)));
        // Thresholds are per cell, not per pixel.
        let threshold = dither::threshold(column, row) as f32 + 0.5;
        let noise = NOISE * (threshold / dither::STEPS as f32 - 0.5);
        let goal = [upper, lower, whole].map(|lightness| lightness + noise);
        let mut least = f32::INFINITY;
        let mut closest = " ";
        for glyph in &self.glyphs {
            let pairs = glyph.lightness.into_iter().zip(goal);
            let error: f32 = pairs.map(|(shown, goal)| (shown - goal).powi(2)).sum();
            if error < least {
                (least, closest) = (error, glyph.symbol);
            }
        }
        closest
    }

    /// The lightness of a pixel after sharpening against its four neighbours; pixels beyond the
    /// edge repeat those at the edge.
    fn sharpened(&self, x: usize, y: usize) -> f32 {
        let Some(here) = self.lightness(x, y) else {
            return 0.0;
        };
        let neighbours = [
            (x.wrapping_sub(1), y),
            (x + 1, y),
            (x, y.wrapping_sub(1)),
            (x, y + 1),
        ];
        let lightness = neighbours.map(|(x, y)| self.lightness(x, y).unwrap_or(here));
        let around = lightness.iter().sum::<f32>() / 4.0;
        (here + SHARPNESS * (here - around)).clamp(0.0, 1.0)
    }

    fn lightness(&self, x: usize, y: usize) -> Option<f32> {
        let inside = x < self.width;
        let at = y.checked_mul(self.width)?.checked_add(x)?;
        inside.then(|| self.lightness.get(at).copied()).flatten()
    }
}

/// The lightness of linear light. Perceived lightness is about its cube root; characters are
/// coarse, and more of a picture is recognizable near the middle of their ramp than with exact
/// lightness.
fn fourth_root(light: f32) -> f32 {
    light.sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::tests::cell_image;

    /// The rows of cells of a picture of greys.
    fn drawn(width: u32, height: u32, grey: impl Fn(u32, u32) -> u8) -> Vec<String> {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels = pixels.map(|(x, y)| [grey(x, y); 3]).collect();
        let characters = &Characters::of(&cell_image(width, height, pixels));
        let row = |row| (0..width).map(move |column| characters.at(column, row));
        let rows = (0..height.div_ceil(2)).map(|at| row(at).collect());
        rows.collect()
    }

    #[test]
    fn the_ramp_goes_from_black_to_white() {
        assert_eq!(drawn(2, 2, |_, _| 0), ["  "]);
        assert_eq!(drawn(2, 2, |_, _| 255), ["██"]);
        let fill = |symbol: char| -> f32 {
            let mut found = GLYPHS.iter().filter(|(known, _)| known.starts_with(symbol));
            let (_, parts) = found.next().expect("a character of the ramp");
            parts.iter().sum()
        };
        let mut last = 0.0;
        for grey in (0..=255).step_by(5) {
            let patch = drawn(8, 16, |_, _| grey).concat();
            let filled: f32 = patch.chars().map(fill).sum();
            assert!(last <= filled, "{grey}: {filled} after {last}");
            last = filled;
        }
    }

    #[test]
    fn edges_follow_the_halves_of_cells() {
        for (rows, expected) in [
            ([255, 0, 0, 0], ["▀▀", "  "]),
            ([0, 255, 255, 255], ["▄▄", "██"]),
            ([0, 0, 0, 255], ["  ", "▄▄"]),
        ] {
            let cells = drawn(2, 4, |_, y| rows[y as usize]);
            assert_eq!(cells, expected, "{rows:?}");
        }
        // The half below an odd last row is black.
        assert_eq!(drawn(1, 1, |_, _| 255), ["▀"]);
    }

    #[test]
    fn a_faint_step_is_sharpened() {
        let cells = drawn(6, 2, |x, _| if x < 3 { 100 } else { 120 }).concat();
        let cells: Vec<char> = cells.chars().collect();
        assert_ne!(cells[2], cells[3], "{cells:?}");
    }

    #[test]
    fn blue_is_darker_than_green() {
        let cell = |colour| Characters::of(&cell_image(1, 2, vec![colour; 2])).at(0, 0);
        assert_eq!([cell([0, 0, 255]), cell([0, 255, 0])], ["=", "▓"]);
    }
}
