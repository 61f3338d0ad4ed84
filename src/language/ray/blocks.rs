//! The objects of long `.ray` texts, read in parallel blocks. Only regular texts are read this way:
//! after the lights there are only objects, as many as declared, none with an error.

use std::borrow::Cow;
use std::ops::Range;
use std::ptr;
use std::sync::Arc;

use rayon::prelude::*;

use super::objects::{first_compared, numbered};
use super::origins::ObjectPlace;
use super::reader::{LEAST_NUMBERS, Reader};
use super::schema::ShapeKind;
use super::tree::Tokens;
use geometry::Shape;
use scene::blocks::BLOCK;
use scene::{Material, Materials, Object, Objects};
use text::Span;

/// A block of objects, and its materials, whose numbers start at that of its first object.
pub(super) type Block = (Arc<[Object]>, Arc<[Material]>);

/// The block with a number that reading these objects would give, with their materials.
pub(super) fn block<'o>(
    number: usize,
    objects: impl Iterator<Item = (&'o Shape, &'o Material)>,
) -> Block {
    /// Number of materials found by address, which is faster than by comparing coefficients.
    const SEEN: usize = 16;
    let mut materials = Vec::new();
    let mut seen: Vec<(&Material, usize)> = Vec::with_capacity(SEEN);
    let objects = objects.map(|(shape, material)| {
        let same = |&&(of, _): &&(&Material, usize)| ptr::eq(of, material);
        let at = match seen.iter().rev().find(same) {
            Some(&(_, known)) if first_compared(&materials) <= known => known,
            _ => {
                let at = numbered(&mut materials, Cow::Borrowed(material));
                if seen.len() == SEEN {
                    seen.remove(0);
                }
                seen.push((material, at));
                at
            }
        };
        Object {
            shape: shape.clone(),
            material: (number * BLOCK + at) as u32,
        }
    });
    (objects.collect(), materials.into())
}

/// Reads a text of several blocks: what is before the objects and where they are, and the objects.
/// `None` if the text must be read in order.
pub(super) fn read<'a>(
    text: &'a str,
    tokens: &'a Tokens,
) -> Option<(Reader<'a>, (Objects, Materials))> {
    // Threads do not pay off for small scenes.
    if tokens.len() <= BLOCK * (1 + LEAST_NUMBERS) {
        return None;
    }
    let places = tokens
        .words()
        .filter_map(|(token, word)| place(text, token, word));
    let places: Vec<_> = places.collect();
    if places.len() <= BLOCK {
        return None;
    }
    let mut reader = header(text, tokens, &places)?;
    let numbers = (0..places.len().div_ceil(BLOCK)).into_par_iter();
    // Small tasks, so that a thread that finishes early can take over more.
    let blocks = numbers.with_max_len(4).map(|number| {
        let first = number * BLOCK;
        let end = places.get(first + BLOCK);
        let end = end.map_or(tokens.len(), |next| next.token as usize);
        let range = places[first].token as usize..end;
        let read = objects(text, tokens, range, first, number)?;
        let materials = read.materials.into_iter().next()?;
        Some(((read.objects.into(), materials.into()), read.report))
    });
    let blocks = blocks.collect::<Option<Vec<_>>>()?;
    let blocks = blocks.into_iter().map(|(block, report): (Block, _)| {
        reader.report.append(report);
        block
    });
    let (objects, materials) = blocks.unzip();
    let objects = Objects::of_blocks(objects);
    debug_assert_eq!(objects.len(), places.len(), "each keyword is an object");
    reader.origins.objects = Arc::new(places);
    Some((reader, (objects, Materials::of_blocks(materials))))
}

/// The place of a complete object, if its keyword is this token.
pub(super) fn place(text: &str, token: usize, word: Span) -> Option<ObjectPlace> {
    let kind = ShapeKind::of_word(word.of(text))?;
    Some(ObjectPlace {
        token: token as u32,
        kind,
        numbers: kind.numbers() as u8,
    })
}

/// Reads the text before the first object; `None` if it is not regular or miscounts the objects.
pub(super) fn header<'a>(
    text: &'a str,
    tokens: &'a Tokens,
    places: &[ObjectPlace],
) -> Option<Reader<'a>> {
    let first = places.first()?.token as usize;
    // Whether a word begins an object depends on the numbers after it.
    let known = 0..first + 1 + LEAST_NUMBERS;
    let mut reader = Reader::new(text, tokens, known);
    reader.header();
    let declared = reader.declared?.declared;
    let is_regular = reader.report.errors() == 0 && reader.at == first && declared == places.len();
    is_regular.then_some(reader)
}

/// Reads objects of these tokens, with `before` objects before them, whose first block has the number
/// `block`; `None` if they are not regular.
pub(super) fn objects<'a>(
    text: &'a str,
    tokens: &'a Tokens,
    range: Range<usize>,
    before: usize,
    block: usize,
) -> Option<Reader<'a>> {
    let mut reader = Reader::new(text, tokens, range);
    (reader.before, reader.blocks_before) = (before, block);
    reader.objects.reserve(BLOCK);
    while let Some(token) = reader.token() {
        let kind = ShapeKind::of_word(token.of(text))?;
        if !reader.object(token, kind, None) {
            return None;
        }
    }
    (reader.report.errors() == 0).then_some(reader)
}
