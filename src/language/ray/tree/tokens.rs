//! The tokens of a text in two bytes each: how far a token is from the one before, and how long.
//!
//! They are kept by pieces of the text, lines of about 64 KiB together, whose tokens are known
//! without those before: pieces are read side by side, and read again alone when they are edited.

use std::ops::Range;

use rayon::prelude::*;

use crate::text::Span;

/// Tokens between two whose place a piece knows by heart.
const STRIDE: usize = 64;

/// Bytes of a token and of the space before it, or more.
const BYTES: usize = 4;

/// Stands for a distance or a length of this and more.
const LONG: usize = u8::MAX as usize;

/// The tokens of a text, in order.
#[derive(Clone, Debug, Default)]
pub struct Tokens {
    pieces: Vec<Piece>,
}

/// The tokens of some lines of a text. Places in it count from its start.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    /// Where its text begins.
    start: usize,
    /// How many tokens there are before it.
    first: usize,
    steps: Vec<Step>,
    /// Where every [`STRIDE`]th token's gap begins.
    marks: Vec<u32>,
    /// The tokens that begin with a letter, and where.
    words: Vec<(u32, u32)>,
    /// The tokens that a step can't tell of.
    long: Vec<(u32, Span)>,
}

/// From the end of one token to that of the next.
#[derive(Clone, Copy, Debug)]
struct Step {
    gap: u8,
    len: u8,
}

impl Piece {
    /// The piece at a place, without tokens as yet, of so many bytes.
    pub(super) fn new(place: &Range<usize>) -> Self {
        Self {
            start: place.start,
            steps: Vec::with_capacity(place.len() / BYTES),
            ..Self::default()
        }
    }

    /// Gives back room that it does not need.
    pub(super) fn shrink(&mut self) {
        self.steps.shrink_to_fit();
    }

    /// Adds a token behind the last one, which ends at `end`; all of it as places in the piece.
    #[inline]
    pub(super) fn push(&mut self, end: usize, token: Span, first: u8) {
        let number = self.steps.len() as u32;
        if number.is_multiple_of(STRIDE as u32) {
            self.marks.push(end as u32);
        }
        let (gap, len) = (token.start() - end, token.len());
        if LONG <= gap.max(len) {
            self.long.push((number, token));
        }
        if first.is_ascii_alphabetic() {
            self.words.push((number, token.start() as u32));
        }
        self.steps.push(Step {
            gap: gap.min(LONG) as u8,
            len: len.min(LONG) as u8,
        });
    }

    /// The span of a token, given the end of the one before.
    #[inline]
    fn span(&self, number: usize, end: usize) -> Span {
        let Step { gap, len } = self.steps[number];
        if usize::from(gap.max(len)) == LONG {
            return self.long_span(number);
        }
        let start = end + usize::from(gap);
        Span::new(start, start + usize::from(len))
    }

    #[cold]
    fn long_span(&self, number: usize) -> Span {
        let at = self
            .long
            .partition_point(|&(long, _)| (long as usize) < number);
        self.long[at].1
    }

    /// Where the token before one ends.
    fn end_before(&self, number: usize) -> usize {
        let mark = number / STRIDE;
        let near = self.marks.get(mark).map_or(0, |&end| end as usize);
        (mark * STRIDE..number).fold(near, |end, number| self.span(number, end).end())
    }

    /// The span of a token in the text.
    fn get(&self, number: usize) -> Span {
        self.span(number, self.end_before(number)).later(self.start)
    }
}

impl Tokens {
    /// The pieces to be read again when the bytes of `old` are edited, and the text that they take:
    /// whole lines before and after the edit, in places of the text before, which had this length.
    /// `is_line` tells of a place behind the edit whether a line begins there after it.
    pub(super) fn touched(
        &self,
        old: Span,
        len: usize,
        is_line: impl Fn(usize) -> bool,
    ) -> (Range<usize>, Range<usize>) {
        let pieces = &self.pieces;
        let after = pieces.partition_point(|piece| piece.start <= old.start());
        let first = after.saturating_sub(1);
        let behind = |piece: &Piece| old.end() <= piece.start && is_line(piece.start);
        let end = (first..pieces.len())
            .find(|&at| behind(&pieces[at]))
            .unwrap_or(pieces.len());
        let start = if after == 0 { 0 } else { pieces[first].start };
        let end_of_text = pieces.get(end).map_or(len, |piece| piece.start);
        (first..end, start..end_of_text)
    }

