//! Comments behind numbers stay in their columns when a number becomes longer or shorter.

use super::{Edit, Span, line_end, line_start, next_line};

/// Returns the edits with the last one of each line extended to the comment that follows on it, which
/// `mark` opens, so that the blanks before it absorb what the line grows by and give it back.
///
/// A single blank stays as it is unless a comment above or below begins in the same column. `length` is the
/// number of characters that a span had when the run of edits began that it belongs to, if it is known.
/// Edits that insert, delete or span lines are returned as they are.
pub fn keep_columns(
    text: &str,
    edits: &[Edit],
    mark: &str,
    length: impl Fn(Span) -> Option<usize>,
) -> Vec<Edit> {
    let mut kept = edits.to_vec();
    let mut from = 0;
    while let Some(first) = edits.get(from) {
        let end = line_end(text, first.span.start());
        let on_line = edits[from..].iter();
        let count = on_line.take_while(|edit| edit.span.start() <= end).count();
        let own = &edits[from..from + count.max(1)];
        from += own.len();
        if let Some(extended) = extended(text, own, mark, &length) {
            kept[from - 1] = extended;
        }
    }
    kept
}

/// The last of the edits on a line, extended to the comment behind it; `None` if that has no column.
fn extended(
    text: &str,
    edits: &[Edit],
    mark: &str,
    length: &impl Fn(Span) -> Option<usize>,
) -> Option<Edit> {
    let (first, last) = (edits.first()?, edits.last()?);
    let is_value = |edit: &Edit| {
        let both = [edit.span.of(text), &edit.text];
        both.iter()
            .all(|part| !part.is_empty() && !part.contains(['\n', '\r']))
    };
    if !edits.iter().all(is_value) {
        return None;
    }
    let start = line_start(text, first.span.start());
    let end = line_end(text, last.span.end());
    if text[start..last.span.end()].contains(mark) {
        return None;
    }
    let comment = last.span.end() + text[last.span.end()..end].find(mark)?;
    let between = &text[last.span.end()..comment];
    let code = between.trim_end_matches(' ');
    let blanks = between.len() - code.len();
    let is_quoted = mark != "<!--" && code.contains(['"', '\'']);
    if blanks == 0 || is_quoted || code.ends_with('\t') {
        return None;
    }
    let count = |text: &str| text.chars().count();
    let whole = Span::new(last.span.start(), comment);
    let column = count(&text[start..comment]);
    // What the edits before the last one on the line add is not in its own text.
    let earlier = &edits[..edits.len() - 1];
    let grown = earlier.iter().map(|edit| count(&edit.text)).sum::<usize>();
    let shrunk = earlier
        .iter()
        .map(|edit| count(edit.span.of(text)))
        .sum::<usize>();
    let wanted = match length(whole).filter(|_| earlier.is_empty()) {
        Some(length) => count(&text[start..whole.start()]) + length,
        None => wanted_column(text, [start, end], column, blanks, mark)?,
    };
    let before = count(&text[start..whole.start()]) + grown - shrunk;
    let mut new = format!("{}{code}", last.text);
    let blanks = wanted.saturating_sub(before + count(&new)).max(1);
    new.extend(std::iter::repeat_n(' ', blanks));
    Some(Edit {
        span: whole,
        text: new,
    })
}

/// The column in which the comment of a line belongs; `None` if it follows its number wherever that ends.
fn wanted_column(
    text: &str,
    [start, end]: [usize; 2],
    column: usize,
    blanks: usize,
    mark: &str,
) -> Option<usize> {
    if 1 < blanks {
        return Some(column);
    }
    let above = start.checked_sub(1).map(|last| line_start(text, last));
    let below = Some(next_line(text, end)).filter(|below| end < *below);
    let of_line = |start: usize| {
        let line = &text[start..line_end(text, start)];
        let before = line[..line.find(mark)?].chars();
        let column = before.clone().count();
        before
            .last()
            .is_some_and(|last| last == ' ')
            .then_some(column)
    };
    let [above, below] = [above, below].map(|start| start.and_then(of_line));
    match (above, below) {
        _ if above == Some(column) || below == Some(column) => Some(column),
        // A long number has pushed it out.
        (Some(one), Some(other)) if one == other && one < column => Some(one),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text after its first `old` becomes `new`, in a run that began with a span of this length.
    fn edited(text: &str, old: &str, new: &str, length: Option<usize>) -> String {
        let start = text.find(old).expect("it is in the text");
        let edit = Edit {
            span: Span::new(start, start + old.len()),
            text: new.to_owned(),
        };
        let mut text = text.to_owned();
        let edits = keep_columns(&text, &[edit], "//", |_| length);
        crate::apply(&mut text, &edits);
        text
    }

    #[test]
    fn blanks_before_a_comment_absorb_longer_numbers_and_give_back() {
        for (text, old, new, length, expected) in [
            ("0.8    // r", "0.8", "0.25", None, "0.25   // r"),
            ("0.25   // r", "0.25", "1", None, "1      // r"),
            ("0.8 1  // r", "0.8", "0.86603", None, "0.86603 1 // r"),
            // In one run, the first text counts.
            ("10.5 // r", "10.5", "9.5", Some(5), "9.5  // r"),
            ("10.5 // r", "10.5", "9.5", Some(4), "9.5 // r"),
            // A single blank is no column, unless its neighbour shows one.
            ("0.8 // r", "0.8", "0.25", None, "0.25 // r"),
            ("0.25 // r", "0.25", "1", None, "1 // r"),
            (
                "0.25 // r\n1    // s",
                "0.25",
                "1",
                None,
                "1    // r\n1    // s",
            ),
            (
                "2  // q\n0.25 // r\n1  // s",
                "0.25",
                "1",
                None,
                "2  // q\n1  // r\n1  // s",
            ),
            // Nothing else moves.
            ("0.8", "0.8", "0.25", None, "0.25"),
            ("0.8\t// r", "0.8", "0.25", None, "0.25\t// r"),
            ("0.8 \"a  // b\"", "0.8", "0.25", None, "0.25 \"a  // b\""),
            ("// eye 1   // r", "1", "10", None, "// eye 10   // r"),
            ("é 0.8   // r", "0.8", "0.25", None, "é 0.25  // r"),
        ] {
            assert_eq!(edited(text, old, new, length), expected, "{text} {new}");
        }
    }

    #[test]
    fn all_edits_of_a_line_are_absorbed_together() {
        let text = "1 2 3     // a\n4    // b";
        let edit = |at: usize, text: &str| Edit {
            span: Span::new(at, at + 1),
            text: text.to_owned(),
        };
        let edits = [edit(0, "0.1"), edit(4, "0.3"), edit(15, "0.44")];
        let mut new = text.to_owned();
        crate::apply(&mut new, &keep_columns(text, &edits, "//", |_| None));
        assert_eq!(new, "0.1 2 0.3 // a\n0.44 // b");
    }
}
