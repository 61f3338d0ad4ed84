//! What is wrong with a picture as a whole, and whether anything may be.

use std::fmt;

use crate::render::frame::Frame;
use crate::render::overexposure::Overexposure;
use crate::render::tone::{Light, Tone};
use crate::scene::{Integrator, Rgb, Transfer};

/// A picture without a brighter level, of 255, is told as a black one is.
const BLACK: u8 = 15;

/// Levels up to this, of 255, are no proof of a picture that is not black.
pub(super) const DIM: u8 = 63;

/// A picture of few samples may be black if no larger share of it is brighter than [`DIM`]. By paths the
/// samples of one that is no brighter than [`BLACK`] on average may be: a quarter of them at most.
const LIT: f64 = 0.01;
const LIT_BY_PATHS: f64 = 0.25;

/// Pictures of which this share is above 1 may be too bright: the noise of few samples hides how much is.
const BRIGHT: f64 = 0.25;

/// So may those with this mean: one of which half is above 1 has at least 0.5.
const BRIGHT_MEAN: f64 = 0.4;

/// The side of the squares of pixels by whose means a picture traced by paths is judged: in them the noise
/// of single samples evens out.
const SQUARE: u32 = 8;

/// What is wrong with a picture of light as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Nothing in it is brighter than this level, 0 to 15 of 255.
    Black(u8),
    /// More than half of it is above 1 after the exposure.
    Burnt,
    /// Nothing lights surfaces by this integrator but would by paths, as the text shows.
    Unlit,
    /// Lights emit no photons because they do not fade, as the text shows.
    WithoutPhotons,
    /// The same of some lights, while others emit photons.
    FewerPhotons,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Black(0) => f.write_str("the picture is black"),
            Self::Black(most) => {
                let black = "the picture is almost black";
                write!(f, "{black} (brightest value {most} of 255)")
            }
            Self::Burnt => f.write_str("more than half of the picture is above 1"),
            Self::Unlit => f.write_str("no surface is lit"),
            Self::WithoutPhotons => f.write_str("lights emit no photons"),
            Self::FewerPhotons => f.write_str("some lights emit no photons"),
        }
    }
}

impl Frame {
    /// What is wrong with a complete picture of light, judging by its own samples.
    pub fn fault(&self) -> Option<Fault> {
        let brightest = self.brightest();
        if brightest <= BLACK {
            Some(Fault::Black(brightest))
        } else {
            (0.5 < self.exceeding().share).then_some(Fault::Burnt)
        }
    }

    fn exceeding(&self) -> Overexposure {
        match &self.values[..] {
            [] => self.overexposure,
            values => Overexposure::of(values),
        }
    }
}

/// What may be wrong with a picture of few samples. More samples show no other fault.
#[derive(Clone, Copy, Debug)]
pub(super) struct Suspicion {
    pub(super) is_dark: bool,
    pub(super) is_bright: bool,
}

impl Suspicion {
    /// That of a complete picture of light traced like this.
    pub(super) fn of(picture: &Frame, (integrator, transfer): (Integrator, Transfer)) -> Self {
        let Overexposure { share, mean, .. } = picture.exceeding();
        let is_lit = |pixel: &[u8; 3]| pixel.iter().any(|level| DIM < *level);
        let lit = if picture.values.is_empty() {
            picture.pixels.iter().filter(|pixel| is_lit(pixel)).count()
        } else {
            let tone = Tone::Colour(Light::new(0.0, transfer));
            let values = picture.values.iter();
            let levels = values.map(|value| tone.bytes(Rgb::from(value.map(f64::from))));
            levels.filter(is_lit).count()
        };
        let most = if integrator.traces_paths() {
            LIT_BY_PATHS
        } else {
            LIT
        };
        Self {
            is_dark: lit as f64 <= most * picture.size.pixels() as f64,
            is_bright: BRIGHT < share || BRIGHT_MEAN <= mean,
        }
    }
}

/// The brightest of each channel, 0 to 1, of a small picture: by paths, of the means of squares, to which a
/// pixel adds no more than is displayed of it.
pub(super) fn brightest(picture: &Frame, integrator: Integrator) -> Rgb {
    let side = if integrator.traces_paths() { SQUARE } else { 1 };
    let width = picture.size.width;
    let across = width.div_ceil(side).max(1) as usize;
    let down = picture.size.height.div_ceil(side) as usize;
    let mut squares = vec![(Rgb::ZERO, 0_u32); across * down];
    for (at, value) in (0_u32..).zip(&picture.values) {
        let [x, y] = [at % width / side, at / width / side];
        if let Some((sum, count)) = squares.get_mut(y as usize * across + x as usize) {
            *sum += Rgb::from(value.map(displayed));
            *count += 1;
        }
    }
    let means = squares
        .iter()
        .map(|(sum, count)| *sum / f64::from((*count).max(1)));
    means.fold(Rgb::ZERO, Rgb::max)
}

/// The level of the brightest channel as exported, 0 to 255.
pub(super) fn level(colour: Rgb, transfer: Transfer) -> u8 {
    let bytes = Tone::Colour(Light::new(0.0, transfer)).bytes(colour);
    bytes.into_iter().max().unwrap_or(0)
}

/// What is displayed of a channel; nothing of what is no number.
fn displayed(channel: f32) -> f64 {
    if 0.0 < channel {
        f64::from(channel.min(1.0))
    } else {
        0.0
    }
}

/// That a picture is black which has no brighter level than this.
pub(super) fn black(brightest: u8) -> Option<Fault> {
    (brightest <= BLACK).then_some(Fault::Black(brightest))
}
