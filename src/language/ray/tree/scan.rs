//! The tokeniser: 64 bytes at once on plain lines, byte by byte on all others.

use std::ops::Range;

use rayon::prelude::*;

use super::tokens::{TokenBlock, Tokens};
use super::{begins_comment, has_key};
use crate::words::white_space;
use text::{Span, first_byte, is_line_end};

/// Bytes of text per piece: enough to be worth a task, few enough to be read again with every edit.
pub(super) const PIECE: usize = 1 << 16;

/// Bytes processed together.
const BLOCK: usize = 64;

/// Reads a text in pieces of about `piece` bytes.
pub(super) fn scan(text: &str, piece: usize) -> Tokens {
    Tokens::of(read(text, 0..text.len(), piece))
}

/// Updates the tree after edits in text order, each of which replaced the first span, of the text
/// before all of them, by the second, of the text after all of them.
pub(super) fn follow(tokens: &mut Tokens, text: &str, edits: &[[Span; 2]], piece: usize) {
    let growth = |[old, changed]: [Span; 2]| changed.len() as isize - old.len() as isize;
    // What follows is given in the text after the edits so far, which up to the next one is `text`.
    let mut len = edits.iter().map(|&edit| growth(edit)).sum::<isize>();
    len = text.len() as isize - len;
    let mut edits = edits.iter().copied();
    let mut next = edits.next();
    while let Some(first) = next {
        let mut changed = first[1];
        let mut grown = growth(first);
        loop {
            next = edits.next();
            let old = Span::new(changed.start(), changed.end().wrapping_add_signed(-grown));
            let is_line = |start: usize| {
                let before = start.wrapping_add_signed(grown).checked_sub(1);
                let byte = |before: usize| text.as_bytes().get(before);
                before.is_none_or(|before| byte(before).copied().is_some_and(is_line_end))
            };
            let (touched, lines) = tokens.touched(old, len as usize, is_line);
            let now = lines.start..lines.end.wrapping_add_signed(grown);
            // Edits of the same lines are followed together.
            if let Some(edit) = next
                && edit[1].start() <= now.end
            {
                changed = changed.to(edit[1]);
                grown += growth(edit);
                continue;
            }
            tokens.replace(touched, read(text, now, piece), grown);
            len += grown;
            break;
        }
    }
}

/// Reads whole lines of a text in pieces of about `piece` bytes.
fn read(text: &str, lines: Range<usize>, piece: usize) -> Vec<TokenBlock> {
    let pieces = cut(text, lines, piece);
    match &pieces[..] {
        [all] => vec![Scanner::read(text, all.clone())],
        // Smaller texts are done before other threads wake up.
        _ => pieces
            .into_par_iter()
            .map(|piece| Scanner::read(text, piece))
            .collect(),
    }
}

/// Cuts a text after line ends, which no token or comment contains, into at least one piece.
fn cut(text: &str, lines: Range<usize>, piece: usize) -> Vec<Range<usize>> {
    let bytes = &text.as_bytes()[..lines.end];
    let mut pieces = Vec::with_capacity(1 + lines.len() / piece);
    let mut start = lines.start;
    loop {
        let end = match bytes.get(start + piece..) {
            Some(rest) => start + piece + line_len(rest),
            None => bytes.len(),
        };
        pieces.push(start..end);
        start = end;
        if start == bytes.len() {
            return pieces;
        }
    }
}

/// The length of the first line, including its line ending or part of that.
fn line_len(bytes: &[u8]) -> usize {
    first_byte(bytes, is_line_end).map_or(bytes.len(), |end| end + 1)
}

/// A scanner of one piece of a text.
struct Scanner<'t> {
    text: &'t str,
    /// Start of the piece.
    start: usize,
    piece: TokenBlock,
    /// End of the last token, relative to the piece.
    end: usize,
}

impl<'t> Scanner<'t> {
    fn new(text: &'t str, range: &Range<usize>) -> Self {
        Self {
            text,
            start: range.start,
            piece: TokenBlock::new(range),
            end: 0,
        }
    }

    fn read(text: &'t str, range: Range<usize>) -> TokenBlock {
        let mut scanner = Self::new(text, &range);
        let mut at = range.start;
        while at < range.end {
            at = scanner.plain(at..range.end);
            // At least a block, or lines of a few bytes would also be read as blocks.
            let end = range.end.min(at + BLOCK);
            let end = end + line_len(&text.as_bytes()[end..range.end]);
            scanner.any(at..end);
            at = end;
        }
        scanner.piece.shrink();
        scanner.piece
    }

