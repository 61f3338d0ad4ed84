//! Small pictures that show by which depth a picture would not be too bright.

use std::ops::ControlFlow;

use super::frame::Settings;
use super::overexposure::Overexposure;
use crate::scene::{Filter, Size};

/// The longer side of a small picture, in pixels.
const SIDE: u32 = 64;

/// Its samples per pixel.
const SAMPLES: u32 = 16;

/// How many stops its 99th percentile may be above 1: noise alone accounts for about that.
const ROUGHLY: f64 = 0.5;

/// A search for the largest of the depths 1, 2, 4 … by which the 99th percentile of a picture is about 1.
#[derive(Clone, Copy, Debug)]
pub struct DepthSearch {
    /// Those of the picture.
    settings: Settings,
    /// The depth to try next.
    depth: u32,
    found: Option<u32>,
}

impl DepthSearch {
    /// Begins with a picture of light that is too bright, of these settings; `None` unless it is path traced
    /// by more bounces than one.
    pub fn new(settings: &Settings) -> Option<Self> {
        let is_deep = settings.integrator.traces_paths() && 1 < settings.depth;
        is_deep.then_some(Self {
            settings: *settings,
            depth: 1,
            found: None,
        })
    }

    /// The settings of the small picture to trace next.
    pub fn settings(&self) -> Settings {
        let Size { width, height } = self.settings.size;
        let longer = width.max(height);
        let side = |side: u32| {
            let fitted = u64::from(side) * u64::from(SIDE) / u64::from(longer);
            side.min(fitted.max(1) as u32)
        };
        Settings {
            size: Size {
                width: side(width),
                height: side(height),
            },
            region: None,
            spp: SAMPLES,
            depth: self.depth,
            filter: Filter::Box,
            noise: None,
            ..self.settings
        }
    }

    /// Goes on after that picture, or ends with the depth that was found, if any was.
    pub fn after(self, overexposure: Overexposure) -> ControlFlow<Option<u32>, Self> {
        if ROUGHLY < overexposure.stops {
            return ControlFlow::Break(self.found);
        }
        let found = Some(self.depth);
        let depth = 2 * self.depth;
        if depth < self.settings.depth {
            ControlFlow::Continue(Self {
                depth,
                found,
                ..self
            })
        } else {
            ControlFlow::Break(found)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Integrator, Rendering};

    /// The depths tried and the one found, if pictures of depths up to `most` are not too bright.
    fn search(integrator: Integrator, depth: u32, most: u32) -> (Vec<u32>, Option<u32>) {
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
        let mut next = DepthSearch::new(&Settings::new(size, &asked));
        while let Some(search) = next {
            let settings = search.settings();
            let Size { width, height } = settings.size;
            assert_eq!(
                (width, height, settings.spp, settings.noise),
                (64, 1, 16, None)
            );
            tried.push(settings.depth);
            let stops = if settings.depth <= most { 0.5 } else { 1.0 };
            let share = 0.0;
            match search.after(Overexposure { share, stops }) {
                ControlFlow::Continue(search) => next = Some(search),
                ControlFlow::Break(found) => return (tried, found),
            }
        }
        (tried, None)
    }

    #[test]
    fn the_largest_depth_that_is_not_too_bright_is_found() {
        let path = Integrator::Path;
        assert_eq!(search(path, 64, 5), (vec![1, 2, 4, 8], Some(4)));
        assert_eq!(search(path, 64, 0), (vec![1], None));
        assert_eq!(search(path, 5, 9), (vec![1, 2, 4], Some(4)));
        assert_eq!(search(Integrator::Photon, 4, 9), (vec![1, 2], Some(2)));
        assert_eq!(search(path, 1, 9), (vec![], None));
        assert_eq!(search(Integrator::Whitted, 8, 9), (vec![], None));
    }
}
