use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::*;
use language::Node;

mod losses;
mod steps;
mod structure;

fn document(text: &str) -> Document {
    Document::new(Language::Ray, text.to_owned())
}

/// Sets the leaf at an index.
fn set(document: &mut Document, leaf: usize, literal: &str) {
    let span = document.source().leaves()[leaf];
    document.set(span, literal);
}

#[track_caller]
fn check_tree(document: &Document) {
    let fresh = Source::new(document.language(), document.shared_text());
    assert_eq!(document.source().leaves(), fresh.leaves());
}

/// Applies a text from outside; returns the undecided merge if there are conflicts.
fn replace(document: &mut Document, theirs: &str) -> Result<(), Merge> {
    let theirs = Document::new(document.language(), theirs.to_owned());
    let snapshot = document.snapshot();
    assert!(snapshot.is_of(document));
    drop(if snapshot.edited.is_some() {
        let merged = snapshot.merge(theirs, &Meshes::default());
        document.take(merged.expect("there is memory")?.0)
    } else {
        document.load(theirs, Past::Cleared)
    });
    assert!(!snapshot.is_of(document));
    check_tree(document);
    Ok(())
}

fn save(document: &mut Document, text: &str) {
    document.mark_saved(Arc::new(text.to_owned()));
}

/// The current text, then those after each undo.
fn history(document: &Document) -> Vec<String> {
    let mut document = document.clone();
    let mut texts = vec![document.text().to_owned()];
    while document.undo().is_some() {
        check_tree(&document);
        texts.push(document.text().to_owned());
    }
    texts
}

/// The current text, then those after each redo.
fn future(document: &Document) -> Vec<String> {
    let mut document = document.clone();
    let mut texts = vec![document.text().to_owned()];
    while document.redo().is_some() {
        texts.push(document.text().to_owned());
    }
    texts
}

#[test]
fn consecutive_sets_of_one_leaf_are_one_step() {
    let mut doc = document("1 2");
    for literal in ["10", "100", "100", "9"] {
        set(&mut doc, 0, literal);
    }
    assert_eq!(history(&doc), ["9 2", "1 2"]);
    set(&mut doc, 1, "3");
    set(&mut doc, 0, "8");
    assert_eq!(history(&doc), ["8 3", "9 3", "9 2", "1 2"]);
    doc.end_step();
    set(&mut doc, 0, "7");
    assert_eq!(history(&doc), ["7 3", "8 3", "9 3", "9 2", "1 2"]);
}

#[test]
fn calls_that_change_nothing_are_not_steps() {
    let mut doc = document("1 2");
    set(&mut doc, 0, "1");
    doc.edit(&[]);
    assert_eq!(history(&doc), ["1 2"]);
    set(&mut doc, 0, "3");
    set(&mut doc, 0, "1");
    assert_eq!(history(&doc), ["1 2"]);
    set(&mut doc, 0, "4");
    assert_eq!(history(&doc), ["4 2", "1 2"]);
}

#[test]
fn undo_and_redo_return_the_changed_span() {
    let mut doc = document("1 2 3");
    let span = |start, end| Some(Span::new(start, end));
    set(&mut doc, 1, "200");
    assert_eq!(doc.undo(), span(2, 3));
    assert_eq!(doc.redo(), span(2, 5));
    assert_eq!(doc.redo(), None);
    let edit = |at: Span, text: &str| Edit {
        span: at,
        text: text.to_owned(),
    };
    doc.edit(&[edit(Span::at(0), "0 "), edit(Span::new(5, 7), "")]);
    assert_eq!(doc.text(), "0 1 200");
    assert_eq!(doc.undo(), span(0, 7));
    assert_eq!(doc.text(), "1 200 3");
    assert_eq!(doc.redo(), span(0, 7));
}

#[test]
fn new_edits_clear_redo() {
    let mut doc = document("1 2");
    set(&mut doc, 0, "3");
    doc.undo();
    assert_eq!(future(&doc), ["1 2", "3 2"]);
    set(&mut doc, 1, "4");
    assert_eq!(future(&doc), ["1 4"]);
}

