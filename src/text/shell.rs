//! Words of shell command lines.

use std::borrow::Cow;

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
    shlex::try_quote(word).unwrap_or(Cow::Borrowed(word))
}

/// Splits a command line into words, with a shell's quotes and backslashes; `None` if a quote is
/// unmatched.
pub fn shell_words(line: &str) -> Option<Vec<String>> {
    shlex::split(line)
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
        ] {
            assert_eq!(shell_path(path), typed);
            let path = if path.starts_with('-') { typed } else { path };
            assert_eq!(shell_words(typed), Some(vec![path.to_owned()]));
        }
        assert_eq!(shell_words("vi 'a"), None);
    }
}
