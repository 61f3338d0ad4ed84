//! Where in the text each field of a scene stands, for each language.

pub(super) mod dat;
mod node;
pub(super) mod ray;
pub(super) mod xml;

pub use node::{Node, Nodes};

use std::fmt;

use super::fields::ray::ShapeKind;
use super::fields::{Category, Field};
use super::placed::Placed;
use crate::format::Tree;
use crate::text::Span;

/// What is in a file that a text names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A picture, of a texture.
    Picture,
    /// A mesh, of an object.
    Mesh,
}

/// Another file that a text names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    /// Its path, relative to the scene's folder: as the text says it, or a mesh that the text names.
    pub path: String,
    /// What is in it.
    pub kind: FileKind,
    /// Where the text names it, or the mesh.
    pub span: Span,
    /// What it is: `texture 2 file`.
    pub what: String,
}

/// Where everything that was lowered stands. It holds indices into the tree: ask it only with the
/// tree it was made from.
#[derive(Clone, Debug)]
pub enum Origins {
    /// Of a `.ray` text.
    Ray(ray::Origins),
    /// Of a `.dat` text.
    Dat(dat::Origins),
    /// Of a `.xml` text.
    Xml(xml::Origins),
}

impl Default for Origins {
    fn default() -> Self {
        Self::Ray(ray::Origins::default())
    }
}

impl Origins {
    /// The view, ambient light or background and environment, lights, materials, textures, objects: as
    /// far as the text has them and could be understood.
    pub fn nodes(&self) -> Nodes {
        match self {
            Self::Ray(origins) => origins.nodes(),
            Self::Dat(origins) => origins.nodes(),
            Self::Xml(origins) => origins.nodes(),
        }
    }

    /// What a node is called: `view`, `ambient`, `light 2`, `object 3 (box)`.
    pub fn name(&self, node: Node) -> String {
        match self {
            Self::Ray(origins) => origins.name(node),
            Self::Dat(origins) => origins.name(node),
            Self::Xml(origins) => origins.name(node),
        }
    }

    /// How many listed things a node is in.
    pub fn depth(&self, node: Node) -> usize {
        match self {
            Self::Ray(_) | Self::Dat(_) => 0,
            Self::Xml(origins) => origins.depth(node),
        }
    }

    /// A node's fields with their places. A node whose text breaks off has only those fields whose
    /// components are all there.
    pub fn fields(&self, tree: &Tree, node: Node) -> Vec<Placed> {
        match (self, tree) {
            (Self::Ray(origins), Tree::Ray(tree)) => origins.fields(tree, node),
            (Self::Dat(origins), Tree::Dat(tree)) => origins.fields(tree, node),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.fields(tree, node),
            _ => Vec::new(),
        }
    }

    /// The whole of a node's text, from its first token to its last; empty for a missing view. Of a
    /// node that stands in several places, the first.
    pub fn span(&self, tree: &Tree, node: Node) -> Span {
        match (self, tree) {
            (Self::Ray(origins), Tree::Ray(tree)) => origins.span(tree, node),
            (Self::Dat(origins), Tree::Dat(tree)) => origins.span(tree, node),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.span(tree, node),
            _ => Span::at(0),
        }
    }

