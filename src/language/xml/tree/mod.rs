//! The tree of an `.xml` text: nested elements with attributes.
//!
//! The tree is flat, in document order, and traversed without recursion: elements may be nested a
//! hundred thousand deep.

mod fault;
mod scan;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::ops::Range;

use roxmltree::{Document, Error, Node, NodeType, ParsingOptions};

use crate::words::{skip_white_space, white_space};
use crate::written::Parse;
use text::{Diagnostic, Edit, Span};

/// The elements and comments of a text, each in text order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    /// Elements, in the order of their start tags: each precedes its descendants.
    pub elements: Vec<Element>,
    /// The attributes of all elements.
    pub attributes: Vec<Attribute>,
    /// Comments, with their delimiters.
    pub comments: Vec<Span>,
    /// Text between tags, without surrounding white space, and the element it is in.
    pub words: Vec<(Span, u32)>,
    /// The error if the text is not XML; then there are no elements.
    pub fault: Option<Diagnostic>,
    /// Spans that are one leaf even if they contain white space: values, comments, instructions.
    whole: Vec<Span>,
}

/// An element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Element {
    /// Its name in the start tag.
    pub name: Span,
    /// The start tag.
    pub tag: Span,
    /// From the start tag to the end tag.
    pub whole: Span,
    /// Where to insert another attribute.
    pub attributes_end: u32,
    /// Start of the end tag; for an empty-element tag, the end of the tag.
    pub close: u32,
    /// The line end before the element and its indentation; empty if anything else precedes it on
    /// its line.
    pub lead: Span,
    /// Index of the element it is in.
    pub parent: Option<u32>,
    /// Number of elements it is in.
    pub depth: u32,
    /// Index after its last descendant.
    pub end: u32,
    first_attribute: u32,
    end_attribute: u32,
}

/// An attribute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Attribute {
    /// Its name.
    pub name: Span,
    /// The text between the quotes.
    pub value: Span,
    /// The value, if references or line ends make it differ from the text.
    unescaped: Option<Box<str>>,
}

impl Element {
    /// Whether it is an empty-element tag.
    pub(crate) fn is_empty_tag(&self) -> bool {
        self.tag == self.whole
    }

    /// Its name wherever it stands: in the start tag, and in the end tag if there is one.
    pub(crate) fn names(&self) -> Vec<Span> {
        let start = self.close as usize + "</".len();
        let end = Span::new(start, start + self.name.len());
        let end = (!self.is_empty_tag()).then_some(end);
        [self.name].into_iter().chain(end).collect()
    }

    /// The indices of its attributes.
    pub(crate) fn attributes(&self) -> Range<usize> {
        self.first_attribute as usize..self.end_attribute as usize
    }
}

impl Attribute {
    /// Its value, with references resolved.
    pub(crate) fn unescaped<'t>(&'t self, text: &'t str) -> &'t str {
        self.unescaped
            .as_deref()
            .unwrap_or_else(|| self.value.of(text))
    }
}

