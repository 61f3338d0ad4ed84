//! The roles that the leaves of a `.dat` text play.

use super::tree::is_comment;
use crate::roles::{ANYWHERE, Roles, role};
use text::{Span, line_end};

/// The roles of leaves: a number's is its distance from the last word before it, in a record of its
/// kind. Lists and options may be anywhere in a record.
pub(super) fn roles(text: &str, leaves: &[Span]) -> Roles {
    let mut roles = Vec::with_capacity(leaves.len());
    let mut end = None;
    let (mut kind, mut index, mut is_id) = (0, 0, false);
    for leaf in leaves {
        let word = leaf.of(text);
        if is_comment(word) {
            roles.push(ANYWHERE);
            continue;
        }
        if end.is_none_or(|end| end <= leaf.start()) {
            end = Some(line_end(text, leaf.start()));
            kind = word.bytes().next().filter(u8::is_ascii).unwrap_or(b' ');
            (index, is_id) = (0, false);
        }
        let is_word = word.starts_with(|first: char| first.is_ascii_alphabetic());
        if is_word {
            roles.push(role(kind, 0));
            (index, is_id) = (2, word == "ID");
            continue;
        }
        roles.push(role(kind, if is_id { 1 } else { index }));
        (index, is_id) = (index + 1, false);
    }
    Roles { roles, unknown: 0 }
}
