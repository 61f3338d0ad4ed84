//! Words of shell command lines.

use std::borrow::Cow;
use std::str::Chars;

/// Quotes a path for a shell command line, so that one that begins with `-` is not read as an option.
pub fn shell_path(path: &str) -> String {
    if path.starts_with('-') {
        shell_word(&format!("./{path}")).into_owned()
    } else {
        shell_word(path).into_owned()
    }
}

/// Quotes a word, which must not contain NUL, for a shell command line.
pub fn shell_word(word: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "+-./:@_".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        Cow::Borrowed(word)
    } else if !word.contains(['\'', '\\']) {
        Cow::Owned(format!("'{word}'"))
    } else if !word.contains(['"', '$', '`', '!']) {
        // In single quotes fish reads a backslash as the beginning of an escape.
        Cow::Owned(format!("\"{}\"", word.replace('\\', r"\\")))
    } else {
        Cow::Owned(format!("'{}'", word.replace('\'', r"'\''")))
    }
}

/// Splits a command line into words, with a shell's quotes, backslashes and comments (POSIX.1-2024,
/// Shell Command Language, 2.2 and 2.3); `None` if a quote is unmatched or nothing follows a
/// backslash. Nothing is expanded.
pub fn shell_words(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    // The word so far, and whether it has begun: `''` is a word.
    let mut word: Option<String> = None;
    let mut chars = line.chars();
    while let Some(c) = chars.next() {
        match c {
            ' ' | '\t' | '\n' => words.extend(word.take()),
            '#' if word.is_none() => {
                let _ = chars.find(|&c| c == '\n');
            }
            '\\' if chars.as_str().starts_with('\n') => {
                let _ = chars.next();
            }
            _ => {
                let word = word.get_or_insert_default();
                match c {
                    '\'' => until_quote(&mut chars, word)?,
                    '"' => until_double_quote(&mut chars, word)?,
                    '\\' => word.push(chars.next()?),
                    _ => word.push(c),
                }
            }
        }
    }
    words.extend(word);
    Some(words)
}

/// Adds what comes before the next `'` to a word.
fn until_quote(chars: &mut Chars<'_>, word: &mut String) -> Option<()> {
    loop {
        match chars.next()? {
            '\'' => return Some(()),
            c => word.push(c),
        }
    }
}

/// Adds what comes before the next `"` to a word. There, a backslash escapes only some characters,
/// and stands for itself before others.
fn until_double_quote(chars: &mut Chars<'_>, word: &mut String) -> Option<()> {
    loop {
        match chars.next()? {
            '"' => return Some(()),
            '\\' => match chars.next()? {
                '\n' => {}
                c @ ('$' | '`' | '"' | '\\') => word.push(c),
                c => word.extend(['\\', c]),
            },
            c => word.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_quoted_for_a_shell() {
        for (path, typed) in [
            ("a/b.ray", "a/b.ray"),
            ("my scene.ray", "'my scene.ray'"),
            ("it's.ray", "\"it's.ray\""),
            ("$(a).ray", "'$(a).ray'"),
            ("a;b`c`.ray", "'a;b`c`.ray'"),
            ("~/a.ray", "'~/a.ray'"),
            ("-x.ray", "./-x.ray"),
            ("it's $1", r"'it'\''s $1'"),
            (r"a\b.ray", r#""a\\b.ray""#),
            ("", "''"),
        ] {
            assert_eq!(shell_path(path), typed);
            let path = if path.starts_with('-') { typed } else { path };
            assert_eq!(shell_words(typed), Some(vec![path.to_owned()]));
        }
    }

    /// Against `sh -c 'printf "<%s>" LINE'`.
    #[test]
    fn a_command_line_is_split_as_by_a_shell() {
        for (line, words) in [
            ("", Some(&[][..])),
            (" vi\t-R \n a ", Some(&["vi", "-R", "a"])),
            ("vi '' \"\"", Some(&["vi", "", ""])),
            ("a' b'c\" d\"", Some(&["a bc d"])),
            (r#"'it'\''s' "\"\$\`\\\a'""#, Some(&["it's", "\"$`\\\\a'"])),
            (r"a\ b \'", Some(&["a b", "'"])),
            ("a\\\nb \"c\\\nd\"", Some(&["ab", "cd"])),
            ("a#b #c 'd\ne", Some(&["a#b", "e"])),
            ("vi \\\n -R", Some(&["vi", "-R"])),
            ("a \\\n#b", Some(&["a"])),
            ("vi 'a", None),
            ("vi \"a'", None),
            ("vi \"a\\", None),
            ("vi \\", None),
        ] {
            let words = words.map(|words| words.iter().map(ToString::to_string).collect());
            assert_eq!(shell_words(line), words, "{line}");
        }
    }
}
