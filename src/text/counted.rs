//! Counts with nouns.

/// A count with its noun, in the plural unless it is 1: `1 error`, `2 errors`.
pub fn counted(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
