//! Traces pictures into part files, which can be continued and merged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::{Duration, Instant};

use super::progress::{ProgressStyle, Reporter};
use super::signals::Signals;
use super::tracing::Tracing;
use super::{Error, Messages};
use part::{Header, Part, Shard};
use render::{
    BLOCK, Block, BlockTracer, Blocks, Counts, Frame, Job, Progress, Provenance, Settings,
    memory_for_blocks,
};
use scene::Integrator;
use text::counted;

/// How a picture is traced into a part file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The part of the picture to trace.
    pub shard: Shard,
    /// What becomes of a part file that is there already.
    pub existing: Existing,
}

/// What becomes of a part file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It is continued.
    Continued,
    /// It is an error.
    Refused,
}

/// A block takes this long at most until it is written, and this long again until it is synced: at
/// most 30 s of work are lost.
const INTERVAL: Duration = Duration::from_secs(10);

/// Blocks that wait to be written. Tracing waits for a slow disk.
const WAITING: usize = 64;

/// What was traced into a part file.
pub(super) struct Traced {
    /// The picture, if the part is all of it.
    pub(super) frame: Option<Frame>,
    /// The samples and rays of all of it, and the time of this process.
    pub(super) progress: Progress,
    /// The number of pixels traced.
    pub(super) pixels: usize,
}

/// About how many bytes of memory tracing a job into a part file takes, and merging it if it is whole;
/// without those of the scene. `kept` are the photons of each map, if known.
pub(super) fn memory_for(job: &Job, parts: Parts, threads: usize, kept: Option<u64>) -> u64 {
    let blocks = Blocks::of(job.settings.traced().size());
    let in_flight = (WAITING + 2 * threads) as u64 * u64::from(BLOCK) * u64::from(BLOCK);
    // Blocks that are continued are read before, and those with photons traced together.
    let is_together = job.settings.integrator == Integrator::Photon;
    let begun = if parts.existing == Existing::Refused && !is_together {
        0
    } else {
        let numbers = parts.shard.blocks(blocks).into_iter();
        numbers.map(|number| blocks.area(number) as u64).sum()
    };
    let traced = memory_for_blocks(job, begun + in_flight, kept);
    match parts.shard {
        Shard::WHOLE => traced.max(render::memory_for(job, kept)),
        _ => traced,
    }
}

/// Traces a job, of this picture, into the part file beside its file.
pub(super) fn trace(
    tracing: &Tracing,
    (path, parts): (&Path, Parts),
    job: Job,
    picture: &Provenance,
) -> Result<Traced, Error> {
    let frames = job.frames;
    let header = Header {
        picture: picture.clone(),
        shard: parts.shard,
    };
    let blocks = Blocks::of(job.settings.traced().size());
    let path = part::path_beside(path, parts.shard);
    let refused = |source| Error::Part {
        path: path.clone(),
        source,
    };
    // Without them, a signal ends the process, and what was synced is kept.
    let signals = Signals::noted().unwrap_or_default();
    let part = match parts.existing {
        Existing::Continued => Part::open(&path, &header),
        Existing::Refused => Part::create(&path, &header),
    };
    let part = part.map_err(refused)?;
    if 0 < part.cut() {
        let cut = counted(part.cut() as usize, "damaged byte");
        let note = format!("{}: discarded {cut} at the end", path.display());
        Messages::beside(tracing.progress).note(&note);
    }
    let mut continued = Continued {
        numbers: parts.shard.blocks(blocks),
        part,
        path,
        signals,
        limit: tracing.time,
        style: tracing.progress,
        begun: Instant::now(),
        counts: Counts::default(),
    };
    let spp = continued.run(job, tracing.threads)?;
    let Continued {
        part,
        path,
        numbers,
        begun,
        counts,
        ..
    } = &continued;
    let elapsed = begun.elapsed();
    let traced = progress(spp, 1.0, elapsed, *counts);
    let progress = progress(spp, 1.0, elapsed, part.counts());
    let pixels = numbers.iter().map(|&number| blocks.area(number)).sum();
    let reporter = Reporter::new(tracing.progress);
    if parts.shard != Shard::WHOLE {
        reporter.finish(&traced);
        let blocks = counted(numbers.len(), "block");
        let note = format!(
            "shard {}: {blocks} with {spp} spp in {}",
            parts.shard,
            path.display()
        );
        Messages::beside(tracing.progress).note(&note);
        return Ok(Traced {
            frame: None,
            progress,
            pixels,
        });
    }
    let mut frame = part::merge(std::slice::from_ref(path), frames)?.frame;
    frame.progress.elapsed = elapsed;
    reporter.finish(&Progress {
        noise: frame.progress.noise,
        ..traced
    });
    Ok(Traced {
        progress: frame.progress,
        frame: Some(frame),
        pixels,
    })
}

