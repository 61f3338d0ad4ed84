//! Small trial pictures that show which settings bring an overexposed picture down to about 1.

use std::ops::ControlFlow;

use super::frame::{Frame, Settings};
use super::lights::faded;
use crate::scene::{FalloffRule, Filter, Light, Size};

/// The longer side of a small picture, in pixels.
const SIDE: u32 = 64;

/// Its samples per pixel.
const SAMPLES: u32 = 16;

/// How many stops its 99th percentile may be above 1: noise alone accounts for about that.
const ROUGHLY: f64 = 0.5;

/// A change of the settings.
#[derive(Clone, Copy, Debug)]
enum Trial {
    Falloff,
    Depth(u32),
}

/// What the small pictures showed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrialResults {
    /// The stops by which the 99th percentile exceeds 1 with `falloff square`, negative if it is below;
    /// `None` if that was not tried.
    pub falloff: Option<f64>,
    /// The largest of the depths 1, 2, 4 … at which the 99th percentile is at most about 1.
    pub depth: Option<u32>,
}

/// Trials of `falloff square`, if there are lights that it changes, and of smaller depths for paths.
#[derive(Clone, Copy, Debug)]
pub struct Trials {
    /// The settings of the picture.
    settings: Settings,
    /// The stops by which its 99th percentile is above 1.
    over: f64,
    next: Trial,
    shown: TrialResults,
}

impl Trials {
    /// Starts the trials for a picture with these settings and lights whose 99th percentile is `over`
    /// stops above 1; `None` if there is nothing to try. Depths are tried only if noise does not account
    /// for that: otherwise any would seem to help.
    pub fn new(settings: &Settings, lights: &[Light], over: f64) -> Option<Self> {
        let fades =
            settings.falloff == FalloffRule::None && faded(lights, FalloffRule::Square).is_some();
        let first = if fades {
            Some(Trial::Falloff)
        } else {
            (ROUGHLY < over && is_deep(settings, 1)).then_some(Trial::Depth(1))
        };
        first.map(|next| Self {
            settings: *settings,
            over,
            next,
            shown: TrialResults::default(),
        })
    }

    /// What the pictures so far have shown.
    pub fn shown(&self) -> TrialResults {
        self.shown
    }

    /// The settings of the small picture to trace next.
    pub fn settings(&self) -> Settings {
        let Size { width, height } = self.settings.size;
        let longer = width.max(height);
        let side = |side: u32| {
            let fitted = u64::from(side) * u64::from(SIDE) / u64::from(longer);
            side.min(fitted.max(1) as u32)
        };
        let small = Settings {
            size: Size {
                width: side(width),
                height: side(height),
            },
            region: None,
            spp: SAMPLES,
            filter: Filter::Box,
            noise: None,
            ..self.settings
        };
        match self.next {
            Trial::Falloff => Settings {
                falloff: FalloffRule::Square,
                ..small
            },
            Trial::Depth(depth) => Settings { depth, ..small },
        }
    }

    /// Goes on after that picture, or ends with what was shown.
    pub fn after(mut self, picture: &Frame) -> ControlFlow<TrialResults, Self> {
        let stops = stops_above_1(&picture.values);
        let depth = match self.next {
            Trial::Falloff => {
                self.shown.falloff = Some(stops);
                1
            }
            Trial::Depth(_) if ROUGHLY < stops => return ControlFlow::Break(self.shown),
            Trial::Depth(depth) => {
                self.shown.depth = Some(depth);
                2 * depth
            }
        };
        if self.over <= ROUGHLY || !is_deep(&self.settings, depth) {
            return ControlFlow::Break(self.shown);
        }
        self.next = Trial::Depth(depth);
        ControlFlow::Continue(self)
    }
}

/// Whether paths may have more bounces than `depth`.
fn is_deep(settings: &Settings, depth: u32) -> bool {
    settings.integrator.traces_paths() && depth < settings.depth
}

