//! A picture of the differences of two pictures.

use super::levels;

/// The difference, in levels, from which a pixel is white.
const HOTTEST: f64 = 64.0;

/// The pixels of a picture that shows where two pictures of the same size differ: black where they agree, then
/// blue, red, yellow and white by the largest difference of a channel, the smallest of 1 level
/// visible and all from 64 levels white.
pub fn heat_map(a: &[[u8; 3]], b: &[[u8; 3]]) -> Vec<[u8; 3]> {
    let pairs = a.iter().zip(b);
    let heat = |(a, b): (&[u8; 3], &[u8; 3])| {
        let levels = levels(*a, *b);
        heat(levels.into_iter().max().unwrap_or(0))
    };
    pairs.map(heat).collect()
}

/// The colour of a difference in levels. Logarithmic, so that a difference of 1 is visible.
fn heat(level: u8) -> [u8; 3] {
    const RAMP: [[f64; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [0.1, 0.1, 0.7],
        [0.8, 0.1, 0.2],
        [1.0, 0.85, 0.1],
        [1.0, 1.0, 1.0],
    ];
    let share = (f64::from(level).ln_1p() / HOTTEST.ln_1p()).min(1.0);
    let place = share * (RAMP.len() - 1) as f64;
    let below = (place as usize).min(RAMP.len() - 2);
    let part = place - below as f64;
    std::array::from_fn(|channel| {
        let value = RAMP[below][channel] * (1.0 - part) + RAMP[below + 1][channel] * part;
        (255.0 * value + 0.5) as u8
    })
}
