//! Integrator, depth, AOV and filter of pictures.

use std::sync::Arc;

use super::*;
use crate::render::{Aov, Job, Settings};
use crate::scene::Filter;
use crate::scene::Integrator;
use crate::ui::msg::Target;

/// A scene in each language.
pub(super) const SCENES: [(&str, &str); 3] = [
    ("scene.ray", SCENE),
    ("scene.dat", dat::SCENE),
    ("scene.xml", include_str!("../../../../scenes/spheres.xml")),
];

/// The jobs among the effects.
fn jobs(effects: &[Effect]) -> Vec<(Target, &Job)> {
    effects.iter().filter_map(traced_by).collect()
}

/// The settings of the only picture that these keys start.
fn traced(app: &mut App, said: &str) -> (Target, Settings) {
    let effects = press(app, said);
    let [(target, job)] = jobs(&effects)[..] else {
        panic!("{said}: {} effects", effects.len());
    };
    (target, job.settings)
}

#[test]
fn switching_the_integrator_affects_every_picture_at_once() {
    for (name, text) in SCENES {
        let mut app = opened_as(name, text).0;
        let gathered =
            |(target, settings): (Target, Settings)| (target, settings.integrator, settings.depth);
        let (path, whitted) = ((Integrator::Path, 64), (Integrator::Whitted, 8));
        let photon = (Integrator::Photon, 64);
        for (said, target, (integrator, depth)) in [
            ("P", Target::Preview, path),
            ("<F5>", Target::Trace, path),
            ("P", Target::Trace, photon),
            ("P", Target::Trace, whitted),
            ("P", Target::Trace, path),
            ("b", Target::Export, path),
            ("<Esc>", Target::Preview, path),
        ] {
            let traced = gathered(traced(&mut app, said));
            assert_eq!(traced, (target, integrator, depth), "{name} {said}");
            if target == Target::Trace {
                app.update(Msg::Started(target, 1));
            }
        }
        assert_eq!(app.document.text(), text);
    }
}

#[test]
fn the_scenes_integrator_applies_until_the_user_chooses() {
    let text = SCENES[2].1;
    let paths = text.replace("<camera>", "<camera gamma=\"sRGB\">");
    let (mut app, effects) = opened_as("scene.xml", &paths);
    let [(Target::Preview, job)] = jobs(&effects)[..] else {
        panic!("{effects:?}");
    };
    let settings = job.settings;
    assert_eq!(
        (settings.integrator, settings.depth),
        (Integrator::Path, 64)
    );
    press(&mut app, "P");
    assert_eq!(app.rendering().integrator(), Integrator::Photon);
    press(&mut app, "P");
    assert_eq!(app.rendering().integrator(), Integrator::Whitted);
    assert!(app.is_integrator_changed());
    press(&mut app, "P");
    assert!(!app.is_integrator_changed());
    read(&mut app, "scene.xml", text);
    assert_eq!(app.error_count(), 0);
    assert_eq!(app.rendering().integrator(), Integrator::Whitted);
}

#[test]
fn a_depth_set_by_the_user_applies_to_all_integrators() {
    let mut app = open(SCENE);
    app.pictures.rendering.depth = Some(3);
    for integrator in [Integrator::Path, Integrator::Photon, Integrator::Whitted] {
        let settings = traced(&mut app, "P").1;
        assert_eq!((settings.integrator, settings.depth), (integrator, 3));
    }
}

#[test]
fn settings_of_the_text_lie_under_the_users() {
    let mut app = open(&format!(
        "// render: integrator path depth 2 spp 8 exposure 1\n{SCENE}"
    ));
    let (_, settings) = traced(&mut app, "<F5>");
    let found = (settings.integrator, settings.depth, settings.exposure);
    assert_eq!(found, (Integrator::Path, 2, 1.0));
    // As if given on the command line.
    assert_eq!(settings.spp, 4);
    app.pictures.rendering.spp = None;
    press(&mut app, "PP");
    assert!(app.is_integrator_changed());
    let (_, settings) = traced(&mut app, "b");
    let found = (settings.integrator, settings.depth, settings.spp);
    assert_eq!(found, (Integrator::Whitted, 2, 8));
}

