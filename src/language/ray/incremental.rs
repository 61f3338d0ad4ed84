//! Incremental lowering of a `.ray` text: after an edit, only the objects in its lines are read
//! again, and only the blocks of objects that differ are rebuilt. Gives up wherever anything else may
//! have changed.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::blocks;
use super::lower;
use super::origins::{ObjectPlace, Origins};
use super::reader::Reader;
use super::tree::Tokens;
use crate::written::{Replaced, numbers};
use crate::{Before, Lowered};
use scene::blocks::BLOCK;
use scene::{Materials, Object, Objects, Scene};
use text::{Findings, Span, line_start, next_line};

/// The most tokens read again, on a single thread; with more, the whole text is read in parallel.
const MOST: usize = 1 << 16;

/// The number of blocks from which rebuilding them in parallel pays off.
const MANY: usize = 4;

/// Lowers a text after edits.
pub(super) fn lower(
    text: &str,
    tree: &Tokens,
    origins: &Origins,
    before: &Before<'_>,
    edits: &[Replaced],
) -> Option<(Origins, Lowered)> {
    let is_sound = before.diagnostics.errors() == 0
        && before.diagnostics.len() == before.diagnostics.warnings()
        && before.scene.objects.len() == origins.objects.len();
    if !is_sound {
        return None;
    }
    let change = Change::of(text, tree, origins, edits)?;
    let places = change.places(origins);
    let mut reader = blocks::header(text, tree, &places)?;
    let kept = change.kept_findings(tree, &places, before.diagnostics)?;
    reader.report.append(kept);
    let known = before.scene;
    let objects = if change.region.is_none() {
        (known.objects.clone(), known.materials.clone())
    } else {
        let tokens = change.tokens(tree, &places);
        if MOST < tokens.len() {
            return None;
        }
        let read = blocks::objects(text, tree, tokens, change.old.start, 0)?;
        let made = replaced(known, change.old.clone(), &read);
        reader.report.append(read.report);
        made
    };
    reader.origins.objects = places;
    let (origins, lowered) = lower::joined(text, tree, reader, objects);
    let found = &lowered.diagnostics;
    (found.len() == found.warnings()).then_some((origins, lowered))
}

/// What edits may have changed of the objects.
#[derive(Default)]
struct Change<'e> {
    edits: &'e [Replaced],
    /// The bytes of the text before in which objects may have changed; `None` if none has.
    region: Option<Span>,
    /// The objects before the edits that are read again.
    old: Range<usize>,
    /// The first token that is read again, if that is an object's.
    from: Option<usize>,
    /// Where the objects that replace them are.
    new: Vec<ObjectPlace>,
    /// How many more tokens precede the objects behind.
    grown: isize,
}

impl<'e> Change<'e> {
    /// Finds the objects in the lines of the edits. Tokens in lines before and behind them are as
    /// before.
    fn of(text: &str, tree: &Tokens, origins: &Origins, edits: &'e [Replaced]) -> Option<Self> {
        let objects = &origins.objects;
        let first = objects.first()?.token as usize;
        let in_header = edits.iter().take_while(|edit| {
            let token = numbers_in_place(text, tree, edit);
            token.is_some_and(|last| last < first)
        });
        let of_objects = &edits[in_header.count()..];
        let Some((one, last)) = of_objects.first().zip(of_objects.last()) else {
            return Some(Self {
                edits,
                ..Self::default()
            });
        };
        let grown = tree.len() as isize - origins.tokens as isize;
        let line = line_start(text, one.new.start());
        let before = tree.partition_point(|token| token.start() < line);
        let before = objects.partition_point(|object| (object.token as usize) < before);
        let line = next_line(text, last.new.end());
        let behind = tree.partition_point(|token| token.start() < line) as isize - grown;
        let end = objects.partition_point(|object| (object.token as isize) < behind);
        // The last object that begins before these lines may end in them.
        let old = before.saturating_sub(1)..end;
        let from = (0 < before).then(|| objects[old.start].token as usize);
        let end = match objects.get(end) {
            Some(object) => (object.token as isize + grown) as usize,
            None => tree.len(),
        };
        let words = tree.words_from(from.unwrap_or(0));
        let words = words.take_while(|&(token, _)| token < end);
        let read = words.filter_map(|(token, word)| blocks::place(text, token, word));
        (old.start <= old.end).then(|| Self {
            edits,
            region: Some(one.old.to(last.old)),
            new: read.collect(),
            old,
            from,
            grown,
        })
    }

