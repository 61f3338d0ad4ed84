//! The two lines as they are drawn.

use std::sync::Arc;
use std::time::Duration;

use tui_input::Input;

use super::*;
use crate::app::{Picture, Prompt, PromptKind, ShownWireframe, Typing};
use crate::keymap::bound;
use crate::layout::tests::size;
use crate::view::tests::{Change, app, app_of, drawn, retype, say};
use language::Language;
use render::{Aov, Frame, Progress};
use scene::{Integrator, Rendering};

/// The status line of a wide screen.
fn line(app: &App) -> String {
    drawn(app, bar, 200, 1).concat()
}

fn bar(app: &App, area: Rect, buffer: &mut Buffer) {
    render(app, ColourDepth::TrueColour, area, buffer);
}

#[test]
fn the_least_important_segments_are_omitted() {
    let mut app = app();
    retype(&mut app, " 0.25 //", " 0.5 //");
    say(&mut app, None, "took the file's changes");
    for (width, line) in [
        (60, " SELECT  test.ray [+]  took the file's changes"),
        (40, " SELECT  [+]  took the file's changes"),
        (25, " SELECT  test.ray [+]"),
        (5, " SEL…"),
    ] {
        assert_eq!(drawn(&app, bar, width, 1), [line]);
    }
    app.shared.disk.state = OnDisk::Unreadable;
    let line = " SELECT  [+]  [cannot read file]";
    assert_eq!(drawn(&app, bar, 40, 1), [line]);
}

#[test]
fn an_integrator_that_differs_from_the_scenes_has_a_star() {
    let mut app = app();
    let changes: [(Change, &str); 4] = [
        (|_| {}, "whitted"),
        (
            |app| app.shared.pictures.rendering.integrator = Some(Integrator::Path),
            "path*",
        ),
        (|app| app.shared.pictures.aov = Some(Aov::Depth), "depth"),
        (
            |app| app.shared.pictures.wireframe = Some(ShownWireframe::default()),
            "wireframe",
        ),
    ];
    for (change, words) in changes {
        change(&mut app);
        assert_eq!(line(&app), format!(" SELECT  test.ray  {words}"));
    }
    let paths = "<xml><scene/><camera gamma='sRGB'/></xml>";
    let app = app_of(Language::Xml, paths);
    assert_eq!(line(&app), " SELECT  test.xml  1 warning  path");
}

#[test]
fn settings_that_bias_the_picture_are_named() {
    let mut app = app();
    for (noise, clamp, words) in table! {
        Some(0.01), None => "whitted  adaptive, slightly biased";
        None, Some(2.0) => "whitted  clamped, biased";
        // 0 turns it off.
        None, Some(0.0) => "whitted";
    } {
        app.shared.pictures.rendering = Rendering {
            noise,
            clamp,
            ..Rendering::default()
        };
        assert_eq!(line(&app), format!(" SELECT  test.ray  {words}"));
    }
}

#[test]
fn progress_is_shown_until_the_picture_is_complete() {
    let complete = Frame::drawn(size(1, 1), Vec::new()).progress;
    let traced = Progress {
        spp: 2,
        mean_spp: 2.0,
        done: 0.25,
        elapsed: Duration::from_millis(1500),
        rays: 21_000_000,
        noise: Some(0.0134),
        ..complete
    };
    let adaptive = Progress {
        spp: 256,
        mean_spp: 41.3,
        ..complete
    };
    // A quarter took 1.5 s, so three more take 4.5 s; 21 million in 1.5 s are 14 million per
    // second.
    for (progress, words) in table! {
        Progress { pass: 3, passes: 6, complete: false, ..traced }
            => "pass 3/6 · 2 spp · 25 % · noise 1.3 % · 1.5 s · ETA 4.5 s · 14 Mray/s";
        traced => "2 spp · noise 1.3 % · 1.5 s · 14 Mray/s";
        adaptive => "preview 41 of 256 spp";
    } {
        let mut app = app();
        let drawn = Frame::drawn(size(1, 1), vec![[0; 3]]);
        app.shared.picture_mut().wanted = Some(drawn.generation);
        app.shared
            .picture_mut()
            .take(Arc::new(Frame { progress, ..drawn }));
        let shown = format!(" SELECT  test.ray  {words} · whitted  1×1  24-bit");
        assert_eq!(line(&app), shown);
    }
}

