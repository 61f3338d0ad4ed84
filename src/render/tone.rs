//! Linear radiance to 8-bit pixels.

use crate::scene::Rgb;

/// The 8-bit value of each channel: ⌊255 · clamp(c, 0, 1) + ½⌋, without gamma.
pub(crate) fn to_bytes(colour: Rgb) -> [u8; 3] {
    // The cast truncates, and takes NaN to 0.
    colour
        .to_array()
        .map(|channel| (255.0 * channel.clamp(0.0, 1.0) + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_clamped_and_rounded_to_the_nearest_level() {
        for (channel, byte) in [
            (0.0, 0),
            (1.0, 255),
            (0.5, 128),
            (0.499, 127),
            (0.5 / 255.0, 1),
            (0.49 / 255.0, 0),
            (-3.0, 0),
            (7.0, 255),
            (f64::INFINITY, 255),
        ] {
            assert_eq!(to_bytes(Rgb::splat(channel)), [byte; 3], "{channel}");
        }
    }
}
