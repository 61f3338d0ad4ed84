//! What an `.xml` text says: its [`SceneText`].

use std::borrow::Cow;
use std::collections::HashSet;

use super::origins::{NamedPlace, What, fields};
use super::schema::GROUP;
use super::tree::{Attribute, escaped, quote};
use super::{Source, lower, memory_estimate, view};
use crate::field_spans::{Implicit, Wanted, edits, insertions};
use crate::node::{FileKind, object_at, place_of};
use crate::rendering::Around;
use crate::schema::{Category, Field};
use crate::view::Numbers;
use crate::{FieldSpans, Lowered, NamedFile, Node, Nodes, SceneText, Visibility};
use memory::OutOfMemory;
use scene::{Camera, Meshes};
use text::{Edit, Span, is_one_line_end, visible};

impl SceneText for Source {
    fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory> {
        let fits = memory_estimate::fits(&self.tree);
        let found = fits.map(|()| lower::lower(&self.text, &self.tree, meshes));
        self.store(found)
    }

    fn leaves(&self) -> Vec<Span> {
        self.tree.leaves(&self.text)
    }

    fn leaf_text(&self, leaf: Span) -> &str {
        self.tree.unescaped(&self.text, leaf)
    }

    fn spelled<'v>(&self, leaf: Span, value: &'v str) -> Cow<'v, str> {
        escaped(value, quote(&self.text, leaf))
    }

    fn name(&self, node: Node) -> String {
        self.origins.name(node)
    }

    fn fields(&self, node: Node) -> Vec<FieldSpans> {
        fields::of(&self.text, &self.tree, &self.origins, node)
    }

    fn nodes(&self) -> Nodes {
        Nodes {
            view: self.origins.root.is_some(),
            surroundings: self.origins.scene.is_some(),
            lights: self.origins.of(Category::Light).len(),
            materials: self.origins.of(Category::Material).len(),
            objects: self.origins.objects().len(),
            ..Nodes::default()
        }
    }

    fn depth(&self, node: Node) -> usize {
        let place = self.origins.get(node);
        place.map_or(0, |place| place.depth as usize)
    }

    fn is_group(&self, object: usize) -> bool {
        let place = self.origins.objects().get(object);
        place.is_some_and(|place| *place.kind == GROUP)
    }

    fn group_of(&self, object: usize) -> Option<usize> {
        let element = self.element(Node::Object(object))?;
        let parent = self.tree.elements.get(element)?.parent?;
        match self.origins.node_of(parent as usize)? {
            Node::Object(group) => Some(group),
            _ => None,
        }
    }

    fn span(&self, node: Node) -> Span {
        let element = self.element(node);
        let element = element.and_then(|at| self.tree.elements.get(at));
        element.map_or_else(|| Span::at(0), |element| element.whole)
    }

    fn comment(&self, node: Node) -> Option<&str> {
        let (text, tree) = (&*self.text, &self.tree);
        let element = tree.elements.get(self.element(node)?)?;
        let own = element.tag;
        let content = |comment: &Span| {
            let content = comment
                .of(text)
                .strip_prefix("<!--")?
                .strip_suffix("-->")?
                .trim();
            (!content.is_empty()).then_some(content)
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
        behind.or(before).and_then(content)
    }

    fn node_at(&self, span: Span) -> Option<Node> {
        let tree = &self.tree;
        let innermost = tree.element_at(span);
        // The end of an element belongs to it, unless another one begins there.
        let before = span.start().checked_sub(1).map(|at| Span::new(at, at + 1));
        innermost
            .and_then(|at| self.origins.node_of(at))
            .or_else(|| self.origins.node_of(tree.element_at(before?)?))
    }

    fn nodes_in(&self, span: Span) -> Vec<Node> {
        let tree = &self.tree;
        let from = tree
            .elements
            .partition_point(|at| at.tag.end() <= span.start());
        let count = tree.elements[from..].partition_point(|at| at.tag.start() < span.end());
        let mut nodes: Vec<_> = (from..from + count)
            .filter_map(|at| self.origins.node_of(at))
            .collect();
        nodes.dedup();
        nodes
    }

    fn references(&self, _: Node, category: Category) -> Vec<(String, Node)> {
        if category != Category::Material {
            return Vec::new();
        }
        let mut known = HashSet::new();
        let materials = self.origins.of(category).iter().enumerate();
        let names = materials.filter_map(|(index, place)| {
            let name = self.value(place.element as usize, "name")?;
            Some((name.unescaped(&self.text), Node::Material(index)))
        });
        let names = names.filter(|(name, _)| !name.is_empty() && known.insert(*name));
        names.map(|(name, node)| (name.to_owned(), node)).collect()
    }

    fn files(&self) -> Vec<NamedFile> {
        let (text, tree) = (&*self.text, &self.tree);
        let file = |place: &NamedPlace| {
            let attribute = tree.attributes.get(place.attribute)?;
            let owner = self.origins.name(self.origins.node_of(place.element)?);
            let name = tree.elements.get(place.element)?.name.of(text);
            let is_own = self.origins.owners[place.element] as usize == place.element;
            let what = match &place.what {
                What::Mesh => owner,
                What::Map(keyword, path) => format!("{owner} {keyword} {}", visible(path)),
                What::Texture if is_own => format!("{name} texture"),
                What::Texture => format!("{owner} {name} texture"),
            };
            let kind = match place.what {
                What::Mesh => FileKind::Mesh,
                What::Map(..) | What::Texture => FileKind::Picture,
            };
            let path = match &place.what {
                What::Map(_, path) => path,
                What::Texture | What::Mesh => attribute.unescaped(text),
            };
            Some(NamedFile {
                path: path.to_owned(),
                kind,
                span: attribute.value,
                what,
            })
        };
        self.origins.files.iter().filter_map(file).collect()
    }

    fn users(&self, node: Node) -> usize {
        let Node::Material(material) = node else {
            return 0;
        };
        let drawn = self.origins.drawn.iter();
        let uses = |at: &&usize| self.material(**at) == Some(material);
        drawn.filter(uses).count()
    }

    fn edits(&self, wanted: &[Wanted<'_>]) -> Vec<Edit> {
        let mut edits = edits(self, wanted);
        edits.extend(insertions(&self.text, wanted, markup));
        Edit::sort(&mut edits);
        edits
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        place_of(&self.origins.drawn, object)
    }

    fn object(&self, drawn: u32) -> usize {
        object_at(&self.origins.drawn, drawn)
    }

    fn material(&self, object: usize) -> Option<usize> {
        self.origins.objects().get(object)?.material
    }

    fn render_removal(&self, key: &str) -> Vec<Edit> {
        let render = self.origins.render;
        let element = render.and_then(|at| self.tree.elements.get(at));
        let removed = element.and_then(|element| {
            let around = Around::Lead(if element.lead.is_empty() {
                Span::at(element.whole.start())
            } else {
                element.lead
            });
            self.origins.settings.removal(&self.text, key, around)
        });
        removed.into_iter().collect()
    }

    fn view_fields(&self) -> Vec<&'static Field> {
        view::fields(&self.origins).collect()
    }

    fn view_numbers(&self, camera: &Camera) -> Numbers {
        view::numbers(camera, &self.origins)
    }

    fn view_camera(&self, numbers: &Numbers, _: &Camera) -> Camera {
        view::camera(numbers, &self.origins)
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        view::edits(self, before, camera)
    }

    fn is_comment(&self, leaf: Span) -> bool {
        leaf.of(&self.text).starts_with("<!--")
    }

    fn comment_marks(&self) -> [&'static str; 2] {
        ["<!--", "-->"]
    }

    fn visibility_edits(&self, _: &[usize], _: Visibility) -> Result<Vec<Edit>, &'static str> {
        Err(".xml cannot hide objects")
    }
}

impl Source {
    /// The element of a node.
    pub(super) fn element(&self, node: Node) -> Option<usize> {
        self.origins.element(&self.tree, node)
    }

    /// The attribute of an element with this name.
    pub(super) fn value(&self, element: usize, word: &str) -> Option<&Attribute> {
        self.tree.attribute(&self.text, element, word)
    }
}

/// The attributes with these values, in their element if that is missing too.
fn markup(implicit: &Implicit, values: &[(usize, String)]) -> String {
    let mut markup = String::new();
    markup.extend(implicit.element.into_iter().flat_map(|name| ["<", name]));
    for (component, own) in implicit.components.iter().enumerate() {
        let value = values.iter().find(|(of, _)| *of == component);
        let value = match value {
            Some((_, value)) => &**value,
            None if own.is_required => &*own.default,
            None => continue,
        };
        let value = escaped(value, '"');
        markup.extend([" ", own.name, "=\"", &value, "\""]);
    }
    markup.extend(implicit.element.map(|_| "/>"));
    markup
}