#[test]
fn a_setting_in_use_is_written_and_no_longer_lies_over_the_text() {
    let mut app = open(SCENE);
    app.pictures.rendering.depth = Some(3);
    let said = |app: &App| app.document.text().lines().next().map(str::to_owned);
    press(&mut app, "P:set integrator<Enter>");
    assert_eq!(said(&app).as_deref(), Some("// render: integrator path"));
    assert!(!app.is_integrator_changed());
    let (_, settings) = traced(&mut app, ":set depth 5<Enter>");
    assert_eq!((settings.integrator, settings.depth), (Integrator::Path, 5));
    assert_eq!(
        said(&app).as_deref(),
        Some("// render: integrator path depth 5")
    );
    press(
        &mut app,
        ":set integrator default<Enter>:set depth default<Enter>",
    );
    assert_eq!(app.document.text(), SCENE);
    press(&mut app, "u");
    assert_eq!(said(&app).as_deref(), Some("// render: depth 5"));
    for (order, reason) in [
        (":set depth x<Enter>", "render depth: `x` is not a number"),
        (":set integrator pth<Enter>", "did you mean `path`?"),
        (
            ":set depth 9999<Enter>",
            "render depth: must be a whole number from 0 to 4096",
        ),
        (
            ":set gamma 2<Enter>",
            ":set takes integrator, depth, spp, filter, transfer, exposure, falloff, gloss",
        ),
    ] {
        press(&mut app, order);
        assert!(words(&app).contains(reason), "{}", words(&app));
        assert!(!words(&app).contains("skipped"), "{}", words(&app));
        assert_eq!(said(&app).as_deref(), Some("// render: depth 5"));
        press(&mut app, "<Esc>");
    }
}

/// The text and what takes precedence over it are as they were, also over several steps.
#[test]
fn undo_of_a_written_setting_brings_back_what_it_replaced() {
    let mut app = open(SCENE);
    press(&mut app, "P:set integrator<Enter>");
    let written = app.document.text().to_owned();
    assert_eq!(written, format!("// render: integrator path\n{SCENE}"));
    let seen = |app: &mut App, keys: &str| {
        press(app, keys);
        let integrator = app.rendering().integrator();
        (
            integrator,
            app.is_integrator_changed(),
            app.document.text() == written,
        )
    };
    let [whitted, path, photon] = Integrator::ALL;
    assert_eq!(seen(&mut app, "u"), (path, true, false));
    assert_eq!(seen(&mut app, "<Ctrl-r>"), (path, false, true));
    // What is chosen since belongs to the text then.
    assert_eq!(seen(&mut app, "P"), (photon, true, true));
    assert_eq!(seen(&mut app, "u"), (path, true, false));
    assert_eq!(seen(&mut app, "PP"), (whitted, false, false));
    assert_eq!(seen(&mut app, "<Ctrl-r>"), (photon, true, true));
    assert_eq!(seen(&mut app, "uPP<Ctrl-r>"), (photon, true, true));
    // Another setting, and several steps at once.
    assert_eq!(seen(&mut app, ":set depth 3<Enter>u"), (photon, true, true));
    press(&mut app, ":set integrator<Enter>P:set depth 2<Enter>");
    let (last, rendering) = (app.document.present(), app.rendering());
    app.go_to_state(last - 2);
    assert_eq!(seen(&mut app, ""), (photon, true, true));
    app.go_to_state(last);
    assert_eq!(app.rendering(), rendering);
}

/// What is wrong already stays a warning.
#[test]
fn a_setting_replaces_one_that_is_skipped() {
    let mut app = open(&format!("// render: depth x\n{SCENE}"));
    press(&mut app, ":set spp 8<Enter>");
    assert!(
        app.document
            .text()
            .starts_with("// render: depth x spp 8\n")
    );
    press(&mut app, ":set depth 2<Enter>");
    assert!(
        app.document
            .text()
            .starts_with("// render: depth 2 spp 8\n")
    );
    press(&mut app, ":set exposure 1 spp 3<Enter>");
    assert_eq!(words(&app), ":set exposure takes one value");
}

#[test]
fn settings_are_fields_of_a_thing_of_their_own() {
    let mut app = open(SCENE);
    press(&mut app, "ggel");
    assert!(
        app.document
            .text()
            .starts_with("// render: integrator path\n")
    );
    press(&mut app, "jl");
    assert!(
        app.document
            .text()
            .starts_with("// render: integrator path depth 65\n")
    );
    press(&mut app, "0<Enter>i4097<Enter>");
    assert!(
        app.document
            .text()
            .starts_with("// render: integrator path depth 0\n")
    );
}

