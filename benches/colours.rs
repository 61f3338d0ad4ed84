//! The error of pictures in few colours, compared with chafa.
//!
//! `cargo bench --bench colours` prints a table. For each scene and depth it has the error of a
//! pixel and of the mean light of 2×2 pixels, both as mean distances in `OkLab` times 1000, and the
//! mean step in luma, of 255, between neighbours in flat areas; for Halflight also the time of the
//! first and of later drawings in milliseconds. Without chafa only our own rows are printed. The
//! pictures are those in `scenes`; the 16 colours are xterm's. Without colours the error is that to
//! the greyscale picture, and a character emits light in proportion to its filled area.
//!
//! `cargo bench --bench colours -- DIR` also writes the pictures to a folder.

#[allow(dead_code, reason = "shared with the other bench")]
mod encoding;

use std::convert::Infallible;
use std::fs;
use std::num::NonZeroU16;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use halflight::render::{Frame, NO_OBJECT};
use halflight::scene::Size;
use halflight::ui::app::{CellImage, display};
use halflight::ui::msg::{Msg, Target};
use halflight::ui::terminal::{AnsiBackend, ColourDepth};
use halflight::ui::view::{self, Inks};
use vt100::{Cell, Color, Parser, Screen};

const SCENES: [&str; 5] = ["default", "courtyard", "glass", "mirrors", "still-life"];

/// The colour depths with chafa's names.
const DEPTHS: [(ColourDepth, &str); 3] = [
    (ColourDepth::Palette256, "256"),
    (ColourDepth::Palette16, "16"),
    (ColourDepth::Mono, "none"),
];

/// Columns and rows of the terminal.
const TERMINAL: (u16, u16) = (160, 62);

fn main() {
    let folder = std::env::args().skip(1).find(|arg| arg != "--bench");
    let folder = folder.map(PathBuf::from);
    println!("scene         colours  by      pixel    2x2   flat  first again");
    for scene in SCENES {
        for (depth, name) in DEPTHS {
            let (picture, ours, [first, again]) = ours(scene, depth);
            let theirs = chafa(&picture, name);
            let reference = match depth {
                ColourDepth::Mono => greys(&picture),
                _ => picture,
            };
            let times = format!(" {first:6.1} {again:5.1}");
            let drawn = [("ours", Some(ours), &*times), ("chafa", theirs, "")];
            for (by, quarters, times) in drawn {
                let Some(quarters) = quarters else {
                    continue;
                };
                let [pixel, block, flat] = errors(&reference, &quarters);
                println!("{scene:13} {name:8} {by:6} {pixel:6.1} {block:6.1} {flat:6.1}{times}");
                if let Some(folder) = &folder {
                    let path = folder.join(format!("{scene}-{name}-{by}.ppm"));
                    write(&path, 2 * reference.size.width, &quarters);
                }
            }
        }
    }
}

/// Writes a picture with rows of `width` pixels.
fn write(path: &Path, width: u32, pixels: &[[u8; 3]]) {
    let height = pixels.len() / width as usize;
    let mut file = format!("P6\n{width} {height}\n255\n").into_bytes();
    file.extend(pixels.iter().flatten());
    fs::write(path, file).expect("the folder is writable");
}

/// Returns a picture, the colours it is drawn in, 2×2 per cell, and the milliseconds that the first
/// and later drawings take.
fn ours(scene: &str, depth: ColourDepth) -> (CellImage, Vec<[u8; 3]>, [f64; 2]) {
    let (mut app, _) = encoding::opened(include_str!("../scenes/default.ray"), TERMINAL);
    let (cells, size) = app.shared.raster().expect("the picture has cells");
    let picture = read(scene).resampled(size);
    let frame = Frame {
        objects: picture.objects.clone(),
        ..Frame::drawn(size, picture.pixels.clone())
    };
    app.update(Msg::Frame(Target::Preview, Arc::new(frame)));
    let frame_window = display::frame_window(&app.shared).expect("the picture has cells");
    app.shared
        .picture_mut()
        .advance(&frame_window, &[], usize::MAX);
    let backend = AnsiBackend::new(depth, ratatui::layout::Size::from(TERMINAL));
    let Ok(mut terminal) = ratatui::terminal::Terminal::new(backend);
    let mut inks = Inks::for_depth(depth);
    let mut draw = || {
        let begun = Instant::now();
        let Ok(_) = terminal.draw(|frame| {
            view::draw(&app, &mut inks, frame);
        });
        1000.0 * begun.elapsed().as_secs_f64()
    };
    let first = draw();
    let again = (0..20).map(|_| draw()).fold(f64::INFINITY, f64::min);
    let mut parser = parser(TERMINAL);
    let Ok(_) = terminal.backend_mut().finish(|bytes| {
        parser.process(bytes);
        Ok::<_, Infallible>(())
    });
    let quarters = quarters(parser.screen(), (cells.x, cells.y), size);
    (picture, quarters, [first, again])
}

