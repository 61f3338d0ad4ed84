//! The objects of long `.ray` texts, read in parallel blocks. Only regular texts are read this way:
//! after the lights there are only objects, as many as declared, none with an error.

use std::ops::Range;
use std::ptr;
use std::sync::Arc;

use rayon::prelude::*;

use super::objects::{first_compared, known_material};
use super::origins::ObjectPlace;
use super::reader::{LEAST_NUMBERS, Reader};
use super::table::ShapeKind;
use super::tree::Tokens;
use crate::geometry::Shape;
use crate::scene::blocks::BLOCK;
use crate::scene::{Material, Object, Objects};
use crate::text::{Findings, Span};

/// Blocks from which processing them is worth other threads.
pub(super) const MANY: usize = 4;

/// A block of objects; its material indices count from 0.
pub(super) struct Block {
    pub(super) materials: Vec<Material>,
    pub(super) objects: Arc<[Object]>,
    pub(super) report: Findings,
}

impl Block {
    /// The block that reading these objects would give, with their materials.
    pub(super) fn of<'o>(objects: impl Iterator<Item = (&'o Shape, &'o Material)>) -> Self {
        /// Number of materials found by address, which is several times faster than by their numbers.
        const SEEN: usize = 16;
        let mut materials = Vec::new();
        let mut seen: Vec<(&Material, usize)> = Vec::with_capacity(SEEN);
        let objects = objects.map(|(shape, material)| {
            let same = |&&(of, _): &&(&Material, usize)| ptr::eq(of, material);
            let number = match seen.iter().rev().find(same) {
                Some(&(_, known)) if first_compared(&materials, 0) <= known => known,
                _ => {
                    let known = known_material(&materials, 0, material);
                    let number = known.unwrap_or_else(|| {
                        materials.push(material.clone());
                        materials.len() - 1
                    });
                    if seen.len() == SEEN {
                        seen.remove(0);
                    }
                    seen.push((material, number));
                    number
                }
            };
            Object {
                shape: shape.clone(),
                material: number as u32,
            }
        });
        Self {
            objects: objects.collect(),
            materials,
            report: Findings::default(),
        }
    }
}

/// The objects of blocks, whose materials count from `base`, and all their materials.
pub(super) fn joined(blocks: Vec<Block>, base: usize) -> (Vec<Arc<[Object]>>, Vec<Material>) {
    let mut materials = Vec::new();
    let based = blocks.into_iter().map(|mut block| {
        let first = (base + materials.len()) as u32;
        materials.append(&mut block.materials);
        (block.objects, first)
    });
    let based = based.collect();
    (renumbered(based), materials)
}

/// Blocks of objects, with a number added to the indices of each block's materials.
pub(super) fn renumbered(mut blocks: Vec<(Arc<[Object]>, u32)>) -> Vec<Arc<[Object]>> {
    let numbers = |(block, more): &mut (Arc<[Object]>, u32)| {
        for object in Arc::make_mut(block) {
            object.material = object.material.wrapping_add(*more);
        }
    };
    // Threads do not pay off for a few.
    if blocks.len() < MANY {
        blocks.iter_mut().for_each(numbers);
    } else {
        blocks.par_iter_mut().for_each(numbers);
    }
    blocks.into_iter().map(|(block, _)| block).collect()
}

/// Reads a text of several blocks. Returns a reader, the objects and the place of their count, or
/// the findings so far if the text must be read in order.
pub(super) fn read<'a>(
    text: &'a str,
    tokens: &'a Tokens,
    report: Findings,
) -> Result<(Reader<'a>, Objects, Span), Findings> {
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
        block(text, tokens, range, first)
    });
    let Some(mut blocks) = blocks.collect::<Option<Vec<_>>>() else {
        return Err(report);
    };
    let found = std::mem::replace(&mut reader.report, report);
    reader.report.append(found);
    for block in &mut blocks {
        reader.report.append(std::mem::take(&mut block.report));
    }
    let (objects, materials) = joined(blocks, 0);
    let objects = Objects::of_blocks(objects);
    reader.materials = materials;
    debug_assert_eq!(objects.len(), places.len(), "each keyword is an object");
    reader.places = places;
    Ok((reader, objects, count))
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

/// Reads a block of these tokens, with `first` objects before it; `None` if it is not regular.
pub(super) fn block(
    text: &str,
    tokens: &Tokens,
    range: Range<usize>,
    first: usize,
) -> Option<Block> {
    let mut reader = Reader::new(text, tokens, range, Findings::default());
    reader.before = first;
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
    (report.errors() == 0).then_some(Block {
        materials,
        objects: objects.into(),
        report,
    })
}
