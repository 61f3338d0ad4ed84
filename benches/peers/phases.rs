//! The phases of a scene, measured in a separate process so that its memory can be measured.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use halflight::assets::{Assets, Wanted};
use halflight::geometry::Shape;
use halflight::language::{FileKind, Language, Source};
use halflight::render::{Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Camera, Images, Meshes, Object, Rendering, Scene, Size};

use crate::cases::Case;
use crate::programs::{kilobytes, median};
use crate::setting::{LONG, RUNS, THREADS, WHOLE};

/// The first argument of a measuring process.
pub(crate) const VERB: &str = "phases-of";

/// The scene with which threads are started.
const SPHERE: &str = "0 0 0 1 0 0 9 1 1 1 1 sphere 0 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1";

/// The smallest picture.
const PIXEL: Size = Size {
    width: 1,
    height: 1,
};

/// The measurements; times are medians.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Phases {
    /// The size of the scene's text in bytes.
    pub(crate) text: usize,
    /// The number of objects, with each triangle of a mesh counted as one.
    pub(crate) objects: usize,
    /// From text to tree, including reading the files it names.
    pub(crate) parse: Duration,
    /// From tree to scene.
    pub(crate) lower: Duration,
    /// Building the acceleration structures.
    pub(crate) build: Duration,
    /// Tracing.
    pub(crate) render: Duration,
    /// The number of camera rays, one per sample.
    pub(crate) camera_rays: u64,
    /// The number of all rays.
    pub(crate) rays: u64,
    /// The number of shadow rays.
    pub(crate) shadow_rays: u64,
    /// The memory of an open scene besides its text, in bytes: tree, origins, scene, structures.
    pub(crate) open: usize,
}

/// Measures a scene in a separate process.
pub(crate) fn measure(case: &Case) -> Phases {
    let program = std::env::current_exe().expect("the program knows its path");
    let mut command = Command::new(program);
    command.arg(VERB).arg(&case.scene).arg(case.spp.to_string());
    command.args(case.depth.map(|depth| depth.to_string()));
    let output = command.output().expect("the process runs");
    assert!(
        output.status.success(),
        "{}: {}",
        case.name,
        String::from_utf8_lossy(&output.stderr)
    );
    let output = String::from_utf8_lossy(&output.stdout);
    let mut numbers = output.split_whitespace().map(|number| {
        number
            .parse::<u64>()
            .expect("the process prints only numbers")
    });
    let mut next = || numbers.next().expect("the process prints all numbers");
    Phases {
        text: next() as usize,
        objects: next() as usize,
        parse: Duration::from_nanos(next()),
        lower: Duration::from_nanos(next()),
        build: Duration::from_nanos(next()),
        render: Duration::from_nanos(next()),
        camera_rays: next(),
        rays: next(),
        shadow_rays: next(),
        open: next() as usize,
    }
}

/// Measures the scene given by the arguments and prints the numbers.
pub(crate) fn print(arguments: &[String]) {
    let [scene, spp, depth @ ..] = arguments else {
        panic!("usage: {VERB} SCENE SPP [DEPTH]");
    };
    let spp = spp.parse().expect("SPP is a number");
    let depth = depth
        .first()
        .map(|depth| depth.parse().expect("DEPTH is a number"));
    let phases = of(Path::new(scene), spp, depth);
    let mut line = String::new();
    for number in [
        phases.text as u128,
        phases.objects as u128,
        phases.parse.as_nanos(),
        phases.lower.as_nanos(),
        phases.build.as_nanos(),
        phases.render.as_nanos(),
        phases.camera_rays.into(),
        phases.rays.into(),
        phases.shadow_rays.into(),
        phases.open as u128,
    ] {
        let _ = write!(line, "{number} ");
    }
    println!("{line}");
}

fn of(path: &Path, spp: u32, depth: Option<u32>) -> Phases {
    let language = Language::of_path(path).expect("a scene's extension");
    let text = std::fs::read_to_string(path).expect("a readable scene");

    // First, as freed memory may later stay resident.
    let before = resident();
    let opened = Opened::new(path, language, &text);
    let mut stage = Stage::new(depth);
    stage.build(&opened);
    let open = resident().saturating_sub(before);
    let objects = opened.objects();
    drop((opened, stage));

    let mut times = [const { Vec::new() }; 4];
    let (mut rays, mut shadow_rays) = (0, 0);
    for run in 0..RUNS {
        let long = times.iter().flatten().any(|&time| LONG < time);
        if long && 3 <= run {
            break;
        }
        let opened = Opened::new(path, language, &text);
        let mut stage = Stage::new(depth);
        let build = stage.build(&opened);
        let (render, frame) = stage.trace(&opened.scene, &opened.images, WHOLE, spp);
        rays = frame.progress.rays;
        shadow_rays = frame.progress.shadow_rays;
        for (times, time) in times
            .iter_mut()
            .zip([opened.parse, opened.lower, build, render])
        {
            times.push(time);
        }
    }
    let [parse, lower, build, render] = times.map(|times| median(&times));
    Phases {
        text: text.len(),
        objects,
        parse,
        lower,
        build,
        render,
        camera_rays: WHOLE.pixels() as u64 * u64::from(spp),
        rays,
        shadow_rays,
        open,
    }
}

