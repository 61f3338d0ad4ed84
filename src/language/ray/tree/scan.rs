//! Text → tokens and comments: plain lines by 64 bytes at once, all others byte by byte.

use std::ops::Range;

use rayon::prelude::*;

use super::tokens::{Piece, Tokens};
use super::{Comment, Marker, Tree};
use crate::language::{trim_end, white_space};
use crate::text::{Span, is_line_end};

/// Bytes of text that are read at once: enough to be worth a task, few enough to be read again
/// with every edit in them.
pub(super) const PIECE: usize = 1 << 16;

/// Bytes that are looked at together.
const BLOCK: usize = 64;

/// Reads a text by pieces of about so many bytes.
pub(super) fn scan(text: &str, piece: usize) -> Tree {
    let (pieces, comments) = read(text, 0..text.len(), piece);
    let tokens = Tokens::of(pieces);
    Tree { tokens, comments }
}

/// Makes the tree of a text that of the text after an edit, of which `changed` is what it put in the
/// place of the bytes `old`.
pub(super) fn follow(tree: &mut Tree, text: &str, old: Span, changed: Span, piece: usize) {
    let grown = changed.len() as isize - old.len() as isize;
    let len = text.len().wrapping_add_signed(-grown);
    let is_line = |start: usize| {
        let before = start.wrapping_add_signed(grown).checked_sub(1);
        before.is_none_or(|before| is_line_end(text.as_bytes()[before]))
    };
    let (touched, lines) = tree.tokens.touched(old, len, is_line);
    let now = lines.start..lines.end.wrapping_add_signed(grown);
    let (pieces, found) = read(text, now, piece);
    tree.tokens.replace(touched, pieces, grown);
    let comments = &mut tree.comments;
    let before = |place: usize| move |comment: &Comment| comment.span.start() < place;
    let first = comments.partition_point(before(lines.start));
    let end = comments.partition_point(before(lines.end));
    for comment in &mut comments[end..] {
        let start = comment.span.start().wrapping_add_signed(grown);
        comment.span = Span::new(start, start + comment.span.len());
    }
    comments.splice(first..end, found);
}

/// Reads whole lines of a text by pieces of about so many bytes.
fn read(text: &str, lines: Range<usize>, piece: usize) -> (Vec<Piece>, Vec<Comment>) {
    let pieces = cut(text, lines, piece);
    let read: Vec<_> = match &pieces[..] {
        [all] => vec![Reader::read(text, all.clone())],
        // Smaller texts are read before other threads are awake.
        _ => pieces
            .into_par_iter()
            .map(|piece| Reader::read(text, piece))
            .collect(),
    };
    let mut comments = Vec::new();
    let pieces = read.into_iter().map(|reader| {
        comments.extend(reader.comments);
        reader.piece
    });
    (pieces.collect(), comments)
}

/// Cuts a text behind line ends, which neither tokens nor comments contain. One piece at least.
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

/// The length of the line that bytes begin with, and of its end or a part of that.
fn line_len(bytes: &[u8]) -> usize {
    let end = bytes.iter().position(|&byte| is_line_end(byte));
    end.map_or(bytes.len(), |end| end + 1)
}

/// A piece of a text that is being read.
struct Reader<'t> {
    text: &'t str,
    /// Where the piece begins.
    start: usize,
    piece: Piece,
    comments: Vec<Comment>,
    /// Where the last token ends, from the piece's start.
    end: usize,
}

impl<'t> Reader<'t> {
    fn read(text: &'t str, range: Range<usize>) -> Self {
        let mut reader = Self {
            text,
            start: range.start,
            piece: Piece::new(&range),
            comments: Vec::new(),
            end: 0,
        };
        let mut at = range.start;
        while at < range.end {
            at = reader.plain(at..range.end);
            let line = line_len(&text.as_bytes()[at..range.end]);
            reader.any(at..at + line);
            at += line;
        }
        reader.piece.shrink();
        reader
    }

