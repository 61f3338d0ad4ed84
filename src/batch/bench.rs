//! Measures how fast scenes are read, built and traced here.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::{Error, Messages, Reading, Report, Tracing, machine, stdout};
use language::{Language, Source};
use render::{Block, BlockTracer, Frames, Job, Renderer, Settings, Threads};
use scene::{Images, Meshes, Rendering, Scene, Size};

/// Scenes to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Bench {
    /// The scene files; built-in scenes if empty.
    pub scenes: Vec<PathBuf>,
    /// How they are traced; without a size at 800x600, without a number of samples with 4.
    pub tracing: Tracing,
    /// How often each figure is measured; the median counts.
    pub runs: u32,
    /// How the figures are printed.
    pub report: Report,
    /// How they are read.
    pub reading: Reading,
}

/// The size of the pictures unless another is asked for.
const SIZE: Size = Size {
    width: 800,
    height: 600,
};

/// The samples per pixel unless others are asked for.
const SPP: u32 = 4;

/// The scene that the interface opens without a name.
const EMBEDDED: &str = include_str!("../../scenes/default.ray");

/// Spheres along each edge of the built-in cubes of them.
const EDGES: [u32; 2] = [10, 40];

/// Measures scenes and prints a row of figures for each to standard output.
pub fn bench(work: &Bench) -> Result<(), Error> {
    try_bench(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_bench(work: &Bench) -> Result<(), Error> {
    work.reading.begin()?;
    let tracing = Tracing {
        size: Some(work.tracing.size.unwrap_or(SIZE)),
        rendering: Rendering {
            spp: work.tracing.rendering.spp.or(Some(SPP)),
            ..work.tracing.rendering
        },
        ..work.tracing.clone()
    };
    let mut rows = Vec::new();
    if work.scenes.is_empty() {
        rows.push(measure(work, &tracing, "default", || built_in(EMBEDDED))?);
        for edge in EDGES {
            let text = cube_of_spheres(edge);
            let name = format!("{} spheres", edge.pow(3));
            rows.push(measure(work, &tracing, &name, || built_in(&text))?);
        }
    }
    for path in &work.scenes {
        let name = path.file_name().unwrap_or(path.as_os_str());
        let read = || from_file(work, path);
        rows.push(measure(work, &tracing, &name.to_string_lossy(), read)?);
    }
    let report = match work.report {
        Report::Text => table(work, &tracing, &rows),
        Report::Json => format!("{:#}\n", object(work, &tracing, &rows)),
    };
    stdout::print(&report).map_err(stdout::error)
}

/// Reads a scene file and lowers it.
fn from_file(work: &Bench, path: &Path) -> Result<(Scene, Images), Error> {
    let over = work.tracing.over();
    let mut loaded = work.reading.load(Messages::Text, path, Some(&over))?;
    Ok((loaded.take_scene()?, loaded.read.images))
}

/// Lowers a `.ray` text without errors.
fn built_in(text: &str) -> Result<(Scene, Images), Error> {
    let mut source = Source::new(Language::Ray, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default());
    let scene = lowered.ok().and_then(|lowered| lowered.scene);
    let scene = scene.ok_or(Error::Invalid { errors: 1 })?;
    Ok((scene, Images::default()))
}

/// A `.ray` scene of spheres in a cube, every fourth of them a mirror.
fn cube_of_spheres(edge: u32) -> String {
    let count = edge.pow(3);
    let mut text = format!(".2 .2 .2\n2 3 5 4 .7 .7 .7 -4 2 5 .3 .3 .3\n{count}\n");
    for number in 0..count {
        let place = [1, edge, edge * edge].map(|stride| {
            let along = f64::from(number / stride % edge) + 0.5;
            2.0 * along / f64::from(edge) - 1.0
        });
        let [x, y, z] = place;
        let radius = 0.7 / f64::from(edge);
        let mirror = if number % 4 == 0 { 0.5 } else { 0.0 };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "sphere {x} {y} {z} {radius} .2 .2 .2 {} .5 .7 .2 .2 .2 30 {mirror} 0 1",
            0.5 + 0.5 * x
        );
    }
    text + "// view: eye 2.5 1.8 3.5 target 0 0 0 up 0 1 0 fov 40\n"
}

/// The figures of a scene.
struct Row {
    name: String,
    objects: usize,
    settings: Settings,
    rays: u64,
    /// From the file, or the text, to the scene.
    load: Spread,
    /// The acceleration structures.
    build: Spread,
    /// From the scene to the first picture on screen, of one sample at most.
    first: Spread,
    /// All samples.
    trace: Spread,
}

/// The times of several runs, in order.
struct Spread(Vec<Duration>);

impl Spread {
    fn new(mut times: Vec<Duration>) -> Self {
        times.sort_unstable();
        Self(times)
    }

    fn median(&self) -> f64 {
        self.0[self.0.len() / 2].as_secs_f64()
    }

    /// Half the difference between the longest and the shortest, relative to the median.
    fn relative(&self) -> f64 {
        let [first, last] = [0, self.0.len() - 1].map(|at| self.0[at].as_secs_f64());
        0.5 * (last - first) / self.median().max(f64::MIN_POSITIVE)
    }
}

fn measure(
    work: &Bench,
    tracing: &Tracing,
    name: &str,
    read: impl Fn() -> Result<(Scene, Images), Error>,
) -> Result<Row, Error> {
    let mut times: [Vec<Duration>; 4] = Default::default();
    let mut found = None;
    for _ in 0..work.runs {
        let begun = Instant::now();
        let (scene, images) = read()?;
        times[0].push(begun.elapsed());
        let objects = scene.objects.len();
        let job = tracing.job(scene, images, Frames::Live)?;
        let settings = job.settings;
        times[2].push(first_picture(job.clone(), tracing.execution.threads)?);
        let begun = Instant::now();
        let tracer =
            BlockTracer::new(job, tracing.execution.threads, &|| false)?.ok_or(Error::Stopped)?;
        times[1].push(begun.elapsed());
        let (took, rays) = trace(&tracer, settings.spp);
        times[3].push(took);
        found = Some((objects, settings, rays));
    }
    let (objects, settings, rays) = found.ok_or(Error::Stopped)?;
    let [load, build, first, trace] = times.map(Spread::new);
    Ok(Row {
        name: name.to_owned(),
        objects,
        settings,
        rays,
        load,
        build,
        first,
        trace,
    })
}

/// The time until a renderer shows something.
fn first_picture(job: Job, threads: usize) -> Result<Duration, Error> {
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Exactly(threads), move || {
        // This fails only while the renderer is being dropped.
        let _ = wake.send(());
    });
    let begun = Instant::now();
    renderer.restart(job)?;
    woken.recv().map_err(|_| Error::Stopped)?;
    Ok(begun.elapsed())
}

