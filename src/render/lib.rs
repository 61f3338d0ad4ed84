//! Traces scenes to pixels. Independent of documents, files and terminals.
//!
//! A [`Renderer`] is a handle to a worker thread that traces the newest [`Job`] and publishes its
//! progress as [`Frame`]s. Every sample is a pure function of (scene, camera, settings, pixel,
//! sample index), and the samples of a pixel are added in index order, so a finished frame has the
//! same bits for any number of threads and any history of cancelled jobs.
//!
//! # The rooms, from the bottom up
//!
//! A room uses those above it in this table, and no others. Its `mod.rs` lists what the rooms below it
//! may use.
//!
//! | room | holds |
//! |---|---|
//! | [`simd_level`] | the vector instructions that tracing uses |
//! | [`sampling`] | random numbers, and their mappings to pixels and directions; multiple importance sampling |
//! | [`material`] | what a surface does with light: textures, Whitted shading, lobes, mirrors and boundaries |
//! | [`light`] | what sends light: lights, objects that emit, the environment |
//! | [`job`] | what is asked: settings, region, AOV |
//! | [`world`] | a scene made ready: structures, intersection, surface points, cameras |
//! | [`integrators`] | radiance along camera rays: Whitted, paths, photons, first hits |
//! | [`picture`] | frames: tone mapping, noise reduction, histograms, what a file says of its picture |
//! | [`engine`] | films traced tile by tile in the background, or block by block; unfinished pictures |
//! | [`explain`] | every ray behind a sample, recorded by driving the same integrators |
//!
//! # How a picture is made
//!
//! A [`Renderer`] hands a job to its worker (`engine/worker.rs`), which builds a [`world`] and fills the
//! tiles of a film pass by pass (`engine/tracing.rs`, `engine/film/mod.rs`). A frame context generates the
//! camera samples, and a tracer computes their radiance. [Tone mapping](picture::tone) turns the film
//! into a frame. A [`BlockTracer`] does the same block by block, for an [`Assembly`] that is put
//! together later, perhaps on another machine.
//!
//! Pixels of live pictures record their dependencies (`world/dependencies.rs`): after an edit of a
//! material or of a light's colour the film is reused, and only the pixels that depend on what changed
//! (`engine/edit_difference.rs`) are traced again.
//!
//! Dropping a renderer ends its work soon, however large the picture: cancellation is polled every
//! few milliseconds, and a film's memory is first touched while tracing and freed by the pool.

mod engine;
mod explain;
mod integrators;
mod job;
mod light;
mod material;
mod picture;
mod sampling;
mod simd_level;
mod world;

pub use crate::explain::{
    Boundary, Chosen, Crossing, DepthLimit, EmitterTerm, Explanation, Finding, FirstHit, LightHit,
    LightTerm, PreparedScene, RayEnd, RayKind, Shading, Stop, SurfaceHit, Term, TermSource,
    TracedRay, Unlisted, UnlitReason, Verdict,
};
pub use engine::{
    Assembly, BLOCK, Block, BlockTracer, Blocks, Checkpoint, PixelHistory, Refusal, Renderer,
    Threads, check_memory, memory_for, memory_for_blocks, photons_kept,
};
pub use geometry::Side;
pub use integrators::Counts;
pub use job::{Aov, Frames, Job, Limit, NO_OBJECT, NoRegion, Region, Settings, can_denoise};
pub use picture::{
    Advice, Colours, Display, Fault, Frame, HISTOGRAM_STOPS, Histogram, MOST_HALF_STOPS,
    Overexposure, PictureMetadata, Progress, Provenance, Query, SettingSearch, WireLine, Wireframe,
    wireframe,
};
pub use sampling::Densities;
pub use simd_level::{CPU_LEVEL_VARIABLE, CPU_LEVELS, simd_level_name};
pub use world::{
    SurfacePoint, camera_axes, distance_to_surface, pixel_width, project_line, project_point,
    summit, surface_under, surrounds, top_at,
};

#[cfg(test)]
mod tests;
