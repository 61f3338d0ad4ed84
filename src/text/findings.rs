//! All diagnostics of a text, up to a limit.

use std::ops::Deref;

use super::{Diagnostic, Edit, Position, Severity, counted};

/// Maximum number of diagnostics kept per severity. More tell the user nothing new, and a hostile
/// text could cause millions.
const LIMIT: usize = 100;

/// Diagnostics, at most a hundred of each severity, and their total numbers. Dereferences to the
/// diagnostics kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    kept: Vec<Diagnostic>,
    errors: usize,
    warnings: usize,
    notes: usize,
}

impl Findings {
    /// Adds an error; `make` is called only if it is kept.
    pub fn error(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.errors += 1;
        if self.errors <= LIMIT {
            self.kept.push(make());
        }
    }

    /// Adds a warning; `make` is called only if it is kept.
    pub fn warning(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.warnings += 1;
        if self.warnings <= LIMIT {
            self.kept.push(make());
        }
    }

    /// Adds a note; `make` is called only if it is kept.
    pub fn note(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.notes += 1;
        if self.notes <= LIMIT {
            self.kept.push(make());
        }
    }

    /// Appends later findings, as if added one by one.
    pub fn append(&mut self, later: Self) {
        let more = [later.errors, later.warnings, later.notes];
        for diagnostic in later.kept {
            match diagnostic.severity {
                Severity::Error => self.error(|| diagnostic),
                Severity::Warning => self.warning(|| diagnostic),
                Severity::Note => self.note(|| diagnostic),
            }
        }
        let [errors, warnings, notes] = more.map(|count| count.saturating_sub(LIMIT));
        self.errors += errors;
        self.warnings += warnings;
        self.notes += notes;
    }

    /// Turns every warning into an error.
    #[must_use]
    pub fn strict(mut self) -> Self {
        for diagnostic in &mut self.kept {
            if diagnostic.severity == Severity::Warning {
                diagnostic.severity = Severity::Error;
            }
        }
        self.errors += std::mem::take(&mut self.warnings);
        self
    }

    /// Replaces the names of cited files by those that `name` gives.
    #[must_use]
    pub fn citing(mut self, name: impl Fn(&str) -> Option<String>) -> Self {
        let cited = self.kept.iter_mut().filter_map(|kept| kept.cited.as_mut());
        for cited in cited {
            if let Some(name) = name(&cited.file) {
                cited.file = name;
            }
        }
        self
    }

    /// The number of errors, kept or not.
    pub fn errors(&self) -> usize {
        self.errors
    }

    /// The number of warnings, kept or not.
    pub fn warnings(&self) -> usize {
        self.warnings
    }

    /// The number of notes, kept or not.
    pub fn notes(&self) -> usize {
        self.notes
    }

    /// The number of findings, kept or not.
    pub fn count(&self) -> usize {
        self.errors + self.warnings + self.notes
    }

    /// The first error kept.
    pub fn first_error(&self) -> Option<&Diagnostic> {
        self.kept.iter().find(|d| d.severity == Severity::Error)
    }

    /// The number of errors in words, and where in `text` the first one is:
    /// `2 errors, the first at 3:1: unknown shape`.
    pub fn errors_in(&self, text: &str) -> String {
        let count = counted(self.errors, "error");
        let Some(first) = self.first_error() else {
            return count;
        };
        let Position { line, column } = Position::of(text, first.span.start());
        format!("{count}, the first at {line}:{column}: {}", first.message)
    }

    /// Whether edits that turn the text of these findings into that of `after` mend one of them: it is said
    /// less often or, where only the first error is found, of a place behind what they replace.
    pub fn is_mended(&self, found: &Diagnostic, edits: &[Edit], after: &Self) -> bool {
        let same = |all: &Self| {
            let same = all.iter().filter(|other| other.message == found.message);
            same.map(|other| other.span.start()).collect::<Vec<_>>()
        };
        let (before, left) = (same(self), same(after));
        let (Some(first), Some(last)) = (edits.first(), edits.last()) else {
            return false;
        };
        let is_here =
            !before.is_empty() && !first.span.is_empty() && first.span.touches(found.span);
        left.len() < before.len()
            || (is_here && self.errors == 1 && left.iter().all(|at| last.placed().end() <= *at))
    }

    /// Sorts the diagnostics kept by the start of their spans.
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
    use crate::Span;

    #[test]
    fn a_hundred_of_each_severity_are_kept_and_all_are_counted() {
        let mut found = Findings::default();
        for at in (0..1000).rev() {
            found.error(|| Diagnostic::error(Span::at(at), "e", ""));
            found.warning(|| Diagnostic::warning(Span::at(at), "w", ""));
            found.note(|| Diagnostic::note(Span::at(at), "n", ""));
        }
        let mut all = Findings::default();
        all.append(found.sorted());
        assert_eq!(
            (all.errors(), all.warnings(), all.notes()),
            (1000, 1000, 1000)
        );
        assert_eq!((all.len(), all.count()), (300, 3000));
        assert_eq!(all[0].span, Span::at(900));
        let strict = all.strict();
        assert_eq!(
            (strict.errors(), strict.warnings(), strict.notes()),
            (2000, 0, 1000)
        );
        assert_eq!(strict.iter().filter(|found| found.is_error()).count(), 200);
    }
}
