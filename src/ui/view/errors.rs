//! What is wrong with the text: each message with its place, the line it stands in, and the way
//! out.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use super::row::{Row, shorten, title, visible, wrap};
use super::theme;
use crate::text::{Diagnostic, Position, Span, counted, line_end, line_start};
use crate::ui::app::App;

/// How much of a line is read on either side of a span, in bytes: more than any screen shows.
const REACH: usize = 2048;

/// Columns from one tab stop to the next.
const TAB: usize = 4;

/// The panel as it is shown.
#[derive(Debug)]
pub(crate) struct Panel {
    /// The cells it takes.
    pub(crate) area: Rect,
    /// The first diagnostic shown.
    first: usize,
    /// What stands below its title: lines, and the diagnostic that each is part of.
    lines: Vec<(usize, Line)>,
}

impl Panel {
    /// The diagnostic that a row of the screen is part of; none at the title.
    pub(crate) fn diagnostic_at(&self, row: u16) -> Option<usize> {
        let below = row.checked_sub(self.area.y)?.checked_sub(1)?;
        self.lines.get(usize::from(below)).map(|&(index, _)| index)
    }
}

/// Lays the diagnostics out over the lower part of the picture: from the one under the cursor on,
/// or the first error where the list has no keys. `None` if there is nothing to show.
pub(crate) fn panel(app: &App, area: Rect) -> Option<Panel> {
    let (_, diagnostics) = app.wrong();
    let first_error = diagnostics.iter().position(Diagnostic::is_error);
    let first = app.errors.or(first_error)?;
    let width = usize::from(area.width.saturating_sub(2));
    let mut lines: Vec<(usize, Line)> = Vec::new();
    for (index, diagnostic) in diagnostics.iter().enumerate().skip(first) {
        if usize::from(area.height) <= lines.len() {
            break;
        }
        let mut own = describe(app, diagnostic, width);
        if app.errors == Some(index) {
            let place = &mut own[0].0[0].1;
            *place = theme::chip(*place);
        }
        own.push(Line::default());
        lines.extend(own.into_iter().map(|line| (index, line)));
    }
    lines.pop();
    let height = (lines.len() as u16 + 1).min(area.height);
    Some(Panel {
        area: super::layout::split_bottom(area, height).1,
        first,
        lines,
    })
}

/// Draws the diagnostics over the lower part of the picture, if there are any to show.
pub(crate) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(panel) = panel(app, area) else {
        return;
    };
    Clear.render(panel.area.intersection(buffer.area), buffer);
    let count = app.wrong().1.len();
    title(
        &heading(app),
        &format!("{}/{count}", (panel.first + 1).min(count)),
        app.errors.map(|_| theme::ACCENT),
        panel.area,
        buffer,
    );
    let rows = usize::from(panel.area.height.saturating_sub(1));
    for (index, (_, Line(parts))) in panel.lines.iter().enumerate().take(rows) {
        let mut row = Row::new(buffer, panel.area, index as u16 + 1);
        row.skip(1);
        for (text, style) in parts {
            row.put(text, *style);
        }
    }
}

/// Text of one line in its styles.
#[derive(Debug, Default)]
struct Line(Vec<(String, Style)>);

fn heading(app: &App) -> String {
    let (_, diagnostics) = app.wrong();
    let (errors, warnings) = (diagnostics.errors(), diagnostics.warnings());
    if app.is_disk_wrong() {
        return format!("{} in the file on disk", counted(errors, "error"));
    }
    let kinds = [(errors, "error"), (warnings, "warning")];
    let mut said: Vec<_> = kinds
        .into_iter()
        .filter(|&(count, _)| 0 < count)
        .map(|(count, noun)| counted(count, noun))
        .collect();
    if said.is_empty() {
        said.push("nothing is wrong".to_owned());
    }
    if diagnostics.len() < errors + warnings {
        said.push(format!("{} listed", diagnostics.len()));
    }
    said.join(", ")
}

/// The lines of one diagnostic: its place comes first.
fn describe(app: &App, diagnostic: &Diagnostic, width: usize) -> Vec<Line> {
    let mut lines = Vec::new();
    let (text, _) = app.wrong();
    let style = theme::severity(Some(diagnostic.severity));
    let Position { line, column } = Position::of(text, diagnostic.span.start());
    let place = format!("{}:{line}:{column}", app.file_name());
    let message = visible(&diagnostic.message);
    if place.width() + 1 + message.width() <= width {
        let parts = vec![(place, theme::BOLD), (format!(" {message}"), style)];
        lines.push(Line(parts));
    } else {
        lines.push(Line(vec![(place, theme::BOLD)]));
        let wrapped = wrap(&message, width).into_iter();
        lines.extend(wrapped.map(|line| Line(vec![(line, style)])));
    }
    let number = line.to_string();
    let margin = " ".repeat(number.len());
    let room = width.saturating_sub(number.len() + 3);
    let shown = excerpt(text, diagnostic.span, room);
    let numbered = (format!("{number} │ "), theme::DIM);
    lines.push(Line(vec![numbered, (shown.text, Style::new())]));

    let carets = " ".repeat(shown.caret.start) + &"^".repeat(shown.caret.len());
    let mut under = vec![(format!("{margin} │ "), theme::DIM), (carets, style)];
    let expected = visible(&diagnostic.expected);
    let beside = shown.caret.end + 1 + expected.width() <= room;
    if beside {
        under.push((format!(" {expected}"), style));
    }
    lines.push(Line(under));
    let expected = (!beside).then(|| format!("expected {expected}"));
    let hint = diagnostic.hint.as_ref().map(|hint| format!("hint: {hint}"));
    let notes = [expected, hint].into_iter().flatten();
    lines.extend(notes.flat_map(|note| wrap(&note, room)).map(|note| {
        Line(vec![
            (format!("{margin} = "), theme::DIM),
            (note, Style::new()),
        ])
    }));
    lines
}

