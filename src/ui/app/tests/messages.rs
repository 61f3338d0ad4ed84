//! Messages: none is lost before it could be read, and none outlives its cause.

use super::*;
use crate::ui::msg::Timer;

fn past(app: &App) -> Vec<&str> {
    let past = app.overlays.messages.past();
    past.map(|message| &*message.text).collect()
}

#[test]
fn a_message_that_comes_with_another_waits_for_the_next_key() {
    let mut app = open(SCENE);
    app.overlays.begin_step();
    app.overlays.say("one");
    app.overlays.warn("two");
    app.overlays.say("one");
    assert_eq!(words(&app), "one");
    press(&mut app, "j");
    assert_eq!(words(&app), "two");
    press(&mut app, "j");
    assert_eq!(words(&app), "");
    // The answer to a key is shown first.
    app.overlays.begin_step();
    app.overlays.say("three");
    app.overlays.say("four");
    press(&mut app, "X");
    assert!(words(&app).contains("is free"));
    press(&mut app, "j");
    assert_eq!(words(&app), "four");
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
