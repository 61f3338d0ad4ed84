//! Changes of a scene's structure as edits of its text: what every language can delete, copy, move
//! and name; and the text that goes with a node.

use glam::DVec3;

use super::Node;
use super::form::{Form, Motion};
use super::roles::Roles;
use super::schema::Category;
use super::view::{beginning, line_ending, line_from};
use text::{Edit, Span, line_end, next_line, parse_number, rounded, spell_like, without_suffix};

/// How a language changes the structure of a text, which must be free of errors. Counts, lists, IDs
/// and names in the text follow.
pub trait StructureEdits {
    /// What deleting these nodes does to others, as a sentence; `None` if it does nothing.
    fn consequence(&self, nodes: &[Node]) -> Option<String>;

    /// Returns the edits that delete nodes, with the comments on them, and whatever cannot stay
    /// without them.
    ///
    /// # Errors
    ///
    /// Fails if a scene cannot do without one of them.
    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError>;

    /// The text of nodes, with the comments on them, in text order: what
    /// [`StructureEdits::insertion`] takes.
    ///
    /// # Errors
    ///
    /// Fails if a scene has exactly one of such a node.
    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError>;

    /// Returns the edits that insert copied text after a node, or where the language permits it.
    /// IDs and names that are in use are replaced by unused ones.
    ///
    /// # Errors
    ///
    /// Fails if the text is not one of nodes of this language. Their values are not checked.
    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError>;

    /// Returns the edits that exchange a node and its neighbour of the same kind in the same group.
    ///
    /// # Errors
    ///
    /// Fails if there is no such neighbour.
    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError>;

    /// Returns the edits that make the counts of a text agree with what it holds, for instance after
    /// two texts were merged that both add something. None where they agree, or where it is unclear
    /// what is counted. Needs no places.
    fn recount(&self) -> Vec<Edit> {
        Vec::new()
    }

    /// The roles that these leaves play, all of the text: in a merge, leaves of different roles are
    /// never taken for each other. `at_ends` tells whether the text begins, and ends, where the whole
    /// one does of which it may be some lines. Needs no places.
    fn roles(&self, leaves: &[Span], at_ends: [bool; 2]) -> Roles {
        let _ = at_ends;
        Roles::anywhere(leaves.len())
    }

    /// Returns the edits that give what is new in this text since `base` other names or IDs where
    /// `theirs`, another text made from `base`, gives the same to something new of its own;
    /// references follow. Needs no places.
    fn set_apart(&self, base: &str, theirs: &str) -> Vec<Edit> {
        let _ = (base, theirs);
        Vec::new()
    }

    /// The name or ID by which the text calls a node, or its comment where nodes have neither; `None`
    /// if it can have none.
    fn called(&self, node: Node) -> Option<&str>;

    /// Returns the edits that give a node another name, ID or comment; references to it follow.
    ///
    /// # Errors
    ///
    /// Fails if the language does not name such nodes, or the name is in use.
    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError>;

    /// The kinds of things that can be added.
    fn additions(&self) -> &'static [Addition];

