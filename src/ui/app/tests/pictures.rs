//! Tracing and exporting.

use std::sync::Arc;
use std::time::Duration;

use super::*;
use crate::render::{Frame, Overexposure, Progress};
use crate::scene::Size;
use crate::ui::msg::{Existing, ExportId, Recalled, Target, Timer};

pub(in crate::ui) fn frame(size: Size, objects: Vec<u32>) -> Frame {
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

#[test]
fn an_edit_restarts_the_preview_and_a_refused_one_does_not() {
    let traces = |said: &str| {
        let mut app = open(SCENE);
        press(&mut app, TO_FIRST_OBJECT);
        let effects = press(&mut app, said);
        let preview = |effect: &&Effect| matches!(effect, Effect::Trace(Target::Preview, _));
        effects.iter().filter(preview).count()
    };
    assert_eq!(traces("el"), 1);
    assert_eq!(traces("ejHH"), 1);
    assert_eq!(traces("vh"), 1);
    assert_eq!(traces("z"), 1);
    assert_eq!(traces("?"), 0);
}

/// Cells may be divided into pixels that are not square.
#[test]
fn every_division_of_cells_frames_the_picture_alike() {
    let mut app = open(SCENE);
    let mut traced = |across, down| {
        let effects = app.update(Msg::Grid { across, down });
        let job = effects.into_iter().find_map(|effect| match effect {
            Effect::Trace(Target::Preview, job) => Some(job),
            _ => None,
        });
        let job = job.expect("the preview is traced");
        (job.settings.size, job.camera)
    };
    let (quadrants, camera) = traced(2, 2);
    for (across, down) in [(2, 3), (2, 4), (1, 2)] {
        let (size, same) = traced(across, down);
        assert_eq!(same, camera, "{across}x{down}");
        assert_eq!(2 * size.width, u32::from(across) * quadrants.width);
    }
}

#[test]
fn impossible_commands_are_refused_with_a_reason() {
    for (said, reason) in [
        (":export a.webp<Enter>", ".bmp"),
        (":export a.bmp 99999x99999<Enter>", "99999x99999"),
        (":export a.bmp 70000<Enter>", "samples"),
        (
            ":export a.bmp 10x<Enter>",
            "`10x`: expected a size such as 800x600",
        ),
        (":export a.bmp 10x 4<Enter>", "`10x`: expected a size"),
        (":export 10x<Enter>", "`10x`: expected a size"),
        (":export a.bmp 99999999999<Enter>", "99999999999: samples"),
        (":export a.bmp fine<Enter>", "`fine` is neither"),
        (":export cancel<Enter>", "nothing is running"),
        (":expoort<Enter>", "did you mean export?"),
        (":put 8x8<Enter>", "the commands are"),
        (":size 0x5<Enter>", "size takes a size such as 800x600"),
        (
            ":size 99999x99999<Enter>",
            "99999x99999: a picture has at most",
        ),
    ] {
        let mut app = open(SCENE);
        let effects = press(&mut app, said);
        assert!(effects.is_empty(), "{said}: {effects:?}");
        assert!(words(&app).contains(reason), "{said}: {}", words(&app));
    }
}

#[test]
fn an_export_is_traced_written_and_reported() {
    let mut app = open(SCENE);
    let effects = press(&mut app, ":export b c.png 32x8 2<Enter>");
    let [
        Effect::CheckTarget(id, destination),
        Effect::Trace(Target::Export, job),
    ] = &effects[..]
    else {
        panic!("{effects:?}");
    };
    let size = Size {
        width: 32,
        height: 8,
    };
    let path = &destination.path;
    assert_eq!(path, &PathBuf::from("b c.png"));
    assert_eq!(destination.existing, Existing::Kept);
    assert_eq!(destination.scene, app.disk.path);
    assert_eq!((job.settings.size, job.settings.spp), (size, 2));
    assert_eq!(job.camera.size, size);
    let done = Arc::new(frame(size, vec![0; size.pixels()]));
    let effects = app.update(Msg::Frame(Target::Export, done));
    assert!(
        matches!(&effects[..], [Effect::WriteImage(_, _, to), Effect::Stop(_), Effect::Later(..)] if to == destination)
    );
    app.update(exported(*id, path, None));
    assert!(app.jobs.export.is_none());
    assert_eq!(words(&app), "wrote b c.png: 32×8, 2 spp");
}

#[test]
fn the_full_size_trace_continues_in_the_background_until_the_scene_changes() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "<F5>");
    let [Effect::Recall(job, _)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!((job.settings.size, job.settings.spp), (app.output(), 4));
    app.update(Msg::Started(Target::Trace, 1));
    assert!(press(&mut app, "<Esc>").is_empty());
    assert_eq!(app.mode, Mode::Select);
    assert!(press(&mut app, "r").is_empty(), "it is still under way");
    let theirs = SCENE.replace("1.5", "1.7");
    let effects = outside(&mut app, &theirs);
    assert!(matches!(
        effects[..],
        [Effect::Free(_), Effect::Trace(Target::Trace, _)]
    ));
    let effects = press(&mut app, "<Esc>");
    assert!(matches!(effects[..], [Effect::Trace(Target::Preview, _)]));
    let effects = outside(&mut app, SCENE);
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Stop(Target::Trace)
    )));
}

