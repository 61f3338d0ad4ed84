//! Several exports, and files that others wrote.

use std::sync::Arc;

use super::pictures::frame;
use super::*;
use crate::scene::Size;
use crate::ui::msg::{Existing, Target};

const SIZE: Size = Size {
    width: 32,
    height: 8,
};

/// The ID and the file of the export that effects start.
fn started(effects: &[Effect]) -> Option<(ExportId, String, Existing)> {
    effects.iter().find_map(|effect| match effect {
        Effect::CheckTarget(id, to) => Some((*id, to.path.display().to_string(), to.existing)),
        _ => None,
    })
}

/// Lets the running export be traced and written.
fn finish(app: &mut App, id: u32, path: &str) -> Vec<Effect> {
    let done = Arc::new(frame(SIZE, vec![0; SIZE.pixels()]));
    app.update(Msg::Frame(Target::Export, done));
    app.update(exported(ExportId(id), path, None))
}

fn quits(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Quit))
}

#[test]
fn exports_run_one_after_the_other_and_each_is_reported() {
    let mut app = open(SCENE);
    for path in ["a", "b", "c"] {
        press(&mut app, &format!(":export {path}.bmp 32x8 1<Enter>"));
    }
    assert_eq!(words(&app), "queued: to c.bmp");
    // Another picture in the same file replaces the one that waits.
    press(&mut app, ":export b.bmp 16x8 1<Enter>");
    assert_eq!(app.jobs.queued(), 2);
    let effects = finish(&mut app, 1, "a.bmp");
    assert_eq!(
        started(&effects).map(|(_, path, _)| path),
        Some("c.bmp".into())
    );
    let effects = finish(&mut app, 3, "c.bmp");
    assert_eq!(
        started(&effects).map(|(_, path, _)| path),
        Some("b.bmp".into())
    );
    finish(&mut app, 4, "b.bmp");
    assert!(app.jobs.export.is_none());
    for path in ["a.bmp", "c.bmp", "b.bmp"] {
        let expected = format!("wrote {path}");
        assert!(shown(&app).starts_with(&expected), "{}", shown(&app));
        press(&mut app, "j");
    }
}

#[test]
fn a_cancelled_or_failed_export_lets_the_next_one_start() {
    let ends: [fn(&mut App) -> Vec<Effect>; 4] = [
        |app| press(app, "x"),
        |app| app.update(Msg::Ended(Target::Export)),
        |app| app.update(Msg::Refused(Target::Export, "too large".into())),
        |app| app.update(Msg::Exported(ExportId(1), Err("full".into()))),
    ];
    for end in ends {
        let mut app = open(SCENE);
        press(&mut app, ":export a.bmp<Enter>:export b.bmp<Enter>");
        let (id, path, _) = started(&end(&mut app)).expect("the next one");
        assert_eq!((id, &*path), (ExportId(2), "b.bmp"));
    }
}

#[test]
fn quitting_waits_for_all_exports() {
    let mut app = open(SCENE);
    press(&mut app, ":export a.bmp<Enter>:export b.bmp<Enter>");
    press(&mut app, "qw");
    assert_eq!(words(&app), "will quit once 2 exports finish");
    assert!(!quits(&finish(&mut app, 1, "a.bmp")));
    assert!(quits(&finish(&mut app, 2, "b.bmp")));
    let mut app = open(SCENE);
    press(&mut app, "bq<Esc>");
    assert!(app.overlays.dialog.is_none() && app.jobs.export.is_some());
    assert!(quits(&press(&mut app, "qy")));
}

#[test]
fn a_file_that_others_wrote_is_overwritten_or_numbered_as_the_user_decides() {
    let taken = |id| Msg::Taken(ExportId(id), "scene.bmp exists".into());
    for (answer, expected, said) in [
        ("y", Some(Existing::Overwritten), "exporting to scene.bmp"),
        ("n", Some(Existing::Numbered), ""),
        ("<Esc>", None, ""),
    ] {
        let mut app = open(SCENE);
        press(&mut app, "b");
        let effects = app.update(taken(1));
        assert_eq!(words(&app), "");
        assert!(wants(&effects, |e| matches!(
            e,
            Effect::Stop(Target::Export)
        )));
        assert!(app.jobs.export.is_none());
        let effects = press(&mut app, answer);
        let existing = started(&effects).map(|(_, _, existing)| existing);
        assert_eq!(existing, expected, "{answer}");
        assert_eq!(words(&app), said, "{answer}");
        assert_eq!(app.jobs.export.is_some(), expected.is_some());
    }
    // A command names the file, and how to overwrite it.
    let mut app = open(SCENE);
    press(&mut app, ":export scene.bmp<Enter>");
    app.update(taken(1));
    assert_eq!(words(&app), "scene.bmp exists");
    assert!(app.overlays.dialog.is_none());
}
