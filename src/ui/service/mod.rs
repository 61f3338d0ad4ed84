//! Background work: threads that read, write, watch, compare and explain, so that no key press
//! waits for them.

pub mod assets;
pub mod comparer;
pub mod deriving;
pub mod destination;
pub mod explaining;
pub mod filming;
pub mod recent;
pub mod scene_loader;
pub mod tracks;
pub mod writing;
