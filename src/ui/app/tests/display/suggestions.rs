//! What is wrong with pictures as a whole, the trials, and the setting suggested.

use std::sync::Arc;

use super::light::{job, preview};
use super::*;
use crate::render::{Frame, Frames, Job, Settings};
use crate::scene::{FalloffRule, Integrator};
use crate::ui::msg::Target;

/// Answers the trials among the effects, each with a picture three quarters of which have the grey that
/// `shade` gives for its settings, and the rest an eighth of it; returns what follows the last one, and
/// what was tried.
fn answer(
    app: &mut App,
    mut effects: Vec<Effect>,
    shade: impl Fn(&Settings) -> f32,
) -> (Vec<Effect>, Vec<Settings>) {
    let mut tried = Vec::new();
    while let Some(live_edit) = job(&effects, Target::Trial) {
        assert_eq!(
            (live_edit.frames, live_edit.settings.spp),
            (Frames::Live, 16)
        );
        let settings = live_edit.settings;
        let size = settings.size;
        let grey = shade(&settings);
        let columns = (0..size.pixels()).map(|at| (at as u32 % size.width) * 4 / size.width);
        let values = columns.map(|quarter| [if quarter == 0 { 0.125 * grey } else { grey }; 3]);
        let frame = Frame {
            generation: 7,
            values: values.collect(),
            objects: vec![0; size.pixels()],
            ..Frame::drawn(size, Vec::new())
        };
        tried.push(settings);
        app.update(Msg::Started(Target::Trial, 7));
        effects = app.update(Msg::Frame(Target::Trial, Arc::new(frame)));
    }
    (effects, tried)
}

/// Shows a preview of this grey, and answers its trials.
fn judged(
    app: &mut App,
    trace: &Job,
    grey: f32,
    shade: impl Fn(&Settings) -> f32,
) -> Vec<Settings> {
    let effects = app.update(preview(trace, grey));
    let (effects, tried) = answer(app, effects, shade);
    let is_end = |effect: &Effect| matches!(effect, Effect::Stop(Target::Trial));
    let ends = effects.iter().any(is_end);
    assert_eq!(ends, !tried.is_empty(), "{effects:?}");
    tried
}

/// A scene of which nothing is tried that would darken it.
fn faded() -> String {
    format!("// render: falloff square\n{SCENE}")
}

const OVEREXPOSED: &str = "more than half of the picture is above 1: ";

#[test]
fn a_picture_that_is_too_bright_says_so_once() {
    let (mut app, effects) = opened(&faded());
    let [bright, brighter] = [-1, -2]
        .map(|stops| format!("{OVEREXPOSED}C sets exposure {stops}; < darkens only the screen"));
    let again = format!("no errors or warnings in the text, but {bright}");
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    for (keys, grey, told) in [
        ("", 0.9, ""),
        ("", 1.5, &*bright),
        // What is offered is what `C` does.
        ("", 3.0, &*brighter),
        ("", 1.5, &*bright),
        // The next key dismisses it, and it only comes back on request.
        ("j", 1.5, ""),
        ("!", 1.5, &*again),
        ("j", 0.9, ""),
        ("", 1.5, &*bright),
        ("<Lt><Lt><Esc>", 0.9, ""),
        // Darkened by a stop, it is not too bright.
        ("<Esc>", 1.5, ""),
    ] {
        press(&mut app, keys);
        judged(&mut app, &trace, grey, |_| grey);
        assert_eq!(shown(&app), told, "{keys} {grey}");
    }
}

#[test]
fn what_is_wrong_with_a_picture_is_said_after_other_messages_while_it_is_so() {
    let (mut app, effects) = opened(&faded());
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    for (last, told) in [(1.5, "more than half of the picture is above 1"), (0.9, "")] {
        app.shared.say("something else");
        judged(&mut app, &trace, 1.5, |_| 1.5);
        judged(&mut app, &trace, last, |_| last);
        assert_eq!(shown(&app), "something else");
        press(&mut app, "<Esc>");
        assert_eq!(shown(&app).split(':').next(), Some(told));
        press(&mut app, "<Esc>");
        judged(&mut app, &trace, 0.9, |_| 0.9);
    }
}

/// What is tried for a preview of grey 3, and what is said of it.
fn cured(settings: &str, shade: impl Fn(&Settings) -> f32) -> (App, Vec<Settings>) {
    // Its mirror and its diffuse part add up to more than 1.
    let scene = SCENE.replace(".45 .45 .45", ".9 .9 .9");
    let (mut app, effects) = opened(&format!("// render: {settings}\n{scene}"));
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    let tried = judged(&mut app, &trace, 3.0, shade);
    (app, tried)
}