    /// Puts pieces in the place of others; those behind stand elsewhere now, by `grown` bytes.
    pub(super) fn replace(&mut self, pieces: Range<usize>, by: Vec<Piece>, grown: isize) {
        for piece in &mut self.pieces[pieces.end..] {
            piece.start = piece.start.wrapping_add_signed(grown);
        }
        self.pieces.splice(pieces, by);
        *self = Self::of(std::mem::take(&mut self.pieces));
    }

    /// Joins the pieces of a text.
    pub(super) fn of(mut pieces: Vec<Piece>) -> Self {
        // Of one without tokens it can't be said whether a place is before or behind.
        pieces.retain(|piece| !piece.steps.is_empty());
        let mut first = 0;
        for piece in &mut pieces {
            piece.first = first;
            first += piece.steps.len();
        }
        Self { pieces }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        let last = self.pieces.last();
        last.map_or(0, |piece| piece.first + piece.steps.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place of a token.
    pub fn get(&self, token: usize) -> Option<Span> {
        let piece = &self.pieces[self.piece_of(token)?];
        Some(piece.get(token - piece.first))
    }

    /// Appends the tokens of a range, as far as there are any.
    pub fn append_to(&self, spans: &mut Vec<Span>, range: Range<usize>) {
        let from = self.piece_of(range.start).unwrap_or(self.pieces.len());
        for piece in &self.pieces[from..] {
            if range.end <= piece.first {
                break;
            }
            let first = range.start.saturating_sub(piece.first);
            let last = piece.steps.len().min(range.end - piece.first);
            let mut end = piece.end_before(first);
            spans.extend((first..last).map(|number| {
                let span = piece.span(number, end);
                end = span.end();
                span.later(piece.start)
            }));
        }
    }

    /// The tokens of a range, as far as there are any.
    pub fn range(&self, range: Range<usize>) -> Vec<Span> {
        let range = range.start.min(self.len())..range.end.min(self.len());
        let mut spans = Vec::with_capacity(range.len());
        self.append_to(&mut spans, range);
        spans
    }

    /// All of them.
    pub fn all(&self) -> Vec<Span> {
        self.range(0..self.len())
    }

    /// Those that begin with an ASCII letter, in order, with their numbers.
    pub fn words(&self) -> impl ParallelIterator<Item = (usize, Span)> + '_ {
        self.pieces.par_iter().flat_map_iter(|piece| {
            piece.words.iter().map(|&(number, start)| {
                let (number, start) = (number as usize, start as usize);
                let before = start - usize::from(piece.steps[number].gap);
                let span = piece.span(number, before);
                (piece.first + number, span.later(piece.start))
            })
        })
    }

    /// The first token that does not fulfil what all before it do.
    pub fn partition_point(&self, fulfils: impl Fn(Span) -> bool) -> usize {
        let whole = |piece: &Piece| {
            let last = piece.steps.len().checked_sub(1);
            last.is_none_or(|last| fulfils(piece.get(last)))
        };
        let at = self.pieces.partition_point(whole);
        let Some(piece) = self.pieces.get(at) else {
            return self.len();
        };
        // Of each run between marks the first token tells whether all before it fulfil it.
        let runs: Vec<usize> = (0..piece.marks.len()).collect();
        let runs = runs.partition_point(|run| fulfils(piece.get(run * STRIDE)));
        let first = piece.first + runs.saturating_sub(1) * STRIDE;
        let spans = self.range(first..self.len().min(first + STRIDE));
        first + spans.partition_point(|&span| fulfils(span))
    }

    fn piece_of(&self, token: usize) -> Option<usize> {
        let after = self.pieces.partition_point(|piece| piece.first <= token);
        let at = after.checked_sub(1)?;
        let piece = &self.pieces[at];
        (token < piece.first + piece.steps.len()).then_some(at)
    }
}
