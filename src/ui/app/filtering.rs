//! Showing only a part of the list: filtering it while typing, going through the matches, and
//! folding groups.

use std::collections::BTreeSet;

use crossterm::event::KeyEvent;

use super::rows::foldable;
use super::{Fold, PromptKind, Shared, line};
use crate::language::Node;
use crate::ui::keymap::{Context, Mode};

impl Shared {
    /// Opens the line that filters the list; it contains the present filter.
    pub(super) fn start_filter(&mut self) {
        let kind = PromptKind::Filter(self.cursor.selected());
        let filter = self.cursor.rows.filter().to_owned();
        self.overlays.open_prompt_over(kind, &filter);
    }

    /// Handles a key in the line that filters the list; `from` was selected before.
    pub(super) fn filter_key(&mut self, key: KeyEvent, from: Node) {
        let Some(rows) = line::rows(key) else {
            if let Some(prompt) = &mut self.overlays.prompt
                && line::edit_over(&mut prompt.input, &mut prompt.is_selected, key)
            {
                self.filter_list(from);
            }
            return;
        };
        if 0 < self.cursor.rows.matches() {
            self.move_cursor_in(Context::In(Mode::Select), rows);
        }
    }

    /// Filters the list by the line being typed, and selects the first match from `from` on.
    pub(super) fn filter_list(&mut self, from: Node) {
        let Some(prompt) = &self.overlays.prompt else {
            return;
        };
        let words = prompt.input.value().trim();
        let source = self.document.source();
        self.cursor.rows.filter_by(words, source);
        let nodes = source.nodes();
        let nearest = if words.is_empty() {
            Some(from)
        } else {
            let row = self.cursor.rows.match_from(nodes.before(from));
            row.and_then(|row| nodes.get(row))
        };
        if let Some(node) = nearest {
            self.select(node);
        }
    }

    /// Keeps the selection and the filter that was typed; without a match, shows all again.
    pub(super) fn keep_filter(&mut self, from: Node) {
        self.overlays.prompt = None;
        let words = self.cursor.rows.filter().to_owned();
        if words.is_empty() {
            return;
        }
        self.cursor.searched.clone_from(&words);
        let count = self.cursor.rows.matches();
        match self.cursor.rows.match_at(self.selected_row()) {
            Some(at) => {
                let back = self.key_for("back");
                let words = format!("{} of {count}; {back} shows all", at + 1);
                self.overlays.say(words);
            }
            None if 0 < count => {}
            None => {
                self.drop_filter(from);
                self.overlays.fail(format!("no match for {words}"));
            }
        }
    }

    /// Shows all nodes again, and selects what was selected before.
    pub(super) fn drop_filter(&mut self, from: Node) {
        self.end_filter();
        self.select(from);
    }

    /// Shows all nodes again; returns whether the list was filtered.
    pub(super) fn end_filter(&mut self) -> bool {
        let is_filtered = !self.cursor.rows.filter().is_empty();
        if is_filtered {
            self.cursor.rows.filter_by("", self.document.source());
            self.cursor.settle(self.document.source());
        }
        is_filtered
    }

    /// Selects the next or previous node whose name or comment contains the text filtered by last.
    pub(super) fn search(&mut self, step: isize) {
        let wanted = &self.cursor.searched;
        if wanted.is_empty() {
            let filter = self.key_for("search");
            let words = format!("nothing to search for: {filter} filters the list");
            self.overlays.say(words);
            return;
        }
        let nodes = self.nodes();
        let found = self.cursor.rows.called(wanted, self.source());
        if found.is_empty() {
            self.overlays.fail(format!("no match for {wanted}"));
            return;
        }
        let row = self.selected_row();
        let at = match step {
            ..0 => found.partition_point(|&other| other < row).checked_sub(1),
            _ => Some(found.partition_point(|&other| other <= row)).filter(|&at| at < found.len()),
        };
        let at = at.unwrap_or(if step < 0 { found.len() - 1 } else { 0 });
        if let Some(node) = nodes.get(found[at]) {
            self.select(node);
        }
        self.overlays.say(format!("{} of {}", at + 1, found.len()));
    }

    /// Folds or unfolds the selected group, or all groups. Where nothing is to be folded or
    /// unfolded, goes to the group that holds the selection or to the first thing in it.
    pub(super) fn fold(&mut self, fold: Fold) {
        if !self.cursor.rows.filter().is_empty() {
            let back = self.key_for("back");
            self.overlays.say(format!(
                "groups stay unfolded while the list is filtered; {back} shows all"
            ));
            return;
        }
        let source = self.document.source();
        let mut folded = self.cursor.rows.folded().clone();
        match (fold, self.cursor.selected()) {
            (Fold::All, _) => folded = foldable(source).into_iter().map(|(at, _)| at).collect(),
            (Fold::None, _) => folded = BTreeSet::new(),
            (Fold::Selected, Node::Object(at))
                if source.is_foldable(at) && !folded.contains(&at) =>
            {
                folded.insert(at);
            }
            (Fold::Selected, Node::Object(at)) if let Some(group) = source.group_of(at) => {
                self.select(Node::Object(group));
                return;
            }
            (Fold::Unselected, Node::Object(at)) if folded.contains(&at) => {
                folded.remove(&at);
            }
            (Fold::Unselected, Node::Object(at)) if source.is_foldable(at) => {
                let first = source.parts(at, 1).first().map(|&(_, part)| part);
                self.select(first.unwrap_or(Node::Object(at + 1)));
                return;
            }
            (Fold::Selected | Fold::Unselected, _) => {
                self.overlays.say("only groups and combined objects fold");
                return;
            }
        }
        self.document.end_step();
        self.cursor.rows.fold(folded, self.document.source());
        self.cursor.settle(self.document.source());
    }
}
