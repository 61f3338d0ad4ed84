//! The tokens of a text in two bytes each: the gap to the previous token and the length.
//!
//! They are grouped into pieces, whole lines of about 64 KiB together, whose tokens do not depend
//! on the text before: pieces are read in parallel, and an edit reads only its own again.

use std::ops::Range;

use rayon::prelude::*;

use crate::partition::partition_point;
use crate::words::may_begin_word;
use text::Span;

/// Number of tokens between two whose offsets are stored.
const STRIDE: usize = 64;

/// Lower estimate of the bytes of a token and the space before it.
const BYTES: usize = 4;

/// Marks a gap or a length of this or more.
const LONG: usize = u8::MAX as usize;

/// The tokens of a text, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tokens {
    pieces: Vec<TokenBlock>,
}

/// The tokens of some lines of a text. Its offsets count from its start.
#[derive(Clone, Debug, Default)]
pub(super) struct TokenBlock {
    /// Offset of its text.
    start: usize,
    /// Number of tokens before it.
    first: usize,
    steps: Vec<Advance>,
    /// Start of the gap before every [`STRIDE`]th token.
    marks: Vec<u32>,
    /// Index and start of each token that may be a word.
    words: Vec<(u32, u32)>,
    /// Tokens whose gap or length is too large for a step.
    long: Vec<(u32, Span)>,
    /// Start of each comment with a key.
    keyed: Vec<u32>,
}

/// The distance from the end of one token to the end of the next.
#[derive(Clone, Copy, Debug)]
struct Advance {
    gap: u8,
    len: u8,
}

impl TokenBlock {
    /// An empty piece for this range of the text.
    pub(super) fn new(place: &Range<usize>) -> Self {
        Self {
            start: place.start,
            steps: Vec::with_capacity(place.len() / BYTES),
            ..Self::default()
        }
    }

    /// Releases unused capacity.
    pub(super) fn shrink(&mut self) {
        self.steps.shrink_to_fit();
    }

    /// Adds a comment with a key that begins at this offset in the piece.
    pub(super) fn push_keyed(&mut self, start: usize) {
        self.keyed.push(start as u32);
    }

    /// Adds a token after the last one, which ends at `end`; both are offsets in the piece.
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
        if may_begin_word(first) {
            self.words.push((number, token.start() as u32));
        }
        self.steps.push(Advance {
            gap: gap.min(LONG) as u8,
            len: len.min(LONG) as u8,
        });
    }

    /// The span of a token, given the end of the previous one.
    #[inline]
    fn span(&self, number: usize, end: usize) -> Span {
        let Advance { gap, len } = self.steps[number];
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

    /// The end of the token before one.
    fn end_before(&self, number: usize) -> usize {
        let mark = number / STRIDE;
        let near = self.marks.get(mark).map_or(0, |&end| end as usize);
        (mark * STRIDE..number).fold(near, |end, number| self.span(number, end).end())
    }

    /// The span of a token in the text.
    fn get(&self, number: usize) -> Span {
        self.span(number, self.end_before(number))
            .shifted(self.start)
    }

    /// The tokens from one on that may be words, with their indices in the text.
    fn words(&self, from: usize) -> impl Iterator<Item = (usize, Span)> + '_ {
        let first = self
            .words
            .partition_point(|&(number, _)| (number as usize) < from);
        self.words[first..].iter().map(|&(number, start)| {
            let (number, start) = (number as usize, start as usize);
            let before = start - usize::from(self.steps[number].gap);
            let span = self.span(number, before);
            (self.first + number, span.shifted(self.start))
        })
    }
}

