//! Views, shares of the light, the exposure of the display, and the histogram.

use std::sync::{Arc, Weak};

use super::*;
use crate::render::{Aov, Colours, Frame, Frames, Job, Query};
use crate::scene::{FalloffRule, Size, Transfer};
use crate::ui::msg::Target;

/// The job of a picture among the effects.
fn job(effects: &[Effect], wanted: Target) -> Option<&Job> {
    let mut traced = effects.iter().filter_map(traced_by);
    traced.find_map(|(target, job)| (target == wanted).then_some(job))
}

/// The complete preview of a job, of a single grey.
fn preview(job: &Job, grey: f32) -> Msg {
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
        let sight = app.sight().expect("there is room");
        assert_eq!(sight.display, app.pictures.display);
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
    let sight = app.sight().expect("there is room");
    assert!(sight.display.denoised);
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

/// A scene of which nothing is tried that would darken it.
fn faded() -> String {
    format!("// render: falloff square\n{SCENE}")
}

#[test]
fn a_picture_that_is_too_bright_says_so_once() {
    let (mut app, effects) = opened(&faded());
    let bright =
        "more than half of the picture is above 1: C sets exposure -1, < darkens the screen only";
    let again = format!("no errors or warnings in the text, but {bright}");
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    for (keys, grey, told) in [
        ("", 0.9, ""),
        ("", 1.5, bright),
        // The next key dismisses it, and it only comes back on request.
        ("j", 1.5, ""),
        ("!", 1.5, &again),
        ("j", 0.9, ""),
        ("", 1.5, bright),
        ("<Lt><Lt><Esc>", 0.9, ""),
        // Darkened by a stop, it is not too bright.
        ("<Esc>", 1.5, ""),
    ] {
        press(&mut app, keys);
        app.update(preview(&trace, grey));
        assert_eq!(shown(&app), told, "{keys} {grey}");
    }
}

#[test]
fn what_is_wrong_with_a_picture_is_said_after_other_messages_while_it_is_so() {
    let (mut app, effects) = opened(&faded());
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    for (last, told) in [(1.5, "more than half of the picture is above 1"), (0.9, "")] {
        app.overlays.say("something else");
        app.update(preview(&trace, 1.5));
        app.update(preview(&trace, last));
        assert_eq!(shown(&app), "something else");
        press(&mut app, "<Esc>");
        assert_eq!(shown(&app).split(':').next(), Some(told));
        press(&mut app, "<Esc>");
        app.update(preview(&trace, 0.9));
    }
}

#[test]
fn a_burnt_picture_is_offered_its_likeliest_cure_first() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    let burnt = "more than half of the picture is above 1: C sets";
    let effects = app.update(preview(&trace, 40.0));
    let trial = job(&effects, Target::Trial).expect("a trial");
    assert_eq!(trial.settings.falloff, FalloffRule::Square);
    tried(&mut app, 1, 0.5);
    assert!(shown(&app).starts_with(&format!("{burnt} falloff square,")));
    let effects = press(&mut app, "C");
    assert_eq!(app.document.text(), faded());
    // Nothing is left to try.
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    let effects = app.update(preview(&trace, 3.0));
    assert!(job(&effects, Target::Trial).is_none());
    assert!(shown(&app).starts_with(&format!("{burnt} exposure -2,")));
    press(&mut app, "C");
    assert_eq!(
        app.document.text(),
        format!("// render: falloff square exposure -2\n{SCENE}")
    );
    press(&mut app, "uu");
    assert_eq!(app.document.text(), SCENE);
}

/// A small picture by which a setting is tried, whose 99th percentile is so many stops above 1; returns what
/// follows.
fn tried(app: &mut App, generation: u64, stops: f64) -> Vec<Effect> {
    let size = Size {
        width: 1,
        height: 1,
    };
    app.update(Msg::Started(Target::Trial, generation));
    let frame = Frame {
        generation,
        values: vec![[stops.exp2() as f32; 3]],
        ..Frame::drawn(size, vec![[255; 3]])
    };
    app.update(Msg::Frame(Target::Trial, Arc::new(frame)))
}

#[test]
fn a_falloff_that_does_not_help_is_not_offered() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    app.update(preview(&trace, 3.0));
    tried(&mut app, 1, 2.0);
    let burnt = "more than half of the picture is above 1: C sets";
    assert!(shown(&app).starts_with(&format!("{burnt} exposure -2,")));
    press(&mut app, "<Esc>C");
    press(&mut app, "<Esc>");
    assert_eq!(
        app.document.text(),
        format!("// render: exposure -2\n{SCENE}")
    );
}

