//! Tests of the interface: keys, pastes and files in; text, state and effects out.

mod actions;
mod comparing;
mod dat;
mod display;
mod edit;
mod exports;
mod files;
mod hints;
mod inspecting;
mod messages;
mod palette;
mod panels;
mod rebinding;
mod samples;
mod scripts;
mod select;
mod sequence;
mod text;
mod timeline;
mod transforming;
mod tutor;
mod views;
mod xml;

use std::path::{Path, PathBuf};
use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::app::*;
use crate::keymap::{self, Mode};
use crate::msg::{Effect, ExportId, Exported, Msg, Target};
use crate::scene_reading::Reading;
use crate::terminal::Mouse;
use file::Version;
use language::Language;
use render::{Frame, Job, Overexposure, Progress};
use scene::{Rendering, Size};

/// Two spheres, far apart, without a view comment.
const SCENE: &str = "\
0.1 0.1 0.1
1
5 5 5 // the light
1 1 1
2
sphere
0 0 0
1.5 // the radius
.1 .1 .1 .45 .45 .45 .5 .5 .5
5 0.50 0 1
sphere
4 0 0
1
.1 .1 .1 .45 .45 .45 .5 .5 .5
5 0 0 1
";

/// A scene in each language.
const SCENES: [(&str, &str); 3] = [
    ("scene.ray", SCENE),
    ("scene.dat", dat::SCENE),
    ("scene.xml", include_str!("../../../../scenes/spheres.xml")),
];

/// Opens the interface with the cursor on the first row of the list.
pub(in crate::app) fn open(text: &str) -> App {
    let mut app = opened(text).0;
    press(&mut app, "ggj");
    app
}

fn opened(text: &str) -> (App, Vec<Effect>) {
    opened_as("scene.ray", text)
}

fn opened_as(name: &str, text: &str) -> (App, Vec<Effect>) {
    App::open(opening_as(name, text.to_owned()))
}

fn opening_as(name: &str, text: String) -> Opening {
    Opening {
        path: Some(PathBuf::from(name)),
        language: Language::of_path(Path::new(name)).expect("a scene's name"),
        text: OpeningText::Known(text),
        rendering: Rendering {
            spp: Some(4),
            ..Rendering::default()
        },
        mouse: Mouse::On,
        preferences: Preferences::default(),
        recent: Vec::new(),
        terminal: (120, 40),
    }
}

/// Parses keys: characters, or names such as in `jje<Right><Shift-Right><Ctrl-r>`.
fn keys(said: &str) -> Vec<KeyEvent> {
    let mut events = Vec::new();
    let mut rest = said;
    while let Some(first) = rest.chars().next() {
        if let Some((name, after)) = rest.strip_prefix('<').and_then(|r| r.split_once('>')) {
            events.push(named(name));
            rest = after;
        } else {
            events.push(KeyEvent::from(KeyCode::Char(first)));
            rest = &rest[first.len_utf8()..];
        }
    }
    events
}

fn named(name: &str) -> KeyEvent {
    for (prefix, modifier) in [
        ("Shift-", KeyModifiers::SHIFT),
        ("Ctrl-", KeyModifiers::CONTROL),
        ("Alt-", KeyModifiers::ALT),
    ] {
        if let Some(rest) = name.strip_prefix(prefix) {
            return KeyEvent::new(named(rest).code, modifier);
        }
    }
    KeyEvent::from(match name {
        "Right" => KeyCode::Right,
        "Left" => KeyCode::Left,
        "Down" => KeyCode::Down,
        "Up" => KeyCode::Up,
        "PageDown" => KeyCode::PageDown,
        "PageUp" => KeyCode::PageUp,
        "Enter" => KeyCode::Enter,
        "Esc" => KeyCode::Esc,
        "Tab" => KeyCode::Tab,
        "Back" => KeyCode::Backspace,
        "F5" => KeyCode::F(5),
        "Space" => KeyCode::Char(' '),
        "Lt" => KeyCode::Char('<'),
        one => KeyCode::Char(one.chars().next().expect("a key has a name")),
    })
}

/// Presses keys; returns their effects except requests for names to complete.
fn press(app: &mut App, said: &str) -> Vec<Effect> {
    let mut effects = press_all(app, said);
    effects.retain(|effect| !matches!(effect, Effect::ListFolder(_)));
    effects
}

fn press_all(app: &mut App, said: &str) -> Vec<Effect> {
    let keys = keys(said);
    keys.into_iter()
        .flat_map(|key| app.update(Msg::Key(key)))
        .collect()
}

/// The newest message, unless all have been dismissed.
fn words(app: &App) -> &str {
    let messages = &app.shared.overlays.messages;
    let newest = match messages.waiting() {
        0 => app.shared.overlays.message.as_ref(),
        _ => messages.past().next(),
    };
    newest.map_or("", |message| &message.text)
}

/// The message in the status line.
fn shown(app: &App) -> &str {
    let message = app.shared.overlays.message.as_ref();
    message.map_or("", |message| &message.text)
}

/// A frame of grey pixels that belong to these objects.
pub(crate) fn frame_of(size: Size, objects: Vec<u32>) -> Frame {
    Frame {
        generation: 1,
        size,
        corner: [0; 2],
        pixels: vec![[9; 3]; size.pixels()],
        objects,
        values: Vec::new(),
        denoised: Vec::new(),
        errors: Vec::new(),
        range: None,
        overexposure: Overexposure::default(),
        progress: Progress {
            pass: 1,
            passes: 1,
            spp: 1,
            mean_spp: 1.0,
            done: 1.0,
            elapsed: Duration::ZERO,
            rays: 1,
            shadow_rays: 0,
            over_budget: 0,
            noise: None,
            complete: true,
        },
        query: None,
    }
}

/// The message that a picture was written.
fn exported(id: ExportId, path: impl Into<PathBuf>, version: Option<Version>) -> Msg {
    let path = path.into();
    Msg::Exported(id, Ok(Exported { path, version }))
}

/// The picture that an effect starts to trace, and its job.
fn traced_by(effect: &Effect) -> Option<(Target, &Job)> {
    match effect {
        Effect::Trace(target, job) => Some((*target, job)),
        Effect::Recall(job, _, _) => Some((Target::Trace, job)),
        _ => None,
    }
}

/// Numbers below a bound, the same in every run.
fn random(seed: u64) -> impl FnMut(usize) -> usize {
    let mut state = seed;
    move |bound| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % bound
    }
}