#[test]
fn reject_reverts_one_call() {
    let mut doc = document("1 2");
    set(&mut doc, 1, "5");
    doc.undo();
    set(&mut doc, 0, "-");
    doc.reject();
    assert_eq!(
        (history(&doc), future(&doc)),
        (vec!["1 2".into()], vec!["1 2".into(), "1 5".into()])
    );
    doc.reject();
    assert_eq!(doc.text(), "1 2", "only one call can be reverted");

    // Inside a merged step; the run continues as if nothing had happened.
    set(&mut doc, 0, "3");
    set(&mut doc, 0, "33");
    doc.reject();
    assert_eq!(history(&doc), ["3 2", "1 2"]);
    set(&mut doc, 1, "x");
    doc.reject();
    set(&mut doc, 0, "4");
    assert_eq!(history(&doc), ["4 2", "1 2"]);

    // A call that returned to the initial text of the run.
    set(&mut doc, 0, "1");
    doc.reject();
    assert_eq!(history(&doc), ["4 2", "1 2"]);

    // A call that changed nothing still counts as a call.
    set(&mut doc, 0, "4");
    doc.reject();
    assert_eq!(history(&doc), ["4 2", "1 2"]);
    check_tree(&doc);
}

#[test]
fn texts_from_outside_clear_the_history_if_nothing_is_unsaved() {
    let mut doc = document("1 2");
    set(&mut doc, 0, "3");
    assert!(doc.is_dirty());
    save(&mut doc, "3 2");
    assert!(!doc.is_dirty());
    replace(&mut doc, "0 3 2").expect("nothing is unsaved");
    assert!(!doc.is_dirty());
    assert_eq!(history(&doc), ["0 3 2"]);
    set(&mut doc, 0, "7");
    doc.undo();
    replace(&mut doc, "8 2").expect("nothing is unsaved");
    assert_eq!(
        (history(&doc), future(&doc)),
        (vec!["8 2".into()], vec!["8 2".into()])
    );
    replace(&mut doc, "0 3 2").expect("nothing is unsaved");
    doc.reject();
    assert_eq!(
        doc.text(),
        "0 3 2",
        "a text from outside cannot be rejected"
    );
}

#[test]
fn unsaved_edits_merge_with_texts_from_outside() {
    let mut doc = document("1 2 3");
    set(&mut doc, 0, "9");
    replace(&mut doc, "1 2 8").expect("they changed different leaves");
    assert_eq!((doc.text(), doc.saved().as_str()), ("9 2 8", "1 2 8"));
    assert_eq!(history(&doc), ["9 2 8", "9 2 3", "1 2 3"]);
    assert!(doc.is_dirty());
    replace(&mut doc, "9 2 8").expect("both texts are equal");
    assert!(!doc.is_dirty());
    assert_eq!(history(&doc), ["9 2 8", "9 2 3", "1 2 3"]);
}

/// A document with the saved text `1 2` whose first leaf was set to `3`, and its conflict with
/// `theirs`.
fn conflict(theirs: &str) -> (Document, Merge) {
    let mut doc = document("1 2");
    set(&mut doc, 0, "3");
    let merge = replace(&mut doc, theirs).expect_err("both changed the first leaf");
    assert_eq!((doc.text(), doc.saved().as_str()), ("3 2", "1 2"));
    (doc, merge)
}

#[test]
fn decided_conflicts_are_adopted_as_one_step() {
    for (decision, text) in [(Side::Mine, "3 5"), (Side::Theirs, "4 5")] {
        let (mut doc, mut merge) = conflict("4 5");
        merge.conflicts[0].decision = Some(decision);
        assert!(matches!(doc.adopt(merge), Adopted::Taken));
        assert_eq!((doc.text(), doc.saved().as_str()), (text, "4 5"));
        assert_eq!(history(&doc), [text, "3 2", "1 2"]);
    }
}

