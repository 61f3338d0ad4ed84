//! Palettes of terminals with few colours, and what comes closest to other colours in them.
//!
//! A colour becomes one of the palette, or in the whole of a cell a tint: a shade character of one
//! colour on another, whose total light is close to its own. Areas of one colour are of one tint,
//! never a pattern. The first sixteen of 256 colours are never used, because they depend on the
//! theme.

use ratatui::style::{Color, Style};

use super::oklab::{light, luma, oklab};
use crate::terminal::{THEME, colour_on_screen};

/// The number of nearest colours that are tried as the paper of a tint.
const PAPERS: usize = 12;

/// The shade characters, and how much of a cell they fill in common fonts.
const SHADES: [(&str, f32); 3] = [(" ", 0.0), ("░", 0.25), ("▒", 0.5)];

/// Width of a box of colours that share a tint. The levels of the 6×6×6 cube of the 256 colours are
/// multiples of it, so that they are mapped to themselves.
const STEP: usize = 5;

/// Number of boxes along a channel.
const STEPS: usize = 255 / STEP + 1;

/// How the colours of a palette are chosen. `benches/colours.rs` measures the result.
#[derive(Clone, Copy, Debug)]
struct Taste {
    /// Weight of an error in hue relative to lightness. The two chromatic axes of `OkLab` are about
    /// half as long as perceived.
    hue: f32,
    /// Weight of the contrast in a tint relative to the error of its mean.
    noise: f32,
    /// The greatest difference in lightness of a tint's colours, and in all.
    contrast: [f32; 2],
}

/// A palette and the tints of its colours, found on demand.
#[derive(Debug)]
pub(super) struct Palette {
    colours: Vec<Fixed>,
    taste: Taste,
    /// The tints on each colour as paper: itself first.
    blends: Vec<Vec<Blend>>,
    /// The nearest colour and tint of each box of colours, then of each grey: those of the ramp are
    /// not multiples of [`STEP`].
    found: Vec<Option<Found>>,
}

/// A colour of the palette.
#[derive(Clone, Copy, Debug)]
struct Fixed {
    index: u8,
    light: [f32; 3],
    lab: [f32; 3],
    luma: f32,
    is_grey: bool,
}

/// A tint, and what it looks like.
#[derive(Clone, Copy, Debug)]
struct Blend {
    tint: Tint,
    lab: [f32; 3],
    /// The squared distance of its colours.
    noise: f32,
    is_grey: bool,
}

#[derive(Clone, Copy, Debug)]
struct Found {
    nearest: u8,
    tint: Tint,
}

/// A shade character of one colour of a palette on another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tint {
    shade: u8,
    ink: u8,
    paper: u8,
}

impl Tint {
    pub(super) fn symbol(self) -> &'static str {
        SHADES[usize::from(self.shade)].0
    }

    pub(super) fn style(self) -> Style {
        Style::reset()
            .fg(Color::Indexed(self.ink))
            .bg(Color::Indexed(self.paper))
    }
}

impl Palette {
    /// The 240 fixed colours of the 256.
    pub(super) fn of_256() -> Self {
        let taste = Taste {
            hue: 2.0,
            noise: 0.02,
            contrast: [0.06, 0.134],
        };
        let fixed = |index| Some((index, colour_on_screen(Color::Indexed(index))?));
        Self::new((16..=255).filter_map(fixed), taste)
    }

    /// The sixteen colours of the terminal's theme.
    pub(super) fn of_16() -> Self {
        // No colour is close to another: shades of all that have no other hue.
        let taste = Taste {
            hue: 1.2,
            noise: 0.03,
            contrast: [f32::MAX; 2],
        };
        Self::new((0..).zip(THEME), taste)
    }

    fn new(colours: impl Iterator<Item = (u8, [u8; 3])>, taste: Taste) -> Self {
        let colours = colours.map(|(index, colour)| Fixed {
            index,
            light: light(colour),
            lab: oklab(light(colour)),
            luma: luma(colour),
            is_grey: is_grey(colour),
        });
        let colours: Vec<_> = colours.collect();
        let blends = colours.iter().map(|paper| blends(&colours, paper, taste));
        Self {
            blends: blends.collect(),
            colours,
            taste,
            found: vec![None; STEPS * STEPS * STEPS + 256],
        }
    }

    /// The terminal's colour with an index.
    pub(super) fn colour(index: u8) -> Color {
        Color::Indexed(index)
    }

