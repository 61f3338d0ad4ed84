//! Zoom and pan: which part of a picture is on screen.

use super::frame_window::{Grid, Window};
use render::Region;
use scene::Size;

/// The strongest enlargement: 64 pixels on screen for one of the picture.
const NEAREST: i8 = 6;

/// The weakest: one pixel on screen for 2^16 of the picture, more than any has.
const FARTHEST: i8 = -16;

/// The share of the window by which a step of a pan moves it.
const PAN: f64 = 0.125;

/// Which part of a picture is on screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Its scale: 2 to this power pixels on screen for one of the picture; `None` fits all of it.
    scale: Option<i8>,
    /// The place of the picture in the middle, as shares of its width and height.
    centre: [f64; 2],
}

/// A picture and the screen it is shown on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen {
    /// Size of the picture.
    pub(crate) output: Size,
    /// Size in half blocks of the whole picture on screen.
    pub(crate) halves: Size,
    /// Pixels in each cell.
    pub(crate) grid: Grid,
}

/// How a picture is traced that is seen smaller than it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Detail {
    /// At its full size.
    Full,
    /// At the size on screen.
    OnScreen,
}

impl Default for Viewport {
    fn default() -> Self {
        Self {
            scale: None,
            centre: [0.5; 2],
        }
    }
}

impl Viewport {
    /// The same on this screen, which may have grown since: a scale that shows all of the picture
    /// fits it.
    #[must_use]
    pub(crate) fn on(self, screen: Screen) -> Self {
        match self.scale {
            Some(scale) if scale < screen.least_scale() => Self::default(),
            _ => self,
        }
    }

    /// Whether all of the picture is on screen.
    pub fn is_fit(self) -> bool {
        self.scale.is_none()
    }

    /// The scale, such as `fit`, `2:1` or `1:4`: pixels on screen to pixels of the picture.
    pub fn name(self) -> String {
        match self.scale {
            None => "fit".to_owned(),
            Some(scale @ 0..) => format!("{}:1", 1 << scale),
            Some(scale) => format!("1:{}", 1_u32 << -scale),
        }
    }

    /// The scale with this name, without `fit`: a power of two up to 64, `N:1`, or `1:N`.
    pub(crate) fn parse(said: &str) -> Option<i8> {
        let (shown, pixels) = said.split_once(':').unwrap_or((said, "1"));
        let power = |digits: &str| {
            let number: u32 = digits.trim().parse().ok()?;
            number.is_power_of_two().then(|| number.ilog2() as i8)
        };
        let scale = power(shown)? - power(pixels)?;
        (FARTHEST..=NEAREST).contains(&scale).then_some(scale)
    }

    /// Zooms by doublings; what is at `about`, in shares of the window, stays there.
    #[must_use]
    pub(crate) fn zoomed(self, steps: i8, about: [f64; 2], screen: Screen) -> Self {
        let scale = match self.scale {
            Some(scale) => scale + steps,
            None if steps < 0 => return self,
            None => screen.least_scale() + steps - 1,
        };
        self.scaled(scale, about, screen)
    }

    /// Sets the scale; what is at `about`, in shares of the window, stays there. A scale that shows
    /// all of the picture fits it.
    #[must_use]
    pub(crate) fn scaled(self, scale: i8, about: [f64; 2], screen: Screen) -> Self {
        let scale = scale.min(NEAREST);
        if scale < screen.least_scale() {
            return Self::default();
        }
        let fixed = self.place(about, screen);
        let part = screen.part(Some(scale));
        let to = Self {
            scale: Some(scale),
            centre: [0, 1].map(|axis| fixed[axis] + (0.5 - about[axis]) * part[axis]),
        };
        to.settled(screen)
    }

    /// One pixel on screen for one of the picture, or the next larger scale if that shows all of it;
    /// if it is there already, all of the picture.
    #[must_use]
    pub(crate) fn toggled(self, screen: Screen) -> Self {
        match self.scale {
            None => self.scaled(screen.least_scale().max(0), [0.5; 2], screen),
            Some(_) => Self::default(),
        }
    }

