//! What a cluster would take, computed from what is measured here: a picture divided among tasks that
//! each load the scene, trace their shard and write their part, and a task that merges the parts.

use std::env;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::Error;
use part::{Header, Part, Shard};
use render::{Block, BlockTracer, Blocks, Frames, Provenance};

/// The numbers of tasks that are planned for.
const TASKS: [u32; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];

/// Parts that are merged to measure what each adds.
const PARTS: u32 = 64;

/// How often parts are merged to measure it.
const MERGES: usize = 3;

/// What the plan is computed from; times in seconds.
pub(super) struct Measured {
    /// To load the scene, and to build its structures.
    pub(super) prepare: f64,
    /// To trace all blocks with the threads of a task.
    pub(super) trace: f64,
    /// The threads of a task.
    pub(super) threads: usize,
    /// Bytes of the scene and the files it names.
    pub(super) bytes: u64,
    blocks: Blocks,
    /// The rays of each block, which tell their costs apart.
    rays: Vec<u64>,
    /// To write and sync all blocks.
    write: f64,
    /// To merge all blocks.
    merge: f64,
    /// What each further part adds to that.
    merge_part: f64,
}

/// What a number of tasks would take; times in seconds.
struct Step {
    tasks: u32,
    /// Of the costliest task: all of it, and its tracing.
    task: f64,
    trace: f64,
    merge: f64,
    /// Bytes that all tasks read.
    read: u64,
}

impl Measured {
    /// Traces all blocks and measures how they are written to parts and merged.
    pub(super) fn new(
        tracer: &BlockTracer,
        picture: &Provenance,
        (prepare, trace): (f64, f64),
        (threads, bytes): (usize, u64),
    ) -> Result<Self, Error> {
        let blocks = tracer.blocks();
        let all = traced(tracer, picture.settings.spp);
        let mut rays = vec![0; blocks.count() as usize];
        for block in &all {
            rays[block.number as usize] = block.counts.rays;
        }
        let folder = env::temp_dir().join(format!("halflight-plan-{}", std::process::id()));
        let io = |source| Error::Create {
            path: folder.clone(),
            source,
        };
        fs::create_dir(&folder).map_err(io)?;
        let measured = written(&folder, picture, &all);
        fs::remove_dir_all(&folder).map_err(io)?;
        let [write, merge, merge_parts] = measured?;
        Ok(Self {
            prepare,
            trace,
            threads,
            bytes,
            blocks,
            rays,
            write,
            merge,
            merge_part: ((merge_parts - merge) / f64::from(PARTS - 1)).max(0.0),
        })
    }

    /// What a number of tasks takes, each on cores of its own.
    fn step(&self, tasks: u32) -> Step {
        let mut rays = vec![0; tasks as usize];
        for (owner, block) in part::deal(self.blocks, tasks).zip(&self.rays) {
            rays[owner as usize] += block;
        }
        let all: u64 = self.rays.iter().sum();
        let share = |rays: u64| rays as f64 / all.max(1) as f64;
        let most = share(rays.into_iter().max().unwrap_or(0));
        // A block is traced by one thread.
        let largest = share(self.rays.iter().copied().max().unwrap_or(0));
        let trace = self.trace * most.max(largest * self.threads as f64);
        Step {
            tasks,
            task: self.prepare + trace + most * self.write,
            trace,
            merge: self.merge + f64::from(tasks) * self.merge_part,
            read: u64::from(tasks) * self.bytes,
        }
    }

    fn steps(&self) -> impl Iterator<Item = Step> {
        TASKS.into_iter().map(|tasks| self.step(tasks))
    }

