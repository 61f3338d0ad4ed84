//! The comments that belong to nodes: those on the lines before them.

use super::lines::is_comment;
use super::{Language, Source};
use crate::node::Node;
use crate::structure::{Block, follows, line_before, lines};
use crate::words::skip_white_space;
use text::{Span, line_start};

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

    /// The comment on a node.
    pub(super) fn comment_on(&self, node: Node) -> Option<&str> {
        let (at, _) = self.origins.records::<L>(node).next()?;
        self.label(self.tree.span(at).start())
            .filter(|_| node.category().is_some())
    }
}
