//! The table, row by row.

use std::fmt::Write as _;
use std::time::Duration;

use crate::THREADS;
use crate::phases::Phases;
use crate::programs::{Program, Timed};

/// The peers, in the order of their columns.
const PEERS: [Program; 3] = [Program::Povray, Program::Tachyon, Program::Embree];

/// Below so many objects a page more or less says nothing about each.
const MANY: usize = 1000;

/// What a scene is to reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wanted {
    Nothing,
    /// At most this part of the best peer's time.
    Ratio(f64),
    /// At most so long.
    Milliseconds(f64),
}

/// What is known of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'a> {
    pub(crate) name: &'a str,
    pub(crate) phases: Option<&'a Phases>,
    /// The most memory that its picture takes beside its text, in bytes.
    pub(crate) peak: Option<usize>,
    /// What programs took, ours and peers'.
    pub(crate) timed: &'a [Timed],
    /// What ours took, of what is compared.
    pub(crate) ours: Duration,
    /// What ours takes to a first picture.
    pub(crate) first: Option<Duration>,
    pub(crate) wanted: Wanted,
}

/// What stands above the columns, in two lines; the first column is wider than its heading.
const HEADINGS: [[&str; 2]; 20] = [
    ["", "scene            "],
    ["", "  objects"],
    ["", "  parse"],
    ["", "  lower"],
    ["", "  build"],
    ["", "  render"],
    ["whole", "process"],
    ["first", "picture"],
    ["Mrays", "camera"],
    ["", "onward"],
    ["", "shadow"],
    ["", "   all"],
    ["Mray/s", "a core"],
    ["B/object", "open"],
    ["", "headless"],
    ["peers", "povray"],
    ["", "tachyon"],
    ["", " embree"],
    ["to best", "ratio"],
    ["", "wanted"],
];

/// Prints what stands above the columns.
pub(crate) fn heading() {
    for line in 0..2 {
        print_cells(&HEADINGS.map(|heading| heading[line].trim().to_owned()));
    }
}

/// Prints a row.
pub(crate) fn print(row: &Row<'_>) {
    let of_phases = |say: &dyn Fn(&Phases) -> String| row.phases.map_or_else(String::new, say);
    let peer = |program| row.timed.iter().find(|timed| timed.program == program);
    let best = PEERS
        .into_iter()
        .filter_map(peer)
        .map(|timed| timed.wall)
        .min();
    let ratio = best.map(|best| row.ours.as_secs_f64() / best.as_secs_f64());
    let each = |bytes: usize| {
        let objects = row.phases.map_or(0, |phases| phases.objects);
        if objects < MANY {
            String::new()
        } else {
            (bytes / objects).to_string()
        }
    };
    let megarays = |rays: u64| format!("{:.2}", rays as f64 / 1e6);
    let in_milliseconds = |time: Option<Duration>| time.map_or_else(String::new, milliseconds);
    let [povray, tachyon, embree] =
        PEERS.map(|program| in_milliseconds(peer(program).map(|timed| timed.wall)));
    print_cells(&[
        row.name.to_owned(),
        of_phases(&|phases| phases.objects.to_string()),
        of_phases(&|phases| milliseconds(phases.parse)),
        of_phases(&|phases| milliseconds(phases.lower)),
        of_phases(&|phases| milliseconds(phases.build)),
        of_phases(&|phases| milliseconds(phases.render)),
        milliseconds(row.ours),
        in_milliseconds(row.first),
        of_phases(&|phases| megarays(phases.camera_rays)),
        of_phases(&|phases| megarays(phases.rays - phases.shadow_rays - phases.camera_rays)),
        of_phases(&|phases| megarays(phases.shadow_rays)),
        of_phases(&|phases| megarays(phases.rays)),
        of_phases(&|phases| {
            let seconds = phases.render.as_secs_f64() * THREADS as f64;
            format!("{:.2}", phases.rays as f64 / 1e6 / seconds)
        }),
        of_phases(&|phases| each(phases.open)),
        row.peak.map_or_else(String::new, each),
        povray,
        tachyon,
        embree,
        ratio.map_or_else(String::new, |ratio| format!("{ratio:.2}")),
        match row.wanted {
            Wanted::Nothing => String::new(),
            Wanted::Ratio(ratio) => format!("<= {ratio}"),
            Wanted::Milliseconds(most) => format!("<= {most} ms"),
        },
    ]);
}

/// Prints cells below their headings, the first to the left and all others to the right.
fn print_cells(cells: &[String; HEADINGS.len()]) {
    let mut line = String::new();
    for (cell, [above, below]) in cells.iter().zip(HEADINGS) {
        let width = above.len().max(below.len());
        if line.is_empty() {
            line = format!("{cell:<width$}");
        } else {
            let _ = write!(line, " {cell:>width$}");
        }
    }
    println!("{}", line.trim_end());
}

fn milliseconds(time: Duration) -> String {
    let time = time.as_secs_f64() * 1e3;
    if time < 100.0 {
        format!("{time:.1}")
    } else {
        format!("{time:.0}")
    }
}