#[test]
fn the_setting_whose_trial_is_best_is_offered() {
    let by = |falloff: f32, depth: [f32; 2]| {
        move |settings: &Settings| match (settings.falloff, settings.depth) {
            (FalloffRule::Square, 64) => falloff,
            (FalloffRule::None, 2) => depth[0],
            (FalloffRule::None, 4) => depth[1],
            _ => 3.0,
        }
    };
    // Too bright at depth 4, so that no more bounces are tried.
    for (falloff, depth, cure) in [
        (0.5, [2.0, 2.0], "falloff square"),
        (0.01, [2.0, 2.0], "exposure -2"),
        (0.2, [0.4, 0.9], "depth 2"),
        (0.2, [0.8, 0.45], "depth 4"),
    ] {
        let (app, _) = cured("integrator path depth 64", by(falloff, depth));
        let said = shown(&app);
        assert!(
            said.starts_with(&format!("{OVEREXPOSED}C sets {cure};")),
            "{said}"
        );
    }
    let (mut app, tried) = cured("integrator path depth 64", by(0.5, [2.0, 2.0]));
    let tried = tried
        .iter()
        .map(|settings| (settings.falloff, settings.depth));
    assert_eq!(
        tried.collect::<Vec<_>>(),
        [
            (FalloffRule::None, 64),
            (FalloffRule::Square, 64),
            (FalloffRule::None, 2)
        ]
    );
    let before = app.shared.document.text().to_owned();
    press(&mut app, "C");
    let text = app.shared.document.text();
    assert!(
        text.starts_with("// render: integrator path depth 64 falloff square\n"),
        "{text}"
    );
    press(&mut app, "u");
    assert_eq!(app.shared.document.text(), before);
}

#[test]
fn where_no_trial_helps_that_is_said() {
    // Above 1 in three quarters, whatever the exposure: infinitely bright.
    let (mut app, _) = cured("falloff square", |_| f32::INFINITY);
    let said = shown(&app);
    let none = format!("{OVEREXPOSED}no single render setting fixes that;");
    assert!(said.starts_with(&none), "{said}");
    press(&mut app, "<Esc>C");
    assert_eq!(shown(&app), "there is no render setting to suggest");
}

#[test]
fn trials_that_end_early_or_are_outdated_suggest_nothing() {
    let (mut app, effects) = opened(SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    press(&mut app, "<Esc>");
    let effects = app.update(preview(&trace, 3.0));
    assert!(job(&effects, Target::Trial).is_some());
    assert_eq!(
        shown(&app),
        "",
        "nothing is said before it is known what helps"
    );
    let effects = app.update(Msg::Refused(Target::Trial, "no memory".to_owned()));
    assert!(matches!(effects[..], [Effect::Stop(Target::Trial)]));
    assert_eq!(shown(&app), "");
    // What is found out of a picture that was left is not said.
    let effects = app.update(preview(&trace, 3.0));
    press(&mut app, "P<Esc>");
    let (effects, tried) = answer(&mut app, effects, |_| 3.0);
    assert!(matches!(effects[..], [Effect::Stop(Target::Trial)]));
    assert_eq!((tried.len(), shown(&app)), (1, ""));
}

#[test]
fn a_picture_too_dark_to_be_exported_says_which_exposure_helps() {
    let (mut app, effects) = opened_as("scene.ray", SCENE);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    for (grey, told) in [
        (1e-4, "the picture is black: C sets exposure 13"),
        (
            0.01,
            "the picture is almost black (brightest value 3 of 255): C sets exposure 6.5",
        ),
        (0.07, ""),
    ] {
        press(&mut app, "<Esc>");
        judged(&mut app, &trace, grey, |_| grey);
        assert_eq!(shown(&app), told);
        judged(&mut app, &trace, 0.5, |_| 0.5);
    }
}

#[test]
fn a_black_picture_says_what_helps() {
    let sky = "<xml><scene><object type=\"sphere\" material=\"m\"/><material name=\"m\"/>\
               <environment value=\"1\"/></scene><camera><position z=\"9\"/></camera></xml>";
    let (mut app, effects) = opened_as("scene.xml", sky);
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    assert_eq!(app.shared.diagnostics.len(), 1);
    let path = |settings: &Settings| f32::from(settings.integrator == Integrator::Path);
    judged(&mut app, &trace, 0.0, path);
    assert_eq!(shown(&app), "the picture is black: C sets integrator path");
    press(&mut app, "P");
    assert_eq!(app.shared.diagnostics.len(), 0, "by path it is lit");
    press(&mut app, "PP");
    judged(&mut app, &trace, 0.0, path);
    press(&mut app, "C");
    assert!(
        app.shared
            .document
            .text()
            .contains("<render integrator=\"path\"/>")
    );
    assert_eq!(app.shared.diagnostics.len(), 0);
    press(&mut app, "<Esc>C");
    assert_eq!(shown(&app), "there is no render setting to suggest");
    // What glows is seen, but lights nothing.
    let lamp = "<object type=\"sphere\" material=\"l\"><translate x=\"3\"/></object>\
                <material name=\"l\"><emission value=\"1\"/></material></scene>";
    let (mut app, effects) = opened_as("scene.xml", &sky.replace("</scene>", lamp));
    let trace = job(&effects, Target::Preview).expect("a preview").clone();
    let half = |settings: &Settings| {
        if settings.integrator == Integrator::Path {
            0.5
        } else {
            0.2
        }
    };
    judged(&mut app, &trace, 0.2, half);
    assert_eq!(shown(&app), "no surface is lit: C sets integrator path");
}
