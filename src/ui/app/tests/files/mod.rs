//! The files of the scene.

mod assets;
mod buffers;
mod disk;
mod opening;
mod recovering;
mod reloading;
mod saving;
mod starting;
mod two_sides;

use super::*;
