//! Errors, warnings and notes at spans of a text.

use super::{Edit, Position, Span};

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text is valid and common, but its author may not know what it means here.
    Note,
    /// The text is valid, but perhaps not what was intended.
    Warning,
    /// The text is invalid; nothing is rendered.
    Error,
}

/// A message about one span of a text. File name, line and excerpt are added on display.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether this prevents rendering.
    pub severity: Severity,
    /// The offending text; empty if something is missing there.
    pub span: Span,
    /// The problem, with the field: `object 2 (box) length: must be greater than 0`.
    pub message: String,
    /// What was expected, shown under the excerpt: `a number greater than 0`.
    pub expected: String,
    /// How to fix it, if known.
    pub hint: Option<String>,
    /// The edits of the text that do, sorted and disjoint; empty if they are not known.
    pub fix: Vec<Edit>,
    /// The place in another file that it is about; the span then leads to that file.
    pub cited: Option<Box<Cited>>,
}

/// A place in another file than the text, with its line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cited {
    /// The file as named by the text, relative to its folder.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, in characters from 1.
    pub column: usize,
    /// The line, or the part of a long one around the offending text.
    pub excerpt: String,
    /// The offending text in the excerpt.
    pub marked: Span,
}

/// What a diagnostic shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown<'a> {
    /// The other file that it is about, as in [`Cited`]; `None` for the text itself.
    pub file: Option<&'a str>,
    /// Where the offending text begins in that file.
    pub position: Position,
    /// A text with the line.
    pub text: &'a str,
    /// The offending text in it.
    pub span: Span,
}

/// The hint of a warning about valid text that has no effect.
pub const SKIPPED: &str = "it is skipped";

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            span,
            message: message.into(),
            expected: expected.into(),
            hint: None,
            fix: Vec::new(),
            cited: None,
        }
    }

    /// What to show of it, given the text of its span.
    pub fn shown<'a>(&'a self, text: &'a str) -> Shown<'a> {
        match &self.cited {
            Some(cited) => Shown {
                file: Some(&cited.file),
                position: Position {
                    line: cited.line,
                    column: cited.column,
                },
                text: &cited.excerpt,
                span: cited.marked,
            },
            None => Shown {
                file: None,
                position: Position::of(text, self.span.start()),
                text,
                span: self.span,
            },
        }
    }

    /// Adds the place in another file that it is about.
    #[must_use]
    pub fn citing(self, cited: Cited) -> Self {
        Self {
            cited: Some(Box::new(cited)),
            ..self
        }
    }

    /// The problem and how to fix it, for a line without an excerpt.
    pub fn message_with_hint(&self) -> String {
        match &self.hint {
            Some(hint) => format!("{}; {hint}", self.message_with_file()),
            None => self.message_with_file(),
        }
    }

    /// The problem, with its place if that is in another file, for a line without an excerpt.
    pub fn message_with_file(&self) -> String {
        match self.cited.as_deref() {
            Some(Cited {
                file, line, column, ..
            }) => format!("{file}:{line}:{column}: {}", self.message),
            None => self.message.clone(),
        }
    }

    /// The same for a value that was refused instead of written, so that nothing is [`SKIPPED`].
    #[must_use]
    pub fn refused(mut self) -> Self {
        self.hint = self.hint.and_then(|hint| match hint.strip_prefix(SKIPPED) {
            Some(rest) => rest.strip_prefix("; ").map(str::to_owned),
            None => Some(hint),
        });
        self
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(span, message, expected)
        }
    }

    /// A note at `span`.
    pub fn note(span: Span, message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            severity: Severity::Note,
            ..Self::error(span, message, expected)
        }
    }

    /// Adds advice on how to correct the text, in the imperative.
    #[must_use]
    pub fn with_hint(self, hint: impl Into<String>) -> Self {
        Self {
            hint: Some(hint.into()),
            ..self
        }
    }

    /// Adds an edit that corrects the text, behind those added before, which belong to it.
    #[must_use]
    pub fn with_fix(mut self, span: Span, text: impl Into<String>) -> Self {
        let text = text.into();
        self.fix.push(Edit { span, text });
        self
    }

    /// The same in a text in which its parts are elsewhere.
    #[must_use]
    pub fn moved(mut self, place: impl Fn(Span) -> Span) -> Self {
        self.span = place(self.span);
        for edit in &mut self.fix {
            edit.span = place(edit.span);
        }
        self
    }

    /// Whether this prevents rendering.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
