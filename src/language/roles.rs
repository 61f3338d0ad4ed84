//! The roles that leaves play in a text, by which equal leaves are told apart.

/// The role that a leaf plays, such as a count or the third number of a material: two ASCII
/// characters, the first for what the leaf is part of.
pub type Role = [u8; 2];

/// The role of leaves that can stand anywhere.
pub(super) const ANYWHERE: Role = *b"  ";

/// The roles of the leaves of a text, or of some lines of it.
#[derive(Clone, Debug, Default)]
pub struct Roles {
    /// The role of each leaf, in order.
    pub roles: Vec<Role>,
    /// The number of leaves at the beginning whose roles depend on lines outside.
    pub unknown: usize,
}

impl Roles {
    /// Roles of leaves that can all stand anywhere.
    pub fn anywhere(leaves: usize) -> Self {
        Self {
            roles: vec![ANYWHERE; leaves],
            unknown: 0,
        }
    }
}

/// The role of the leaf with this index in something; those far behind share one.
pub(super) fn role(of: u8, index: usize) -> Role {
    [of, index.min(0x7F) as u8]
}
