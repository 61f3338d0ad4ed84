//! How much memory a `.ray` text takes: its tree, and its scene.

use rayon::prelude::*;

use super::blocks;
use super::lower::LEAST_NUMBERS;
use super::origins::ObjectPlace;
use super::table::ShapeKind;
use super::tree::{Comment, Tree};
use crate::geometry::Affine;
use crate::language::room::{Counts, each};
use crate::memory::{self, Need, OutOfMemory, megabytes};
use crate::scene::objects::BLOCK;
use crate::scene::{Material, Object};
use crate::text::{Span, counted};

/// The most that an object takes besides its material: in lists that grow it has up to twice the room
/// it needs.
const OBJECT: usize =
    2 * size_of::<Object>() + 2 * size_of::<ObjectPlace>() + 2 * size_of::<Affine>();

/// Blocks of objects that are read to see how many materials there are.
const SAMPLED: usize = 8;

/// About how many bytes a tree of so many leaves takes while it is made.
pub(in crate::language) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.tokens, 3)
        + each(counts.words, 16)
        + each(counts.comments, 2 * size_of::<Comment>())
}

/// Refuses a tree whose scene does not fit into memory.
pub(super) fn fits(text: &str, tree: &Tree) -> Result<(), OutOfMemory> {
    let tokens = each(tree.tokens.len() as u64, size_of::<Span>());
    let objects = tree.tokens.len() / (1 + LEAST_NUMBERS);
    let most = tokens + each(objects as u64, OBJECT + 3 * size_of::<Material>());
    memory::check(most, || of_objects(text, tree))
}

/// What the objects of a `.ray` text need.
fn of_objects(text: &str, tree: &Tree) -> Need {
    let kinds = || {
        tree.tokens
            .words()
            .filter_map(|(token, word)| Some((token, ShapeKind::of_word(word.of(text))?)))
    };
    let count = kinds().count();
    let boxed = kinds()
        .filter(|&(_, kind)| kind != ShapeKind::Sphere)
        .count();
    let places = 3 * size_of::<ObjectPlace>();
    let shapes =
        each(count as u64, places + size_of::<Object>()) + each(boxed as u64, size_of::<Affine>());
    let materials = match materials(text, tree, count) {
        Some(materials) => each(materials as u64, 3 * size_of::<Material>()),
        // It is read in order, for it has errors.
        None => {
            each(tree.tokens.len() as u64, size_of::<Span>())
                + each(count as u64, size_of::<Object>())
        }
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
fn materials(text: &str, tree: &Tree, count: usize) -> Option<usize> {
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
    use crate::language::ray::tree::parse;

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
        let need = |text: &str| of_objects(text, &parse(text));
        assert_eq!(need(&"1 ".repeat(600_000)).what, "2 MB of text");
        let (alike, different) = (need(&text(true)), need(&text(false)));
        assert_eq!(alike.what, "5120 objects");
        let each = |need: &Need| need.bytes / (5 * BLOCK as u64);
        assert!((40..120).contains(&each(&alike)), "{}", each(&alike));
        assert!(400 < each(&different), "{}", each(&different));
    }
}
