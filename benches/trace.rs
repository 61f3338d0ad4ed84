//! Reading, building and tracing scenes: a table of medians.
//!
//! `cargo bench --bench trace` prints it; `cargo bench --bench trace -- flake` selects scenes by
//! name. A mesh of a million triangles has its own table.

#[allow(dead_code, reason = "shared with the other benches")]
mod meshes;
#[allow(dead_code, reason = "shared with the other benches")]
mod scenes;

use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use glam::DVec3;
use halflight::accel::Bvh;
use halflight::geometry::{Aabb, Affine, Instance, Mesh, Shape, TriangleRuns};
use halflight::language::{self, FileKind, Language};
use halflight::obj;
use halflight::render::{Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{
    Camera, DEFAULT_DEPTH, Emitter, Focus, Images, Lens, Light, Material, Meshes, Object,
    Rendering, Rgb, Scene, Setting, Size,
};

/// The number of timed runs; the median is printed.
const RUNS: usize = 5;

/// The size of the pictures, traced with one sample per pixel.
const SIZE: Size = Size {
    width: 640,
    height: 480,
};

fn main() {
    // Cargo passes `--bench`; other arguments are parts of names.
    let selected: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!(
        "{}x{}, 1 spp, depth {DEFAULT_DEPTH}, medians of {RUNS}",
        SIZE.width, SIZE.height
    );
    println!(
        "{:<20} {:>8} {:>9} {:>9} {:>9} {:>9} {:>7} {:>9} {:>9}",
        "scene",
        "objects",
        "parse ms",
        "lower ms",
        "build ms",
        "B/object",
        "Mrays",
        "Mray/s 1",
        format!("Mray/s {cores}")
    );
    for (name, language, text) in measured() {
        if selected.is_empty() || selected.iter().any(|part| name.contains(part.as_str())) {
            row(&name, language, &text(), cores);
        }
    }
    let name = "mesh of 1,000,000";
    if selected.is_empty() || selected.iter().any(|part| name.contains(part.as_str())) {
        mesh(name, cores);
    }
}

type Text = Box<dyn Fn() -> String>;

/// The name, language and text of all scenes: the project's own and the generated ones.
fn measured() -> Vec<(String, Language, Text)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = std::fs::read_dir(folder).expect("the project has scenes");
    let mut own: Vec<_> = entries
        .map(|entry| entry.expect("a scene").path())
        .collect();
    own.sort();
    let mut measured: Vec<(String, Language, Text)> = Vec::new();
    for path in own {
        let Ok(language) = Language::of_path(&path) else {
            continue;
        };
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        measured.push((
            name,
            language,
            Box::new(move || std::fs::read_to_string(&path).expect("a scene")),
        ));
    }
    let generated: [(&str, Language, Text); 3] = [
        (
            "flake of 7,381",
            Language::Ray,
            Box::new(|| scenes::sphereflake(4)),
        ),
        (
            "1,000,000 spheres",
            Language::Ray,
            Box::new(|| scenes::random_spheres(1_000_000, 1)),
        ),
        (
            "200 CSG trees",
            Language::Dat,
            Box::new(|| scenes::set_operations(200)),
        ),
    ];
    let generated = generated.into_iter();
    measured.extend(generated.map(|(name, language, text)| (name.to_owned(), language, text)));
    measured
}

fn row(name: &str, language: Language, text: &str, cores: usize) {
    let text = Arc::new(text.to_owned());
    let (parse, mut source) = median(|| language::Source::new(language, Arc::clone(&text)));
    let mut lower = || source.lower(&Meshes::default()).expect("there is memory");
    let (lowering, lowered) = median(&mut lower);
    drop(lowered);
    let files = source.files();
    if files.iter().any(|file| file.kind == FileKind::Mesh) {
        println!("{name:<20} skipped: meshes are measured below");
        return;
    }
    drop(source);

    // The memory of an open document besides its text: tokens, origins, scene and bvh.
    let before = resident();
    let mut source = language::Source::new(language, text);
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = Arc::new(lowered.scene.expect("a scene without errors"));
    let boxes: Vec<Aabb> = scene
        .objects
        .iter()
        .map(|object| object.shape.bounds())
        .collect();
    let (build, bvh) = median(|| Bvh::build(&boxes, &|| false).expect("nothing cancels"));
    drop(boxes);
    let bytes = resident().saturating_sub(before) / scene.objects.len();
    drop((source, bvh));

    let (alone, frame) = traced(&scene, 1);
    let (together, _) = traced(&scene, cores);
    let rays = frame.progress.rays as f64 / 1e6;
    println!(
        "{name:<20} {:>8} {:>9} {:>9} {:>9} {:>9} {rays:>7.2} {:>9.2} {:>9.2}",
        scene.objects.len(),
        milliseconds(parse),
        milliseconds(lowering),
        milliseconds(build),
        // For fewer objects the size of a page dominates.
        if scene.objects.len() < 1000 {
            "-".into()
        } else {
            bytes.to_string()
        },
        rays / alone.as_secs_f64(),
        rays / together.as_secs_f64(),
    );
}

