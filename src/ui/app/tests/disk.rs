//! Rereading, saving, conflicts, quitting.

use std::fs;
use std::sync::Arc;

use super::saving::saved;
use super::*;
use crate::document::Side;
use crate::file::ReadError;
use crate::ui::msg::{Guard, SaveId, SaveOutcome, Timer};
use crate::ui::scene_reading::SceneFolder;

#[test]
fn a_save_may_only_replace_what_was_last_seen() {
    let mut app = open(SCENE);
    let effects = press(&mut app, "jjjelw");
    let [
        ..,
        Effect::Save {
            path, text, guard, ..
        },
    ] = effects.as_slice()
    else {
        panic!("{effects:?}");
    };
    assert_eq!(path, &PathBuf::from("scene.ray"));
    assert_eq!(**text, app.document.text());
    assert_eq!(guard, &Guard::Holding(Arc::new(SCENE.to_owned())));
    let outcome = SaveOutcome::Saved {
        path: path.clone(),
        text: text.clone(),
    };
    app.update(Msg::Saved(SaveId(1), outcome));
    assert!(!app.document.is_dirty());
}

#[test]
fn a_save_over_a_changed_file_asks() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelw");
    let theirs = SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0");
    let effects = app.update(Msg::Saved(SaveId(1), SaveOutcome::ChangedOnDisk));
    assert!(matches!(&effects[..], [Effect::Read(..)]), "{effects:?}");
    assert!(
        words(&app).contains("nothing was written"),
        "{}",
        words(&app)
    );
    outside(&mut app, &theirs);
    let Some(Dialog::Conflict { merge, .. }) = &app.overlays.dialog else {
        panic!("{:?}", app.overlays.dialog);
    };
    assert_eq!(merge.conflicts.len(), 1);
    assert_eq!(app.disk.state, OnDisk::Changed);
    press(&mut app, "<Enter>");
    assert!(app.overlays.dialog.is_some(), "nothing is decided yet");
    press(&mut app, "t<Enter>");
    assert_eq!(app.document.text(), theirs);
    assert_eq!(app.disk.state, OnDisk::Known);
}

#[test]
fn a_postponed_conflict_returns_with_the_next_save() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    outside(&mut app, &SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0"));
    press(&mut app, "<Esc>");
    assert!(app.overlays.dialog.is_none());
    assert_eq!(changed_lines(&app), ["0.1 0 0"], "mine is kept");
    let effects = press(&mut app, "w");
    assert!(wants(&effects, |effect| matches!(effect, Effect::Read(..))));
}

#[test]
fn a_postponed_conflict_ends_when_the_edits_are_undone() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let theirs = SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0");
    outside(&mut app, &theirs);
    press(&mut app, "<Esc>");
    let effects = press(&mut app, "u");
    assert!(wants(&effects, |effect| matches!(effect, Effect::Read(..))));
    outside(&mut app, &theirs);
    assert_eq!(app.document.text(), theirs);
    assert_eq!(app.disk.state, OnDisk::Known);
}

#[test]
fn all_conflicts_can_be_decided_at_once() {
    for (key, decided) in [("M", Side::Mine), ("T", Side::Theirs)] {
        let mut app = open(SCENE);
        press(&mut app, "jjjeljl");
        let theirs = SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0");
        outside(&mut app, &theirs.replace("1.5", "1.9"));
        press(&mut app, key);
        let Some(Dialog::Conflict { merge, .. }) = &app.overlays.dialog else {
            panic!("{:?}", app.overlays.dialog);
        };
        assert!(merge.conflicts.iter().all(|c| c.decision == Some(decided)));
        press(&mut app, "<Enter>");
        let mine = app.document.text().contains("0.1 0 0");
        assert_eq!(mine, decided == Side::Mine);
    }
}

#[test]
fn a_changed_file_is_reloaded_when_nothing_is_unsaved() {
    let mut app = open(SCENE);
    let theirs = SCENE.replace("1.5", "1.7");
    let effects = app.update(Msg::FileChanged);
    assert!(wants(&effects, |effect| matches!(effect, Effect::Read(..))));
    let effects = outside(&mut app, &theirs);
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Trace(..)
    )));
    assert_eq!(app.document.text(), theirs);
    assert!(!app.document.is_dirty());
    assert!(outside(&mut app, &theirs).is_empty(), "nothing is new");
}

