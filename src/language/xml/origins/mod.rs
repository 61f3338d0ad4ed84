//! The places of the nodes of an `.xml` text: each is an element, and its fields are attributes of
//! that and of elements in it.

pub(super) mod fields;
mod insert;

use super::table::{LightKind, MaterialKind, ObjectKind, Parameter};
use super::tree::{Attribute, Tree};
use crate::node::Node;
use crate::rendering::RenderPlace;
use scene::Transfer;

/// The places of everything lowered, as indices of elements and attributes: valid only with the
/// tree they were made from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    /// The role of each element.
    pub(super) roles: Vec<Role>,
    /// For each element, the element of the node it belongs to; 0 for none.
    pub(super) owners: Vec<u32>,
    /// For each attribute, its index in [`WORDS`] or [`NO_WORD`].
    pub(super) words: Vec<u8>,
    pub(super) root: Option<usize>,
    pub(super) scene: Option<usize>,
    pub(super) camera: Option<usize>,
    pub(super) render: Option<usize>,
    /// What that element states.
    pub(super) settings: RenderPlace,
    pub(super) lights: Vec<Place<LightKind>>,
    pub(super) materials: Vec<Place<MaterialKind>>,
    pub(super) objects: Vec<Place<ObjectKind>>,
    /// The material of each object, by index.
    pub(super) object_materials: Vec<Option<usize>>,
    /// The drawn objects, ascending: those of the scene.
    pub(super) drawn: Vec<usize>,
    /// The attributes that name files.
    pub(super) files: Vec<NamedPlace>,
    /// The transfer function, on which the defaults of some fields depend.
    pub(super) transfer: Transfer,
    /// The factors of the camera's vectors.
    pub(super) factors: [Option<f64>; 3],
}

/// The place of a light, a material or an object.
#[derive(Clone, Debug)]
pub(super) struct Place<Kind> {
    /// Index of its element.
    pub(super) element: u32,
    pub(super) kind: Kind,
    /// Its name in the text.
    pub(super) name: Option<Box<str>>,
    /// Number of objects it is in.
    pub(super) depth: u32,
}

/// The place of an attribute that names a file.
#[derive(Clone, Debug)]
pub(super) struct NamedPlace {
    /// Index of its element.
    pub(super) element: usize,
    pub(super) attribute: usize,
    pub(super) what: What,
}

/// The use of a named file.
#[derive(Clone, Debug)]
pub(super) enum What {
    /// The picture of a texture.
    Texture,
    /// A mesh.
    Mesh,
    /// A picture named by a material of that mesh: the statement, and the path.
    Map(&'static str, Box<str>),
}

/// The role of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// An ignored element.
    Skipped,
    Root,
    Scene,
    Camera,
    Render,
    /// Index of the light.
    Light(u32),
    /// Index of the material.
    Material(u32),
    /// Index of the object.
    Object(u32),
    /// A parameter of its parent.
    Parameter(&'static Parameter),
    /// A transform of its parent.
    Transform(&'static Parameter),
}

/// The known attributes.
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

/// Marks an unknown attribute.
pub(super) const NO_WORD: u8 = u8::MAX;

impl Origins {
    pub(super) fn name(&self, node: Node) -> String {
        let name = match node {
            Node::Light(index) => node_name(node, self.lights.get(index), LightKind::word),
            Node::Material(index) => node_name(node, self.materials.get(index), MaterialKind::word),
            Node::Object(index) => node_name(node, self.objects.get(index), ObjectKind::word),
            _ => None,
        };
        name.unwrap_or_else(|| node.to_string())
    }

    /// The attribute of an element with this name, one of [`WORDS`].
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

    /// The child of an element that sets a parameter.
    pub(super) fn parameter(
        &self,
        tree: &Tree,
        holder: usize,
        parameter: &'static Parameter,
    ) -> Option<usize> {
        let role = Role::Parameter(parameter);
        tree.children(holder)
            .find(|&at| self.roles.get(at) == Some(&role))
    }

    /// The element of a node.
    pub(super) fn element(&self, tree: &Tree, node: Node) -> Option<usize> {
        use crate::xml::table::{BACKGROUND, ENVIRONMENT};
        match node {
            Node::View => self.camera,
            Node::Render => self.render,
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
            Role::Render => Node::Render,
            Role::Light(index) => Node::Light(*index as usize),
            Role::Material(index) => Node::Material(*index as usize),
            Role::Object(index) => Node::Object(*index as usize),
            Role::Parameter(parameter) if parameter.element == "background" => Node::Background,
            Role::Parameter(parameter) if parameter.element == "environment" => Node::Environment,
            _ => return None,
        })
    }
}

/// The name of a node with a kind: from the text if it has one, otherwise by its number.
fn node_name<Kind: Copy>(
    node: Node,
    place: Option<&Place<Kind>>,
    word: impl Fn(Kind) -> &'static str,
) -> Option<String> {
    let place = place?;
    let kind = word(place.kind);
    Some(match &place.name {
        Some(name) => format!("{name} ({kind})"),
        None => format!("{node} ({kind})"),
    })
}
