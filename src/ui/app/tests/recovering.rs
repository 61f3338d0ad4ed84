//! Keeping unsaved edits, and restoring those of earlier runs.

use std::sync::Arc;

use super::*;
use crate::ui::msg::{Guard, SaveId, SaveOutcome, Timer};
use crate::ui::recovery::tests::offer;
use crate::ui::recovery::{Found, Offer};

/// The revision that is to be written, if any.
fn ordered(effects: &[Effect]) -> Option<u64> {
    effects.iter().find_map(|effect| match effect {
        Effect::WriteRecovery { revision, .. } => Some(*revision),
        _ => None,
    })
}

/// The delay of the next attempt to keep edits, in seconds.
fn put_off(effects: &[Effect]) -> Option<u64> {
    effects.iter().find_map(|effect| match effect {
        Effect::Later(time, Timer::Keep) => Some(time.as_secs()),
        _ => None,
    })
}

fn elapse(app: &mut App) -> Vec<Effect> {
    app.update(Msg::Elapsed(Timer::Keep))
}

const IS_FULL: &str = "unsaved edits cannot be kept for recovery: it is full";

fn fail(app: &mut App, revision: u64) -> Vec<Effect> {
    app.update(Msg::Kept(revision, Err("it is full".to_owned())))
}

fn saved(app: &App) -> Msg {
    Msg::Saved(
        SaveId(1),
        SaveOutcome::Saved {
            path: PathBuf::from("scene.ray"),
            text: app.document.shared_text(),
        },
    )
}

#[test]
fn unsaved_edits_are_kept_once_and_forgotten_when_none_are_left() {
    let mut app = open(SCENE);
    assert_eq!(put_off(&press(&mut app, "jjjel")), Some(1));
    assert_eq!(
        put_off(&press(&mut app, "l")),
        None,
        "a held key waits once"
    );
    let effects = elapse(&mut app);
    let [
        Effect::WriteRecovery {
            scene,
            known,
            revision,
        },
    ] = &effects[..]
    else {
        panic!("{effects:?}");
    };
    assert_eq!(scene.as_deref(), Some(Path::new("scene.ray")));
    assert_eq!(
        (known.saved.as_str(), known.text().as_str()),
        (SCENE, app.document.text())
    );
    assert!(elapse(&mut app).is_empty(), "the answer is awaited");
    assert!(app.update(Msg::Kept(*revision, Ok(()))).is_empty());
    assert!(elapse(&mut app).is_empty());
    assert_eq!(put_off(&press(&mut app, "u")), Some(1));
    let effects = elapse(&mut app);
    assert!(matches!(effects[..], [Effect::DropRecovery]));
}

#[test]
fn keeping_edits_is_retried_after_a_failure() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let mut delays = Vec::new();
    for round in 0..8 {
        let revision = ordered(&elapse(&mut app)).expect("it is tried again");
        delays.extend(put_off(&fail(&mut app, revision)));
        assert!(app.fails_to_keep());
        assert_eq!(
            words(&app),
            if round == 0 { IS_FULL } else { "" },
            "said once"
        );
        app.overlays.message = None;
    }
    assert_eq!(delays, [1, 2, 4, 8, 16, 30, 30, 30]);
    // New edits are not delayed that long.
    assert_eq!(put_off(&press(&mut app, "l")), Some(1));
    assert_eq!(
        put_off(&press(&mut app, "l")),
        None,
        "a held key puts nothing off"
    );
    let revision = ordered(&elapse(&mut app)).expect("it is tried again");
    fail(&mut app, revision);
    // Neither is the end.
    let revision = ordered(&app.update(Msg::HangUp)).expect("it is tried again");
    app.update(Msg::Kept(revision, Ok(())));
    assert!(!app.fails_to_keep());
}

#[test]
fn edits_are_kept_once_more_at_the_end() {
    for end in [Msg::HangUp, Msg::Terminate { signal: 15 }] {
        let mut app = open(SCENE);
        press(&mut app, "jjjel");
        let revision = ordered(&elapse(&mut app)).expect("an edit");
        app.update(Msg::Kept(revision, Ok(())));
        assert!(elapse(&mut app).is_empty(), "they are kept");
        // The journal may have been removed by others.
        assert_eq!(ordered(&app.update(end)), Some(revision));
    }
}

