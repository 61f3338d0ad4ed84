//! Changes of text as values, each with its inverse.

use super::Span;

/// Replaces the text of a span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty to insert.
    pub span: Span,
    /// What stands there afterwards; empty to delete.
    pub text: String,
}

/// Applies edits, sorted and disjoint, all given in positions of the text before; returns the
/// edits that undo them, in positions of the text after.
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

/// The smallest single edit that turns `old` into `new` (common ends left alone, cut at character
/// boundaries), or `None` if they are equal.
pub fn smallest_edit(old: &str, new: &str) -> Option<Edit> {
    if old == new {
        return None;
    }
    let common = |pair: (u8, u8)| pair.0 == pair.1;
    let mut head = old
        .bytes()
        .zip(new.bytes())
        .take_while(|&pair| common(pair))
        .count();
    while !old.is_char_boundary(head) || !new.is_char_boundary(head) {
        head -= 1;
    }
    let (old_rest, new_rest) = (&old[head..], &new[head..]);
    let mut tail = old_rest
        .bytes()
        .rev()
        .zip(new_rest.bytes().rev())
        .take_while(|&pair| common(pair))
        .count();
    while !old_rest.is_char_boundary(old_rest.len() - tail)
        || !new_rest.is_char_boundary(new_rest.len() - tail)
    {
        tail -= 1;
    }
    Some(Edit {
        span: Span::new(head, old.len() - tail),
        text: new[head..new.len() - tail].to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn edits_are_given_in_positions_of_the_text_before() {
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
    fn the_smallest_edit_leaves_common_ends_alone() {
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

    proptest! {
        #[test]
        fn the_smallest_edit_leads_there_and_back(old in "[aé ]{0,9}", new in "[aé ]{0,9}") {
            let mut text = old.clone();
            let edits: Vec<_> = smallest_edit(&old, &new).into_iter().collect();
            let inverse = apply(&mut text, &edits);
            prop_assert_eq!(&text, &new);
            apply(&mut text, &inverse);
            prop_assert_eq!(&text, &old);
        }
    }
}