/// Keys arrive while a large file is being parsed and lowered.
#[test]
fn a_reading_compared_with_an_outdated_text_is_repeated() {
    let mut app = open(SCENE);
    let late = |app: &App| {
        let theirs = app.document.text().replace("1.5", "1.7");
        let reading = Reading::new(theirs, app.baseline()).expect("it fits into memory");
        Msg::Read(PathBuf::from("scene.ray"), Ok(reading))
    };
    let before = late(&app);
    press(&mut app, "jjjelw");
    app.update(Msg::Saved(
        SaveId(1),
        SaveOutcome::Saved {
            path: PathBuf::from("scene.ray"),
            text: app.document.shared_text(),
        },
    ));
    let effects = app.update(before);
    assert!(matches!(effects[..], [Effect::Read(..), Effect::Free(_)]));
    assert_eq!(changed_lines(&app), ["0.1 0 0"]);

    // An edit would have to be merged with the file's change.
    let before = late(&app);
    press(&mut app, "l");
    let effects = app.update(before);
    assert!(matches!(
        effects[..],
        [Effect::Read(..), Effect::Free(_), ..]
    ));
    assert_eq!(changed_lines(&app), ["0.2 0 0"]);
    let merged = late(&app);
    app.update(merged);
    assert_eq!(changed_lines(&app), ["0.2 0 0", "1.7 // the radius"]);
}

#[test]
fn a_reading_of_another_file_is_ignored() {
    let mut app = open(SCENE);
    let theirs = SCENE.replace("1.5", "1.7");
    read(&mut app, "before.ray", &theirs);
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn a_file_is_read_again_once_it_is_watched() {
    let (mut app, effects) = opened(SCENE);
    assert!(matches!(
        &effects[..],
        [Effect::Watch(path), Effect::Read(read, _), ..] if path == read
    ));
    assert!(outside(&mut app, SCENE).is_empty());
    assert_eq!(words(&app), "");
}

#[test]
fn changes_in_different_places_are_merged_as_one_step() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    outside(&mut app, &SCENE.replace("1.5", "1.7"));
    assert_eq!(changed_lines(&app), ["0.1 0 0", "1.7 // the radius"]);
    assert!(app.overlays.dialog.is_none() && app.document.is_dirty());
    let lowered = app.lowered();
    assert_eq!(app.scene.as_deref(), lowered.scene.as_ref());
    press(&mut app, "u");
    assert_eq!(changed_lines(&app), ["0.1 0 0"]);
}

#[test]
fn a_file_equal_to_the_edits_counts_as_saved() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let mine = app.document.text().to_owned();
    outside(&mut app, &mine);
    assert!(!app.document.is_dirty());
    assert!(
        words(&app).starts_with("the file now has the same changes"),
        "{}",
        words(&app)
    );
    press(&mut app, "u");
    assert_eq!(app.document.text(), SCENE, "the edit is a step still");

    // But not if the file has only one of them.
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let one = app.document.text().to_owned();
    press(&mut app, "jl");
    outside(&mut app, &one);
    assert!(app.document.is_dirty());
    assert_eq!(
        words(&app),
        "merged the file's changes with your edits: the picture is unchanged; \
         press u to undo the merge"
    );
    let other = one.replace("4 0 0", "5 0 0");
    outside(&mut app, &other);
    assert_eq!(
        words(&app),
        "merged the file's changes with your edits: object 2 (sphere) centre x; \
         press u to undo the merge"
    );
}

#[test]
fn a_moved_or_replaced_folder_is_reported() {
    let directory = tempfile::tempdir().expect("a folder");
    let at = |name: &str| directory.path().join(name);
    fs::create_dir(at("one")).expect("the folder is new");
    fs::create_dir(at("two")).expect("the folder is new");
    let file = |folder: &str| at(folder).join("scene.ray");
    let place = |folder: &str| SceneFolder::of(&file(folder));
    // A place with the path of one folder and the identity of another.
    let of_other = |path: &str, folder: &str| {
        let [path, other] = [place(path), place(folder)].map(|place| place.expect("there"));
        Some(SceneFolder {
            id: other.id,
            ..path
        })
    };
    let (one, two) = (at("one"), at("two"));
    let moved = format!("the scene's folder was moved to {}", two.display());
    let replaced = format!("{} is now a different folder", one.display());
    let theirs = SCENE.replace("1.5", "1.7");
    let news = "; reloaded: object 1 (sphere) radius";
    for (then, text, expected) in [
        (place("one"), SCENE, String::new()),
        (None, SCENE, String::new()),
        (of_other("two", "one"), SCENE, moved.clone()),
        (of_other("two", "one"), &theirs, format!("{moved}{news}")),
        (of_other("one", "two"), SCENE, replaced.clone()),
        (of_other("one", "two"), &theirs, format!("{replaced}{news}")),
    ] {
        let mut app = open(SCENE);
        let mut read = |text: &str, place| {
            app.overlays.message = None;
            let reading = Reading::new(text.to_owned(), app.baseline()).expect("it fits");
            let reading = Reading { place, ..reading };
            app.update(Msg::Read(PathBuf::from("scene.ray"), Ok(reading)));
            words(&app).to_owned()
        };
        assert_eq!(read(SCENE, place("one")), "");
        assert_eq!(read(text, then.clone()), expected);
        assert_eq!(read(text, then), "", "said once");
    }
}

