//! How a finished frame is looked at: brighter or darker, by another transfer, in false colours.
//! It changes what is on screen, never what files hold.

use rayon::prelude::*;

use super::frame::Frame;
use super::heat_map::heat;
use super::tone::{DisplayTransform, Tone, to_bytes};
use crate::job::Aov;
use scene::{Rgb, Transfer};

/// The largest exposure of the display either way, in half stops.
pub const MOST_HALF_STOPS: i8 = 40;

/// Stops below 1 at which the scale of false colours begins: 1/256, the last level of 8 bits.
const DARKEST: f64 = -8.0;

/// False colours of light below and above the scale.
const BELOW: [u8; 3] = [0, 158, 115];
const ABOVE: [u8; 3] = [255; 3];

/// How light and albedo are displayed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Display {
    /// Exposure on top of the picture's own, in half stops.
    pub half_stops: i8,
    /// The transfer function instead of the picture's own.
    pub transfer: Option<Transfer>,
    /// Whether noise is reduced, in frames that have [`Frame::denoised`].
    pub denoised: bool,
    /// What colours stand for.
    pub colours: Colours,
}

/// What the colours of the display stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// Themselves.
    #[default]
    True,
    /// The luminance after exposure, from 8 stops below 1 to 1: dark to bright; what lies below is
    /// green, above white.
    False,
}

