//! Slow and failing saves.

use super::*;
use crate::file::ReadError;
use crate::ui::msg::{Guard, SaveId, SaveOutcome, Timer};
use std::sync::Arc;

#[test]
fn an_abandoned_save_does_not_quit_later() {
    let mut app = open(SCENE);
    app.disk.path = None;
    press(&mut app, "jjjel");
    // The answer to the question prompts for a name, which is not given.
    press(&mut app, "qw<Esc>");
    assert!(app.overlays.prompt.is_none());
    assert!(app.jobs.next.is_none());
}

pub(super) fn saved(app: &mut App, id: u32, path: &str, text: &Arc<String>) -> Vec<Effect> {
    let outcome = SaveOutcome::Saved {
        path: PathBuf::from(path),
        text: Arc::clone(text),
    };
    app.update(Msg::Saved(SaveId(id), outcome))
}

fn quits(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Quit))
}

/// The saves among the effects: number, file, guard.
fn saves(effects: &[Effect]) -> Vec<(u32, String, Guard)> {
    let saves = effects.iter().filter_map(|effect| match effect {
        Effect::Save {
            id, path, guard, ..
        } => Some((id.0, path.display().to_string(), guard.clone())),
        _ => None,
    });
    saves.collect()
}

#[test]
fn a_hanging_save_is_reported_and_delays_no_other_file() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "jjjel:w! stuck.ray<Enter>");
    assert_eq!(saves(&effects)[0].1, "stuck.ray");
    let ticks = |effects: &[Effect]| {
        wants(effects, |effect| {
            matches!(effect, Effect::Later(_, Timer::Writing))
        })
    };
    assert!(ticks(&effects));
    assert_eq!(app.jobs.still_writing(), None);
    for _ in 0..12 {
        assert!(ticks(&app.update(Msg::Elapsed(Timer::Writing))));
    }
    assert_eq!(app.jobs.still_writing(), Some((Path::new("stuck.ray"), 12)));

    let effects = press(&mut app, ":w free.ray<Enter>");
    assert_eq!(saves(&effects), [(2, "free.ray".to_owned(), Guard::Absent)]);
    let text = app.document.shared_text();
    saved(&mut app, 2, "free.ray", &text);
    assert_eq!(words(&app), "wrote free.ray");
    assert_eq!(app.disk.name(), "free.ray");
    // The late outcome no longer changes anything.
    saved(&mut app, 1, "stuck.ray", &Arc::new(SCENE.to_owned()));
    assert_eq!(
        (words(&app), app.disk.name().as_str()),
        ("wrote stuck.ray", "free.ray")
    );
    assert!(!app.document.is_dirty());
    assert!(!ticks(&app.update(Msg::Elapsed(Timer::Writing))));
    assert_eq!(app.jobs.still_writing(), None);
}

#[test]
fn saves_of_one_file_wait_for_each_other() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let first = app.document.shared_text();
    assert!(saves(&press(&mut app, "lw")).is_empty());
    assert!(saves(&press(&mut app, "l:wq<Enter>")).is_empty());
    let last = app.document.shared_text();
    let effects = saved(&mut app, 1, "scene.ray", &first);
    let expected = Guard::Holding(first);
    assert_eq!(saves(&effects), [(3, "scene.ray".to_owned(), expected)]);
    assert!(app.document.is_dirty());
    let effects = saved(&mut app, 3, "scene.ray", &last);
    assert!(!app.document.is_dirty());
    // The quit has waited for the last save.
    assert!(wants(&effects, |effect| matches!(effect, Effect::Quit)));
}

/// The previous save determines what the file holds, regardless of saves elsewhere meanwhile.
#[test]
fn a_waiting_save_may_replace_what_the_previous_one_wrote() {
    let failed = || SaveOutcome::Failed("full".to_owned());
    let cases: [(&str, &str, &str, Option<SaveOutcome>); 4] = [
        ("w", "w", "scene.ray", None),
        ("w", "w", "scene.ray", Some(failed())),
        (":w new.ray<Enter>", ":w new.ray<Enter>", "new.ray", None),
        (":w! new.ray<Enter>", ":w new.ray<Enter>", "new.ray", None),
    ];
    for (first, second, path, outcome) in cases {
        let mut app = open(SCENE);
        press(&mut app, &format!("jjjel{first}"));
        let written = app.document.shared_text();
        press(&mut app, &format!("l{second}"));
        press(&mut app, "l:w other.ray<Enter>");
        let other = app.document.shared_text();
        saved(&mut app, 3, "other.ray", &other);
        let is_written = outcome.is_none();
        let outcome = outcome.unwrap_or_else(|| SaveOutcome::Saved {
            path: PathBuf::from(path),
            text: Arc::clone(&written),
        });
        let effects = app.update(Msg::Saved(SaveId(1), outcome));
        let held = if is_written {
            written
        } else {
            Arc::new(SCENE.to_owned())
        };
        let expected = (2, path.to_owned(), Guard::Holding(held));
        assert_eq!(saves(&effects), [expected], "{first} {second}");
    }
}