/// A file is read after each save; the result, that nothing has changed, may arrive late.
#[test]
fn an_unchanged_file_is_not_read_again_because_of_an_edit() {
    let mut app = open(SCENE);
    let reading = Reading::new(SCENE.to_owned(), app.baseline()).expect("it fits into memory");
    press(&mut app, "jjjel");
    let effects = app.update(Msg::Read(PathBuf::from("scene.ray"), Ok(reading)));
    assert!(
        !wants(&effects, |effect| matches!(effect, Effect::Read(..))),
        "{effects:?}"
    );
    assert_eq!(changed_lines(&app), ["0.1 0 0"]);
}

#[test]
fn errors_must_persist_before_they_are_shown() {
    for broken in ["", "1 1 1 2", "nonsense"] {
        let mut app = open(SCENE);
        let effects = outside(&mut app, broken);
        assert!(matches!(
            effects[..],
            [Effect::Later(_, Timer::Settled), Effect::Free(_)]
        ));
        assert_eq!(app.document.text(), SCENE, "not yet");
        let effects = app.update(Msg::Elapsed(Timer::Settled));
        assert!(matches!(effects[..], [Effect::Read(..)]));
        outside(&mut app, broken);
        assert_eq!(app.document.text(), broken);
        assert!(0 < app.error_count());
        let scene = app.scene.as_ref().expect("the last good scene is kept");
        assert_eq!(scene.objects.len(), 2);
        outside(&mut app, SCENE);
        assert_eq!(app.error_count(), 0);
    }
}

#[test]
fn a_text_with_errors_is_kept_apart_from_unsaved_edits() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    outside(&mut app, "nonsense");
    app.update(Msg::Elapsed(Timer::Settled));
    outside(&mut app, "nonsense");
    assert!(app.is_disk_wrong());
    assert_eq!(changed_lines(&app), ["0.1 0 0"]);
    assert!(
        words(&app).starts_with("line 1 of the file"),
        "{}",
        words(&app)
    );
    assert!(words(&app).contains(":w!"), "{}", words(&app));
    let (text, wrong) = (app.wrong().text, app.wrong().findings);
    assert_eq!((text, wrong.is_empty()), ("nonsense", false));
    press(&mut app, "!");
    assert_eq!(app.overlays.errors, Some(0));
    let effects = press(&mut app, "E");
    assert!(matches!(effects[..], [Effect::OpenEditor { line: 1, .. }]));
    outside(&mut app, SCENE);
    assert_eq!(app.disk.state, OnDisk::Known);
    assert_eq!((app.overlays.errors, app.wrong().findings.len()), (None, 0));
}

#[test]
fn an_unreadable_file_replaces_its_earlier_errors() {
    let unreadable = || {
        let path = PathBuf::from("scene.ray");
        let kind = "a folder";
        Msg::Read(path.clone(), Err(ReadError::NotRegular { path, kind }))
    };
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    outside(&mut app, "nonsense");
    app.update(Msg::Elapsed(Timer::Settled));
    outside(&mut app, "nonsense");
    assert!(app.is_disk_wrong());
    app.update(unreadable());
    app.update(Msg::Elapsed(Timer::Settled));
    app.update(unreadable());
    assert_eq!(words(&app), "scene.ray: is a folder, not a file");
    assert_eq!(
        (&app.disk.state, app.wrong().findings.len()),
        (&OnDisk::Unreadable, 0)
    );
    let effects = press(&mut app, "w");
    assert!(matches!(effects[..], [Effect::Read(..)]), "{effects:?}");
}

#[test]
fn a_missing_file_is_reported_after_a_while_until_it_is_back() {
    let missing = || {
        let path = PathBuf::from("scene.ray");
        Msg::Read(path.clone(), Err(ReadError::NotFound { path }))
    };
    let mut app = open(SCENE);
    app.update(missing());
    assert_eq!(
        app.disk.state,
        OnDisk::Known,
        "another name may be on its way"
    );
    app.update(Msg::Elapsed(Timer::Settled));
    app.update(missing());
    assert_eq!(app.disk.state, OnDisk::Missing);
    outside(&mut app, SCENE);
    assert_eq!(app.disk.state, OnDisk::Known);
    assert_eq!(words(&app), "the file matches the saved text again");
}

