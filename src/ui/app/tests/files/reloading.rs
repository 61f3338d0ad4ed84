//! Numbers that another program changes in a long text.

use std::fmt::Write as _;
use std::sync::Arc;

use super::*;
use crate::language::{Language, Node, Source};
use crate::scene::Meshes;
use crate::ui::app::files;
use crate::ui::scene_reading::News;

/// Objects of a text that is long enough not to be parsed as a whole.
const OBJECTS: usize = 12_000;

fn long() -> String {
    let mut text = format!(
        "// view: eye 0 0 9 target 0 0 0\n.1 .1 .1\n1\n5 5 5\n1 1 1\n{OBJECTS} // objects\n"
    );
    for number in 0..OBJECTS {
        let material = ".1 .1 .1  .45 .45 .45  .5 .5 .5  5 .5 0 1";
        writeln!(
            text,
            "sphere {number} 0 0 0.75  {material} // a comment of some length"
        )
        .expect("texts grow");
    }
    text
}

/// Delivers a text, again where the application asks for it; returns how often.
fn deliver(app: &mut App, text: &str) -> usize {
    let mut baseline = files::baseline(&app.shared);
    for times in 1..4 {
        let reading = Reading::new(text.to_owned(), baseline).expect("it fits into memory");
        let effects = app.update(Msg::Read(PathBuf::from("scene.ray"), Ok(reading)));
        let again = effects.into_iter().find_map(|effect| match effect {
            Effect::Read(_, baseline) => Some(baseline),
            _ => None,
        });
        let Some(again) = again else { return times };
        baseline = again;
    }
    panic!("it asks again and again");
}

/// Whether the state is that of a text just opened.
fn assert_opened(app: &App, text: &str) {
    assert_eq!(app.shared.document.text(), text);
    assert_eq!(**app.shared.document.saved(), text);
    assert!(!app.shared.document.is_dirty());
    assert_eq!(app.shared.document.undoable(), None);
    let mut source = Source::new(Language::Ray, Arc::new(text.to_owned()));
    let lowered = source
        .lower(&Meshes::default())
        .expect("it fits into memory");
    assert_eq!(app.shared.scene.as_deref(), lowered.scene.as_ref());
    let last = Node::Object(OBJECTS - 1);
    assert_eq!(app.shared.source().fields(last), source.fields(last));
}

#[test]
fn numbers_of_one_object_are_taken_without_parsing_the_rest() {
    let mut text = long();
    let mut app = open(&text);
    for (old, new, place) in [
        (
            "sphere 7 0 0 0.75",
            "sphere 7 0 0 0.5",
            "object 8 (sphere) radius",
        ),
        (
            "sphere 7 0 0 0.5",
            "sphere -1e1 0 0 0.25",
            "object 8 (sphere)",
        ),
        (
            "sphere 11999 0",
            "sphere 1199 0",
            "object 12000 (sphere) centre x",
        ),
    ] {
        text = text.replacen(old, new, 1);
        let reading =
            Reading::new(text.clone(), files::baseline(&app.shared)).expect("it fits into memory");
        let news = reading.news.as_deref();
        assert!(matches!(news, Some(News::Numbers(_))), "{new}");
        assert_eq!(deliver(&mut app, &text), 1, "{new}");
        assert_eq!(words(&app), format!("reloaded: {place}"));
        assert_opened(&app, &text);
    }
    let reading = Reading::new(text, files::baseline(&app.shared)).expect("it fits into memory");
    assert!(reading.news.is_none(), "nothing is new");
}

#[test]
fn changes_of_more_than_numbers_of_one_object_are_taken() {
    let mut text = long();
    let mut app = open(&text);
    let between = "length\nsphere 5 0 0 0.75";
    for (old, new, is_numbers) in [
        // Numbers of the header or a comment, for which no object is read again.
        (".1 .1 .1\n", ".1 .1 .2\n", true),
        ("eye 0 0 9", "eye 0 0 8", true),
        // White space behind numbers.
        (between, &format!("{between} "), true),
        // Other text.
        ("// objects", "// 12000 objects", false),
        ("sphere 9 0", "Sphere 9 0", false),
    ] {
        text = text.replacen(old, new, 1);
        let reading =
            Reading::new(text.clone(), files::baseline(&app.shared)).expect("it fits into memory");
        let are_numbers = matches!(reading.news.as_deref(), Some(News::Numbers(_)));
        assert_eq!(are_numbers, is_numbers, "{new}");
        assert_eq!(deliver(&mut app, &text), 1, "{new}");
        assert_eq!(app.shared.document.text(), text);
    }
    // A number with an error: the text is read as a whole, and waits for a correction.
    let broken = text.replacen("sphere 7 0 0 0.75", "sphere 7 0 0 -1", 1);
    assert_eq!(deliver(&mut app, &broken), 2);
    assert_opened(&app, &text);
}

#[test]
fn numbers_are_merged_with_unsaved_edits() {
    let text = long();
    let mut app = open(&text);
    press(&mut app, "jjjel");
    let theirs = text.replacen("sphere 7 0 0 0.75", "sphere 7 0 0 0.5", 1);
    assert_eq!(deliver(&mut app, &theirs), 1);
    assert!(words(&app).starts_with("merged"), "{}", words(&app));
    assert!(app.shared.document.text().contains("sphere 7 0 0 0.5"));
    assert!(app.shared.document.is_dirty());
}