    /// Moves the window by steps to the right and down.
    #[must_use]
    pub(crate) fn panned(self, [right, down]: [f64; 2], screen: Screen) -> Self {
        let part = screen.part(self.scale);
        // At least a pixel of the picture.
        let step = |axis: usize, all: u32| (PAN * part[axis]).max(1.0 / f64::from(all));
        let [x, y] = self.centre;
        let to = [
            x + right * step(0, screen.output.width),
            y + down * step(1, screen.output.height),
        ];
        Self { centre: to, ..self }.settled(screen)
    }

    /// Moves the window so that what is at one place of it, in shares, comes to another.
    #[must_use]
    pub(crate) fn dragged(self, from: [f64; 2], to: [f64; 2], screen: Screen) -> Self {
        let part = screen.part(self.scale);
        let centre = [0, 1].map(|axis| self.centre[axis] + (from[axis] - to[axis]) * part[axis]);
        Self { centre, ..self }.settled(screen)
    }

    /// What is on screen; `None` for all of the picture.
    pub(crate) fn window(self, screen: Screen, detail: Detail) -> Option<Window> {
        let scale = self.scale.filter(|&scale| screen.least_scale() <= scale)?;
        let shrunk = match (detail, scale) {
            (Detail::OnScreen, ..0) => scale,
            _ => 0,
        };
        let each = |pixels: f64| (pixels * f64::from(shrunk).exp2()).round().max(1.0);
        let output = screen.output;
        let [width, height] = [output.width, output.height].map(f64::from);
        let whole = [each(width), each(height)];
        let pixels = screen.pixels();
        // Pixels on screen for one of the traced ones: a whole number unless they are averaged.
        let enlarged = f64::from(scale - shrunk).exp2();
        let part = [0, 1].map(|axis| (pixels[axis] / enlarged).ceil().min(whole[axis]));
        let from = [0, 1].map(|axis| {
            let from = self.centre[axis] * whole[axis] - 0.5 * pixels[axis] / enlarged;
            from.round().clamp(0.0, whole[axis] - part[axis])
        });
        let shown = screen.grid.size(screen.halves);
        let down = f64::from(shown.height) / pixels[1];
        let size = |pixels: [f64; 2]| {
            let [width, height] = pixels.map(|length| length as u32);
            Size { width, height }
        };
        Some(Window {
            whole: size(whole),
            part: Region {
                x: from[0] as u32,
                y: from[1] as u32,
                width: part[0] as u32,
                height: part[1] as u32,
            },
            fills: size([
                (part[0] * enlarged).round(),
                (part[1] * enlarged * down).round(),
            ]),
        })
    }

    /// The place of the picture at a place of the window, both in shares.
    fn place(self, about: [f64; 2], screen: Screen) -> [f64; 2] {
        let part = screen.part(self.scale);
        [0, 1].map(|axis| self.centre[axis] + (about[axis] - 0.5) * part[axis])
    }

    /// Keeps the window inside the picture.
    fn settled(self, screen: Screen) -> Self {
        let part = screen.part(self.scale);
        let inside = |axis: usize| {
            let margin = 0.5 * part[axis];
            self.centre[axis].max(margin).min(1.0 - margin)
        };
        Self {
            centre: [inside(0), inside(1)],
            ..self
        }
    }
}

impl Screen {
    /// Pixels on screen, if all were as wide and as high as one is wide.
    fn pixels(self) -> [f64; 2] {
        let across = f64::from(self.grid.across);
        [self.halves.width, self.halves.height].map(|halves| across * f64::from(halves))
    }

    /// The shares of the picture's width and height that a scale shows.
    fn part(self, scale: Option<i8>) -> [f64; 2] {
        let output = [self.output.width, self.output.height].map(f64::from);
        let pixels = self.pixels();
        let all = |scale: i8| {
            let shown = f64::from(scale).exp2();
            [0, 1].map(|axis| (pixels[axis] / shown / output[axis]).min(1.0))
        };
        scale.map_or([1.0; 2], all)
    }

