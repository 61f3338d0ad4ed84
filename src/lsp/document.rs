//! An open text: what the editor shows, lowered.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use assets::Assets;
use language::schema::Field;
use language::{FieldSpans, Language, Lowered, Node, Source};
use serde_json::{Value, json};
use text::{Edit, Findings, Span, smallest_edit};

use crate::positions::{Encoding, Lines};

/// The maximum length of a text whose nodes are listed, in bytes. Longer ones are checked only.
const MOST_SERVED: usize = 16 << 20;

/// The maximum length of a text, in bytes: spans hold no more.
pub(crate) const LONGEST: usize = u32::MAX as usize;

/// A text that the editor has open.
#[derive(Debug)]
pub(crate) struct Document {
    /// Its name in messages.
    pub(crate) uri: String,
    /// The file that it is, or would be.
    path: PathBuf,
    /// The client's number for the text, which may be null.
    pub(crate) version: Value,
    pub(crate) source: Source,
    lines: Lines,
    encoding: Encoding,
    /// What is wrong with the text as it was last read.
    pub(crate) findings: Findings,
    /// The messages of the findings that the editor shows.
    pub(crate) shown: HashSet<String>,
    /// Whether it is a scene by content; it stays one while it is edited.
    pub(crate) is_scene: bool,
    assets: Assets,
}

/// A change that has no place in the text, or no text.
#[derive(Debug)]
pub(crate) struct InvalidChange;

/// A field and one of its components, with its place.
pub(crate) struct Place {
    pub(crate) node: Node,
    pub(crate) placed: FieldSpans,
    pub(crate) component: usize,
    pub(crate) span: Span,
}

impl Place {
    pub(crate) fn field(&self) -> &'static Field {
        self.placed.field
    }
}

impl Document {
    pub(crate) fn new(
        uri: String,
        (path, language): (PathBuf, Language),
        text: String,
        encoding: Encoding,
    ) -> Self {
        let mut document = Self {
            uri,
            path,
            version: Value::Null,
            lines: Lines::of(&text),
            source: Source::new(language, Arc::new(text)),
            encoding,
            findings: Findings::default(),
            shown: HashSet::new(),
            is_scene: false,
            assets: Assets::new(&[]),
        };
        document.lower();
        document
    }

