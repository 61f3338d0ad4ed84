//! Positions and changes in text: spans, edits, numbers, diagnostics. Knows no language.

mod counted;
mod diagnostic;
mod edit;
mod findings;
mod number;
mod percentage;
mod slips;
mod span;
mod visible;

pub use counted::counted;
pub use diagnostic::{Diagnostic, Severity};
pub use edit::{Edit, apply, difference, smallest_edit};
pub use findings::Findings;
pub use number::{NumberError, concise, decimals, is_integer, parse_number, spell_like};
pub use percentage::percentage;
pub use slips::slips;
pub use span::{Position, Span, mark_len};
pub use visible::visible;
