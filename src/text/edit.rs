//! Text edits as values, and their inverses.

use super::Span;

/// Bytes compared at once, which is many times faster than one by one.
const BLOCK: usize = 4096;

/// A replacement of the text in a span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The span to replace; empty to insert.
    pub span: Span,
    /// The new text; empty to delete.
    pub text: String,
}

impl Edit {
    /// Sorts edits by their places; those at one place keep their order.
    pub fn sort(edits: &mut [Self]) {
        edits.sort_by_key(|edit| edit.span);
    }

    /// The span of the new text after the edit.
    pub fn placed(&self) -> Span {
        let start = self.span.start();
        Span::new(start, start + self.text.len())
    }
}

/// The smallest span that covers the spans of all edits; `None` if there are none.
pub fn cover(edits: &[Edit]) -> Option<Span> {
    edits.iter().map(|edit| edit.span).reduce(Span::to)
}

/// Applies sorted, disjoint edits, whose spans refer to the text before all of them. Returns the
/// inverse edits, whose spans refer to the text after all of them.
pub fn apply(text: &mut String, edits: &[Edit]) -> Vec<Edit> {
    debug_assert!(
        edits
            .windows(2)
            .all(|pair| pair[0].span.end() <= pair[1].span.start()),
        "edits are sorted and disjoint"
    );
    let mut inverse = Vec::with_capacity(edits.len());
    let (mut removed, mut inserted) = (0, 0);
    for edit in edits {
        let start = edit.span.start() + inserted - removed;
        inverse.push(Edit {
            span: Span::new(start, start + edit.text.len()),
            text: edit.span.of(text).to_owned(),
        });
        removed += edit.span.len();
        inserted += edit.text.len();
    }
    for edit in edits.iter().rev() {
        text.replace_range(edit.span.range(), &edit.text);
    }
    inverse
}

/// The smallest single edit that turns `old` into `new`: everything except their common prefix and
/// suffix, cut at character boundaries. `None` if they are equal.
pub fn smallest_edit(old: &str, new: &str) -> Option<Edit> {
    let [span, changed] = difference(old, new)?;
    Some(Edit {
        span,
        text: changed.of(new).to_owned(),
    })
}

/// The differing span of each text: everything except their common prefix and suffix, cut at
/// character boundaries. `None` if they are equal.
pub fn difference(old: &str, new: &str) -> Option<[Span; 2]> {
    if old == new {
        return None;
    }
    let head = common_prefix(old, new);
    let (old_rest, new_rest) = (&old[head..], &new[head..]);
    let mut tail = common_suffix(old_rest.as_bytes(), new_rest.as_bytes());
    while !old_rest.is_char_boundary(old_rest.len() - tail)
        || !new_rest.is_char_boundary(new_rest.len() - tail)
    {
        tail -= 1;
    }
    Some([old.len(), new.len()].map(|len| Span::new(head, len - tail)))
}

/// The length of the common prefix in bytes, cut at a character boundary.
pub fn common_prefix(old: &str, new: &str) -> usize {
    let mut head = common_bytes(old.as_bytes(), new.as_bytes());
    while !old.is_char_boundary(head) || !new.is_char_boundary(head) {
        head -= 1;
    }
    head
}

/// The number of equal bytes at the start.
fn common_bytes(old: &[u8], new: &[u8]) -> usize {
    let blocks = old.chunks_exact(BLOCK).zip(new.chunks_exact(BLOCK));
    let whole = BLOCK * blocks.take_while(|(old, new)| old == new).count();
    let rest = old[whole..].iter().zip(&new[whole..]);
    whole + rest.take_while(|(old, new)| old == new).count()
}

/// The length of the common suffix, in bytes.
fn common_suffix(old: &[u8], new: &[u8]) -> usize {
    let blocks = old.rchunks_exact(BLOCK).zip(new.rchunks_exact(BLOCK));
    let whole = BLOCK * blocks.take_while(|(old, new)| old == new).count();
    let (old, new) = (&old[..old.len() - whole], &new[..new.len() - whole]);
    let rest = old.iter().rev().zip(new.iter().rev());
    whole + rest.take_while(|(old, new)| old == new).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn spans_of_edits_refer_to_the_text_before() {
        let mut text = "one two three".to_owned();
        let edits = [
            Edit {
                span: Span::new(0, 3),
                text: "1".into(),
            },
            Edit {
                span: Span::at(4),
                text: "and ".into(),
            },
            Edit {
                span: Span::new(8, 13),
                text: String::new(),
            },
        ];
        let inverse = apply(&mut text, &edits);
        assert_eq!(text, "1 and two ");
        apply(&mut text, &inverse);
        assert_eq!(text, "one two three");
    }

    #[test]
    fn the_smallest_edit_excludes_common_prefix_and_suffix() {
        let check = |old: &str, new: &str, span: (usize, usize), text: &str| {
            let edit = smallest_edit(old, new).expect("the texts differ");
            assert_eq!(
                (edit.span, edit.text.as_str()),
                (Span::new(span.0, span.1), text)
            );
        };
        check("a 1 b", "a 22 b", (2, 3), "22");
        check("aa", "aaa", (2, 2), "a");
        check("é", "è", (0, 2), "è");
        check("x", "", (0, 1), "");
        assert_eq!(smallest_edit("same", "same"), None);
    }

    #[test]
    fn the_smallest_edit_is_found_in_long_texts() {
        let old = "a".repeat(3 * BLOCK + 5);
        for at in [0, 5, BLOCK - 1, BLOCK, BLOCK + 5, 3 * BLOCK + 4] {
            for (len, text) in [(1, "b"), (0, "b"), (1, "é"), (2.min(old.len() - at), "")] {
                let span = Span::new(at, at + len);
                let edit = Edit {
                    span,
                    text: text.to_owned(),
                };
                let mut new = old.clone();
                apply(&mut new, std::slice::from_ref(&edit));
                // A deletion among equal letters is ambiguous; the last place is taken.
                let last = Span::new(old.len() - len, old.len());
                let span = if text.is_empty() { last } else { span };
                assert_eq!(smallest_edit(&old, &new), Some(Edit { span, ..edit }));
            }
        }
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn the_smallest_edit_round_trips(old in "[aé ]{0,9}", new in "[aé ]{0,9}") {
            let mut text = old.clone();
            let edits: Vec<_> = smallest_edit(&old, &new).into_iter().collect();
            let inverse = apply(&mut text, &edits);
            prop_assert_eq!(&text, &new);
            apply(&mut text, &inverse);
            prop_assert_eq!(&text, &old);
        }
    }
}
