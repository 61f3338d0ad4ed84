//! Changes of the text as a whole.

mod live_edits;
mod naming;
mod sequences;

use super::*;