/// A parsed and lowered scene, and the times that took.
struct Opened {
    /// Kept as long as the scene, as in an open document.
    _source: Source,
    scene: Arc<Scene>,
    images: Images,
    parse: Duration,
    lower: Duration,
}

impl Opened {
    fn new(path: &Path, language: Language, text: &str) -> Self {
        let text = Arc::new(text.to_owned());
        let (mut parse, mut source) = timed(|| Source::new(language, text));
        let lower = |source: &mut Source, meshes: &Meshes| {
            timed(|| source.lower(meshes).expect("there is memory"))
        };
        let (mut lowering, mut lowered) = lower(&mut source, &Meshes::default());
        let mut assets = Assets::new(&[]);
        let mut read = |source: &Source| {
            let files = source.files();
            let (time, loaded) = timed(|| assets.read(&Wanted::new(path, &files)));
            parse += time;
            (files, loaded)
        };
        let (files, mut loaded) = read(&source);
        if files.iter().any(|file| file.kind == FileKind::Mesh) {
            (lowering, lowered) = lower(&mut source, &loaded.meshes);
            // Meshes may name pictures, which are known only after reading.
            loaded = read(&source).1;
        }
        let scene = lowered.scene.expect("a scene without errors");
        Self {
            scene: Arc::new(scene),
            images: loaded.images,
            parse,
            lower: lowering,
            _source: source,
        }
    }

    fn objects(&self) -> usize {
        let count = |object: &Object| match &object.shape {
            Shape::Mesh(instance) => instance.mesh().len(),
            _ => 1,
        };
        self.scene.objects.iter().map(count).sum()
    }
}

/// A renderer whose threads are already running.
struct Stage {
    renderer: Renderer,
    woken: Receiver<()>,
    depth: Option<u32>,
}

impl Stage {
    fn new(depth: Option<u32>) -> Self {
        let (wake, woken) = mpsc::channel();
        let renderer = Renderer::new(Threads::Exactly(THREADS), move || {
            let _ = wake.send(());
        });
        let mut stage = Self {
            renderer,
            woken,
            depth,
        };
        let mut source = Source::new(Language::Ray, Arc::new(SPHERE.to_owned()));
        let lowered = source.lower(&Meshes::default()).expect("there is memory");
        let scene = lowered.scene.expect("a scene without errors");
        stage.trace(&Arc::new(scene), &Images::default(), PIXEL, 1);
        stage
    }

    /// Builds a scene for a picture of one pixel and returns the time.
    fn build(&mut self, opened: &Opened) -> Duration {
        self.trace(&opened.scene, &opened.images, PIXEL, 1).0
    }

    /// Traces a picture and returns the time.
    fn trace(
        &mut self,
        scene: &Arc<Scene>,
        images: &Images,
        size: Size,
        spp: u32,
    ) -> (Duration, Arc<Frame>) {
        let integrator = scene.setting.rendering.integrator();
        let job = Job {
            scene: Arc::clone(scene),
            images: images.clone(),
            camera: Camera {
                size,
                ..scene.camera
            },
            settings: Settings {
                spp,
                depth: self.depth.unwrap_or_else(|| integrator.default_depth()),
                integrator,
                transfer: scene.setting.rendering.transfer(),
                ..Settings::new(size, &Rendering::default())
            },
            limit: None,
            frames: Frames::Last,
            denoise: false,
            numbers: None,
        };
        let begun = Instant::now();
        let generation = self.renderer.restart(job).expect("the worker runs");
        loop {
            self.woken.recv().expect("the worker runs");
            match self.renderer.latest() {
                Some(frame) if frame.generation == generation && frame.progress.complete => {
                    return (begun.elapsed(), frame);
                }
                _ => {}
            }
        }
    }
}

fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let begun = Instant::now();
    let outcome = work();
    (begun.elapsed(), outcome)
}

/// The resident memory of this process, in bytes; 0 if unknown.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    kilobytes(&status, "VmRSS:") * 1024
}
