//! Showing only a part of the list: filtering it while typing, going through the matches, and
//! folding groups.

use std::collections::BTreeSet;

use crossterm::event::KeyEvent;

use crate::app::shared::line;
use crate::app::shared::rows::foldable;
use crate::app::{Fold, PromptKind, Shared};
use language::Node;

/// Opens the line that filters the list; it contains the present filter.
pub(super) fn start_filter(shared: &mut Shared) {
    let kind = PromptKind::Filter(shared.cursor.selected());
    let filter = shared.cursor.rows.filter().to_owned();
    shared.overlays.open_prompt_over(kind, &filter);
}

/// Handles a key in the line that filters the list; `from` was selected before.
pub(crate) fn filter_key(shared: &mut Shared, key: KeyEvent, from: Node) {
    let Some(rows) = line::rows(key) else {
        if let Some(prompt) = &mut shared.overlays.prompt
            && line::edit_over(&mut prompt.input, &mut prompt.is_selected, key)
        {
            filter_list(shared, from);
        }
        return;
    };
    if 0 < shared.cursor.rows.matches() {
        shared.move_selection(rows);
    }
}

/// Filters the list by the line being typed, and selects the first match from `from` on.
pub(crate) fn filter_list(shared: &mut Shared, from: Node) {
    let Some(prompt) = &shared.overlays.prompt else {
        return;
    };
    let words = prompt.input.value().trim();
    let source = shared.document.source();
    shared.cursor.rows.filter_by(words, source);
    let nodes = source.nodes();
    let nearest = if words.is_empty() {
        Some(from)
    } else {
        let row = shared.cursor.rows.match_from(nodes.before(from));
        row.and_then(|row| nodes.get(row))
    };
    if let Some(node) = nearest {
        shared.select(node);
    }
}

/// Keeps the selection and the filter that was typed; without a match, shows all again.
pub(crate) fn keep_filter(shared: &mut Shared, from: Node) {
    shared.overlays.prompt = None;
    let words = shared.cursor.rows.filter().to_owned();
    if words.is_empty() {
        return;
    }
    shared.cursor.searched.clone_from(&words);
    let count = shared.cursor.rows.matches();
    match shared.cursor.rows.match_at(shared.selected_row()) {
        Some(at) => {
            let back = shared.key_for("back");
            let words = format!("{} of {count}; {back} shows all", at + 1);
            shared.say(words);
        }
        None if 0 < count => {}
        None => {
            drop_filter(shared, from);
            shared.fail(format!("no match for {words}"));
        }
    }
}

/// Shows all nodes again, and selects what was selected before.
pub(crate) fn drop_filter(shared: &mut Shared, from: Node) {
    end_filter(shared);
    shared.select(from);
}

/// Shows all nodes again; returns whether the list was filtered.
pub(crate) fn end_filter(shared: &mut Shared) -> bool {
    let is_filtered = !shared.cursor.rows.filter().is_empty();
    if is_filtered {
        shared.cursor.rows.filter_by("", shared.document.source());
        shared.cursor.settle(shared.document.source());
    }
    is_filtered
}

/// Selects the next or previous node whose name or comment contains the text filtered by last.
pub(super) fn search(shared: &mut Shared, step: isize) {
    let wanted = &shared.cursor.searched;
    if wanted.is_empty() {
        let filter = shared.key_for("search");
        shared.say(format!("nothing to search for: {filter} filters the list"));
        return;
    }
    let nodes = shared.nodes();
    let found = shared.cursor.rows.called(wanted, shared.source());
    if found.is_empty() {
        shared.fail(format!("no match for {wanted}"));
        return;
    }
    let row = shared.selected_row();
    let at = match step {
        ..0 => found.partition_point(|&other| other < row).checked_sub(1),
        _ => Some(found.partition_point(|&other| other <= row)).filter(|&at| at < found.len()),
    };
    let at = at.unwrap_or(if step < 0 { found.len() - 1 } else { 0 });
    if let Some(node) = nodes.get(found[at]) {
        shared.select(node);
    }
    shared.say(format!("{} of {}", at + 1, found.len()));
}

/// Folds or unfolds the selected group, or all groups. Where nothing is to be folded or
/// unfolded, goes to the group that holds the selection or to the first thing in it.
pub(super) fn fold(shared: &mut Shared, fold: Fold) {
    if !shared.cursor.rows.filter().is_empty() {
        let back = shared.key_for("back");
        shared.say(format!(
            "groups stay unfolded while the list is filtered; {back} shows all"
        ));
        return;
    }
    let source = shared.document.source();
    let mut folded = shared.cursor.rows.folded().clone();
    match (fold, shared.cursor.selected()) {
        (Fold::All, _) => folded = foldable(source).into_iter().map(|(at, _)| at).collect(),
        (Fold::None, _) => folded = BTreeSet::new(),
        (Fold::Selected, Node::Object(at)) if source.is_foldable(at) && !folded.contains(&at) => {
            folded.insert(at);
        }
        (Fold::Selected, Node::Object(at)) if let Some(group) = source.group_of(at) => {
            shared.select(Node::Object(group));
            return;
        }
        (Fold::Unselected, Node::Object(at)) if folded.contains(&at) => {
            folded.remove(&at);
        }
        (Fold::Unselected, Node::Object(at)) if source.is_foldable(at) => {
            let first = source.parts(at, 1).first().map(|&(_, part)| part);
            shared.select(first.unwrap_or(Node::Object(at + 1)));
            return;
        }
        (Fold::Selected | Fold::Unselected, _) => {
            shared.say("only groups and combined objects fold");
            return;
        }
    }
    shared.document.end_step();
    shared.cursor.rows.fold(folded, shared.document.source());
    shared.cursor.settle(shared.document.source());
}

/// Selects the next or previous light or object in the list, wrapping around.
pub(super) fn cycle(shared: &mut Shared, step: isize) {
    let (rows, source) = (&shared.cursor.rows, shared.source());
    let first = rows.place_of(source.nodes().before(Node::Light(0)));
    let count = rows.count(source) - first;
    if count == 0 {
        return;
    }
    let place = match rows.place_of(shared.selected_row()).checked_sub(first) {
        Some(at) => (at as isize + step).rem_euclid(count as isize) as usize,
        None if step < 0 => count - 1,
        None => 0,
    };
    let row = rows.at(first + place, source);
    if let Some(node) = row.and_then(|row| source.nodes().get(row)) {
        shared.select(node);
    }
}
