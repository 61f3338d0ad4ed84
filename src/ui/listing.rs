//! The lines of the list: its nodes under headings with their counts.
//!
//! Headings cannot be selected. Nothing is stored per line, so that a list of millions of objects
//! costs no more than a short one, except the rows of a list that shows only some.

use language::{Node, Nodes};
use text::counted;

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
pub struct Listing<'a> {
    nodes: Nodes,
    /// The rows shown, ascending; `None` if all are.
    shown: Option<&'a [usize]>,
    sections: [Section; 4],
}

/// Consecutive nodes of a kind.
#[derive(Clone, Copy, Debug)]
struct Section {
    noun: &'static str,
    /// The number of rows shown before it.
    first: usize,
    /// The number of its rows shown.
    shown: usize,
    /// The number of all nodes of the kind.
    count: usize,
}

impl<'a> Listing<'a> {
    /// The lines of the list of these nodes, of which only some rows, ascending, may be shown.
    pub fn new(nodes: Nodes, shown: Option<&'a [usize]>) -> Self {
        let section = |noun, kind: fn(usize) -> Node| {
            let first = nodes.before(kind(0));
            // No node of the kind has this index.
            let end = nodes.before(kind(usize::MAX));
            let before = shown_before(shown, first);
            Section {
                noun,
                first: before,
                shown: shown_before(shown, end) - before,
                count: end - first,
            }
        };
        Self {
            nodes,
            shown,
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
        let rows = self.shown.map_or_else(|| self.nodes.len(), <[usize]>::len);
        rows + self.headed().count()
    }

    /// Whether there are no lines.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The line with an index.
    pub fn get(&self, line: usize) -> Option<ListLine> {
        let mut place = line;
        for section in self.headed() {
            if place < section.first {
                break;
            }
            if place == section.first {
                return Some(ListLine::Heading(section.heading()));
            }
            place -= 1;
        }
        let row = match self.shown {
            Some(shown) => *shown.get(place)?,
            None => place,
        };
        Some(ListLine::Node(row, self.nodes.get(row)?))
    }

    /// The index of the line that shows the node with a row, or would if it were shown.
    pub fn line_of(&self, row: usize) -> usize {
        let place = shown_before(self.shown, row);
        let above = self.headed().filter(|section| section.first <= place);
        place + above.count()
    }

    /// The sections with a heading.
    fn headed(&self) -> impl Iterator<Item = &Section> {
        self.sections.iter().filter(|section| 0 < section.shown)
    }
}

/// The number of rows shown before a row.
fn shown_before(shown: Option<&[usize]>, row: usize) -> usize {
    shown.map_or(row, |shown| shown.partition_point(|&other| other < row))
}

impl Section {
    fn heading(&self) -> String {
        let all = counted(self.count, self.noun);
        if self.shown == self.count {
            all
        } else {
            format!("{} of {all}", self.shown)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use language::{Language, Source};
    use scene::Meshes;

    fn nodes(language: Language, text: &str) -> Nodes {
        let mut source = Source::new(language, Arc::new(text.to_owned()));
        source.lower(&Meshes::default()).expect("there is memory");
        source.nodes()
    }

    /// The lines of a list, each found by its row as well.
    fn lines(nodes: Nodes, shown: Option<&[usize]>) -> String {
        let listing = Listing::new(nodes, shown);
        assert_eq!(listing.get(listing.len()), None);
        let line = |line| match listing.get(line).expect("a line") {
            ListLine::Heading(words) => words,
            ListLine::Node(row, node) => {
                assert_eq!(listing.line_of(row), line);
                node.to_string()
            }
        };
        (0..listing.len()).map(line).collect::<Vec<_>>().join(", ")
    }

    #[test]
    fn every_node_has_a_line_below_the_heading_of_its_kind() {
        let ball = "sphere 0 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1\n";
        let text = format!(".1 .1 .1\n1\n1 5 5 5 1 1\n2\n{ball}{ball}");
        let xml = nodes(Language::Xml, "");
        let nodes = nodes(Language::Ray, &text);
        let all = "render, view, ambient, 1 light, light 1, 2 objects, object 1, object 2";
        for (nodes, shown, expected) in [
            (nodes, None, all),
            (
                nodes,
                Some(&[2, 5][..]),
                "ambient, 1 of 2 objects, object 2",
            ),
            (nodes, Some(&[]), ""),
            (xml, None, ""),
        ] {
            assert_eq!(lines(nodes, shown), expected);
        }
    }
}
