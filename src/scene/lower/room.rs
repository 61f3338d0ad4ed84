//! How much memory the scene of a tree takes, before it is lowered.

use super::ray::LEAST_NUMBERS;
use super::{Lowered, blocks};
use crate::format::{Tree, ray};
use crate::geometry::{Affine, Shape};
use crate::memory::{self, Need, OutOfMemory, megabytes};
use crate::scene::fields::ray::ShapeKind;
use crate::scene::objects::BLOCK;
use crate::scene::origins::ray::ObjectPlace;
use crate::scene::{Material, Object, Origins, Utah, origins};
use crate::text::{Diagnostic, Findings, Span, counted};

/// The most that an object takes besides its material: in lists that grow it has up to twice the room
/// it needs.
const OBJECT: usize =
    2 * size_of::<Object>() + 2 * size_of::<ObjectPlace>() + 2 * size_of::<Affine>();

/// What a thing of a `.dat` text takes: itself, its place and its name, in several lists.
const RECORD: usize = 2 * size_of::<Shape>() + 2 * size_of::<Affine>() + size_of::<Material>();

/// What an element takes: an object with where it is, or a part of a material or of a light.
const ELEMENT: usize = 2 * size_of::<Object>() + size_of::<Affine>() + size_of::<Utah>() / 2;

/// Blocks of objects that are read to see how many materials there are.
const SAMPLED: usize = 8;

/// Refuses a tree whose scene does not fit into memory.
pub fn fits(text: &str, tree: &Tree) -> Result<(), OutOfMemory> {
    let each = |count: usize, size: usize| count as u64 * size as u64;
    match tree {
        Tree::Ray(tree) => {
            let tokens = each(tree.tokens.len(), size_of::<Span>());
            let objects = tree.tokens.len() / (1 + LEAST_NUMBERS);
            let most = tokens + each(objects, OBJECT + 3 * size_of::<Material>());
            memory::check(most, || of_objects(text, tree))
        }
        Tree::Dat(tree) => {
            let count = tree.records.len();
            let bytes = each(count, RECORD);
            memory::check(bytes, || Need {
                what: counted(count, "record"),
                bytes,
            })
        }
        Tree::Xml(tree) => {
            let count = tree.elements.len();
            let bytes = each(count, ELEMENT);
            memory::check(bytes, || Need {
                what: counted(count, "element"),
                bytes,
            })
        }
    }
}

impl Lowered {
    /// What a tree means that is not lowered: nothing, for this reason.
    pub fn refused(tree: &Tree, reason: &OutOfMemory) -> Self {
        let mut diagnostics = Findings::default();
        diagnostics.error(|| {
            let start = Span::at(0);
            Diagnostic::error(start, reason.to_string(), "a scene that fits into memory")
        });
        Self {
            scene: None,
            origins: match tree {
                Tree::Ray(_) => Origins::Ray(origins::ray::Origins::default()),
                Tree::Dat(_) => Origins::Dat(origins::dat::Origins::default()),
                Tree::Xml(_) => Origins::Xml(origins::xml::Origins::default()),
            },
            diagnostics,
        }
    }
}

/// What the objects of a `.ray` text need.
fn of_objects(text: &str, tree: &ray::Tree) -> Need {
    use rayon::prelude::*;
    let kinds = || {
        tree.tokens
            .words()
            .filter_map(|(token, word)| Some((token, ShapeKind::of_word(word.of(text))?)))
    };
    let count = kinds().count();
    let boxed = kinds()
        .filter(|&(_, kind)| kind != ShapeKind::Sphere)
        .count();
    let each = |count: usize, size: usize| count as u64 * size as u64;
    let places = 3 * size_of::<ObjectPlace>();
    let shapes = each(count, places + size_of::<Object>()) + each(boxed, size_of::<Affine>());
    let materials = match materials(text, tree, count) {
        Some(materials) => each(materials, 3 * size_of::<Material>()),
        // It is read in order, for it has errors.
        None => each(tree.tokens.len(), size_of::<Span>()) + each(count, size_of::<Object>()),
    };
    // What is not much of its objects is called by its size.
    let most_is_objects = tree.tokens.len() <= count * 10 * LEAST_NUMBERS;
    Need {
        what: if most_is_objects {
            counted(count, "object")
        } else {
            format!("{} of text", megabytes(text.len() as u64))
        },
        bytes: shapes + materials,
    }
}

/// About how many materials there are, as some blocks of objects tell; `None` if one is not regular.
fn materials(text: &str, tree: &ray::Tree, count: usize) -> Option<usize> {
    let mut found = 0;
    let mut objects = 0;
    for sample in 0..SAMPLED {
        let from = tree.tokens.len() / SAMPLED * sample;
        let mut spans = tree.tokens.range(from..from + BLOCK * (1 + LEAST_NUMBERS));
        let begins = |span: &Span| ShapeKind::of_word(span.of(text)).is_some();
        let first = spans.iter().position(begins)?;
        let end = spans.iter().rposition(begins)?;
        let block = blocks::block(text, spans.get(first..end)?, 0)?;
        spans.clear();
        found += block.materials.len();
        objects += block.objects.len();
    }
    Some(count.checked_mul(found)?.div_ceil(objects.max(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::{self, Format};

    #[test]
    fn materials_that_differ_are_needed_each() {
        let text = |alike: bool| {
            let object = |number: usize| {
                let red = if alike { 5 } else { number };
                format!("sphere 0 0 0 1 0 0 0 .{red} .5 .5 0 0 0 1 0 0 1\n")
            };
            let objects: String = (0..5 * BLOCK).map(object).collect();
            format!("0 0 0 0 {} {objects}", 5 * BLOCK)
        };
        let need = |text: &str| {
            let Tree::Ray(tree) = format::parse(Format::Ray, text) else {
                panic!("it is .ray");
            };
            of_objects(text, &tree)
        };
        assert_eq!(need(&"1 ".repeat(600_000)).what, "2 MB of text");
        let (alike, different) = (need(&text(true)), need(&text(false)));
        assert_eq!(alike.what, "5120 objects");
        let each = |need: &Need| need.bytes / (5 * BLOCK as u64);
        assert!((40..120).contains(&each(&alike)), "{}", each(&alike));
        assert!(400 < each(&different), "{}", each(&different));
    }
}
