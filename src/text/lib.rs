//! Spans, edits, numbers and diagnostics of text. Knows no language.

mod base64;
mod codes;
mod comment_columns;
mod counted;
mod diagnostic;
mod duration;
mod edit;
mod findings;
mod lines;
mod nearest;
mod number;
mod number_hint;
mod percentage;
mod seek;
mod shell;
mod span;
mod visible;

pub use base64::base64;
pub use codes::without_codes;
pub use comment_columns::keep_columns;
pub use counted::{alternatives, counted};
pub use diagnostic::{Cited, Diagnostic, SKIPPED, Severity, Shown};
pub use duration::parse_duration;
pub use edit::{Edit, apply, common_prefix, cover, difference, smallest_edit};
pub use findings::Findings;
pub use lines::{is_line_end, is_one_line_end, line_end, line_start, next_line};
pub use nearest::{did_you_mean, nearest_word};
pub use number::{
    NumberError, are_plain_numbers, concise, decimals, is_integer, leading_number, parse_number,
    rounded, spell_like, without_suffix,
};
pub use number_hint::meant_number;
pub use percentage::percentage;
pub use seek::first_byte;
pub use shell::{shell_path, shell_word, shell_words};
pub use span::{Position, Span, mark_len};
pub use visible::{columns, visible};
