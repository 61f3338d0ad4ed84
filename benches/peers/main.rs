//! Rendering times compared with other ray tracers: one table.
//!
//! `cargo bench --bench peers` prints it; words after `--` select scenes by name. `HALFLIGHT_BENCH`
//! names a folder with the scenes S1 to S5 in our languages and those of the peers, and with the
//! source of a reference that traces with Embree. Without it similar scenes are generated, and
//! peers are not measured. `cargo bench --bench peers -- growth` prints and plots the growth of
//! time and memory with objects and lights instead.
//!
//! The table is also written as JSON, and its ratios are printed beside those kept in `peers.json`;
//! `-- --keep` replaces these.
//!
//! Programs are run in turn, so that other load on the machine affects all of them alike.

mod cases;
mod growth;
mod kept;
#[path = "../meshes/mod.rs"]
mod meshes;
mod phases;
mod plot;
mod programs;
#[path = "../scenes/mod.rs"]
mod scenes;
mod setting;
mod table;

use std::path::Path;

use cases::{Case, Picture, Target};
use halflight::scene::Size;
use kept::Kept;
use programs::{Program, Timed};
use setting::{LONG, RUNS, SCRATCH, THREADS, WHOLE};
use table::Row;

/// A small first picture.
const FIRST: Picture = Picture {
    size: Size {
        width: 160,
        height: 90,
    },
    spp: 1,
};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [verb, of_child @ ..] = &arguments[..]
        && verb == phases::VERB
    {
        phases::print(of_child);
        return;
    }
    // Cargo passes `--bench`; other arguments are parts of names.
    let selected: Vec<&String> = arguments.iter().filter(|a| !a.starts_with("--")).collect();
    std::fs::create_dir_all(SCRATCH).expect("the target folder is writable");
    if selected == ["growth"] {
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
        println!("peers skipped: HALFLIGHT_BENCH names no folder with scenes in their languages");
    }
    table::heading();
    let bare = programs::peak_of(&cases::bare());
    let mut kept = Kept::read();
    for case in cases::all(folder) {
        if selected.is_empty()
            || selected
                .iter()
                .any(|part| case.name.contains(part.as_str()))
        {
            measure(&case, &programs, bare, &mut kept);
        }
    }
    println!("load {}", load());
    kept.write(arguments.iter().any(|argument| argument == "--keep"));
}

/// Measures a scene and prints its rows. `bare` is the peak memory of a minimal render.
fn measure(case: &Case, programs: &[Program], bare: usize, kept: &mut Kept) {
    let phases = phases::measure(case);
    let whole = in_turn(case, &case.picture(WHOLE), programs);
    let small = in_turn(case, &FIRST, programs);
    let peak = programs::peak_of(case).saturating_sub(bare);
    let mut print = |row: Row<'_>| {
        // Rows below that of the scene are indented.
        let name = match row.name.strip_prefix("  ") {
            Some(of_scene) => format!("{}, {of_scene}", case.name),
            None => row.name.to_owned(),
        };
        table::print(&row, kept.ratio(&name));
        kept.add(name, &row);
    };
    print(Row {
        name: &case.name,
        phases: Some(&phases),
        peak: Some(peak.saturating_sub(phases.text)),
        timed: &whole,
        ours: whole[0].wall,
        first: Some(small[0].wall),
        target: case.target,
    });
    let mut plain = |name, timed, ours, target| {
        print(Row {
            name,
            phases: None,
            peak: None,
            timed,
            ours,
            first: None,
            target,
        });
    };
    let frames: Vec<_> = whole.iter().filter_map(Timed::frame_alone).collect();
    if !frames.is_empty() {
        plain("  frame alone", &frames, phases.render, case.frame_target);
    }
    if case.first_target != Target::Nothing {
        plain("  first picture", &small, small[0].wall, case.first_target);
    }
}

/// Runs all programs that can render a picture, in turn, ours first.
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

/// The machine's load over the last minute, an indication of how reliable the figures are.
fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split(' ').next().unwrap_or("?").to_owned()
}
