//! The University of Utah's `.xml`: elements with attributes, objects in one another.

mod lower;
mod origins;
mod room;
mod table;
#[cfg(test)]
mod tests;
mod tree;
mod view;

use std::borrow::Cow;
use std::sync::Arc;

use super::node::{object_at, place_of};
use super::table::Category;
use super::view::{literals, saying};
use super::written::Written;
use super::{Answers, Lowered, NamedFile, Node, Nodes, Placed};
use crate::memory::OutOfMemory;
use crate::scene::{Camera, Meshes};
use crate::text::{Edit, Findings, Span};
use origins::Origins;
use tree::Tree;

pub(super) use room::tree_bytes;
pub(super) use tree::spelled;

/// A `.xml` text.
pub(super) type Source = Written<Tree, Origins>;

/// Whether no leaf crosses the end of a line.
pub(super) const LEAVES_KEEP_TO_LINES: bool = false;

/// Parses a text.
pub(super) fn parse(text: Arc<String>) -> Source {
    let tree = tree::parse(&text);
    Source::new(text, tree)
}

/// The errors of every text that begins like this.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    let mut findings = Findings::default();
    if let Some(fault) = tree::fault_of_beginning(beginning) {
        findings.error(|| fault);
    }
    findings
}

impl Answers for Source {
    fn text(&self) -> &Arc<String> {
        &self.text
    }

    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        self.apply(edits, |tree, text, _| *tree = tree::parse(text))
    }

    fn restore(&mut self) {
        self.take_back();
    }

    fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory> {
        if let Err(refused) = room::fits(&self.tree) {
            self.place(Origins::default());
            return Err(refused);
        }
        let (origins, lowered) = lower::lower(&self.text, &self.tree, meshes);
        self.place(origins);
        Ok(lowered)
    }

    fn leaves(&self) -> Vec<Span> {
        self.tree.leaves()
    }

    fn said(&self, leaf: Span) -> &str {
        self.tree.said(&self.text, leaf)
    }

    fn spelled<'v>(&self, leaf: Span, value: &'v str) -> Cow<'v, str> {
        spelled(value, tree::quote(&self.text, leaf))
    }

    fn nodes(&self) -> Nodes {
        self.origins.nodes()
    }

    fn name(&self, node: Node) -> String {
        self.origins.name(node)
    }

    fn depth(&self, node: Node) -> usize {
        self.origins.depth(node)
    }

    fn fields(&self, node: Node) -> Vec<Placed> {
        self.origins.fields(&self.tree, node)
    }

    fn span(&self, node: Node) -> Span {
        self.origins.span(&self.tree, node)
    }

    fn comment(&self, node: Node) -> Option<&str> {
        self.origins.comment(&self.text, &self.tree, node)
    }

    fn node_at(&self, span: Span) -> Option<Node> {
        self.origins.node_at(&self.tree, span)
    }

    fn nodes_in(&self, span: Span) -> Vec<Node> {
        self.origins.nodes_in(&self.tree, span)
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        place_of(&self.origins.drawn, object)
    }

    fn is_group(&self, object: usize) -> bool {
        self.origins.is_group(object)
    }

    fn object(&self, drawn: u32) -> usize {
        object_at(&self.origins.drawn, drawn)
    }

    fn material(&self, object: usize) -> Option<usize> {
        *self.origins.dressed.get(object)?
    }

    fn names(&self, category: Category) -> Vec<String> {
        match category {
            Category::Material => self.origins.material_names(&self.text, &self.tree),
            Category::Light | Category::Texture | Category::Object => Vec::new(),
        }
    }

    fn files(&self) -> Vec<NamedFile> {
        self.origins.files(&self.text, &self.tree)
    }

    fn users(&self, node: Node) -> usize {
        self.origins.users(node)
    }

    fn view_literals(&self, camera: &Camera) -> Vec<Vec<String>> {
        literals(
            view::fields(&self.origins),
            view::numbers(camera, &self.origins),
        )
    }

    fn view_saying(
        &self,
        camera: &Camera,
        at: (usize, usize),
        said: &str,
    ) -> Result<Camera, String> {
        let numbers = view::numbers(camera, &self.origins);
        let numbers = saying(view::fields(&self.origins), numbers, at, said)?;
        Ok(view::camera(&numbers, camera))
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        let fields = self.fields(Node::View);
        view::edits(self, &fields, before, camera)
    }
}
