//! What is wrong with a text, where, and what would be right.

use super::Span;

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text has a meaning, though perhaps not the one intended.
    Warning,
    /// The text has no meaning; nothing is rendered from it.
    Error,
}

/// One message about one place of a text. File name, line and excerpt are added where it is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// The offending text; empty where something is missing.
    pub span: Span,
    /// What is wrong, with the field named: `object 2 (box) length: must be greater than 0`.
    pub message: String,
    /// What was expected there, to stand under the excerpt: `a number greater than 0`.
    pub expected: String,
    /// The way out, where one is known.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            span,
            message: message.into(),
            expected: expected.into(),
            hint: None,
        }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(span, message, expected)
        }
    }

    /// The same with a hint.
    #[must_use]
    pub fn with_hint(self, hint: impl Into<String>) -> Self {
        Self {
            hint: Some(hint.into()),
            ..self
        }
    }

    /// Whether it keeps the scene from being rendered.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
