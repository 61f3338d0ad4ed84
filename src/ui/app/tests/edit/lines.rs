//! Lines that keys are typed into, when they are full, and what the search of the help shows first.

use super::scripts::{ray, scripts};
use super::*;
use crate::app::shared::line::LONGEST;

const FULL: &str = "a line is limited to 4096 characters";

scripts! {
    a_search_of_the_help_begins_at_its_top: ray().play(r"
        ?jjj     | help-top 3
        /        | help-top 3
        u        | help-top 0
        <Esc>jj  | help-top 2
        /
        @paste n | help-top 0
    ");
}

/// The line that keys are typed into.
fn line(app: &App) -> &str {
    let line = app.shared.overlays.line().map(|(input, _)| input);
    let typing = app.shared.cursor.typing.as_ref();
    let typing = typing.map(|typing| &typing.input);
    let line = line.or(typing);
    line.expect("a line is open").value()
}

#[test]
fn a_full_line_takes_no_more_and_says_so() {
    for opening in [":", "/", "?/", "a", "<Enter>i", "<Enter>ji"] {
        let mut app = open(SCENE);
        press(&mut app, opening);
        let held = line(&app).chars().count();
        let full = "é".repeat(LONGEST - held);
        press(&mut app, "<Left><Right>");
        app.update(Msg::Paste(full));
        assert_ne!(words(&app), FULL, "{opening}");
        for (said, pasted) in [("x", ""), ("", "y"), ("", "zz")] {
            assert_eq!(line(&app).chars().count(), LONGEST, "{opening} {said}");
            press(&mut app, said);
            app.update(Msg::Paste(pasted.to_owned()));
            assert_eq!(words(&app), FULL, "{opening} {said}{pasted}");
        }
        press(&mut app, "<Back>x");
        assert!(line(&app).ends_with('x'), "{opening}");
        assert_eq!(line(&app).chars().count(), LONGEST, "{opening}");
    }
}

/// A mebibyte takes hours where each character costs a copy of the line.
#[test]
fn long_pastes_are_refused_at_once_everywhere() {
    let long = "1 2 3 ~ ".repeat(130_000);
    for opening in [
        "", ":", "/", "?/", "a", "<Enter>", "<Enter>i", "<Enter>c", "v",
    ] {
        let mut app = open(SCENE);
        press(&mut app, opening);
        app.update(Msg::Paste(long.clone()));
        let words = words(&app);
        assert!(
            (1..1000).contains(&words.len()),
            "{opening}: {} bytes",
            words.len()
        );
        assert_eq!(app.shared.document.text(), SCENE, "{opening}");
    }
}
