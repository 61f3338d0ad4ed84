//! The objects of long `.ray` texts, read by blocks side by side. Only what is regular is read so:
//! after the lights nothing but objects, as many as the text says, none with an error.

use std::sync::Arc;

use rayon::prelude::*;

use super::lower::{LEAST_NUMBERS, Reader};
use super::origins::ObjectPlace;
use super::table::ShapeKind;
use super::tree::Tokens;
use crate::scene::objects::BLOCK;
use crate::scene::{Material, Object, Objects};
use crate::text::{Findings, Span};

/// A block of objects as it was read; its materials count from 0.
pub(super) struct Block {
    pub(super) materials: Vec<Material>,
    pub(super) objects: Vec<Object>,
    pub(super) report: Findings,
}

/// Reads a text of several blocks; what was read, the objects, and where their number stands. Gives
/// the findings so far back if it must be read in order.
pub(super) fn read<'a>(
    text: &'a str,
    tokens: &Tokens,
    report: Findings,
) -> Result<(Reader<'a>, Objects, Span), Findings> {
    // Small scenes do without threads.
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
    // A thread that is done early finds some left to take over.
    let blocks = numbers.with_max_len(4).map_init(Vec::new, |spans, number| {
        let first = number * BLOCK;
        let end = places.get(first + BLOCK);
        let end = end.map_or(tokens.len(), |next| next.token as usize);
        spans.clear();
        tokens.append_to(spans, places[first].token as usize..end);
        let read = block(text, spans, first)?;
        Some((read.materials, Arc::from(read.objects), read.report))
    });
    let Some(blocks) = blocks.collect::<Option<Vec<(_, Arc<[Object]>, _)>>>() else {
        return Err(report);
    };
    let found = std::mem::replace(&mut reader.report, report);
    reader.report.append(found);
    let mut bases = Vec::with_capacity(blocks.len());
    let mut objects = Vec::with_capacity(blocks.len());
    for (mut materials, block, report) in blocks {
        bases.push(reader.materials.len() as u32);
        reader.materials.append(&mut materials);
        objects.push(block);
        reader.report.append(report);
    }
    let based = objects.par_iter_mut().zip(bases);
    based.for_each(|(block, base)| {
        for object in Arc::make_mut(block) {
            object.material += base;
        }
    });
    let objects = Objects::of_blocks(objects);
    debug_assert_eq!(objects.len(), places.len(), "each keyword is an object");
    reader.places = places;
    Ok((reader, objects, count))
}

/// Where each keyword stands, with the numbers that a whole object has.
fn places(text: &str, tokens: &Tokens) -> Vec<ObjectPlace> {
    let places = tokens.words().filter_map(|(token, word)| {
        let kind = ShapeKind::of_word(word.of(text))?;
        Some(ObjectPlace {
            token: token as u32,
            kind,
            numbers: kind.numbers() as u8,
        })
    });
    places.collect()
}

/// Reads what stands before the first object, if that and the number of objects is as it should be.
fn header<'a>(
    text: &'a str,
    tokens: &Tokens,
    places: &[ObjectPlace],
) -> Option<(Reader<'a>, Span)> {
    let first = places[0].token as usize;
    // Whether a word begins an object is told by the numbers behind it.
    let spans = tokens.range(0..first + 1 + LEAST_NUMBERS);
    let mut reader = Reader::new(text, &spans, Findings::default());
    let count = reader.header()?;
    let is_regular =
        reader.report.errors() == 0 && reader.at == first && count.declared == places.len() as u64;
    let Reader {
        report,
        origins,
        ambient,
        lights,
        ..
    } = reader;
    let reader = Reader {
        report,
        origins,
        ambient,
        lights,
        ..Reader::new(text, &[], Findings::default())
    };
    is_regular.then_some((reader, count.token))
}

/// Reads a block whose first object has `first` ones before it, if it is regular.
pub(super) fn block(text: &str, tokens: &[Span], first: usize) -> Option<Block> {
    let mut reader = Reader::new(text, tokens, Findings::default());
    reader.before = first;
    reader.objects.reserve(BLOCK);
    while let Some(token) = tokens.get(reader.at) {
        let kind = ShapeKind::of_word(token.of(text))?;
        if !reader.object(kind, None) {
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
        objects,
        report,
    })
}
