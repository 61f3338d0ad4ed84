//! Formats diagnostics, each with an excerpt of the text.

use std::io::{self, IsTerminal};

use serde_json::{Value, json};

use text::{
    Diagnostic, Position, Severity, Shown, Span, columns, first_byte, line_end, line_start,
    mark_len, visible,
};

/// Maximum number of characters shown before a span, of it, and after it. Escapes and tabs are wider, so a
/// line may still be longer than the terminal is wide.
const MARGIN: usize = 60;

/// Whether a report is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    Plain,
    Coloured,
}

impl Style {
    /// Coloured on a terminal, unless `NO_COLOR` is set (see no-color.org) or `TERM` is `dumb`.
    pub(super) fn of_error_stream() -> Self {
        let no_colour = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        if has_controls() && !no_colour {
            Self::Coloured
        } else {
            Self::Plain
        }
    }

    /// A text in a colour.
    fn paint(self, colour: &str, text: &str) -> String {
        match self {
            Self::Plain => text.to_owned(),
            Self::Coloured => format!("\x1b[{colour}m{text}\x1b[0m"),
        }
    }
}

/// The colours of a report, as SGR parameters: bold, most with a colour of the terminal.
const ERROR: &str = "1;91";
const WARNING: &str = "1;33";
const MARGINALIA: &str = "1;94";
const TITLE: &str = "1";

/// Whether standard error is a terminal that knows control sequences.
pub(super) fn has_controls() -> bool {
    io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// Formats the diagnostics of a text, in order, without a trailing line break. The first line of
/// each contains `NAME:LINE:COLUMN`. Foreign text is escaped by [`visible`].
pub(super) fn render(name: &str, text: &str, diagnostics: &[Diagnostic], style: Style) -> String {
    let lines: Vec<_> = diagnostics
        .iter()
        .map(|diagnostic| one(name, text, diagnostic, style))
        .collect();
    lines.join("\n")
}

/// A diagnostic in rustc's layout: what is wrong, the line, the mark with what is expected, the hint.
fn one(name: &str, text: &str, diagnostic: &Diagnostic, style: Style) -> String {
    let Shown {
        file,
        position: Position { line, column },
        text,
        span,
    } = diagnostic.shown(text);
    let (level, colour) = match diagnostic.severity {
        Severity::Error => ("error", ERROR),
        Severity::Warning => ("warning", WARNING),
        Severity::Note => ("note", TITLE),
    };
    let place = visible(file.unwrap_or(name));
    let title = format!(
        ": {place}:{line}:{column}: {}",
        visible(&diagnostic.message)
    );
    let excerpt = Excerpt::of(text, span);
    let before = &excerpt.line[..excerpt.marked.start()];
    let marks = columns(excerpt.marked.of(&excerpt.line)).max(1);
    let mark = format!("{} {}", "^".repeat(marks), visible(&diagnostic.expected));

    let number = line.to_string();
    let margin = " ".repeat(number.len());
    let side = |text: &str| style.paint(MARGINALIA, text);
    let empty = side(&format!("{margin} |"));
    let numbered = side(&format!("{number} |"));
    let space = if excerpt.line.is_empty() { "" } else { " " };
    let indent = " ".repeat(columns(before));
    let mut lines = vec![
        style.paint(colour, level) + &style.paint(TITLE, &title),
        empty.clone(),
        format!("{numbered}{space}{}", excerpt.line),
        format!("{empty} {indent}{}", style.paint(colour, mark.trim_end())),
    ];
    if let Some(hint) = &diagnostic.hint {
        let equals = side(&format!("{margin} ="));
        let help = style.paint(TITLE, "help");
        lines.extend([empty, format!("{equals} {help}: {}", visible(hint))]);
    }
    lines.join("\n")
}

/// A diagnostic of a text as an object of JSON, whose `excerpt` is the offending part of the first line;
/// the `hint` is null if there is none. Foreign text is escaped by [`visible`].
pub(super) fn object(name: &str, text: &str, diagnostic: &Diagnostic) -> Value {
    let Shown {
        file,
        position: Position { line, column },
        text,
        span,
    } = diagnostic.shown(text);
    let excerpt = Excerpt::of(text, span);
    json!({
        "event": match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        },
        "message": visible(&diagnostic.message),
        "file": visible(file.unwrap_or(name)),
        "line": line,
        "column": column,
        "excerpt": excerpt.marked.of(&excerpt.line),
        "expected": visible(&diagnostic.expected),
        "hint": diagnostic.hint.as_deref().map(visible),
    })
}

