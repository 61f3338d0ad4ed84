//! The first thing in an empty text: a minimal scene that holds it.

use std::sync::Arc;

use glam::DVec3;

use super::node::IndexedNode;
use super::structure::{NewNode, adapted};
use super::view::{beginning, line_ending};
use super::{Node, Source, StructureError};
use scene::Meshes;
use text::{Edit, Span};

impl Source {
    /// Whether the text holds nothing but comments.
    pub fn is_blank(&self) -> bool {
        // Also what one of the languages skips; where it is none, a scene behind it has errors.
        let marks = [self.comment_marks(), ["//", ""], ["<?", "?>"]];
        let text = self.text();
        let mut rest = text[beginning(text)..].trim_start();
        while !rest.is_empty() {
            let begun = marks.iter().find(|[open, _]| rest.starts_with(open));
            let Some([_, close]) = begun else {
                return false;
            };
            rest = match (*close, rest.find(['\n', '\r'])) {
                ("", None) => "",
                ("", Some(end)) => rest[end..].trim_start(),
                (close, _) => match rest.split_once(close) {
                    Some((_, behind)) => behind.trim_start(),
                    None => return false,
                },
            };
        }
        true
    }

    /// Returns the edit that writes a minimal scene with a thing of a kind, by its name in
    /// [`additions`](super::StructureEdits::additions), into a [blank](Source::is_blank) text, behind
    /// its comments, and the node of the thing.
    ///
    /// # Errors
    ///
    /// Fails if the thing needs others.
    pub fn first(&self, name: &str) -> Result<(Edit, Node), StructureError> {
        let text = self.text();
        let mut scene = Self::new(
            self.language(),
            Arc::new(self.language().skeleton().to_owned()),
        );
        scene.understand()?;
        let wish = NewNode {
            centre: DVec3::ZERO,
            half: 1.0,
            up: self.language().vertical(),
            decimals: 2,
            after: Node::View,
            marked: &[],
            file: None,
        };
        let before = scene.nodes();
        let placement = scene.addition(name, &wish)?;
        scene.change(&placement.edits);
        scene.understand()?;
        let after = scene.nodes();
        let kinds: [(IndexedNode, usize, usize); 4] = [
            (Node::Object, before.objects, after.objects),
            (Node::Light, before.lights, after.lights),
            (Node::Texture, before.textures, after.textures),
            (Node::Material, before.materials, after.materials),
        ];
        let mut kinds = kinds.into_iter();
        let added = kinds.find(|(_, before, after)| before < after);
        let node = added.map_or(Node::View, |(kind, ..)| kind(0));
        if let Some((kind, others @ 1.., _)) = added {
            // It takes the place of what the language requires.
            let others: Vec<_> = (0..others).map(kind).collect();
            let edits = scene.removal(&others)?;
            scene.change(&edits);
        }
        let kept = text.trim_end();
        let ending = line_ending(text);
        let gap = match &kept[beginning(text)..] {
            "" => String::new(),
            _ => format!("{ending}{ending}"),
        };
        let edit = Edit {
            span: Span::new(kept.len(), text.len()),
            text: format!("{gap}{}{ending}", adapted(scene.text(), text)),
        };
        Ok((edit, node))
    }

    /// Finds the places of the nodes.
    fn understand(&mut self) -> Result<(), StructureError> {
        let lowered = self.lower(&Meshes::default());
        let refused =
            |reason: memory::OutOfMemory| StructureError::Inexpressible(reason.to_string());
        lowered.map(|_| ()).map_err(refused)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Language;

    fn lowered(language: Language, text: &str) -> Source {
        let mut source = Source::new(language, Arc::new(text.to_owned()));
        source.understand().expect("there is memory");
        source
    }

    #[test]
    fn comments_alone_are_blank() {
        for (language, text, is_blank) in [
            (Language::Ray, "", true),
            (Language::Ray, " // a scene\n\n// of mine", true),
            (Language::Ray, "// a\n1", false),
            (Language::Dat, "# a\r\n// b\r\n", true),
            (Language::Dat, "# a\nmat", false),
            (Language::Ray, "\u{FEFF}", true),
            (Language::Dat, "\u{FEFF}# a", true),
            (Language::Xml, "\u{FEFF}\n<xml/>", false),
            (
                Language::Xml,
                "<?xml version='1.0'?>\n<!-- a\nb -->\n",
                true,
            ),
            (Language::Xml, "<!-- a", false),
            (Language::Xml, "<xml/>", false),
        ] {
            assert_eq!(lowered(language, text).is_blank(), is_blank, "{text}");
        }
    }

    #[test]
    fn anything_that_refers_to_nothing_else_can_be_added_first() {
        for (language, comment) in [
            (Language::Ray, "// mine"),
            (Language::Dat, "# mine"),
            (Language::Xml, "<!-- mine -->"),
        ] {
            let marked = format!("\u{FEFF}{comment}");
            for text in ["", comment, "\n\n", "\u{FEFF}\n", &marked] {
                let source = lowered(language, text);
                for addition in source.additions() {
                    let Ok((edit, node)) = source.first(addition.name) else {
                        let combines = ["union", "intersection", "difference"];
                        assert!(combines.contains(&addition.name), "{}", addition.name);
                        continue;
                    };
                    let mut new = source.clone();
                    new.change(&[edit]);
                    let found = new.lower(&Meshes::default()).expect("there is memory");
                    let name = format!("{language:?} {}", addition.name);
                    assert_eq!(found.diagnostics.errors(), 0, "{name}: {}", new.text());
                    assert!(new.text().starts_with(text.trim_end()), "{name}");
                    assert!(new.nodes().iter().any(|listed| listed == node), "{name}");
                    assert_ne!(node, Node::View, "{name}");
                }
            }
        }
    }
}
