//! Text within HTML and XML.

/// Escapes a text, so that it is one in elements and in quoted attributes. Characters that XML 1.0 cannot
/// hold become U+FFFD.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'.. => {
                escaped.push(character);
            }
            _ => escaped.push('\u{fffd}'),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_is_markup() {
        for (text, shown) in [
            ("a.ray", "a.ray"),
            ("<script>&\"'", "&lt;script&gt;&amp;&quot;&#39;"),
            (
                "\u{0}\u{1b}\u{ffff}é\u{1f600}",
                "\u{fffd}\u{fffd}\u{fffd}é\u{1f600}",
            ),
        ] {
            assert_eq!(escaped(text), shown);
        }
    }
}