#[test]
fn quitting_asks_only_about_unsaved_edits() {
    let quits = |said: &str| {
        let mut app = open(SCENE);
        let effects = press(&mut app, said);
        wants(&effects, |effect| matches!(effect, Effect::Quit))
    };
    for said in ["q", "<Ctrl-c>", ":q<Enter>", "jjjelq" /* asks */] {
        assert_eq!(quits(said), !said.starts_with("jjjel"), "{said}");
    }
    assert!(quits("jjjelqy"));
    assert!(quits("jjjel:q!<Enter>"));
    assert!(!quits("jjjelqn"));
    assert!(!quits("jjjelq<Esc>"));
}

#[test]
fn a_second_interrupt_quits_and_keeps_the_edits() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel<Ctrl-c>");
    let effects = press(&mut app, "<Ctrl-c>");
    assert!(matches!(
        &effects[..],
        [Effect::WriteRecovery { scene: Some(_), known, .. }, Effect::Quit]
            if **known.text() == app.document.text()
    ));
    let mut app = open(SCENE);
    press(&mut app, "jjjel<Ctrl-c><Esc>");
    app.update(Msg::Elapsed(Timer::Interrupt));
    let effects = press(&mut app, "<Ctrl-c>");
    assert!(!wants(&effects, |effect| matches!(effect, Effect::Quit)));
}

#[test]
fn a_scene_without_a_file_asks_for_one() {
    let mut app = open(SCENE);
    app.disk.path = None;
    press(&mut app, "w");
    let effects = press(&mut app, "new.ray<Enter>");
    assert!(matches!(
        &effects[..],
        [.., Effect::Save { path, guard: Guard::Absent, .. }] if path == &PathBuf::from("new.ray")
    ));
}

#[test]
fn a_reread_without_a_file_is_not_answered_later() {
    let mut app = open(SCENE);
    app.disk.path = None;
    press(&mut app, ":e<Enter>");
    assert!(words(&app).contains("has no file yet"), "{}", words(&app));
    press(&mut app, "<Esc>:w new.ray<Enter>");
    let text = app.document.shared_text();
    saved(&mut app, 1, "new.ray", &text);
    outside(&mut app, SCENE);
    assert_eq!(words(&app), "wrote new.ray");
}

#[test]
fn a_reload_without_unsaved_edits_cannot_be_undone() {
    let mut app = open(SCENE);
    let theirs = SCENE.replace("1.5", "1.7");
    press(&mut app, "jjjelu");
    outside(&mut app, &theirs);
    for key in ["u", "<Ctrl-r>"] {
        press(&mut app, key);
        assert_eq!(app.document.text(), theirs, "{key}");
        assert!(words(&app).starts_with("nothing to "), "{}", words(&app));
    }
}

#[test]
fn a_text_with_errors_is_written_only_by_force() {
    let saves = |said: &str| {
        let mut app = open(&SCENE.replace("\n4 0 0\n1\n", "\n4 0 0\n-1\n"));
        let effects = press(&mut app, said);
        let saves = wants(&effects, |effect| matches!(effect, Effect::Save { .. }));
        (saves, words(&app).to_owned())
    };
    let refused = "line 13 has an error: use :w! to save anyway";
    assert_eq!(saves("jelw"), (false, refused.to_owned()));
    assert_eq!(saves("jel:wq<Enter>"), (false, refused.to_owned()));
    let other = "line 13 has an error: use :w! b.ray to save anyway";
    assert_eq!(saves("jel:w b.ray<Enter>"), (false, other.to_owned()));
    assert!(saves("jel:w!<Enter>").0);
    assert!(saves("jel:w! b.ray<Enter>").0);
}

#[test]
fn a_value_being_typed_survives_a_reload() {
    let first = SCENE.find("sphere").expect("an object");
    let rest = &SCENE[first..];
    let longer = SCENE.replace(
        "1\n5 5 5 // the light\n1 1 1\n2\n",
        "2\n5 5 5\n1 1 1\n9 9 9\n1 1 1\n2\n",
    );
    let more = SCENE.replacen("\n2\nsphere", "\n3\nsphere", 1);
    let (head, tail) = more.split_at(first);
    let with_another = format!(
        "{head}{rest_first}{tail}",
        rest_first = &rest[..=rest.find("\nsphere").expect("two")]
    );
    for theirs in [SCENE.replace("1.5", "1.7"), longer, with_another] {
        for dirty in ["", "jjj<Enter>jl<Esc>ggj"] {
            let mut app = open(SCENE);
            press(&mut app, dirty);
            press(&mut app, "Ge<Tab>42");
            outside(&mut app, &theirs);
            if app.overlays.dialog.is_some() {
                press(&mut app, "T<Enter>");
            }
            assert_eq!(app.mode, Mode::Edit);
            press(&mut app, "<Enter>");
            assert!(
                app.document.text().contains("sphere\n4 42 0\n"),
                "{}",
                app.document.text()
            );
        }
    }
}