    /// The path of its file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn text(&self) -> &str {
        self.source.text()
    }

    /// Takes changes of the editor's, each of the text after those before; returns the edit that they
    /// amount to, if they change anything.
    ///
    /// # Errors
    ///
    /// Fails, without any effect, if a change is invalid.
    pub(crate) fn change(&mut self, changes: &[Value]) -> Result<Option<Edit>, InvalidChange> {
        let mut text = self.text().to_owned();
        let mut lines = self.lines.clone();
        let mut changed = Vec::new();
        for change in changes {
            let Some(new) = change.get("text").and_then(Value::as_str) else {
                return Err(InvalidChange);
            };
            let span = match change.get("range") {
                None | Some(Value::Null) => Some(Span::new(0, text.len())),
                Some(range) => lines.span(&text, range, self.encoding),
            };
            let Some(span) = span.filter(|span| text.len() - span.len() + new.len() <= LONGEST)
            else {
                return Err(InvalidChange);
            };
            let edit = smallest_edit(span.of(&text), new).map(|edit| Edit {
                span: edit.span.shifted(span.start()),
                ..edit
            });
            if let Some(edit) = edit {
                text.replace_range(edit.span.range(), &edit.text);
                lines.follow(&text, &edit);
                changed.push(edit);
            }
        }
        let edit = match changed.as_slice() {
            [] | [_] => changed.pop(),
            _ => smallest_edit(self.source.text(), &text),
        };
        if let Some(edit) = &edit {
            self.source.substitute(Arc::new(text), edit);
            self.lines = lines;
        }
        Ok(edit)
    }

    /// Finds the nodes of the text and what is wrong with it.
    pub(crate) fn lower(&mut self) {
        self.findings = match self.assets.lower(&self.path, &mut self.source) {
            Ok((lowered, _)) => lowered.diagnostics,
            Err(reason) => Lowered::refused(&reason).diagnostics,
        };
        self.is_scene |= self.looks_like_scene();
    }

    /// Whether the text is probably a scene: other languages have the same extensions.
    fn looks_like_scene(&self) -> bool {
        let text = self.text();
        match self.source.language() {
            Language::Ray => true,
            Language::Xml => {
                text.contains("<xml") && ["<scene", "<camera"].iter().any(|tag| text.contains(tag))
            }
            Language::Dat | Language::Cse167 => {
                let is_record = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
                let records = text.lines().filter(is_record).count();
                // What is missing has no place of its own.
                let missing = self.findings.iter().filter(|found| found.span.is_empty());
                2 * (self.findings.count() - missing.count()) <= records
            }
        }
    }

    /// The offset of a position in the parameters of a request.
    pub(crate) fn offset(&self, position: &Value) -> Option<usize> {
        self.lines.offset(self.text(), position, self.encoding)
    }

    pub(crate) fn span(&self, range: &Value) -> Option<Span> {
        self.lines.span(self.text(), range, self.encoding)
    }

    pub(crate) fn position(&self, at: usize) -> Value {
        self.lines.position(self.text(), at, self.encoding)
    }

    pub(crate) fn range(&self, span: Span) -> Value {
        self.lines.range(self.text(), span, self.encoding)
    }

    /// The number of the line that an offset is on, from 0.
    pub(crate) fn line(&self, at: usize) -> usize {
        self.lines.line(at)
    }

    /// The length of a part of a line, as the client counts.
    pub(crate) fn length(&self, span: Span) -> usize {
        self.encoding.length(span.of(self.text()).as_bytes())
    }

    /// A span as a place that an editor can go to.
    pub(crate) fn location(&self, span: Span) -> Value {
        json!({ "uri": self.uri, "range": self.range(span) })
    }

    /// Edits as changes of this document.
    pub(crate) fn workspace_edit(&self, edits: &[Edit]) -> Value {
        let edits: Vec<_> = edits.iter().map(|edit| self.text_edit(edit)).collect();
        json!({ "changes": { &self.uri: edits } })
    }

    /// Edits as changes of this version of the document: an editor that has another one refuses them.
    pub(crate) fn versioned_edit(&self, edits: &[Edit]) -> Value {
        let edits: Vec<_> = edits.iter().map(|edit| self.text_edit(edit)).collect();
        let document = json!({ "uri": self.uri, "version": self.version });
        json!({ "documentChanges": [{ "textDocument": document, "edits": edits }] })
    }

    pub(crate) fn text_edit(&self, edit: &Edit) -> Value {
        json!({ "range": self.range(edit.span), "newText": edit.text })
    }

    /// Whether lowering it takes longer than a key may wait.
    pub(crate) fn is_long(&self) -> bool {
        MOST_SERVED < self.text().len()
    }

    /// Whether its nodes are asked for: not in long texts.
    pub(crate) fn is_served(&self) -> bool {
        self.is_scene && !self.is_long()
    }

    /// The field that states something at an offset.
    pub(crate) fn place(&self, at: usize) -> Option<Place> {
        let node = self.source.node_at(Span::at(at))?;
        let mut fields = self.source.fields(node).into_iter();
        fields.find_map(|placed| {
            let is_here = |component: &usize| {
                let is_stated = placed.default_of(*component).is_none();
                is_stated && placed.spans[*component].touches(Span::at(at))
            };
            let component = (0..placed.spans.len()).find(is_here)?;
            let span = placed.spans[component];
            Some(Place {
                node,
                placed,
                component,
                span,
            })
        })
    }

    /// The fields that the text states of nodes that overlap a span, each place once.
    pub(crate) fn stated_in(&self, span: Span) -> impl Iterator<Item = FieldSpans> {
        let nodes = self.source.nodes_in(span).into_iter();
        let fields = nodes.flat_map(|node| self.source.fields(node));
        let mut known = HashSet::new();
        fields.filter(move |placed| {
            let mut components = 0..placed.spans.len();
            let is_stated = components.all(|at| placed.default_of(at).is_none());
            is_stated
                && placed
                    .spans
                    .first()
                    .is_some_and(|first| known.insert(*first))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "camera 0 0 9 0 0 0 0 1 0 45\nsphere 0 0 0 1\n";

    /// Random changes of any kind leave the document with the text that a plain string has.
    #[test]
    fn changed_texts_are_those_of_a_plain_string() {
        const PIECES: [&str; 12] = [
            "\n",
            "\r\n",
            "\r",
            "1 ",
            "\t",
            "é",
            "\u{1F600}",
            "sphere 0 0 0 1",
            "#",
            " x",
            "",
            "\u{FEFF}",
        ];
        let mut random = 0x9E37_79B9_7F4A_7C15_u64;
        let mut below = |count: usize| {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            (random >> 11) as usize % count
        };
        let ascii = PIECES.map(|piece| if piece.is_ascii() { piece } else { "\r" });
        for (encoding, pieces) in [
            (Encoding::Utf8, PIECES),
            (Encoding::Utf16, PIECES),
            (Encoding::Utf32, PIECES),
            (Encoding::Utf16, ascii),
        ] {
            let path = PathBuf::from("/none/a.test");
            let file = (path, Language::Cse167);
            let mut document = Document::new(
                "file:///none/a.test".to_owned(),
                file,
                TEXT.to_owned(),
                encoding,
            );
            let mut plain = TEXT.to_owned();
            for _ in 0..3_400 {
                let is_end = |at: usize, text: &str| {
                    text.is_char_boundary(at) && !text[..at].ends_with('\r')
                };
                let mut place = |text: &str| loop {
                    let at = below(text.len() + 1);
                    if is_end(at, text) {
                        return at;
                    }
                };
                let (one, other) = (place(&plain), place(&plain));
                let span = Span::new(one.min(other), one.max(other).min(one.min(other) + 40));
                if !is_end(span.end(), &plain) {
                    continue;
                }
                let piece = pieces[below(pieces.len())];
                let change = if below(40) == 0 {
                    plain = TEXT.to_owned();
                    json!({ "text": TEXT })
                } else {
                    let range = document.range(span);
                    plain.replace_range(span.range(), piece);
                    json!({ "range": range, "text": piece })
                };
                document.change(&[change]).expect("valid");
                assert_eq!(document.text(), plain);
                assert_eq!(document.lines, Lines::of(&plain));
            }
        }
    }
}
