//! Ordered dithering: approximates colours by patterns of those that a terminal has.
//!
//! The result for a pixel depends only on its position and colour, so that an unchanged picture
//! sends nothing.

/// The number of thresholds, one for each cell of the pattern.
pub(super) const STEPS: u32 = 64;

/// The threshold of a pixel, less than [`STEPS`]: Bayer's 8×8 matrix (B. E. Bayer, “An optimum
/// method for two-level rendition of continuous-tone pictures”, 1973).
pub(super) fn threshold(x: u32, y: u32) -> u32 {
    (0..3).fold(0, |sum, bit| {
        let (x, y) = (x >> bit & 1, y >> bit & 1);
        4 * sum + 2 * (x ^ y) + y
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_threshold_is_used_once() {
        let mut all: Vec<u32> = (0..64).map(|at| threshold(at % 8, at / 8)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..64).collect::<Vec<_>>());
        assert_eq!([threshold(0, 0), threshold(1, 1)], [0, 16]);
    }
}
