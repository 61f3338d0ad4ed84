//! The program on a terminal. Its output is recorded with times and parsed only while the program
//! is at rest, so that parsing does not slow it down.

use std::path::Path;
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use halflight::scene::Size;
use halflight::ui::arrange::{Areas, PanelSizes, Shape, Zoom, arrange};
use halflight::ui::layout::raster;
use ratatui::layout::Rect;
use vt100::{Color, Screen};

use crate::harness::Session;

/// Columns and rows of the terminal.
pub(crate) const TERMINAL: (u16, u16) = (200, 50);

/// The scene, and the size of its picture.
const SCENE: &str = include_str!("../../scenes/default.ray");
const OUTPUT: Size = Size {
    width: 400,
    height: 300,
};

/// Longer than the time between two frames of a preview.
const QUIET: Duration = Duration::from_millis(800);

/// After this time a picture hardly changes any more.
const SETTLED: Duration = Duration::from_millis(800);

/// A picture that changes more than this shows something new; refining a settled picture changes it
/// less.
const NEW: f64 = 0.7;

/// The sequence that ends a frame.
const END: &[u8] = b"\x1b[?2026l";

/// A program on its own terminal, in its own folder with one scene.
pub(crate) struct Desk {
    session: Session,
    pub(crate) folder: tempfile::TempDir,
    tape: Vec<(Instant, Vec<u8>)>,
    screen: vt100::Parser,
    /// Bytes of the unfinished frame.
    open: Vec<u8>,
    seen: Seen,
}

/// A frame drawn by the program.
pub(crate) struct Drawn {
    /// When its last byte arrived.
    pub(crate) at: Instant,
    pub(crate) bytes: usize,
    /// The change of the picture: the mean difference of all channels, of 255.
    pub(crate) change: f64,
    /// Whether the list changed; likewise the fields.
    pub(crate) list: bool,
    pub(crate) fields: bool,
    /// The picture, two pixels per cell, upper first.
    pub(crate) pixels: Vec<[u8; 3]>,
    /// The characters on the screen.
    pub(crate) text: String,
}

#[derive(Default, PartialEq)]
struct Seen {
    pixels: Vec<[u8; 3]>,
    list: Vec<(String, Color, Color)>,
    fields: Vec<(String, Color, Color)>,
}

impl Drawn {
    /// Whether the picture changed at all.
    pub(crate) fn is_picture(&self) -> bool {
        0.0 < self.change
    }

    /// Whether the picture shows something new, if it had settled before.
    pub(crate) fn is_new_picture(&self) -> bool {
        NEW <= self.change
    }
}

impl Desk {
    /// Starts the program on the scene. Returns the time before the start.
    pub(crate) fn open(arguments: &[&str], environment: &[(&str, &str)]) -> (Self, Instant) {
        Self::open_files(&[("scene.ray", SCENE)], arguments, environment)
    }

