//! The rows of keys that all modes share: what each does, whether it would do something now, and what is
//! said of it. A mode that is a room has its own beside its state.

pub(crate) mod anywhere;
pub(crate) mod lists;
pub(crate) mod pages;
pub(crate) mod questions;