    /// Returns the edits that add a thing of a kind, by its name in [`StructureEdits::additions`],
    /// spelled like its neighbours.
    ///
    /// # Errors
    ///
    /// Fails if the text lacks what the thing would refer to.
    fn addition(&self, name: &str, wish: &NewNode<'_>) -> Result<Placement, StructureError>;

    /// Returns the edits that add a plain node of a category with this name or ID, where a field of
    /// `user` can refer to it.
    ///
    /// # Errors
    ///
    /// Fails if the name or ID is in use or none, or if such nodes cannot be plain.
    fn creation(
        &self,
        category: Category,
        name: &str,
        user: Node,
    ) -> Result<Placement, StructureError> {
        let _ = (name, user);
        Err(uncreatable(category))
    }

    /// The words for the kinds that a node can be changed to, with its own; empty if there is no
    /// choice.
    fn kinds(&self, node: Node) -> Vec<&'static str>;

    /// Returns the edits that change a node to another of its [kinds](StructureEdits::kinds) and keep
    /// what both share: place, directions, sizes and material.
    ///
    /// # Errors
    ///
    /// Fails if the node has no size that the other kind could take.
    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError>;

    /// The place and the axes of a node in world space; `None` if it has no place.
    fn pose(&self, node: Node) -> Option<Pose>;

    /// Returns the edits that move, rotate or scale nodes. Points and sizes are rounded to this number
    /// of decimals where they change.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot express the result.
    fn motion(
        &self,
        nodes: &[Node],
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError>;

    /// Returns the edits that make the directions of a node's frame orthogonal, and of length 1 unless
    /// their lengths count; none if they are so. The last direction and the handedness stay.
    ///
    /// # Errors
    ///
    /// Fails if the node has no such directions, or two are parallel.
    fn orthonormalised(&self, node: Node) -> Result<Vec<Edit>, StructureError>;
}

/// The error for a category without plain nodes.
pub(super) fn uncreatable(category: Category) -> StructureError {
    StructureError::Inexpressible(format!(
        "{} cannot be created by name alone",
        category.word()
    ))
}

/// A kind of thing that can be added to a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Addition {
    /// Its name, unique in its language: `point light`.
    pub name: &'static str,
    /// What it is, in a phrase.
    pub words: &'static str,
    /// Where its shape comes from.
    shape: Shape,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Own,
    Flat,
    File,
}

impl Addition {
    pub(super) const fn new(name: &'static str, words: &'static str) -> Self {
        let shape = Shape::Own;
        Self { name, words, shape }
    }

    /// A kind of thing without a height.
    pub(super) const fn flat(name: &'static str, words: &'static str) -> Self {
        let shape = Shape::Flat;
        Self { name, words, shape }
    }

    /// A kind of thing that is read from a file.
    pub(super) const fn of_file(name: &'static str, words: &'static str) -> Self {
        let shape = Shape::File;
        Self { name, words, shape }
    }

    /// Whether it needs [`NewNode::file`].
    pub fn needs_file(&self) -> bool {
        self.shape == Shape::File
    }

    /// Whether it is as high as its centre, instead of half its extent above and below that.
    pub fn is_flat(&self) -> bool {
        self.shape == Shape::Flat
    }
}

/// Where to add a thing, and how large.
#[derive(Clone, Copy, Debug)]
pub struct NewNode<'a> {
    /// Its centre.
    pub centre: DVec3,
    /// Half its extent, above 0.
    pub half: f64,
    /// The axis of the world along which solids of revolution stand: y or z.
    pub up: DVec3,
    /// The number of decimals that its numbers need at most.
    pub decimals: usize,
    /// The selected node: the new one stands after it, and takes its material.
    pub after: Node,
    /// The marked nodes, which a combination combines.
    pub marked: &'a [Node],
    /// The file of a mesh, as the text is to name it.
    pub file: Option<&'a str>,
}

/// The place and the axes of a node in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Its centre, or the origin of its own space.
    pub centre: DVec3,
    /// The unit vectors of its own axes.
    pub axes: [DVec3; 3],
}

/// The neighbour with which a node exchanges places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbour {
    /// The one before it.
    Previous,
    /// The one after it.
    Next,
}

