//! Showing a part of the list: filtering it and folding groups.

use super::*;
use crate::language::Node;
use crate::ui::listing::ListLine;

const RAY: &str = "\
0.1 0.1 0.1
2
5 5 5  1 1 1 // sun
-5 5 5  1 1 1
3
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1 // moon
box 4 0 0  1 0 0  0 1 0  0 0 1  1 1 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

/// A drawn union, its parts, one of which is drawn, too, and another sphere.
const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 1  1 0 0  1
obj sphere ID 4 mat ID 1  3 0 0  1
obj CSG ID 3 union ID 1 ID 2
obj CSG ID 5 union ID 3 ID 4
render 2 ID 5 ID 2
";

const XML: &str = "\
<xml><scene>
  <object name='pair'>
    <object name='inner'><object type='sphere' name='a'/></object>
    <object type='sphere' name='b'/>
  </object>
  <object type='sphere' name='c'/>
</scene></xml>
";

/// The list's nodes with their marks: of selection and of folded groups, with `|` between them.
fn list(app: &App) -> String {
    let lines = (0..app.listing().len()).filter_map(|line| app.listing().get(line));
    let nodes = lines.filter_map(|line| match line {
        ListLine::Heading(_) => None,
        ListLine::Node(_, node) => Some(node),
    });
    let marked = nodes.map(|node| {
        let is_folded = matches!(node, Node::Object(at) if app.cursor.rows.is_folded(at));
        let fold = if is_folded { "+" } else { "" };
        let cursor = if node == app.cursor.selected() {
            ">"
        } else {
            ""
        };
        format!("{cursor}{fold}{}", app.source().name(node))
    });
    marked.collect::<Vec<_>>().join("|")
}

#[track_caller]
fn check(name: &str, text: &str, cases: &[(&str, &str)]) {
    let mut app = opened_as(name, text).0;
    assert_eq!(app.error_count(), 0);
    for (said, expected) in cases {
        press(&mut app, said);
        assert_eq!(list(&app), *expected, "{said}: {}", words(&app));
    }
    press(&mut app, ":q");
    assert_eq!(app.document.text(), text);
}

#[test]
fn the_list_is_filtered_while_typing() {
    let all =
        "render|view|ambient|light 1|light 2|object 1 (sphere)|>object 2 (box)|object 3 (sphere)";
    let first =
        "render|view|ambient|light 1|light 2|>object 1 (sphere)|object 2 (box)|object 3 (sphere)";
    check(
        "a.ray",
        RAY,
        &[
            ("", first),
            ("/", first),
            (
                "b",
                "ambient|>object 1 (sphere)|object 2 (box)|object 3 (sphere)",
            ),
            ("ox", ">object 2 (box)"),
            ("<Back>", ">object 2 (box)"),
            (
                "<Back>",
                "ambient|>object 1 (sphere)|object 2 (box)|object 3 (sphere)",
            ),
            ("<Back><Back>", first),
            ("", first),
            // The empty line closes on Backspace; comments count, too.
            ("/MOON<Enter>", ">object 1 (sphere)"),
            ("/sphere", ">object 1 (sphere)|object 3 (sphere)"),
            ("<Down>", "object 1 (sphere)|>object 3 (sphere)"),
            ("<Enter>n", ">object 1 (sphere)|object 3 (sphere)"),
            ("N", "object 1 (sphere)|>object 3 (sphere)"),
            ("kk", ">object 1 (sphere)|object 3 (sphere)"),
            ("<Esc>", first),
            (
                "n",
                &first.replace('>', "").replace("object 3", ">object 3"),
            ),
            ("/xyz", ""),
            (
                "<Enter>",
                &first.replace('>', "").replace("object 3", ">object 3"),
            ),
            ("k", all),
            ("/light<Esc>", all),
        ],
    );
}

#[test]
fn groups_of_matches_are_listed() {
    check(
        "a.xml",
        XML,
        &[
            ("/a (", "pair (group)|inner (group)|>a (sphere)"),
            ("<Enter>j", "pair (group)|inner (group)|>a (sphere)"),
            ("k<Left>", "pair (group)|>inner (group)|a (sphere)"),
        ],
    );
}

