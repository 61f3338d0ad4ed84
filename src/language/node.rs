//! The things of a scene's text: those that have fields, the list of them, and the files they name.

use crate::text::Span;

/// A thing that has fields, in the order in which the interface lists them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    /// The camera.
    View,
    /// Ambient light.
    Ambient,
    /// What the camera sees behind everything.
    Background,
    /// What other rays meet there.
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

/// The nodes of a scene, ascending. Of each kind the first so many are there, so that a list of
/// millions is no longer than one of a few.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nodes {
    /// Whether there is a view.
    pub(super) view: bool,
    /// Whether there is ambient light.
    pub(super) ambient: bool,
    /// Whether there are background and environment.
    pub(super) surroundings: bool,
    /// How many lights there are.
    pub(super) lights: usize,
    /// How many materials.
    pub(super) materials: usize,
    /// How many textures.
    pub(super) textures: usize,
    /// How many objects.
    pub(super) objects: usize,
}

/// The node of a kind that has an index; kinds of which there is one at most take any.
type Kind = fn(usize) -> Node;

impl Nodes {
    /// How many there are.
    pub fn len(self) -> usize {
        self.kinds().iter().map(|&(_, count)| count).sum()
    }

    /// Whether there are none.
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

    /// How many of the list come before a node, which need not be in it.
    pub fn before(self, node: Node) -> usize {
        self.partition_point(|listed| listed < node)
    }

    /// How many fulfil a condition that the first so many fulfil and no others.
    pub fn partition_point(self, fulfils: impl Fn(Node) -> bool) -> usize {
        let (mut from, mut until) = (0, self.len());
        while from < until {
            let middle = from.midpoint(until);
            if self.get(middle).is_some_and(&fulfils) {
                from = middle + 1;
            } else {
                until = middle;
            }
        }
        from
    }

    /// All of them.
    pub fn iter(self) -> impl Iterator<Item = Node> {
        (0..self.len()).filter_map(move |row| self.get(row))
    }

    fn kinds(self) -> [(Kind, usize); 8] {
        [
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

/// The object of the scene that an object of the text is, given those that are drawn, ascending.
pub(super) fn place_of(drawn: &[usize], object: usize) -> Option<u32> {
    u32::try_from(drawn.binary_search(&object).ok()?).ok()
}

/// The object of the text that an object of the scene is, given those that are drawn, ascending.
pub(super) fn object_at(drawn: &[usize], place: u32) -> usize {
    drawn.get(place as usize).copied().unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_is_in_the_row_that_follows_those_before_it() {
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
