//! What may stand in a tag that is still being written.

use super::Lowering;
use crate::schema::Named;
use crate::written::Parse;
use crate::xml::schema::LIGHT;
use crate::xml::tree::{Tree, open_tag};
use scene::Meshes;
use text::Span;

/// A tag in a text that need not be XML behind it.
#[derive(Clone, Debug)]
pub struct Tag {
    /// Its name, which may be empty.
    pub name: Span,
    /// The elements that may stand here, each with what it is in a sentence, if that is known.
    pub elements: Vec<(&'static str, &'static str)>,
    /// The attributes that it may have.
    pub attributes: Vec<Named>,
}

/// The tag at a place; `None` outside tags, or if the text before is not XML.
pub fn tag_at(text: &str, at: usize) -> Option<Tag> {
    let (open, tag) = open_tag(text, at)?;
    let name = Span::new(tag.start() + 1, tag.end());
    // Of any type: lights without one are skipped.
    let (before, kind) = (&text[..name.end()], LIGHT.kinds[0].word);
    let name_or_any = if name.is_empty() { "any" } else { "" };
    let mut whole = format!("{before}{name_or_any} type=\"{kind}\"/>");
    for element in open.iter().rev() {
        whole.extend(["</", &element.of(text)[1..], ">"]);
    }
    let (tree, meshes) = (Tree::parse(&whole), Meshes::default());
    let mut lowering = Lowering::new(&whole, &tree, &meshes);
    lowering.find_roles();
    let last = tree.elements.last()?;
    Some(Tag {
        name,
        elements: last
            .parent
            .map_or_else(Vec::new, |at| lowering.known_in(at as usize)),
        attributes: lowering.known_attributes(tree.elements.len() - 1),
    })
}