/// A mesh of a million triangles: read, built, traced, and traced with a shadow ray for each point
/// that faces the light.
fn mesh(name: &str, cores: usize) {
    let text = meshes::bumpy_ball(1_000_000);
    let read =
        || obj::read(text.as_bytes(), |_| Ok::<_, String>(Vec::new())).expect("a valid mesh");
    let structure = |mesh: &Mesh| {
        let triangles = 0..mesh.len() as u32;
        let boxes: Vec<_> = triangles
            .map(|number| mesh.triangle_bounds(number))
            .collect();
        let bvh = Bvh::build(&boxes, &|| false).expect("nothing cancels");
        let runs = TriangleRuns::new(
            mesh,
            bvh.order(),
            &bvh.runs(&|| false).expect("nothing cancels"),
            &|| false,
        );
        (bvh, runs.expect("nothing cancels"))
    };
    // First, as freed memory may later stay resident.
    let before = resident();
    let mesh = read().mesh;
    let structures = structure(&mesh);
    let bytes = resident().saturating_sub(before) / mesh.len();
    drop(structures);
    let (read, _) = median(read);
    let (build, _) = median(|| structure(&mesh));
    println!(
        "\n{name}: .obj of {} MB read in {} ms, bvh and runs built in {} ms, \
        {bytes} bytes per triangle with them",
        text.len() / 1_000_000,
        milliseconds(read),
        milliseconds(build),
    );
    let frame = Affine::of_matrix(DVec3::AXES, DVec3::ZERO).expect("the axes");
    let shape = Shape::Mesh(Box::new(Instance::new(mesh, &frame, Vec::new())));
    let [dark, lit] = [
        &[][..],
        &[Light {
            emitter: Emitter::Distant(DVec3::new(0.6, 0.0, 0.8)),
            ..Light::point(DVec3::ZERO, Rgb::ONE)
        }],
    ]
    .map(|lights| Arc::new(portrait(shape.clone(), lights)));
    for threads in [1, cores] {
        let (seen, first) = traced(&dark, threads);
        let (shaded, second) = traced(&lit, threads);
        let rays = first.progress.rays as f64 / 1e6;
        let shadows = second.progress.rays as f64 / 1e6 - rays;
        println!(
            "  {threads} threads: primary {:.2} Mray/s, shadow {:.2} Mray/s",
            rays / seen.as_secs_f64(),
            shadows / shaded.saturating_sub(seen).as_secs_f64(),
        );
    }
}

/// A scene of one white matte shape that fills the picture.
fn portrait(shape: Shape, lights: &[Light]) -> Scene {
    let material = Material {
        diffuse: Rgb::ONE,
        ..Material::BLACK
    };
    Scene {
        camera: Camera {
            eye: DVec3::new(0.0, -3.0, 0.5),
            target: DVec3::ZERO,
            up: DVec3::Z,
            lens: Lens::Perspective(32.0),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: SIZE,
        },
        ambient: Rgb::ONE,
        lights: lights.to_vec(),
        materials: vec![material].into(),
        textures: Vec::new(),
        objects: [Object { shape, material: 0 }].into_iter().collect(),
        setting: Setting::default(),
    }
}

/// The median time of tracing a scene on `threads` threads, and the frame.
fn traced(scene: &Arc<Scene>, threads: usize) -> (Duration, Arc<Frame>) {
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Exactly(threads), move || {
        let _ = wake.send(());
    });
    let mut trace = || {
        let settings = Settings {
            spp: 1,
            ..Settings::new(SIZE, &Rendering::default())
        };
        let job = Job {
            scene: Arc::clone(scene),
            images: Images::default(),
            camera: scene.camera,
            settings,
            limit: None,
            frames: Frames::Last,
            denoise: false,
            numbers: None,
        };
        let generation = renderer.restart(job).expect("the worker runs");
        loop {
            woken.recv().expect("the worker runs");
            match renderer.latest() {
                Some(frame) if frame.generation == generation && frame.progress.complete => {
                    return frame;
                }
                _ => {}
            }
        }
    };
    // The first run builds the tree.
    trace();
    median(trace)
}

/// The median time of several runs, and the result of the last.
fn median<T>(mut run: impl FnMut() -> T) -> (Duration, T) {
    let mut times = [Duration::ZERO; RUNS];
    let mut last = None;
    for time in &mut times {
        drop(last.take());
        let begun = Instant::now();
        last = Some(run());
        *time = begun.elapsed();
    }
    times.sort_unstable();
    (times[RUNS / 2], last.expect("there was a run"))
}

fn milliseconds(time: Duration) -> String {
    format!("{:.2}", time.as_secs_f64() * 1e3)
}

/// The resident memory of this process, in bytes; 0 if unknown.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = status
        .split(' ')
        .nth(1)
        .and_then(|pages| pages.parse().ok())
        .unwrap_or(0_usize);
    4096 * pages
}