#[test]
fn a_leading_dot_does_not_make_it_another_file() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "jjjel:w ./scene.ray<Enter>");
    let text = app.document.text().to_owned();
    let expected = (
        1,
        "scene.ray".to_owned(),
        Guard::Holding(Arc::new(SCENE.to_owned())),
    );
    assert_eq!(saves(&effects), [expected], "{text}");
}

/// The watcher may be faster than the outcome of the save.
#[test]
fn the_text_of_a_running_save_is_not_a_change() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let mine = app.document.shared_text();
    let said = words(&app).to_owned();
    outside(&mut app, &mine);
    assert_eq!(words(&app), said);
    assert!(app.document.is_dirty(), "the save has no outcome yet");
    saved(&mut app, 1, "scene.ray", &mine);
    assert!(outside(&mut app, &mine).is_empty());
    assert_eq!(words(&app), "wrote scene.ray");

    // What others write meanwhile is a change, but only once the save has ended.
    press(&mut app, "lw");
    let mine = app.document.shared_text();
    let theirs = mine.replace("1.5", "1.7");
    outside(&mut app, &theirs);
    assert_eq!(app.document.text(), *mine);
    saved(&mut app, 2, "scene.ray", &mine);
    outside(&mut app, &theirs);
    assert_eq!(app.document.text(), theirs);
}

#[test]
fn a_quit_waits_for_a_hanging_save_unless_forced() {
    let keeps = |effects: &[Effect]| {
        wants(effects, |effect| {
            matches!(effect, Effect::WriteRecovery { .. })
        })
    };
    for (keys, forced) in [
        (":q!<Enter>", true),
        ("<Ctrl-c>y", true),
        ("<Ctrl-c><Esc>", false),
    ] {
        let mut app = open(SCENE);
        assert!(!quits(&press(&mut app, "jjjel:wq<Enter>")));
        app.update(Msg::Elapsed(Timer::Writing));
        app.update(Msg::Elapsed(Timer::Writing));
        assert!(words(&app).starts_with("will quit once the save finishes"));
        let effects = press(&mut app, keys);
        // The text that was to be saved is not lost.
        assert_eq!(
            (quits(&effects), keeps(&effects)),
            (forced, forced),
            "{keys}"
        );
    }
    let mut app = open(SCENE);
    press(&mut app, "jjjel:wq<Enter>");
    let text = app.document.shared_text();
    assert!(quits(&saved(&mut app, 1, "scene.ray", &text)));
}

/// The file was changed by others, so the first `:wq` saves nothing; a later `w` only saves.
#[test]
fn a_conflict_cancels_the_quit_that_waits_for_the_save() {
    for quit in [":wq<Enter>", "qw"] {
        let mut app = open(SCENE);
        press(&mut app, "jjjel");
        let theirs = SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0");
        outside(&mut app, &theirs);
        press(&mut app, "<Esc>");
        assert!(saves(&press(&mut app, quit)).is_empty());
        outside(&mut app, &theirs);
        press(&mut app, "m<Enter>");
        assert_eq!(saves(&press(&mut app, "w")).len(), 1, "{quit}");
        let text = app.document.shared_text();
        let effects = saved(&mut app, 1, "scene.ray", &text);
        assert!(!quits(&effects), "{quit}");
    }
}

#[test]
fn save_and_quit_asks_for_a_missing_name_and_then_quits() {
    for quit in [":wq<Enter>", "qw"] {
        let mut app = open(SCENE);
        app.disk.path = None;
        assert!(!quits(&press(&mut app, &format!("jjjel{quit}"))));
        assert_eq!(saves(&press(&mut app, "new.ray<Enter>")).len(), 1, "{quit}");
        let text = app.document.shared_text();
        assert!(quits(&saved(&mut app, 1, "new.ray", &text)), "{quit}");
    }
}

#[test]
fn quitting_during_a_save_of_unchanged_text_asks() {
    let mut app = open(SCENE);
    press(&mut app, ":w copy.ray<Enter>q");
    assert!(matches!(
        app.overlays.dialog,
        Some(Dialog::Leave(AfterLeaving::Quit))
    ));
    assert_eq!(
        app.losses().as_deref(),
        Some("copy.ray is still being written")
    );
}

#[test]
fn another_failure_does_not_hide_why_a_save_failed() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let failed = SaveOutcome::Failed("scene.ray: no space left".to_owned());
    app.update(Msg::Saved(SaveId(1), failed));
    app.update(Msg::Failed("the unsaved edits cannot be kept".to_owned()));
    assert_eq!(
        words(&app),
        "scene.ray: no space left; the unsaved edits cannot be kept"
    );
}