#[test]
fn a_picture_burnt_by_its_bounces_is_offered_a_smaller_depth() {
    let text = format!("// render: integrator path falloff square\n{SCENE}");
    let (mut app, effects) = opened(&text);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    let trial = |effects: &[Effect]| {
        job(effects, Target::Trial).map(|job| (job.settings.depth, job.settings.spp, job.frames))
    };
    let ends = |effects: &[Effect]| matches!(effects, [Effect::Stop(Target::Trial)]);
    let effects = app.update(preview(&trace, 3.0));
    assert_eq!(trial(&effects), Some((1, 16, Frames::LastWithValues)));
    assert_eq!(
        shown(&app),
        "",
        "nothing is said before it is known what helps"
    );
    let effects = tried(&mut app, 1, 0.0);
    assert_eq!(trial(&effects), Some((2, 16, Frames::LastWithValues)));
    let effects = tried(&mut app, 2, 1.0);
    assert!(ends(&effects), "{effects:?}");
    let burnt = "more than half of the picture is above 1: C sets";
    assert!(
        shown(&app).starts_with(&format!("{burnt} depth 1,")),
        "{}",
        shown(&app)
    );
    press(&mut app, "C");
    assert!(
        app.document
            .text()
            .starts_with("// render: integrator path falloff square depth 1\n")
    );
    // Where no depth helps, or nothing can be tried, an exposure does.
    press(&mut app, "u<Esc>");
    app.update(preview(&trace, 0.5));
    for ended in [
        |app: &mut App| tried(app, 3, 1.0),
        |app: &mut App| app.update(Msg::Refused(Target::Trial, "no memory".to_owned())),
    ] {
        assert!(trial(&app.update(preview(&trace, 3.0))).is_some());
        assert!(ends(&ended(&mut app)));
        assert!(
            shown(&app).starts_with(&format!("{burnt} exposure -2,")),
            "{}",
            shown(&app)
        );
        press(&mut app, "<Esc>");
        app.update(preview(&trace, 0.5));
    }
    // What is found out of a picture that was left is not said.
    app.update(preview(&trace, 3.0));
    press(&mut app, "P<Esc>");
    assert!(ends(&tried(&mut app, 4, 0.0)));
    assert_eq!(shown(&app), "");
}

#[test]
fn a_picture_too_dark_to_be_exported_says_which_exposure_helps() {
    let (mut app, effects) = opened_as("scene.ray", SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    app.update(preview(&trace, 1e-4));
    assert_eq!(shown(&app), "the picture is black: C sets exposure 13");
    app.update(preview(&trace, 0.01));
    assert_eq!(shown(&app), "");
}

#[test]
fn a_black_picture_says_what_helps() {
    let sky = "<xml><scene><object type=\"sphere\" material=\"m\"/><material name=\"m\"/>\
               <environment value=\"1\"/></scene><camera><position z=\"9\"/></camera></xml>";
    let (mut app, effects) = opened_as("scene.xml", sky);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    assert_eq!(app.diagnostics.len(), 1);
    app.update(preview(&trace, 0.0));
    assert_eq!(shown(&app), "the picture is black: C sets integrator path");
    press(&mut app, "P");
    assert_eq!(app.diagnostics.len(), 0, "by path it is lit");
    press(&mut app, "PPC");
    assert!(
        app.document
            .text()
            .contains("<render integrator=\"path\"/>")
    );
    assert_eq!(app.diagnostics.len(), 0);
    press(&mut app, "<Esc>C");
    assert_eq!(shown(&app), "there is no render setting to suggest");
}

#[test]
fn the_histogram_follows_picture_and_exposure() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    app.update(preview(&trace, 0.5));
    press(&mut app, ":histogram<Enter>");
    let pixels = trace.settings.size.pixels() as u32;
    let bin = |app: &App| {
        let tally = app.pictures.tally.as_ref().expect("it is shown");
        let histogram = tally.histogram.as_ref().expect("of light");
        let bin = histogram.bins.iter().position(|count| *count == pixels);
        (bin, histogram.clipped)
    };
    assert_eq!(bin(&app), (Some(14), 0.0));
    press(&mut app, ">>>");
    assert_eq!(bin(&app), (Some(17), 1.0));
    app.update(preview(&trace, 0.25));
    assert_eq!(bin(&app), (Some(15), 0.0));
    press(&mut app, ":histogram<Enter>");
    assert!(app.pictures.tally.is_none());
}
