//! Tracks: played, keyed and exported.

mod exporting;
mod playing;

use super::*;