/// A line prepared for display.
#[derive(Debug, PartialEq)]
struct Excerpt {
    line: String,
    marked: Span,
}

impl Excerpt {
    /// The line in which `span` begins, shortened around it if long. Marks only the part of the
    /// span in that line.
    fn of(text: &str, span: Span) -> Self {
        let start = span.start().clamp(mark_len(text), text.len());
        let line_start = line_start(text, start).max(mark_len(text));
        let line_end = line_end(text, start);
        let end = span.end().clamp(start, line_end);
        let before = last_chars(&text[line_start..start]);
        let marked = first_chars(&text[start..end]);
        let rest = &text[start + marked.len()..line_end];
        let after = first_chars(rest);
        let is_cut = !is_blank(&rest[after.len()..]);
        let after = if is_cut { after } else { after.trim_end() };

        let mut line = String::new();
        if before.len() < start - line_start {
            line.push('…');
        }
        line.push_str(&shown(before));
        let from = line.len();
        line.push_str(&shown(marked));
        let marked = Span::new(from, line.len());
        line.push_str(&shown(after));
        line.truncate(line.trim_end().len().max(marked.end()));
        if is_cut {
            line.push('…');
        }
        Self { line, marked }
    }
}

/// Expands tabs to spaces and escapes the rest by [`visible`].
fn shown(text: &str) -> String {
    let parts: Vec<_> = text.split('\t').map(visible).collect();
    parts.join("    ")
}

/// Whether a text is white space, of which there may be a gigabyte.
fn is_blank(text: &str) -> bool {
    let other = first_byte(text.as_bytes(), |byte| byte != b' ');
    other.is_none_or(|at| text[at..].trim_start().is_empty())
}

fn first_chars(text: &str) -> &str {
    let end = text
        .char_indices()
        .nth(MARGIN)
        .map_or(text.len(), |(at, _)| at);
    &text[..end]
}

fn last_chars(text: &str) -> &str {
    let start = text
        .char_indices()
        .rev()
        .nth(MARGIN - 1)
        .map_or(0, |(at, _)| at);
    &text[start..]
}

#[cfg(test)]
mod tests {
    use super::*;
    use text::Cited;

    /// The plain report of one error at the part of `text` between brackets.
    fn report(text: &str) -> String {
        let start = text.find('[').expect("a bracket");
        let end = text.find(']').expect("a bracket") - 1;
        let text = text.replace(['[', ']'], "");
        let diagnostic = Diagnostic::error(Span::new(start, end), "wrong", "a number");
        render("a.ray", &text, &[diagnostic], Style::Plain)
    }

    #[test]
    fn a_report_gives_the_position_and_points_at_it() {
        let text = "1\nsphere 0 0 0 -1\n";
        let diagnostic = Diagnostic::error(
            Span::new(15, 17),
            "object 1 (sphere) radius: must be greater than 0",
            "a number greater than 0",
        )
        .with_hint("write 1");
        assert_eq!(
            render("a.ray", text, &[diagnostic], Style::Plain),
            "\
error: a.ray:2:14: object 1 (sphere) radius: must be greater than 0
  |
2 | sphere 0 0 0 -1
  |              ^^ a number greater than 0
  |
  = help: write 1"
        );
    }

