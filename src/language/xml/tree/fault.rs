//! Messages for texts that are not XML.

use std::fmt::Display;

use roxmltree::{Error, TextPos};

use text::{Diagnostic, Span, nearest_word};

/// The diagnostic for an error of the parser, at the place it is about.
pub(super) fn diagnostic(text: &str, error: &Error, unclosed: Option<Span>) -> Diagnostic {
    let at = place(text, error.pos());
    let end = Span::at(text.trim_ascii_end().len());
    let here = character(text, at);
    match error {
        Error::UnexpectedCloseTag(expected, actual, _) => {
            let message = format!("`</{actual}>` does not close `<{expected}>`, which is open");
            let (tag, right) = (until(text, at, '>'), format!("</{expected}>"));
            let is_misspelt = nearest_word(actual, [&**expected]).is_some();
            let place = if is_misspelt { tag } else { Span::at(at) };
            Diagnostic::error(tag, message, format!("`{right}`")).with_fix(place, right)
        }
        Error::UnknownEntityReference(name, _) => Diagnostic::error(
            until(text, at, ';'),
            format!("`&{name};` is not known"),
            "&amp; &lt; &gt; &quot; &apos; or the number of a character",
        )
        .with_hint("a literal & is written &amp;")
        .with_fix(here, "&amp;"),
        Error::MalformedEntityReference(_) => Diagnostic::error(
            here,
            "`&` does not begin a reference to a character that XML allows",
            "`&amp;` for a literal &, or the number of a character, such as `&#65;`",
        )
        .with_fix(here, "&amp;"),
        Error::InvalidAttributeValue(_) | Error::InvalidChar(b'"' | b'\'', b'<', _) => {
            Diagnostic::error(here, "`<` in an attribute value", "`&lt;` for a literal <")
                .with_hint("or the closing quote of the value is missing")
                .with_fix(here, "&lt;")
        }
        Error::DuplicatedAttribute(name, _) => Diagnostic::error(
            word(text, at),
            format!("attribute `{name}`: given twice"),
            "each attribute once",
        ),
        Error::UnclosedRootNode => {
            let open = unclosed.unwrap_or(end);
            let message = format!("`{}>` is never closed", open.of(text));
            let name = open.of(text).trim_start_matches('<');
            Diagnostic::error(open, message, format!("`</{name}>` after its content"))
        }
        // The parser ignores a tag that breaks off.
        Error::UnexpectedEndOfStream | Error::NoRootNode => match unclosed {
            Some(open) => {
                let message = format!("the text ends inside `{}>`", open.of(text));
                Diagnostic::error(open, message, "the rest of the tag and its end tag")
            }
            None => Diagnostic::error(end, "there is no element", "an element"),
        },
        Error::NonXmlChar(c, _) => Diagnostic::error(
            here,
            format!("{c:?} is not allowed in XML"),
            "a printable character",
        ),
        Error::InvalidChar(expected, ..) => missing(here, char::from(*expected)),
        Error::InvalidString(expected, _) => missing(here, expected),
        Error::InvalidChar2(expected, ..) => Diagnostic::error(
            here,
            format!("{expected} is missing"),
            (*expected).to_owned(),
        ),
        Error::InvalidName(_) => Diagnostic::error(here, "a name cannot begin here", "a name")
            .with_hint("a literal < is written &lt;"),
        Error::InvalidComment(_) => {
            let expected = "no `--` before the `-->` that ends it";
            Diagnostic::error(here, "the comment contains `--`", expected)
        }
        Error::InvalidCharacterData(_) => Diagnostic::error(here, "`]]>` in text", "`]]&gt;`"),
        Error::UnknownNamespace(prefix, _) => Diagnostic::error(
            word(text, at),
            format!("the prefix `{prefix}` is not declared"),
            "a name without a prefix",
        ),
        Error::UnexpectedDeclaration(_) => Diagnostic::error(
            until(text, at, '>'),
            "the XML declaration is not at the beginning",
            "an element",
        ),
        Error::UnknownToken(_) => {
            Diagnostic::error(here, "this is not part of XML", "an element or a comment")
                .with_hint("only comments are allowed before and after the root element")
        }
        _ => Diagnostic::error(here, format!("this is not XML: {error}"), "well-formed XML"),
    }
}

/// The byte offset of a line and a column in characters, both from 1.
fn place(text: &str, position: TextPos) -> usize {
    let lines = position.row.saturating_sub(1) as usize;
    let line = match lines.checked_sub(1) {
        Some(before) => text
            .match_indices('\n')
            .nth(before)
            .map_or(0, |(at, _)| at + 1),
        None => 0,
    };
    let column = position.col.saturating_sub(1) as usize;
    let mut characters = text[line..].char_indices();
    line + characters
        .nth(column)
        .map_or(text.len() - line, |(at, _)| at)
}

/// The character at an offset.
fn character(text: &str, at: usize) -> Span {
    let width = text[at..].chars().next().map_or(0, char::len_utf8);
    Span::new(at, at + width)
}

/// The name at an offset.
fn word(text: &str, at: usize) -> Span {
    let end = text[at..].find([' ', '\t', '\r', '\n', '=', '/', '>']);
    Span::new(at, end.map_or(text.len(), |end| at + end))
}

/// The span from an offset to the next `mark`, if that is near; otherwise the character there.
fn until(text: &str, at: usize, mark: char) -> Span {
    const NEAR: usize = 80;
    match text[at..].find([mark, '\n']) {
        Some(end) if end < NEAR && text[at + end..].starts_with(mark) => {
            Span::new(at, at + end + mark.len_utf8())
        }
        _ => character(text, at),
    }
}

/// A mark that the syntax requires and the text lacks.
fn missing(here: Span, mark: impl Display) -> Diagnostic {
    Diagnostic::error(here, format!("`{mark}` is missing"), format!("`{mark}`"))
}
