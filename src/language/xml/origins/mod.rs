//! The places of the nodes of an `.xml` text: each is an element, and its fields are attributes of
//! that and of elements in it.

pub(super) mod fields;
pub(super) mod insert;

use super::parameter::{Parameter, Type};
use super::schema::{BACKGROUND, ENVIRONMENT};
use super::tree::Tree;
use crate::node::Node;
use crate::rendering::RenderPlace;
use crate::schema::Category;
use scene::Transfer;

/// The places of everything lowered, as indices of elements and attributes: valid only with the
/// tree they were made from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    /// The role of each element.
    pub(super) roles: Vec<Role>,
    /// For each element, the element of the node it belongs to; 0 for none.
    pub(super) owners: Vec<u32>,
    pub(super) root: Option<usize>,
    pub(super) scene: Option<usize>,
    pub(super) camera: Option<usize>,
    pub(super) render: Option<usize>,
    /// What that element states.
    pub(super) settings: RenderPlace,
    /// The nodes of each category.
    places: [Vec<Place>; 4],
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
pub(super) struct Place {
    /// Index of its element.
    pub(super) element: u32,
    /// Number of objects it is in.
    pub(super) depth: u32,
    pub(super) kind: &'static Type,
    /// Its name in the text.
    pub(super) name: Option<Box<str>>,
    /// The index of its material.
    pub(super) material: Option<usize>,
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
    /// A node with an element of its own.
    Node(Node),
    /// A parameter of its parent.
    Parameter(&'static Parameter),
    /// A transform of its parent.
    Transform(&'static Parameter),
}

impl Origins {
    /// The places of the nodes of a category.
    pub(super) fn of(&self, category: Category) -> &[Place] {
        &self.places[category as usize]
    }

    /// The objects.
    pub(super) fn objects(&self) -> &[Place] {
        self.of(Category::Object)
    }

    /// Adds a node.
    pub(super) fn push(&mut self, category: Category, place: Place) -> Node {
        let places = &mut self.places[category as usize];
        places.push(place);
        Node::of(category, places.len() - 1)
    }

    /// Notes the material of an object.
    pub(super) fn set_material(&mut self, object: usize, material: Option<usize>) {
        self.places[Category::Object as usize][object].material = material;
    }

    /// Notes an attribute that names a file.
    pub(super) fn note_file(&mut self, element: usize, attribute: usize, what: What) {
        self.files.push(NamedPlace {
            element,
            attribute,
            what,
        });
    }

    /// The place of a node of a category.
    pub(super) fn get(&self, node: Node) -> Option<&Place> {
        let (category, index) = node.category()?;
        self.of(category).get(index)
    }

    /// The name of a node: with its kind if it has one, from the text if that names it.
    pub(super) fn name(&self, node: Node) -> String {
        match self.get(node) {
            Some(Place { kind, name, .. }) => match name {
                Some(name) => format!("{name} ({})", kind.word),
                None => format!("{node} ({})", kind.word),
            },
            None => node.to_string(),
        }
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
        match node {
            Node::View => self.camera,
            Node::Render => self.render,
            Node::Background => self.parameter(tree, self.scene?, &BACKGROUND),
            Node::Environment => self.parameter(tree, self.scene?, &ENVIRONMENT),
            _ => Some(self.get(node)?.element as usize),
        }
    }

    /// The node that an element belongs to.
    pub(super) fn node_of(&self, element: usize) -> Option<Node> {
        let owner = *self.owners.get(element)?;
        match self.roles.get(owner as usize)? {
            Role::Node(node) => Some(*node),
            Role::Parameter(parameter) if **parameter == BACKGROUND => Some(Node::Background),
            Role::Parameter(parameter) if **parameter == ENVIRONMENT => Some(Node::Environment),
            _ => None,
        }
    }

    /// The node whose element this is.
    pub(super) fn own_node(&self, element: usize) -> Option<Node> {
        let is_own = self
            .owners
            .get(element)
            .is_some_and(|&owner| owner as usize == element);
        self.node_of(element).filter(|_| is_own)
    }
}
