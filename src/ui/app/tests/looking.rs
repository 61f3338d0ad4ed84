//! Views, shares of the light, the exposure of the display, and the histogram.

use std::sync::{Arc, Weak};

use super::*;
use crate::render::{Aov, Colours, Frame, Job, Query};
use crate::scene::Transfer;
use crate::ui::msg::Target;

/// The job of a picture among the effects.
pub(super) fn job(effects: &[Effect], wanted: Target) -> Option<&Job> {
    let mut traced = effects.iter().filter_map(traced_by);
    traced.find_map(|(target, job)| (target == wanted).then_some(job))
}

/// The complete preview of a job, of a single grey.
pub(super) fn preview(job: &Job, grey: f32) -> Msg {
    let size = job.settings.size;
    let plain = pictures::frame(size, vec![0; size.pixels()]);
    let query = Query {
        world: Weak::new(),
        photons: Weak::new(),
        camera: job.camera,
        settings: job.settings,
        numbers: None,
    };
    let frame = Frame {
        values: vec![[grey; 3]; size.pixels()],
        range: matches!(
            job.settings.aov,
            Some(Aov::Cost | Aov::Samples | Aov::Depth)
        )
        .then_some([1.0, 311.6]),
        query: Some(query),
        ..plain
    };
    Msg::Frame(Target::Preview, Arc::new(frame))
}

#[test]
fn exposure_changes_the_screen_and_traces_nothing() {
    let mut app = open(SCENE);
    for (said, half_stops, told) in [
        (">", 1, "exposure +0.5 EV, on screen only"),
        (">>", 3, "exposure +1.5 EV, on screen only"),
        ("<Lt>", 2, "exposure +1 EV, on screen only"),
        (
            ":exposure -2.5<Enter>",
            -5,
            "exposure -2.5 EV, on screen only",
        ),
        (
            ":exposure 0.25<Enter>",
            -5,
            "exposure takes stops from -20 to 20, in steps of 0.5",
        ),
        (":exposure 0<Enter>", 0, "exposure 0"),
        (
            ":exposure 20<Enter>>",
            40,
            "exposure +20 EV, on screen only",
        ),
    ] {
        let effects = press(&mut app, said);
        assert!(job(&effects, Target::Preview).is_none(), "{said}");
        assert_eq!(app.pictures.display.half_stops, half_stops, "{said}");
        assert_eq!(words(&app), told, "{said}");
        let frame_window = app.frame_window().expect("there is room");
        assert_eq!(frame_window.display, app.pictures.display);
    }
    assert_eq!(app.display_name().as_deref(), Some("+20 EV"));
    press(&mut app, "2<Esc>>");
    let refused = "only light and albedo can be exposed; press 1";
    assert_eq!((words(&app), app.display_name()), (refused, None));
    assert_eq!(app.pictures.display.half_stops, 40);
}

#[test]
fn commands_choose_transfer_and_colours_of_the_display() {
    let mut app = open(SCENE);
    for (said, name) in [
        (":transfer srgb<Enter>", Some("sRGB")),
        (":falsecolour<Enter>", Some("sRGB false colours")),
        (
            ":transfer linear<Enter>>",
            Some("+0.5 EV linear false colours"),
        ),
        (":transfer scene<Enter>", Some("+0.5 EV false colours")),
        (":falsecolor<Enter><Lt>", None),
    ] {
        press(&mut app, said);
        assert_eq!(app.display_name().as_deref(), name, "{said}");
    }
}

#[test]
fn noise_is_reduced_on_screen_and_in_no_file() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "~");
    let asked = job(&effects, Target::Preview).expect("it is traced again");
    assert!(asked.denoise);
    assert_eq!(words(&app), "noise is reduced, on screen only");
    assert_eq!(app.display_name().as_deref(), Some("denoised"));
    let frame_window = app.frame_window().expect("there is room");
    assert!(frame_window.display.denoised);
    // A complete picture without is too large for it.
    let arrived = preview(asked, 0.5);
    app.update(Msg::Started(Target::Preview, 1));
    app.update(arrived);
    assert_eq!(app.display_name().as_deref(), Some("not denoised"));
    let effects = press(&mut app, "<F5>");
    assert!(job(&effects, Target::Trace).is_some_and(|job| job.denoise));
    let effects = press(&mut app, "<Esc>b");
    let export = job(&effects, Target::Export).expect("a trace");
    assert!(!export.denoise);
    // The others show no light.
    let effects = press(&mut app, "2");
    assert!(job(&effects, Target::Preview).is_some());
    assert_eq!(app.display_name(), None);
    press(&mut app, "~");
    assert_eq!(words(&app), "only light has noise to reduce; press 1");
    press(&mut app, "1");
    let effects = press(&mut app, ":denoise<Enter>");
    assert!(job(&effects, Target::Preview).is_some_and(|job| !job.denoise));
    assert_eq!(words(&app), "noise is no longer reduced");
    assert_eq!(app.display_name(), None);
}