/// Traces all blocks; returns the time and the rays.
fn trace(tracer: &BlockTracer, spp: u32) -> (Duration, u64) {
    let blocks = tracer.blocks();
    let (hand_over, handed_over) = mpsc::channel();
    let begun = Instant::now();
    tracer.trace(
        (0..blocks.count()).map(|number| Block::new(number, blocks)),
        spp,
        Duration::MAX,
        &|| false,
        // The receiver lives until the end.
        |block: Block| {
            let _ = hand_over.send(block.counts.rays);
        },
    );
    let took = begun.elapsed();
    drop(hand_over);
    (took, handed_over.iter().sum())
}

fn table(work: &Bench, tracing: &Tracing, rows: &[Row]) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{words}");
    };
    let machine = machine::Machine::found();
    line(format!(
        "halflight {}, {} of {} cores, {}, {}, {} of memory",
        env!("CARGO_PKG_VERSION"),
        tracing.execution.threads,
        machine.cores,
        machine.processor,
        machine.vectors,
        memory::megabytes(machine.memory)
    ));
    line(format!(
        "{}; medians of {}",
        common_settings(rows),
        work.runs
    ));
    line(format!(
        "\n{:<20} {:>8} {:>9} {:>9} {:>9} {:>9} {:>6} {:>8} {:>10}",
        "scene",
        "objects",
        "load ms",
        "build ms",
        "first ms",
        "trace s",
        "± %",
        "Mray/s",
        "Msample/s"
    ));
    for row in rows {
        line(format!(
            "{:<20} {:>8} {:>9.2} {:>9.2} {:>9.2} {:>9.3} {:>6.1} {:>8.2} {:>10.3}",
            row.name,
            row.objects,
            1e3 * row.load.median(),
            1e3 * row.build.median(),
            1e3 * row.first.median(),
            row.trace.median(),
            1e2 * row.trace.relative(),
            1e-6 * row.rays as f64 / row.trace.median(),
            1e-6 * row.samples() / row.trace.median(),
        ));
    }
    text
}

/// The settings that all rows have in common.
fn common_settings(rows: &[Row]) -> String {
    let written = |row: &Row| row.settings.written();
    let mut common = rows.first().map_or_else(Vec::new, |row| {
        let mut all = written(row);
        all.push(("spp", row.settings.spp.to_string()));
        all
    });
    common.retain(|setting| {
        let others = |row| setting.0 == "spp" || written(row).contains(setting);
        setting.1 != "none" && rows.iter().all(others)
    });
    let common = common
        .into_iter()
        .map(|(name, value)| format!("{name} {value}"));
    common.collect::<Vec<_>>().join(", ")
}

impl Row {
    fn samples(&self) -> f64 {
        self.settings.traced().size().pixels() as f64 * f64::from(self.settings.spp)
    }
}

/// The keys are part of the interface of the command. Times are in seconds, memory in bytes.
fn object(work: &Bench, tracing: &Tracing, rows: &[Row]) -> Value {
    let machine = machine::Machine::found();
    let rows = rows.iter().map(|row| {
        json!({
            "scene": row.name,
            "objects": row.objects,
            "load": row.load.median(),
            "build": row.build.median(),
            "first": row.first.median(),
            "trace": row.trace.median(),
            "trace_spread": row.trace.relative(),
            "rays": row.rays,
            "samples": row.samples(),
            "rays_per_second": row.rays as f64 / row.trace.median(),
            "samples_per_second": row.samples() / row.trace.median(),
            "settings": super::stats::settings(&row.settings),
        })
    });
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "machine": {
            "processor": machine.processor,
            "cores": machine.cores,
            "vectors": machine.vectors,
            "memory": machine.memory,
        },
        "threads": tracing.execution.threads,
        "runs": work.runs,
        "rows": rows.collect::<Value>(),
    })
}
