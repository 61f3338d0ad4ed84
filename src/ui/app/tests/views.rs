//! Moving the camera, and where its views go.

use super::*;

fn quits(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Quit))
}

#[test]
fn a_moved_view_is_not_lost_in_silence() {
    for said in ["q", ":q<Enter>", "<Ctrl-c>", ":wq<Enter>", ":new<Enter>"] {
        let mut app = open(SCENE);
        assert!(
            !quits(&press(&mut app, &format!("vh<Esc>{said}"))),
            "{said}"
        );
        assert!(
            matches!(app.overlays.dialog, Some(Dialog::Leave(_))),
            "{said}"
        );
        let losses = "the moved view is not in the text (S writes it)";
        assert_eq!(app.losses().as_deref(), Some(losses), "{said}");
        assert_eq!(app.document.text(), SCENE);
    }
    for said in ["vhqy", "vhqw", "vh:q!<Enter>", "vh0q", "vhSuq", "vhqn0q"] {
        assert!(quits(&press(&mut open(SCENE), said)), "{said}");
    }
}

#[test]
fn the_view_can_be_written_when_asked_and_saved_then() {
    let mut app = open(SCENE);
    press(&mut app, "vhqS");
    assert!(matches!(
        app.overlays.dialog,
        Some(Dialog::Leave(Next::Quit))
    ));
    assert!(app.document.text().starts_with("// view: eye "));
    assert_eq!(app.losses().as_deref(), Some("scene.ray has unsaved edits"));
    let effects = press(&mut app, "w");
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Save { .. }
    )));
    let text = app.document.shared_text();
    assert!(quits(&saving::saved(&mut app, 1, "scene.ray", &text)));
}

#[test]
fn saving_mentions_a_moved_view() {
    let mut app = open(SCENE);
    press(&mut app, "vhw");
    let words_in_view = "; the moved view is not in the text: S writes it";
    assert_eq!(words(&app), format!("nothing to save{words_in_view}"));
    press(&mut app, "<Esc>jjjel<Esc>w");
    let text = app.document.shared_text();
    saving::saved(&mut app, 1, "scene.ray", &text);
    assert_eq!(
        words(&app),
        "wrote scene.ray; the moved view is not in the text: S in VIEW writes it"
    );
}