/// Keys, what they show, and the samples taken when many are requested.
const SHOWN: [(&str, Option<Aov>, u32); 8] = [
    ("2", Some(Aov::Depth), 1),
    ("3", Some(Aov::Normal), 4),
    ("4", Some(Aov::Object), 1),
    ("5", Some(Aov::Albedo), 4),
    ("7", Some(Aov::Cost), 4),
    ("8", Some(Aov::Samples), 4),
    ("9", Some(Aov::Noise), 4),
    ("1", None, 4),
];

#[test]
fn digits_select_what_every_picture_shows() {
    for (name, text) in SCENES {
        let mut app = opened_as(name, text).0;
        press(&mut app, "<F5>");
        app.update(Msg::Started(Target::Trace, 1));
        for (said, aov, spp) in SHOWN {
            let (target, settings) = traced(&mut app, said);
            assert_eq!(
                (target, settings.aov),
                (Target::Trace, aov),
                "{name} {said}"
            );
            assert_eq!(settings.spp, spp, "{name} {said}");
            app.update(Msg::Started(Target::Trace, 1));
        }
        for mode in ["<Esc>", "v"] {
            press(&mut app, mode);
            for (said, aov, spp) in SHOWN {
                let (target, settings) = traced(&mut app, said);
                assert_eq!(
                    (target, settings.aov),
                    (Target::Preview, aov),
                    "{name} {said}"
                );
                assert_eq!(settings.spp == 1, spp == 1, "{name} {said}");
                assert!(press(&mut app, said).is_empty(), "it is shown already");
            }
        }
        assert_eq!(app.document.text(), text);
    }
}

#[test]
fn digits_are_typed_while_fields_are_edited() {
    let mut app = open(SCENE);
    press(&mut app, "2jjje3");
    assert_eq!(app.pictures.aov, Some(Aov::Depth));
    let typing = app.cursor.typing.as_ref().expect("a value is typed");
    assert_eq!(typing.input.value(), "3");
}

#[test]
fn an_export_writes_what_is_shown_and_reports_it() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "2b");
    let [
        Effect::CheckTarget(id, destination),
        Effect::Trace(Target::Export, job),
    ] = &effects[1..]
    else {
        panic!("{effects:?}");
    };
    assert_eq!((job.settings.aov, job.settings.spp), (Some(Aov::Depth), 1));
    assert_eq!(words(&app), "exporting depth to scene.depth.bmp");
    let path = destination.path.clone();
    let size = job.settings.size;
    // The AOV shown meanwhile does not matter.
    press(&mut app, "1");
    let done = Arc::new(pictures::frame(size, vec![0; size.pixels()]));
    app.update(Msg::Frame(Target::Export, done));
    app.update(exported(*id, path, None));
    assert_eq!(words(&app), "wrote scene.depth.bmp: depth, 800×600, 1 spp");
    press(&mut app, "b");
    assert_eq!(words(&app), "exporting to scene.bmp");
}

/// A finished trace is exported as it is only if it shows what is requested.
#[test]
fn a_finished_trace_is_exported_if_it_shows_what_is_requested() {
    let mut app = open(SCENE);
    press(&mut app, "2<F5>");
    app.update(Msg::Started(Target::Trace, 1));
    let size = app.output();
    let done = Arc::new(pictures::frame(size, vec![0; size.pixels()]));
    app.update(Msg::Frame(Target::Trace, done));
    let effects = press(&mut app, "b");
    assert!(matches!(
        effects[..],
        [Effect::WriteImage(..), Effect::Later(..)]
    ));
    press(&mut app, "x");
    assert_eq!(traced(&mut app, "3").0, Target::Trace);
    app.update(Msg::Started(Target::Trace, 2));
    assert_eq!(traced(&mut app, "b").0, Target::Export);
}

#[test]
fn the_pixel_filter_applies_to_full_size_pictures_only() {
    let mut app = open(SCENE);
    app.pictures.rendering.filter = Some(Filter::Gaussian);
    for (said, target, filter) in [
        ("P", Target::Preview, Filter::Box),
        ("<F5>", Target::Trace, Filter::Gaussian),
        ("b", Target::Export, Filter::Gaussian),
    ] {
        let (traced, settings) = traced(&mut app, said);
        assert_eq!((traced, settings.filter), (target, filter), "{said}");
    }
}
