//! What pictures are drawn with, measured at the terminal: for each choice of `--pixels` the bytes
//! of a whole screen, the time until the last of them, and how close cells come to the picture.
//!
//! `cargo bench --bench pixels` prints the table for `scenes/default.ray`, cropped to the screen so
//! that the picture fills all lines but the last two. The terminal has cells of 8×16 pixels. PSNR is
//! taken against the picture traced at 12×24 pixels a cell, a multiple of all divisions of cells.

#[allow(
    dead_code,
    unreachable_pub,
    reason = "shared with tests, which use other parts"
)]
#[path = "../tests/harness/mod.rs"]
mod harness;

use std::process::Command;
use std::time::{Duration, Instant};

use halflight::ui::view::Mosaic;
use image::RgbImage;
use vt100::{Color, Screen};

use harness::{CTRL_L, Session};

/// Columns and rows of the terminals.
const TERMINALS: [(u16, u16); 2] = [(100, 30), (200, 50)];
/// Lines of text below the picture.
const BELOW: u16 = 2;
/// Pixels of the reference across and down a cell.
const FINE: (u32, u32) = (12, 24);
/// What pixels are drawn with.
const CHOICES: [&str; 7] = [
    "half", "quadrant", "sextant", "octant", "kitty", "iterm", "sixel",
];
const REDRAWS: usize = 9;
/// Longer than the time between two frames.
const QUIET: Duration = Duration::from_millis(800);

fn main() {
    println!(
        "{:<10} {:<10} {:>10} {:>10} {:>8} {:>8}",
        "terminal", "pixels", "bytes", "per cell", "ms", "PSNR dB"
    );
    for terminal in TERMINALS {
        let folder = tempfile::tempdir().expect("a folder");
        let (columns, rows) = terminal;
        let lines = rows - BELOW;
        let scene = include_str!("../scenes/default.ray");
        let size = format!("size {} {}", 8 * columns, 16 * lines);
        let scene = scene.replace("size 400 300", &size);
        std::fs::write(folder.path().join("scene.ray"), scene).expect("the folder is writable");
        let size = format!(
            "{}x{}",
            FINE.0 * u32::from(columns),
            FINE.1 * u32::from(lines)
        );
        let rendered = Command::new(env!("CARGO_BIN_EXE_halflight"))
            .args(["render", "scene.ray", "-o", "fine.png", "--spp", "4"])
            .args(["--size", &size])
            .current_dir(folder.path())
            .status();
        assert!(rendered.expect("the program starts").success());
        let fine = image::open(folder.path().join("fine.png")).expect("a picture");
        let fine = fine.to_rgb8();
        for choice in CHOICES {
            let arguments = ["scene.ray", "--color", "24", "--pixels", choice];
            let mut session = Session::start(folder.path(), &arguments, terminal, &[]);
            // The size of cells, and no more.
            session.send("\x1b[6;16;8t\x1b[?62c");
            session.send("z");
            session.wait_for(" spp");
            session.wait("waiting for the finished picture", |screen| {
                !screen.contents().contains("pass ")
            });
            session.drain(QUIET);
            let mut times = Vec::new();
            let mut bytes = 0;
            for _ in 0..REDRAWS {
                let from = session.written.len();
                let begun = Instant::now();
                session.send(CTRL_L);
                let mut end = begun;
                while let Some(at) = session.read(QUIET) {
                    end = at;
                }
                times.push((end - begun).as_secs_f64() * 1e3);
                bytes = session.written.len() - from;
            }
            times.sort_by(f64::total_cmp);
            let cells = u32::from(columns) * u32::from(lines);
            let psnr = shown(session.screen(), (columns, lines))
                .map_or_else(|| "-".into(), |shown| format!("{:.2}", psnr(&shown, &fine)));
            println!(
                "{:<10} {:<10} {bytes:>10} {:>10.1} {:>8.1} {psnr:>8}",
                format!("{columns}x{rows}"),
                choice,
                bytes as f64 / f64::from(cells),
                times[REDRAWS / 2],
            );
            session.send("q");
            session.end();
        }
    }
}

/// The picture that a screen's characters show, at the size of the reference; `None` if any is no
/// block.
fn shown(screen: &Screen, (columns, lines): (u16, u16)) -> Option<RgbImage> {
    let (width, height) = (u32::from(columns) * FINE.0, u32::from(lines) * FINE.1);
    let mut picture = RgbImage::new(width, height);
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let cell = screen.cell((y / FINE.1) as u16, (x / FINE.0) as u16)?;
        let character = cell.contents().chars().next().unwrap_or(' ');
        let (mosaic, pattern) = Mosaic::of(character)?;
        let (across, down) = mosaic.grid();
        let column = x % FINE.0 * u32::from(across) / FINE.0;
        let row = y % FINE.1 * u32::from(down) / FINE.1;
        let is_ink = pattern >> (row * u32::from(across) + column) & 1 == 1;
        let colour = if is_ink == cell.inverse() {
            cell.bgcolor()
        } else {
            cell.fgcolor()
        };
        let Color::Rgb(red, green, blue) = colour else {
            return None;
        };
        pixel.0 = [red, green, blue];
    }
    Some(picture)
}

/// The peak signal-to-noise ratio of 8-bit pictures, in dB.
fn psnr(a: &RgbImage, b: &RgbImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let squares: u64 = a
        .iter()
        .zip(b.iter())
        .map(|(a, b)| u64::from(a.abs_diff(*b)).pow(2))
        .sum();
    10.0 * (255.0 * 255.0 * a.len() as f64 / squares as f64).log10()
}
