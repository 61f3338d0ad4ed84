//! Whether the machine can trace a job: estimates the memory it needs, before allocating any.

use std::sync::Arc;

use super::film::Film;
use crate::integrators::{PhotonRules, Photons};
use crate::job::{Job, NoRegion};
use crate::world::{MOST_WITHOUT_TREE, World, WorldSettings, instances};
use memory::{Need, OutOfMemory};
use scene::{Rgb, Scene, Size};

/// Bytes per bounding box while its tree is built: references, nodes twice, positions. What is kept of
/// the vertices of triangles afterwards takes less than what is freed by then.
const BOX: usize = 128;

/// Bytes per pixel of a block: two sums, an error, a variance and an object.
const BLOCK_PIXEL: usize = 2 * size_of::<Rgb>() + 2 * size_of::<f32>() + size_of::<u32>();

/// Bytes per pixel while the picture is encoded.
const ENCODED: usize = 4;

/// Objects whose shapes are compared with the previous scene; comparing a million takes longer than
/// a key may wait.
const COMPARED: usize = 1 << 10;

/// Why a job was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// The worker panicked; whatever `wake` owned is dropped.
    #[error("the renderer has stopped")]
    Ended,
    /// The worker's threads cannot be started; whatever `wake` owned is dropped.
    #[error("cannot start the rendering threads ({count}): {reason}; --threads N sets how many")]
    Threads {
        /// Number of tracing threads.
        count: usize,
        /// The system's error message.
        reason: String,
    },
    /// The region is no part of the picture.
    #[error(transparent)]
    Region(#[from] NoRegion),
    /// The objects or the picture do not fit into memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// The picture needs more memory than is available.
    #[error(
        "cannot trace {}x{}: not enough memory for the {} it needs; choose a smaller size",
        size.width, size.height, memory::megabytes(*bytes)
    )]
    Memory {
        /// Size of the picture.
        size: Size,
        /// Memory needed for tracing it.
        bytes: u64,
    },
}

/// About how many bytes of memory tracing a job takes, without those of its scene. If it has photons, at
/// most, unless it is known how many each map keeps.
pub fn memory_for(job: &Job, kept: Option<u64>) -> u64 {
    film(job)
        .saturating_add(photons(job, kept))
        .saturating_add(world(&job.scene))
}

/// About how many bytes of memory tracing a job by blocks takes, without those of its scene, if blocks
/// of this many pixels in all are held at once; photons as in [`memory_for`].
pub fn memory_for_blocks(job: &Job, pixels: u64, kept: Option<u64>) -> u64 {
    let blocks = pixels.saturating_mul(BLOCK_PIXEL as u64);
    blocks
        .saturating_add(photons(job, kept))
        .saturating_add(world(&job.scene))
}

/// How many photons each map of a job keeps, judging by the first, which is traced on the current thread
/// pool; `None` for a job without photons.
pub fn photons_kept(job: &Job) -> Option<u64> {
    let rules = PhotonRules::of(&job.settings)?;
    let scene = Arc::clone(&job.scene);
    let never = || false;
    let world = World::build(
        scene,
        &job.images,
        WorldSettings::of(&job.settings),
        None,
        &never,
    )?;
    Some(Photons::build(&world, rules, None, &never)?.kept())
}

/// Refuses a job unless this many bytes, those of its acceleration structures included, fit into
/// memory.
pub fn check_memory(job: &Job, bytes: u64) -> Result<(), Refusal> {
    check(job, bytes, world(&job.scene))
}

/// Bytes of the picture while it is traced and encoded.
fn film(job: &Job) -> u64 {
    let size = job.settings.traced().size();
    let pixels = (size.pixels() as u64).saturating_mul(ENCODED as u64);
    Film::bytes(job).saturating_add(pixels)
}

/// Bytes of the photon maps, which are none without photons; `kept` are the photons of each, if known.
fn photons(job: &Job, kept: Option<u64>) -> u64 {
    let rules = PhotonRules::of(&job.settings);
    rules.map_or(0, |rules| rules.bytes(job.settings.spp, kept))
}

/// Refuses a job whose world and film do not fit into memory. For an edit of the scene `before`,
/// the world exists already or is about to exist.
pub(crate) fn fits(job: &Job, before: Option<&Arc<Scene>>) -> Result<(), Refusal> {
    let world = match before {
        Some(before) if is_edit_of(before, &job.scene) => 0,
        _ => world(&job.scene),
    };
    let picture = film(job).saturating_add(photons(job, None));
    check(job, picture.saturating_add(world), world)
}

/// Refuses a job unless `bytes`, of which `world` are for the world, fit into memory.
fn check(job: &Job, bytes: u64, world: u64) -> Result<(), Refusal> {
    let size = job.settings.traced().size();
    let objects = job.scene.objects.len();
    let need = || Need {
        what: format!("{objects} objects"),
        bytes,
    };
    memory::check(bytes, need).map_err(|refused| {
        if bytes - world < world {
            Refusal::OutOfMemory(refused)
        } else {
            Refusal::Memory { size, bytes }
        }
    })
}

/// Whether a scene is an edit of another, judging by a sample of the objects: their worlds differ
/// in a few shapes at most.
fn is_edit_of(before: &Scene, scene: &Scene) -> bool {
    /// Beyond this many changes a tree is rebuilt.
    const MOST_CHANGED: usize = 32;
    let count = scene.objects.len();
    let sample = (0..count).step_by(1 + count / COMPARED);
    let is_other = |&at: &usize| before.objects[at].shape != scene.objects[at].shape;
    count == before.objects.len() && sample.filter(is_other).nth(MOST_CHANGED).is_none()
}

/// Bytes of a scene's acceleration structures.
fn world(scene: &Scene) -> u64 {
    let objects = scene.objects.len();
    let own = if objects <= MOST_WITHOUT_TREE {
        0
    } else {
        objects
    };
    let mut meshes: Vec<_> = instances(&scene.objects)
        .into_iter()
        .map(|(_, instance)| instance.mesh())
        .collect();
    meshes.sort_unstable_by_key(|mesh| Arc::as_ptr(mesh));
    meshes.dedup_by_key(|mesh| Arc::as_ptr(mesh));
    let triangles: usize = meshes.iter().map(|mesh| mesh.len()).sum();
    (own + triangles) as u64 * BOX as u64
}
