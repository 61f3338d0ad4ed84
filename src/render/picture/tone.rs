//! Conversion of pixel values to 8 bits per channel.

use rayon::prelude::*;

use super::frame::Frame;
use super::heat_map::heat;
use crate::job::{Aov, Settings};
use scene::{Rgb, Transfer};

/// Front and back of surfaces: blue and vermilion, which are distinct without red or green vision
/// (Okabe and Ito, "Color Universal Design", 2008).
const SIDES: [[u8; 3]; 2] = [[0, 114, 178], [213, 94, 0]];

/// How linear light is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DisplayTransform {
    /// What colours are multiplied by; `None` leaves every bit.
    scale: Option<f64>,
    transfer: Transfer,
}

impl DisplayTransform {
    pub(crate) fn of(settings: &Settings) -> Self {
        Self::new(settings.exposure, settings.transfer)
    }

    /// Light with an exposure in stops.
    pub(crate) fn new(stops: f64, transfer: Transfer) -> Self {
        Self {
            scale: (stops != 0.0).then(|| libm::exp2(stops)),
            transfer,
        }
    }

    /// The linear colour after exposure.
    #[inline]
    pub(crate) fn exposed(self, colour: Rgb) -> Rgb {
        match self.scale {
            Some(scale) => scale * colour,
            None => colour,
        }
    }

    /// The colour as displayed, each channel from 0 to 1.
    pub(crate) fn displayed(self, colour: Rgb) -> Rgb {
        // NaN survives clamping and becomes 0, as in bytes.
        self.curved(colour)
            .map(|channel| channel.clamp(0.0, 1.0).max(0.0))
    }

    /// Applies exposure and the transfer function.
    #[inline]
    fn curved(self, colour: Rgb) -> Rgb {
        let colour = self.exposed(colour);
        match self.transfer {
            Transfer::Linear => colour,
            Transfer::Srgb => colour.map(srgb),
        }
    }
}

/// The mapping from pixel values to colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tone {
    /// A linear colour.
    Colour(DisplayTransform),
    /// A distance: the nearest is white, the farthest black, infinity black too.
    Depth { nearest: f64, farthest: f64 },
    /// A unit vector with components from −1 to 1; zero is black.
    Normal,
    /// A number, each in its own colour; 0 is black.
    Number,
    /// Texture coordinates, as red and green.
    Uv,
    /// A side: 1 the front, −1 the back; 0 is black.
    Side,
    /// A number on a logarithmic scale.
    Logarithm { least: f64, most: f64 },
    /// A number from 0.
    Part { most: f64 },
}

impl Tone {
    /// The mapping of light, or of an AOV on a scale with these ends.
    pub(crate) fn of(aov: Option<Aov>, display: DisplayTransform, range: Option<[f64; 2]>) -> Self {
        let [least, most] = range.unwrap_or([0.0; 2]);
        match aov {
            None | Some(Aov::Albedo | Aov::Direct(_) | Aov::Emission | Aov::Indirect) => {
                Self::Colour(display)
            }
            Some(Aov::Normal) => Self::Normal,
            Some(Aov::Object) => Self::Number,
            Some(Aov::Depth) => Self::Depth {
                nearest: least,
                farthest: most,
            },
            Some(Aov::Uv) => Self::Uv,
            Some(Aov::Side) => Self::Side,
            Some(Aov::Cost | Aov::Samples) => Self::Logarithm { least, most },
            Some(Aov::Noise) => Self::Part { most },
        }
    }

    /// The linear value after exposure, if it has one.
    pub(crate) fn linear(self, value: Rgb) -> Rgb {
        match self {
            Self::Colour(display) => display.exposed(value),
            _ => value,
        }
    }