/// Why a text cannot be restructured as requested.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StructureError {
    /// The node stands for a part that every scene has once.
    #[error("{0} cannot be copied, moved or deleted")]
    Fixed(String),
    /// The language requires at least one such node.
    #[error("the last {noun} cannot be deleted: {reason}")]
    Last {
        /// The noun for the kind of node.
        noun: &'static str,
        /// What requires it.
        reason: &'static str,
    },
    /// A node must stay after another, to which its text refers.
    #[error("{user} must stay after {used}, which it uses")]
    Order {
        /// The name of the node that refers to the other.
        user: String,
        /// The name of the other.
        used: String,
    },
    /// A text is not one of nodes of the language.
    #[error("cannot paste this: {reason}")]
    Foreign {
        /// What was expected, or what is wrong.
        reason: String,
    },
    /// A node cannot be renamed.
    #[error("{0}")]
    Name(String),
    /// A text cannot express a change.
    #[error("{0}")]
    Inexpressible(String),
    /// There is no neighbour to exchange places with.
    #[error("{name} is already the {end}{place}")]
    AtEnd {
        /// The node's name.
        name: String,
        /// `first` or `last`.
        end: &'static str,
        /// Of what, if not of all nodes of its kind.
        place: &'static str,
    },
}

impl StructureError {
    /// The error for a node without a neighbour on this side; `place` says among what.
    pub(super) fn at_end(name: String, neighbour: Neighbour, place: &'static str) -> Self {
        let end = match neighbour {
            Neighbour::Previous => "first",
            Neighbour::Next => "last",
        };
        Self::AtEnd { name, end, place }
    }
}

/// Edits that copy or move a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placement {
    /// The edits, sorted and disjoint.
    pub edits: Vec<Edit>,
    /// The index of the edit that writes the node.
    pub at: usize,
}

/// The text of a node with what belongs to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    /// Whole lines, comments on the node included, without the end of the last line.
    Lines(Span),
    /// The node alone: it shares a line with others.
    Part(Span),
}

impl Block {
    pub(super) fn span(self) -> Span {
        match self {
            Self::Lines(span) | Self::Part(span) => span,
        }
    }
}

/// The whole lines of a text and of the comment lines directly before it. `above` maps the start of
/// a line to the start of the comment that ends on the line before, if only a comment does.
pub(super) fn lines(text: &str, own: Span, above: impl Fn(usize) -> Option<usize>) -> Span {
    let mut start = line_from(text, own.start());
    while let Some(comment) = above(start) {
        start = comment;
    }
    Span::new(start, line_end(text, own.end()))
}

/// Whether a text begins on the line after another.
pub(super) fn follows(text: &str, own: Span, next: Span) -> bool {
    let line = next_line(text, own.end());
    line <= next.start()
        && text[line..next.start()]
            .trim_matches([' ', '\t'])
            .is_empty()
}

/// The line before the one that starts at `start`.
pub(super) fn line_before(text: &str, start: usize) -> Option<Span> {
    let last = start.checked_sub(1)?;
    (beginning(text) <= last).then(|| {
        let start = line_from(text, last);
        Span::new(start, line_end(text, start))
    })
}

/// Returns the edits that delete blocks: with whole lines go the blank lines before them, unless
/// other lines follow directly.
pub(super) fn deletions(text: &str, blocks: impl Iterator<Item = Block>) -> Vec<Edit> {
    let mut spans: Vec<_> = blocks.map(|block| deletion(text, block)).collect();
    spans.sort_unstable();
    let mut merged: Vec<Span> = Vec::with_capacity(spans.len());
    for span in spans {
        match merged.last_mut() {
            Some(last) if span.start() <= last.end() => {
                *last = last.to(Span::new(last.start(), last.end().max(span.end())));
            }
            _ => merged.push(span),
        }
    }
    let delete = |span| Edit {
        span,
        text: String::new(),
    };
    merged.into_iter().map(delete).collect()
}

