//! Estimates of the memory that a `.ray` text takes: for its tree and its scene.

use rayon::prelude::*;

use super::blocks;
use super::origins::ObjectPlace;
use super::reader::LEAST_NUMBERS;
use super::schema::ShapeKind;
use super::tree::Tokens;
use crate::memory_estimate::{Counts, each};
use geometry::Affine;
use memory::{Need, OutOfMemory, megabytes};
use scene::blocks::BLOCK;
use scene::{Material, Object};
use text::{Span, counted};

/// Upper bound of the bytes of an object without its material: growing lists have up to twice the
/// capacity they need.
const OBJECT: usize =
    2 * size_of::<Object>() + 2 * size_of::<ObjectPlace>() + 2 * size_of::<Affine>();

/// Number of blocks of objects read to estimate the number of materials.
const SAMPLED: usize = 8;

/// Estimates the bytes needed to build a tree with these counts.
pub(crate) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.tokens, 3) + each(counts.words, 16) + each(counts.comments, 8)
}

/// Fails if the tree's scene does not fit into memory.
pub(super) fn fits(text: &str, tree: &Tokens) -> Result<(), OutOfMemory> {
    let objects = tree.len() / (1 + LEAST_NUMBERS);
    let most = each(objects as u64, OBJECT + 3 * size_of::<Material>());
    memory::check(most, || of_objects(text, tree))
}

/// The memory needed by the objects of a text.
fn of_objects(text: &str, tree: &Tokens) -> Need {
    let words = || tree.words();
    let kinds = || words().filter_map(|(_, word)| ShapeKind::of_word(word.of(text)));
    let count = kinds().count();
    let boxed = kinds().filter(|&kind| kind != ShapeKind::Sphere).count();
    let places = 3 * size_of::<ObjectPlace>();
    let shapes =
        each(count as u64, places + size_of::<Object>()) + each(boxed as u64, size_of::<Affine>());
    let materials = match materials(text, tree, count) {
        Some(materials) => each(materials as u64, 3 * size_of::<Material>()),
        // Texts with errors are read in order.
        None => each(count as u64, size_of::<Object>()),
    };
    // A text that is mostly something other than objects is described by its size.
    let most_is_objects = tree.len() <= count * 10 * LEAST_NUMBERS;
    Need {
        what: if most_is_objects {
            counted(count, "object")
        } else {
            format!("{} of text", megabytes(text.len() as u64))
        },
        bytes: shapes + materials,
    }
}

/// Estimates the number of materials from some blocks of objects; `None` if one is not regular.
fn materials(text: &str, tree: &Tokens, count: usize) -> Option<usize> {
    let mut found = 0;
    let mut objects = 0;
    for sample in 0..SAMPLED {
        let from = tree.len() / SAMPLED * sample;
        let spans = tree.range(from..from + BLOCK * (1 + LEAST_NUMBERS));
        let begins = |span: &Span| ShapeKind::of_word(span.of(text)).is_some();
        let first = spans.iter().position(begins)?;
        let end = spans.iter().rposition(begins)?;
        let block = blocks::objects(text, tree, from + first..from + end, 0, 0)?;
        found += block.materials.iter().map(Vec::len).sum::<usize>();
        objects += block.objects.len();
    }
    Some(count.checked_mul(found)?.div_ceil(objects.max(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::tree::parse;

    #[test]
    fn distinct_materials_are_all_counted() {
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