#[test]
fn the_backup_of_an_interrupted_save_is_named() {
    let (mut app, effects) = opened(SCENE);
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::FindBackups(_)
    )));
    app.update(Msg::BackupsFound(vec![PathBuf::from(
        ".halflight-backup-1-2-scene.ray",
    )]));
    assert_eq!(
        words(&app),
        "a save of scene.ray was interrupted: the previous content is in \
         .halflight-backup-1-2-scene.ray; delete that file if you do not need it"
    );
}

#[test]
fn a_save_outdates_what_was_said_of_the_missing_file() {
    let mut app = open(SCENE);
    app.overlays.say("an earlier message");
    let missing = || {
        let path = PathBuf::from("scene.ray");
        Msg::Read(path.clone(), Err(ReadError::NotFound { path }))
    };
    app.update(missing());
    app.update(Msg::Elapsed(Timer::Settled));
    app.update(missing());
    let effects = press(&mut app, "w");
    let text = app.document.shared_text();
    saved(&mut app, saves(&effects)[0].0, "scene.ray", &text);
    assert_eq!(words(&app), "wrote scene.ray");
}

/// What is read of a file that is being written may be half of that.
#[test]
fn nothing_that_is_read_during_a_save_is_taken() {
    let reads = |effects: &[Effect]| {
        let reads = |effect: &&Effect| matches!(effect, Effect::Read(..));
        effects.iter().filter(reads).count()
    };
    let half = SCENE.replace("1.5", "1.7");
    let path = || PathBuf::from("scene.ray");
    let text_of = |app: &App| Arc::clone(&app.document.shared_text());
    let outcomes: [fn(PathBuf, Arc<String>) -> SaveOutcome; 4] = [
        |path, text| SaveOutcome::Saved { path, text },
        |_, _| SaveOutcome::ChangedOnDisk,
        |_, _| SaveOutcome::NoFolder("none".to_owned()),
        |_, _| SaveOutcome::Failed("full".to_owned()),
    ];
    let orders = [
        "w",
        ":w! ./scene.ray<Enter>",
        ":w! /a/link/of/it.ray<Enter>",
    ];
    for (outcome, order) in outcomes
        .into_iter()
        .flat_map(|outcome| orders.map(|order| (outcome, order)))
    {
        let mut app = open(SCENE);
        press(&mut app, "jjjel");
        let reading = Reading::new(half.clone(), app.baseline()).expect("it fits into memory");
        let requested_before = Msg::Read(path(), Ok(reading));
        press(&mut app, order);
        let mine = text_of(&app);

        for msg in [Msg::FileChanged, Msg::Elapsed(Timer::Settled)] {
            assert_eq!(reads(&app.update(msg)), 0);
        }
        assert_eq!(reads(&press(&mut app, ":e<Enter>")), 0);
        assert_eq!(reads(&outside(&mut app, &half)), 0);
        assert_eq!(text_of(&app), mine);

        let saved = outcome(path(), Arc::new(String::clone(&mine)));
        let effects = app.update(Msg::Saved(SaveId(1), saved));
        assert_eq!(reads(&effects), 1);
        assert_eq!(reads(&app.update(requested_before)), 1, "read anew");
        assert_eq!(text_of(&app), mine);
        assert!(app.overlays.dialog.is_none());
    }
}

/// Two windows: the other one saves between this one's save and its report.
#[test]
fn a_late_report_of_a_save_is_older_than_what_is_read_after_it() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let mine = app.document.shared_text();
    let theirs = mine.replace("4 0 0", "5 0 0");
    outside(&mut app, &theirs);
    saved(&mut app, 1, "scene.ray", &mine);
    outside(&mut app, &theirs);
    assert_eq!(app.document.text(), theirs);
    assert_eq!(**app.document.saved(), theirs);
    // Again in the same place: nobody else has changed this one.
    press(&mut app, "l");
    outside(&mut app, &theirs.replace("5 0 0\n1\n", "6 0 0\n1\n"));
    assert!(app.overlays.dialog.is_none());
    assert_eq!(changed_lines(&app), ["0.2 0 0", "6 0 0"]);
}

/// A save that waits begins at once when the one before ends.
#[test]
fn the_file_is_read_after_the_last_of_several_saves() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let first = app.document.shared_text();
    press(&mut app, "lw");
    let second = app.document.shared_text();
    let reads = |effects: &[Effect]| wants(effects, |effect| matches!(effect, Effect::Read(..)));
    assert!(!reads(&saved(&mut app, 1, "scene.ray", &first)));
    assert!(reads(&saved(&mut app, 2, "scene.ray", &second)));
}
