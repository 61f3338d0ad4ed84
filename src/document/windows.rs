//! The lines around differences between texts. Only these are split into leaves, since a scene of a
//! million objects has tens of millions of leaves.

use super::changes::{Change, LIMITS, changes};
use super::hunks::{APART, Chunks, Hunks, hunks};
use language::Language;
use text::Span;

/// Initial margin of a window in bytes, on either side of a difference.
const MARGIN: usize = 1024;

/// Factor by which a margin grows if it was too narrow.
const WIDER: usize = 16;

/// Corresponding parts of three texts: whole lines, or the whole texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    /// In the common ancestor.
    pub(super) base: Span,
    /// In the text being edited.
    pub(super) mine: Span,
    /// In the text from outside.
    pub(super) theirs: Span,
    /// Whether the window starts at the start of the texts, and ends at their end.
    pub(super) at_ends: [bool; 2],
}

impl Window {
    /// Whether a wider window might give other hunks: they depend on an edge beyond which the text
    /// continues.
    pub(super) fn is_narrow(&self, base: &Chunks, found: &Hunks) -> bool {
        let Hunks {
            all,
            reach,
            is_certain,
        } = found;
        let [is_start, is_end] = self.at_ends;
        let narrow =
            (!is_start && reach.start < APART) || (!is_end && base.len() < reach.end + APART);
        (narrow || !is_certain) && !all.is_empty()
    }
}

/// The changes within corresponding spans of the base and of the changed text, relative to these.
pub(super) fn within(changes: &[Change], base: Span, other: Span) -> Vec<Change> {
    let first = changes.partition_point(|change| change.base.start() < base.start());
    let end = changes.partition_point(|change| change.base.end() <= base.end());
    let from = |start: usize, span: Span| Span::new(span.start() - start, span.end() - start);
    let relative = |change: &Change| Change {
        base: from(base.start(), change.base),
        other: from(other.start(), change.other),
    };
    changes[first..end].iter().map(relative).collect()
}

/// Maps a span of the base, which contains all of each change or none of it, to the changed text.
fn moved(changes: &[Change], span: Span) -> Span {
    let before_start = changes.partition_point(|change| change.base.start() < span.start());
    let before_end = changes.partition_point(|change| change.base.end() <= span.end());
    let behind = |at: usize, before: usize| {
        let last = before.checked_sub(1).map(|last| changes[last]);
        last.map_or(at, |last| at - last.base.end() + last.other.end())
    };
    Span::new(
        behind(span.start(), before_start),
        behind(span.end(), before_end),
    )
}

/// Calls `work` with growing margins until it returns a result.
pub(super) fn widening<T>(language: Language, work: impl Fn(usize) -> Option<T>) -> T {
    let mut margin = if language.leaves_keep_to_lines() {
        MARGIN
    } else {
        usize::MAX
    };
    loop {
        if let Some(found) = work(margin) {
            return found;
        }
        margin = margin.saturating_mul(WIDER);
    }
}

/// The lines around the changes of two texts, in order; one window for those that are close together.
pub(super) fn windows(
    base: &str,
    mine: &[Change],
    theirs: &[Change],
    margin: usize,
) -> Vec<Window> {
    let changes = mine.iter().chain(theirs);
    let mut around: Vec<_> = changes
        .map(|change| lines_around(base, change.base, margin))
        .collect();
    around.sort_unstable();
    let mut spans: Vec<Span> = Vec::with_capacity(around.len());
    for span in around {
        match spans.last_mut() {
            Some(last) if span.start() <= last.end() => *last = last.to(span),
            _ => spans.push(span),
        }
    }
    let window = |span: Span| Window {
        base: span,
        mine: moved(mine, span),
        theirs: moved(theirs, span),
        at_ends: [span.start() == 0, span.end() == base.len()],
    };
    spans.into_iter().map(window).collect()
}

/// The lines from the first change of two texts to the last; `None` if neither differs from the base.
pub(super) fn undivided(base: &str, mine: &[Change], theirs: &[Change]) -> Option<Window> {
    let whole = windows(base, mine, theirs, 0).into_iter();
    whole.reduce(|first, last| Window {
        base: first.base.to(last.base),
        mine: first.mine.to(last.mine),
        theirs: first.theirs.to(last.theirs),
        at_ends: [first.at_ends[0], last.at_ends[1]],
    })
}

