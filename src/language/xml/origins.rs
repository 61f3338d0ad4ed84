//! Where the things of a `.xml` text stand: each is an element, and its fields are attributes of
//! that and of elements in it.

mod fields;
mod insert;

use std::collections::HashSet;

use super::table::{LightKind, MaterialKind, ObjectKind, Parameter};
use super::tree::{Attribute, Tree};
use crate::language::node::{FileKind, NamedFile};
use crate::language::node::{Node, Nodes};
use crate::language::placed::Placed;
use crate::text::{Span, is_one_line_end, visible};

/// Where everything that was lowered stands. It holds indices of elements and attributes: ask it
/// only with the tree it was made from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// What each element is.
    pub(super) roles: Vec<Role>,
    /// The element whose node each element belongs to, and 0 where it belongs to none.
    pub(super) owners: Vec<u32>,
    /// What each attribute is: its place in [`WORDS`], or [`NO_WORD`].
    pub(super) words: Vec<u8>,
    pub(super) root: Option<usize>,
    pub(super) scene: Option<usize>,
    pub(super) camera: Option<usize>,
    pub(super) lights: Vec<Place<LightKind>>,
    pub(super) materials: Vec<Place<MaterialKind>>,
    pub(super) objects: Vec<Place<ObjectKind>>,
    /// The material of each object, by index.
    pub(super) dressed: Vec<Option<usize>>,
    /// The objects that are drawn, ascending: those of the scene.
    pub(super) drawn: Vec<usize>,
    /// The attributes that name other files.
    pub(super) files: Vec<NamedPlace>,
    /// Whether the scene is meant for path tracing.
    pub(super) is_srgb: bool,
    /// What multiplies the camera's vectors.
    pub(super) factors: [Option<f64>; 3],
}

/// Where a light, a material or an object stands.
#[derive(Clone, Debug)]
pub(super) struct Place<Kind> {
    /// Index of its element.
    pub(super) element: u32,
    pub(super) kind: Kind,
    /// What the text calls it.
    pub(super) name: Option<Box<str>>,
    /// How many objects it is in.
    pub(super) depth: u32,
}

/// An attribute that names a file.
#[derive(Clone, Debug)]
pub(super) struct NamedPlace {
    /// Whose it is.
    pub(super) element: usize,
    pub(super) attribute: usize,
    pub(super) what: What,
}

/// What a file is that an attribute names.
#[derive(Clone, Debug)]
pub(super) enum What {
    /// The picture of a texture.
    Texture,
    /// A mesh.
    Mesh,
    /// The picture that a material of that mesh names: by which statement, and its path.
    Map(&'static str, Box<str>),
}

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// Nothing that counts.
    Skipped,
    Root,
    Scene,
    Camera,
    /// By index.
    Light(u32),
    /// By index.
    Material(u32),
    /// By index.
    Object(u32),
    /// It says something of the element it is in.
    Parameter(&'static Parameter),
    /// It moves the element it is in.
    Transform(&'static Parameter),
}

/// The attributes that mean something.
pub(super) const WORDS: [&str; 15] = [
    "x",
    "y",
    "z",
    "value",
    "angle",
    "r",
    "g",
    "b",
    "index",
    "glossiness",
    "texture",
    "type",
    "name",
    "material",
    "gamma",
];

/// An attribute that means nothing.
pub(super) const NO_WORD: u8 = u8::MAX;

impl Origins {
    pub(super) fn nodes(&self) -> Nodes {
        Nodes {
            view: self.root.is_some(),
            surroundings: self.scene.is_some(),
            lights: self.lights.len(),
            materials: self.materials.len(),
            objects: self.objects.len(),
            ..Nodes::default()
        }
    }

    pub(super) fn name(&self, node: Node) -> String {
        match node {
            Node::View => "view".to_owned(),
            Node::Ambient => "ambient".to_owned(),
            Node::Background => "background".to_owned(),
            Node::Environment => "environment".to_owned(),
            Node::Light(index) => called("light", index, &self.lights, LightKind::word),
            Node::Material(index) => called("material", index, &self.materials, MaterialKind::word),
            Node::Texture(index) => format!("texture {}", index + 1),
            Node::Object(index) => called("object", index, &self.objects, ObjectKind::word),
        }
    }

    /// How many objects an object is in.
    pub(super) fn depth(&self, node: Node) -> usize {
        match node {
            Node::Object(index) => self.objects.get(index).map_or(0, |at| at.depth as usize),
            _ => 0,
        }
    }

    pub(super) fn is_group(&self, object: usize) -> bool {
        let place = self.objects.get(object);
        place.is_some_and(|place| place.kind == ObjectKind::Group)
    }

    pub(super) fn fields(&self, tree: &Tree, node: Node) -> Vec<Placed> {
        fields::of(self, tree, node)
    }

    pub(super) fn span(&self, tree: &Tree, node: Node) -> Span {
        let element = self
            .element(tree, node)
            .and_then(|at| tree.elements.get(at));
        element.map_or_else(|| Span::at(0), |element| element.whole)
    }

    pub(super) fn comment<'t>(&self, text: &'t str, tree: &Tree, node: Node) -> Option<&'t str> {
        let element = tree.elements.get(self.element(tree, node)?)?;
        let own = element.tag;
        let said = |comment: &Span| {
            let said = comment
                .of(text)
                .strip_prefix("<!--")?
                .strip_suffix("-->")?
                .trim();
            (!said.is_empty()).then_some(said)
        };
        let next = tree.comments.partition_point(|c| c.start() < own.start());
        let behind = tree.comments.get(next).filter(|comment| {
            own.end() <= comment.start()
                && text[own.end()..comment.start()]
                    .trim_matches([' ', '\t'])
                    .is_empty()
        });
        let before = next.checked_sub(1).and_then(|at| tree.comments.get(at));
        let before = before.filter(|comment| {
            comment.end() <= own.start()
                && is_one_line_end(text[comment.end()..own.start()].trim_matches([' ', '\t']))
        });
        behind.or(before).and_then(said)
    }

