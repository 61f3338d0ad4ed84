//! The names of steps, and the texts between them.

use std::collections::BTreeMap;

use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::{check_tree, document, future, history, replace, save, set};
use crate::{Document, Past, StateId, StepName};
use scene::Meshes;
use text::{Edit, Span};

/// Sets the leaf at an index and names that after it.
fn name(document: &mut Document, leaf: usize, literal: &str) {
    let before = document
        .source()
        .leaf_text(document.source().leaves()[leaf]);
    let name = StepName::set(format!("leaf {leaf}"), before, literal);
    set(document, leaf, literal);
    document.name_step(name);
}

fn names(document: &Document) -> Vec<String> {
    let names = document.states().filter_map(|state| state.name);
    names.map(StepName::to_string).collect()
}

#[test]
fn names_follow_their_steps_through_merging_undo_and_redo() {
    let mut doc = document("1 2 3");
    for literal in ["2", "3", "4"] {
        name(&mut doc, 0, literal);
    }
    name(&mut doc, 1, "7");
    let both = ["leaf 0: 1 → 4, 3 nudges", "leaf 1: 2 → 7"];
    assert_eq!(names(&doc), both);
    doc.undo();
    assert_eq!(
        (names(&doc), doc.present()),
        (both.map(str::to_owned).into(), 1)
    );
    doc.redo();
    doc.undo();
    // What is typed next is a step of its own, which ends what could be redone.
    name(&mut doc, 0, "5");
    assert_eq!(names(&doc), [both[0], "leaf 0: 4 → 5"]);
    // A value that is refused leaves the run's name as it was.
    name(&mut doc, 0, "6");
    doc.reject();
    assert_eq!(names(&doc), [both[0], "leaf 0: 4 → 5"]);
    // A run back to where it began is no step, and nothing else takes its name.
    name(&mut doc, 0, "4");
    assert_eq!(names(&doc), [both[0]]);
    doc.edit(&[]);
    doc.name_step(StepName::done("nothing"));
    assert_eq!(names(&doc), [both[0]]);
    doc.edit(&[Edit {
        span: Span::at(0),
        text: "0 ".to_owned(),
    }]);
    assert_eq!(names(&doc), [both[0], "edit"]);
    doc.name_step(StepName::done("added leaf 0"));
    doc.name_step(StepName::done("added 0"));
    assert_eq!(names(&doc), [both[0], "added 0"]);
}

#[test]
fn texts_from_outside_are_numbered_after_those_before() {
    let mut doc = document("1 2");
    let ids = |doc: &Document| doc.states().map(|state| state.id).collect::<Vec<_>>();
    name(&mut doc, 0, "3");
    let before = ids(&doc);
    assert!(replace(&mut doc, "1 5").is_ok());
    assert_eq!(ids(&doc)[..2], before, "a merge is a step like any other");
    assert_eq!(names(&doc), ["leaf 0: 1 → 3", "edit"]);
    while doc.undo().is_some() {}
    doc.mark_saved(doc.shared_text());
    let before = ids(&doc);
    assert!(replace(&mut doc, "8 9").is_ok());
    let [after] = ids(&doc)[..] else {
        panic!("a text from outside has no history")
    };
    assert!(before.iter().all(|id| *id < after));
}

