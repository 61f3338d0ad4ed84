//! Numbers of things in words.

/// A number of things: `1 error`, `2 errors`.
pub fn counted(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