impl Display {
    /// Whether frames are displayed as they are.
    pub fn is_neutral(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a display changes pictures of this; `None` is light.
    pub fn affects(aov: Option<Aov>) -> bool {
        match aov {
            None | Some(Aov::Albedo) => true,
            Some(aov) => aov.is_share(),
        }
    }

    /// The exposure in stops.
    pub fn stops(&self) -> f64 {
        f64::from(self.half_stops) / 2.0
    }

    /// The colours of a frame's pixels. `None` if they are those of the frame: if the display is
    /// neutral, or the frame shows something other than light or albedo.
    pub fn apply(&self, frame: &Frame) -> Option<Vec<[u8; 3]>> {
        let settings = frame.settings().filter(|_| !self.is_neutral())?;
        if !Self::affects(settings.aov) || frame.values.len() != frame.pixels.len() {
            return None;
        }
        let is_denoised = self.denoised && frame.denoised.len() == frame.pixels.len();
        let undenoised = Self {
            denoised: false,
            ..*self
        };
        let shown = match (is_denoised, undenoised.is_neutral()) {
            (true, _) => &frame.denoised,
            (false, false) => &frame.values,
            (false, true) => return None,
        };
        let transfer = self.transfer.unwrap_or(settings.transfer);
        let display = DisplayTransform::new(self.stops(), transfer);
        let pixels = (0..shown.len()).into_par_iter().map(|at| {
            if undenoised.is_neutral() && shown[at] == frame.values[at] {
                return frame.pixels[at];
            }
            let value = Rgb::from(shown[at].map(f64::from));
            match self.colours {
                Colours::True => Tone::Colour(display).bytes(value),
                Colours::False => false_colour(luminance(display.exposed(value))),
            }
        });
        Some(pixels.collect())
    }
}

/// Relative luminance of a linear colour (ITU-R BT.709).
pub(crate) fn luminance(colour: Rgb) -> f64 {
    colour.dot(Rgb::new(0.2126, 0.7152, 0.0722))
}

fn false_colour(luminance: f64) -> [u8; 3] {
    if 1.0 < luminance {
        return ABOVE;
    }
    let stops = libm::log2(luminance);
    // NaN is shown as what is below.
    if DARKEST <= stops {
        // The ends of the ramp are too close to black and white.
        to_bytes(heat(0.15 + 0.75 * (1.0 - stops / DARKEST)))
    } else {
        BELOW
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Weak;

    use glam::DVec3;

    use super::*;
    use crate::{Query, Settings};
    use scene::{Camera, Focus, Lens, Rendering, Size};

    fn settings(aov: Option<Aov>) -> Settings {
        Settings {
            spp: 1,
            depth: 1,
            aov,
            ..Settings::new(
                Size {
                    width: 4,
                    height: 1,
                },
                &Rendering::default(),
            )
        }
    }

    /// A frame of greys.
    fn frame(aov: Option<Aov>) -> Frame {
        let values = [0.0, 0.25, 1.0, 4.0_f32].map(|grey| [grey; 3]);
        let settings = settings(aov);
        let camera = Camera {
            eye: DVec3::Z,
            target: DVec3::ZERO,
            up: DVec3::Y,
            lens: Lens::Perspective(45.0),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: settings.size,
        };
        Frame {
            values: values.to_vec(),
            query: Some(Query {
                world: Weak::new(),
                photons: Weak::new(),
                camera,
                settings,
                numbers: None,
            }),
            ..Frame::drawn(settings.size, vec![[1; 3], [64; 3], [255; 3], [255; 3]])
        }
    }

    fn levels(display: Display, aov: Option<Aov>) -> Option<Vec<u8>> {
        let shown = display.apply(&frame(aov))?;
        Some(shown.iter().map(|pixel| pixel[0]).collect())
    }

    #[test]
    fn exposure_and_transfer_change_light_and_albedo_only() {
        let display = |half_stops, transfer| Display {
            half_stops,
            transfer,
            ..Display::default()
        };
        for (shown, expected) in [
            (display(0, None), None),
            (display(2, None), Some(vec![0, 128, 255, 255])),
            (display(-4, None), Some(vec![0, 16, 64, 255])),
            (display(1, None), Some(vec![0, 90, 255, 255])),
            (
                display(0, Some(Transfer::Srgb)),
                Some(vec![0, 137, 255, 255]),
            ),
        ] {
            assert_eq!(levels(shown, None), expected, "{shown:?}");
            assert_eq!(levels(shown, Some(Aov::Albedo)), expected);
            for other in [Aov::Depth, Aov::Normal, Aov::Object, Aov::Cost, Aov::Noise] {
                assert_eq!(levels(shown, Some(other)), None);
            }
        }
    }

    #[test]
    fn denoised_values_are_displayed_where_they_are_known_and_differ() {
        let with = |half_stops| Display {
            half_stops,
            denoised: true,
            ..Display::default()
        };
        let noisy = frame(None);
        assert_eq!(with(0).apply(&noisy), None);
        assert!(with(2).apply(&noisy).is_some());
        let denoised = Frame {
            denoised: [0.0, 0.5, 1.0, 0.125].map(|grey| [grey; 3]).to_vec(),
            ..noisy
        };
        let levels = |display: Display| {
            let shown = display.apply(&denoised).expect("it is not as traced");
            shown.iter().map(|pixel| pixel[0]).collect::<Vec<_>>()
        };
        // The first pixel stays as traced, although its value is another.
        assert_eq!(levels(with(0)), [1, 128, 255, 32]);
        assert_eq!(levels(with(2)), [0, 255, 255, 64]);
        assert_eq!(Display::default().apply(&denoised), None);
    }

    #[test]
    fn false_colours_mark_both_ends_of_the_scale() {
        let of = |half_stops| {
            let display = Display {
                half_stops,
                colours: Colours::False,
                ..Display::default()
            };
            display.apply(&frame(None)).expect("it is not neutral")
        };
        let neutral = of(0);
        assert_eq!((neutral[0], neutral[3]), (BELOW, ABOVE));
        assert!(![BELOW, ABOVE].contains(&neutral[1]) && ![BELOW, ABOVE].contains(&neutral[2]));
        assert_eq!(of(-4)[3], neutral[2]);
        assert_eq!(of(-20)[1], BELOW);
        for (luminance, colour) in [(f64::NAN, BELOW), (-1.0, BELOW), (f64::INFINITY, ABOVE)] {
            assert_eq!(false_colour(luminance), colour);
        }
    }
}
