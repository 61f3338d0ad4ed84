//! The roles that the leaves of an `.xml` text play.

use super::tree::Tree;
use crate::roles::{ANYWHERE, Role, Roles};
use text::Span;

/// The roles of leaves: the name of the innermost named element that they are in, since things that
/// change places are told apart by their names.
pub(super) fn roles(text: &str, tree: &Tree, leaves: &[Span]) -> Roles {
    let mut open: Vec<(usize, Role)> = Vec::new();
    let mut next = 0;
    let role_of = |leaf: &Span| {
        while let Some(element) = tree.elements.get(next)
            && element.whole.start() <= leaf.start()
        {
            close(&mut open, element.whole.start());
            let outer = open.last().map_or(ANYWHERE, |(_, role)| *role);
            let name = tree.attribute(text, next, "name");
            let role = name.map_or(outer, |name| named(name.unescaped(text)));
            open.push((element.whole.end(), role));
            next += 1;
        }
        close(&mut open, leaf.start());
        open.last().map_or(ANYWHERE, |(_, role)| *role)
    };
    Roles {
        roles: leaves.iter().map(role_of).collect(),
        unknown: 0,
    }
}

/// Leaves the elements that end before an offset, or at it.
fn close(open: &mut Vec<(usize, Role)>, offset: usize) {
    while open.pop_if(|(end, _)| *end <= offset).is_some() {}
}

/// The role of what has a name: 14 bits of its FNV-1a hash.
fn named(name: &str) -> Role {
    let hash = name.bytes().fold(0x811C_9DC5_u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    });
    [7, 0].map(|shift| ((hash >> 16 ^ hash) >> shift & 0x7F) as u8)
}