    /// Reads plain blocks; returns where it stopped, before a token.
    fn plain(&mut self, range: Range<usize>) -> usize {
        let bytes = &self.text.as_bytes()[..range.end];
        let mut at = range.start;
        // The start of a token that has no end yet.
        let mut open = None;
        while at < range.end {
            let mut block = [b' '; BLOCK];
            match bytes[at..].first_chunk() {
                Some(whole) => block = *whole,
                None => block[..range.end - at].copy_from_slice(&bytes[at..]),
            }
            let Some(blanks) = blanks(&block) else {
                return open.unwrap_or(at);
            };
            let blank_before = blanks << 1 | u64::from(open.is_none());
            let mut starts = !blanks & blank_before;
            let mut ends = blanks & !blank_before;
            while ends != 0 {
                let start = open.take().unwrap_or_else(|| {
                    let start = at + starts.trailing_zeros() as usize;
                    starts &= starts - 1;
                    start
                });
                self.token(start, at + ends.trailing_zeros() as usize);
                ends &= ends - 1;
            }
            if starts != 0 {
                open = Some(at + starts.trailing_zeros() as usize);
            }
            at += BLOCK;
        }
        if let Some(start) = open {
            self.token(start, range.end);
        }
        range.end
    }

    /// Reads any text, byte by byte.
    fn any(&mut self, range: Range<usize>) {
        let bytes = &self.text.as_bytes()[..range.end];
        let mut at = range.start;
        while at < range.end {
            if let Some(width) = white_space(&bytes[at..]) {
                at += width;
            } else if begins_comment(&bytes[at..]) {
                let end = at + first_byte(&bytes[at..], is_line_end).unwrap_or(range.end - at);
                if has_key(self.text, Span::new(at, end)) {
                    self.piece.push_keyed(at - self.start);
                }
                at = end;
            } else {
                let end = token_end(bytes, at);
                self.token(at, end);
                at = end;
            }
        }
    }

    #[inline]
    fn token(&mut self, start: usize, end: usize) {
        let token = Span::new(start - self.start, end - self.start);
        self.piece
            .push(self.end, token, self.text.as_bytes()[start]);
        self.end = token.end();
    }
}

/// A bit for each byte that is white space; `None` if some may begin a comment or are not plain.
///
/// Handles eight bytes at once, each below 128, so that no sum carries into the next byte.
#[inline]
fn blanks(block: &[u8; BLOCK]) -> Option<u64> {
    const EACH: u64 = u64::MAX / 255;
    const HIGH: u64 = 128 * EACH;
    let at_least = |bytes: u64, least: u8| bytes + EACH * u64::from(128 - least);
    let differ = |bytes: u64, byte: u8| (bytes ^ (EACH * u64::from(byte))) + EACH * 127;
    let mut blanks = 0;
    let mut odd = 0;
    for (number, bytes) in block.as_chunks().0.iter().enumerate() {
        let bytes = u64::from_le_bytes(*bytes);
        let low = bytes & !HIGH;
        let control = !at_least(low, b'\t') | (at_least(low, 0x0E) & !at_least(low, b' '));
        odd |= bytes | control | !differ(low, b'/') | !differ(low, b'\\');
        let blank = (!at_least(low, b' ' + 1) & HIGH) >> 7;
        // The products of different bytes share no bit; the highest byte collects one bit of each.
        blanks |= (blank.wrapping_mul(0x0102_0408_1020_4080) >> 56) << (8 * number);
    }
    (odd & HIGH == 0).then_some(blanks)
}

