//! The objects of long `.ray` texts, read in parallel blocks. Only regular texts are read this way:
//! after the lights there are only objects, as many as declared, none with an error.

use std::ops::Range;
use std::ptr;
use std::sync::Arc;

use rayon::prelude::*;

use super::objects::{first_compared, known_material};
use super::origins::ObjectPlace;
use super::reader::{LEAST_NUMBERS, Reader};
use super::schema::ShapeKind;
use super::tree::Tokens;
use geometry::Shape;
use scene::blocks::BLOCK;
use scene::{Material, Materials, Object, Objects};
use text::{Findings, Span};

/// A block of objects with its materials, whose numbers start at that of its first object.
pub(super) struct Block {
    pub(super) materials: Arc<[Material]>,
    pub(super) objects: Arc<[Object]>,
}

/// Objects that were read, and the materials of each block of them.
pub(super) struct Read {
    pub(super) materials: Vec<Vec<Material>>,
    pub(super) objects: Vec<Object>,
    pub(super) report: Findings,
}

impl Block {
    /// The block with a number that reading these objects would give, with their materials.
    pub(super) fn of<'o>(
        number: usize,
        objects: impl Iterator<Item = (&'o Shape, &'o Material)>,
    ) -> Self {
        /// Number of materials found by address, which is faster than by comparing coefficients.
        const SEEN: usize = 16;
        let mut materials = Vec::new();
        let mut seen: Vec<(&Material, usize)> = Vec::with_capacity(SEEN);
        let objects = objects.map(|(shape, material)| {
            let same = |&&(of, _): &&(&Material, usize)| ptr::eq(of, material);
            let at = match seen.iter().rev().find(same) {
                Some(&(_, known)) if first_compared(&materials) <= known => known,
                _ => {
                    let known = known_material(&materials, material);
                    let at = known.unwrap_or_else(|| {
                        materials.push(material.clone());
                        materials.len() - 1
                    });
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
        Self {
            objects: objects.collect(),
            materials: materials.into(),
        }
    }
}

/// Joins blocks in order.
pub(super) fn joined(blocks: impl IntoIterator<Item = Block>) -> (Objects, Materials) {
    let lists = blocks
        .into_iter()
        .map(|block| (block.objects, block.materials));
    let (objects, materials) = lists.unzip();
    (Objects::of_blocks(objects), Materials::of_blocks(materials))
}

/// Reads a text of several blocks. Returns a reader, the objects with their materials, and the place
/// of their count, or the findings so far if the text must be read in order.
pub(super) fn read<'a>(
    text: &'a str,
    tokens: &'a Tokens,
    report: Findings,
) -> Result<(Reader<'a>, (Objects, Materials), Span), Findings> {
    // Threads do not pay off for small scenes.
    if tokens.len() <= BLOCK * (1 + LEAST_NUMBERS) {
        return Err(report);
    }
    let places = places(text, tokens);
    if places.len() <= BLOCK {
        return Err(report);
    }
    let Some((mut reader, count)) = header(text, tokens, &places) else {
        return Err(report);
    };
    let numbers = (0..places.len().div_ceil(BLOCK)).into_par_iter();
    // Small tasks, so that a thread that finishes early can take over more.
    let blocks = numbers.with_max_len(4).map(|number| {
        let first = number * BLOCK;
        let end = places.get(first + BLOCK);
        let end = end.map_or(tokens.len(), |next| next.token as usize);
        let range = places[first].token as usize..end;
        let read = objects(text, tokens, range, first, number)?;
        let block = Block {
            materials: read.materials.into_iter().next()?.into(),
            objects: read.objects.into(),
        };
        Some((block, read.report))
    });
    let Some(blocks) = blocks.collect::<Option<Vec<_>>>() else {
        return Err(report);
    };
    let found = std::mem::replace(&mut reader.report, report);
    reader.report.append(found);
    let blocks = blocks.into_iter().map(|(block, report)| {
        reader.report.append(report);
        block
    });
    let (objects, materials) = joined(blocks);
    debug_assert_eq!(objects.len(), places.len(), "each keyword is an object");
    reader.places = places;
    Ok((reader, (objects, materials), count))
}

/// The places of all keywords, with the number of numbers of a complete object.
fn places(text: &str, tokens: &Tokens) -> Vec<ObjectPlace> {
    let words = tokens.words();
    let places = words.filter_map(|(token, word)| place(text, token, word));
    places.collect()
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
) -> Option<(Reader<'a>, Span)> {
    let first = places.first()?.token as usize;
    // Whether a word begins an object depends on the numbers after it.
    let known = 0..first + 1 + LEAST_NUMBERS;
    let mut reader = Reader::new(text, tokens, known, Findings::default());
    let count = reader.header()?;
    let is_regular =
        reader.report.errors() == 0 && reader.at == first && count.declared == places.len() as u64;
    is_regular.then_some((reader, count.token))
}

/// Reads objects of these tokens, with `before` objects before them, whose first block has the number
/// `block`; `None` if they are not regular.
pub(super) fn objects(
    text: &str,
    tokens: &Tokens,
    range: Range<usize>,
    before: usize,
    block: usize,
) -> Option<Read> {
    let mut reader = Reader::new(text, tokens, range, Findings::default());
    (reader.before, reader.blocks_before) = (before, block);
    reader.objects.reserve(BLOCK);
    while let Some(token) = reader.token() {
        let kind = ShapeKind::of_word(token.of(text))?;
        if !reader.object(token, kind, None) {
            return None;
        }
    }
    let Reader {
        materials,
        objects,
        report,
        ..
    } = reader;
    (report.errors() == 0).then_some(Read {
        materials,
        objects,
        report,
    })
}
