//! Rice University's `.ray`: ambient light, lights and objects as a stream of tokens, and a view in a
//! comment.

mod again;
mod blocks;
mod lower;
mod objects;
mod origins;
mod room;
mod table;
#[cfg(test)]
mod tests;
mod tree;
mod view;
mod view_comment;

use std::sync::Arc;

use super::view::{literals, saying};
use super::written::Written;
use super::{Answers, Before, Lowered, Node, Nodes, Placed};
use crate::memory::OutOfMemory;
use crate::scene::{Camera, Meshes};
use crate::text::{Edit, Findings, Span};
use origins::Origins;
use tree::Tree;

pub(super) use room::tree_bytes;

/// A `.ray` text.
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
        self.apply(edits, |tree, text, [old, changed]| {
            tree.follow(text, old, changed);
        })
    }

    fn restore(&mut self) {
        self.take_back();
    }

    fn lower(&mut self, _: &Meshes) -> Result<Lowered, OutOfMemory> {
        if let Err(refused) = room::fits(&self.text, &self.tree) {
            self.place(Origins::default());
            return Err(refused);
        }
        let (origins, lowered) = lower::lower(&self.text, &self.tree);
        self.place(origins);
        Ok(lowered)
    }

    fn lower_again(
        &mut self,
        meshes: &Meshes,
        before: Before<'_>,
        spans: [Span; 2],
    ) -> Result<Lowered, OutOfMemory> {
        match again::lower(&self.text, &self.tree, &self.origins, &before, spans) {
            Some((origins, lowered)) => {
                self.place(origins);
                Ok(lowered)
            }
            None => self.lower(meshes),
        }
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

    fn view_literals(&self, camera: &Camera) -> Vec<Vec<String>> {
        literals(view::fields(), view::numbers(camera))
    }

    fn view_saying(
        &self,
        camera: &Camera,
        at: (usize, usize),
        said: &str,
    ) -> Result<Camera, String> {
        let numbers = saying(view::fields(), view::numbers(camera), at, said)?;
        Ok(view::camera(&numbers, camera))
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        view::edits(&self.text, &self.origins, before, camera)
    }
}
