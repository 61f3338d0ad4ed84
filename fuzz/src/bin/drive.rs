//! Fuzzes with a stable toolchain: mutates the corpora, without coverage, on all cores, and saves
//! every input that breaks an invariant or takes long.
//!
//! `drive --seconds N --corpus DIR --out DIR [TARGET…]`; prints the number of runs of each target.

use std::collections::HashMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::num::NonZero;
use std::panic;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use halflight_fuzz::{TARGETS, Target};

/// Inputs that take longer are findings.
const PATIENCE: Duration = Duration::from_secs(5);

/// The maximum length of an input, in bytes.
const LONGEST: usize = 8192;

/// Words of the languages, which random mutations would not produce.
const WORDS: [&[u8]; 40] = [
    b"sphere",
    b"box",
    b"cone",
    b"cylinder",
    b"ellipsoid",
    b"// view: ",
    b"eye",
    b"fov",
    b"size",
    b"obj",
    b"CSG",
    b"ID",
    b"mat",
    b"render",
    b"union",
    b"intersect",
    b"quadric",
    b"texture",
    b"image",
    b"use",
    b"light",
    b"camera",
    b"<object",
    b"<material",
    b"texture=\"checkerboard\"",
    b"/>",
    b"<!--",
    b"-->",
    b"&#10;",
    b"<![CDATA[",
    b"mtllib a\n",
    b"usemtl m\n",
    b"f 1 2 -1\n",
    b"vn",
    b"\x1b[",
    b"\x1b[200~",
    b"\x1b[201~",
    b"1e308",
    b"\r\r\n",
    b"99999999999999999999",
];

/// A target with its seeds.
struct Work {
    name: &'static str,
    target: Target,
    seeds: Vec<Vec<u8>>,
}

/// The current work of one thread: start time, target and input.
type Current = Mutex<Option<(Instant, &'static str, Vec<u8>)>>;

fn main() -> ExitCode {
    let mut options: HashMap<String, String> = HashMap::new();
    let mut names = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.strip_prefix("--") {
            Some(name) => {
                drop(options.insert(name.to_owned(), arguments.next().unwrap_or_default()))
            }
            None => names.push(argument),
        }
    }
    let option = |name: &str, default: &str| {
        let given = options.get(name);
        given.map_or_else(|| default.to_owned(), String::clone)
    };
    let Ok(seconds) = option("seconds", "60").parse() else {
        eprintln!("usage: drive [--seconds N] [--corpus DIR] [--out DIR] [TARGET...]");
        return ExitCode::from(2);
    };
    let out = PathBuf::from(option("out", "findings"));
    let corpus = PathBuf::from(option("corpus", "corpus"));
    fs::create_dir_all(&out).expect("a folder for findings");
    let wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| wanted == name);
    let works: Vec<_> = TARGETS
        .into_iter()
        .filter(|(name, _)| wanted(name))
        .map(|(name, target)| Work {
            name,
            target,
            seeds: seeds(&corpus.join(name)),
        })
        .collect();
    panic::set_hook(Box::new(|_| {}));
    let findings = fuzz(&works, Duration::from_secs(seconds), &out);
    println!("findings: {findings}, in {}", out.display());
    ExitCode::from(u8::from(findings != 0))
}

fn seeds(folder: &Path) -> Vec<Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap_or_else(|_| panic!("no corpus {}", folder.display()));
    let mut paths: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    paths
        .iter()
        .filter_map(|path| fs::read(path).ok())
        .collect()
}

/// Runs the targets on all cores for a time. Returns the number of distinct findings.
fn fuzz(works: &[Work], time: Duration, out: &Path) -> usize {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let threads = cores.max(works.len());
    let currents: Vec<Current> = (0..threads).map(|_| Mutex::new(None)).collect();
    let is_over = AtomicBool::new(false);
    let start = Instant::now();
    let counts = thread::scope(|scope| {
        let watchdog = scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                thread::sleep(PATIENCE / 4);
                for current in &currents {
                    if let Some((since, name, input)) = &*current.lock().expect("no panic in it")
                        && PATIENCE < since.elapsed()
                    {
                        keep(out, name, "slow", input);
                    }
                }
            }
        });
        let workers: Vec<_> = currents
            .iter()
            .enumerate()
            .map(|(thread, current)| {
                let work = &works[thread % works.len()];
                let is_over = || time < start.elapsed();
                scope.spawn(move || (work.name, drive(work, thread, current, is_over, out)))
            })
            .collect();
        let mut counts: HashMap<_, u64> = HashMap::new();
        for worker in workers {
            let (name, count) = worker.join().expect("findings are caught");
            *counts.entry(name).or_default() += count;
        }
        is_over.store(true, Ordering::Relaxed);
        watchdog.join().expect("no panic in it");
        counts
    });
    for work in works {
        println!("{}: {} executions", work.name, counts[work.name]);
    }
    fs::read_dir(out).map_or(0, Iterator::count)
}

/// Runs one target until the time is over. Returns the number of runs.
fn drive(
    work: &Work,
    thread: usize,
    current: &Current,
    is_over: impl Fn() -> bool,
    out: &Path,
) -> u64 {
    let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ (thread as u64 + 1));
    let mut count = 0;
    while !is_over() {
        let mut input = random.pick(&work.seeds).cloned().unwrap_or_default();
        for _ in 0..=random.below(6) {
            mutate(&mut input, &work.seeds, &mut random);
        }
        input.truncate(LONGEST);
        *current.lock().expect("no panic in it") = Some((Instant::now(), work.name, input.clone()));
        if panic::catch_unwind(|| (work.target)(&input)).is_err() {
            keep(out, work.name, "panic", &input);
        }
        *current.lock().expect("no panic in it") = None;
        count += 1;
    }
    count
}

fn mutate(input: &mut Vec<u8>, seeds: &[Vec<u8>], random: &mut Random) {
    let at = random.below(input.len() + 1);
    let end = (at + 1 + random.below(16)).min(input.len());
    match random.below(8) {
        0 if at < input.len() => input[at] ^= 1 << random.below(8),
        1 if at < input.len() => input[at] = random.next() as u8,
        2 => drop(input.drain(at..end)),
        3 => {
            let piece = input[at..end].to_vec();
            let to = random.below(input.len() + 1);
            input.splice(to..to, piece);
        }
        4 => {
            let word = WORDS[random.below(WORDS.len())];
            input.splice(at..end, word.iter().copied());
        }
        5 => {
            let number = random.next() as i16;
            input.splice(at..end, format!(" {number} ").into_bytes());
        }
        6 => {
            let other = random.pick(seeds).cloned().unwrap_or_default();
            let from = random.below(other.len() + 1);
            input.truncate(at);
            input.extend_from_slice(&other[from..]);
        }
        _ => input.insert(at, random.next() as u8),
    }
}

/// Saves an input that is a finding, under a name derived from its hash.
fn keep(out: &Path, name: &str, kind: &str, input: &[u8]) {
    let mut hasher = DefaultHasher::new();
    input.hash(&mut hasher);
    let path = out.join(format!("{name}-{kind}-{:016x}", hasher.finish()));
    if let Err(error) = fs::write(&path, input) {
        eprintln!("{}: {error}", path.display());
    }
}

/// Marsaglia's xorshift64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() >> 16) as usize % count.max(1)
    }

    fn pick<'a, T>(&mut self, of: &'a [T]) -> Option<&'a T> {
        of.get(self.below(of.len()))
    }
}
