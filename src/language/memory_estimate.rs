//! Estimates of the memory that a text's tree takes, made before it is parsed.

use rayon::prelude::*;

use super::Language;
use super::words::may_begin_word;
use memory::{Need, OutOfMemory, megabytes};
use text::counted;

/// Bytes counted in one parallel piece.
const PIECE: usize = 1 << 18;

/// What a text contains, as far as each byte and the one before it show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Runs between blanks.
    pub(super) tokens: u64,
    /// Tokens that may be words.
    pub(super) words: u64,
    /// Tokens that begin like comments.
    pub(super) comments: u64,
    pub(super) lines: u64,
    /// A `<` that begins a start tag or anything similar.
    pub(super) openings: u64,
    pub(super) equals: u64,
}

/// Fails if the text's tree does not fit into memory together with `beside` other bytes.
pub fn fits(language: Language, text: &str, beside: usize) -> Result<(), OutOfMemory> {
    let beside = beside as u64;
    let most = language.tree_bytes(&Counts::most(text.len() as u64));
    memory::check(most.saturating_add(beside), || Need {
        what: format!("{} of text", megabytes(text.len() as u64)),
        bytes: language
            .tree_bytes(&Counts::of(text))
            .saturating_add(beside),
    })
}

/// Fails if the scene of a tree does not fit into memory: of `count` parts, each called `noun` and
/// taking at most `size` bytes.
pub(super) fn scene_fits(count: usize, noun: &str, size: usize) -> Result<(), OutOfMemory> {
    let bytes = each(count as u64, size);
    memory::check(bytes, || Need {
        what: counted(count, noun),
        bytes,
    })
}

/// The bytes taken by `count` items of this size.
pub(super) fn each(count: u64, size: usize) -> u64 {
    count.saturating_mul(size as u64)
}

impl Counts {
    /// The maximum for a text of `len` bytes, of each kind by itself.
    fn most(len: u64) -> Self {
        Self {
            tokens: len / 2,
            words: len / 2,
            comments: len / 2,
            lines: len,
            openings: len / 3,
            equals: len / 4,
        }
    }

    fn of(text: &str) -> Self {
        let pieces = text.as_bytes().par_chunks(PIECE);
        pieces.map(Self::of_piece).reduce(Self::default, Self::and)
    }

    fn of_piece(bytes: &[u8]) -> Self {
        let begins = |before: u8, byte: u8| b' ' < byte && before <= b' ';
        Self {
            tokens: count(bytes, begins),
            words: count(bytes, |before, byte| {
                begins(before, byte) && may_begin_word(byte)
            }),
            comments: count(bytes, |before, byte| {
                begins(before, byte) && matches!(byte, b'/' | b'\\' | b'#')
            }),
            lines: count(bytes, |before, byte| {
                byte == b'\r' || byte == b'\n' && before != b'\r'
            }),
            openings: count(bytes, |before, byte| before == b'<' && byte != b'/'),
            equals: count(bytes, |_, byte| byte == b'='),
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            tokens: self.tokens + other.tokens,
            words: self.words + other.words,
            comments: self.comments + other.comments,
            lines: self.lines + other.lines,
            openings: self.openings + other.openings,
            equals: self.equals + other.equals,
        }
    }
}

/// Counts the bytes that meet a condition, given the byte before each, at first a blank.
fn count(bytes: &[u8], is: impl Fn(u8, u8) -> bool) -> u64 {
    /// The maximum of a `u8` counter, so that the compiler can vectorise the count.
    const BLOCK: usize = 255;
    let first = bytes.first().map_or(0, |&byte| u64::from(is(b' ', byte)));
    let behind = bytes.get(1..).unwrap_or_default();
    let blocks = bytes.chunks(BLOCK).zip(behind.chunks(BLOCK));
    let counts = blocks.map(|(before, block)| {
        let pairs = before.iter().zip(block);
        let add = |count, (&before, &byte): (&u8, &u8)| count + u8::from(is(before, byte));
        u64::from(pairs.fold(0, add))
    });
    first + counts.sum::<u64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_counted() {
        let text = "sphere 1 2 é\n// a\r\n<a b='1'> </a>\r";
        let counted = Counts {
            tokens: 9,
            words: 4,
            comments: 1,
            lines: 3,
            openings: 1,
            equals: 1,
        };
        assert_eq!(Counts::of(text), counted);
        assert_eq!(fits(Language::Ray, text, 0), Ok(()));
    }

    #[test]
    fn no_text_needs_more_than_the_maximum_for_its_length() {
        let texts = ["a a a ", "//\n", "#\n", "\n", "<a/>", "a='1' ", "1 "];
        for (language, text) in Language::ALL
            .iter()
            .flat_map(|language| texts.map(|text| (language, text)))
        {
            let text = text.repeat(1000);
            let most = language.tree_bytes(&Counts::most(text.len() as u64));
            assert!(
                language.tree_bytes(&Counts::of(&text)) <= most,
                "{language:?} {text:.9}"
            );
        }
    }
}
