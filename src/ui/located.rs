//! Where things are in the picture: what is asked of the background, and what it answers.

use render::{Job, UnlitReason};

/// What is to be located.
#[derive(Clone, Debug)]
pub struct Search {
    /// The number of the search, which its answer has.
    pub ticket: u64,
    /// The picture; of its samples only the first of each pixel counts.
    pub job: Job,
    /// What is sought.
    pub sought: Sought,
}

/// What is sought in a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sought {
    /// These objects, as frames call them, ascending.
    Objects(Vec<u32>),
    /// What a light lights.
    Light(u32),
}

/// Where something is in a picture. Parts of the picture are counted in pixels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Located {
    /// The pixels of the picture.
    pub pixels: usize,
    /// Those that objects would have with nothing in front of them.
    pub covered: usize,
    /// Those that they have.
    pub seen: usize,
    /// Those that would have another colour without them, or without the light.
    pub changed: usize,
    /// The objects in front of them and how many pixels each takes, most first.
    pub hiders: Vec<(u32, usize)>,
    /// What each light is to the pixels that objects have.
    pub lights: Vec<Lit>,
    /// The objects that a light lights and in how many pixels, most first.
    pub lit: Vec<(u32, usize)>,
}

/// What a light is to some pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lit {
    /// The light.
    pub light: u32,
    /// The pixels that it lights.
    pub reached: usize,
    /// The pixels in which it is asked for.
    pub asked: usize,
    /// Why it lights none of the others, if it lights none, and the object that hides it in most.
    pub dark: Option<(UnlitReason, Option<u32>)>,
}