    /// The plan as a table, with the number of tasks from which on more are of no use.
    pub(super) fn table(&self, name: &str) -> String {
        let mut text = format!(
            "\n{name} divided among tasks with cores of their own: {} blocks; {:.2} ms to load and \
             build,\n{:.3} s to trace, {:.0} ms to write, {:.0} ms to merge and {:.2} ms a part\n\
             {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>10}\n",
            self.blocks.count(),
            1e3 * self.prepare,
            self.trace,
            1e3 * self.write,
            1e3 * self.merge,
            1e3 * self.merge_part,
            "tasks",
            "trace s",
            "task s",
            "merge s",
            "all s",
            "speed-up",
            "%",
            "read MB",
        );
        let one = self.step(1).all();
        for step in self.steps() {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{:>7} {:>9.4} {:>9.4} {:>9.4} {:>9.4} {:>9.1} {:>6.1} {:>10.1}",
                step.tasks,
                step.trace,
                step.task,
                step.merge,
                step.all(),
                one / step.all(),
                100.0 * one / step.all() / f64::from(step.tasks),
                1e-6 * step.read as f64,
            );
        }
        let best = self.steps().min_by(|a, b| a.all().total_cmp(&b.all()));
        if let Some(best) = best {
            let _ = writeln!(
                text,
                "Shortest with {} tasks, where {} takes longest. A sequence divided by frames has no merge: \
                 {:.4} s a frame and task.",
                best.tasks,
                best.bound(self.prepare),
                self.prepare + self.trace,
            );
        }
        text
    }

    /// The plan as JSON; times in seconds.
    pub(super) fn object(&self) -> Value {
        let steps = self.steps().map(|step| {
            json!({
                "tasks": step.tasks,
                "trace": step.trace,
                "task": step.task,
                "merge": step.merge,
                "all": step.all(),
                "bytes_read": step.read,
            })
        });
        json!({
            "blocks": self.blocks.count(),
            "prepare": self.prepare,
            "trace": self.trace,
            "write": self.write,
            "merge": self.merge,
            "merge_part": self.merge_part,
            "steps": steps.collect::<Value>(),
        })
    }
}

impl Step {
    fn all(&self) -> f64 {
        self.task + self.merge
    }

    /// What takes most of the time.
    fn bound(&self, prepare: f64) -> &'static str {
        let shares = [
            (prepare, "loading the scene"),
            (self.trace, "tracing the costliest shard"),
            (self.merge, "merging"),
        ];
        let most = shares.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or("", |(_, name)| name)
    }
}

/// All blocks, traced.
fn traced(tracer: &BlockTracer, spp: u32) -> Vec<Block> {
    let blocks = tracer.blocks();
    let begun = (0..blocks.count()).map(|number| Block::new(number, blocks));
    let (hand_over, handed_over) = mpsc::channel();
    tracer.trace(
        begun,
        spp,
        Duration::MAX,
        || false,
        // The receiver lives until the end.
        |block| drop(hand_over.send(block)),
    );
    drop(hand_over);
    handed_over.into_iter().collect()
}

/// The seconds to write blocks to one part, to merge it, and to merge them from many parts.
fn written(folder: &Path, picture: &Provenance, blocks: &[Block]) -> Result<[f64; 3], Error> {
    let begun = Instant::now();
    let whole = vec![write(folder, picture, Shard::WHOLE, blocks)?];
    let writing = begun.elapsed();
    let owners: Vec<_> = part::deal(Blocks::of(picture.settings.traced().size()), PARTS).collect();
    let mut parts = Vec::new();
    for index in 0..PARTS {
        let own = blocks
            .iter()
            .filter(|block| owners[block.number as usize] == index);
        let own: Vec<_> = own.cloned().collect();
        let shard = Shard {
            index,
            count: PARTS,
        };
        parts.push(write(folder, picture, shard, &own)?);
    }
    // The shortest: the two are subtracted, and the first of them touches fresh memory.
    let merging = |parts: &[PathBuf]| -> Result<Duration, Error> {
        let mut shortest = Duration::MAX;
        for _ in 0..MERGES {
            let begun = Instant::now();
            part::merge(parts, Frames::Last)?;
            shortest = shortest.min(begun.elapsed());
        }
        Ok(shortest)
    };
    let times = [writing, merging(&whole)?, merging(&parts)?];
    Ok(times.map(|time| time.as_secs_f64()))
}

/// Writes a part; returns its path.
fn write(
    folder: &Path,
    picture: &Provenance,
    shard: Shard,
    blocks: &[Block],
) -> Result<PathBuf, Error> {
    let header = Header {
        picture: picture.clone(),
        shard,
    };
    let path = part::path_beside(&folder.join("plan.png"), shard);
    let part = Part::create(&path, &header);
    let mut part = part.map_err(|source| Error::Part {
        path: path.clone(),
        source,
    })?;
    let io = |source| Error::Write {
        to: path.display().to_string(),
        source,
    };
    part.aim(picture.settings.spp).map_err(io)?;
    for block in blocks {
        part.put(block.clone()).map_err(io)?;
    }
    part.sync().map_err(io)?;
    Ok(path)
}
