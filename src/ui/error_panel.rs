//! The layout of the error panel: each diagnostic with its position, its line of text and a hint.
//! Shared by drawing and the mouse.

use std::borrow::Cow;
use std::ops::Range;

use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use super::layout::split_bottom;
use super::text_width::{shorten, visible, wrap};
use super::theme;
use text::{Diagnostic, Findings, Position, Shown, Span, line_end, line_start};

/// Bytes of a line read on either side of a span; more than any screen shows.
const REACH: usize = 2048;

/// Distance between tab stops, in columns.
const TAB: usize = 4;

/// A text with its diagnostics, and the state of their list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wrong<'a> {
    /// The text that the spans of `findings` refer to.
    pub(crate) text: &'a str,
    /// The diagnostics of the text.
    pub(crate) findings: &'a Findings,
    /// The selected diagnostic if the list has the focus.
    pub(crate) at: Option<usize>,
}

/// The panel as shown.
#[derive(Debug)]
pub(crate) struct Panel {
    /// The cells it covers.
    pub(crate) area: Rect,
    /// The first diagnostic shown.
    pub(crate) first: usize,
    /// The lines below the title, each with the index of its diagnostic.
    pub(crate) lines: Vec<(usize, StyledLine)>,
}

impl Panel {
    /// Returns the diagnostic on a row of the screen; `None` on the title.
    pub(crate) fn diagnostic_at(&self, row: u16) -> Option<usize> {
        let below = row.checked_sub(self.area.y)?.checked_sub(1)?;
        self.lines.get(usize::from(below)).map(|&(index, _)| index)
    }
}

/// Lays out the diagnostics at the bottom of an area, starting with the selected one, or
/// with the first error if the list has no focus. `None` if there is nothing to show.
pub(crate) fn panel(wrong: &Wrong, file: &str, area: Rect) -> Option<Panel> {
    let first_error = wrong.findings.iter().position(Diagnostic::is_error);
    let first = wrong.at.or(first_error)?;
    let width = usize::from(area.width.saturating_sub(2));
    let mut lines: Vec<(usize, StyledLine)> = Vec::new();
    let gutter = gutter(wrong, first, usize::from(area.height));
    for (index, diagnostic) in wrong.findings.iter().enumerate().skip(first) {
        if usize::from(area.height) <= lines.len() {
            break;
        }
        let mut own = describe(wrong.text, file, diagnostic, (width, gutter));
        if wrong.at == Some(index) {
            let place = &mut own[0].0[0].1;
            *place = theme::chip(*place);
        }
        own.push(StyledLine::default());
        lines.extend(own.into_iter().map(|line| (index, line)));
    }
    lines.pop();
    let height = (lines.len() as u16 + 1).min(area.height);
    Some(Panel {
        area: split_bottom(area, height).1,
        first,
        lines,
    })
}

/// A line of styled text.
#[derive(Debug, Default)]
pub(crate) struct StyledLine(pub(crate) Vec<(String, Style)>);

/// The digits of the largest line number of the diagnostics from one on, as far as there are lines to show
/// them.
fn gutter(wrong: &Wrong, first: usize, lines: usize) -> usize {
    let shown = wrong.findings.iter().skip(first).take(lines);
    let numbers = shown.map(|diagnostic| diagnostic.shown(wrong.text).position.line);
    numbers.max().map_or(0, |line| line.to_string().len())
}

/// Returns the lines of one diagnostic, starting with its position, in a panel of this width with so many
/// digits of line numbers.
fn describe(
    text: &str,
    file: &str,
    diagnostic: &Diagnostic,
    (width, digits): (usize, usize),
) -> Vec<StyledLine> {
    let mut lines = Vec::new();
    let style = theme::severity(Some(diagnostic.severity));
    let Shown {
        file: other,
        position: Position { line, column },
        text,
        span,
    } = diagnostic.shown(text);
    let file = other.map_or(Cow::Borrowed(file), visible);
    let place = format!("{file}:{line}:{column}");
    let message = visible(&diagnostic.message);
    if place.width() + 1 + message.width() <= width {
        let parts = vec![(place, theme::BOLD), (format!(" {message}"), style)];
        lines.push(StyledLine(parts));
    } else {
        lines.push(StyledLine(vec![(place, theme::BOLD)]));
        let wrapped = wrap(&message, width).into_iter();
        lines.extend(wrapped.map(|line| StyledLine(vec![(line, style)])));
    }
    let number = format!("{line:>digits$}");
    let margin = " ".repeat(number.len());
    let room = width.saturating_sub(number.len() + 3);
    let shown = excerpt(text, span, room);
    let numbered = (format!("{number} │ "), theme::DIM);
    lines.push(StyledLine(vec![numbered, (shown.text, Style::new())]));

    let carets = " ".repeat(shown.caret.start) + &"^".repeat(shown.caret.len());
    let mut under = vec![(format!("{margin} │ "), theme::DIM), (carets, style)];
    let expected = visible(&diagnostic.expected);
    let beside = shown.caret.end + 1 + expected.width() <= room;
    if beside {
        under.push((format!(" {expected}"), style));
    }
    lines.push(StyledLine(under));
    let expected = (!beside).then(|| format!("expected {expected}"));
    let hint = diagnostic.hint.as_ref().map(|hint| format!("hint: {hint}"));
    let notes = [expected, hint].into_iter().flatten();
    lines.extend(notes.flat_map(|note| wrap(&note, room)).map(|note| {
        StyledLine(vec![
            (format!("{margin} = "), theme::DIM),
            (note, Style::new()),
        ])
    }));
    lines
}

