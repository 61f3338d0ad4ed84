//! Nudging, typing, pasting, undoing.

use super::*;
use crate::language::Node;

#[test]
fn nudges_have_the_selected_size() {
    for (said, lines) in [
        ("jjje<Right><Right>", "0.2 0 0"),
        ("jjjell", "0.2 0 0"),
        ("jjje<Left>", "-0.1 0 0"),
        ("jjje<Shift-Right>", "1 0 0"),
        ("jjjeL", "1 0 0"),
        ("jjje<Alt-Right>", "0.01 0 0"),
        ("jjje,l", "0.01 0 0"),
        ("jjje;l", "1 0 0"),
        ("jjje,;l", "0.1 0 0"),
        ("jjje<Tab>l", "0 0.1 0"),
        ("jjjejl", "1.6 // the radius"),
        // A nudge below the minimum is refused.
        ("jjjej<Shift-Left><Shift-Left>", "0.5 // the radius"),
        ("jel", "0.15 0.1 0.1"),
        // Nudging there and back restores the text exactly.
        ("jjjejhl", ""),
    ] {
        assert_eq!(typed(said), lines, "{said}");
    }
}

#[test]
fn a_typed_literal_is_written_unchanged() {
    for (said, lines) in [
        ("jjjej2<Enter>", "2 // the radius"),
        ("jjjei<Back>.25e1<Enter>", ".25e1 0 0"),
        ("jjje-.5<Enter>", "-.5 0 0"),
        ("jjje1 2 3<Enter>", "1 2 3"),
        ("jjje.5<Enter>", ".5 0 0"),
        ("jjje(1+2)/4<Enter>", "0.75 0 0"),
        ("jjjej*=2<Enter>", "3 // the radius"),
        ("jjjej/=3<Enter>", "0.5 // the radius"),
        ("jjje1/3 0 sqrt(2)<Enter>", "0.333333333333 0 1.41421356237"),
        ("jjje7<Esc>", ""),
        ("jjje7<Tab>8<Enter>", "7 8 0"),
    ] {
        assert_eq!(typed(said), lines, "{said}");
    }
}

#[test]
fn a_refused_value_stays_in_the_field_with_the_reason() {
    for (said, reason) in [
        (
            "jjjej0<Enter>",
            "object 1 (sphere) radius: must be greater than 0",
        ),
        ("jjjei<Ctrl-u>abc<Enter>", "column 1: `abc` is none of"),
        ("jjjei<Ctrl-u>1 2<Enter>", "one number"),
        ("jjjei<Ctrl-u><Enter>", "one number"),
        ("jjjei<Ctrl-u>1//<Enter>", "column 3: expected a number"),
        ("ejjj180<Enter>", "view fov: must be"),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        let typing = app.cursor.typing.as_ref().expect("the field is still open");
        let refused = typing.refused.as_ref().expect("there is a reason");
        assert!(
            refused.message.contains(reason),
            "{said}: {}",
            refused.message
        );
        assert_eq!(app.document.text(), SCENE, "{said}");
        assert_eq!(app.error_count(), 0);
        press(&mut app, "<Esc>");
        assert!(app.cursor.typing.is_none() && app.mode == Mode::Edit);
    }
}

#[test]
fn pastes_fill_all_components_in_one_step() {
    for (said, pasted, lines) in [
        ("jjje", "0.1, 0.2 0.3", "0.1 0.2 0.3"),
        ("jjje", " 1e3 ", "1e3 0 0"),
        ("je", "#ff8000", "1 0.502 0"),
        ("jjje", "#ff8000", ""),
        ("jjje", "1 2", ""),
        ("jjjejjjjj", "1 2 3", "1 2 3 1"),
        ("jjjejjjjj", "1 2 3 4 5", ""),
        ("jjj", "1 2 3", ""),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        app.update(Msg::Paste(pasted.to_owned()));
        assert_eq!(changed_lines(&app).join("|"), lines, "{pasted}");
        press(&mut app, "u");
        assert_eq!(app.document.text(), SCENE, "one step: {pasted}");
    }
}

#[test]
fn nudges_of_one_number_are_one_step() {
    let mut app = open(SCENE);
    press(&mut app, "jjjelll<Tab>ll");
    assert_eq!(changed_lines(&app), ["0.3 0.2 0"]);
    press(&mut app, "u");
    assert_eq!(changed_lines(&app), ["0.3 0 0"]);
    press(&mut app, "u");
    assert_eq!(app.document.text(), SCENE);
    press(&mut app, "u");
    assert_eq!(words(&app), "nothing to undo");
    press(&mut app, "<Ctrl-r>");
    assert_eq!(changed_lines(&app), ["0.3 0 0"]);
}

#[test]
fn undo_selects_the_changed_node() {
    let mut app = open(SCENE);
    press(&mut app, "jjjejl<Esc>ggju");
    assert_eq!(
        (app.cursor.selected(), app.cursor.field),
        (Node::Object(0), 1)
    );
    assert_eq!(words(&app), "undone: object 1 (sphere) radius: 1.5 → 1.6");
    press(&mut app, "<Ctrl-r>");
    assert_eq!(words(&app), "redone: object 1 (sphere) radius: 1.5 → 1.6");
}

/// The reflection of the first object is `0.50`, usually from 0 to 1.
#[test]
fn nudges_stop_at_the_ends_of_the_usual_range() {
    let there = "jjjejjjjjj";
    for (said, line) in [
        ("LLLLLLLLLLLLLLL", "5 1.00 0 1"),
        ("HHHHHHHHHHHHHHHHl", "5 0.05 0 1"),
        ("1<Enter>l", "5 1 0 1"),
        ("1.2<Enter>l", "5 1.25 0 1"),
        ("1.02<Enter>h", "5 0.97 0 1"),
        ("-.2<Enter>L", "5 .3 0 1"),
    ] {
        assert_eq!(typed(&format!("{there}{said}")), line, "{said}");
    }
    let mut app = open(SCENE);
    press(&mut app, &format!("{there}1<Enter>l"));
    assert_eq!(
        words(&app),
        "the usual range ends here: type a number to leave it"
    );
    assert_eq!(typed("jjjejjHHHH"), ".0 .1 .1 .45 .45 .45 .5 .5 .5");
    assert_eq!(typed("jjjejLL"), "3.5 // the radius");
}

#[test]
fn a_hash_begins_to_type_a_colour() {
    assert_eq!(
        typed("jjjejj#ff8000<Enter>"),
        "1 0.502 0 .45 .45 .45 .5 .5 .5"
    );
}