/// By how many stops the 99th percentile of the pixels' largest channels is above 1; negative if it is
/// below, −∞ if it is 0.
fn stops_above_1(values: &[[f32; 3]]) -> f64 {
    let largest = values.iter().map(|[r, g, b]| r.max(*g).max(*b));
    let mut largest: Vec<f32> = largest.filter(|value| !value.is_nan()).collect();
    // A hundredth of the pixels may be brighter.
    let at = largest.len().saturating_sub(1 + values.len() / 100);
    if largest.is_empty() {
        return f64::NEG_INFINITY;
    }
    let (_, value, _) = largest.select_nth_unstable_by(at, f32::total_cmp);
    libm::log2(f64::from(*value))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::{Emitter, Falloff, Integrator, Rendering, Rgb, Shadows};

    /// A lamp with these falloff coefficients.
    fn lamp(radial: [f64; 3]) -> Light {
        Light {
            emitter: Emitter::Point {
                position: DVec3::Z,
                radius: 0.0,
                falloff: Falloff { radial, spot: None },
            },
            colour: Rgb::ONE,
            scale: 1.0,
            shadows: Shadows::Cast,
        }
    }

    /// A picture whose 99th percentile is this many stops above 1.
    fn picture(stops: f64) -> Frame {
        let bright = libm::exp2(stops) as f32;
        let size = Size {
            width: 10,
            height: 10,
        };
        let mut values = vec![[0.0, bright, 0.0]; 100];
        values[7] = [f32::INFINITY; 3];
        Frame {
            values,
            ..Frame::drawn(size, vec![[0; 3]; 100])
        }
    }

    /// The depths tried, 0 for the falloff, and what was shown, for a picture so many stops too bright if
    /// pictures of depths up to `most` are not.
    fn trials(
        over: f64,
        (integrator, depth): (Integrator, u32),
        radial: [f64; 3],
        most: u32,
    ) -> (Vec<u32>, TrialResults) {
        let asked = Rendering {
            integrator: Some(integrator),
            depth: Some(depth),
            noise: Some(0.1),
            ..Rendering::default()
        };
        let size = Size {
            width: 640,
            height: 3,
        };
        let mut tried = Vec::new();
        let mut next = Trials::new(&Settings::new(size, &asked), &[lamp(radial)], over);
        while let Some(trials) = next {
            let settings = trials.settings();
            let Size { width, height } = settings.size;
            assert_eq!(
                (width, height, settings.spp, settings.noise),
                (64, 1, 16, None)
            );
            let fades = settings.falloff == FalloffRule::Square;
            tried.push(if fades { 0 } else { settings.depth });
            let stops = match fades {
                true => -2.0,
                false if settings.depth <= most => 0.25,
                false => 1.0,
            };
            match trials.after(&picture(stops)) {
                ControlFlow::Continue(trials) => next = Some(trials),
                ControlFlow::Break(shown) => return (tried, shown),
            }
        }
        (tried, TrialResults::default())
    }

    #[test]
    fn the_falloff_and_the_largest_depth_that_is_not_too_bright_are_found() {
        let (path, whitted) = (Integrator::Path, Integrator::Whitted);
        let (steady, fading) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let falloff = Some(-2.0);
        for (by, lamp, most, tried, falloff, depth) in [
            ((path, 64), fading, 5, vec![1, 2, 4, 8], None, Some(4)),
            ((path, 64), fading, 0, vec![1], None, None),
            ((path, 5), fading, 9, vec![1, 2, 4], None, Some(4)),
            (
                (Integrator::Photon, 4),
                fading,
                9,
                vec![1, 2],
                None,
                Some(2),
            ),
            ((path, 1), fading, 9, vec![], None, None),
            ((whitted, 8), fading, 9, vec![], None, None),
            ((whitted, 8), steady, 9, vec![0], falloff, None),
            ((path, 1), steady, 9, vec![0], falloff, None),
            ((path, 3), steady, 1, vec![0, 1, 2], falloff, Some(1)),
        ] {
            let shown = TrialResults { falloff, depth };
            assert_eq!(trials(2.0, by, lamp, most), (tried, shown), "{by:?}");
        }
    }

    #[test]
    fn no_depth_is_tried_for_a_picture_that_is_hardly_too_bright() {
        let path = (Integrator::Path, 64);
        let shown = |falloff| TrialResults {
            falloff,
            depth: None,
        };
        assert_eq!(
            trials(0.5, path, [0.0, 0.0, 1.0], 64),
            (vec![], shown(None))
        );
        let steady = trials(0.5, path, [1.0, 0.0, 0.0], 64);
        assert_eq!(steady, (vec![0], shown(Some(-2.0))));
    }

    #[test]
    fn a_hundredth_of_the_pixels_may_be_brighter() {
        let with = |bright: &[f32]| {
            let mut values = vec![[0.5; 3]; 200 - bright.len()];
            values.extend(bright.iter().map(|green| [0.0, *green, 0.0]));
            stops_above_1(&values)
        };
        assert_eq!(with(&[]), -1.0);
        assert_eq!(with(&[8.0, f32::INFINITY]), -1.0);
        assert_eq!(with(&[8.0, 4.0, f32::INFINITY]), 2.0);
        assert_eq!(stops_above_1(&[[0.0; 3]; 9]), f64::NEG_INFINITY);
        assert_eq!(stops_above_1(&[]), f64::NEG_INFINITY);
    }
}