/// The picture on screen still has the old object numbers.
#[test]
fn no_object_is_outlined_by_an_outdated_number() {
    let mut app = open(SCENE);
    let size = Size {
        width: 4,
        height: 2,
    };
    app.pictures.preview.take(Arc::new(frame(size, vec![1; 8])));
    app.pictures
        .preview
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    outside(&mut app, &SCENE.replace("1.5", "1.7"));
    assert_eq!(app.pictures.preview.shown.object_at(0, 0), Some(1));
    let (head, second) = SCENE.split_at(SCENE.rfind("sphere").expect("two of them"));
    let more = format!("{}{second}{second}", head.replace("\n2\n", "\n3\n"));
    outside(&mut app, &more);
    assert_eq!(app.error_count(), 0);
    assert_eq!(app.pictures.preview.shown.object_at(0, 0), None);
}

#[test]
fn only_pictures_of_this_session_are_overwritten_unasked() {
    let place = tempfile::tempdir().expect("a folder");
    let written = Version::of(place.path()).expect("it is there");
    let existing = |app: &mut App, said: &str| {
        let effects = press(app, said);
        let Some(Effect::CheckTarget(id, destination)) = effects.first() else {
            panic!("{effects:?}");
        };
        let (id, destination) = (*id, destination.clone());
        app.update(exported(id, destination.path, Some(written)));
        destination.existing
    };
    let mut app = open(SCENE);
    assert_eq!(existing(&mut app, "b"), Existing::Kept);
    assert_eq!(existing(&mut app, "b"), Existing::Own(written));
    let to_another = ":export a.bmp<Enter>";
    assert_eq!(existing(&mut app, to_another), Existing::Kept);
    assert_eq!(existing(&mut app, to_another), Existing::Own(written));
    let by_force = ":export! c.bmp<Enter>";
    assert_eq!(existing(&mut app, by_force), Existing::Overwritten);
}

#[test]
fn exports_of_a_text_with_errors_announce_the_last_valid_scene() {
    for said in ["b", "<F5>"] {
        let mut app = open(SCENE);
        outside(&mut app, "x");
        app.update(Msg::Elapsed(Timer::Settled));
        outside(&mut app, "x");
        assert!(0 < app.error_count());
        press(&mut app, said);
        assert!(
            words(&app).contains("the last valid scene"),
            "{said}: {}",
            words(&app)
        );
    }
}

#[test]
fn a_file_written_after_its_export_was_cancelled_is_reported_and_stops_no_other() {
    let late = |outcome: Msg| {
        let mut app = open(SCENE);
        press(&mut app, ":export a.bmp 32x8<Enter>");
        let size = Size {
            width: 32,
            height: 8,
        };
        let done = Arc::new(frame(size, vec![0; size.pixels()]));
        app.update(Msg::Frame(Target::Export, done));
        assert!(press(&mut app, "x").is_empty(), "no picture is traced");
        assert!(words(&app).contains("a.bmp is being written"));
        press(&mut app, ":export b.bmp<Enter>");
        app.overlays.message = None;
        assert!(app.update(outcome).is_empty());
        let export = app.jobs.export.as_ref().expect("it goes on");
        assert_eq!(export.destination.path, PathBuf::from("b.bmp"));
        words(&app).to_owned()
    };
    assert_eq!(
        late(exported(ExportId(1), "a.bmp", None)),
        "wrote a.bmp anyway"
    );
    assert_eq!(late(Msg::Exported(ExportId(1), Err("full".into()))), "");
}

#[test]
fn an_export_ends_with_its_worker() {
    let mut app = open(SCENE);
    press(&mut app, "bqw");
    app.update(Msg::Ended(Target::Export));
    assert!(app.jobs.export.is_none() && app.jobs.next.is_none());
    assert!(words(&app).contains("stopped early"), "{}", words(&app));
    press(&mut app, "b");
    assert!(app.jobs.export.is_some());
    assert!(app.update(Msg::Ended(Target::Preview)).is_empty());
}

#[test]
fn a_refused_picture_is_no_longer_awaited() {
    let refusal = |target| Msg::Refused(target, "too large".into());
    let mut app = open(SCENE);
    press(&mut app, "bqw");
    app.update(refusal(Target::Export));
    assert!(app.jobs.export.is_none() && app.jobs.next.is_none());
    assert_eq!(words(&app), "too large");
    press(&mut app, "<Esc><F5>");
    app.update(refusal(Target::Trace));
    assert_eq!(words(&app), "too large");
    assert!(app.picture().wanted.is_none(), "nothing is on its way");
    let effects = press(&mut app, "<Esc><F5>");
    assert!(traces_in_full(&effects));
}

