//! A quick scan of a text before it is parsed, for what is refused and for unclosed elements.

use text::{Diagnostic, Span};

/// Maximum number of attributes per tag: far more than in any scene, and comparing each with all
/// others takes time.
const MOST_ATTRIBUTES: usize = 1000;

/// Maximum number of namespace declarations, which each element inherits from its parent.
const MOST_NAME_SPACES: usize = 64;

/// Maximum nesting depth of elements, far more than in any scene.
const MOST_LEVELS: usize = 1 << 17;

/// Scans a text; returns the elements that are never closed, by their `<` and names, the innermost last.
/// Skips anything that is not XML.
///
/// # Errors
///
/// Fails at what is refused.
pub(super) fn scan(text: &str) -> Result<Vec<Span>, Diagnostic> {
    let mut open: Vec<Span> = Vec::new();
    let mut name_spaces = 0;
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
            return Err(doctype(Span::new(start, start + 9)));
        } else if rest.starts_with("</") {
            open.pop();
            until(">")
        } else {
            let end = tag_end(text, start + 1);
            let tag = &text[start..end];
            let name = tag
                .find([' ', '\t', '\r', '\n', '/', '>'])
                .unwrap_or(tag.len());
            for (at, name) in tag.match_indices("xmlns") {
                name_spaces += 1;
                if MOST_NAME_SPACES < name_spaces {
                    let span = Span::new(start + at, start + at + name.len());
                    let expected = "elements without prefixes";
                    return Err(too_many(span, MOST_NAME_SPACES, "namespaces", expected));
                }
            }
            let name = Span::new(start, start + name);
            if MOST_ATTRIBUTES < tag.matches('=').count() {
                let expected = "fewer attributes";
                return Err(too_many(name, MOST_ATTRIBUTES, "attributes", expected));
            }
            if !tag.ends_with("/>") {
                if open.len() == MOST_LEVELS {
                    let (what, expected) = ("levels of elements", "fewer levels");
                    return Err(too_many(name, MOST_LEVELS, what, expected));
                }
                open.push(name);
            }
            end
        };
    }
    Ok(open)
}

/// The end of a tag, after its `>`, from an offset inside the tag but not between quotes.
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

fn too_many(span: Span, most: usize, what: &str, expected: &str) -> Diagnostic {
    let message = format!("more than {most} {what} are not supported");
    Diagnostic::error(span, message, expected)
}

fn doctype(span: Span) -> Diagnostic {
    let message = "document type declarations are not supported";
    Diagnostic::error(span, message, "an element")
        .with_hint("remove it: scenes need none, and entities are not resolved")
}
