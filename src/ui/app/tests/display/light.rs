//! Views, light components, the exposure of the display, and the histogram.

use std::sync::{Arc, Weak};

use super::rows::{ray, scripts};
use super::*;
use crate::render::{Aov, Frame, Job, Query};
use crate::ui::msg::Target;

/// The job of a picture among the effects.
pub(super) fn job(effects: &[Effect], wanted: Target) -> Option<&Job> {
    let mut traced = effects.iter().filter_map(traced_by);
    traced.find_map(|(target, job)| (target == wanted).then_some(job))
}

/// The complete preview of a job, of a single grey.
pub(super) fn preview(job: &Job, grey: f32) -> Msg {
    let size = job.settings.size;
    let plain = frame_of(size, vec![0; size.pixels()]);
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

scripts! {
    exposure_changes_the_screen_and_traces_nothing: ray().play(r"
        >                     | exposed 1 | not does trace preview | says exposure +0.5 EV, on screen only
        >>                    | exposed 3 | not does trace preview | says exposure +1.5 EV, on screen only
        <Lt>                  | exposed 2 | not does trace preview | says exposure +1 EV, on screen only
        :exposure -2.5<Enter> | exposed -5 | not does trace preview | says exposure -2.5 EV, on screen only
        :exposure 0.25<Enter> | exposed -5 | not does trace preview
        | says exposure takes stops from -20 to 20, in steps of 0.5
        :exposure 0<Enter>    | exposed 0 | not does trace preview | says exposure 0
        :exposure 20<Enter>>  | exposed 40 | not does trace preview | says exposure +20 EV, on screen only
        | exposure +20 EV
        2<Esc>> | not exposure | says only light and albedo can be exposed; press 1
    ");

    commands_choose_transfer_and_colours_of_the_display: ray().play(r"
        :transfer srgb<Enter>    | exposure sRGB
        :falsecolour<Enter>      | exposure sRGB false colours
        :transfer linear<Enter>> | exposure +0.5 EV linear false colours
        :transfer scene<Enter>   | exposure +0.5 EV false colours
        :falsecolor<Enter><Lt>   | not exposure
    ");

    noise_is_reduced_on_screen_and_in_no_file: ray().play(r"
        ~ | does trace preview | job denoise true | says noise is reduced, on screen only
        | exposure denoised | denoised
        // A complete picture without is too large for it.
        @started preview 1
        @frame preview  | exposure not denoised
        <F5>            | job denoise true
        <Esc>
        b               | does trace export | job denoise false
        // The others show no light.
        2               | does trace preview | not exposure
        ~               | says only light has noise to reduce; press 1
        1
        :denoise<Enter> | does trace preview | job denoise false
        | says noise is no longer reduced | not exposure
    ");

    a_trace_continues_when_denoising_is_switched: ray().play(r"
        <F5>
        @started full 1
        ~ | does only trace full | job denoise true
    ");

    brackets_step_through_the_shares_of_the_light: {
        let mut session = ray().session();
        let shares = [
            (Some(Aov::Direct(0)), "only direct light of light 1"),
            (Some(Aov::Emission), "emission, ambient light and background alone"),
            (Some(Aov::Indirect), "indirect light alone: by way of other surfaces"),
            (None, "light"),
        ];
        for (share, told) in shares {
            session.run(&format!(") | does trace preview | says {told}"));
            let traced = session.effects.iter().find_map(traced_by).expect("a trace");
            assert_eq!(traced.1.settings.aov, share);
        }
        for (share, _) in [3, 2, 1, 0].map(|at| shares[(at + 3) % 4]) {
            session.run("(");
            assert_eq!(session.app.shared.pictures.aov, share);
        }
        session.run(") | view-name only light 1");
    };

    the_share_of_a_light_goes_with_it: ray()
        .but(r"1\n5 5 5 // the light\n1 1 1\n => 2\n5 5 5 // the light\n1 1 1\n-5 5 5\n1 1 1\n")
        .with("one", SCENE)
        .play(r"
        ))        | view-name only light 2
        @file one | not errors | not aov | not view-name
    ");

    legends_say_what_colours_stand_for: {
        let mut session = ray().session();
        for (said, name, legend) in [
            ("7", "view-name cost", "legend 1 to 312 rays a sample"),
            ("8", "view-name samples", "legend 1 to 312"),
            ("2", "view-name depth", "legend 1 to 312"),
            ("3", "view-name normal", "not legend"),
            (":show uv<Enter>", "view-name uv", "legend u red, v green"),
            (":show side<Enter>", "view-name side", "legend front blue, back orange"),
            ("1", "not view-name", "not legend"),
            (":falsecolour<Enter>", "not view-name", "legend -8 to 0 EV, green below, white above"),
        ] {
            session.run(said);
            if let Some(frame) = job(&session.effects, Target::Preview).map(|job| preview(job, 0.5)) {
                session.app.update(Msg::Started(Target::Preview, 1));
                session.app.update(frame);
            }
            session.run(&format!("| {name} | {legend}"));
        }
        session.run("| exposure false colours");
    };
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
    let frame = Arc::new(frame_of(size, vec![0; size.pixels()]));
    app.update(Msg::Frame(Target::Trace, Arc::clone(&frame)));
    let effects = press(&mut app, "b");
    assert!(
        job(&effects, Target::Export).is_none(),
        "it is traced already"
    );
    let trace = app
        .shared
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
fn the_histogram_follows_picture_and_exposure() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    app.update(preview(&trace, 0.5));
    press(&mut app, ":histogram<Enter>");
    let pixels = trace.settings.size.pixels() as u32;
    let bin = |app: &App| {
        let histogram = app.shared.pictures.histogram.as_ref().expect("it is shown");
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
    assert!(app.shared.pictures.histogram.is_none());
}
