//! Messages: none is lost before it could be read, and none outlives its cause.

use super::*;
use crate::file::ReadError;
use crate::ui::msg::{Polled, Timer};

fn past(app: &App) -> Vec<&str> {
    let past = app.overlays.messages.past();
    past.map(|message| &*message.text).collect()
}

#[test]
fn a_message_that_comes_while_another_is_shown_waits_for_a_key() {
    let mut app = open(SCENE);
    app.overlays.say("one");
    app.overlays.say("two");
    app.overlays.say("one");
    assert_eq!(shown(&app), "one");
    press(&mut app, "j");
    assert_eq!(shown(&app), "two");
    press(&mut app, "j");
    assert_eq!(shown(&app), "");
    // The answer to a key is shown first.
    app.overlays.say("three");
    app.overlays.say("four");
    press(&mut app, "X");
    assert!(shown(&app).contains("is free"));
    press(&mut app, "j");
    assert_eq!(shown(&app), "four");
}

#[test]
fn a_message_makes_way_once_it_could_be_read_and_errors_go_first() {
    let timer = |effects: &[Effect]| {
        effects.iter().find_map(|effect| match effect {
            Effect::Later(time, Timer::Message) => Some(time.as_millis()),
            _ => None,
        })
    };
    let mut app = open(SCENE);
    let effects = app.update(Msg::Failed("a disk is full".to_owned()));
    assert_eq!(timer(&effects), None, "nothing waits");
    app.overlays.clear_message();
    app.overlays.say("0123456789");
    app.overlays.say("saved");
    let effects = app.update(Msg::Failed("failed".to_owned()));
    assert_eq!(timer(&effects), Some(2500));
    let effects = app.update(Msg::Failed("failed twice".to_owned()));
    assert_eq!((timer(&effects), shown(&app)), (None, "0123456789"));
    for (next, time) in [
        ("failed", Some(2300)),
        ("failed twice", Some(2600)),
        ("saved", None),
        ("saved", None),
    ] {
        let effects = app.update(Msg::Elapsed(Timer::Message));
        assert_eq!((shown(&app), timer(&effects)), (next, time));
    }
}

#[test]
fn a_timer_set_for_another_message_does_not_turn_this_one() {
    let mut app = open(SCENE);
    app.overlays.say("one");
    app.overlays.say("two");
    app.update(Msg::Resize(120, 40));
    press(&mut app, "j");
    assert_eq!(shown(&app), "two");
    app.update(Msg::Elapsed(Timer::Message));
    assert_eq!(shown(&app), "two");
}

#[test]
fn messages_are_remembered_the_newest_first() {
    let mut app = open(SCENE);
    for number in 0..60 {
        app.update(Msg::Failed(format!("message {number}")));
        press(&mut app, "j");
    }
    assert_eq!(past(&app).len(), 50);
    assert_eq!(past(&app)[..2], ["message 59", "message 58"]);
    app.update(Msg::Failed("a: Permission denied (os error 13)".to_owned()));
    assert_eq!(past(&app)[0], "a: Permission denied");
    press(&mut app, "Mjj");
    assert_eq!(app.overlays.history, Some(2));
    press(&mut app, "<Esc>");
    assert_eq!(app.overlays.history, None);
}

#[test]
fn a_message_about_errors_goes_when_they_are_corrected() {
    for said in ["vS", "<F5>", ":size 8x8<Enter>"] {
        let mut app = open(SCENE);
        press(&mut app, "vh<Esc>");
        let wrong = SCENE.replace("sphere\n0", "sphär\n0");
        outside(&mut app, &wrong);
        app.update(Msg::Elapsed(Timer::Settled));
        outside(&mut app, &wrong);
        assert!(0 < app.error_count());
        press(&mut app, said);
        assert!(words(&app).contains("error"), "{said}: {}", words(&app));
        outside(&mut app, SCENE);
        assert_eq!(app.error_count(), 0);
        assert!(!words(&app).contains("error"), "{said}: {}", words(&app));
    }
}

#[test]
fn a_message_about_the_file_goes_when_the_file_can_be_read_again() {
    let mut app = open(SCENE);
    let twice = |app: &mut App, read: &dyn Fn(&mut App)| {
        read(app);
        app.update(Msg::Elapsed(Timer::Settled));
        read(app);
    };
    app.overlays.say("one");
    twice(&mut app, &|app| {
        let path = PathBuf::from("scene.ray");
        app.update(Msg::Read(path.clone(), Err(ReadError::NotFound { path })));
    });
    assert!(past(&app)[0].contains("no such file"));
    outside(&mut app, SCENE);
    press(&mut app, "j");
    assert_eq!(shown(&app), "the file matches the saved text again");

    press(&mut app, "jjel<Esc>");
    twice(&mut app, &|app| {
        outside(app, "nonsense");
    });
    assert!(shown(&app).contains("has an error"), "{}", shown(&app));
    outside(&mut app, &format!("{SCENE}\n"));
    assert!(!shown(&app).contains("has an error"), "{}", shown(&app));
}

#[test]
fn a_message_that_files_are_polled_lasts_until_they_are_watched() {
    let mut app = open(SCENE);
    let reason = "the limit is reached (os error 24)";
    app.update(Msg::Polled(Polled::Scene, Some(reason.to_owned())));
    let said = "the limit is reached: polling scene.ray instead";
    assert_eq!(shown(&app), said);
    app.update(Msg::Polled(Polled::Track, Some(reason.to_owned())));
    press(&mut app, "jk");
    assert!(app.polls());
    app.update(Msg::Polled(Polled::Scene, None));
    assert!(app.polls());
    app.update(Msg::Polled(Polled::Track, None));
    assert!(!app.polls());

    // A message that nobody has dismissed goes with its cause.
    app.update(Msg::Polled(Polled::Assets, Some(reason.to_owned())));
    assert!(shown(&app).contains("the scene's files"), "{}", shown(&app));
    app.update(Msg::Polled(Polled::Assets, None));
    assert_eq!(shown(&app), "");
}

#[test]
fn a_missing_folder_is_not_told_to_be_written_to() {
    let mut app = open(SCENE);
    for _ in 0..2 {
        let folder = PathBuf::from("/scenes");
        let error = ReadError::NoFolder { folder };
        app.update(Msg::Read(PathBuf::from("scene.ray"), Err(error)));
        app.update(Msg::Elapsed(Timer::Settled));
    }
    assert_eq!(app.disk.state, OnDisk::Missing);
    let said = "/scenes: no such folder; save the scene elsewhere with :w FILE";
    assert_eq!(shown(&app), said);
    // The folder is there again, but not the file.
    for _ in 0..2 {
        let path = PathBuf::from("scene.ray");
        app.update(Msg::Read(path.clone(), Err(ReadError::NotFound { path })));
        app.update(Msg::Elapsed(Timer::Settled));
    }
    assert_eq!(
        shown(&app),
        "scene.ray: no such file; press w to write it again"
    );
}