#[test]
fn messages_about_unkept_edits_disappear_once_they_are_kept() {
    for (said, left) in [(None, ""), (Some("something else"), "something else")] {
        let mut app = open(SCENE);
        press(&mut app, "jjjel");
        let revision = ordered(&elapse(&mut app)).expect("an edit");
        fail(&mut app, revision);
        assert_eq!(words(&app), IS_FULL);
        if let Some(said) = said {
            app.overlays.say(said);
        }
        let revision = ordered(&elapse(&mut app)).expect("it is tried again");
        app.update(Msg::Kept(revision, Ok(())));
        assert_eq!(words(&app), left);
        assert!(!app.fails_to_keep());
    }
}

#[test]
fn edits_count_as_kept_once_they_are() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let first = ordered(&elapse(&mut app)).expect("an edit");
    press(&mut app, "l");
    let second = ordered(&elapse(&mut app)).expect("another");
    app.update(Msg::Kept(first, Ok(())));
    assert!(elapse(&mut app).is_empty(), "the second is on its way");
    fail(&mut app, second);
    assert_eq!(ordered(&elapse(&mut app)), Some(second));
}

#[test]
fn edits_made_while_the_scene_was_saved_are_kept_at_once() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    let revision = ordered(&elapse(&mut app)).expect("an edit");
    app.update(Msg::Kept(revision, Ok(())));
    let outcome = saved(&app);
    press(&mut app, "l");
    let effects = app.update(outcome);
    assert_eq!(ordered(&effects), Some(app.document.revision()));
    let outcome = saved(&app);
    let effects = app.update(outcome);
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::DropRecovery
    )));
}

/// An offer, for the current text, of edits with this base.
fn kept(app: &App, base: &str, text: &str) -> Offer {
    offer(
        app.document.language(),
        &app.document.shared_text(),
        base,
        text,
    )
}

fn recovered(offer: Offer) -> Msg {
    Msg::Recovered(Found {
        offer: Some(Box::new(offer)),
        complaints: Vec::new(),
    })
}

/// [`SCENE`] with another radius, and the first sphere elsewhere.
fn variant(radius: &str, x: &str) -> String {
    let scene = SCENE.replace("1.5", radius);
    scene.replace("sphere\n0 0 0", &format!("sphere\n{x} 0 0"))
}

fn looks(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::LookForKept(_)))
}