/// The end of the token that begins at `start`: before white space or a comment.
fn token_end(bytes: &[u8], start: usize) -> usize {
    let mut end = start + 1;
    while end < bytes.len()
        && white_space(&bytes[end..]).is_none()
        && !begins_comment(&bytes[end..])
    {
        end += 1;
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::tree::Window;
    use crate::words::may_begin_word;
    use proptest::prelude::*;
    use text::Edit;

    /// The tokens and the starts of view comments of a text, read byte by byte.
    fn read_plainly(text: &str) -> (Vec<Span>, Vec<usize>) {
        let mut scanner = Scanner::new(text, &(0..text.len()));
        scanner.any(0..text.len());
        all(&Tokens::of(vec![scanner.piece]))
    }

    fn all(tokens: &Tokens) -> (Vec<Span>, Vec<usize>) {
        (tokens.range(0..tokens.len()), tokens.keyed().collect())
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn a_tree_follows_its_text(
            text in "([-0-9.]{0,3}[ \n\r\t]{0,2}|//|/|// ?view:|\\\\\\\\|é|\u{A0}){0,30}",
            edits in prop::collection::vec(
                (any::<prop::sample::Index>(), any::<prop::sample::Index>(), "[/\n\r 1a]{0,4}"),
                1..6,
            ),
            piece in 1usize..20,
        ) {
            let mut text = text;
            let mut tree = scan(&text, piece);
            for (one, other, put) in edits {
                let places: Vec<_> = (0..=text.len()).filter(|&at| text.is_char_boundary(at)).collect();
                let (one, other) = (*one.get(&places), *other.get(&places));
                let old = Span::new(one.min(other), one.max(other).min(one.min(other) + 9));
                if !text.is_char_boundary(old.end()) {
                    continue;
                }
                text.replace_range(old.range(), &put);
                let changed = Span::new(old.start(), old.start() + put.len());
                follow(&mut tree, &text, &[[old, changed]], piece);
                prop_assert_eq!(all(&tree), read_plainly(&text), "{:?}", text);
            }
        }

        #[test]
        fn a_tree_follows_edits_made_together(
            text in "([-0-9.]{0,3}[ \n\r\t]{0,2}|//|/|// ?view:|\\\\\\\\|é|\u{A0}){0,60}",
            places in prop::collection::vec(any::<prop::sample::Index>(), 2..12),
            puts in prop::collection::vec("[/\n\r 1a]{0,4}", 6),
            piece in 1usize..20,
        ) {
            let ends: Vec<_> = (0..=text.len()).filter(|&at| text.is_char_boundary(at)).collect();
            let mut places: Vec<_> = places.iter().map(|place| *place.get(&ends)).collect();
            places.sort_unstable();
            let edits: Vec<_> = places.chunks_exact(2).zip(puts).map(|(ends, text)| Edit {
                span: Span::new(ends[0], ends[1].min(ends[0] + 9)),
                text,
            }).collect();
            prop_assume!(edits.iter().all(|edit| text.is_char_boundary(edit.span.end())));
            let mut tree = scan(&text, piece);
            let mut text = text;
            let inverse = text::apply(&mut text, &edits);
            let spans: Vec<_> = edits.iter().zip(&inverse).map(|(edit, back)| [edit.span, back.span]).collect();
            follow(&mut tree, &text, &spans, piece);
            prop_assert_eq!(all(&tree), read_plainly(&text), "{:?}", text);
        }

        #[test]
        fn blocks_and_pieces_give_the_tokens_of_bytes(
            text in "([-0-9.]{0,9}[ \n\t\r]{0,3}|[ -~\t-\r\x01]|//|\\\\\\\\|\u{A0}|é){0,60}( {270}| {0,3})[a-z]{0,300}[ -~\n]{0,80}",
            piece in 1usize..90,
        ) {
            let tree = scan(&text, piece);
            prop_assert_eq!(all(&tree), read_plainly(&text));
            let (tokens, _) = read_plainly(&text);
            let letters = |&(_, token): &(usize, Span)| may_begin_word(text.as_bytes()[token.start()]);
            prop_assert_eq!(tree.len(), tokens.len());
            let words: Vec<_> = tree.words().collect();
            prop_assert!(words.into_iter().eq((0..).zip(tokens.iter().copied()).filter(letters)));
            for at in 0..=tokens.len() {
                prop_assert_eq!(tree.get(at), tokens.get(at).copied());
                let to = tokens.len().min(at + 3);
                prop_assert_eq!(tree.range(at..at + 3), &tokens[at..to]);
                let words = tree.words_from(at);
                prop_assert!(words.eq((at..).zip(tokens[at..].iter().copied()).filter(letters)));
            }
            let mut window = Window::new(&tree, 0..tokens.len());
            for at in (0..=tokens.len()).step_by(7) {
                window.slide(at);
                let to = tokens.len().min(at + 64);
                prop_assert_eq!(window.ahead(at, to - at), Some(&tokens[at..to]));
                prop_assert_eq!(window.get(tokens.len() - at), tokens.get(tokens.len() - at).copied());
            }
            for place in 0..text.len() {
                let before = |span: &Span| span.end() <= place;
                let found = tree.partition_point(|span| before(&span));
                prop_assert_eq!(found, tokens.partition_point(before));
            }
        }
    }
}
