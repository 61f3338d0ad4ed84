//! Traces pictures into part files, which can be continued and merged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::{Duration, Instant};

use super::arguments::{Existing, Parts};
use super::tally::Tally;
use super::{Error, Execution, Output};
use crate::progress::Reporter;
use crate::signals::Signals;
use render::{
    BLOCK, Block, BlockTracer, Blocks, Counts, Frame, Job, Limit, Progress, Provenance, Settings,
    memory_for_blocks,
};
use scene::Integrator;
use shards::{Header, NoTrace, Part, Shard, Traces};
use text::counted;

/// A block takes this long at most until it is written, and this long again until it is synced: at
/// most 30 s of work are lost.
const INTERVAL: Duration = Duration::from_secs(10);

/// Blocks that wait to be written. Tracing waits for a slow disk.
const WAITING: usize = 64;

/// A picture, or a part of one, that was traced.
pub(super) struct Traced {
    /// The picture, unless it is a part.
    pub(super) frame: Option<Arc<Frame>>,
    /// What it is made from.
    pub(super) picture: Provenance,
    /// The samples and rays of all of it, and the time of this process.
    pub(super) progress: Progress,
    /// The number of pixels traced.
    pub(super) pixels: usize,
}

/// A part file beside a picture, which need not exist.
pub(super) struct PartFile {
    path: PathBuf,
    parts: Parts,
}

impl PartFile {
    /// The part file beside a picture; refuses one beside no file.
    pub(super) fn beside(picture: &Output, parts: Parts) -> Result<Self, Error> {
        match picture {
            Output::File(path) if !path.exists() || path.is_file() => Ok(Self {
                path: shards::path_beside(path, parts.shard),
                parts,
            }),
            _ => Err(Error::Refused(
                "--shard and --resume keep a part file beside the picture: use -o FILE".to_owned(),
            )),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The option that asks for it, with its verb.
    pub(super) fn needs(&self) -> &'static str {
        match self.parts.existing {
            Existing::Continued => "--resume needs",
            Existing::Refused => "--shard needs",
        }
    }

    /// About how many bytes of memory tracing a job into it takes, and merging it if it is whole; without
    /// those of the scene. `kept` are the photons of each map, if known.
    pub(super) fn memory_for(&self, job: &Job, threads: usize, kept: Option<u64>) -> u64 {
        let Parts { shard, existing } = self.parts;
        let blocks = Blocks::of(job.settings.traced().size());
        let in_flight = (WAITING + 2 * threads) as u64 * u64::from(BLOCK) * u64::from(BLOCK);
        // Blocks that are continued are read before, and those with photons traced together.
        let is_together = job.settings.integrator == Integrator::Photon;
        let begun = if existing == Existing::Refused && !is_together {
            0
        } else {
            let numbers = shard.blocks(blocks).into_iter();
            numbers.map(|number| blocks.area(number) as u64).sum()
        };
        let traced = memory_for_blocks(job, begun + in_flight, kept);
        match shard {
            Shard::WHOLE => traced.max(render::memory_for(job, kept)),
            _ => traced,
        }
    }

    /// Opens or creates it for this picture, and refuses one that has more samples already. From now on,
    /// a signal stops the tracing instead of the process.
    pub(super) fn open(self, picture: Provenance, execution: Execution) -> Result<Opened, Error> {
        let Self { path, parts } = self;
        let shard = parts.shard;
        let header = Header { picture, shard };
        // Without them, a signal ends the process, and what was synced is kept.
        let signals = Signals::noted().unwrap_or_default();
        let part = match parts.existing {
            Existing::Continued => Part::open(&path, &header),
            Existing::Refused => Part::create(&path, &header),
        };
        let mut part = part.map_err(|source| Error::Part {
            path: path.clone(),
            source,
        })?;
        let note = |what: &str| {
            execution
                .messages()
                .note(&format!("{}: {what}", path.display()));
        };
        if 0 < part.cut() {
            let cut = counted(part.cut() as usize, "damaged byte");
            note(&format!("discarded {cut} at the end"));
        }
        let spp = header.picture.settings.spp;
        let numbers = shard.blocks(part.blocks());
        let most = numbers
            .iter()
            .map(|&number| part.most_samples(number))
            .max();
        if let Some(most) = most.filter(|&most| spp < most) {
            return Err(Error::Refused(format!(
                "{} has {most} samples per pixel already: use --spp {most} or more, or delete it",
                path.display()
            )));
        }
        if parts.existing == Existing::Continued {
            match take_over(&mut part, &numbers, spp) {
                Ok(0) => {}
                Ok(taken) => {
                    let taken = counted(taken, "block");
                    note(&format!(
                        "continues {taken} of the interface's full-size trace"
                    ));
                }
                Err(reason) => note(&reason.to_string()),
            }
        }
        Ok(Opened {
            spent: part.goal().time,
            part,
            path,
            header,
            numbers,
            signals,
            execution,
            begun: Instant::now(),
            counts: Counts::default(),
        })
    }
}

/// Takes over the blocks in which the interface's full-size trace of the same film is further, unless it
/// has more samples than `spp`. Returns how many there are.
fn take_over(part: &mut Part, numbers: &[u32], spp: u32) -> Result<usize, NoTrace> {
    // Without a state folder there are no traces.
    let Ok(traces) = Traces::of_user() else {
        return Ok(0);
    };
    let Some(trace) = traces.find(&part.header().picture)? else {
        return Ok(0);
    };
    let blocks = part.blocks();
    let mut taken = 0;
    for &number in numbers {
        if part.taken(number) < trace.taken(number) && trace.most_samples(number) <= spp {
            let block = trace.block(number)?.continued_to(spp, blocks);
            if part.taken(number) < block.total(blocks) {
                part.put(block)?;
                taken += 1;
            }
        }
    }
    if 0 < taken {
        part.spend(part.goal().time.max(trace.goal().time))?;
    }
    Ok(taken)
}

/// A part file that is open, to be traced into.
pub(super) struct Opened {
    part: Part,
    path: PathBuf,
    header: Header,
    /// The numbers of its blocks.
    numbers: Vec<u32>,
    signals: Signals,
    execution: Execution,
    begun: Instant,
    /// The time that earlier processes spent.
    spent: Duration,
    /// Rays traced.
    counts: Counts,
}

impl Opened {
    /// Traces a job as far as asked.
    pub(super) fn trace(mut self, job: Job) -> Result<Traced, Error> {
        let frames = job.frames;
        let spp = self.run(job)?;
        let Header { mut picture, shard } = self.header;
        picture.settings.spp = spp;
        let elapsed = self.begun.elapsed();
        let traced = progress(spp, 1.0, elapsed, self.counts);
        let progress = progress(spp, 1.0, elapsed, self.part.counts());
        let blocks = self.part.blocks();
        let numbers = self.numbers.iter();
        let pixels = numbers.map(|&number| blocks.area(number)).sum();
        let reporter = Reporter::new(self.execution.progress);
        if shard != Shard::WHOLE {
            reporter.finish(&traced);
            let blocks = counted(self.numbers.len(), "block");
            let path = self.path.display();
            let note = format!("shard {shard}: {blocks} with {spp} spp in {path}");
            self.execution.messages().note(&note);
            return Ok(Traced {
                frame: None,
                picture,
                progress,
                pixels,
            });
        }
        let mut frame = shards::merge(&[self.path], frames)?.frame;
        frame.progress.elapsed = elapsed;
        reporter.finish(&Progress {
            noise: frame.progress.noise,
            ..traced
        });
        picture.settings.spp = frame.progress.spp;
        Ok(Traced {
            progress: frame.progress,
            frame: Some(Arc::new(frame)),
            picture,
            pixels,
        })
    }