    /// Reads plain blocks; where it stopped, before a token.
    fn plain(&mut self, range: Range<usize>) -> usize {
        let bytes = &self.text.as_bytes()[..range.end];
        let mut at = range.start;
        // Where a token began that has no end as yet.
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

    /// Reads whatever there is.
    fn any(&mut self, range: Range<usize>) {
        let bytes = &self.text.as_bytes()[..range.end];
        let mut at = range.start;
        while at < range.end {
            if let Some(width) = white_space(&bytes[at..]) {
                at += width;
            } else if let Some(marker) = comment_marker(&bytes[at..]) {
                let end = bytes[at..].iter().position(|&byte| is_line_end(byte));
                let end = end.map_or(range.end, |len| at + len);
                self.comments.push(Comment {
                    span: trim_end(self.text, Span::new(at, end)),
                    marker,
                });
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
/// Eight bytes at once, each of them below 128, so that no sum reaches the next one.
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
        // The products of different bytes meet in no bit; the highest byte gathers one of each.
        blanks |= (blank.wrapping_mul(0x0102_0408_1020_4080) >> 56) << (8 * number);
    }
    (odd & HIGH == 0).then_some(blanks)
}

fn comment_marker(bytes: &[u8]) -> Option<Marker> {
    match bytes {
        [b'/', b'/', ..] => Some(Marker::Slashes),
        [b'\\', b'\\', ..] => Some(Marker::Backslashes),
        _ => None,
    }
}

/// Where the token that begins at `start` ends: before white space or a comment.
fn token_end(bytes: &[u8], start: usize) -> usize {
    let mut end = start + 1;
    while end < bytes.len()
        && white_space(&bytes[end..]).is_none()
        && comment_marker(&bytes[end..]).is_none()
    {
        end += 1;
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A text's leaves, read byte by byte.
    fn read_plainly(text: &str) -> (Vec<Span>, Vec<Comment>) {
        let mut reader = Reader {
            text,
            start: 0,
            piece: Piece::new(&(0..text.len())),
            comments: Vec::new(),
            end: 0,
        };
        reader.any(0..text.len());
        (Tokens::of(vec![reader.piece]).all(), reader.comments)
    }

    proptest! {
        #[test]
        fn a_tree_follows_its_text(
            text in "([-0-9.]{0,3}[ \n\r\t]{0,2}|//|/|\\\\\\\\|é|\u{A0}){0,30}",
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
                follow(&mut tree, &text, old, changed, piece);
                let (tokens, comments) = read_plainly(&text);
                prop_assert_eq!(tree.tokens.all(), tokens, "{:?}", text);
                prop_assert_eq!(&tree.comments, &comments);
            }
        }

        #[test]
        fn blocks_and_pieces_are_read_as_bytes_are(
            text in "([-0-9.]{0,9}[ \n\t\r]{0,3}|[ -~\t-\r\x01]|//|\\\\\\\\|\u{A0}|é){0,60}( {270}| {0,3})[a-z]{0,300}[ -~\n]{0,80}",
            piece in 1usize..90,
        ) {
            let (tokens, comments) = read_plainly(&text);
            let tree = scan(&text, piece);
            prop_assert_eq!(tree.tokens.all(), &tokens[..]);
            prop_assert_eq!(tree.comments, comments);
            prop_assert_eq!(tree.tokens.len(), tokens.len());
            let letters = |&(_, token): &(usize, Span)| text.as_bytes()[token.start()].is_ascii_alphabetic();
            let words: Vec<_> = tree.tokens.words().collect();
            prop_assert!(words.into_iter().eq((0..).zip(tokens.iter().copied()).filter(letters)));
            for at in 0..=tokens.len() {
                prop_assert_eq!(tree.tokens.get(at), tokens.get(at).copied());
                let to = tokens.len().min(at + 3);
                prop_assert_eq!(tree.tokens.range(at..at + 3), &tokens[at..to]);
            }
            for place in 0..text.len() {
                let before = |span: &Span| span.end() <= place;
                let found = tree.tokens.partition_point(|span| before(&span));
                prop_assert_eq!(found, tokens.partition_point(before));
            }
        }
    }
}
