//! The key that asks where something is.

use super::screen::{HERE, LIST, toggle};
use crate::app::room::Row;
use crate::keymap::{Key, Scope, c};

use Scope::These;

#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(These(HERE), "where", &[c('W')], "where is it: seen, hidden by what, lit by what").also("where find locate hidden invisible missing").hint_in(LIST, 70, "where").does(toggle),
];
