//! What deleting, copying and moving mean in an `.xml` text: an element goes with all that is in
//! it, and copies get names of their own.

use std::collections::HashSet;

use super::copies::Copies;
use super::table::ObjectKind;
use super::tree::{escaped, quote};
use super::{Source, add, clashing_ids, roles};
use crate::frame::frameless;
use crate::roles::Roles;
use crate::schema::Category;
use crate::structure::{Block, deletions, follows, line_before, lines, uncreatable};
use crate::view::{line_ending, line_from};
use crate::{
    Addition, Motion, Neighbour, NewNode, Node, Placement, Pose, SceneText, StructureEdits,
    StructureError, structure,
};
use text::{Edit, Span, counted, line_end};

impl StructureEdits for Source {
    fn consequence(&self, nodes: &[Node]) -> Option<String> {
        match self.users_outside(nodes).len() {
            0 => None,
            1 => Some("1 object uses it and will be plain white".to_owned()),
            users => Some(format!(
                "{} use it and will be plain white",
                counted(users, "object")
            )),
        }
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let blocks: Result<Vec<_>, _> = nodes.iter().map(|&node| self.block(node)).collect();
        let mut edits = deletions(&self.text, blocks?.into_iter());
        let users = self.users_outside(nodes);
        edits.extend(
            users
                .into_iter()
                .filter_map(|user| self.without_material(user)),
        );
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let mut copied: Vec<Span> = Vec::new();
        let mut spans = Vec::new();
        for &node in nodes {
            spans.push(self.block(node)?.span());
        }
        spans.sort_unstable();
        for span in spans {
            // An element in another goes with that.
            if copied.last().is_none_or(|last| last.end() < span.end()) {
                copied.push(span);
            }
        }
        let copies: Vec<_> = copied.iter().map(|span| span.of(&self.text)).collect();
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        let mut copies = Copies::of(text)?;
        copies.rename(&self.names());
        let scene = self.origins.scene.ok_or_else(|| StructureError::Foreign {
            reason: "there is no <scene> to hold it".to_owned(),
        })?;
        let edit = match self.anchor(&copies, after, scene) {
            Some(anchor) => self.after(anchor, &copies),
            None => self.inside_empty(scene, &copies),
        };
        Ok(Placement {
            edits: vec![edit],
            at: 0,
        })
    }

    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError> {
        let own = self.block(node)?;
        let sibling = self.sibling(node, neighbour).ok_or_else(|| {
            let place = match node {
                Node::Object(_) if self.depth(node) != 0 => " in its group",
                _ => "",
            };
            StructureError::at_end(self.name(node), neighbour, place)
        })?;
        let other = self.block(sibling)?;
        let spans = [self.span(node), self.span(sibling)];
        let (blocks, parts) = match neighbour {
            Neighbour::Next => ([own, other], spans),
            Neighbour::Previous => ([other, own], [spans[1], spans[0]]),
        };
        Ok(structure::exchange(&self.text, blocks, parts, neighbour))
    }

    fn roles(&self, leaves: &[Span], _: [bool; 2]) -> Roles {
        roles::roles(&self.text, &self.tree, leaves)
    }

    fn set_apart(&self, base: &str, theirs: &str) -> Vec<Edit> {
        clashing_ids::set_apart(&self.text, &self.tree, base, theirs)
    }

    fn called(&self, node: Node) -> Option<&str> {
        if !matches!(node, Node::Light(_) | Node::Material(_) | Node::Object(_))
            || self.names_file(node)
        {
            return None;
        }
        let element = self.origins.element(&self.tree, node)?;
        let name = self.origins.value(&self.tree, element, "name");
        Some(name.map_or("", |name| name.unescaped(&self.text)))
    }

    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        let Some(old) = self.called(node) else {
            return refused(if self.names_file(node) {
                "an obj's name is its file: edit the field instead".to_owned()
            } else {
                format!("{} has no name", self.name(node))
            });
        };
        if name.trim().is_empty() {
            return refused("a name must not be empty".to_owned());
        }
        if matches!(node, Node::Material(_)) && name != old {
            self.unused_material(name)?;
        }
        let (tree, origins) = (&self.tree, &self.origins);
        let element = origins.element(tree, node).unwrap_or_default();
        let mut edits = vec![match origins.value(tree, element, "name") {
            Some(value) => self.replaced(value.value, name),
            None => Edit {
                span: Span::at(tree.elements[element].attributes_end as usize),
                text: format!(" name=\"{}\"", escaped(name, '"')),
            },
        }];
        if let Node::Material(material) = node {
            let users = origins.object_materials.iter().enumerate();
            let users = users.filter(|(_, of)| **of == Some(material));
            let values = users.filter_map(|(user, _)| {
                let element = origins.element(tree, Node::Object(user))?;
                origins.value(tree, element, "material")
            });
            edits.extend(values.map(|value| self.replaced(value.value, name)));
        }
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn additions(&self) -> &'static [Addition] {
        add::ADDITIONS
    }

    fn addition(&self, name: &str, wish: &NewNode<'_>) -> Result<Placement, StructureError> {
        add::addition(self, name, wish)
    }

    fn creation(
        &self,
        category: Category,
        name: &str,
        _: Node,
    ) -> Result<Placement, StructureError> {
        if category != Category::Material {
            return Err(uncreatable(category));
        }
        self.unused_material(name)?;
        let text = add::material("blinn", name).join(line_ending(&self.text));
        self.insertion(&text, Node::View)
    }

    fn kinds(&self, node: Node) -> Vec<&'static str> {
        add::kinds(node)
    }

    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError> {
        add::retyping(self, node, kind)
    }

    fn pose(&self, node: Node) -> Option<Pose> {
        self.pose_of(node)
    }

    fn orthonormalised(&self, node: Node) -> Result<Vec<Edit>, StructureError> {
        Err(frameless(&self.name(node)))
    }

    fn motion(
        &self,
        nodes: &[Node],
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let elements: Vec<_> = nodes.iter().map(|&node| self.span(node)).collect();
        // What is in a group moves with it.
        let is_inner = |own: Span| {
            let holds = |outer: &Span| outer.start() < own.start() && own.end() <= outer.end();
            elements.iter().any(holds)
        };
        let outer = nodes.iter().filter(|&&node| !is_inner(self.span(node)));
        let moved = outer.map(|&node| self.moved(node, motion, decimals));
        let mut edits = moved.collect::<Result<Vec<_>, _>>()?.concat();
        Edit::sort(&mut edits);
        Ok(edits)
    }
}

