//! The comments that belong to nodes: those behind them and on the lines before.

use super::lines::is_comment;
use super::{Language, Source};
use crate::node::Node;
use crate::structure::{Block, follows, line_before, lines};
use crate::words::skip_white_space;
use text::{Edit, Span, line_end, line_start};

impl<L: Language> Source<L> {
    /// The words of the comment line before a place.
    pub(super) fn label(&self, place: usize) -> Option<&str> {
        let before = self.text[..place].trim_end_matches([' ', '\t']);
        let line = line_start(before, before.len().checked_sub(1)?);
        let start = skip_white_space(before.as_bytes(), line);
        let line = before[start..].trim_end();
        let content = line.trim_start_matches(['#', '/']).trim();
        let is_label = is_comment::<L>(line) && !content.is_empty();
        (is_label && !self.is_settings(start)).then_some(content)
    }

    /// Whether the comment that begins at this offset holds the render settings.
    fn is_settings(&self, start: usize) -> bool {
        let settings = self.origins.settings.as_ref();
        settings.is_some_and(|settings| settings.whole.start() == start)
    }

    /// Whether a comment above a record is a heading of several: one of the same category follows
    /// on the next line.
    fn has_heading(&self, record: usize) -> bool {
        let category = |record| Some(self.origins.node_of(record)?.category()?.0);
        let [own, next] = [record, record + 1].map(|record| self.tree.span(record));
        category(record).is_some()
            && category(record) == category(record + 1)
            && follows(&self.text, own, next)
    }

    /// The lines that move with a record.
    pub(super) fn block(&self, record: usize) -> Block {
        let text = &*self.text;
        let comment_above = |start| {
            let line = line_before(text, start).filter(|_| !self.has_heading(record))?;
            let comment = line.of(text).trim();
            let start = line.start() + line.of(text).find(comment).unwrap_or_default();
            (is_comment::<L>(comment) && !self.is_settings(start)).then_some(line.start())
        };
        Block::Lines(lines(text, self.tree.span(record), comment_above))
    }

    /// The text that moves with a record.
    pub(crate) fn block_span(&self, record: usize) -> Span {
        self.block(record).span()
    }

    /// The comment on a node: the one behind its first record, otherwise that on the line before.
    pub(super) fn comment_on(&self, node: Node) -> Option<&str> {
        node.category()?;
        if let Some(behind) = self.name_behind(node) {
            return Some(behind.of(&self.text));
        }
        let (at, _) = self.origins.records::<L>(node).next()?;
        self.label(self.tree.span(at).start())
    }

    /// The words of the comment behind the first record of a node, if that has any.
    fn name_behind(&self, node: Node) -> Option<Span> {
        let (at, _) = self.origins.records::<L>(node).next()?;
        let end = self.tree.span(at).end();
        let behind = Span::new(end, line_end(&self.text, end));
        let marked = behind
            .of(&self.text)
            .trim_start()
            .strip_prefix(L::COMMENTS[0])?;
        let name = marked.trim_start_matches(L::COMMENTS[0]).trim();
        let start = behind.end() - marked.len() + marked.find(name)?;
        (!name.is_empty()).then(|| Span::new(start, start + name.len()))
    }

    /// What a node without an ID is called: the comment behind it.
    pub(super) fn called_behind(&self, node: Node) -> Option<&str> {
        let name = self.name_behind(node);
        let has_name = L::COMMENTS_BEHIND && L::is_movable(node) && node.category().is_some();
        has_name.then(|| name.map_or("", |name| name.of(&self.text)))
    }

    /// Returns the edits that call a node by a comment behind it, which an empty name removes.
    pub(super) fn named_behind(&self, node: Node, name: &str) -> Vec<Edit> {
        let Some((at, _)) = self.origins.records::<L>(node).next() else {
            return Vec::new();
        };
        let own = self.tree.span(at).end();
        let (span, text) = match self.name_behind(node) {
            Some(old) if name.is_empty() => (Span::new(own, old.end()), String::new()),
            Some(old) => (old, name.to_owned()),
            None if name.is_empty() => return Vec::new(),
            None => {
                let blank = &self.text[own..line_end(&self.text, own)];
                let end = own + blank.trim_end().len();
                (Span::at(end), format!("  {} {name}", L::COMMENTS[0]))
            }
        };
        vec![Edit { span, text }]
    }
}
