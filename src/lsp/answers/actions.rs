//! What mends a finding, as quick fixes. Each was tried: the finding is gone with it.

use std::iter;

use language::schema::Kind;
use scene::Meshes;
use serde_json::{Value, json};
use text::{Diagnostic, Edit, Findings, Span, nearest_word};

use super::diagnostics;
use crate::document::Document;

/// The maximum number of fixes tried for one request, as each reads the whole text.
const MOST: usize = 20;

/// The kind of all actions.
pub(crate) const KIND: &str = "quickfix";

/// Edits, and what they do in words.
struct Fix {
    title: String,
    edits: Vec<Edit>,
}

/// The answer to `textDocument/codeAction` about a span.
pub(crate) fn within(document: &Document, asked: Span, context: &Value) -> Value {
    let only = context["only"].as_array();
    let is_asked = |kinds: &Vec<Value>| kinds.iter().any(|kind| kind == KIND || kind == "");
    if !only.is_none_or(is_asked) {
        return json!([]);
    }
    let is_here = |found: &&Diagnostic| {
        found.cited.is_none() && diagnostics::shown(document, found.span).touches(asked)
    };
    let mut fixes: Vec<Fix> = Vec::new();
    for found in document.findings.iter().filter(is_here) {
        for fix in proposed(document, found) {
            let is_known = |other: &Fix| other.edits == fix.edits;
            if !fix.edits.is_empty() && fixes.len() < MOST && !fixes.iter().any(is_known) {
                fixes.push(fix);
            }
        }
    }
    if fixes.is_empty() {
        return json!([]);
    }
    let Some(before) = tried(document, &[]) else {
        return json!([]);
    };
    let tried = fixes.into_iter().filter_map(|fix| {
        let after = tried(document, &fix.edits)?;
        let here = document.findings.iter().filter(is_here);
        let mended = here.filter(|found| before.is_mended(found, &fix.edits, &after));
        let mended: Vec<_> = mended.collect();
        (!mended.is_empty()).then_some((fix, mended))
    });
    let tried: Vec<_> = tried.collect();
    let action = |(fix, mended): &(Fix, Vec<&Diagnostic>)| {
        let others = tried.iter().filter(|(other, _)| other.edits != fix.edits);
        let mut rivals = others.flat_map(|(_, others)| others);
        let is_single = !rivals.any(|other| mended.contains(other));
        let found = mended.iter().map(|found| diagnostics::one(document, found));
        json!({
            "title": fix.title,
            "kind": KIND,
            "diagnostics": found.collect::<Vec<_>>(),
            "isPreferred": is_single,
            "edit": document.workspace_edit(&fix.edits),
        })
    };
    tried.iter().map(action).collect()
}

/// What may mend a finding: its own fix, the true count, the name of what exists, directions of unit
/// length at right angles.
fn proposed(document: &Document, found: &Diagnostic) -> Vec<Fix> {
    let counts = document.source.recount();
    let is_count = counts.iter().any(|edit| edit.span.touches(found.span));
    let counts = if is_count { counts } else { Vec::new() };
    let edits = [found.fix.clone(), counts, renamed(document, found.span)];
    let changes = edits.into_iter().filter(|edits| !edits.is_empty());
    let changes = changes.map(|edits| Fix {
        title: title(document, &edits[0]),
        edits,
    });
    changes.chain(straightened(document, found.span)).collect()
}

/// The change of a name that is none to the nearest one.
fn renamed(document: &Document, span: Span) -> Vec<Edit> {
    let place = document.place(span.start());
    let Some(place) = place.filter(|place| matches!(place.field().kind, Kind::Name(_))) else {
        return Vec::new();
    };
    let Kind::Name(category) = place.field().kind else {
        return Vec::new();
    };
    let known = document.source.references(place.node, category);
    let known = known.iter().map(|(name, _)| &**name);
    let nearest = nearest_word(document.source.leaf_text(place.span), known);
    let edit = nearest.map(|name| Edit {
        span: place.span,
        text: document.source.spelled(place.span, name).into_owned(),
    });
    edit.into_iter().collect()
}

/// The directions of a node, made orthogonal; only a text without errors says what they are.
fn straightened(document: &Document, span: Span) -> Option<Fix> {
    let node = document.source.node_at(span)?;
    let edits = document.source.orthonormalised(node);
    let edits = edits.ok().filter(|_| document.findings.errors() == 0)?;
    let title = format!(
        "Make the directions of {} orthonormal",
        document.source.name(node)
    );
    Some(Fix { title, edits })
}

/// What is wrong with the text after edits, apart from the files that it names.
fn tried(document: &Document, edits: &[Edit]) -> Option<Findings> {
    let mut source = document.source.clone();
    source.change(edits);
    let lowered = source.lower(&Meshes::default()).ok()?;
    Some(lowered.diagnostics)
}

/// What an edit does, in words.
fn title(document: &Document, edit: &Edit) -> String {
    let old = edit.span.of(document.text());
    match (old, &*edit.text) {
        ("", new) => format!("Insert {}", quoted(new)),
        (old, "") => format!("Remove {}", quoted(old)),
        (old, new) => format!("Change {} to {}", quoted(old), quoted(new)),
    }
}

/// The beginning of a text in backticks.
fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let rest = text.chars().nth(LONGEST).map(|_| '…');
    let shown = text.chars().take(LONGEST).chain(rest);
    iter::once('`').chain(shown).chain(['`']).collect()
}