    /// The places of all objects.
    fn places(&self, origins: &Origins) -> Arc<Vec<ObjectPlace>> {
        let objects = &origins.objects;
        if self.grown == 0 && objects[self.old.clone()] == self.new {
            return Arc::clone(objects);
        }
        let mut places = Vec::with_capacity(objects.len() - self.old.len() + self.new.len());
        places.extend_from_slice(&objects[..self.old.start]);
        places.extend_from_slice(&self.new);
        places.extend(objects[self.old.end..].iter().map(|place| ObjectPlace {
            token: place.token.wrapping_add_signed(self.grown as i32),
            ..*place
        }));
        Arc::new(places)
    }

    /// The tokens that are read again, given the places of all objects.
    fn tokens(&self, tree: &Tokens, places: &[ObjectPlace]) -> Range<usize> {
        let token = |object: usize| {
            let place = places.get(object);
            place.map_or(tree.len(), |place| place.token as usize)
        };
        let from = self.from.unwrap_or_else(|| token(self.old.start));
        from..token(self.old.start + self.new.len())
    }

    /// The findings about objects that are not read again; `None` if they name objects that now have
    /// other numbers.
    fn kept_findings(
        &self,
        tree: &Tokens,
        places: &[ObjectPlace],
        before: &Findings,
    ) -> Option<Findings> {
        let first = places.first()?.token as usize;
        let read = self.tokens(tree, places);
        let mut kept = Findings::default();
        for found in before.iter() {
            let start = found.span.start();
            let is_in = |old: Span| old.range().contains(&start);
            if self.region.is_some_and(is_in) || self.edits.iter().any(|edit| is_in(edit.old)) {
                continue;
            }
            let moved = |span: Span| Span::new(self.moved(span.start()), self.moved(span.end()));
            let span = moved(found.span);
            // Findings about objects are reported at one of their tokens.
            let token = tree.partition_point(|token| token.start() < span.start());
            let place = tree.get(token);
            let is_token = place.is_some_and(|place| place.start() == span.start());
            if !is_token || token < first || read.contains(&token) {
                continue;
            }
            if read.end <= token && self.old.len() != self.new.len() {
                return None;
            }
            kept.warning(|| found.clone().moved(moved));
        }
        Some(kept)
    }

    /// Maps a place in the old text, outside the region, to the new one.
    fn moved(&self, place: usize) -> usize {
        let before = self.edits.iter().take_while(|edit| edit.old.end() <= place);
        let last = before.last();
        last.map_or(place, |edit| place - edit.old.end() + edit.new.end())
    }
}

/// If an edit replaced numbers by as many, between white space, the last one's token.
fn numbers_in_place(text: &str, tree: &Tokens, edit: &Replaced) -> Option<usize> {
    let (new, count) = (edit.new, edit.numbers);
    if count == 0 || numbers(new.of(text)) != count {
        return None;
    }
    let first = tree.partition_point(|token| token.start() < new.start());
    let last = first + count - 1;
    let is_start = tree.get(first)?.start() == new.start();
    let is_end = tree.get(last)?.end() == new.end();
    (is_start && is_end).then_some(last)
}

/// The objects and materials of a scene after some objects are replaced: the same as reading them
/// all would give.
fn replaced(scene: &Scene, old: Range<usize>, by: &Reader<'_>) -> (Objects, Materials) {
    let known = &scene.objects;
    let count = known.len() - old.len() + by.objects.len();
    let object = |at: usize| match at.checked_sub(old.start) {
        Some(new) if new < by.objects.len() => {
            let Object { shape, material } = &by.objects[new];
            let at = *material as usize;
            (shape, &by.materials[at / BLOCK][at % BLOCK])
        }
        moved => {
            let at = moved.map_or(at, |new| old.end + new - by.objects.len());
            let Object { shape, material } = &known[at];
            (shape, &scene.materials[*material as usize])
        }
    };
    let block = |number: usize| {
        let end = count.min((number + 1) * BLOCK);
        blocks::block(number, (number * BLOCK..end).map(object))
    };
    let first = old.start / BLOCK;
    // If the objects behind keep their numbers, so do their blocks.
    let [end, new_end] = if by.objects.len() == old.len() {
        [old.end.div_ceil(BLOCK); 2]
    } else {
        [known.blocks().len(), count.div_ceil(BLOCK)]
    };
    let made: Vec<_> = if new_end - first < MANY {
        (first..new_end).map(block).collect()
    } else {
        (first..new_end).into_par_iter().map(block).collect()
    };
    let (new_objects, new_materials): (Vec<_>, Vec<_>) = made.into_iter().unzip();
    let mut objects = known.blocks().to_vec();
    let mut materials = scene.materials.blocks().to_vec();
    objects.splice(first..end, new_objects);
    materials.splice(first..end, new_materials);
    (Objects::of_blocks(objects), Materials::of_blocks(materials))
}