    /// Starts the program on the first of some files, whose picture must have the usual size.
    pub(crate) fn open_files(
        files: &[(&str, &str)],
        arguments: &[&str],
        environment: &[(&str, &str)],
    ) -> (Self, Instant) {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, content) in files {
            std::fs::write(folder.path().join(name), content).expect("the folder is writable");
        }
        Self::start(folder, files[0].0, arguments, environment)
    }

    /// Starts the program on a scene in place, whose picture must have the usual aspect ratio.
    pub(crate) fn open_scene(scene: &Path) -> (Self, Instant) {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = scene.to_str().expect("the path is UTF-8");
        Self::start(folder, scene, &[], &[])
    }

    fn start(
        folder: tempfile::TempDir,
        scene: &str,
        arguments: &[&str],
        environment: &[(&str, &str)],
    ) -> (Self, Instant) {
        let mut all = vec![scene, "--color", "24"];
        all.extend(arguments);
        let begun = Instant::now();
        let session = Session::start(folder.path(), &all, TERMINAL, environment);
        let cells = |cells| std::num::NonZeroU16::new(cells).expect("a screen has cells");
        let desk = Self {
            session,
            folder,
            tape: Vec::new(),
            screen: vt100::Parser::new(cells(TERMINAL.1), cells(TERMINAL.0), 0),
            open: Vec::new(),
            seen: Seen::default(),
        };
        (desk, begun)
    }

    /// Like [`Desk::open`], with the picture at rest.
    pub(crate) fn at_rest(arguments: &[&str], environment: &[(&str, &str)]) -> Self {
        let mut desk = Self::open(arguments, environment).0;
        desk.rest();
        desk.look();
        desk
    }

    /// Types keys and returns the time.
    pub(crate) fn press(&mut self, keys: &str) -> Instant {
        let at = Instant::now();
        self.session.send(keys);
        at
    }

    /// Types keys at intervals of `apart` and returns their times.
    pub(crate) fn press_all<'k>(
        &mut self,
        keys: impl IntoIterator<Item = &'k str>,
        apart: Duration,
    ) -> Vec<Instant> {
        let mut next = Instant::now();
        let mut pressed = Vec::new();
        for key in keys {
            pressed.push(self.press(key));
            next += apart;
            self.record(next);
        }
        pressed
    }

    /// Records output until a given time.
    pub(crate) fn record(&mut self, until: Instant) {
        loop {
            let timeout = until.saturating_duration_since(Instant::now());
            match self.session.take(timeout) {
                Ok(piece) => self.tape.push(piece),
                Err(RecvTimeoutError::Timeout) => return,
                Err(RecvTimeoutError::Disconnected) => panic!("the program has ended"),
            }
        }
    }

    /// Records output until the program is silent.
    pub(crate) fn rest(&mut self) {
        while let Ok(piece) = self.session.take(QUIET) {
            self.tape.push(piece);
        }
    }

    /// Types keys, waits until the program is silent, and returns the frames it drew.
    pub(crate) fn answer(&mut self, keys: &str) -> (Instant, Vec<Drawn>) {
        let at = self.press(keys);
        self.rest();
        (at, self.look())
    }

    /// Records output until the picture has settled, and returns all frames.
    pub(crate) fn settle(&mut self) -> Vec<Drawn> {
        self.record(Instant::now() + SETTLED);
        self.look()
    }

    /// Parses the recorded output into frames.
    pub(crate) fn look(&mut self) -> Vec<Drawn> {
        let mut drawn = Vec::new();
        for (at, piece) in std::mem::take(&mut self.tape) {
            self.open.extend(piece);
            let ends = |open: &[u8]| open.windows(END.len()).position(|part| part == END);
            while let Some(end) = ends(&self.open) {
                let frame: Vec<u8> = self.open.drain(..end + END.len()).collect();
                self.screen.process(&frame);
                drawn.push(self.drawn(at, frame.len()));
            }
        }
        drawn
    }

    fn drawn(&mut self, at: Instant, bytes: usize) -> Drawn {
        let screen = self.screen.screen();
        let areas = areas(Zoom::Panels);
        let seen = Seen {
            pixels: pixels(screen, picture_cells(Zoom::Panels)),
            list: cells(screen, areas.list),
            fields: cells(screen, areas.fields),
        };
        let before = std::mem::replace(&mut self.seen, seen);
        let seen = &self.seen;
        Drawn {
            at,
            bytes,
            change: difference(&before.pixels, &seen.pixels),
            list: before.list != seen.list,
            fields: before.fields != seen.fields,
            pixels: seen.pixels.clone(),
            text: screen.contents(),
        }
    }

    /// The CPU time of the program so far, over all threads.
    pub(crate) fn processor_time(&self) -> Duration {
        let tasks = format!("/proc/{}/task", self.session.process_id());
        let tasks = std::fs::read_dir(tasks).expect("the program runs");
        let spent = tasks.map(|task| {
            let path = task.expect("a thread").path().join("schedstat");
            let stat = std::fs::read_to_string(path).unwrap_or_default();
            stat.split(' ')
                .next()
                .and_then(|time| time.parse().ok())
                .unwrap_or(0)
        });
        Duration::from_nanos(spent.sum())
    }
}

/// The mean difference of two pictures over all channels.
pub(crate) fn difference(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let channels = a.as_flattened().iter().zip(b.as_flattened());
    let sum: u64 = channels.map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / (3 * a.len().max(1)) as f64
}

/// The cells of the picture.
pub(crate) fn picture_cells(zoom: Zoom) -> Rect {
    raster(areas(zoom).picture, OUTPUT)
        .expect("the picture has cells")
        .0
}

fn areas(zoom: Zoom) -> Areas {
    let shape = Shape {
        zoom,
        output: OUTPUT,
        fields: 0,
        lines: 20,
        explains: false,
        panels: PanelSizes::default(),
    };
    arrange(Rect::new(0, 0, TERMINAL.0, TERMINAL.1), &shape)
}

/// The pixels shown by half blocks: different characters may look the same.
fn pixels(screen: &Screen, area: Rect) -> Vec<[u8; 3]> {
    let rgb = |colour| match colour {
        Color::Rgb(red, green, blue) => [red, green, blue],
        _ => [0; 3],
    };
    cells(screen, area)
        .into_iter()
        .flat_map(|(symbol, fg, bg)| match symbol.as_str() {
            "▀" => [fg, bg],
            "▄" => [bg, fg],
            "█" => [fg, fg],
            _ => [bg, bg],
        })
        .map(rgb)
        .collect()
}

fn cells(screen: &Screen, area: Rect) -> Vec<(String, Color, Color)> {
    let cell = |at: ratatui::layout::Position| {
        let cell = screen.cell(at.y, at.x).expect("the area is on the screen");
        let (fg, bg) = if cell.inverse() {
            (cell.bgcolor(), cell.fgcolor())
        } else {
            (cell.fgcolor(), cell.bgcolor())
        };
        (cell.contents().to_owned(), fg, bg)
    };
    area.positions().map(cell).collect()
}
