//! Encoding of pictures without a terminal: from frame to bytes.

use std::convert::Infallible;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use crossterm::event::{KeyCode, KeyEvent};
use halflight::language::Language;
use halflight::render::{Frame, Job, Renderer, Threads};
use halflight::scene::Rendering;
use halflight::ui::app::{App, Opening, OpeningText, Preferences, display};
use halflight::ui::msg::{Effect, Msg, Target};
use halflight::ui::terminal::{AnsiBackend, ColourDepth, Mouse};
use halflight::ui::view::{self, Inks};
use ratatui::layout::Size;

/// The cost of drawing pictures.
pub(crate) struct Encoded {
    /// The time from each frame to its last byte.
    pub(crate) times: Vec<Duration>,
    /// The size of the last frame.
    pub(crate) bytes: usize,
}

/// Alternates full-screen pictures from a scene's camera and from farther away, which differ in
/// nearly every cell.
pub(crate) fn alternating(scene: &str, (columns, rows): (u16, u16), turns: usize) -> Encoded {
    let (mut app, job) = opened(scene, (columns, rows));
    let mut farther = job.clone();
    farther.camera.eye += 0.2 * (farther.camera.eye - farther.camera.target);
    show(&mut app, &[traced(job), traced(farther)], turns)
}

/// Like [`alternating`] with two pictures of noise, which take the most bytes.
pub(crate) fn noise(scene: &str, (columns, rows): (u16, u16), turns: usize) -> Encoded {
    let (mut app, job) = opened(scene, (columns, rows));
    let frame = traced(job);
    let noisy = |seed: u32| {
        let mut state = seed;
        let mut byte = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let mut noisy = Frame::clone(&frame);
        noisy.pixels.fill_with(|| [byte(), byte(), byte()]);
        Arc::new(noisy)
    };
    show(&mut app, &[noisy(1), noisy(2)], turns)
}

/// Returns the interface with only the picture on screen, and the job that traces it.
pub(crate) fn opened(scene: &str, terminal: (u16, u16)) -> (App, Job) {
    let (mut app, mut effects) = App::open(Opening {
        path: Some(PathBuf::from("scene.ray")),
        language: Language::Ray,
        text: OpeningText::Known(scene.to_owned()),
        rendering: Rendering {
            spp: Some(1),
            ..Rendering::default()
        },
        mouse: Mouse::On,
        preferences: Preferences::default(),
        recent: Vec::new(),
        terminal,
    });
    effects.extend(app.update(Msg::Key(KeyEvent::from(KeyCode::Char('z')))));
    let jobs = effects.into_iter().filter_map(|effect| match effect {
        Effect::Trace(Target::Preview, job) => Some(job),
        _ => None,
    });
    let mut job = jobs.last().expect("the scene is traced");
    job.settings.spp = 4;
    (app, job)
}

fn traced(job: Job) -> Arc<Frame> {
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Preview, move || {
        let _ = wake.send(());
    });
    renderer.restart(job).expect("the worker runs");
    loop {
        woken.recv().expect("the worker runs");
        match renderer.latest() {
            Some(frame) if frame.progress.complete => return frame,
            _ => {}
        }
    }
}

fn show(app: &mut App, frames: &[Arc<Frame>], turns: usize) -> Encoded {
    let (columns, rows) = app.shared.terminal;
    let depth = ColourDepth::TrueColour;
    let backend = AnsiBackend::new(depth, Size::new(columns, rows));
    let Ok(mut terminal) = ratatui::terminal::Terminal::new(backend);
    let mut inks = Inks::for_depth(depth);
    let mut sent = Vec::new();
    let mut times = Vec::new();
    for turn in 0..turns {
        let frame = Arc::clone(&frames[turn % frames.len()]);
        sent.clear();
        let begun = Instant::now();
        app.update(Msg::Frame(Target::Preview, frame));
        let frame_window = display::frame_window(&app.shared).expect("the picture has cells");
        app.shared
            .picture_mut()
            .advance(&frame_window, &[], usize::MAX);
        let Ok(_) = terminal.draw(|frame| {
            view::draw(app, &mut inks, frame);
        });
        let taken = terminal.backend_mut().finish(|bytes| {
            sent.extend_from_slice(bytes);
            Ok::<_, Infallible>(())
        });
        let Ok(_) = taken;
        // The first frames draw the whole screen, with cold memory.
        if 2 <= turn {
            times.push(begun.elapsed());
        }
    }
    Encoded {
        times,
        bytes: sent.len(),
    }
}
