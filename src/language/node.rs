//! The nodes of a scene's text: those with fields, their list, and the files they name.

use std::fmt;

use super::partition::partition_point;
use super::schema::Category;
use text::Span;

/// A node with fields, in the order of the list in the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    /// The render settings.
    Render,
    /// The camera.
    View,
    /// Ambient light.
    Ambient,
    /// The background seen by camera rays.
    Background,
    /// The background seen by all other rays.
    Environment,
    /// A light, by index.
    Light(usize),
    /// A material, by index.
    Material(usize),
    /// A texture, by index.
    Texture(usize),
    /// An object, by index.
    Object(usize),
}

impl Node {
    /// The node of a category with this index.
    pub(super) const fn of(category: Category, index: usize) -> Self {
        match category {
            Category::Light => Self::Light(index),
            Category::Material => Self::Material(index),
            Category::Texture => Self::Texture(index),
            Category::Object => Self::Object(index),
        }
    }

    /// Its category and index; `None` for what a scene has once.
    pub(super) const fn category(self) -> Option<(Category, usize)> {
        match self {
            Self::Light(index) => Some((Category::Light, index)),
            Self::Material(index) => Some((Category::Material, index)),
            Self::Texture(index) => Some((Category::Texture, index)),
            Self::Object(index) => Some((Category::Object, index)),
            Self::Render | Self::View | Self::Ambient | Self::Background | Self::Environment => {
                None
            }
        }
    }
}

/// The noun for the kind of node, with its number from 1: `light 2`.
impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Render => f.write_str("render"),
            Self::View => f.write_str("view"),
            Self::Ambient => f.write_str("ambient"),
            Self::Background => f.write_str("background"),
            Self::Environment => f.write_str("environment"),
            Self::Light(index) => write!(f, "light {}", index + 1),
            Self::Material(index) => write!(f, "material {}", index + 1),
            Self::Texture(index) => write!(f, "texture {}", index + 1),
            Self::Object(index) => write!(f, "object {}", index + 1),
        }
    }
}

/// The nodes of a scene, ascending. Only the count of each kind is stored, so that a list of
/// millions takes no more memory than a short one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nodes {
    /// Whether there are render settings and a view.
    pub(super) view: bool,
    /// Whether there is ambient light.
    pub(super) ambient: bool,
    /// Whether there are a background and an environment.
    pub(super) surroundings: bool,
    /// The number of lights.
    pub(super) lights: usize,
    /// The number of materials.
    pub(super) materials: usize,
    /// The number of textures.
    pub(super) textures: usize,
    /// The number of objects.
    pub(super) objects: usize,
}

/// Makes the node with an index; kinds with at most one node ignore it.
pub(super) type IndexedNode = fn(usize) -> Node;

impl Nodes {
    /// The number of nodes.
    pub fn len(self) -> usize {
        self.kinds().iter().map(|&(_, count)| count).sum()
    }

    /// Whether there are no nodes.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The node in a row of the list.
    pub fn get(self, row: usize) -> Option<Node> {
        let mut index = row;
        for (kind, count) in self.kinds() {
            if index < count {
                return Some(kind(index));
            }
            index -= count;
        }
        None
    }

    /// The number of listed nodes before a node, which need not be in the list.
    pub fn before(self, node: Node) -> usize {
        self.partition_point(|listed| listed < node)
    }

    /// The number of nodes that meet a condition, which must hold for exactly a prefix.
    pub fn partition_point(self, fulfils: impl Fn(Node) -> bool) -> usize {
        partition_point(self.len(), |at| self.get(at).is_some_and(&fulfils))
    }

    /// All nodes.
    pub fn iter(self) -> impl Iterator<Item = Node> {
        (0..self.len()).filter_map(move |row| self.get(row))
    }

    /// The number of objects.
    pub fn objects(self) -> usize {
        self.objects
    }

    fn kinds(self) -> [(IndexedNode, usize); 9] {
        [
            (|_| Node::Render, usize::from(self.view)),
            (|_| Node::View, usize::from(self.view)),
            (|_| Node::Ambient, usize::from(self.ambient)),
            (|_| Node::Background, usize::from(self.surroundings)),
            (|_| Node::Environment, usize::from(self.surroundings)),
            (Node::Light, self.lights),
            (Node::Material, self.materials),
            (Node::Texture, self.textures),
            (Node::Object, self.objects),
        ]
    }
}

/// The kind of a file named by a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// The picture of a texture.
    Picture,
    /// The mesh of an object.
    Mesh,
}

/// A file named by a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    /// The path, relative to the scene's folder, as written in the text or in a mesh.
    pub path: String,
    /// The kind of file.
    pub kind: FileKind,
    /// The place in the text that names the file, or the mesh that does.
    pub span: Span,
    /// A description: `texture 2 file`.
    pub what: String,
}

/// Maps an object of the text to one of the scene, given the drawn objects in ascending order.
pub(super) fn place_of(drawn: &[usize], object: usize) -> Option<u32> {
    u32::try_from(drawn.binary_search(&object).ok()?).ok()
}

/// Maps an object of the scene to one of the text, given the drawn objects in ascending order.
pub(super) fn object_at(drawn: &[usize], place: u32) -> usize {
    drawn.get(place as usize).copied().unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_the_order_of_nodes() {
        let nodes = Nodes {
            view: true,
            ambient: false,
            surroundings: true,
            lights: 2,
            materials: 0,
            textures: 1,
            objects: 3,
        };
        let listed = [
            Node::Render,
            Node::View,
            Node::Background,
            Node::Environment,
            Node::Light(0),
            Node::Light(1),
            Node::Texture(0),
            Node::Object(0),
            Node::Object(1),
            Node::Object(2),
        ];
        assert!(nodes.iter().eq(listed));
        assert_eq!(nodes.len(), listed.len());
        assert_eq!(nodes.get(listed.len()), None);
        let others = [
            Node::Ambient,
            Node::Light(2),
            Node::Material(0),
            Node::Material(7),
            Node::Texture(1),
            Node::Object(9),
        ];
        for node in listed.into_iter().chain(others) {
            let before = listed.partition_point(|&listed| listed < node);
            assert_eq!(nodes.before(node), before, "{node:?}");
        }
        assert!(Nodes::default().is_empty());
    }
}