#[test]
fn outdated_merges_lose_nothing() {
    // Edited elsewhere meanwhile: both the edit and the decision are kept.
    let (mut doc, mut merge) = conflict("4 2");
    merge.conflicts[0].decision = Some(Side::Theirs);
    set(&mut doc, 1, "7");
    assert!(matches!(doc.adopt(merge), Adopted::Taken));
    assert_eq!((doc.text(), doc.saved().as_str()), ("4 7", "4 2"));

    // Edited at the conflict meanwhile: it is undecided again.
    let (mut doc, mut merge) = conflict("4 2");
    merge.conflicts[0].decision = Some(Side::Theirs);
    set(&mut doc, 0, "7");
    let Adopted::Conflict(again) = doc.adopt(merge) else {
        panic!("the decision was for another value");
    };
    assert_eq!((doc.text(), again.conflicts[0].mine.as_str()), ("7 2", "7"));

    // Saved meanwhile.
    let (mut doc, merge) = conflict("4 2");
    save(&mut doc, "3 2");
    assert!(matches!(doc.adopt(merge), Adopted::OutOfDate));
    assert_eq!((doc.text(), doc.saved().as_str()), ("3 2", "3 2"));

    // Another text arrived while the conflict was undecided: the ancestor is still the same.
    let (mut doc, _) = conflict("4 2");
    replace(&mut doc, "1 6").expect("they changed different leaves");
    assert_eq!((doc.text(), doc.saved().as_str()), ("3 6", "1 6"));
}

/// Scenes with everything that a careless editor would lose.
fn scene() -> impl Strategy<Value = String> {
    let pattern = "\u{FEFF}?(([0-9]{1,3}|[a-z]{1,4}|-?\\.[0-9]|// é[ a]{0,4}\r?\n|\\\\\\\\ x\n)\
                   ( |\t|\r\n|\n|\u{A0}|\u{A0}\u{A0} ){1,2}){1,12}(5|// end)?";
    proptest::string::string_regex(pattern).expect("the pattern is regular")
}

proptest! {
    // 200 texts of 100 edits each, over all languages.
    #![proptest_config(ProptestConfig { cases: 200, ..repeatable::config() })]

    #[test]
    fn edits_change_their_span_and_undo_restores_every_byte(
        language in select(&Language::ALL),
        text in scene(),
        edits in prop::collection::vec((any::<Index>(), "-?[0-9]{1,4}(\\.5)?", 0..8), 100),
    ) {
        let mut doc = Document::new(language, text.clone());
        for (leaf, literal, then) in edits {
            let leaves = doc.source().leaves();
            let span = leaves[leaf.index(leaves.len())];
            let before = doc.text().to_owned();
            doc.set(span, &literal);
            let (head, tail) = (&before[..span.start()], &before[span.end()..]);
            prop_assert_eq!(doc.text(), format!("{head}{literal}{tail}"));
            match then {
                0 => doc.end_step(),
                1 => {
                    doc.reject();
                    prop_assert_eq!(doc.text(), before);
                }
                _ => {}
            }
        }
        let edited = doc.text().to_owned();
        while doc.undo().is_some() {}
        prop_assert_eq!(doc.text(), text);
        while doc.redo().is_some() {}
        prop_assert_eq!(doc.text(), edited);
        check_tree(&doc);
    }
}

#[test]
fn a_rejected_edit_leaves_the_places_of_the_text_before() {
    let text = "<xml><scene><object type=\"sphere\" name=\"a\"/><object name=\"b\"/></scene></xml>";
    let mut document = Document::new(Language::Xml, text.to_owned());
    document.lower(&Meshes::default()).expect("there is memory");
    let places = |document: &Document| {
        let nodes = document.source().nodes().iter();
        nodes
            .map(|node| (node, document.source().span(node)))
            .collect::<Vec<_>>()
    };
    let before = places(&document);
    let removed = document.source().removal(&[Node::Object(0)]);
    document.edit(&removed.expect("it can be deleted"));
    document.lower(&Meshes::default()).expect("there is memory");
    assert_ne!(places(&document), before);
    document.reject();
    assert_eq!(document.text(), text);
    assert_eq!(places(&document), before);
}
