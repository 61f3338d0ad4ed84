//! The lines of the list: its nodes under headings with their counts.
//!
//! Headings cannot be selected. Nothing is stored per line, so that a list of millions of objects
//! costs no more than a short one.

use crate::language::{Node, Nodes};
use crate::text::counted;

/// A line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ListLine {
    /// The heading of the nodes below: `3 lights`.
    Heading(String),
    /// A node and its row among the nodes.
    Node(usize, Node),
}

/// The lines of the list of some nodes.
#[derive(Clone, Copy, Debug)]
pub struct Listing {
    nodes: Nodes,
    sections: [Section; 4],
}

/// Consecutive nodes of a kind.
#[derive(Clone, Copy, Debug)]
struct Section {
    noun: &'static str,
    /// The row of the first node.
    first: usize,
    count: usize,
}

impl Listing {
    /// The lines of the list of these nodes.
    pub fn new(nodes: Nodes) -> Self {
        let section = |noun, kind: fn(usize) -> Node| {
            let first = nodes.before(kind(0));
            // No node of the kind has this index.
            let count = nodes.before(kind(usize::MAX)) - first;
            Section { noun, first, count }
        };
        Self {
            nodes,
            sections: [
                section("light", Node::Light),
                section("material", Node::Material),
                section("texture", Node::Texture),
                section("object", Node::Object),
            ],
        }
    }

    /// The number of lines.
    pub fn len(&self) -> usize {
        self.nodes.len() + self.headed().count()
    }

    /// Whether there are no lines.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The line with an index.
    pub fn get(&self, line: usize) -> Option<ListLine> {
        let mut row = line;
        for section in self.headed() {
            if row < section.first {
                break;
            }
            if row == section.first {
                return Some(ListLine::Heading(counted(section.count, section.noun)));
            }
            row -= 1;
        }
        Some(ListLine::Node(row, self.nodes.get(row)?))
    }

    /// The index of the line that shows the node with a row.
    pub fn line_of(&self, row: usize) -> usize {
        row + self.headed().filter(|section| section.first <= row).count()
    }

    /// The sections with a heading.
    fn headed(&self) -> impl Iterator<Item = &Section> {
        self.sections.iter().filter(|section| 0 < section.count)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::language::{Language, Source};
    use crate::scene::Meshes;

    fn listing(language: Language, text: &str) -> Listing {
        let mut source = Source::new(language, Arc::new(text.to_owned()));
        source.lower(&Meshes::default()).expect("there is memory");
        Listing::new(source.nodes())
    }

    #[test]
    fn every_node_has_a_line_below_the_heading_of_its_kind() {
        let ball = "sphere 0 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1\n";
        let text = format!(".1 .1 .1\n1\n1 5 5 5 1 1\n2\n{ball}{ball}");
        let listing = listing(Language::Ray, &text);
        let lines: Vec<_> = (0..listing.len())
            .map(|line| match listing.get(line) {
                Some(ListLine::Heading(words)) => words,
                Some(ListLine::Node(row, node)) => {
                    assert_eq!(listing.line_of(row), line);
                    node.to_string()
                }
                None => panic!("line {line} is missing"),
            })
            .collect();
        assert_eq!(
            lines,
            [
                "view",
                "ambient",
                "1 light",
                "light 1",
                "2 objects",
                "object 1",
                "object 2"
            ]
        );
        assert_eq!(listing.get(listing.len()), None);
    }

    #[test]
    fn an_empty_list_has_no_lines() {
        let listing = listing(Language::Xml, "");
        assert!(listing.is_empty() && listing.get(0).is_none());
    }
}