impl Tokens {
    /// The pieces to read again after an edit of the bytes `old`, and the text they cover: whole
    /// lines before and after the edit, as offsets in the old text, of length `len`. `is_line`
    /// tells whether an old offset behind the edit is now the start of a line.
    pub(super) fn touched(
        &self,
        old: Span,
        len: usize,
        is_line: impl Fn(usize) -> bool,
    ) -> (Range<usize>, Range<usize>) {
        let pieces = &self.pieces;
        let after = pieces.partition_point(|piece| piece.start <= old.start());
        let first = after.saturating_sub(1);
        let behind = |piece: &TokenBlock| old.end() <= piece.start && is_line(piece.start);
        let end = (first..pieces.len())
            .find(|&at| behind(&pieces[at]))
            .unwrap_or(pieces.len());
        let start = if after == 0 { 0 } else { pieces[first].start };
        let end_of_text = pieces.get(end).map_or(len, |piece| piece.start);
        (first..end, start..end_of_text)
    }

    /// Replaces pieces and shifts those behind by `grown` bytes.
    pub(super) fn replace(&mut self, pieces: Range<usize>, by: Vec<TokenBlock>, grown: isize) {
        for piece in &mut self.pieces[pieces.end..] {
            piece.start = piece.start.wrapping_add_signed(grown);
        }
        self.pieces.splice(pieces, by);
        *self = Self::of(std::mem::take(&mut self.pieces));
    }

    /// Joins the pieces of a text.
    pub(super) fn of(mut pieces: Vec<TokenBlock>) -> Self {
        let mut first = 0;
        for piece in &mut pieces {
            piece.first = first;
            first += piece.steps.len();
        }
        Self { pieces }
    }

    /// The number of tokens.
    pub(crate) fn len(&self) -> usize {
        let last = self.pieces.last();
        last.map_or(0, |piece| piece.first + piece.steps.len())
    }

    /// The span of a token.
    pub(crate) fn get(&self, token: usize) -> Option<Span> {
        let piece = &self.pieces[self.piece_of(token)?];
        Some(piece.get(token - piece.first))
    }

    /// Appends the tokens of a range, clipped to those that exist.
    pub(crate) fn append_to(&self, spans: &mut Vec<Span>, range: Range<usize>) {
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
                span.shifted(piece.start)
            }));
        }
    }

    /// The tokens of a range, clipped to those that exist.
    pub(crate) fn range(&self, range: Range<usize>) -> Vec<Span> {
        let range = range.start.min(self.len())..range.end.min(self.len());
        let mut spans = Vec::with_capacity(range.len());
        self.append_to(&mut spans, range);
        spans
    }

    /// The tokens that begin with a letter or outside ASCII, in order, with their indices.
    pub(crate) fn words(&self) -> impl ParallelIterator<Item = (usize, Span)> + '_ {
        self.pieces.par_iter().flat_map_iter(|piece| piece.words(0))
    }

    /// Such tokens from an index on.
    pub(crate) fn words_from(&self, token: usize) -> impl Iterator<Item = (usize, Span)> + '_ {
        let from = self.piece_of(token).unwrap_or(self.pieces.len());
        let pieces = self.pieces[from..].iter();
        pieces.flat_map(move |piece| piece.words(token.saturating_sub(piece.first)))
    }

    /// The start of each comment with a key.
    pub(crate) fn keyed(&self) -> impl Iterator<Item = usize> + '_ {
        let pieces = self.pieces.iter();
        pieces.flat_map(|piece| piece.keyed.iter().map(|&at| piece.start + at as usize))
    }

    /// The index of the first token for which a condition fails that holds for exactly a prefix.
    pub(crate) fn partition_point(&self, fulfils: impl Fn(Span) -> bool) -> usize {
        partition_point(self.len(), |at| self.get(at).is_some_and(&fulfils))
    }

    /// The piece that holds a token. Pieces without tokens may precede it.
    fn piece_of(&self, token: usize) -> Option<usize> {
        let after = self.pieces.partition_point(|piece| piece.first <= token);
        let at = after.checked_sub(1)?;
        let piece = &self.pieces[at];
        (token < piece.first + piece.steps.len()).then_some(at)
    }
}
