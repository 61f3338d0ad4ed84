//! Traces scenes to pixels. Independent of documents, files and terminals.
//!
//! A [`Renderer`] is a handle to a worker thread that traces the newest [`Job`] and publishes its
//! progress as [`Frame`]s. Every sample is a pure function of (scene, camera, settings, pixel,
//! sample index), and the samples of a pixel are added in index order, so a finished frame has the
//! same bits for any number of threads and any history of cancelled jobs.
//!
//! Dropping a renderer ends its work soon, however large the picture: cancellation is polled every
//! few milliseconds, and a film's memory is first touched while tracing and freed by the pool.
//!
//! Data flow: [`renderer`] hands a job to [`worker`], which builds a [`world`] with the
//! [`structures`] of its meshes and, pass by pass ([`mod@tracing`]), fills the [`tile`]s of a
//! [`film`] in [`steps`]. Each sample gets its numbers from [`sampler`], its place around the pixel
//! from [`filter`], its ray from [`camera`] and its radiance from a [`tracer`], or an AOV from
//! [`first_hit`]. [`tone`] converts the film to a frame (heat maps by a [`ramp`]), and [`noise`]
//! estimates the remaining error, which [`denoise`] reduces. A part of a picture, a
//! [`mod@region`], can be traced alone.
//!
//! Pixels of live pictures record their dependencies ([`touched`]): after an edit of a material or
//! of a light's colour the film is reused, and only dependent pixels are traced again.
//!
//! A tracer has three integrators: [`whitted`] traces a [`wave`] of samples at once, whose rays land
//! on [`surfaces`] and [`branch`]; [`path_wave`] follows a [`path`] for each sample, all of them bounce
//! by bounce, continuing by a [`bsdf`] and its [`lobes`] and asking what emits light ([`next_event`],
//! [`next_event_wave`]), at eight [`vertices`] at once; the third adds the [`caustics`] of [`photons`]
//! to paths. These are traced before the tiles of a step ([`photon_paths`]), turned at mirrors and glass
//! by a [`deflection`], and found in a [`photon_map`], on what of a [`disc`] lies on a surface. All query the world through a [`probe`], which applies
//! a material's maps ([`texture`]), shade according to [`shading`], and sample [`lights`] for [`direct`]
//! light. [`optics`], [`microfacet`] and [`warp`] hold the formulas. [`gather`] tells the shares of the
//! light apart.
//!
//! [`explain`] records every ray behind a sample, part by part, by driving the same integrators;
//! a [`Query`] of a frame does so for the frame's pixels.
//!
//! A [`BlockTracer`] traces a picture by [`mod@block`]s, which may be stored, continued and put
//! together in an [`assembly`] later, on other machines too, to the same frame.
//!
//! [`display`] says how a finished frame is looked at, and a [`histogram`] how bright it is.
//!
//! A picture as far as it is traced can be [`kept`] beyond the renderer, as bytes, and continued by
//! another.
//!
//! [`mod@wireframe`] projects the outlines of objects without tracing.
//!
//! Rays are intersected in packets of eight with one object after the other ([`packets`]), or
//! singly with up to eight [`spheres`] at once ([`intersect`]), with bitwise equal results.

mod adaptive;
mod appearance;
mod assembly;
mod block;
mod block_tracer;
mod blocks;
mod branch;
mod bsdf;
mod camera;
mod caustics;
mod deflection;
mod denoise;
mod direct;
mod disc;
mod display;
mod emitters;
mod explain;
mod film;
mod filter;
mod first_hit;
mod frame;
mod gather;
mod heuristic;
mod histogram;
mod intersect;
mod kept;
mod level;
mod lights;
mod lobes;
mod microfacet;
mod nearby;
mod next_event;
mod next_event_wave;
mod noise;
mod optics;
mod overexposure;
mod packets;
mod path;
mod path_wave;
mod photon_map;
mod photon_paths;
mod photons;
mod place;
mod probe;
mod provenance;
mod ramp;
mod record;
mod refusal;
mod region;
mod renderer;
mod sampler;
mod shading;
mod shared;
mod shot;
mod sky;
mod spheres;
mod steps;
mod structures;
mod surfaces;
mod texture;
mod tile;
mod tone;
mod touched;
mod tracer;
mod tracing;
mod trials;
mod vertices;
mod warp;
mod wave;
mod whitted;
mod wireframe;
mod worker;
mod world;
mod written;

pub use assembly::Assembly;
pub use block::Block;
pub use block_tracer::BlockTracer;
pub use blocks::{BLOCK, Blocks};
pub use display::{Colours, Display, MOST_HALF_STOPS, exposes};
pub use explain::{
    Boundary, Chosen, Crossing, Dark, DepthLimit, EmitterTerm, Explanation, Finding, FirstHit,
    LightHit, LightTerm, PreparedScene, RayEnd, RayKind, Shading, Stop, SurfaceHit, Term,
    TermSource, TracedRay, Unlisted, Verdict,
};
pub use frame::{Aov, Frame, Frames, Job, Limit, NO_OBJECT, Progress, Query, Settings, denoises};
pub use heuristic::Densities;
pub use histogram::{HISTOGRAM_STOPS, Histogram};
pub use kept::Kept;
pub use level::{CAP, CAPS, vectors};
pub use overexposure::Overexposure;
pub use place::{SurfacePoint, axes, clearance, line_of, pixel_of, pixel_width, surface_under};
pub use probe::Counts;
pub use provenance::Provenance;
pub use record::Record;
pub use refusal::{Refusal, check_memory, memory_for, memory_for_blocks, photons_kept};
pub use region::{NoRegion, Region};
pub use renderer::{Renderer, Threads};
pub use shading::Side;
pub use trials::{Advice, Fault, Trials};
pub use wireframe::{WireLine, Wireframe, wireframe};

#[cfg(test)]
mod tests;