/// A part that is traced.
struct Continued {
    part: Part,
    path: PathBuf,
    /// The numbers of its blocks.
    numbers: Vec<u32>,
    signals: Signals,
    /// The time after which no pass begins.
    limit: Option<Duration>,
    style: ProgressStyle,
    begun: Instant,
    /// Rays traced.
    counts: Counts,
}

impl Continued {
    /// Traces all blocks as far as asked. Returns their samples.
    fn run(&mut self, job: Job, threads: usize) -> Result<u32, Error> {
        let Settings { spp, .. } = job.settings;
        let numbers = || self.numbers.iter().copied();
        let most = numbers().map(|number| self.part.most_samples(number)).max();
        if let Some(most) = most.filter(|&most| spp < most) {
            return Err(Error::Refused(format!(
                "{} has {most} samples per pixel already: use --spp {most} or more, or delete it",
                self.path.display()
            )));
        }
        let samples = numbers().map(|number| self.part.samples(number));
        let mut whole = samples.min().unwrap_or(spp);
        if spp <= whole {
            self.aim(spp)?;
            return Ok(spp);
        }
        let signals = self.signals.clone();
        let tracer = BlockTracer::new(job, threads, || signals.arrived())?;
        let Some(tracer) = tracer else {
            let none_begun = BTreeMap::new();
            return Err(self.stopped(self.tally(spp, &none_begun).done()));
        };
        let (first, begun) = (whole, Instant::now());
        loop {
            let goal = match self.limit {
                None => spp,
                Some(_) => (whole + 1).next_power_of_two().min(spp),
            };
            self.sweep(&tracer, goal)?;
            let took = begun.elapsed().as_secs_f64() / f64::from(goal - first);
            whole = goal;
            let next = f64::from(whole.min(spp - whole));
            let left = self
                .limit
                .map(|limit| limit.saturating_sub(self.begun.elapsed()));
            if whole == spp || left.is_some_and(|left| left.as_secs_f64() < next * took) {
                return Ok(whole);
            }
        }
    }

    /// Traces all blocks to this number of samples.
    fn sweep(&mut self, tracer: &BlockTracer, spp: u32) -> Result<(), Error> {
        self.aim(spp)?;
        let Self { part, numbers, .. } = self;
        let blocks = tracer.blocks();
        let lacking = numbers
            .iter()
            .copied()
            .filter(|&number| part.samples(number) < spp);
        let lacking: Vec<_> = lacking.collect();
        let begun = lacking.iter().filter(|&&number| 0 < part.samples(number));
        let begun = begun.map(|&number| Ok((number, part.block(number)?)));
        let begun: Result<BTreeMap<_, _>, _> = begun.collect();
        let mut begun = begun.map_err(|source| self.unwritten(source))?;
        let mut tally = self.tally(spp, &begun);
        let todo = lacking.into_iter().map(move |number| {
            let block = begun.remove(&number);
            block.unwrap_or_else(|| Block::new(number, blocks))
        });
        let (signals, failed) = (self.signals.clone(), &AtomicBool::new(false));
        let stopped = move || signals.arrived() || failed.load(Ordering::Relaxed);
        let (hand_over, handed_over) = mpsc::sync_channel(WAITING);
        let written = thread::scope(|scope| {
            // The sender ends with the tracing, and with it the loop that writes.
            scope.spawn(move || {
                // The receiver is dropped only after a failure, which stops the tracing.
                let hand_over = |block| drop(hand_over.send(block));
                tracer.trace(todo, spp, INTERVAL, stopped, hand_over);
            });
            let written = self.write(&handed_over, &mut tally);
            failed.store(written.is_err(), Ordering::Relaxed);
            drop(handed_over);
            written
        });
        written.map_err(|source| self.unwritten(source))?;
        if tally.taken < tally.all {
            return Err(self.stopped(tally.done()));
        }
        Ok(())
    }

    /// How far all blocks are on their way to `spp` samples, some of which are `begun`.
    fn tally(&self, spp: u32, begun: &BTreeMap<u32, Block>) -> Tally {
        let reached = self.numbers.iter().map(|&number| {
            let counts = begun.get(&number).map(|block| block.counts);
            (
                number,
                self.part.samples(number),
                counts.unwrap_or_default(),
            )
        });
        Tally::new(spp, self.part.blocks(), reached)
    }

