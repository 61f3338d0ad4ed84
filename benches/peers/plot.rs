//! Plots with logarithmic axes as PNG.

use std::ops::Range;
use std::path::Path;

use image::{Rgb, RgbImage};

/// A named line through points.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) name: &'static str,
    pub(crate) points: Vec<(f64, f64)>,
}

const WIDTH: u32 = 960;
const HEIGHT: u32 = 640;

/// The margin around the axes, in pixels.
const MARGIN: f64 = 80.0;

/// The edge length of a letter's dot, in pixels.
const DOT: u32 = 3;

const WHITE: Rgb<u8> = Rgb([255; 3]);
const GRID: Rgb<u8> = Rgb([220; 3]);
const BLACK: Rgb<u8> = Rgb([0; 3]);

/// Colours that are distinct with colour vision deficiencies too (Okabe and Ito).
const COLOURS: [Rgb<u8>; 5] = [
    Rgb([0, 114, 178]),
    Rgb([213, 94, 0]),
    Rgb([0, 158, 115]),
    Rgb([204, 121, 167]),
    Rgb([120, 120, 120]),
];

/// Digits, then letters: five rows of three dots each, one octal digit per row.
const LETTERS: [u16; 36] = [
    0o75557, 0o26227, 0o71747, 0o71717, 0o55711, 0o74717, 0o74757, 0o71122, 0o75757, 0o75717,
    0o25755, 0o65656, 0o34443, 0o65556, 0o74647, 0o74644, 0o34553, 0o55755, 0o72227, 0o11152,
    0o55655, 0o44447, 0o57755, 0o65555, 0o25552, 0o65644, 0o25563, 0o65655, 0o34216, 0o72222,
    0o55557, 0o55552, 0o55775, 0o55255, 0o55222, 0o71247,
];

/// Draws series and their names on a log-log plot; points that are not positive are skipped.
pub(crate) fn draw(path: &Path, across: &str, up: &str, series: &[Series]) {
    let is_shown = |&&(x, y): &&(f64, f64)| 0.0 < x && 0.0 < y;
    let points = || {
        series
            .iter()
            .flat_map(|series| &series.points)
            .filter(is_shown)
    };
    let decades_across = decades(points().map(|point| point.0));
    let decades_up = decades(points().map(|point| point.1));
    let position = |x: f64, y: f64| {
        let share = |value: f64, decades: &Range<i32>| {
            (value.log10() - f64::from(decades.start)) / f64::from(decades.end - decades.start)
        };
        let (width, height) = (
            f64::from(WIDTH) - 2.0 * MARGIN,
            f64::from(HEIGHT) - 2.0 * MARGIN,
        );
        let left = MARGIN + width * share(x, &decades_across);
        (left, MARGIN + height * (1.0 - share(y, &decades_up)))
    };
    let mut image = RgbImage::from_pixel(WIDTH, HEIGHT, WHITE);
    let [low, high] = [decades_up.start, decades_up.end].map(|decade| 10f64.powi(decade));
    for decade in decades_across.start..=decades_across.end {
        let x = 10f64.powi(decade);
        let (left, bottom) = position(x, low);
        line(&mut image, (left, bottom), position(x, high), GRID);
        write(
            &mut image,
            (left - 10.0, bottom + 10.0),
            &power(decade),
            BLACK,
        );
    }
    let [first, last] = [decades_across.start, decades_across.end].map(|decade| 10f64.powi(decade));
    for decade in decades_up.start..=decades_up.end {
        let y = 10f64.powi(decade);
        let (left, top) = position(first, y);
        line(&mut image, (left, top), position(last, y), GRID);
        write(&mut image, (8.0, top - 7.0), &power(decade), BLACK);
    }
    write(
        &mut image,
        (f64::from(WIDTH) / 2.0, f64::from(HEIGHT) - 36.0),
        across,
        BLACK,
    );
    write(&mut image, (8.0, 24.0), up, BLACK);
    for (at, (series, colour)) in series.iter().zip(COLOURS).enumerate() {
        let shown: Vec<_> = series.points.iter().filter(is_shown).collect();
        for pair in shown.windows(2) {
            let &[&(x, y), &(next, later)] = pair else {
                continue;
            };
            line(&mut image, position(x, y), position(next, later), colour);
        }
        let top = MARGIN + 12.0 + 24.0 * at as f64;
        write(&mut image, (MARGIN + 12.0, top), series.name, colour);
    }
    image.save(path).expect("the scratch folder is writable");
}

/// The exponents of the decades that contain all values, at least one decade.
fn decades(values: impl Iterator<Item = f64>) -> Range<i32> {
    let around = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
    let (low, high) = values.fold((f64::INFINITY, 0.0), around);
    if high <= 0.0 {
        return 0..1;
    }
    let low = low.log10().floor() as i32;
    low..(high.log10().ceil() as i32).max(low + 1)
}

/// The label of a power of ten.
fn power(decade: i32) -> String {
    if (0..4).contains(&decade) {
        10_i32.pow(decade as u32).to_string()
    } else {
        format!("1e{decade}")
    }
}

fn line(image: &mut RgbImage, from: (f64, f64), to: (f64, f64), colour: Rgb<u8>) {
    let steps = (to.0 - from.0)
        .abs()
        .max((to.1 - from.1).abs())
        .ceil()
        .max(1.0);
    for step in 0..=steps as u32 {
        let share = f64::from(step) / steps;
        let (x, y) = (
            from.0 + share * (to.0 - from.0),
            from.1 + share * (to.1 - from.1),
        );
        square(image, (x, y), 2, colour);
    }
}

/// Writes a word of digits, letters and minus signs; other characters are blank.
fn write(image: &mut RgbImage, (left, top): (f64, f64), word: &str, colour: Rgb<u8>) {
    for (at, letter) in word.chars().enumerate() {
        let dots = match letter.to_digit(36) {
            Some(digit) => LETTERS[digit as usize],
            None if letter == '-' => 0o00700,
            None => 0,
        };
        for dot in (0..15).filter(|dot| dots >> (14 - dot) & 1 == 1) {
            let x = left + f64::from(DOT * (dot % 3)) + f64::from(4 * DOT) * at as f64;
            square(image, (x, top + f64::from(DOT * (dot / 3))), DOT, colour);
        }
    }
}

fn square(image: &mut RgbImage, (x, y): (f64, f64), edge: u32, colour: Rgb<u8>) {
    for (column, row) in (0..edge * edge).map(|at| (at % edge, at / edge)) {
        // The cast clamps coordinates left of or above the picture to its edge.
        if let Some(pixel) = image.get_pixel_mut_checked(x as u32 + column, y as u32 + row) {
            *pixel = colour;
        }
    }
}