    /// Converts a value to 8 bits per channel.
    #[inline]
    pub(crate) fn bytes(self, value: Rgb) -> [u8; 3] {
        match self {
            Self::Colour(display) => to_bytes(display.curved(value)),
            Self::Depth { .. } if value.x == f64::INFINITY => [0; 3],
            Self::Depth { nearest, farthest } if nearest < farthest => {
                to_bytes((farthest - value) / (farthest - nearest))
            }
            Self::Depth { .. } => [255; 3],
            Self::Normal | Self::Number | Self::Side if value == Rgb::ZERO => [0; 3],
            Self::Normal => to_bytes(0.5 * value + 0.5),
            Self::Number => colour_of(value.x as u32),
            Self::Uv => to_bytes(value.map(repeated)),
            Self::Side => SIDES[usize::from(value.x < 0.0)],
            Self::Logarithm { least, most } => {
                let height = |value: f64| libm::log(value / least);
                to_bytes(heat(share(height(value.x), height(most))))
            }
            Self::Part { most } => to_bytes(heat(share(value.x, most))),
        }
    }
}

impl Frame {
    /// The brightest level of any channel of this picture of light as exported, 0 to 255.
    pub(crate) fn brightest(&self) -> u8 {
        let brightest = |most: u8, [red, green, blue]: [u8; 3]| most.max(red).max(green).max(blue);
        if self.values.is_empty() {
            return self.pixels.iter().copied().fold(0, brightest);
        }
        let transfer = self.settings().map(|settings| settings.transfer);
        // The exposure is in the values.
        let tone = Tone::Colour(DisplayTransform::new(0.0, transfer.unwrap_or_default()));
        let bytes = |value: &[f32; 3]| tone.bytes(Rgb::from(value.map(f64::from)));
        self.values.iter().map(bytes).fold(0, brightest)
    }
}

/// The ends of the scale of AOVs that have one, given all values; without a value on it, infinity
/// and 0.
pub(crate) fn scale(
    aov: Option<Aov>,
    values: impl ParallelIterator<Item = Rgb>,
) -> Option<[f64; 2]> {
    let starts_at_zero = match aov? {
        Aov::Depth | Aov::Cost | Aov::Samples => false,
        Aov::Noise => true,
        _ => return None,
    };
    let values = values
        .map(|value| value.x)
        .filter(|&x| 0.0 < x && x.is_finite());
    let (least, most) = values
        .map(|x| (x, x))
        .reduce(|| (f64::INFINITY, 0.0), |a, b| (a.0.min(b.0), a.1.max(b.1)));
    Some([if starts_at_zero { 0.0 } else { least }, most])
}

/// The share of a scale from 0 at which a value stands; 1 on an empty scale.
fn share(value: f64, most: f64) -> f64 {
    if 0.0 < most { value / most } else { 1.0 }
}

/// A texture coordinate in the unit square, whose both ends are in it.
fn repeated(coordinate: f64) -> f64 {
    if (0.0..=1.0).contains(&coordinate) {
        coordinate
    } else {
        coordinate - coordinate.floor()
    }
}

/// Returns a bright colour for a number; Fibonacci hashing (Knuth, The Art of Computer Programming
/// 6.4) makes neighbours distinct.
fn colour_of(number: u32) -> [u8; 3] {
    let [hash @ .., _] = number.wrapping_mul(0x9E37_79B9).to_be_bytes();
    hash.map(|byte| 64 | byte)
}

/// The sRGB transfer function for a linear value from 0 to 1.
fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}

