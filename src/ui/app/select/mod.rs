//! SELECT: the list, and what is done with the selected things.

mod adding;
mod filtering;
mod keys;
mod standing;
mod structure;

pub(crate) use adding::{add, add_mesh, own_kind};
pub(crate) use filtering::{drop_filter, end_filter, filter_key, filter_list, keep_filter};
pub(crate) use keys::{KEYS, OTHERS};
pub(crate) use structure::{
    delete_anyway, insert, orthonormalise, question_before_deleting, rename, restructure,
};
