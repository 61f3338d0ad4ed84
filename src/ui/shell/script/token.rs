//! The words and quoted texts of a script.

use text::{Diagnostic, Span, mark_len};

/// A word or a text in quotation marks.
#[derive(Clone, Debug)]
pub(super) enum Token {
    Word(String, Span),
    /// The text without its quotation marks.
    Text(String, Span),
    /// A text without its last quotation mark.
    Open(Span),
}

impl Token {
    pub(super) fn span(&self) -> Span {
        match self {
            Self::Word(_, span) | Self::Text(_, span) | Self::Open(span) => *span,
        }
    }
}

/// Reads a text from the start.
pub(super) struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let at = mark_len(text);
        Self { text, at }
    }

    /// The next token; `None` at the end.
    pub(super) fn next(&mut self) -> Option<Token> {
        loop {
            let rest = &self.text[self.at..];
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            match trimmed.chars().next()? {
                '#' => self.at += trimmed.find('\n').unwrap_or(trimmed.len()),
                '"' => return Some(self.quoted()),
                _ => {
                    let end = trimmed.find(char::is_whitespace).unwrap_or(trimmed.len());
                    return Some(Token::Word(trimmed[..end].to_owned(), self.step_over(end)));
                }
            }
        }
    }

    /// Reads the argument of a command, which stands at `command`.
    pub(super) fn argument<T>(
        &mut self,
        command: Span,
        name: &str,
        expected: &str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Result<T, Diagnostic> {
        let (text, span) = match self.next() {
            Some(Token::Word(text, span) | Token::Text(text, span)) => (text, span),
            Some(Token::Open(span)) => {
                let message = format!("{name}: this text has no end");
                return Err(Diagnostic::error(span, message, expected));
            }
            None => {
                let message = format!("{name}: nothing follows");
                return Err(Diagnostic::error(command, message, expected));
            }
        };
        read(&text).ok_or_else(|| {
            Diagnostic::error(span, format!("{name}: {text} is not valid"), expected)
        })
    }

    fn quoted(&mut self) -> Token {
        let rest = &self.text[self.at..];
        let mut text = String::new();
        let mut characters = rest.char_indices().skip(1);
        while let Some((at, character)) = characters.next() {
            match character {
                '"' => return Token::Text(text, self.step_over(at + 1)),
                '\n' => return Token::Open(self.step_over(at)),
                '\\' => match characters.next() {
                    Some((_, 'n')) => text.push('\n'),
                    Some((_, 't')) => text.push('\t'),
                    Some((_, other)) => text.push(other),
                    None => break,
                },
                other => text.push(other),
            }
        }
        Token::Open(self.step_over(rest.len()))
    }

    fn step_over(&mut self, bytes: usize) -> Span {
        let start = self.at;
        self.at += bytes;
        Span::new(start, self.at)
    }
}
