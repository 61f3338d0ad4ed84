//! What deleting, copying and moving mean in an `.xml` text: an element goes with all that is in
//! it, and copies get names of their own.

use std::collections::HashSet;

use super::copies::{Copies, set_apart};
use super::origins::Place;
use super::schema::{OBJ, class_of};
use super::tree::{escaped, respelled};
use super::{Source, add, roles};
use crate::frame::frameless;
use crate::roles::Roles;
use crate::schema::Category;
use crate::structure::{
    Block, deletions, follows, line_before, lines, lines_after, pair, uncreatable,
};
use crate::view::{line_ending, line_from};
use crate::{
    Addition, Motion, Neighbour, NewNode, Node, Placement, Pose, SceneText, StructureEdits,
    StructureError, structure,
};
use text::{Edit, Span, counted, line_end};

impl StructureEdits for Source {
    fn consequence(&self, nodes: &[Node]) -> Option<String> {
        let said = match self.users_outside(nodes).len() {
            0 => return None,
            1 => "1 object uses it".to_owned(),
            users => format!("{} use it", counted(users, "object")),
        };
        Some(said + " and will be plain white")
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let blocks: Result<Vec<_>, _> = nodes.iter().map(|&node| self.block(node)).collect();
        let mut edits = deletions(&self.text, blocks?.into_iter());
        let users = self.users_outside(nodes).into_iter();
        edits.extend(users.filter_map(|user| self.without_material(user)));
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let spans = nodes.iter().map(|&node| Ok(self.block(node)?.span()));
        let mut spans = spans.collect::<Result<Vec<_>, _>>()?;
        spans.sort_unstable();
        // An element in another goes with that.
        spans.dedup_by(|own, last| own.end() <= last.end());
        let copies: Vec<_> = spans.iter().map(|span| span.of(&self.text)).collect();
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        let mut copies = Copies::of(text)?;
        copies.rename(|category| {
            let places = self.origins.of(category).iter();
            let names = places.filter_map(|place| place.name.as_deref());
            names.map(str::to_owned).collect()
        });
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
        set_apart(&self.text, &self.tree, [base, theirs])
    }

    fn called(&self, node: Node) -> Option<&str> {
        let place = self.origins.get(node).filter(|place| *place.kind != OBJ)?;
        let name = self.value(place.element as usize, "name");
        Some(name.map_or("", |name| name.unescaped(&self.text)))
    }

    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        let Some(old) = self.called(node) else {
            return refused(match self.origins.get(node) {
                Some(_) => "an obj's name is its file: edit the field instead".to_owned(),
                None => format!("{} has no name", self.name(node)),
            });
        };
        match node {
            Node::Material(_) if name != old => self.unused_material(name)?,
            _ => not_empty(name)?,
        }
        let element = self.element(node).unwrap_or_default();
        let mut edits = vec![match self.value(element, "name") {
            Some(value) => respelled(&self.text, value.value, name),
            None => Edit {
                span: Span::at(self.tree.elements[element].attributes_end as usize),
                text: format!(" name=\"{}\"", escaped(name, '"')),
            },
        }];
        if let Node::Material(material) = node {
            let users = self.origins.objects().iter();
            let users = users.filter(|place| place.material == Some(material));
            let values = users.filter_map(|place| self.value(place.element as usize, "material"));
            edits.extend(values.map(|value| respelled(&self.text, value.value, name)));
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
        let text = add::material("blinn", name).replace('\n', line_ending(&self.text));
        self.insertion(&text, Node::View)
    }