/// A part of a line as it is shown, and the columns of the span in it.
#[derive(Debug, PartialEq, Eq)]
struct Excerpt {
    text: String,
    caret: Range<usize>,
}

/// The line that `span` begins in, cut around the span to at most `width` columns. Tabs become
/// blanks, invisible characters visible. The caret covers the span's part in this line, and at
/// least one column.
fn excerpt(text: &str, span: Span, width: usize) -> Excerpt {
    let start = boundary(text, span.start());
    let from = boundary(text, start.saturating_sub(REACH));
    let until = boundary(text, start.saturating_add(REACH));
    let from = from + line_start(&text[from..until], start - from);
    let until = line_end(&text[..until], start);
    let end = boundary(text, span.end()).clamp(start, until);

    let mut shown = String::new();
    let mut columns = 0;
    push_shown(
        text[from..start].trim_start_matches('\u{feff}'),
        &mut shown,
        &mut columns,
    );
    let first = columns;
    push_shown(&text[start..end], &mut shown, &mut columns);
    let last = columns.max(first + 1);
    push_shown(&text[end..until], &mut shown, &mut columns);
    cut(&shown, first..last, width)
}

/// Appends text as it is shown and counts its columns.
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

/// Cuts a shown line to `width` columns around the caret, with `…` where something is left out.
fn cut(shown: &str, caret: Range<usize>, width: usize) -> Excerpt {
    if shown.width() <= width && caret.end <= width {
        let text = shown.to_owned();
        return Excerpt { text, caret };
    }
    // A quarter of the room for what stands before; all of it where the caret is near the start.
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
    let start = caret
        .start
        .saturating_sub(dropped)
        .min(width.saturating_sub(1));
    let end = caret.end.saturating_sub(dropped).min(width).max(start + 1);
    Excerpt {
        text,
        caret: start..end,
    }
}

/// The nearest character boundary at or before an offset.
fn boundary(text: &str, offset: usize) -> usize {
    let offset = offset.min(text.len());
    (0..=offset)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Findings;
    use crate::ui::view::Glyphs;
    use crate::ui::view::tests::{app, drawn, retype};
    use proptest::prelude::*;

    /// Checks a line, given with `«` and `»` around the span, against what is shown with carets.
    fn check(marked: &str, width: usize, shown: &str, carets: &str) {
        let start = marked.find('«').expect("a span begins");
        let end = marked.find('»').expect("a span ends") - '«'.len_utf8();
        let text = marked.replace(['«', '»'], "");
        let excerpt = excerpt(&text, Span::new(start, end), width);
        let under = " ".repeat(excerpt.caret.start) + &"^".repeat(excerpt.caret.len());
        assert_eq!((excerpt.text.as_str(), under.as_str()), (shown, carets));
    }

    #[test]
    fn carets_stand_under_the_span() {
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

    #[test]
    fn an_error_says_where_what_and_the_way_out() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " -0.25 //");
        let radius = app.diagnostics[0].clone();
        app.diagnostics = Findings::default();
        app.diagnostics
            .error(|| radius.with_hint("sizes count outward"));
        let lines = drawn(&app, render, 70, 10);
        let text = lines.join("\n");
        for part in [
            "1 error ─",
            " test.ray:6:18 object 1 (sphere) radius",
            " 6 │ sphere 0 .5 -1e0 -0.25 // the first",
            "   │                  ^^^^^ a number greater than 0",
            "   = hint: sizes count outward",
        ] {
            assert!(text.contains(part), "{part:?} in\n{text}");
        }
    }

    #[test]
    fn errors_that_are_not_listed_are_counted() {
        let mut app = app();
        let wrong = "sphere 0 0 0 -1  0 0 0  0 0 0  0 0 0  1 0 0 1\n".repeat(250);
        retype(&mut app, "box", &format!("{wrong}box"));
        let title = drawn(&app, render, 70, 10).swap_remove(0);
        assert!(title.starts_with("251 errors, 100 listed ─"), "{title}");
        let status = |app: &App, area: Rect, buffer: &mut Buffer| {
            super::super::status::render(app, Glyphs::HalfBlocks, area, buffer);
        };
        let line = drawn(&app, status, 70, 1).swap_remove(0);
        assert!(line.contains(" 251 errors "), "{line}");
    }

    proptest! {
        #[test]
        fn excerpts_fit_and_show_no_control_character(
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
