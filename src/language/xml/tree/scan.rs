//! A quick look at a text before it is parsed: whether it holds what is refused, and what it leaves
//! open.

use crate::text::{Diagnostic, Span};

/// More attributes than this in one tag are not a scene's, and comparing each with all others takes
/// its time.
const MOST_ATTRIBUTES: usize = 1000;

/// The same of declared name spaces, which each element inherits from the one around it.
const MOST_NAME_SPACES: usize = 64;

/// Elements inside one another beyond this are not a scene's.
const MOST_LEVELS: usize = 1 << 17;

/// What the look finds.
pub(super) struct Scan {
    /// What is refused.
    pub(super) refused: Option<Diagnostic>,
    /// The innermost element that is never closed: its `<` and name.
    pub(super) unclosed: Option<Span>,
}

/// Looks at a text. What is not XML at all it passes by.
pub(super) fn scan(text: &str) -> Scan {
    let mut open: Vec<Span> = Vec::new();
    let refuse = |refused| Scan {
        refused: Some(refused),
        unclosed: None,
    };
    if let Some((at, name)) = text.match_indices("xmlns").nth(MOST_NAME_SPACES) {
        let message = format!("more than {MOST_NAME_SPACES} name spaces are refused");
        let span = Span::new(at, at + name.len());
        return refuse(Diagnostic::error(
            span,
            message,
            "elements without prefixes",
        ));
    }
    let mut at = 0;
    while let Some(offset) = text[at..].find('<') {
        let start = at + offset;
        let rest = &text[start..];
        let until = |mark: &str| {
            rest.find(mark)
                .map_or(text.len(), |end| start + end + mark.len())
        };
        at = if rest.starts_with("<!--") {
            until("-->")
        } else if rest.starts_with("<![CDATA[") {
            until("]]>")
        } else if rest.starts_with("<?") {
            until("?>")
        } else if rest
            .get(..9)
            .is_some_and(|mark| mark.eq_ignore_ascii_case("<!doctype"))
        {
            return refuse(doctype(Span::new(start, start + 9)));
        } else if rest.starts_with("</") {
            open.pop();
            until(">")
        } else {
            let end = tag_end(text, start + 1);
            let tag = &text[start..end];
            let name = tag
                .find([' ', '\t', '\r', '\n', '/', '>'])
                .unwrap_or(tag.len());
            if MOST_ATTRIBUTES < tag.matches('=').count() {
                let span = Span::new(start, start + name);
                let message = format!("more than {MOST_ATTRIBUTES} attributes are refused");
                return refuse(Diagnostic::error(span, message, "fewer attributes"));
            }
            if !tag.ends_with("/>") {
                if open.len() == MOST_LEVELS {
                    let span = Span::new(start, start + name);
                    let message =
                        format!("more than {MOST_LEVELS} elements inside one another are refused");
                    return refuse(Diagnostic::error(span, message, "fewer levels"));
                }
                open.push(Span::new(start, start + name));
            }
            end
        };
    }
    Scan {
        refused: None,
        unclosed: open.pop(),
    }
}

/// Where a tag ends, from a place inside it that is not between quotes: after its `>`.
pub(super) fn tag_end(text: &str, from: usize) -> usize {
    let mut quote = None;
    for (at, &byte) in text.as_bytes()[from..].iter().enumerate() {
        match (byte, quote) {
            (b'"' | b'\'', None) => quote = Some(byte),
            (byte, Some(open)) if byte == open => quote = None,
            (b'>', None) => return from + at + 1,
            _ => {}
        }
    }
    text.len()
}

fn doctype(span: Span) -> Diagnostic {
    let message = "document type declarations are refused";
    Diagnostic::error(span, message, "an element")
        .with_hint("remove it: scenes need none, and entities are not resolved")
}
