//! Pixels from a scene. Knows no documents, files or terminals.
//!
//! A [`Renderer`] is a handle on a worker thread that traces the newest [`Job`] it was given and
//! shows its progress as [`Frame`]s. Every sample is a pure function of (scene, camera, settings,
//! pixel, sample index) and each pixel's samples are added in the order of their indices, so a
//! finished frame has the same bits for any number of threads and any history of cancelled jobs.
//!
//! Dropping a renderer ends its work soon, however large the picture: work asks every few
//! milliseconds whether to stop, a film's memory is first touched as it is traced, and is left to
//! the pool to free.
//!
//! The way of a picture: [`renderer`] hands a job to [`worker`], which builds a [`world`] with the
//! [`structures`] of its meshes and fills the [`tile`]s of a [`film`] in [`steps`]; each sample takes
//! its numbers from [`sampler`], its place around the pixel from [`filter`], its ray from [`camera`]
//! and its radiance from a [`tracer`], or something else from [`first_hit`]; [`tone`] makes the film a
//! frame, and [`noise`] says how far that is from the last one.
//!
//! Pixels of live pictures remember what they depend on ([`touched`]): an edit of a material or of a
//! light's colour takes over the film as far as it is, and only what depends on it is traced anew.
//!
//! A tracer gathers light in one of two ways: [`whitted`], a [`wave`] of samples at once, whose rays
//! land on [`surfaces`] and [`branch`]; or [`path`], one sample after the other. Both ask the world by
//! a [`probe`], come to matter of [`phong`] (with its [`texture`]s) or [`utah`] (with those of
//! [`mapped`]) and ask [`lights`] for their [`direct`] light; [`optics`], [`lobes`], [`microfacet`] and
//! [`warp`] are the formulas.
//!
//! Rays meet the world eight side by side, against one object after the other ([`packets`]), or alone,
//! against up to eight [`spheres`] at once ([`intersect`]). Neither changes a bit of what is met.

mod branch;
mod camera;
mod direct;
mod film;
mod filter;
mod first_hit;
mod frame;
mod intersect;
mod lights;
mod lobes;
mod mapped;
mod microfacet;
mod noise;
mod optics;
mod packets;
mod path;
mod phong;
mod probe;
mod renderer;
mod room;
mod sampler;
mod shared;
mod shot;
mod spheres;
mod steps;
mod structures;
mod surfaces;
mod texture;
mod tile;
mod tone;
mod touched;
mod tracer;
mod utah;
mod warp;
mod wave;
mod whitted;
mod worker;
mod world;

pub use filter::Filter;
pub use frame::{
    Aov, DEFAULT_DEPTH, DEFAULT_SPP, Frame, Frames, Job, MAX_SPP, NO_OBJECT, Progress, Settings,
    default_depth,
};
pub use renderer::{Refusal, Renderer, Threads};

#[cfg(test)]
mod tests;