/// The visible part of a line, and the columns of the span within it.
#[derive(Debug, PartialEq, Eq)]
struct Excerpt {
    text: String,
    caret: Range<usize>,
}

/// Returns the line in which `span` begins, cut around the span to at most `width` columns. Tabs
/// become spaces, and invisible characters become visible. The caret covers the part of the span
/// within this line, and at least one column.
fn excerpt(text: &str, span: Span, width: usize) -> Excerpt {
    let start = boundary(text, span.start());
    let from = boundary(text, start.saturating_sub(REACH));
    let until = boundary(text, start.saturating_add(REACH));
    let from = from + line_start(&text[from..until], start - from);
    let until = line_end(&text[..until], start);
    let end = boundary(text, span.end()).clamp(start, until);

    let mut shown = String::new();
    let mut columns = 0;
    let before = text[from..start].trim_start_matches('\u{feff}');
    push_shown(before, &mut shown, &mut columns);
    let first = columns;
    push_shown(&text[start..end], &mut shown, &mut columns);
    let last = columns.max(first + 1);
    push_shown(&text[end..until], &mut shown, &mut columns);
    cut(&shown, first..last, width)
}

/// Appends text in its visible form and counts its columns.
fn push_shown(text: &str, shown: &mut String, columns: &mut usize) {
    for c in text.chars() {
        if c == '\t' {
            let blanks = TAB - *columns % TAB;
            shown.extend(std::iter::repeat_n(' ', blanks));
            *columns += blanks;
        } else {
            let mut bytes = [0; 4];
            let c = visible(c.encode_utf8(&mut bytes)).into_owned();
            *columns += c.width();
            shown.push_str(&c);
        }
    }
}

/// Cuts a line to `width` columns around the caret, with `…` for omitted parts.
fn cut(shown: &str, caret: Range<usize>, width: usize) -> Excerpt {
    if shown.width() <= width && caret.end <= width {
        let text = shown.to_owned();
        return Excerpt { text, caret };
    }
    // A quarter of the width is for the prefix; all of it if the caret is near the start.
    let skipped = if caret.end < width {
        0
    } else {
        caret.start.saturating_sub(width / 4)
    };
    let mut text = String::new();
    let mut columns = 0;
    let mut dropped = 0;
    for c in shown.chars() {
        let wide = c.width().unwrap_or(0);
        if columns < skipped + usize::from(0 < skipped) {
            dropped += wide;
        } else {
            text.push(c);
        }
        columns += wide;
    }
    if 0 < skipped {
        text.insert(0, '…');
        dropped = dropped.saturating_sub(1);
    }
    let text = shorten(&text, width).into_owned();
    let start = caret.start.saturating_sub(dropped);
    let start = start.min(width.saturating_sub(1));
    let end = caret.end.saturating_sub(dropped).min(width).max(start + 1);
    Excerpt {
        text,
        caret: start..end,
    }
}

/// The nearest character boundary at or before an offset.
fn boundary(text: &str, offset: usize) -> usize {
    let nearest = (0..=offset.min(text.len())).rfind(|&at| text.is_char_boundary(at));
    nearest.unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Asserts the visible text and carets of a line whose span is delimited by `«` and `»`.
    fn check(marked: &str, width: usize, shown: &str, carets: &str) {
        let start = marked.find('«').expect("a span begins");
        let end = marked.find('»').expect("a span ends") - '«'.len_utf8();
        let text = marked.replace(['«', '»'], "");
        let excerpt = excerpt(&text, Span::new(start, end), width);
        let under = " ".repeat(excerpt.caret.start) + &"^".repeat(excerpt.caret.len());
        assert_eq!((excerpt.text.as_str(), under.as_str()), (shown, carets));
    }

    #[test]
    fn carets_mark_the_span() {
        check("a\nsphere «-3» 4\nb", 40, "sphere -3 4", "       ^^");
        check("x «»", 40, "x ", "  ^");
        check("\t1\t«2»\r\n", 40, "    1   2", "        ^");
        check("界 «界»!", 40, "界 界!", "   ^^");
        check("\x1b[2J «x»", 40, "␛[2J x", "     ^");
        check("«a\nb»", 40, "a", "^");
    }

    #[test]
    fn long_lines_are_cut_around_the_span() {
        let long = "0123456789".repeat(9);
        check(&format!("«ab» {long}"), 12, "ab 01234567…", "^^");
        check(&format!("{long}«ab»{long}"), 12, "…89ab012345…", "   ^^");
        check(&format!("{long}«ab»"), 12, "…89ab", "   ^^");
        check(&format!("«{long}»"), 12, "01234567890…", &"^".repeat(12));
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn excerpts_fit_and_contain_no_control_characters(
            text in "[a-c\\t\\n\\r界é\u{1b}\u{202e}]{0,60}", span in (0usize..90, 0usize..90), width in 1usize..40
        ) {
            let (a, b) = span;
            let shown = excerpt(&text, Span::new(a.min(b), a.max(b)), width);
            let columns: usize = shown.text.chars().filter_map(UnicodeWidthChar::width).sum();
            prop_assert!(columns <= width, "{shown:?}");
            prop_assert!(shown.caret.start < shown.caret.end, "{shown:?}");
            prop_assert!(shown.caret.start < width, "{shown:?}");
            prop_assert!(!shown.text.contains(char::is_control), "{shown:?}");
        }
    }
}