    /// The smallest scale that does not show all of the picture.
    fn least_scale(self) -> i8 {
        let shows_less = |&scale: &i8| self.part(Some(scale)).iter().any(|&share| share < 1.0);
        (FARTHEST..=NEAREST).find(shows_less).unwrap_or(NEAREST + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 400×300 on 100×75 half blocks: it fits at 1:4.
    const SCREEN: Screen = Screen {
        output: Size {
            width: 400,
            height: 300,
        },
        halves: Size {
            width: 100,
            height: 75,
        },
        grid: Grid::HALF_BLOCKS,
    };

    #[track_caller]
    fn assert_sees(viewport: Viewport, detail: Detail, expected: &str) {
        let window = viewport.window(SCREEN, detail).expect("a part");
        let Window { whole, part, fills } = window;
        let size = |size: Size| format!("{}x{}", size.width, size.height);
        let seen = format!("{part} of {} on {}", size(whole), size(fills));
        assert_eq!(seen, expected);
    }

    #[test]
    fn scales_are_powers_of_two_from_the_first_that_does_not_fit() {
        let middle = [0.5; 2];
        let mut viewport = Viewport::default();
        let mut names = Vec::new();
        for steps in [1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -7, -1] {
            viewport = viewport.zoomed(steps, middle, SCREEN);
            names.push(viewport.name());
        }
        let expected = "1:2 1:1 2:1 4:1 8:1 16:1 32:1 64:1 64:1 32:1 1:4 1:4";
        assert_eq!(names.join(" "), expected.replace("1:4", "fit"));
        assert_eq!(Viewport::default().toggled(SCREEN).name(), "1:1");
        assert!(Viewport::default().toggled(SCREEN).toggled(SCREEN).is_fit());
        let small = Screen {
            output: SCREEN.halves,
            ..SCREEN
        };
        assert_eq!(Viewport::default().toggled(small).name(), "2:1");
        for (said, scale) in [
            ("4", Some(2)),
            ("4:1", Some(2)),
            ("1 : 8", Some(-3)),
            ("1:1", Some(0)),
            ("3", None),
            ("128", None),
            ("0", None),
            ("x", None),
        ] {
            assert_eq!(Viewport::parse(said), scale, "{said}");
        }
    }

    #[test]
    fn a_window_shows_the_pixels_of_its_scale() {
        let at = |scale| Viewport::default().scaled(scale, [0.5; 2], SCREEN);
        assert_eq!(at(-2).window(SCREEN, Detail::Full), None);
        for (scale, detail, seen) in [
            (-1, Detail::Full, "100,75,200,150 of 400x300 on 100x75"),
            (-1, Detail::OnScreen, "50,38,100,75 of 200x150 on 100x75"),
            (0, Detail::Full, "150,113,100,75 of 400x300 on 100x75"),
            (1, Detail::OnScreen, "175,131,50,38 of 400x300 on 100x76"),
            (4, Detail::Full, "197,148,7,5 of 400x300 on 112x80"),
        ] {
            assert_sees(at(scale), detail, seen);
        }
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer_and_the_window_stays_inside() {
        let corner = Viewport::default().scaled(0, [0.0, 1.0], SCREEN);
        assert_sees(corner, Detail::Full, "0,225,100,75 of 400x300 on 100x75");
        let about = Viewport::default().scaled(0, [0.25, 0.5], SCREEN);
        // A quarter of the picture is at a quarter of the window: pixel 100 at column 25.
        assert_sees(about, Detail::Full, "75,113,100,75 of 400x300 on 100x75");
        let panned = about.panned([1.0, -2.0], SCREEN);
        assert_sees(panned, Detail::Full, "88,94,100,75 of 400x300 on 100x75");
        let far = about.panned([-99.0, 99.0], SCREEN);
        assert_eq!(far, corner.panned([0.0; 2], SCREEN));
        let dragged = about.dragged([0.5, 0.5], [0.4, 0.5], SCREEN);
        assert_sees(dragged, Detail::Full, "85,113,100,75 of 400x300 on 100x75");
    }

    /// Sextants: pixels on screen are not square, those of the picture are.
    #[test]
    fn pixels_stay_square_on_every_grid() {
        let screen = Screen {
            grid: Grid { across: 2, down: 3 },
            ..SCREEN
        };
        let viewport = Viewport::default().scaled(1, [0.5; 2], screen);
        let window = viewport.window(screen, Detail::Full).expect("a part");
        assert_eq!(window.part.size(), SCREEN.halves);
        // 38 cells high.
        let fills = Size {
            width: 200,
            height: 113,
        };
        assert_eq!(window.fills, fills);
    }
}
