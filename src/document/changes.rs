//! The places at which a text differs from another: few and far apart in a large scene, so that what
//! lies between them need not be looked at.

use text::Span;

/// A span of a text that is replaced by a span of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// The span in the base that is replaced.
    pub(super) base: Span,
    /// The span in the other text that replaces it.
    pub(super) other: Span,
}

/// How changes are told apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Texts that differ over no more than this many bytes have one change.
    pub(super) near: usize,
    /// How far behind a difference a place is sought from which both texts go on alike.
    pub(super) reach: usize,
    /// For how many bytes they must go on alike.
    pub(super) alike: usize,
    /// The maximum number of changes.
    pub(super) most: usize,
}

/// A few objects are alike at most.
pub(super) const LIMITS: Limits = Limits {
    near: 1 << 14,
    reach: 1 << 13,
    alike: 1 << 8,
    most: 1 << 10,
};

/// The changes from `base` to `other`, in order. Outside of them the texts are equal.
pub(super) fn changes(base: &str, other: &str, limits: Limits) -> Vec<Change> {
    let Some([old, new]) = text::difference(base, other) else {
        return Vec::new();
    };
    let whole = Change {
        base: old,
        other: new,
    };
    if old.len().min(new.len()) <= limits.near {
        return vec![whole];
    }
    apart([base, other], whole, limits).unwrap_or_else(|| vec![whole])
}

/// Divides a change where the texts go on alike; `None` if it has too many parts.
fn apart(texts: [&str; 2], whole: Change, limits: Limits) -> Option<Vec<Change>> {
    let ends = [whole.base.end(), whole.other.end()];
    let mut at = [whole.base.start(), whole.other.start()];
    let mut changes = Vec::new();
    while at != ends {
        let next = resumption(texts, at, ends, limits).unwrap_or(ends);
        changes.push(Change {
            base: Span::new(at[0], next[0]),
            other: Span::new(at[1], next[1]),
        });
        if limits.most < changes.len() {
            return None;
        }
        let rest = |side: usize| &texts[side][next[side]..ends[side]];
        let alike = text::common_prefix(rest(0), rest(1));
        at = next.map(|start| start + alike);
    }
    Some(changes)
}

/// The nearest pair of line starts behind a difference from which both texts go on alike.
fn resumption(
    texts: [&str; 2],
    at: [usize; 2],
    ends: [usize; 2],
    limits: Limits,
) -> Option<[usize; 2]> {
    let [old, new] = [0, 1].map(|side| starts(&texts[side][..ends[side]], at[side], limits.reach));
    let from = |side: usize, start: usize| {
        let text = &texts[side].as_bytes()[..ends[side]];
        text.get(start..start + limits.alike)
    };
    let pairs = (0..old.len() + new.len()).flat_map(|sum| {
        let first = (sum + 1).saturating_sub(new.len());
        (first..old.len().min(sum + 1)).map(move |line| [line, sum - line])
    });
    pairs
        .map(|[line, of_other]| [old[line], new[of_other]])
        .find(|&[start, of_other]| {
            let alike = from(0, start);
            alike.is_some() && alike == from(1, of_other)
        })
}

/// The starts of the lines behind an offset, as far as `reach`, the offset itself first if it is one.
fn starts(text: &str, at: usize, reach: usize) -> Vec<usize> {
    let first = if text::line_start(text, at) == at {
        at
    } else {
        text::next_line(text, at)
    };
    let mut starts = Vec::new();
    let mut start = first;
    while start < text.len() && start - at <= reach {
        starts.push(start);
        start = text::next_line(text, start);
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use text::Edit;

    const CLOSE: Limits = Limits {
        near: 2,
        reach: 24,
        alike: 6,
        most: 5,
    };

    #[test]
    fn changes_are_apart_where_the_texts_go_on_alike() {
        let old = "aa\nbbb\nccc\nddd\neee\nfff\n";
        let changed = |new: &str| {
            let show = |change: Change| format!("{}|{}", change.base.of(old), change.other.of(new));
            changes(old, new, CLOSE)
                .into_iter()
                .map(show)
                .collect::<Vec<_>>()
        };
        assert!(changed(old).is_empty());
        assert_eq!(changed("a0\nbbb\nccc\nddd\neee\nf0f\n"), ["a\n|0\n", "f|0"]);
        assert_eq!(changed("aa\nbbb\nccc\nddd\neee\nfff\nggg\n"), ["|ggg\n"]);
        assert_eq!(changed("bbb\nccc\nddd\neee\nff\n"), ["aa\n|", "f|"]);
        // Too close together.
        assert_eq!(
            changed("aa\nb0b\nccc\nd0d\neee\nfff\n"),
            ["bb\nccc\ndd|0b\nccc\nd0"]
        );
    }

    #[test]
    fn a_million_lines_between_changes_are_no_part_of_them() {
        let row = |number: usize| format!("{number} 0 1\n");
        let old: String = (0..1_000_000).map(row).collect();
        let new = format!("7{}8\n", &old[..old.len() - 1]);
        let changes = changes(&old, &new, LIMITS);
        let lengths = |change: &Change| [change.base.len(), change.other.len()];
        let lengths: Vec<_> = changes.iter().map(lengths).collect();
        assert!(
            lengths.len() == 2 && lengths.as_flattened().iter().all(|&len| len < 16),
            "{lengths:?}"
        );
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn changes_applied_give_the_other_text(
            [old, new] in [lines(), lines()],
            end in prop::sample::select(vec!["\n", "\r", "\r\n"]),
        ) {
            let (old, new) = (old.join(end), new.join(end));
            let changes = changes(&old, &new, CLOSE);
            let edit = |change: &Change| Edit {
                span: change.base,
                text: change.other.of(&new).to_owned(),
            };
            let edits: Vec<_> = changes.iter().map(edit).collect();
            let mut text = old;
            text::apply(&mut text, &edits);
            prop_assert_eq!(text, new);
            let ordered = |pair: &[Change]| {
                pair[0].base.end() < pair[1].base.start() && pair[0].other.end() < pair[1].other.start()
            };
            prop_assert!(changes.windows(2).all(ordered));
        }
    }

    fn lines() -> impl Strategy<Value = Vec<&'static str>> {
        prop::collection::vec(
            prop::sample::select(vec!["0 1", "0", "ä", "sphere", ""]),
            0..40,
        )
    }
}
