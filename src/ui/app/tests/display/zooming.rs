//! Zooming and panning, regions, pauses, and the ends of traces.

use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::rows::{ray, scripts};
use super::*;
use crate::render::{Job, Limit, Region};
use crate::scene::{MAX_SPP, Size};
use crate::ui::app::display;
use crate::ui::keymap::Context;
use crate::ui::msg::Target;

/// The job of the last of these effects that traces this picture.
fn job(effects: &[Effect], target: Target) -> Option<&Job> {
    let mut traced = effects.iter().rev().filter_map(traced_by);
    traced.find_map(|(of, job)| (of == target).then_some(job))
}

/// An interface with the full-size trace on screen.
fn tracing() -> App {
    let mut app = open(SCENE);
    assert!(job(&press(&mut app, "<F5>"), Target::Trace).is_some());
    app.update(Msg::Started(Target::Trace, 1));
    app
}

fn mouse(
    app: &mut App,
    kind: MouseEventKind,
    at: (u16, u16),
    modifiers: KeyModifiers,
) -> Vec<Effect> {
    let (column, row) = at;
    app.update(Msg::Mouse(MouseEvent {
        kind,
        column,
        row,
        modifiers,
    }))
}

scripts! {
    a_trace_ends_in_the_mode_that_it_was_called_from: ray().table(r"
        {1}   | mode {2}
        <F5>  | mode TRACE
        <Esc> | mode {2}
    ", r"
        j  | SELECT
        e  | EDIT
        v  | VIEW
        vF | VIEW FLY
    ");
}

#[test]
fn keys_zoom_about_the_middle() {
    let mut app = tracing();
    let (cells, _) = app.shared.raster().expect("room");
    let (middle, output) = ((cells.width / 2, cells.height / 2), app.shared.output());
    let under = |app: &App| {
        let window = display::frame_window(&app.shared);
        window.and_then(|window| window.pixel_at(middle, output))
    };
    let before = under(&app).expect("a pixel");
    for said in ["+++++", "--"] {
        press(&mut app, said);
        assert!(!display::viewport(&app.shared).is_fit());
        let after = under(&app).expect("a pixel");
        // A pixel of the screen was several of the picture before.
        let near = |axis: usize| before[axis].abs_diff(after[axis]) <= 8;
        assert!(near(0) && near(1), "{said}: {before:?} {after:?}");
    }
}

#[test]
fn a_trace_is_paused_and_continued() {
    use Effect::{Halt, Pause, Resume};
    let mut app = tracing();
    for (said, pauses) in [(" ", true), (" ", false), (" ", true), ("<F5>", false)] {
        let effects = press(&mut app, said);
        let is_right = match effects[..] {
            [Pause(Target::Trace)] => pauses,
            [Resume(Target::Trace)] => !pauses,
            _ => false,
        };
        assert!(is_right, "{said}: {effects:?}");
        assert_eq!(app.shared.picture().paused, pauses);
    }
    assert!(matches!(
        press(&mut app, " x")[..],
        [Pause(_), Halt(Target::Trace)]
    ));
    assert!(!app.shared.picture().paused);
    assert!(job(&press(&mut app, " "), Target::Trace).is_some());
    app.update(Msg::Started(Target::Trace, 2));
    let size = app.shared.output();
    let mut done = frame_of(size, vec![0; size.pixels()]);
    done.generation = 2;
    app.update(Msg::Frame(Target::Trace, Arc::new(done)));
    assert!(press(&mut app, " ").is_empty());
    assert!(words(&app).contains("nothing to pause"), "{}", words(&app));
}

/// Scripts wait for pictures; one that is paused would never come.
#[test]
fn a_paused_trace_is_not_awaited() {
    let mut app = tracing();
    app.shared.pictures.preview.wanted = None;
    assert!(app.shared.pictures.are_awaited());
    press(&mut app, " ");
    assert!(!app.shared.pictures.are_awaited());
}

#[test]
fn a_running_trace_continues_to_another_end() {
    let mut app = open(SCENE);
    assert!(press(&mut app, ":until<Enter>").is_empty());
    assert_eq!(words(&app), "the full-size trace ends at 4 spp");
    assert!(press(&mut app, ":until 256 spp<Enter>").is_empty());
    let ends = |effects: &[Effect]| {
        let job = job(effects, Target::Trace).expect("a trace");
        (job.settings.spp, job.limit)
    };
    assert_eq!(ends(&press(&mut app, "<F5>")), (256, None));
    app.update(Msg::Started(Target::Trace, 1));
    let time = Limit::Time(Duration::from_secs(30));
    for (said, end) in [
        ("16 spp", (16, None)),
        ("30 s", (MAX_SPP, Some(time))),
        ("noise 0.01", (MAX_SPP, Some(Limit::Noise(0.01)))),
    ] {
        let effects = press(&mut app, &format!(":until {said}<Enter>"));
        assert_eq!(ends(&effects), end, "{said}");
    }
    let effects = press(&mut app, ":export a.png<Enter>");
    let export = job(&effects, Target::Export).expect("an export");
    assert_eq!((export.settings.spp, export.limit), (4, None));
}

#[test]
fn a_region_is_traced_alone_and_exports_are_of_all_of_the_picture() {
    let mut app = open(SCENE);
    let region = |effects: &[Effect]| job(effects, Target::Trace).map(|job| job.settings.region);
    let asked = Region::parse("10,20,64,48");
    let effects = press(&mut app, ":region 10,20,64,48<Enter>");
    assert_eq!(region(&effects), Some(asked));
    assert_eq!(app.shared.mode, Mode::Trace);
    app.update(Msg::Started(Target::Trace, 1));
    let effects = press(&mut app, "b");
    let export = job(&effects, Target::Export).expect("an export");
    assert_eq!(export.settings.region, None);
    assert_eq!(region(&press(&mut app, ":region off<Enter>")), Some(None));
    assert!(press(&mut app, ":region 9999,0,1,1<Enter>").is_empty());
    assert!(
        words(&app).contains("reaches outside the picture"),
        "{}",
        words(&app)
    );
    // The middle half of all of the picture.
    let Size { width, height } = app.shared.output();
    let effects = press(&mut app, "R<Enter>");
    let drawn = region(&effects).flatten().expect("a region");
    assert_eq!((drawn.x, drawn.y), (width / 4, height / 4));
    assert_eq!((drawn.width, drawn.height), (width / 2 + 1, height / 2 + 1));
    assert!(press(&mut app, "Rh<Tab>LJ<Esc>").is_empty());
    assert_eq!(
        (app.shared.mode, app.shared.context()),
        (Mode::Trace, Context::In(Mode::Trace))
    );
}

#[test]
fn corners_of_a_region_are_moved_by_pixels_of_the_screen() {
    let mut app = tracing();
    press(&mut app, "+++++");
    press(&mut app, "R");
    let before = app.shared.region_drawn().expect("a region");
    press(&mut app, "lJ<Tab>h");
    let after = app.shared.region_drawn().expect("a region");
    let wider = (before.width + 2, before.height + 8);
    assert_eq!((after.width, after.height), wider);
    assert_eq!((after.x, after.y), (before.x - 1, before.y));
}

#[test]
fn a_region_is_dragged_with_the_mouse() {
    use MouseEventKind::{Down, Drag, Up};
    let left = MouseButton::Left;
    let none = KeyModifiers::NONE;
    let mut app = tracing();
    press(&mut app, "z");
    let (cells, _) = app.shared.raster().expect("room");
    let at = |column, row| (cells.x + column, cells.y + row);
    let corner = display::pixel_in_corner(&app.shared).expect("a pixel");
    press(&mut app, "R");
    mouse(&mut app, Down(left), at(9, 9), none);
    mouse(&mut app, Drag(left), at(4, 7), none);
    let effects = mouse(&mut app, Up(left), at(4, 7), none);
    let job = job(&effects, Target::Trace).expect("a trace");
    // At 1:1 a cell shows one pixel across and two down.
    let region = Region {
        x: corner[0] + 4,
        y: corner[1] + 14,
        width: 6,
        height: 5,
    };
    assert_eq!(job.settings.region, Some(region));
}

/// What the preview is traced at after a command.
fn zoomed(app: &mut App, said: &str) -> (Size, Option<Region>) {
    let effects = press(app, &format!(":zoom {said}<Enter>"));
    let job = job(&effects, Target::Preview).expect("another preview");
    (job.settings.size, job.settings.region)
}

#[test]
fn a_zoomed_preview_is_traced_at_its_scale() {
    let mut app = open(SCENE);
    let output = app.shared.output();
    let shown = display::frame_window(&app.shared).expect("room").size;
    let half = Size {
        width: output.width / 2,
        height: output.height / 2,
    };
    for (said, size, pixels) in [
        ("1:2", half, shown.width),
        ("1:1", output, shown.width),
        ("8", output, shown.width.div_ceil(8)),
    ] {
        let (traced, region) = zoomed(&mut app, said);
        let region = region.expect("a region");
        assert_eq!((traced, region.width), (size, pixels), "{said}");
        assert!(region.within(traced).is_ok());
    }
    assert_eq!(zoomed(&mut app, "fit"), (shown, None));
    assert!(press(&mut app, ":zoom 3<Enter>").is_empty());
    assert!(words(&app).contains("a power of two"), "{}", words(&app));
}

#[test]
fn the_wheel_zooms_about_the_pointer() {
    let up = MouseEventKind::ScrollUp;
    for (mut app, modifiers) in [
        (tracing(), KeyModifiers::NONE),
        (open(SCENE), KeyModifiers::CONTROL),
    ] {
        let (cells, _) = app.shared.raster().expect("room");
        let cell = (cells.width / 3, cells.height / 3);
        let output = app.shared.output();
        let under = |app: &App| {
            display::frame_window(&app.shared)
                .and_then(|frame_window| frame_window.pixel_at(cell, output))
        };
        let before = under(&app).expect("a pixel");
        for _ in 0..4 {
            mouse(
                &mut app,
                up,
                (cells.x + cell.0, cells.y + cell.1),
                modifiers,
            );
        }
        let after = under(&app).expect("a pixel");
        assert!(!display::viewport(&app.shared).is_fit());
        // A pixel of the screen was several of the picture before.
        let near = |axis: usize| before[axis].abs_diff(after[axis]) <= 8;
        assert!(near(0) && near(1), "{before:?} {after:?}");
    }
}

#[test]
fn a_zoomed_trace_is_panned_by_keys_and_by_dragging() {
    let mut app = tracing();
    press(&mut app, "z");
    let corner = |app: &App| display::pixel_in_corner(&app.shared).expect("a pixel");
    let before = corner(&app);
    press(&mut app, "lj");
    let after = corner(&app);
    assert!(before[0] < after[0] && before[1] < after[1]);
    let (cells, _) = app.shared.raster().expect("room");
    let (from, to) = ((cells.x + 20, cells.y + 10), (cells.x + 17, cells.y + 11));
    let left = MouseButton::Left;
    mouse(
        &mut app,
        MouseEventKind::Down(left),
        from,
        KeyModifiers::NONE,
    );
    mouse(&mut app, MouseEventKind::Drag(left), to, KeyModifiers::NONE);
    assert_eq!(corner(&app), [after[0] + 3, after[1] - 2]);
    assert_eq!(app.shared.mode, Mode::Trace);
    press(&mut app, "z");
    assert!(display::viewport(&app.shared).is_fit());
}

/// The objects under the pixels on screen are those of the part that is seen.
#[test]
fn cells_find_the_pixels_of_the_newest_frame() {
    let mut app = tracing();
    let size = app.shared.output();
    let numbers: Vec<_> = (0..size.pixels() as u32).collect();
    app.update(Msg::Frame(Target::Trace, Arc::new(frame_of(size, numbers))));
    press(&mut app, "+++++++");
    let frame_window = display::frame_window(&app.shared).expect("room");
    app.shared
        .picture_mut()
        .advance(&frame_window, &[], usize::MAX);
    let (cells, _) = app.shared.raster().expect("room");
    let grid = frame_window.grid;
    for cell in [(0, 0), (9, 4), (cells.width - 1, cells.height - 1)] {
        let Some([x, y]) = display::pixel_at(&app.shared, cell) else {
            continue;
        };
        let shown = &app.shared.picture().shown;
        let under = shown.object_at(cell.0.into(), u32::from(cell.1 * grid.down));
        assert_eq!(under, Some(y * size.width + x), "{cell:?}");
    }
}