/// The lines that contain a span and a margin around it.
fn lines_around(text: &str, span: Span, margin: usize) -> Span {
    let from = span.start().saturating_sub(margin);
    let to = span.end().saturating_add(margin).min(text.len());
    Span::new(text::line_start(text, from), text::next_line(text, to))
}

/// The number of places, leaves or runs of leaves, at which `other` differs from `text`.
pub fn differences(language: Language, text: &str, other: &str) -> usize {
    let changes = changes(text, other, LIMITS);
    widening(language, |margin| {
        let mut count = 0;
        for window in windows(text, &[], &changes, margin) {
            let base = Chunks::of(language, window.base.of(text), window.at_ends);
            let other = Chunks::of(language, window.theirs.of(other), window.at_ends);
            let within = within(&changes, window.base, window.theirs);
            let hunks = hunks(&base, &other, &within);
            if window.is_narrow(&base, &hunks) {
                return None;
            }
            count += hunks.all.len();
        }
        Some(count)
    })
}

#[cfg(test)]
mod tests {
    use super::super::hunks::Hunk;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn windows_are_the_lines_around_changes() {
        let base = "aa\nbb\ncc\ndd\nee\n";
        let windows = |mine: &str, theirs: &str, margin| {
            let changes = [mine, theirs].map(|other| changes(base, other, LIMITS));
            let found = windows(base, &changes[0], &changes[1], margin);
            let show = |w: &Window| {
                let texts = [(w.base, base), (w.mine, mine), (w.theirs, theirs)];
                texts.map(|(span, text)| span.of(text).to_owned()).join("|")
            };
            found.iter().map(show).collect::<Vec<_>>()
        };
        let far = windows("aa\nxbb\ncc\ndd\nee\n", "aa\nbb\ncc\nd\nee\n", 0);
        assert_eq!(far, ["bb\n|xbb\n|bb\n", "dd\n|dd\n|d\n"]);
        let near = windows("aa\nxbb\ncc\ndd\nee\n", "aa\nbb\ncc\nd\nee\n", 3);
        assert_eq!(
            near,
            ["aa\nbb\ncc\ndd\nee\n|aa\nxbb\ncc\ndd\nee\n|aa\nbb\ncc\nd\nee\n"]
        );
        let one = windows(base, "aa\nbb\ncc\ndd\nee\nff", 0);
        assert_eq!(one, ["||ff"]);
        assert!(windows(base, base, 0).is_empty());
    }

    #[test]
    fn windows_end_at_any_kind_of_line_end() {
        for end in ["\r", "\r\n", "\r\r\n"] {
            let text = |middle: &str| ["aa", middle, "cc", ""].join(end);
            let (base, other) = (text("bb"), text("b"));
            let found = windows(&base, &changes(&base, &other, LIMITS), &[], 0);
            let found: Vec<_> = found.iter().map(|window| window.base.of(&base)).collect();
            assert_eq!(found, [format!("bb{end}")]);
        }
    }

    /// Rows of few different words, so that the position of an insertion is often ambiguous.
    fn rows() -> impl Strategy<Value = Vec<&'static str>> {
        prop::collection::vec(
            prop::sample::select(vec!["0 0", "0", "1 0", "sphere"]),
            0..40,
        )
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn a_window_has_the_same_hunks_as_the_whole_text(
            head in rows(), old in rows(), new in rows(), tail in rows(), margin in 0_usize..20,
        ) {
            let text = |middle: &[&str]| [&head[..], middle, &tail[..]].concat().join("\n");
            let (base, other) = (text(&old), text(&new));
            let found = |margin| {
                let changes = changes(&base, &other, LIMITS);
                let windows = windows(&base, &[], &changes, margin);
                let [window] = windows[..] else { return Some(Vec::new()) };
                let chunks = Chunks::of(Language::Ray, window.base.of(&base), window.at_ends);
                let others = Chunks::of(Language::Ray, window.theirs.of(&other), window.at_ends);
                let within = within(&changes, window.base, window.theirs);
                let hunks = hunks(&chunks, &others, &within);
                let bytes = |hunk: &Hunk| [
                    chunks.span(&hunk.base).shifted(window.base.start()),
                    others.span(&hunk.other).shifted(window.theirs.start()),
                ];
                (!window.is_narrow(&chunks, &hunks)).then(|| hunks.all.iter().map(bytes).collect())
            };
            let whole = found(usize::MAX);
            prop_assert!(whole.is_some());
            let part = found(margin);
            prop_assert!(part.is_none() || part == whole, "{part:?}, not {whole:?}");
        }
    }
}