#[derive(Clone, Debug)]
enum Doing {
    Set(Index, &'static str),
    Edit(Index),
    EndStep,
    Reject,
    Undo,
    Redo,
    Jump(Index),
}

fn doings() -> impl Strategy<Value = Vec<Doing>> {
    let doing = prop_oneof![
        4 => (any::<Index>(), select(&["0", "11", "-2.5"][..]))
            .prop_map(|(leaf, literal)| Doing::Set(leaf, literal)),
        2 => any::<Index>().prop_map(Doing::Edit),
        1 => Just(Doing::EndStep),
        1 => Just(Doing::Reject),
        1 => Just(Doing::Undo),
        1 => Just(Doing::Redo),
        2 => any::<Index>().prop_map(Doing::Jump),
    ];
    prop::collection::vec(doing, 1..40)
}

fn go_to(document: &mut Document, state: usize) {
    while state < document.present() {
        document.undo().expect("a step before");
    }
    while document.present() < state {
        document.redo().expect("a step after");
    }
}

fn act(document: &mut Document, doing: &Doing) {
    match doing {
        Doing::Set(leaf, literal) => {
            let leaf = leaf.index(document.source().leaves().len());
            set(document, leaf, literal);
        }
        Doing::Edit(leaf) => {
            let leaves = document.source().leaves();
            let leaf = leaves[leaf.index(leaves.len())];
            let text = format!("{0} {0}", leaf.of(document.text()));
            document.edit(&[Edit { span: leaf, text }]);
        }
        Doing::EndStep => document.end_step(),
        Doing::Reject => document.reject(),
        Doing::Undo => drop(document.undo()),
        Doing::Redo => drop(document.redo()),
        Doing::Jump(state) => go_to(document, state.index(document.states().count())),
    }
}

/// Steps outlast what others change elsewhere; the first whose place they touched ends them.
#[test]
fn steps_are_carried_over_changes_of_others() {
    let mut doc = document("0 1 2 3 4");
    for (leaf, literal) in [(1, "10"), (2, "20"), (3, "30")] {
        name(&mut doc, leaf, literal);
        doc.end_step();
    }
    doc.undo();
    save(&mut doc, "0 10 20 3 4");
    drop(doc.load(document("// a\n0 10 20 3 4"), Past::Rebased));
    drop(doc.load(document("// a\n0 10 20 3 44"), Past::Rebased));
    let undone = [
        "// a\n0 10 20 3 44",
        "// a\n0 10 2 3 44",
        "// a\n0 1 2 3 44",
    ];
    assert_eq!(history(&doc), undone);
    let redone = ["// a\n0 10 20 3 44", "// a\n0 10 20 30 44"];
    assert_eq!(future(&doc), redone);
    name(&mut doc, 5, "40");
    let theirs = document("// a\n0 17 20 3 44");
    let merged = doc.snapshot().merge(theirs, &Meshes::default());
    let (merged, _) = merged.expect("there is memory").expect("no conflict");
    drop(doc.follow(merged));
    let undone = [
        "// a\n0 17 20 3 40",
        "// a\n0 17 20 3 44",
        "// a\n0 17 2 3 44",
    ];
    assert_eq!(history(&doc), undone);
    drop(doc.load(document("5"), Past::Rebased));
    assert_eq!((history(&doc).len(), future(&doc).len()), (1, 1));
}

proptest! {
    #![proptest_config(repeatable::config())]

    /// A comment of others is in all texts of the history, which are otherwise as before.
    #[test]
    fn carried_steps_lead_to_the_same_texts(doings in doings(), place in any::<Index>()) {
        const COMMENT: &str = "/*!*/";
        let mut doc = document("1 2 3\n4 5\n6");
        for doing in doings {
            act(&mut doc, &doing);
        }
        let before = [history(&doc), future(&doc)];
        doc.mark_saved(doc.shared_text());
        let gaps: Vec<_> = doc.text().match_indices([' ', '\n']).map(|(at, _)| at + 1).collect();
        let mut text = doc.text().to_owned();
        text.insert_str(gaps[place.index(gaps.len())], COMMENT);
        drop(doc.load(document(&text), Past::Rebased));
        for (before, after) in before.iter().zip([history(&doc), future(&doc)]) {
            prop_assert!(after.len() <= before.len());
            for (before, after) in before.iter().zip(&after) {
                prop_assert_eq!(before, &after.replacen(COMMENT, "", 1));
            }
        }
    }

    #[test]
    fn every_state_keeps_its_text(doings in doings()) {
        let mut doc = document("1 2 3");
        let mut known: BTreeMap<StateId, String> = BTreeMap::new();
        for doing in doings {
            act(&mut doc, &doing);
            check_tree(&doc);
            let timeline = doc.timeline();
            let ids: Vec<_> = doc.states().map(|state| state.id).collect();
            let (present, now) = (doc.present(), doc.text().to_owned());
            for (at, id) in ids.iter().enumerate() {
                let text = timeline.text(at);
                let known = known.entry(*id).or_insert_with(|| text.to_string());
                prop_assert_eq!(&*text, known, "{:?}: state {}", doing, at);
                let mut there = doc.clone();
                go_to(&mut there, at);
                prop_assert_eq!(there.text(), &**text);
                go_to(&mut there, present);
                prop_assert_eq!(there.text(), &now);
                let back: Vec<_> = there.states().map(|state| state.id).collect();
                prop_assert_eq!(&back, &ids);
            }
            prop_assert_eq!(&known[&ids[present]], &now);
        }
    }
}