    /// The index of the nearest colour.
    pub(super) fn nearest(&mut self, colour: [u8; 3]) -> u8 {
        self.find(colour).nearest
    }

    /// The tint that comes closest to a colour.
    pub(super) fn tint(&mut self, colour: [u8; 3]) -> Tint {
        self.find(colour).tint
    }

    /// The index of a colour in which a line is seen on another.
    pub(super) fn contrast(&self, paper: u8) -> u8 {
        const DARK: f32 = 70.0;
        let at = |index: u8| self.colours.iter().find(|fixed| fixed.index == index);
        match at(paper).map_or(0.0, |fixed| fixed.luma) {
            DARK.. => 0,
            // White on black would be louder than what the line is around.
            0.0 => 8,
            _ => 15,
        }
    }

    fn find(&mut self, colour: [u8; 3]) -> Found {
        let (slot, of_box) = slot(colour);
        if let Some(found) = self.found[slot] {
            return found;
        }
        let found = self.search(of_box);
        self.found[slot] = Some(found);
        found
    }

    /// Finds what comes closest to a colour. Greys become greys only.
    fn search(&self, colour: [u8; 3]) -> Found {
        let goal = oklab(light(colour));
        let hue = self.taste.hue;
        let papers = self.papers(goal, is_grey(colour));
        let mut tint = self.blends[papers[0]][0].tint;
        let mut least = f32::INFINITY;
        for blend in papers.iter().flat_map(|&paper| &self.blends[paper]) {
            let cost = squared(blend.lab, goal, hue) + self.taste.noise * blend.noise;
            if cost < least && (blend.is_grey || !is_grey(colour)) {
                (least, tint) = (cost, blend.tint);
            }
        }
        Found {
            nearest: self.colours[papers[0]].index,
            tint,
        }
    }

    /// The places of the colours nearest to a colour, the nearest first.
    fn papers(&self, goal: [f32; 3], is_grey: bool) -> [usize; PAPERS] {
        let mut found = [(f32::INFINITY, 0); PAPERS];
        for (at, candidate) in self.colours.iter().enumerate() {
            let far = squared(candidate.lab, goal, self.taste.hue);
            if far < found[PAPERS - 1].0 && (candidate.is_grey || !is_grey) {
                let place = found.partition_point(|&(closer, _)| closer <= far);
                found.copy_within(place..PAPERS - 1, place + 1);
                found[place] = (far, at);
            }
        }
        found.map(|(_, at)| at)
    }
}

/// The tints on a paper, itself first.
fn blends(colours: &[Fixed], paper: &Fixed, taste: Taste) -> Vec<Blend> {
    let mut blends = Vec::new();
    for (shade, (_, share)) in (0_u8..).zip(SHADES) {
        for ink in colours {
            let is_itself = ink.index == paper.index;
            if is_itself != (shade == 0) || !is_itself && !blend_well(ink, paper, taste) {
                continue;
            }
            let mean = |at: usize| share * ink.light[at] + (1.0 - share) * paper.light[at];
            blends.push(Blend {
                tint: Tint {
                    shade,
                    ink: ink.index,
                    paper: paper.index,
                },
                lab: oklab([0, 1, 2].map(mean)),
                noise: squared(ink.lab, paper.lab, 1.0),
                is_grey: ink.is_grey && paper.is_grey,
            });
        }
    }
    blends
}

/// Whether two colours make a calm tint.
fn blend_well(one: &Fixed, other: &Fixed, taste: Taste) -> bool {
    let [lightness, all] = taste.contrast;
    let is_close = (one.lab[0] - other.lab[0]).abs() < lightness
        && squared(one.lab, other.lab, taste.hue) < all * all;
    // In the theme, bright colours come eight after dull ones.
    let is_one_hue = one.is_grey || other.is_grey || one.index % 8 == other.index % 8;
    is_close && (is_one_hue || 16 <= one.index)
}

/// The slot of a colour's box, and the colour that stands for it.
fn slot(colour: [u8; 3]) -> (usize, [u8; 3]) {
    if is_grey(colour) {
        return (STEPS * STEPS * STEPS + usize::from(colour[0]), colour);
    }
    let boxes = colour.map(|channel| (usize::from(channel) + STEP / 2) / STEP);
    let [red, green, blue] = boxes;
    (
        (red * STEPS + green) * STEPS + blue,
        boxes.map(|at| (at * STEP) as u8),
    )
}

