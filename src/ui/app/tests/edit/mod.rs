//! Fields: nudged, typed, chosen, slid and picked.

mod colours;
mod fields;
mod inputs;
mod lines;
mod nudging;
mod repeating;

use super::*;
