//! The interface before its scene is read.

use std::path::PathBuf;

use super::*;
use crate::file::ReadError;

/// The interface while its file is being read.
fn opening() -> (App, Vec<Effect>) {
    let mut opening = opening_as("scene.ray", String::new());
    opening.text = OpeningText::Unread(2_000_000_000);
    App::open(opening)
}

/// The message with the first reading of a file that holds this text.
fn read(effects: &[Effect], text: &str) -> Msg {
    let baseline = effects.iter().find_map(|effect| match effect {
        Effect::Read(path, baseline) => Some((path.clone(), baseline.clone())),
        _ => None,
    });
    let (path, baseline) = baseline.expect("it is to be read");
    Msg::Read(
        path,
        Ok(Reading::new(text.to_owned(), baseline).expect("it fits")),
    )
}

#[test]
fn a_scene_is_read_after_its_watch_began_and_shown_as_if_known() {
    for text in [SCENE, "", "no scene"] {
        let (mut app, effects) = opening();
        assert!(matches!(
            effects[..],
            [Effect::Watch(_), Effect::Read(..), Effect::FindBackups(_)]
        ));
        let first = read(&effects, text);
        let effects = app.update(first);
        let at_once = opened(text).0;
        assert!(!app.disk.is_opening());
        assert_eq!(app.document.text(), text);
        assert_eq!(app.diagnostics, at_once.diagnostics, "of {text:?}");
        assert_eq!(app.scene, at_once.scene);
        assert_eq!(app.cursor.selected(), at_once.cursor.selected());
        let traces = effects.iter().any(|e| matches!(e, Effect::Trace(..)));
        assert_eq!(traces, text == SCENE);
        assert!(!app.document.is_dirty());
    }
}

#[test]
fn actions_that_need_a_scene_are_refused_until_it_is_read() {
    for said in [
        "w",
        "b",
        "<F5>",
        "e",
        "E",
        "u",
        "5",
        ":w<Enter>",
        ":export a.bmp<Enter>",
    ] {
        let (mut app, _) = opening();
        let effects = press(&mut app, said);
        assert!(effects.is_empty(), "{said}: {effects:?}");
        let message = app.overlays.message.as_ref().expect("it says why");
        assert_eq!(message.text, "still opening scene.ray", "{said}");
    }
    let (mut app, _) = opening();
    app.update(Msg::Paste("1 2 3".to_owned()));
    assert!(app.overlays.message.is_some() && !app.document.is_dirty());
}

#[test]
fn help_and_quitting_need_no_scene() {
    let (mut app, _) = opening();
    press(&mut app, "?");
    assert!(app.overlays.help.is_some());
    press(&mut app, "q");
    assert!(app.overlays.help.is_none());
    for said in ["q", ":q<Enter>", "<Ctrl-c>"] {
        let (mut app, _) = opening();
        let effects = press(&mut app, said);
        assert!(matches!(effects[..], [Effect::Quit]), "{said}: {effects:?}");
    }
    for msg in [Msg::Terminate { signal: 15 }, Msg::HangUp] {
        let (mut app, _) = opening();
        assert!(matches!(app.update(msg)[..], [Effect::Quit]));
    }
}

#[test]
fn an_unreadable_scene_ends_the_interface() {
    let (mut app, _) = opening();
    let path = PathBuf::from("scene.ray");
    let error = ReadError::NotFound { path: path.clone() };
    let effects = app.update(Msg::Read(path, Err(error)));
    assert!(matches!(effects[..], [Effect::Quit]));
    assert!(matches!(
        app.disk.take_failure(),
        Some(ReadError::NotFound { .. })
    ));
}

#[test]
fn a_scene_whose_file_is_missing_is_written_again() {
    let mut opening = opening_as("scene.ray", String::new());
    opening.text = OpeningText::Kept(SCENE.to_owned());
    let (mut app, effects) = App::open(opening);
    let looks = |effect: &Effect| matches!(effect, Effect::LookForKept(_));
    assert!(wants(&effects, looks));
    assert_eq!(
        (&app.disk.state, app.document.text()),
        (&OnDisk::Missing, SCENE)
    );
    let quits = |effect: &Effect| matches!(effect, Effect::Quit);
    assert!(!wants(&press(&mut app, "q"), quits));
    assert_eq!(app.losses().as_deref(), Some("scene.ray no longer exists"));
    let effects = press(&mut app, "w");
    let saves = |effect: &Effect| matches!(effect, Effect::Save { text, .. } if **text == SCENE);
    assert!(wants(&effects, saves), "{effects:?}");
}

#[test]
fn kept_edits_are_looked_for_once_the_scene_is_read() {
    let looks = |effects: &[Effect]| {
        wants(
            effects,
            |effect| matches!(effect, Effect::LookForKept(sought) if *sought.text == SCENE),
        )
    };
    let (mut app, effects) = opening();
    assert!(!wants(&effects, |effect| matches!(
        effect,
        Effect::LookForKept(_)
    )));
    assert!(looks(&app.update(read(&effects, SCENE))));
}
