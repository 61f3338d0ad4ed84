//! Positions and changes in text: spans, edits, numbers, diagnostics. Knows no language.

mod diagnostic;
mod edit;
mod number;
mod span;
mod visible;

pub use diagnostic::{Diagnostic, Severity};
pub use edit::{Edit, apply, smallest_edit};
pub use number::{NumberError, decimals, parse_number, spell_like};
pub use span::{Position, Span};
pub use visible::visible;
