//! The list, and what is done with the selected things.

mod adding;
mod listing;
mod moving;
mod soloing;
pub(super) mod structure;
mod whereabouts;

use super::*;