    /// Writes blocks as they come.
    fn write(&mut self, blocks: &Receiver<Block>, tally: &mut Tally) -> std::io::Result<()> {
        let mut reporter = Reporter::new(self.style).begun(tally.done());
        let mut synced = Instant::now();
        while let Ok(block) = blocks.recv() {
            tally.add(&block);
            self.part.put(block)?;
            if INTERVAL <= synced.elapsed() {
                self.part.sync()?;
                synced = Instant::now();
            }
            let counts = self.counts.and(tally.counts);
            let elapsed = self.begun.elapsed();
            reporter.show(&progress(tally.least(), tally.done(), elapsed, counts));
        }
        self.counts = self.counts.and(tally.counts);
        self.part.sync()
    }

    fn aim(&mut self, spp: u32) -> Result<(), Error> {
        self.part.aim(spp).map_err(|source| self.unwritten(source))
    }

    fn unwritten(&self, source: std::io::Error) -> Error {
        Error::Write {
            to: self.path.display().to_string(),
            source,
        }
    }

    /// The error that tracing was stopped.
    fn stopped(&self, done: f64) -> Error {
        match self.signals.last() {
            Some(signal) => Error::Kept {
                path: self.path.clone(),
                signal,
                done,
            },
            None => Error::Stopped,
        }
    }
}

/// How far all blocks of a part are traced.
struct Tally {
    /// Samples of each pixel to reach.
    spp: u32,
    blocks: Blocks,
    /// The samples of each block, and the rays of those that are to be continued.
    reached: BTreeMap<u32, (u32, Counts)>,
    /// How many blocks have reached each number of samples.
    levels: BTreeMap<u32, usize>,
    /// Samples of all blocks to take, and taken, before too.
    all: u64,
    taken: u64,
    /// Rays traced since it began.
    counts: Counts,
}

impl Tally {
    /// Begins with blocks of some samples.
    fn new(spp: u32, blocks: Blocks, begun: impl Iterator<Item = (u32, u32, Counts)>) -> Self {
        let mut tally = Self {
            spp,
            blocks,
            reached: BTreeMap::new(),
            levels: BTreeMap::new(),
            all: 0,
            taken: 0,
            counts: Counts::default(),
        };
        for (number, samples, counts) in begun {
            let (samples, area) = (samples.min(spp), blocks.area(number) as u64);
            tally.all += u64::from(spp) * area;
            tally.taken += u64::from(samples) * area;
            tally.reached.insert(number, (samples, counts));
            *tally.levels.entry(samples).or_default() += 1;
        }
        tally
    }

    fn add(&mut self, block: &Block) {
        let now = (block.samples, block.counts);
        let (samples, counts) = self.reached.insert(block.number, now).unwrap_or_default();
        let taken = u64::from(block.samples - samples);
        self.taken += taken * self.blocks.area(block.number) as u64;
        self.counts = self.counts.and(block.counts.since(counts));
        if let Some(blocks) = self.levels.get_mut(&samples) {
            *blocks -= 1;
            if *blocks == 0 {
                self.levels.remove(&samples);
            }
        }
        *self.levels.entry(block.samples).or_default() += 1;
    }

    /// Samples that every pixel has.
    fn least(&self) -> u32 {
        let least = self.levels.first_key_value();
        least.map_or(self.spp, |(&samples, _)| samples)
    }

    /// The share of all the work that is done, 0 to 1.
    fn done(&self) -> f64 {
        self.taken as f64 / self.all.max(1) as f64
    }
}

/// The progress of blocks traced to `spp` samples.
fn progress(spp: u32, done: f64, elapsed: Duration, counts: Counts) -> Progress {
    Progress {
        pass: 1,
        passes: 1,
        spp,
        mean_spp: f64::from(spp),
        done,
        elapsed,
        rays: counts.rays,
        shadow_rays: counts.shadow_rays,
        over_budget: counts.over_budget,
        noise: None,
        complete: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Size;

    #[test]
    fn what_was_traced_before_counts_as_done() {
        let size = Size {
            width: 96,
            height: 32,
        };
        let blocks = Blocks::of(size);
        let counts = |rays| Counts {
            rays,
            ..Counts::default()
        };
        let traced = |number, samples, rays| Block {
            samples,
            counts: counts(rays),
            ..Block::new(number, blocks)
        };
        // One block is complete, one is begun.
        let begun = [
            (0, 8, Counts::default()),
            (1, 4, counts(40)),
            (2, 0, counts(0)),
        ];
        let mut tally = Tally::new(8, blocks, begun.into_iter());
        assert_eq!(
            (tally.done(), tally.least(), tally.counts.rays),
            (0.5, 0, 0)
        );
        tally.add(&traced(2, 4, 50));
        assert_eq!((tally.least(), tally.counts.rays), (4, 50));
        tally.add(&traced(1, 8, 80));
        tally.add(&traced(2, 8, 90));
        assert_eq!(
            (tally.done(), tally.least(), tally.counts.rays),
            (1.0, 8, 130)
        );
    }
}