    /// Traces all blocks as far as asked. Returns their samples.
    fn run(&mut self, job: Job) -> Result<u32, Error> {
        let Settings { spp, .. } = job.settings;
        let limit = match job.limit {
            Some(Limit::Time(limit)) => Some(limit),
            _ => None,
        };
        let numbers = self.numbers.iter();
        let samples = numbers.map(|&number| self.part.samples(number));
        let mut whole = samples.min().unwrap_or(spp);
        if spp <= whole {
            self.aim(spp)?;
            return Ok(spp);
        }
        let tracer = BlockTracer::new(job, self.execution.threads, &|| self.signals.arrived())?;
        let Some(tracer) = tracer else {
            let none_begun = BTreeMap::new();
            return Err(self.stopped(self.tally(spp, &none_begun).done()));
        };
        let (first, begun) = (whole, Instant::now());
        loop {
            let goal = match limit {
                None => spp,
                Some(_) => (whole + 1).next_power_of_two().min(spp),
            };
            self.sweep(&tracer, goal)?;
            let took = begun.elapsed().as_secs_f64() / f64::from(goal - first);
            whole = goal;
            let next = f64::from(whole.min(spp - whole));
            let left = limit.map(|limit| limit.saturating_sub(self.begun.elapsed()));
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
        let begun = lacking.iter().filter(|&&number| 0 < part.taken(number));
        let begun = begun.map(|&number| {
            let block = part.block(number)?.continued_to(spp, blocks);
            Ok((number, block))
        });
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
                tracer.trace(todo, spp, INTERVAL, &stopped, hand_over);
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
        let Self { part, numbers, .. } = self;
        let reached = numbers.iter().map(|&number| {
            let reached = begun.get(&number);
            let reached = reached.map(|block| (block.samples, block.counts));
            let (samples, counts) =
                reached.unwrap_or_else(|| (part.samples(number), Counts::default()));
            (number, samples, counts)
        });
        Tally::new(spp, part.blocks(), reached)
    }

    /// Writes blocks as they come.
    fn write(&mut self, blocks: &Receiver<Block>, tally: &mut Tally) -> std::io::Result<()> {
        let mut reporter = Reporter::new(self.execution.progress).begun(tally.done());
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
        self.part.spend(self.spent + self.begun.elapsed())?;
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