#[test]
fn a_value_being_typed_is_discarded_with_its_field() {
    let mut app = open(SCENE);
    press(&mut app, "Gejjj7");
    let objects = SCENE.find("2\nsphere").expect("a count of objects");
    let theirs = format!("{}0\n", &SCENE[..objects]);
    outside(&mut app, &theirs);
    app.update(Msg::Elapsed(Timer::Settled));
    outside(&mut app, &theirs);
    assert!(app.cursor.typing.is_none(), "{:?}", app.cursor.selected());
    press(&mut app, "j");
    assert!(words(&app).contains("discarded"), "{}", words(&app));
}

#[test]
fn the_list_of_errors_follows_the_text() {
    let wrong = |text: &str| {
        let mut app = open(
            &SCENE
                .replace("1.5", "-1")
                .replace("\n4 0 0\n1\n", "\n4 0 0\n-1\n"),
        );
        assert_eq!(app.error_count(), 2);
        press(&mut app, "!j");
        assert_eq!(app.overlays.errors, Some(1));
        outside(&mut app, text);
        app.update(Msg::Elapsed(Timer::Settled));
        outside(&mut app, text);
        app.overlays.errors
    };
    assert_eq!(wrong(&SCENE.replace("1.5", "-1")), Some(0));
    assert_eq!(wrong(SCENE), None);
}

#[test]
fn a_reload_names_what_differs_from_the_last_good_text() {
    let mut app = open(SCENE);
    let broken = |app: &mut App, text: &str| {
        outside(app, text);
        app.update(Msg::Elapsed(Timer::Settled));
        outside(app, text);
    };
    broken(&mut app, "x");
    broken(&mut app, "x y");
    outside(&mut app, SCENE);
    assert_eq!(words(&app), "reloaded: the scene is unchanged");
    broken(&mut app, "x");
    outside(&mut app, &SCENE.replace("1.5", "1.7"));
    assert_eq!(words(&app), "reloaded: object 1 (sphere) radius");
}

#[test]
fn saving_without_changes_writes_nothing() {
    let saves = |effects: &[Effect]| wants(effects, |effect| matches!(effect, Effect::Save { .. }));
    let mut app = open(SCENE);
    assert!(!saves(&press(&mut app, "w")));
    assert_eq!(words(&app), "nothing to save");
    assert!(saves(&press(&mut app, ":w!<Enter>")));
    let text = app.document.shared_text();
    saved(&mut app, 1, "scene.ray", &text);
    app.disk.state = OnDisk::Missing;
    assert!(saves(&press(&mut app, "w")));
    let effects = press(&mut open(SCENE), ":wq<Enter>");
    assert!(matches!(effects[..], [Effect::Quit]));
}

#[test]
fn commands_and_pastes_without_effect_say_why() {
    let mut app = open(SCENE);
    press(&mut app, ":e<Enter>");
    outside(&mut app, SCENE);
    assert_eq!(words(&app), "scene.ray has not changed");
    app.disk.path = None;
    press(&mut app, "w");
    assert!(app.overlays.prompt.is_some() && words(&app).contains("no file yet"));
    press(&mut app, "<Esc>");
    app.update(Msg::Paste("1 2 3".to_owned()));
    assert!(words(&app).contains("to paste values into fields"));
}

#[test]
fn text_is_pasted_into_the_line_that_keys_go_to() {
    let mut app = open(SCENE);
    press(&mut app, "?/");
    app.update(Msg::Paste("undo".to_owned()));
    let help = app.overlays.help.as_ref().expect("it is open");
    assert_eq!(help.search.value(), "undo");
}

/// The reason for the question is gone: the file holds the base of the edits again.
#[test]
fn a_conflict_ends_when_its_change_is_reverted() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    outside(&mut app, &SCENE.replace("sphere\n0 0 0", "sphere\n9 0 0"));
    assert!(app.overlays.dialog.is_some());
    outside(&mut app, SCENE);
    assert!(app.overlays.dialog.is_none());
    assert_eq!(app.disk.state, OnDisk::Known);
    assert!(app.document.is_dirty());
}