#[test]
fn quitting_asks_about_an_export_and_can_wait_for_it() {
    let quits = |effects: &[Effect]| wants(effects, |effect| matches!(effect, Effect::Quit));
    for said in ["q", "<Ctrl-c>", ":q<Enter>"] {
        let mut app = open(SCENE);
        press(&mut app, "b");
        assert!(!quits(&press(&mut app, said)), "{said}");
        assert!(
            matches!(app.overlays.dialog, Some(Dialog::Leave(AfterLeaving::Quit))),
            "{said}"
        );
        assert!(quits(&press(&mut app, "y")));
    }
    let mut app = open(SCENE);
    press(&mut app, "bqw");
    assert!(quits(&app.update(exported(ExportId(1), "a.bmp", None))));
    let mut app = open(SCENE);
    press(&mut app, "bqn");
    assert!(!quits(&app.update(exported(ExportId(1), "a.bmp", None))));
    let mut app = open(SCENE);
    press(&mut app, "bqw");
    assert!(!quits(
        &app.update(Msg::Exported(ExportId(1), Err("full".into())))
    ));
    assert!(app.jobs.next.is_none() && words(&app) == "full");
}

#[test]
fn a_stopped_trace_continues() {
    let traces = traces_in_full;
    let mut app = open(SCENE);
    assert!(traces(&press(&mut app, "<F5>")));
    app.update(Msg::Started(Target::Trace, 1));
    assert!(!traces(&press(&mut app, "<Esc><F5>")), "it runs on");
    let effects = press(&mut app, "x");
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Halt(Target::Trace)
    )));
    assert!(traces(&press(&mut app, "<Esc><F5>")));
}

#[test]
fn a_trace_continues_what_an_earlier_run_left_of_its_text() {
    let recalled = |effects: &[Effect]| {
        let origin = effects.iter().find_map(|effect| match effect {
            Effect::Recall(_, origin) => Some(origin),
            _ => None,
        });
        origin.map(|origin| (origin.text.to_string(), origin.view.to_string()))
    };
    let mut app = open(SCENE);
    let text = SCENE.to_owned();
    assert_eq!(
        recalled(&press(&mut app, "<F5>")),
        Some((text.clone(), String::new()))
    );
    app.update(Msg::Recalled(Recalled::Continued(37)));
    assert_eq!(
        words(&app),
        "continuing the full-size trace that an earlier run left with 37 spp"
    );
    // In this run it continues from its own samples.
    app.update(Msg::Started(Target::Trace, 1));
    let effects = press(&mut app, "x<F5>");
    assert!(traces_in_full(&effects) && recalled(&effects).is_none());
    let reason = "the disk is broken".to_owned();
    app.update(Msg::Recalled(Recalled::Unreadable(reason.clone())));
    assert_eq!(words(&app), reason);

    let mut app = open(SCENE);
    press(&mut app, "vl");
    let (_, view) = recalled(&press(&mut app, "<F5>")).expect("it has an origin");
    assert!(view.contains("eye"), "{view}");

    let mut app = open(SCENE);
    outside(&mut app, "x");
    app.update(Msg::Elapsed(Timer::Settled));
    outside(&mut app, "x");
    let effects = press(&mut app, "<F5>");
    assert!(0 < app.error_count() && traces_in_full(&effects));
    assert_eq!(
        recalled(&effects),
        None,
        "the scene is not that of the text"
    );
}

#[test]
fn more_samples_of_an_earlier_run_are_continued_once_that_many_are_wanted() {
    let mut app = open(SCENE);
    press(&mut app, "<F5>");
    app.update(Msg::Started(Target::Trace, 1));
    app.update(Msg::Recalled(Recalled::More(512)));
    let until = ":until 512 spp";
    assert!(words(&app).contains(until), "{}", words(&app));
    let effects = press(&mut app, &format!("{until}<Enter>"));
    assert!(
        matches!(&effects[..], [Effect::Stop(Target::Trace), Effect::Recall(job, _)] if job.settings.spp == 512),
        "{effects:?}"
    );
    let effects = press(&mut app, ":until 600 spp<Enter>");
    assert!(matches!(effects[..], [Effect::Trace(Target::Trace, _)]));
}

#[test]
fn f5_continues_a_stopped_trace_but_not_a_running_one() {
    let begun = traces_in_full;
    let mut app = open(SCENE);
    assert!(begun(&press(&mut app, "<F5>")));
    app.update(Msg::Started(Target::Trace, 1));
    assert!(!begun(&press(&mut app, "<F5>")));
    press(&mut app, "x");
    assert_eq!(words(&app), "stopped; press F5 to continue");
    assert!(begun(&press(&mut app, "<F5>")));
    press(&mut app, "<Esc>");
    assert_eq!(app.mode, Mode::Select);
}
