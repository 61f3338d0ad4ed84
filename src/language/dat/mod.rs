//! Boston University's `.dat`: one record a line, things known by numbers.

mod lower;
mod origins;
mod room;
mod table;
#[cfg(test)]
mod tests;
mod tree;
mod view;
mod visibility;

use std::sync::Arc;

use super::node::{object_at, place_of};
use super::table::Category;
use super::view::{literals, saying};
use super::written::Written;
use super::{Answers, Lowered, NamedFile, Node, Nodes, Placed, Visibility};
use crate::memory::OutOfMemory;
use crate::scene::{Camera, Meshes};
use crate::text::{Edit, Findings, Span};
use origins::Origins;
use tree::Tree;

pub(super) use room::tree_bytes;

/// A `.dat` text.
pub(super) type Source = Written<Tree, Origins>;

/// Whether no leaf crosses the end of a line.
pub(super) const LEAVES_KEEP_TO_LINES: bool = true;

/// Parses a text.
pub(super) fn parse(text: Arc<String>) -> Source {
    let tree = tree::parse(&text);
    Source::new(text, tree)
}

/// The errors of every text that begins like this.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    lower::errors_of_beginning(beginning, &tree::parse(beginning))
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

    fn lower(&mut self, _: &Meshes) -> Result<Lowered, OutOfMemory> {
        if let Err(refused) = room::fits(&self.tree) {
            self.place(Origins::default());
            return Err(refused);
        }
        let (origins, lowered) = lower::lower(&self.text, &self.tree);
        self.place(origins);
        Ok(lowered)
    }

    fn leaves(&self) -> Vec<Span> {
        self.tree.leaves()
    }

    fn nodes(&self) -> Nodes {
        self.origins.nodes()
    }

    fn name(&self, node: Node) -> String {
        self.origins.name(node)
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

    fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        self.origins.parts(object, limit)
    }

    fn operation(&self, object: usize) -> Option<&str> {
        let word = self.origins.operation(&self.tree, object)?;
        Some(word.of(&self.text))
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        place_of(&self.origins.drawn, object)
    }

    fn object(&self, drawn: u32) -> usize {
        object_at(&self.origins.drawn, drawn)
    }

    fn material(&self, object: usize) -> Option<usize> {
        self.origins.objects.get(object)?.material
    }

    fn identities(&self, node: Node, category: Category) -> Vec<i64> {
        self.origins.identities(node, category)
    }

    fn files(&self) -> Vec<NamedFile> {
        self.origins.files(&self.text, &self.tree)
    }

    fn users(&self, node: Node) -> usize {
        self.origins.users(node)
    }

    fn view_literals(&self, camera: &Camera) -> Vec<Vec<String>> {
        literals(view::fields(), view::numbers(camera, &self.origins))
    }

    fn view_saying(
        &self,
        camera: &Camera,
        at: (usize, usize),
        said: &str,
    ) -> Result<Camera, String> {
        let numbers = view::numbers(camera, &self.origins);
        let numbers = saying(view::fields(), numbers, at, said)?;
        Ok(view::camera(&numbers, camera, &self.origins))
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        view::edits(&self.text, &self.tree, &self.origins, before, camera)
    }

    fn visibility_edits(
        &self,
        object: usize,
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str> {
        visibility::edits(&self.text, &self.tree, &self.origins, object, wanted)
    }
}