#[test]
fn a_filter_follows_the_text() {
    let mut app = opened_as("a.ray", RAY).0;
    press(&mut app, "/sphere<Enter>D");
    assert_eq!(
        list(&app),
        "object 1 (sphere)|>object 2 (sphere)|object 4 (sphere)"
    );
    press(&mut app, "d");
    assert_eq!(list(&app), "object 1 (sphere)|>object 3 (sphere)");
    // Another type no longer matches; the next match is selected.
    press(&mut app, "ggj");
    let retyped = RAY.replace("sphere 0 0 0 1", "box 4 0 0  1 0 0  0 1 0  0 0 1  1 1 1");
    read(&mut app, "a.ray", &retyped);
    assert_eq!(list(&app), ">object 3 (sphere)");
    // Nothing is left of it: all are listed.
    press(&mut app, "d");
    assert_eq!(app.cursor.rows.filter(), "");
    assert_eq!(app.nodes().len(), app.cursor.rows.count(app.source()));
}

#[test]
fn selecting_what_the_filter_hides_ends_it() {
    let mut app = opened_as("a.ray", RAY).0;
    press(&mut app, "/box<Enter>");
    app.select(Node::Object(0));
    assert_eq!(app.cursor.rows.filter(), "");
}

#[test]
fn groups_are_folded_and_unfolded() {
    let rest = "render|view|background|environment|";
    let xml = |objects: &str| format!("{rest}{objects}");
    check(
        "a.xml",
        XML,
        &[
            (
                "",
                &xml(">pair (group)|inner (group)|a (sphere)|b (sphere)|c (sphere)"),
            ),
            ("<Left>", &xml(">+pair (group)|c (sphere)")),
            ("j", &xml("+pair (group)|>c (sphere)")),
            (
                "k<Right>j<Left>",
                &xml("pair (group)|>+inner (group)|b (sphere)|c (sphere)"),
            ),
            // A folded group leads to the one that holds it.
            ("<Left><Left>", &xml(">+pair (group)|c (sphere)")),
            (
                "<Right><Right>",
                &xml("pair (group)|>+inner (group)|b (sphere)|c (sphere)"),
            ),
            (
                "<Right><Right>",
                &xml("pair (group)|inner (group)|>a (sphere)|b (sphere)|c (sphere)"),
            ),
            ("<Shift-Left>", &xml(">+pair (group)|c (sphere)")),
            (
                "<Shift-Right>",
                &xml(">pair (group)|inner (group)|a (sphere)|b (sphere)|c (sphere)"),
            ),
        ],
    );
}

#[test]
fn combined_objects_are_folded_unless_they_are_drawn_by_themselves() {
    let listed = |objects: &str| format!("render|view|material 1|{objects}");
    check(
        "a.dat",
        DAT,
        &[
            ("G<Left>", &listed("object 2 (sphere)|>+object 5 (CSG)")),
            (
                "<Right>",
                &listed(
                    "object 1 (sphere)|object 2 (sphere)|object 4 (sphere)|object 3 (CSG)|>object 5 (CSG)",
                ),
            ),
            (
                "<Right><Left>",
                &listed("object 2 (sphere)|object 4 (sphere)|>+object 3 (CSG)|object 5 (CSG)"),
            ),
        ],
    );
}

#[test]
fn selecting_what_is_folded_unfolds_it_and_folds_outlive_edits() {
    let mut app = opened_as("a.xml", XML).0;
    press(&mut app, "<Left>jD");
    assert!(list(&app).contains("|+pair (group)|c (sphere)|>c 2 (sphere)"));
    press(&mut app, "u");
    assert!(list(&app).contains("|+pair (group)|>c (sphere)"));
    app.select(Node::Object(2));
    assert!(list(&app).contains("|pair (group)|inner (group)|>a (sphere)|"));
}

#[test]
fn a_new_name_replaces_the_old_one_unless_that_is_edited() {
    for (said, name) in [
        ("Rball<Enter>", "ball"),
        ("R<Left>x<Enter>", "paixr"),
        ("R<Back>n<Enter>", "pain"),
        ("R<Enter>", "pair"),
    ] {
        let mut app = opened_as("a.xml", XML).0;
        press(&mut app, said);
        let new = XML.replace("'pair'", &format!("'{name}'"));
        assert_eq!(app.document.text(), new, "{said}");
    }
}
