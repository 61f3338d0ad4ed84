//! All that is wrong with a text, as far as it is worth telling.

use std::ops::Deref;

use super::{Diagnostic, Severity};

/// More messages than this of one severity say nothing new, and a hostile text could ask for
/// millions.
const LIMIT: usize = 100;

/// Diagnostics, at most a hundred of each severity, and how many there are in all. It reads as the
/// list of those kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    kept: Vec<Diagnostic>,
    errors: usize,
    warnings: usize,
}

impl Findings {
    /// Adds an error, made only if it is kept.
    pub fn error(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.errors += 1;
        if self.errors <= LIMIT {
            self.kept.push(make());
        }
    }

    /// Adds a warning, made only if it is kept.
    pub fn warning(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.warnings += 1;
        if self.warnings <= LIMIT {
            self.kept.push(make());
        }
    }

    /// Adds what was found later, as if one by one.
    pub fn append(&mut self, later: Self) {
        let more = (later.errors, later.warnings);
        for diagnostic in later.kept {
            if diagnostic.is_error() {
                self.error(|| diagnostic);
            } else {
                self.warning(|| diagnostic);
            }
        }
        let kept = |count: usize| count.saturating_sub(LIMIT);
        self.errors += kept(more.0);
        self.warnings += kept(more.1);
    }

    /// The same with every warning as an error.
    #[must_use]
    pub fn strict(mut self) -> Self {
        for diagnostic in &mut self.kept {
            diagnostic.severity = Severity::Error;
        }
        self.errors += std::mem::take(&mut self.warnings);
        self
    }

    /// How many errors there are, kept or not.
    pub fn errors(&self) -> usize {
        self.errors
    }

    /// How many warnings there are, kept or not.
    pub fn warnings(&self) -> usize {
        self.warnings
    }

    /// The first error that is kept.
    pub fn first_error(&self) -> Option<&Diagnostic> {
        self.kept.iter().find(|d| d.severity == Severity::Error)
    }

    /// The same in text order.
    #[must_use]
    pub fn sorted(mut self) -> Self {
        self.kept.sort_by_key(|diagnostic| diagnostic.span.start());
        self
    }
}

impl Deref for Findings {
    type Target = [Diagnostic];

    fn deref(&self) -> &[Diagnostic] {
        &self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Span;

    #[test]
    fn a_hundred_of_each_are_kept_and_all_are_counted() {
        let mut found = Findings::default();
        for at in (0..1000).rev() {
            found.error(|| Diagnostic::error(Span::at(at), "e", ""));
            found.warning(|| Diagnostic::warning(Span::at(at), "w", ""));
        }
        let found = found.sorted();
        assert_eq!((found.errors(), found.warnings()), (1000, 1000));
        assert_eq!(found.len(), 200);
        assert_eq!(found[0].span, Span::at(900));
        let found = found.strict();
        assert_eq!((found.errors(), found.warnings()), (2000, 0));
        assert!(found.len() == 200 && found.iter().all(Diagnostic::is_error));
    }
}
