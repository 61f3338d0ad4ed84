//! How much memory the tree of a text takes, before it is read.

use rayon::prelude::*;

use super::Language;
use crate::memory::{self, Need, OutOfMemory, megabytes};

/// Bytes that are counted at once.
const PIECE: usize = 1 << 18;

/// What a text holds, as far as one byte and the one before it tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// What stands between blanks.
    pub(super) tokens: u64,
    /// Those of them that begin with a letter.
    pub(super) words: u64,
    /// Those that begin as comments do.
    pub(super) comments: u64,
    pub(super) lines: u64,
    /// Signs that begin a start tag or anything like it.
    pub(super) openings: u64,
    pub(super) equals: u64,
}

/// Refuses a text whose tree does not fit into memory beside as many bytes of something else.
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

/// What so many things of a size take.
pub(super) fn each(count: u64, size: usize) -> u64 {
    count.saturating_mul(size as u64)
}

impl Counts {
    /// The most that so many bytes can hold, of each kind alone.
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
        let mut counts = Self::default();
        let mut before = b' ';
        for &byte in bytes {
            let begins = b' ' < byte && before <= b' ';
            counts.tokens += u64::from(begins);
            counts.words += u64::from(begins && byte.is_ascii_alphabetic());
            counts.comments += u64::from(begins && matches!(byte, b'/' | b'\\' | b'#'));
            counts.lines += u64::from(byte == b'\r' || byte == b'\n' && before != b'\r');
            counts.openings += u64::from(before == b'<' && byte != b'/');
            counts.equals += u64::from(byte == b'=');
            before = byte;
        }
        counts
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_counted() {
        let text = "sphere 1 2\n// a\r\n<a b='1'> </a>\r";
        let counted = Counts {
            tokens: 8,
            words: 3,
            comments: 1,
            lines: 3,
            openings: 1,
            equals: 1,
        };
        assert_eq!(Counts::of(text), counted);
        assert_eq!(fits(Language::Ray, text, 0), Ok(()));
    }

    #[test]
    fn no_text_needs_more_than_the_most_of_its_length() {
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
