//! What a merge of two changed texts has lost or made up.

use std::collections::{BTreeMap, BTreeSet};

use super::*;
use language::Node;
use language::schema::Kind;

/// What marks the copies of each side.
pub(super) const MINE: &str = "mine";
pub(super) const THEIRS: &str = "theirs";

/// How often each leaf is in a text, without whole numbers and without the numbers of names: counts,
/// IDs and names in use may follow from a merge.
fn leaves(language: Language, text: &str) -> BTreeMap<String, isize> {
    let source = Source::new(language, Arc::new(text.to_owned()));
    let mut leaves = BTreeMap::new();
    for leaf in source.leaves() {
        let leaf = leaf.of(text);
        let is_number = |c: char| c.is_ascii_digit() || c == ' ';
        let leaf = if leaf.contains(char::is_alphabetic) {
            leaf.trim_end_matches(is_number)
        } else {
            leaf
        };
        if !leaf.chars().all(is_number) {
            *leaves.entry(leaf.to_owned()).or_insert(0) += 1;
        }
    }
    leaves
}

/// The leaves that a merge has lost, or has kept although a side removed them; of those that a text
/// has only once, or that tell their side. Others may be the same by coincidence.
pub(super) fn wrong_leaves(
    language: Language,
    base: &str,
    sides: [&str; 2],
    merged: &str,
) -> Vec<String> {
    let [base, mine, theirs, merged] =
        [base, sides[0], sides[1], merged].map(|text| leaves(language, text));
    let keys = [&base, &mine, &theirs]
        .map(BTreeMap::keys)
        .into_iter()
        .flatten();
    let mut wrong = Vec::new();
    for leaf in keys {
        let [base, mine, theirs, merged] =
            [&base, &mine, &theirs, &merged].map(|leaves| leaves.get(leaf).copied().unwrap_or(0));
        let is_telling = leaf.contains(MINE) || leaf.contains(THEIRS);
        if !is_telling && 1 < base.max(mine).max(theirs) {
            continue;
        }
        let by = [mine - base, theirs - base];
        let found = merged - base;
        // What both sides did alike may have been done once.
        if found != by[0] + by[1] && (by[0] != by[1] || found != by[0]) {
            wrong.push(format!("{leaf}: {by:?} became {found}"));
        }
    }
    wrong
}

/// How often each value is in each field of the nodes of a text, by component, without IDs and names
/// of nodes: those may follow from a merge.
fn values(language: Language, text: &str) -> BTreeMap<String, isize> {
    let mut document = Document::new(language, text.to_owned());
    document.lower(&Meshes::default()).expect("there is memory");
    let mut values = BTreeMap::new();
    for node in document.source().nodes().iter() {
        let own = document.source().span(node);
        for placed in document.source().fields(node) {
            let is_name = matches!(placed.field.kind, Kind::Reference(_) | Kind::Name(_));
            // The materials of `.test`, and what objects have of them, come and go with objects.
            let is_here = |span: &Span| own.range().contains(&span.start());
            let is_of_material = language == Language::Cse167
                && match node {
                    Node::Material(_) => true,
                    Node::Object(_) => !placed.is_explicit() || !placed.spans.iter().all(is_here),
                    _ => false,
                };
            if is_name || is_of_material || placed.field.key == "name" {
                continue;
            }
            for (component, span) in placed.spans.iter().enumerate() {
                let value = span.of(text);
                let of = format!("{:?}", std::mem::discriminant(&node));
                let key = format!("{of} {} {component}: {value}", placed.field.key);
                *values.entry(key).or_insert(0) += 1;
            }
        }
    }
    values
}

/// Whether both sides have deleted or changed nodes of the same text: that may then have happened once.
pub(super) fn share_a_node(language: Language, base: &str, sides: [&str; 2]) -> bool {
    let [base, mine, theirs] = [base, sides[0], sides[1]].map(|text| {
        let mut document = Document::new(language, text.to_owned());
        document.lower(&Meshes::default()).expect("there is memory");
        let source = document.source();
        let mut nodes: BTreeMap<String, usize> = BTreeMap::new();
        for node in source.nodes().iter() {
            let own = source.span(node).of(text).to_owned();
            *nodes.entry(own).or_default() += 1;
        }
        nodes
    });
    base.iter().any(|(own, count)| {
        let left = [&mine, &theirs].map(|side| side.get(own).copied().unwrap_or(0));
        left.iter().all(|left| left < count)
    })
}

/// The values that a merge has changed, of fields that only one side or none changed.
pub(super) fn wrong_values(
    language: Language,
    base: &str,
    sides: [&str; 2],
    merged: &str,
) -> Vec<String> {
    let all = [base, sides[0], sides[1], merged].map(|text| values(language, text));
    let keys: BTreeSet<_> = all.iter().flat_map(BTreeMap::keys).collect();
    let wrong = keys.into_iter().filter_map(|key| {
        let [base, mine, theirs, merged] = all.each_ref().map(|v| v.get(key).copied().unwrap_or(0));
        let by = [mine - base, theirs - base];
        let is_wrong = by.contains(&0) && merged - base != by[0] + by[1];
        is_wrong.then(|| format!("{key}: {by:?} became {}", merged - base))
    });
    wrong.collect()
}

/// The number of errors and warnings of a text.
pub(super) fn findings(language: Language, text: &str) -> [usize; 2] {
    let mut document = Document::new(language, text.to_owned());
    let lowered = document.lower(&Meshes::default());
    let found = lowered.expect("there is memory").diagnostics;
    [found.errors(), found.warnings()]
}