    pub(super) fn node_at(&self, tree: &Tree, span: Span) -> Option<Node> {
        let innermost = tree.element_at(span);
        // At the end of an element it is that still, unless another one begins there.
        let before = span.start().checked_sub(1).map(|at| Span::new(at, at + 1));
        innermost
            .and_then(|at| self.node_of(at))
            .or_else(|| self.node_of(tree.element_at(before?)?))
    }

    pub(super) fn nodes_in(&self, tree: &Tree, span: Span) -> Vec<Node> {
        let from = tree
            .elements
            .partition_point(|at| at.tag.end() <= span.start());
        let count = tree.elements[from..].partition_point(|at| at.tag.start() < span.end());
        let mut nodes: Vec<_> = (from..from + count)
            .filter_map(|at| self.node_of(at))
            .collect();
        nodes.dedup();
        nodes
    }

    pub(super) fn material_names(&self, text: &str, tree: &Tree) -> Vec<String> {
        let mut known = HashSet::new();
        let names = self.materials.iter().filter_map(|place| {
            let name = self.value(tree, place.element as usize, "name")?;
            Some(name.said(text))
        });
        let names = names.filter(|name| !name.is_empty() && known.insert(*name));
        names.map(str::to_owned).collect()
    }

    pub(super) fn files(&self, text: &str, tree: &Tree) -> Vec<NamedFile> {
        let file = |place: &NamedPlace| {
            let said = tree.attributes.get(place.attribute)?;
            let owner = self.name(self.node_of(place.element)?);
            let name = tree.elements.get(place.element)?.name.of(text);
            let (kind, what) = match &place.what {
                What::Mesh => (FileKind::Mesh, owner),
                What::Map(keyword, path) => {
                    let what = format!("{owner} {keyword} {}", visible(path));
                    (FileKind::Picture, what)
                }
                What::Texture if self.owners[place.element] as usize == place.element => {
                    (FileKind::Picture, format!("{name} texture"))
                }
                What::Texture => (FileKind::Picture, format!("{owner} {name} texture")),
            };
            let path = match &place.what {
                What::Map(_, path) => path,
                What::Texture | What::Mesh => said.said(text),
            };
            Some(NamedFile {
                path: path.to_owned(),
                kind,
                span: said.value,
                what,
            })
        };
        self.files.iter().filter_map(file).collect()
    }

    pub(super) fn users(&self, node: Node) -> usize {
        let Node::Material(material) = node else {
            return 0;
        };
        let drawn = self.drawn.iter();
        drawn
            .filter(|&&at| self.dressed[at] == Some(material))
            .count()
    }

    /// The attribute of an element that is one of [`WORDS`].
    pub(super) fn attribute(&self, tree: &Tree, element: usize, word: &str) -> Option<usize> {
        let word = WORDS.iter().position(|known| *known == word)? as u8;
        let mut own = tree.elements.get(element)?.attributes();
        own.find(|&at| self.words.get(at) == Some(&word))
    }

    /// The value of an attribute.
    pub(super) fn value<'t>(
        &self,
        tree: &'t Tree,
        element: usize,
        word: &str,
    ) -> Option<&'t Attribute> {
        tree.attributes.get(self.attribute(tree, element, word)?)
    }

    /// The element in another one that says a parameter.
    pub(super) fn parameter(
        &self,
        tree: &Tree,
        holder: usize,
        parameter: &'static Parameter,
    ) -> Option<usize> {
        let said = Role::Parameter(parameter);
        tree.children(holder)
            .find(|&at| self.roles.get(at) == Some(&said))
    }

    /// The element of a node.
    fn element(&self, tree: &Tree, node: Node) -> Option<usize> {
        use crate::language::xml::table::{BACKGROUND, ENVIRONMENT};
        match node {
            Node::View => self.camera,
            Node::Background => self.parameter(tree, self.scene?, &BACKGROUND),
            Node::Environment => self.parameter(tree, self.scene?, &ENVIRONMENT),
            Node::Light(index) => Some(self.lights.get(index)?.element as usize),
            Node::Material(index) => Some(self.materials.get(index)?.element as usize),
            Node::Object(index) => Some(self.objects.get(index)?.element as usize),
            Node::Ambient | Node::Texture(_) => None,
        }
    }

    /// The node that an element belongs to.
    pub(super) fn node_of(&self, element: usize) -> Option<Node> {
        let owner = *self.owners.get(element)?;
        Some(match self.roles.get(owner as usize)? {
            Role::Camera => Node::View,
            Role::Light(index) => Node::Light(*index as usize),
            Role::Material(index) => Node::Material(*index as usize),
            Role::Object(index) => Node::Object(*index as usize),
            Role::Parameter(parameter) if parameter.element == "background" => Node::Background,
            Role::Parameter(parameter) if parameter.element == "environment" => Node::Environment,
            _ => return None,
        })
    }
}

/// What a thing is called: by the text if it does, else by its number.
fn called<Kind: Copy>(
    what: &str,
    index: usize,
    places: &[Place<Kind>],
    word: impl Fn(Kind) -> &'static str,
) -> String {
    match places.get(index) {
        Some(Place {
            kind,
            name: Some(name),
            ..
        }) => format!("{name} ({})", word(*kind)),
        Some(place) => format!("{what} {} ({})", index + 1, word(place.kind)),
        None => format!("{what} {}", index + 1),
    }
}
