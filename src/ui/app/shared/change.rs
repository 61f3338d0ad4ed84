//! The last change, as what it did, so that it can be done to something else.

use language::Motion;
use language::schema::Field;

/// What the last change did.
#[derive(Clone, Debug)]
pub(crate) enum Change {
    /// It set components of a field to these literals.
    Set(&'static Field, Vec<(usize, String)>),
    /// It changed a component of a field by an amount.
    Nudged(&'static Field, usize, f64),
    /// It changed the type to this one.
    Retyped(String),
    /// It moved, rotated or scaled something.
    Moved {
        /// How, about the place that the thing had.
        motion: Motion,
        /// The decimals of the numbers that changed.
        decimals: usize,
        /// How, in words.
        words: String,
    },
}