#[test]
fn a_trace_continues_when_denoising_is_switched() {
    let mut app = open(SCENE);
    press(&mut app, "<F5>");
    app.update(Msg::Started(Target::Trace, 1));
    let effects = press(&mut app, "~");
    let [Effect::Trace(Target::Trace, again)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert!(again.denoise);
}

/// What is exported is what the scene and the view say, whatever the screen shows.
#[test]
fn the_display_never_reaches_a_file() {
    let settings = |keys: &str| {
        let mut app = open(SCENE);
        press(&mut app, keys);
        let effects = press(&mut app, "b");
        job(&effects, Target::Export).expect("a trace").settings
    };
    let plain = settings("");
    assert_eq!(
        plain,
        settings(">>>:transfer srgb<Enter>:falsecolour<Enter>")
    );
    // A complete trace on screen is written as traced.
    let mut app = open(SCENE);
    press(&mut app, ">>:falsecolour<Enter>");
    let effects = press(&mut app, "<F5>");
    let size = job(&effects, Target::Trace).expect("a trace").settings.size;
    app.update(Msg::Started(Target::Trace, 1));
    let frame = Arc::new(pictures::frame(size, vec![0; size.pixels()]));
    app.update(Msg::Frame(Target::Trace, Arc::clone(&frame)));
    let effects = press(&mut app, "b");
    assert!(
        job(&effects, Target::Export).is_none(),
        "it is traced already"
    );
    let trace = app
        .pictures
        .trace
        .as_ref()
        .and_then(|trace| trace.latest.clone());
    assert_eq!(
        trace.map(|trace| trace.pixels.clone()),
        Some(frame.pixels.clone())
    );
}

#[test]
fn brackets_step_through_the_shares_of_the_light() {
    let mut app = open(SCENE);
    let shares = [
        (Some(Aov::Direct(0)), "only direct light of light 1"),
        (
            Some(Aov::Emission),
            "emission, ambient light and background alone",
        ),
        (
            Some(Aov::Indirect),
            "indirect light alone: by way of other surfaces",
        ),
        (None, "light"),
    ];
    for (share, told) in shares {
        let effects = press(&mut app, ")");
        let traced = job(&effects, Target::Preview).expect("a trace").settings;
        assert_eq!((traced.aov, words(&app)), (share, told));
    }
    for (share, _) in [3, 2, 1, 0].map(|at| shares[(at + 3) % 4]) {
        press(&mut app, "(");
        assert_eq!(app.pictures.aov, share);
    }
    press(&mut app, ")");
    assert_eq!(app.view_name().as_deref(), Some("only light 1"));
}

#[test]
fn the_share_of_a_light_goes_with_it() {
    let one = "1\n5 5 5 // the light\n1 1 1\n";
    let two = "2\n5 5 5 // the light\n1 1 1\n-5 5 5\n1 1 1\n";
    let mut app = open(&SCENE.replace(one, two));
    press(&mut app, "))");
    assert_eq!(app.pictures.aov, Some(Aov::Direct(1)));
    outside(&mut app, SCENE);
    assert_eq!(app.error_count(), 0);
    assert_eq!((app.pictures.aov, app.view_name()), (None, None));
}

#[test]
fn legends_say_what_colours_stand_for() {
    let mut app = open(SCENE);
    for (said, name, legend) in [
        ("7", Some("cost"), Some("1 to 312 rays a sample")),
        ("8", Some("samples"), Some("1 to 312")),
        ("2", Some("depth"), Some("1 to 312")),
        ("3", Some("normal"), None),
        (":show uv<Enter>", Some("uv"), Some("u red, v green")),
        (
            ":show side<Enter>",
            Some("side"),
            Some("front blue, back orange"),
        ),
        ("1", None, None),
        (
            ":falsecolour<Enter>",
            None,
            Some("-8 to 0 EV, green below, white above"),
        ),
    ] {
        let effects = press(&mut app, said);
        if let Some(job) = job(&effects, Target::Preview) {
            let frame = preview(job, 0.5);
            app.update(Msg::Started(Target::Preview, 1));
            app.update(frame);
        }
        assert_eq!(app.view_name().as_deref(), name, "{said}");
        assert_eq!(app.legend().as_deref(), legend, "{said}");
    }
    assert_eq!(app.pictures.display.colours, Colours::False);
    assert_eq!(app.pictures.display.transfer, None::<Transfer>);
}

#[test]
fn the_histogram_follows_picture_and_exposure() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    app.update(preview(&trace, 0.5));
    press(&mut app, ":histogram<Enter>");
    let pixels = trace.settings.size.pixels() as u32;
    let bin = |app: &App| {
        let histogram = app.pictures.histogram.as_ref().expect("it is shown");
        let histogram = histogram.histogram.as_ref().expect("of light");
        let bin = histogram.bins.iter().position(|count| *count == pixels);
        (bin, histogram.clipped)
    };
    assert_eq!(bin(&app), (Some(14), 0.0));
    press(&mut app, ">>>");
    assert_eq!(bin(&app), (Some(17), 1.0));
    app.update(preview(&trace, 0.25));
    assert_eq!(bin(&app), (Some(15), 0.0));
    press(&mut app, ":histogram<Enter>");
    assert!(app.pictures.histogram.is_none());
}