/// The colours of a picture drawn by chafa, if it is installed.
fn chafa(picture: &CellImage, colours: &str) -> Option<Vec<[u8; 3]>> {
    let Size { width, height } = picture.size;
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("colours.ppm");
    write(&path, width, &picture.pixels);
    let rows = height.div_ceil(2);
    let output = Command::new("chafa")
        .args(["--colors", colours, "--symbols", "half", "--stretch"])
        .args(["--size", &format!("{width}x{rows}")])
        .arg(&path)
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let mut parser = parser((width as u16, rows as u16 + 1));
    parser.process(text.replace('\n', "\r\n").as_bytes());
    Some(quarters(parser.screen(), (0, 0), picture.size))
}

/// Reads the rendered picture of a scene.
fn read(scene: &str) -> CellImage {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{scene}.bmp"));
    let bytes = fs::read(path).expect("the scene has a picture");
    let number = |at: usize| {
        let bytes = bytes[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(bytes)
    };
    let (start, width, height) = (number(10) as usize, number(18), number(22));
    let size = Size { width, height };
    let stride = (3 * width as usize).next_multiple_of(4);
    // Rows are stored bottom-up, pixels as BGR.
    let pixels = bytes[start..].chunks(stride).take(height as usize).rev();
    let pixels = pixels.flat_map(|row| row.chunks_exact(3).take(width as usize));
    CellImage {
        size,
        pixels: pixels.map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect(),
        objects: vec![NO_OBJECT; size.pixels()],
        outline: Vec::new(),
    }
}

fn parser((columns, rows): (u16, u16)) -> Parser {
    let cells = |cells| NonZeroU16::new(cells).expect("a screen has cells");
    Parser::new(cells(rows), cells(columns), 0)
}

/// The colours of the quarters of a picture's cells: its number of rows, and twice its columns.
fn quarters(screen: &Screen, (left, top): (u16, u16), size: Size) -> Vec<[u8; 3]> {
    let quarter = |x: u32, y: u32| {
        let cell = screen.cell(top + y as u16 / 2, left + x as u16 / 2);
        let cell = cell.expect("the picture is on the screen");
        let (upper, at_left) = (y.is_multiple_of(2), x.is_multiple_of(2));
        let filled = match cell.contents() {
            "▀" => f64::from(u8::from(upper)),
            "▄" => f64::from(u8::from(!upper)),
            "▌" => f64::from(u8::from(at_left)),
            "▐" => f64::from(u8::from(!at_left)),
            symbol => filled(symbol)[usize::from(!upper)],
        };
        between(colour(cell, false), colour(cell, true), filled)
    };
    let row = |y| (0..2 * size.width).map(move |x| quarter(x, y));
    (0..size.height).flat_map(row).collect()
}

/// The filled share of a character's upper and lower half, averaged over common fonts (`DejaVu`
/// Sans Mono, Noto Sans Mono).
fn filled(symbol: &str) -> [f64; 2] {
    match symbol {
        "" | " " => [0.0, 0.0],
        "." => [0.0, 0.043],
        "'" => [0.057, 0.0],
        ":" => [0.044, 0.043],
        "\"" => [0.113, 0.0],
        "=" => [0.106, 0.105],
        "%" => [0.189, 0.194],
        "░" => [0.25, 0.25],
        "▒" => [0.5, 0.5],
        "▓" => [0.75, 0.75],
        "█" => [1.0, 1.0],
        _ => panic!("unexpected character {symbol:?}"),
    }
}

/// Mixes two colours in linear light.
fn between(behind: [u8; 3], front: [u8; 3], share: f64) -> [u8; 3] {
    let (behind, front) = (light(behind), light(front));
    std::array::from_fn(|at| {
        let light = behind[at] + share * (front[at] - behind[at]);
        let value = if light <= 0.003_130_8 {
            12.92 * light
        } else {
            1.055 * light.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * value).round() as u8
    })
}

/// Converts a picture to greys of the same luminance.
fn greys(picture: &CellImage) -> CellImage {
    let grey = |&pixel: &[u8; 3]| {
        let [red, green, blue] = light(pixel);
        let luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        between([0; 3], [255; 3], luminance)
    };
    CellImage {
        pixels: picture.pixels.iter().map(grey).collect(),
        ..picture.clone()
    }
}

/// The colour of a cell's foreground or background.
fn colour(cell: &Cell, in_front: bool) -> [u8; 3] {
    match (in_front != cell.inverse(), cell.fgcolor(), cell.bgcolor()) {
        (true, Color::Idx(index), _) | (false, _, Color::Idx(index)) => of_palette(index),
        (true, Color::Rgb(r, g, b), _) | (false, _, Color::Rgb(r, g, b)) => [r, g, b],
        (true, Color::Default, _) => [255; 3],
        (false, _, Color::Default) => [0; 3],
    }
}

/// A colour of xterm's palette.
fn of_palette(index: u8) -> [u8; 3] {
    match index {
        4 => [0, 0, 238],
        7 => [229; 3],
        8 => [127; 3],
        12 => [92, 92, 255],
        0..16 => {
            let full = if index < 8 { 205 } else { 255 };
            [0, 1, 2].map(|bit| if index >> bit & 1 == 1 { full } else { 0 })
        }
        232.. => [8 + 10 * (index - 232); 3],
        _ => {
            let at = index - 16;
            [at / 36, at / 6 % 6, at % 6].map(|level| if level == 0 { 0 } else { 55 + 40 * level })
        }
    }
}

/// The errors of pixels and of 2×2 means, and the step in flat areas.
fn errors(picture: &CellImage, quarters: &[[u8; 3]]) -> [f64; 3] {
    let (width, height) = (picture.size.width as usize, picture.size.height as usize);
    let reference = |x: usize, y: usize| picture.pixels[y * width + x];
    let shown = |x: usize, y: usize| {
        let at = 2 * (y * width + x);
        [quarters[at], quarters[at + 1]]
    };
    let (mut pixel, mut block, mut flat) = (Mean::default(), Mean::default(), Mean::default());
    for y in 0..height {
        for x in 0..width {
            for half in shown(x, y) {
                pixel.add(distance(light(reference(x, y)), light(half)));
            }
            for (x2, y2) in [(x + 1, y), (x, y + 1)] {
                let is_flat = |one: [u8; 3], other: [u8; 3]| {
                    one.iter().zip(other).all(|(a, b)| a.abs_diff(b) <= 1)
                };
                if x2 < width && y2 < height && is_flat(reference(x, y), reference(x2, y2)) {
                    flat.add((luma(shown(x, y)[0]) - luma(shown(x2, y2)[0])).abs());
                }
            }
            if x + 1 < width && y + 1 < height {
                let points = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
                let whole = mean(points.map(|(x, y)| light(reference(x, y))));
                let drawn = mean(points.map(|(x, y)| mean(shown(x, y).map(light))));
                block.add(distance(whole, drawn));
            }
        }
    }
    [1000.0 * pixel.value(), 1000.0 * block.value(), flat.value()]
}

#[derive(Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    fn value(&self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}

fn mean<const N: usize>(colours: [[f64; 3]; N]) -> [f64; 3] {
    std::array::from_fn(|at| colours.iter().map(|colour| colour[at]).sum::<f64>() / N as f64)
}

fn luma([red, green, blue]: [u8; 3]) -> f64 {
    0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
}

fn light(colour: [u8; 3]) -> [f64; 3] {
    colour.map(|channel| {
        let value = f64::from(channel) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    })
}

/// The distance of two linear colours in `OkLab`.
fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    let (one, other) = (oklab(one), oklab(other));
    let squares = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

fn oklab(light: [f64; 3]) -> [f64; 3] {
    let times = |rows: [[f64; 3]; 3], of: [f64; 3]| {
        rows.map(|row| row[0] * of[0] + row[1] * of[1] + row[2] * of[2])
    };
    let cones = times(
        [
            [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9],
            [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6],
            [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5],
        ],
        light,
    );
    times(
        [
            [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
            [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
            [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
        ],
        cones.map(f64::cbrt),
    )
}
