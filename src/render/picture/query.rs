//! What can be asked of the pixels of a frame.

use std::sync::{Arc, Weak};

use crate::integrators::Photons;
use crate::job::Settings;
use crate::world::World;
use scene::Camera;

/// A handle by which pixels of a frame are traced again and explained.
///
/// It keeps nothing alive: it answers as long as the renderer holds the scene prepared, which may end
/// once a later job is given.
#[derive(Clone, Debug)]
pub struct Query {
    pub(crate) world: Weak<World>,
    /// Where photons are traced.
    pub(crate) photons: Weak<Photons>,
    /// The camera that it shows.
    pub camera: Camera,
    /// What it was traced with.
    pub settings: Settings,
    pub(crate) numbers: Option<Arc<[u32]>>,
}

impl Query {
    /// One without answers, like that of a renderer that was dropped.
    pub fn unanswered(camera: Camera, settings: Settings) -> Self {
        Self {
            world: Weak::new(),
            photons: Weak::new(),
            camera,
            settings,
            numbers: None,
        }
    }
}