/// The text that goes with a deleted block.
fn deletion(text: &str, block: Block) -> Span {
    let is_blank = |line: Span| line.of(text).trim().is_empty();
    match block {
        Block::Lines(span) => {
            let end = next_line(text, span.end());
            let mut start = span.start();
            if end == text.len() || is_blank(Span::new(end, line_end(text, end))) {
                while let Some(before) = line_before(text, start).filter(|line| is_blank(*line)) {
                    start = before.start();
                }
            }
            let is_last = end == span.end();
            if let Some(before) = line_before(text, start).filter(|_| is_last) {
                start = before.end();
            }
            Span::new(start, end)
        }
        Block::Part(span) => {
            let blank = [' ', '\t'];
            let behind = &text[span.end()..];
            let end = text.len() - behind.trim_start_matches(blank).len();
            if end < line_end(text, end) {
                return Span::new(span.start(), end);
            }
            let before = text[..span.start()].trim_end_matches(blank);
            Span::new(before.len(), end)
        }
    }
}

/// Returns the edit that writes whole lines after a block of whole lines, separated by a blank line
/// if one precedes the block.
pub(super) fn lines_after(text: &str, block: Span, lines: &str) -> Edit {
    let ending = line_ending(text);
    let before = line_before(text, block.start());
    let gap = before.filter(|line| line.of(text).trim().is_empty());
    Edit {
        span: Span::at(block.end()),
        text: format!("{ending}{}{lines}", gap.map_or("", |_| ending)),
    }
}

/// A copied text without surrounding blank lines, with the line endings of another text.
pub(super) fn adapted(copied: &str, text: &str) -> String {
    inner_lines(copied).join(line_ending(text))
}

/// The lines of a copied text without surrounding blank ones.
pub(super) fn inner_lines(copied: &str) -> Vec<&str> {
    let lines = copied.lines().map(|line| line.trim_end_matches('\r'));
    let mut lines: Vec<_> = lines.skip_while(|line| line.trim().is_empty()).collect();
    while lines.pop_if(|line| line.trim().is_empty()).is_some() {}
    lines
}

/// Returns the edits that exchange two nodes, the first of which precedes the second; `node` is the
/// one that moves. `parts` are their texts alone, for blocks that share lines.
pub(super) fn exchange(
    text: &str,
    blocks: [Block; 2],
    parts: [Span; 2],
    neighbour: Neighbour,
) -> Placement {
    let [first, second] = match blocks {
        [Block::Lines(first), Block::Lines(second)] => [first, second],
        _ => parts,
    };
    let replace = |span, by: Span| Edit {
        span,
        text: by.of(text).to_owned(),
    };
    Placement {
        edits: vec![replace(first, second), replace(second, first)],
        at: match neighbour {
            Neighbour::Previous => 0,
            Neighbour::Next => 1,
        },
    }
}

/// The pair of indices to exchange, in order, of `count` nodes; `None` at the end.
pub(super) fn pair(index: usize, count: usize, neighbour: Neighbour) -> Option<[usize; 2]> {
    let first = match neighbour {
        Neighbour::Previous => index.checked_sub(1)?,
        Neighbour::Next => index,
    };
    (first + 1 < count).then_some([first, first + 1])
}

impl Pose {
    pub(super) fn of(form: &Form) -> Self {
        Self {
            centre: form.centre,
            axes: form.axes,
        }
    }
}

impl NewNode<'_> {
    /// A number as the wish's text shows it: rounded to its decimals.
    pub(super) fn literal(&self, number: f64) -> String {
        rounded(number, self.decimals).to_string()
    }
}

/// The number at a span of a text without errors.
pub(super) fn number(text: &str, span: Span) -> f64 {
    let literal = span.of(text).trim();
    let literal = without_suffix(literal).unwrap_or(literal);
    parse_number(literal).unwrap_or_default()
}

/// Returns the edits that replace numbers at these spans, spelled like the old ones.
pub(super) fn replacements(text: &str, spans: &[Span], new: &[f64]) -> Vec<Edit> {
    let changed = spans
        .iter()
        .zip(new)
        .filter(|(span, new)| number(text, **span) != **new);
    let edit = |(span, new): (&Span, &f64)| Edit {
        span: *span,
        text: spell_like(span.of(text).trim(), *new),
    };
    changed.map(edit).collect()
}