    /// What a comment says of a node: one that follows its text in the line where that begins, or
    /// else where it ends; in `.dat` one that takes the line before; in `.xml` one behind the start tag
    /// or in the line before.
    pub fn comment<'t>(&self, text: &'t str, tree: &Tree, node: Node) -> Option<&'t str> {
        match (self, tree) {
            (Self::Ray(origins), Tree::Ray(tree)) => origins.comment(text, tree, node),
            (Self::Dat(origins), Tree::Dat(tree)) => origins.comment(text, tree, node),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.comment(text, tree, node),
            _ => None,
        }
    }

    /// The node whose text holds or touches `span`. A view comment inside another node's text
    /// counts as the view; where it ends at that node's token, the token counts.
    pub fn node_at(&self, tree: &Tree, span: Span) -> Option<Node> {
        match (self, tree) {
            (Self::Ray(origins), Tree::Ray(tree)) => origins.node_at(tree, span),
            (Self::Dat(origins), Tree::Dat(tree)) => origins.node_at(tree, span),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.node_at(tree, span),
            _ => None,
        }
    }

    /// The nodes whose text `span` covers in part or lies within, in text order.
    pub fn nodes_in(&self, tree: &Tree, span: Span) -> Vec<Node> {
        match (self, tree) {
            (Self::Ray(origins), Tree::Ray(tree)) => origins.nodes_in(tree, span),
            (Self::Dat(origins), Tree::Dat(tree)) => origins.nodes_in(tree, span),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.nodes_in(tree, span),
            _ => Vec::new(),
        }
    }

    /// What an object is made of: itself, then the objects it combines, each with how deep it lies
    /// below the first. At most `limit` of them; one alone if it is not a combination.
    pub fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        match self {
            Self::Ray(_) | Self::Xml(_) => vec![(0, Node::Object(object))],
            Self::Dat(origins) => origins.parts(object, limit),
        }
    }

    /// The object of the scene that an object of the text is; `None` if it is not drawn.
    pub fn drawn(&self, object: usize) -> Option<u32> {
        match self {
            Self::Ray(_) => u32::try_from(object).ok(),
            Self::Dat(origins) => place(&origins.drawn, object),
            Self::Xml(origins) => place(&origins.drawn, object),
        }
    }

    /// Whether an object of the text is but what is in it.
    pub fn is_group(&self, object: usize) -> bool {
        match self {
            Self::Ray(_) | Self::Dat(_) => false,
            Self::Xml(origins) => origins.is_group(object),
        }
    }

    /// The object of the text that an object of the scene is.
    pub fn object(&self, drawn: u32) -> usize {
        match self {
            Self::Ray(_) => drawn as usize,
            Self::Dat(origins) => thing(&origins.drawn, drawn),
            Self::Xml(origins) => thing(&origins.drawn, drawn),
        }
    }

    /// The material of an object that is listed as a thing of its own.
    pub fn material(&self, object: usize) -> Option<usize> {
        match self {
            Self::Ray(_) => None,
            Self::Dat(origins) => origins.objects.get(object)?.material,
            Self::Xml(origins) => *origins.dressed.get(object)?,
        }
    }

    /// The numbers that a field of a node may refer to: those of a category that are given before
    /// the node's text, ascending.
    pub fn identities(&self, node: Node, category: Category) -> Vec<i64> {
        match self {
            Self::Ray(_) | Self::Xml(_) => Vec::new(),
            Self::Dat(origins) => origins.identities(node, category),
        }
    }

    /// The names that a field may say: those of a category, in text order, each once.
    pub fn names(&self, text: &str, tree: &Tree, category: Category) -> Vec<String> {
        match (self, tree, category) {
            (Self::Xml(origins), Tree::Xml(tree), Category::Material) => {
                origins.material_names(text, tree)
            }
            _ => Vec::new(),
        }
    }

    /// The files that a text names, or that its meshes do, as far as those were read.
    pub fn files(&self, text: &str, tree: &Tree) -> Vec<NamedFile> {
        match (self, tree) {
            (Self::Dat(origins), Tree::Dat(tree)) => origins.files(text, tree),
            (Self::Xml(origins), Tree::Xml(tree)) => origins.files(text, tree),
            _ => Vec::new(),
        }
    }

    /// How many objects a material or a texture is part of.
    pub fn users(&self, node: Node) -> usize {
        match self {
            Self::Ray(_) => 0,
            Self::Dat(origins) => origins.users(node),
            Self::Xml(origins) => origins.users(node),
        }
    }
}

/// The place of an object among those that are drawn.
fn place(drawn: &[usize], object: usize) -> Option<u32> {
    u32::try_from(drawn.binary_search(&object).ok()?).ok()
}

/// The object at a place among those that are drawn.
fn thing(drawn: &[usize], place: u32) -> usize {
    drawn.get(place as usize).copied().unwrap_or(usize::MAX)
}

/// Hands out `tokens` to the fields in order, until one is not complete.
fn hand_out(tokens: &[Span], fields: impl Iterator<Item = &'static Field>) -> Vec<Placed> {
    let mut rest = tokens;
    fields
        .map_while(|field| {
            let (spans, after) = rest.split_at_checked(field.kind.components())?;
            rest = after;
            Some(Placed::said(field, spans.to_vec()))
        })
        .collect()
}

/// A node's name, spelled out only where a message needs it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Name {
    View,
    Ambient,
    Light(usize),
    Object(usize, ShapeKind),
    /// Something known by a number: what it is, its number, and of what kind.
    Known(&'static str, i64, &'static str),
    /// A record without a number.
    Record(&'static str),
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::View => f.write_str("view"),
            Self::Ambient => f.write_str("ambient"),
            Self::Light(index) => write!(f, "light {}", index + 1),
            Self::Object(index, kind) => write!(f, "object {} ({})", index + 1, kind.keyword()),
            Self::Known(word, id, "") => write!(f, "{word} {id}"),
            Self::Known(word, id, kind) => write!(f, "{word} {id} ({kind})"),
            Self::Record(word) => f.write_str(word),
        }
    }
}
