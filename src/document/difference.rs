//! How a text differs from another, for the reader: one edit, and the places that it changes.

use similar::algorithms::{Capture, Replace, myers};

use super::changes::{Change, LIMITS, Limits, changes};
use text::{Edit, Span};

/// Finer than for merging, and given up sooner: places are only named.
const FINE: Limits = Limits {
    near: 0,
    reach: 1 << 10,
    most: 1 << 12,
    ..LIMITS
};

/// A change of more bytes than this is one place.
const LONG: usize = 1 << 14;

/// A difference between two texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The smallest edit that turns one text into the other.
    pub edit: Edit,
    /// The spans of the other text in which it differs, in order; empty where something is missing.
    /// One from the first to the last if they are thousands.
    pub places: Vec<Span>,
}

impl Difference {
    /// How `other` differs from `text`; `None` if they are equal.
    pub fn of(text: &str, other: &str) -> Option<Self> {
        let changes = changes(text, other, FINE);
        let (first, last) = (changes.first()?, changes.last()?);
        let edit = Edit {
            span: first.base.to(last.base),
            text: first.other.to(last.other).of(other).to_owned(),
        };
        let mut places = Vec::with_capacity(changes.len());
        for change in changes {
            let parts = parts_of([text, other], change).into_iter();
            places.extend(parts.map(|part| part.other));
        }
        Some(Self { edit, places })
    }
}

/// The edits that turn `text` into `other`: sorted, disjoint, and no longer than the lines that differ need.
pub fn edits_between(text: &str, other: &str) -> Vec<Edit> {
    let changes = changes(text, other, FINE).into_iter();
    let parts = changes.flat_map(|change| {
        let parts = parts_of([text, other], change);
        // A line end may be one only in one of the texts.
        if are_whole([text, other], change, &parts) {
            parts
        } else {
            vec![change]
        }
    });
    let edit = |part: Change| Edit {
        span: part.base,
        text: part.other.of(other).to_owned(),
    };
    parts.map(edit).collect()
}

/// Whether nothing but its parts differs in a change.
fn are_whole([text, other]: [&str; 2], change: Change, parts: &[Change]) -> bool {
    let mut at = [change.base.start(), change.other.start()];
    let ends = Change {
        base: Span::at(change.base.end()),
        other: Span::at(change.other.end()),
    };
    parts.iter().chain([&ends]).all(|part| {
        let gaps = (
            text.get(at[0]..part.base.start()),
            other.get(at[1]..part.other.start()),
        );
        at = [part.base.end(), part.other.end()];
        gaps.0.is_some() && gaps.0 == gaps.1
    })
}

/// The parts of a change, line by line: lines replaced one by one are changes of their own.
fn parts_of([text, other]: [&str; 2], change: Change) -> Vec<Change> {
    if LONG < change.base.len().max(change.other.len()) {
        return vec![change];
    }
    let ends = [(text, change.base.end()), (other, change.other.end())];
    let is_whole = ends
        .iter()
        .all(|&(text, end)| text::line_start(text, end) == end);
    let [old, new] = [(text, change.base), (other, change.other)].map(|(text, span)| {
        let start = text::line_start(text, span.start());
        let end = if is_whole {
            span.end()
        } else {
            text::next_line(text, span.end())
        };
        bounds(text, Span::new(start, end))
    });
    let lines = [(text, &old), (other, &new)].map(|(text, bounds)| {
        let lines = bounds.windows(2).map(|line| &text[line[0]..line[1]]);
        lines.collect::<Vec<_>>()
    });
    let mut capture = Replace::new(Capture::new());
    let (from, to) = (0..lines[0].len(), 0..lines[1].len());
    let Ok(()) = myers::diff(&mut capture, &lines[0], from, &lines[1], to);
    // A line end may be one only in one of the texts.
    let clip = |span: Span, within: Span| {
        let [start, end] =
            [span.start(), span.end()].map(|at| at.clamp(within.start(), within.end()));
        Span::new(start, end)
    };
    let mut parts = Vec::new();
    for op in capture.into_inner().into_ops() {
        let (lines, others) = (op.old_range(), op.new_range());
        let pairs: Vec<_> = if lines.len() == others.len() {
            lines
                .zip(others)
                .map(|(line, of_other)| [line..line + 1, of_other..of_other + 1])
                .collect()
        } else {
            vec![[lines, others]]
        };
        parts.extend(pairs.into_iter().filter_map(|[lines, others]| {
            let starts = [old[lines.start], new[others.start]];
            let [replaced, changed] = text::difference(
                &text[starts[0]..old[lines.end]],
                &other[starts[1]..new[others.end]],
            )?;
            Some(Change {
                base: clip(replaced.shifted(starts[0]), change.base),
                other: clip(changed.shifted(starts[1]), change.other),
            })
        }));
    }
    parts
}

/// The starts of the lines of a span, then its end.
fn bounds(text: &str, span: Span) -> Vec<usize> {
    let next = |&start: &usize| (start < span.end()).then(|| text::next_line(text, start));
    std::iter::successors(Some(span.start()), next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The changed places of the other text.
    fn places<'t>(text: &str, other: &'t str) -> Vec<&'t str> {
        let found = Difference::of(text, other);
        let places = found.map_or_else(Vec::new, |found| found.places);
        places.into_iter().map(|place| place.of(other)).collect()
    }

    #[test]
    fn places_are_what_changed_in_each_line() {
        let text = "a 1\nb 2\nc 3\nd 4\n";
        assert!(places(text, text).is_empty());
        assert_eq!(places(text, "a 5\nb 2\nc 3\nd 6\n"), ["5", "6"]);
        assert_eq!(places(text, "a 1\nb 2\nx\nc 3\nd 6\n"), ["x\n", "6"]);
        assert_eq!(places(text, "a 1\nc 30\nd 4"), ["c 30\nd 4"]);
        assert_eq!(places("a 1", "a 1\n2 3"), ["\n2 3"]);
    }

    #[test]
    fn two_changes_of_a_long_text_are_two_places() {
        let rows: Vec<_> = (0..100_000)
            .map(|number| format!("row {number}\n"))
            .collect();
        let text = rows.concat();
        let other = text
            .replace("row 7\n", "row x\n")
            .replace("row 99990", "row y");
        assert_eq!(places(&text, &other), ["x", "y"]);
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn the_edit_covers_the_places(text in "[aé \n\r]{0,30}", other in "[aé \n\r]{0,30}") {
            let found = Difference::of(&text, &other);
            let edit = found.as_ref().map(|found| found.edit.clone());
            prop_assert_eq!(edit, text::smallest_edit(&text, &other));
            let mut applied = text.clone();
            let edits = edits_between(&text, &other);
            prop_assert!(edits.windows(2).all(|pair| pair[0].span.end() <= pair[1].span.start()));
            text::apply(&mut applied, &edits);
            prop_assert_eq!(applied, other.clone());
            if let Some(Difference { edit, places }) = found {
                prop_assert!(!places.is_empty());
                let of_edit = edit.placed();
                let is_inside = |place: &Span| place.to(of_edit) == of_edit;
                prop_assert!(places.iter().all(is_inside), "{places:?} in {of_edit:?}");
                prop_assert!(places.windows(2).all(|pair| pair[0].end() <= pair[1].start()));
            }
        }
    }
}