/// Quantises each channel: ⌊255 · clamp(c, 0, 1) + ½⌋.
#[inline]
pub(crate) fn to_bytes(colour: Rgb) -> [u8; 3] {
    // The cast truncates and maps NaN to 0.
    let byte = |channel: f64| (255.0 * channel.clamp(0.0, 1.0) + 0.5) as u8;
    [byte(colour.x), byte(colour.y), byte(colour.z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the standard's table: 128 / 255 is linear 0.21586; 0.003 lies in the linear segment.
    #[test]
    fn the_srgb_curve_matches_the_standard() {
        let tone = Tone::Colour(DisplayTransform::new(0.0, Transfer::Srgb));
        for (linear, byte) in [
            (0.0, 0),
            (1.0, 255),
            (0.215_860_5, 128),
            (0.003, 10),
            (0.5, 188),
            (2.0, 255),
            (-1.0, 0),
        ] {
            assert_eq!(tone.bytes(Rgb::splat(linear)), [byte; 3], "{linear}");
        }
    }

    /// A stop doubles: 0.25 at one stop is 0.5, and 0 stops leave even what doubling would not.
    #[test]
    fn an_exposure_of_one_stop_doubles() {
        for (stops, linear, bytes) in [
            (1.0, 0.25, 128),
            (-1.0, 1.0, 128),
            (0.5, 0.25, 90),
            (0.0, f64::MIN_POSITIVE, 0),
            (60.0, 1e-18, 255),
        ] {
            let display = DisplayTransform::new(stops, Transfer::Linear);
            let tone = Tone::Colour(display);
            assert_eq!(tone.bytes(Rgb::splat(linear)), [bytes; 3], "{stops}");
        }
        assert_eq!(
            DisplayTransform::new(2.0, Transfer::Srgb).exposed(Rgb::ONE),
            Rgb::splat(4.0)
        );
        assert_eq!(DisplayTransform::new(0.0, Transfer::Linear).scale, None);
    }

    #[test]
    fn heat_coordinates_and_sides_have_their_colours() {
        let costs = Tone::Logarithm {
            least: 1.0,
            most: 256.0,
        };
        let errors = Tone::Part { most: 0.5 };
        let even = Tone::Logarithm {
            least: 16.0,
            most: 16.0,
        };
        for (tone, value, bytes) in [
            (costs, [1.0; 3], [0, 0, 4]),
            (costs, [16.0; 3], [188, 55, 84]),
            (costs, [256.0; 3], [252, 255, 164]),
            (costs, [0.0; 3], [0, 0, 4]),
            (even, [16.0; 3], [252, 255, 164]),
            (errors, [0.0; 3], [0, 0, 4]),
            (errors, [0.25; 3], [188, 55, 84]),
            (Tone::Part { most: 0.0 }, [0.0; 3], [252, 255, 164]),
            (Tone::Uv, [0.0, 1.0, 0.0], [0, 255, 0]),
            (Tone::Uv, [1.25, -0.25, 0.0], [64, 191, 0]),
            (Tone::Side, [1.0; 3], [0, 114, 178]),
            (Tone::Side, [-1.0; 3], [213, 94, 0]),
            (Tone::Side, [0.0; 3], [0; 3]),
        ] {
            assert_eq!(tone.bytes(value.into()), bytes, "{tone:?} {value:?}");
        }
    }

    #[test]
    fn distances_normals_and_numbers_have_distinct_mappings() {
        let depth = Tone::Depth {
            nearest: 2.0,
            farthest: 4.0,
        };
        for (distance, byte) in [(2.0, 255), (3.0, 128), (4.0, 0), (f64::INFINITY, 0)] {
            assert_eq!(depth.bytes(Rgb::splat(distance)), [byte; 3], "{distance}");
        }
        let flat = Tone::Depth {
            nearest: 2.0,
            farthest: 2.0,
        };
        assert_eq!(flat.bytes(Rgb::splat(2.0)), [255; 3]);
        assert_eq!(Tone::Normal.bytes(Rgb::new(0.0, 1.0, -1.0)), [128, 255, 0]);
        assert_eq!(Tone::Normal.bytes(Rgb::ZERO), [0; 3]);
        assert_eq!(Tone::Number.bytes(Rgb::ZERO), [0; 3]);
        let colours: std::collections::BTreeSet<_> = (1..200)
            .map(|number| Tone::Number.bytes(Rgb::splat(f64::from(number))))
            .collect();
        assert_eq!(colours.len(), 199);
    }

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