impl Source {
    /// Fails if no material can have a name because it is empty or in use.
    fn unused_material(&self, name: &str) -> Result<(), StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        if name.trim().is_empty() {
            return refused("a name must not be empty".to_owned());
        }
        let materials = self.origins.materials.iter();
        let mut named = materials.filter_map(|place| place.name.as_deref());
        if named.any(|known| known == name) {
            return refused(format!("a material named {name} already exists"));
        }
        Ok(())
    }

    /// The element after which copies stand: that of `after` if they are of its kind, otherwise the
    /// scene's last child of their kind, or its last child. `None` in an empty scene.
    fn anchor(&self, copies: &Copies, after: Node, scene: usize) -> Option<usize> {
        let (tree, origins) = (&self.tree, &self.origins);
        let is_same = |element: &usize| {
            let kind = match origins.node_of(*element) {
                Some(Node::Light(_)) => "light",
                Some(Node::Material(_)) => "material",
                Some(Node::Object(_)) => "object",
                _ => return false,
            };
            let node = origins.node_of(*element);
            // Parameters belong to the node that they are in.
            let is_own = node.and_then(|node| origins.element(tree, node)) == Some(*element);
            is_own && copies.is_all(kind)
        };
        let own = origins.element(tree, after).filter(is_same);
        own.or_else(|| tree.children(scene).filter(is_same).last())
            .or_else(|| tree.children(scene).last())
    }

    /// The edit that writes copies after an element, with its indentation, and after a blank line if
    /// one precedes it.
    fn after(&self, element: usize, copies: &Copies) -> Edit {
        let (text, ending) = (&*self.text, line_ending(&self.text));
        let own = self.tree.elements[element].whole;
        let line = line_from(text, own.start());
        let indent = &text[line..own.start()];
        let indent = if indent.trim().is_empty() { indent } else { "" };
        let before = line_before(text, line);
        let gap = before.filter(|line| line.of(text).trim().is_empty());
        let gap = gap.map_or("", |_| ending);
        Edit {
            span: Span::at(self.with_comment_behind(own)),
            text: format!("{ending}{gap}{}", copies.indented(indent, ending)),
        }
    }

    /// The edit that writes copies into an element without children.
    fn inside_empty(&self, element: usize, copies: &Copies) -> Edit {
        let (text, ending) = (&*self.text, line_ending(&self.text));
        let element = &self.tree.elements[element];
        let own = element.lead.of(text).trim_start_matches(['\r', '\n']);
        let copies = copies.indented(&format!("{own}  "), ending);
        let content = format!("{ending}{copies}{ending}{own}");
        if element.is_empty_tag() {
            let name = element.name.of(text);
            return Edit {
                span: Span::new(element.attributes_end as usize, element.tag.end()),
                text: format!(">{content}</{name}>"),
            };
        }
        Edit {
            span: Span::at(element.tag.end()),
            text: content,
        }
    }

    fn replaced(&self, value: Span, name: &str) -> Edit {
        Edit {
            span: value,
            text: escaped(name, quote(&self.text, value)).into_owned(),
        }
    }

    /// The objects outside these nodes that name one of these materials.
    fn users_outside(&self, nodes: &[Node]) -> Vec<usize> {
        let nodes: HashSet<_> = nodes.iter().copied().collect();
        let named = self.origins.object_materials.iter().enumerate();
        let users = named.filter_map(|(object, material)| {
            let is_user = nodes.contains(&Node::Material((*material)?));
            is_user.then_some(object)
        });
        let elements: Vec<_> = nodes.iter().map(|&node| self.span(node)).collect();
        let is_in = |inner: Span| {
            let holds = |outer: &Span| outer.start() <= inner.start() && inner.end() <= outer.end();
            elements.iter().any(holds)
        };
        users
            .filter(|&user| !is_in(self.span(Node::Object(user))))
            .collect()
    }

    /// The edit that removes an object's reference to its material.
    fn without_material(&self, object: usize) -> Option<Edit> {
        let element = self.origins.element(&self.tree, Node::Object(object))?;
        let attribute = self.origins.value(&self.tree, element, "material")?;
        let before = self.text[..attribute.name.start()].trim_end().len();
        Some(Edit {
            span: Span::new(before, attribute.value.end() + 1),
            text: String::new(),
        })
    }

    /// The names of lights, materials and objects in use.
    fn names(&self) -> [HashSet<&str>; 3] {
        let origins = &self.origins;
        let lights = origins.lights.iter();
        let materials = origins.materials.iter();
        let objects = origins.objects.iter();
        [
            lights.filter_map(|at| at.name.as_deref()).collect(),
            materials.filter_map(|at| at.name.as_deref()).collect(),
            objects.filter_map(|at| at.name.as_deref()).collect(),
        ]
    }

    /// The neighbour of the same kind in the same element.
    fn sibling(&self, node: Node, neighbour: Neighbour) -> Option<Node> {
        let (tree, origins) = (&self.tree, &self.origins);
        let element = origins.element(tree, node)?;
        let parent = tree.elements.get(element)?.parent? as usize;
        let is_alike =
            |&other: &Node| std::mem::discriminant(&other) == std::mem::discriminant(&node);
        let mut before = None;
        let mut is_found = false;
        for child in tree.children(parent) {
            // Parameters of the node's own kind belong to other nodes.
            let Some(other) = origins.node_of(child).filter(is_alike) else {
                continue;
            };
            if origins.element(tree, other) != Some(child) {
                continue;
            }
            match neighbour {
                Neighbour::Previous if child == element => return before,
                Neighbour::Next if is_found => return Some(other),
                _ => {}
            }
            is_found |= child == element;
            before = Some(other);
        }
        None
    }

    /// Whether a node's name is that of a file.
    fn names_file(&self, node: Node) -> bool {
        let Node::Object(index) = node else {
            return false;
        };
        let object = self.origins.objects.get(index);
        object.is_some_and(|object| object.kind == ObjectKind::Obj)
    }

    /// The end of an element, with the comment behind it on its last line.
    fn with_comment_behind(&self, own: Span) -> usize {
        let (text, comments) = (&*self.text, &self.tree.comments);
        let next = comments.partition_point(|comment| comment.start() < own.end());
        let behind = comments.get(next).filter(|comment| {
            comment.start() <= line_end(text, own.end())
                && text[own.end()..comment.start()].trim().is_empty()
        });
        behind.map_or_else(|| own.end(), |comment| comment.end())
    }

    /// Whether a comment above an element is a heading of several: one of the same kind follows on
    /// the next line.
    fn has_heading(&self, node: Node, element: usize) -> bool {
        let (tree, origins) = (&self.tree, &self.origins);
        let own = &tree.elements[element];
        let after = own.end as usize;
        let Some(next) = tree.elements.get(after) else {
            return false;
        };
        let is_alike = |other: Node| {
            std::mem::discriminant(&other) == std::mem::discriminant(&node)
                && origins.element(tree, other) == Some(after)
        };
        let end = Span::at(self.with_comment_behind(own.whole));
        next.parent == own.parent
            && origins.node_of(after).is_some_and(is_alike)
            && follows(&self.text, end, next.whole)
    }

    /// The text that moves with a node.
    fn block(&self, node: Node) -> Result<Block, StructureError> {
        let (text, tree) = (&*self.text, &self.tree);
        let fixed = || StructureError::Fixed(self.name(node));
        if !matches!(node, Node::Light(_) | Node::Material(_) | Node::Object(_)) {
            return Err(fixed());
        }
        let element = self.origins.element(tree, node).ok_or_else(fixed)?;
        let own = tree.elements.get(element).ok_or_else(fixed)?.whole;
        let is_blank = |from: usize, to: usize| text[from..to].trim().is_empty();
        let end = self.with_comment_behind(own);
        let is_alone = is_blank(line_from(text, own.start()), own.start())
            && is_blank(end, line_end(text, end));
        if !is_alone {
            return Ok(Block::Part(own));
        }
        let has_heading = self.has_heading(node, element);
        let comment_above = |start| {
            let line = line_before(text, start).filter(|_| !has_heading)?;
            let next = tree
                .comments
                .partition_point(|comment| comment.end() <= line.end());
            let comment = tree.comments[..next].last()?;
            let first = line_from(text, comment.start());
            let ends_there = line.start() <= comment.end() && is_blank(comment.end(), line.end());
            (ends_there && is_blank(first, comment.start())).then_some(first)
        };
        let own = Span::new(own.start(), end);
        Ok(Block::Lines(lines(text, own, comment_above)))
    }
}