    fn kinds(&self, node: Node) -> Vec<&'static str> {
        let class = node.category().and_then(|(category, _)| class_of(category));
        let kinds = class.map_or(&[][..], |class| class.kinds).iter();
        // A mesh is named by its file, which nothing else has.
        let kinds = kinds.filter(|kind| ***kind != OBJ);
        kinds.map(|kind| kind.word).collect()
    }

    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError> {
        let fields = self.fields(node);
        let field = fields.iter().find(|placed| placed.field.key == "type");
        let fixed = || StructureError::Inexpressible(format!("{} has no type", self.name(node)));
        let field = field.ok_or_else(fixed)?;
        Ok(field.edits(self, &[(0, kind.to_owned())]))
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
        not_empty(name)?;
        let materials = self.origins.of(Category::Material).iter();
        let mut named = materials.filter_map(|place| place.name.as_deref());
        if named.any(|known| known == name) {
            let reason = format!("a material named {name} already exists");
            return Err(StructureError::Name(reason));
        }
        Ok(())
    }

    /// The element after which copies stand: that of `after` if they are of its kind, otherwise the
    /// scene's last child of their kind, or its last child. `None` in an empty scene.
    fn anchor(&self, copies: &Copies, after: Node, scene: usize) -> Option<usize> {
        let is_same = |element: &usize| {
            // Parameters belong to the node that they are in.
            let node = self.origins.own_node(*element);
            let category = node.and_then(Node::category);
            category.is_some_and(|(category, _)| copies.are_all(category))
        };
        let own = self.element(after).filter(is_same);
        own.or_else(|| self.tree.children(scene).filter(is_same).last())
            .or_else(|| self.tree.children(scene).last())
    }

    /// The edit that writes copies after an element, with its indentation, and after a blank line if
    /// one precedes it.
    fn after(&self, element: usize, copies: &Copies) -> Edit {
        let (text, ending) = (&*self.text, line_ending(&self.text));
        let own = self.tree.elements[element].whole;
        let line = line_from(text, own.start());
        let indent = &text[line..own.start()];
        let indent = if indent.trim().is_empty() { indent } else { "" };
        let block = Span::new(line, self.with_comment_behind(own));
        lines_after(text, block, &copies.indented(indent, ending))
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

    /// The objects outside these nodes that name one of these materials.
    fn users_outside(&self, nodes: &[Node]) -> Vec<&Place> {
        let materials: HashSet<_> = nodes.iter().copied().collect();
        let elements: Vec<_> = nodes.iter().map(|&node| self.span(node)).collect();
        let is_inside = |place: &Place| {
            let own = self.tree.elements.get(place.element as usize);
            let inner = own.map_or_else(|| Span::at(0), |own| own.whole);
            let holds = |outer: &Span| outer.start() <= inner.start() && inner.end() <= outer.end();
            elements.iter().any(holds)
        };
        let users = self.origins.objects().iter().filter(|place| {
            let material = place.material.map(Node::Material);
            material.is_some_and(|material| materials.contains(&material)) && !is_inside(place)
        });
        users.collect()
    }

    /// The edit that removes an object's reference to its material.
    fn without_material(&self, object: &Place) -> Option<Edit> {
        let attribute = self.value(object.element as usize, "material")?;
        let before = self.text[..attribute.name.start()].trim_end().len();
        Some(Edit {
            span: Span::new(before, attribute.value.end() + 1),
            text: String::new(),
        })
    }

    /// The neighbour of the same kind in the same element.
    fn sibling(&self, node: Node, neighbour: Neighbour) -> Option<Node> {
        let element = self.tree.elements.get(self.element(node)?)?;
        let children = self.tree.children(element.parent? as usize);
        let alike = children.filter_map(|child| self.origins.own_node(child));
        let alike: Vec<_> = alike.filter(|&other| is_alike(other, node)).collect();
        let own = alike.iter().position(|&other| other == node)?;
        let pair = pair(own, alike.len(), neighbour)?.map(|at| alike[at]);
        pair.into_iter().find(|&other| other != node)
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
        let own = &self.tree.elements[element];
        let after = own.end as usize;
        let Some(next) = self.tree.elements.get(after) else {
            return false;
        };
        let other = self.origins.own_node(after);
        let is_next = other.is_some_and(|other| is_alike(other, node));
        let end = Span::at(self.with_comment_behind(own.whole));
        next.parent == own.parent && is_next && follows(&self.text, end, next.whole)
    }

    /// The text that moves with a node.
    fn block(&self, node: Node) -> Result<Block, StructureError> {
        let (text, tree) = (&*self.text, &self.tree);
        let fixed = || StructureError::Fixed(self.name(node));
        let place = self.origins.get(node).ok_or_else(fixed)?;
        let element = place.element as usize;
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

/// Whether two nodes are of the same kind.
fn is_alike(one: Node, other: Node) -> bool {
    std::mem::discriminant(&one) == std::mem::discriminant(&other)
}

/// Fails for a name without visible characters.
fn not_empty(name: &str) -> Result<(), StructureError> {
    if name.trim().is_empty() {
        return Err(StructureError::Name("a name must not be empty".to_owned()));
    }
    Ok(())
}