#[test]
fn kept_edits_can_be_restored_and_undone() {
    let mut app = open(SCENE);
    let mine = variant("1.7", "0");
    let offer = kept(&app, SCENE, &mine);
    app.update(recovered(offer));
    press(&mut app, "j");
    assert_eq!(words(&app), "answer the question first: r, d, Esc");
    let effects = press(&mut app, "r");
    // The old journal is removed once the new one is written; others may be left.
    let adopted = |effect: &Effect| matches!(effect, Effect::AdoptKept(_));
    assert!(wants(&effects, adopted) && ordered(&effects).is_some() && looks(&effects));
    assert_eq!(app.document.text(), mine);
    press(&mut app, "u");
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn kept_edits_can_be_discarded() {
    let mut app = open(SCENE);
    let offer = kept(&app, SCENE, &variant("1.7", "0"));
    app.update(recovered(offer));
    let effects = press(&mut app, "d");
    let dropped = |effect: &Effect| matches!(effect, Effect::DropKept(_));
    assert!(wants(&effects, dropped) && looks(&effects));
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn postponed_kept_edits_are_left_alone() {
    let mut app = open(SCENE);
    let offer = kept(&app, SCENE, &variant("1.7", "0"));
    let name = offer.claim.name().to_owned();
    app.update(recovered(offer));
    let mut effects = press(&mut app, "<Esc>");
    let [Effect::LookForKept(sought)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(sought.put_off, [name]);
    effects.extend(press(&mut app, "jjjelw"));
    effects.extend(app.update(saved(&app)));
    effects.extend(press(&mut app, "q"));
    assert!(!wants(&effects, |effect| matches!(
        effect,
        Effect::DropKept(_) | Effect::AdoptKept(_)
    )));
}

#[test]
fn a_file_that_has_changed_since_is_merged_with_kept_edits() {
    let theirs = variant("1.5", "9");
    let mut app = open(&theirs);
    let offer = kept(&app, SCENE, &variant("1.7", "0"));
    assert_eq!((offer.places, offer.conflicts()), (1, 0));
    app.update(recovered(offer));
    press(&mut app, "r");
    assert_eq!(app.document.text(), variant("1.7", "9"));
    assert!(words(&app).contains("merged"), "{}", words(&app));
    let effects = press(&mut app, "w");
    let guard = effects.iter().find_map(|effect| match effect {
        Effect::Save { guard, .. } => Some(guard.clone()),
        _ => None,
    });
    assert_eq!(guard, Some(Guard::Holding(Arc::new(theirs.clone()))));
    press(&mut app, "u");
    assert_eq!(
        app.document.text(),
        theirs,
        "no undo takes the file's change back"
    );
}

#[test]
fn conflicts_between_kept_edits_and_the_file_are_asked_about() {
    let theirs = variant("1.9", "9");
    for (keys, left) in [
        ("r<Enter>", &theirs),
        ("rm<Enter>", &variant("1.7", "9")),
        ("rM<Enter>", &variant("1.7", "9")),
        ("rt<Enter>", &theirs),
        ("rT<Enter>", &theirs),
        ("r<Esc>", &theirs),
    ] {
        let mut app = open(&theirs);
        let offer = kept(&app, SCENE, &variant("1.7", "0"));
        assert_eq!(offer.conflicts(), 1);
        app.update(recovered(offer));
        let effects = press(&mut app, keys);
        assert_eq!(app.document.text(), *left, "{keys}");
        assert_eq!(app.document.saved().as_str(), theirs, "{keys}");
        assert_eq!(app.overlays.dialog.is_some(), keys == "r<Enter>", "{keys}");
        let dropped = wants(&effects, |effect| matches!(effect, Effect::DropKept(_)));
        assert_eq!(
            dropped,
            ["rt<Enter>", "rT<Enter>"].contains(&keys),
            "{keys}"
        );
        if app.document.is_dirty() {
            press(&mut app, "u");
            assert_eq!(app.document.text(), theirs, "{keys}");
        }
    }
}

#[test]
fn an_offer_follows_the_file() {
    for keys in ["", "r"] {
        let mut app = open(&variant("1.9", "9"));
        let late = kept(&app, SCENE, &variant("1.7", "0"));
        app.update(recovered(late.clone()));
        press(&mut app, keys);
        let effects = outside(&mut app, &variant("1.6", "9"));
        assert!(looks(&effects) && app.overlays.dialog.is_none());
        // The answer is outdated by now.
        assert!(looks(&app.update(recovered(late))) && app.overlays.dialog.is_none());
    }
}

#[test]
fn one_question_is_asked_at_a_time() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelq");
    let offer = kept(&app, SCENE, &variant("1.7", "0"));
    app.update(recovered(offer));
    assert!(matches!(
        app.overlays.dialog,
        Some(Dialog::Leave(AfterLeaving::Quit))
    ));
    press(&mut app, "n");
    assert!(matches!(app.overlays.dialog, Some(Dialog::Recover(_))));
    press(&mut app, "r");
    assert_eq!(
        app.document.text(),
        variant("1.7", "0.1"),
        "both are in the text"
    );
}

#[test]
fn complaints_about_kept_edits_are_shown() {
    let mut app = open(SCENE);
    let mut complain = |complaints: &[&str]| {
        app.overlays.message = None;
        app.update(Msg::Recovered(Found {
            offer: None,
            complaints: complaints.iter().map(ToString::to_string).collect(),
        }));
        app.overlays
            .message
            .as_ref()
            .map(|message| message.text.clone())
    };
    for (complaints, said) in [
        (["a is damaged"].as_slice(), Some("a is damaged")),
        (&["a is damaged"], None),
        (&["a is damaged", "b is a pipe"], Some("b is a pipe")),
        (&["c", "d", "e"], Some("e; and 2 more")),
    ] {
        assert_eq!(complain(complaints).as_deref(), said);
    }
}