    #[test]
    fn colours_tell_what_is_wrong_from_the_text() {
        let odd = Diagnostic::warning(Span::new(0, 1), "odd", "a number").with_hint("write 1");
        assert_eq!(
            render("a.ray", "x", &[odd], Style::Coloured),
            "\x1b[1;33mwarning\x1b[0m\x1b[1m: a.ray:1:1: odd\x1b[0m
\x1b[1;94m  |\x1b[0m
\x1b[1;94m1 |\x1b[0m x
\x1b[1;94m  |\x1b[0m \x1b[1;33m^ a number\x1b[0m
\x1b[1;94m  |\x1b[0m
\x1b[1;94m  =\x1b[0m \x1b[1mhelp\x1b[0m: write 1"
        );
    }

    #[test]
    fn a_report_about_another_file_shows_its_line() {
        let diagnostic = Diagnostic::warning(Span::new(0, 5), "f: too few", "three corners");
        let diagnostic = diagnostic.citing(Cited {
            file: "meshes/a.obj".to_owned(),
            line: 12,
            column: 3,
            excerpt: "f 1 2".to_owned(),
            marked: Span::new(2, 5),
        });
        assert_eq!(
            render("a.xml", "a.obj", &[diagnostic], Style::Plain),
            "\
warning: meshes/a.obj:12:3: f: too few
   |
12 | f 1 2
   |   ^^^ three corners"
        );
    }

    #[test]
    fn warnings_are_labelled_and_none_is_omitted() {
        let warning = Diagnostic::warning(Span::at(0), "odd", "something else");
        let mut all = vec![warning; 102];
        all.push(Diagnostic::error(Span::at(0), "wrong", "something right"));
        let lines = render("a.ray", "x", &all, Style::Plain);
        assert!(lines.starts_with("warning: a.ray:1:1: odd\n"), "{lines}");
        assert_eq!(lines.matches("warning:").count(), 102);
        assert_eq!(lines.matches("error: a.ray:1:1: wrong").count(), 1);
    }

    #[test]
    fn the_mark_of_an_excerpt_covers_the_span() {
        let long = "0 ".repeat(1000);
        let cases = [
            ("[ab] c", "ab c", "ab"),
            ("x\ny [ab]\r\r\nc", "y ab", "ab"),
            ("x\ry [ab]\rc", "y ab", "ab"),
            ("\t[1]\t2", "    1    2", "1"),
            ("\u{1b}[\u{9b}m]", "\\u{1b}\\u{9b}m", "\\u{9b}m"),
            ("é\u{202e}[é]\u{7}", "é\\u{202e}é\\u{7}", "é"),
            ("a [b\nc] d", "a b", "b"),
            ("end[]", "end", ""),
            ("\u{feff}[ab] c", "ab c", "ab"),
            ("[]\u{feff}ab", "ab", ""),
            ("end \n[]", "", ""),
        ];
        for (text, line, marked) in cases {
            check_excerpt(text, line, marked);
        }
        let zeros = "0 ".repeat(30);
        let cut = format!("…{zeros}x{}…", zeros.trim_end());
        check_excerpt(&format!("{long}[x]{}{long}", ""), &cut, "x");
        for blank in [" ", "\u{a0}", "\x0B", "\u{3000}"] {
            check_excerpt(&format!("a [x]{}\nb", blank.repeat(1000)), "a x", "x");
        }
    }

    fn check_excerpt(text: &str, line: &str, marked: &str) {
        let start = text.find('[').expect("a bracket");
        let end = text.find(']').expect("a bracket") - 1;
        let excerpt = Excerpt::of(&text.replace(['[', ']'], ""), Span::new(start, end));
        assert_eq!(excerpt.line, line, "{text:?}");
        assert_eq!(excerpt.marked.of(&excerpt.line), marked, "{text:?}");
    }

    #[test]
    fn an_empty_span_at_the_end_is_marked() {
        assert_eq!(
            report("1 2[]"),
            "\
error: a.ray:1:4: wrong
  |
1 | 1 2
  |    ^ a number"
        );
    }

    #[test]
    fn control_characters_never_reach_the_terminal() {
        let evil = "\u{1b}]52;c;eA\u{7}\r\u{9b}31m\u{202e}";
        let diagnostic = Diagnostic::warning(Span::new(0, evil.len()), evil, evil).with_hint(evil);
        let lines = render(evil, evil, &[diagnostic], Style::Plain);
        let raw = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
        assert!(!lines.contains(raw), "{lines:?}");
    }
}