#[test]
fn the_scale_and_a_pause_are_told() {
    let mut app = app();
    assert_eq!(line(&app), " SELECT  test.ray  whitted");
    app.shared.mode = Mode::Trace;
    app.shared.pictures.trace = Some(Picture::default());
    assert_eq!(line(&app), " TRACE  test.ray  whitted  fit");
    app.shared.picture_mut().paused = true;
    assert_eq!(line(&app), " TRACE  test.ray   PAUSED   whitted  fit");
}

#[test]
fn a_trace_in_the_background_is_told_while_it_goes_on() {
    let mut app = app();
    let traced = Frame::drawn(size(1, 1), vec![[0; 3]]);
    let mut trace = Picture::default();
    trace.wanted = Some(traced.generation);

    for (paused, complete, words) in [
        (false, false, "  trace 45 %"),
        (true, false, "  trace paused, 45 %"),
        (false, true, ""),
    ] {
        let progress = Progress {
            done: 0.45,
            complete,
            ..traced.progress
        };
        trace.take(Arc::new(Frame {
            progress,
            ..traced.clone()
        }));
        trace.paused = paused;
        app.shared.pictures.trace = Some(trace);
        let expected = format!(" SELECT  test.ray{words}  whitted");
        assert_eq!(line(&app), expected);
        trace = app.shared.pictures.trace.take().expect("it is there");
    }
}

#[test]
fn hints_for_help_commands_and_quitting_outlast_all_others() {
    let mut app = app();
    let hint = |app: &App, width| drawn(app, render_hint, width, 1).concat();
    for (width, shown) in [
        (
            140,
            " j/k select  Enter edit  a add  v camera  i inspect  / filter  W where  F5 trace  b export",
        ),
        (80, " Enter edit  a add  i inspect  F5 trace  b export "),
        (60, " Enter edit  i inspect  F5 trace  b export "),
        (40, " Enter edit  i inspect"),
        (20, ""),
    ] {
        let hint = hint(&app, width);
        assert!(hint.starts_with(shown), "{width}: {hint}");
        let end = if width < 80 {
            " ? help  : q"
        } else {
            "? help  : command  q quit"
        };
        assert!(hint.ends_with(end), "{width}: {hint}");
    }
    assert_eq!(hint(&app, 11).trim(), "? : q");
    // What is unsaved and what is wrong take the place of what is less pressing.
    retype(&mut app, " 0.25 //", " -0.25 //");
    let pressing = [
        "i inspect",
        "F5 trace",
        "b export",
        "w save",
        "! errors",
        "? help",
    ];
    for width in [80, 76] {
        let hint = hint(&app, width);
        let is_shown = pressing.iter().all(|words| hint.contains(words));
        assert!(is_shown, "{width}: {hint}");
    }
    app.shared.cursor.typing = Some(Typing::default());
    assert!(hint(&app, 80).starts_with(" Enter keep  Esc cancel  Tab keep, next number"));
    assert_eq!(hint(&app, 30), " Enter keep  Esc cancel");
    app.shared.overlays.prompt = Some(Prompt {
        kind: PromptKind::Command,
        is_selected: false,
        input: Input::new("export a.bmp".to_owned()),
        opened: String::new(),
    });
    // A prompt replaces the keys.
    assert_eq!(hint(&app, 80), ":export a.bmp");
}

#[test]
fn messages_that_wait_are_counted_beside_the_key_that_lists_them() {
    let mut app = app();
    for text in ["one", "another"] {
        app.shared.say(text);
    }
    assert_eq!(line(&app), " SELECT  test.ray  whitted  one (+1, M)");
    app.shared.keymap = bound("anywhere Q=messages");
    assert_eq!(line(&app), " SELECT  test.ray  whitted  one (+1, Q)");
}
