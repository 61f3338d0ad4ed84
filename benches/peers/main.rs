//! How fast pictures are made beside the tracers a user could pick instead: one table.
//!
//! `cargo bench --bench peers` prints it; with words after `--` only the scenes with one of them in
//! their name. `HALFLIGHT_BENCH` names a folder with the scenes S1 to S5 in our languages and in
//! those of the peers, and with the source of a reference that traces with Embree; without it scenes
//! made up on the spot stand in for those they are like, and nothing is measured beside them.
//! `cargo bench --bench peers -- growth` prints how time and memory grow with objects and lights
//! instead, and plots it.
//!
//! Programs are run in turn, so that whatever slows the machine down slows all of them.

mod cases;
mod growth;
#[path = "../meshes/mod.rs"]
mod meshes;
mod phases;
mod plot;
mod programs;
#[path = "../scenes/mod.rs"]
mod scenes;
mod table;

use std::path::Path;
use std::time::Duration;

use cases::{Case, Picture};
use halflight::scene::Size;
use programs::{Program, Timed};
use table::{Row, Wanted};

/// Runs of everything that is timed; the median is printed.
const RUNS: usize = 5;

/// A program that takes longer than this is run three times only.
const LONG: Duration = Duration::from_secs(6);

/// Threads that each program is given.
const THREADS: usize = 2;

/// What is traced.
const WHOLE: Size = Size {
    width: 1280,
    height: 720,
};

/// A first picture.
const FIRST: Picture = Picture {
    size: Size {
        width: 160,
        height: 90,
    },
    spp: 1,
};

/// What is written on the way: below the target folder.
const SCRATCH: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/peers");

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [verb, of_child @ ..] = &arguments[..]
        && verb == phases::VERB
    {
        phases::tell(of_child);
        return;
    }
    // Cargo passes `--bench`; anything else is part of a name.
    let wanted: Vec<&String> = arguments.iter().filter(|a| !a.starts_with("--")).collect();
    std::fs::create_dir_all(SCRATCH).expect("the target folder takes a folder");
    if wanted == ["growth"] {
        println!("load {}", load());
        growth::measure();
        println!("load {}", load());
        return;
    }
    let folder = std::env::var_os("HALFLIGHT_BENCH");
    let folder = folder.as_deref().map(Path::new);
    let programs = Program::installed(folder);
    println!(
        "{}x{}, {THREADS} threads, medians of {RUNS}, milliseconds; load {}",
        WHOLE.width,
        WHOLE.height,
        load()
    );
    if folder.is_none() {
        println!(
            "peers are left out: HALFLIGHT_BENCH names no folder with scenes in their languages"
        );
    }
    table::heading();
    let bare = programs::peak_of(&cases::bare());
    for case in cases::all(folder) {
        if wanted.is_empty() || wanted.iter().any(|part| case.name.contains(part.as_str())) {
            measure(&case, &programs, bare);
        }
    }
    println!("load {}", load());
}

/// Measures a scene and prints its rows. `bare` is the most memory that a picture of next to nothing
/// takes.
fn measure(case: &Case, programs: &[Program], bare: usize) {
    let phases = phases::measure(case);
    let whole = in_turn(case, &case.picture(WHOLE), programs);
    let small = in_turn(case, &FIRST, programs);
    let peak = programs::peak_of(case).saturating_sub(bare);
    table::print(&Row {
        name: &case.name,
        phases: Some(&phases),
        peak: Some(peak.saturating_sub(phases.text)),
        timed: &whole,
        ours: whole[0].wall,
        first: Some(small[0].wall),
        wanted: case.wanted,
    });
    let plain = |name, timed, ours, wanted| {
        table::print(&Row {
            name,
            phases: None,
            peak: None,
            timed,
            ours,
            first: None,
            wanted,
        });
    };
    let frames: Vec<_> = whole.iter().filter_map(Timed::frame_alone).collect();
    if !frames.is_empty() {
        plain("  frame alone", &frames, phases.render, case.frame_wanted);
    }
    if case.first_wanted != Wanted::Nothing {
        plain("  first picture", &small, small[0].wall, case.first_wanted);
    }
}

/// Runs all programs that can make a picture, in turn; ours is the first.
fn in_turn(case: &Case, picture: &Picture, programs: &[Program]) -> Vec<Timed> {
    let mut timed: Vec<Timed> = programs
        .iter()
        .filter(|program| program.command(case, picture).is_some())
        .map(|program| Timed::of(*program))
        .collect();
    for run in 0..RUNS {
        for timed in &mut timed {
            if run < 3 || timed.wall < LONG {
                timed.run(case, picture);
            }
        }
    }
    timed
}

/// The machine's load over the last minute, which says what the figures are worth.
fn load() -> String {
    let said = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    said.split(' ').next().unwrap_or("?").to_owned()
}
