//! The rows of keys that all modes share: what each does, whether it would do something now, and what is
//! said of it. A mode that is a room has its own beside its state.

pub(super) mod anywhere;
pub(super) mod camera;
pub(super) mod compare;
pub(super) mod display;
pub(super) mod edit;
pub(super) mod inspect;
pub(super) mod lists;
pub(super) mod pages;
pub(super) mod questions;
mod row;
pub(super) mod select;
pub(super) mod trace;
pub(super) mod transform;

pub(super) use row::Row;