impl Tree {
    /// The direct children of an element, in order.
    pub(crate) fn children(&self, parent: usize) -> impl Iterator<Item = usize> + '_ {
        let end = self.elements.get(parent).map_or(0, |element| element.end);
        let mut next = parent + 1;
        std::iter::from_fn(move || {
            let child = (next < end as usize).then_some(next)?;
            next = self.elements[child].end as usize;
            Some(child)
        })
    }

    /// The index of the first attribute of an element with this name.
    pub(super) fn attribute_at(&self, text: &str, element: usize, name: &str) -> Option<usize> {
        let mut own = self.elements.get(element)?.attributes();
        own.find(|&at| self.attributes[at].name.of(text) == name)
    }

    /// The first attribute of an element with this name.
    pub(crate) fn attribute(&self, text: &str, element: usize, name: &str) -> Option<&Attribute> {
        self.attributes.get(self.attribute_at(text, element, name)?)
    }

    /// The attribute value whose text is at a span, with references resolved.
    pub(crate) fn unescaped<'t>(&'t self, text: &'t str, value: Span) -> &'t str {
        let at = self
            .attributes
            .binary_search_by_key(&value.start(), |attribute| attribute.value.start());
        match at {
            Ok(at) => self.attributes[at].unescaped(text),
            Err(_) => value.of(text),
        }
    }

    /// The innermost element whose text contains `span`.
    pub(crate) fn element_at(&self, span: Span) -> Option<usize> {
        let holds = |element: &Element| {
            element.whole.start() <= span.start() && span.end() <= element.whole.end()
        };
        let after = self
            .elements
            .partition_point(|element| element.whole.start() <= span.start());
        let mut at = after.checked_sub(1)?;
        while !holds(&self.elements[at]) {
            at = self.elements[at].parent? as usize;
        }
        Some(at)
    }

    /// The leaves: tags, parts of tags and words, but whole values, comments and instructions.
    pub(super) fn leaves(&self, text: &str) -> Vec<Span> {
        let mut leaves = Vec::new();
        let mut start = 0;
        let mut close = |start: usize, end: usize| {
            if start < end {
                leaves.push(Span::new(start, end));
            }
        };
        let mut gaps = gaps(text).peekable();
        for whole in self.whole.iter().copied().chain([Span::at(text.len())]) {
            while let Some(gap) = gaps.next_if(|gap| gap.start() < whole.start()) {
                close(start, gap.start());
                start = gap.end();
            }
            // White space inside belongs to the leaf.
            while gaps.next_if(|gap| gap.start() < whole.end()).is_some() {}
            close(start, whole.start());
            close(whole.start(), whole.end());
            start = whole.end();
        }
        leaves
    }
}

impl Parse for Tree {
    /// Parses elements and comments. Refuses document type declarations, and entities with them.
    fn parse(text: &str) -> Self {
        let mut tree = Self::default();
        let read = scan::scan(text).and_then(|mut open| {
            document(text).map_err(|error| fault::diagnostic(text, &error, open.pop()))
        });
        match read {
            Ok(document) => tree.fill(text, &document),
            Err(fault) => tree.fault = Some(fault),
        }
        tree
    }
}

/// Returns an error if no text with this beginning can be XML.
pub(super) fn fault_of_beginning(text: &str) -> Option<Diagnostic> {
    /// An error this close to the end may be caused by the cut: longer than any reference, and than
    /// any delimiter of a comment or the like.
    const NEAR: usize = 64;
    if let Err(refused) = scan::scan(text) {
        return Some(refused);
    }
    match document(text) {
        // What follows may close open elements.
        Ok(_) | Err(Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream) => {
            None
        }
        Err(error) => {
            let fault = fault::diagnostic(text, &error, None);
            (fault.span.start() + NEAR < text.len()).then_some(fault)
        }
    }
}

fn document(text: &str) -> Result<Document<'_>, Error> {
    let options = ParsingOptions {
        allow_dtd: false,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options)
}

/// The tag that a place is in, from its `<` to its name, behind the elements that it is in.
pub(super) fn open_tag(text: &str, at: usize) -> Option<(Vec<Span>, Span)> {
    let mut open = scan::scan(&text[..at]).ok()?;
    let tag = open.pop()?;
    let end = scan::tag_end(text, tag.start() + 1);
    (at < end || !text[..end].ends_with('>')).then_some((open, tag))
}

/// The quote that delimits a value.
pub(super) fn quote(text: &str, value: Span) -> char {
    if text[value.end()..].starts_with('\'') {
        '\''
    } else {
        '"'
    }
}

/// The edit that replaces a value.
pub(super) fn respelled(text: &str, span: Span, value: &str) -> Edit {
    Edit {
        span,
        text: escaped(value, quote(text, span)).into_owned(),
    }
}

/// Escapes `value` for use between two of `quote`.
pub(super) fn escaped(value: &str, quote: char) -> Cow<'_, str> {
    let special = |c: char| c == quote || matches!(c, '&' | '<' | '\t' | '\n' | '\r');
    if !value.contains(special) {
        return Cow::Borrowed(value);
    }
    let mut escaped = String::with_capacity(value.len() + 8);
    for c in value.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' if c == quote => escaped.push_str("&quot;"),
            '\'' if c == quote => escaped.push_str("&apos;"),
            // Unescaped, they would be read as blanks.
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            c => escaped.push(c),
        }
    }
    Cow::Owned(escaped)
}

