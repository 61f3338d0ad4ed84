//! Sequential access to tokens: those around the reader are cached as spans.

use std::ops::Range;

use super::Tokens;
use text::Span;

/// Number of tokens converted to spans at once: few enough for a core's cache.
const SPANS: usize = 2048;

/// Number of tokens that can be looked at ahead without a slow look-up.
const AHEAD: usize = 64;

/// A range of a text's tokens.
#[derive(Clone, Debug)]
pub(in crate::ray) struct Window<'a> {
    tokens: &'a Tokens,
    /// Index of the token after the last.
    end: usize,
    /// Index of the token of the first cached span.
    first: usize,
    spans: Vec<Span>,
}

impl<'a> Window<'a> {
    /// The tokens of a range, clipped to those that exist.
    pub(in crate::ray) fn new(tokens: &'a Tokens, range: Range<usize>) -> Self {
        Self {
            tokens,
            end: range.end.min(tokens.len()),
            first: range.start,
            spans: Vec::new(),
        }
    }

    /// The index of the token after the last one.
    pub(in crate::ray) fn end(&self) -> usize {
        self.end
    }

    /// Caches the tokens from one on.
    #[inline]
    pub(in crate::ray) fn slide(&mut self, token: usize) {
        let known = self.first..self.first + self.spans.len();
        if token < known.start || known.end < self.end.min(token + AHEAD) {
            self.fill(token);
        }
    }

    #[cold]
    fn fill(&mut self, token: usize) {
        self.first = token;
        self.spans.clear();
        let range = token..self.end.min(token + SPANS);
        self.tokens.append_to(&mut self.spans, range);
    }

    /// The span of a token.
    #[inline]
    pub(in crate::ray) fn get(&self, token: usize) -> Option<Span> {
        match self.spans.get(token.wrapping_sub(self.first)) {
            Some(&span) => Some(span),
            None if token < self.end => self.tokens.get(token),
            None => None,
        }
    }

    /// The spans of `count` tokens from one that the window was slid to; `None` if there are fewer.
    #[inline]
    pub(in crate::ray) fn ahead(&self, token: usize, count: usize) -> Option<&[Span]> {
        debug_assert!(count <= AHEAD, "the window reaches so far");
        let first = token.wrapping_sub(self.first);
        self.spans.get(first..first.checked_add(count)?)
    }

    /// The tokens from one on that begin with a letter or outside ASCII, in order, with their indices.
    pub(in crate::ray) fn words_from(
        &self,
        token: usize,
    ) -> impl Iterator<Item = (usize, Span)> + '_ {
        let words = self.tokens.words_from(token);
        words.take_while(|&(number, _)| number < self.end)
    }
}
