//! Colours by hue, saturation and value.

use scene::Rgb;

/// A colour by its hue, saturation and value (Smith, "Color Gamut Transform Pairs", 1978).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hsv {
    /// The hue in degrees, from 0 to less than 360: 0 is red, 120 green, 240 blue. 0 for a grey.
    pub hue: f64,
    /// The saturation from 0, a grey, to 1.
    pub saturation: f64,
    /// The value, 0 or more: that of the brightest channel, which may exceed 1.
    pub value: f64,
}

impl Hsv {
    /// Converts red, green and blue; channels below 0 count as 0.
    pub fn of(colour: Rgb) -> Self {
        let [red, green, blue] = colour.to_array().map(|channel| channel.max(0.0));
        let value = red.max(green).max(blue);
        let chroma = value - red.min(green).min(blue);
        if chroma == 0.0 {
            return Self {
                hue: 0.0,
                saturation: 0.0,
                value,
            };
        }
        let sixths = if value == red {
            (green - blue) / chroma
        } else if value == green {
            2.0 + (blue - red) / chroma
        } else {
            4.0 + (red - green) / chroma
        };
        Self {
            hue: (60.0 * sixths).rem_euclid(360.0),
            saturation: chroma / value,
            value,
        }
    }

    /// Converts to red, green and blue.
    pub fn rgb(self) -> Rgb {
        // The distance of each channel's hue, in sixths of the circle.
        let channel = |offset: f64| {
            let sixths = (offset + self.hue / 60.0).rem_euclid(6.0);
            let share = sixths.min(4.0 - sixths).clamp(0.0, 1.0);
            self.value * (1.0 - self.saturation * share)
        };
        Rgb::new(channel(5.0), channel(3.0), channel(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn hues_go_from_red_through_green_to_blue() {
        for (rgb, [hue, saturation, value]) in [
            ([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]),
            ([1.0, 1.0, 0.0], [60.0, 1.0, 1.0]),
            ([0.0, 0.5, 0.0], [120.0, 1.0, 0.5]),
            ([0.0, 2.0, 2.0], [180.0, 1.0, 2.0]),
            ([0.25, 0.25, 0.5], [240.0, 0.5, 0.5]),
            ([1.0, 0.0, 0.5], [330.0, 1.0, 1.0]),
            ([0.5, 0.5, 0.5], [0.0, 0.0, 0.5]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
            ([-1.0, 0.0, 1.0], [240.0, 1.0, 1.0]),
        ] {
            let [red, green, blue] = rgb;
            let hsv = Hsv {
                hue,
                saturation,
                value,
            };
            assert_eq!(Hsv::of(Rgb::new(red, green, blue)), hsv, "{rgb:?}");
        }
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn colours_come_back(red in 0.0..3.0f64, green in 0.0..1.0f64, blue in 0.0..1.0f64) {
            let back = Hsv::of(Rgb::new(red, green, blue)).rgb().to_array();
            for (back, channel) in back.into_iter().zip([red, green, blue]) {
                prop_assert!((back - channel).abs() < 1e-12);
            }
        }
    }
}