fn is_grey([red, green, blue]: [u8; 3]) -> bool {
    red == green && green == blue
}

/// The squared distance of two colours in `OkLab`.
fn squared(one: [f32; 3], other: [f32; 3], hue_weight: f32) -> f32 {
    let [lightness, a, b] = std::array::from_fn(|axis| (one[axis] - other[axis]).powi(2));
    lightness + hue_weight * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The levels of each channel in the 6×6×6 cube of the 256 colours.
    const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

    /// Red, green and blue of one of the 240 fixed colours.
    fn fixed_colour(index: u8) -> [u8; 3] {
        let at = index - 16;
        match index {
            // The ramp has 24 steps of ten from 8 to 238.
            232.. => [8 + 10 * (index - 232); 3],
            _ => [at / 36, at / 6 % 6, at % 6].map(|level| CUBE[usize::from(level)]),
        }
    }

    /// Maps an index to its colour.
    type Look = fn(u8) -> [u8; 3];

    fn palettes() -> [(Palette, Look); 2] {
        [
            (Palette::of_256(), fixed_colour),
            (Palette::of_16(), |index| THEME[usize::from(index)]),
        ]
    }

    /// A few thousand colours, none on a level of the cube.
    fn colours() -> impl Iterator<Item = [u8; 3]> {
        let level = |at: u32| (at * 17 + 3).min(255) as u8;
        (0..16 * 16 * 16).map(move |at| [level(at / 256), level(at / 16 % 16), level(at % 16)])
    }

    /// The mean colour of a tint, in `OkLab`.
    fn mean(tint: Tint, look: Look) -> [f32; 3] {
        let share = SHADES[usize::from(tint.shade)].1;
        let [ink, paper] = [tint.ink, tint.paper].map(|index| light(look(index)));
        oklab([0, 1, 2].map(|at| share * ink[at] + (1.0 - share) * paper[at]))
    }

    #[test]
    fn fixed_colours_are_mapped_to_themselves() {
        let mut palette = Palette::of_256();
        for index in 16..=255 {
            let colour = fixed_colour(index);
            assert_eq!(fixed_colour(palette.nearest(colour)), colour, "{index}");
            let tint = palette.tint(colour);
            assert_eq!(
                (fixed_colour(tint.paper), tint.shade),
                (colour, 0),
                "{index}"
            );
        }
    }

    #[test]
    fn greys_are_mixed_from_greys() {
        for (mut palette, look) in palettes() {
            for grey in 0..=255 {
                let tint = palette.tint([grey; 3]);
                for index in [palette.nearest([grey; 3]), tint.ink, tint.paper] {
                    assert!(is_grey(look(index)), "{grey}");
                }
            }
        }
    }

    #[test]
    fn flat_areas_stay_flat() {
        let mut palette = Palette::of_256();
        for colour in colours() {
            let tint = palette.tint(colour);
            let [ink, paper] =
                [tint.ink, tint.paper].map(|index| oklab(light(fixed_colour(index))));
            assert!((ink[0] - paper[0]).abs() < 0.06, "{colour:?}: {tint:?}");
        }
    }

    #[test]
    fn a_tint_is_closer_than_the_nearest_palette_colour() {
        for ((mut palette, look), part) in palettes().into_iter().zip([0.8, 0.8]) {
            let hue = palette.taste.hue;
            let (mut tinted, mut alone) = (0.0, 0.0);
            for colour in colours() {
                let lab = oklab(light(colour));
                tinted += squared(mean(palette.tint(colour), look), lab, hue).sqrt();
                let nearest = oklab(light(look(palette.nearest(colour))));
                alone += squared(nearest, lab, hue).sqrt();
            }
            assert!(tinted < part * alone, "{tinted} of {alone}");
        }
    }

    #[test]
    fn pale_and_dark_colours_keep_their_hue() {
        for (mut palette, look) in palettes() {
            for colour in [
                [50, 90, 125],
                [200, 60, 30],
                [90, 160, 80],
                [80, 60, 130],
                [60, 90, 80],
            ] {
                let [_, a, b] = oklab(light(colour));
                let [_, tinted_a, tinted_b] = mean(palette.tint(colour), look);
                assert!(0.0 < a * tinted_a + b * tinted_b, "{colour:?} lost its hue");
            }
        }
    }
}