impl Tree {
    fn fill(&mut self, text: &str, document: &Document<'_>) {
        let mut open: Vec<(roxmltree::NodeId, u32)> = Vec::new();
        for node in document.descendants() {
            let range = node.range();
            // Open elements that do not contain this node are closed.
            while let Some(&(id, element)) = open.last() {
                if node.parent().is_some_and(|parent| parent.id() == id) {
                    break;
                }
                self.elements[element as usize].end = self.elements.len() as u32;
                open.pop();
            }
            let parent = open.last().map(|&(_, element)| element);
            match node.node_type() {
                NodeType::Root => {}
                NodeType::Element => {
                    open.push((node.id(), self.elements.len() as u32));
                    self.add(text, &node, parent);
                }
                NodeType::Comment => {
                    let span = Span::new(range.start, range.end);
                    self.comments.push(span);
                    self.whole.push(span);
                }
                NodeType::PI => self.whole.push(Span::new(range.start, range.end)),
                NodeType::Text => {
                    let words = &text[range.clone()];
                    let start = range.start + words.len() - words.trim_start().len();
                    let words = words.trim();
                    if let Some(parent) = parent.filter(|_| !words.is_empty()) {
                        let span = Span::new(start, start + words.len());
                        self.words.push((span, parent));
                    }
                }
            }
        }
        for (_, element) in open {
            self.elements[element as usize].end = self.elements.len() as u32;
        }
    }

    fn add(&mut self, text: &str, node: &Node<'_, '_>, parent: Option<u32>) {
        let range = node.range();
        let name_start = range.start + 1;
        let name_len = text[name_start..].find([' ', '\t', '\r', '\n', '/', '>']);
        let name_end = name_start + name_len.unwrap_or_default();
        let first_attribute = self.attributes.len() as u32;
        let mut attributes_end = name_end;
        for attribute in node.attributes() {
            let range = attribute.range();
            // The parser's own lengths saturate, so they are measured in the text.
            let written = &text[range.clone()];
            let name = written.find([' ', '\t', '\r', '\n', '=']).unwrap_or(0);
            let quote = written.find(['"', '\'']).unwrap_or(0);
            let value = Span::new(range.start + quote + 1, range.end - 1);
            let is_plain = attribute.value() == value.of(text);
            self.attributes.push(Attribute {
                name: Span::new(range.start, range.start + name),
                value,
                unescaped: (!is_plain).then(|| attribute.value().into()),
            });
            if !value.is_empty() {
                self.whole.push(value);
            }
            attributes_end = range.end;
        }
        // Namespace declarations are not among the attributes.
        let tag_end = scan::tag_end(text, attributes_end);
        let inner = text[name_end..tag_end].trim_end_matches('>');
        let inner = inner.strip_suffix('/').unwrap_or(inner).trim_end();
        let is_empty = tag_end == range.end;
        let close = if is_empty {
            tag_end
        } else {
            range.start + text[range.clone()].rfind("</").unwrap_or_default()
        };
        self.elements.push(Element {
            name: Span::new(name_start, name_end),
            tag: Span::new(range.start, tag_end),
            whole: Span::new(range.start, range.end),
            attributes_end: (name_end + inner.len()) as u32,
            close: close as u32,
            lead: lead(text, range.start),
            parent,
            depth: parent.map_or(0, |parent| self.elements[parent as usize].depth + 1),
            end: 0,
            first_attribute,
            end_attribute: self.attributes.len() as u32,
        });
    }
}

/// The line end before an offset and the indentation after it, if nothing else stands between.
fn lead(text: &str, at: usize) -> Span {
    let before = text[..at].trim_end_matches([' ', '\t']);
    let line = match before.strip_suffix('\n') {
        Some(line) => Some(line.trim_end_matches('\r')),
        None => before.strip_suffix('\r'),
    };
    line.map_or_else(|| Span::at(at), |line| Span::new(line.len(), at))
}

/// The runs of white space in a text.
fn gaps(text: &str) -> impl Iterator<Item = Span> {
    let bytes = text.as_bytes();
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = (at..bytes.len()).find(|&at| white_space(&bytes[at..]).is_some())?;
        at = skip_white_space(bytes, start);
        Some(Span::new(start, at))
    })
}
