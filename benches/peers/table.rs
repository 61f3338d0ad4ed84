//! The table of results.

use std::fmt::Write as _;
use std::time::Duration;

use crate::cases::Target;
use crate::phases::Phases;
use crate::programs::{Program, Timed};
use crate::setting::THREADS;

/// The peers, in the order of their columns.
pub(crate) const PEERS: [Program; 3] = [Program::Povray, Program::Tachyon, Program::Embree];

/// Bytes per object are omitted for fewer objects, where the size of a page dominates.
const MANY: usize = 1000;

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'a> {
    pub(crate) name: &'a str,
    pub(crate) phases: Option<&'a Phases>,
    /// The peak memory of a headless render besides the text, in bytes.
    pub(crate) peak: Option<usize>,
    /// The times of all programs.
    pub(crate) timed: &'a [Timed],
    /// Our time to be compared.
    pub(crate) ours: Duration,
    /// Our time to a first picture.
    pub(crate) first: Option<Duration>,
    pub(crate) target: Target,
}

impl Row<'_> {
    /// The time of a peer.
    pub(crate) fn of(&self, peer: Program) -> Option<&Timed> {
        self.timed.iter().find(|timed| timed.program == peer)
    }

    /// Our time over that of the fastest peer.
    pub(crate) fn ratio(&self) -> Option<f64> {
        let peers = PEERS.into_iter().filter_map(|peer| self.of(peer));
        let best = peers.map(|timed| timed.wall).min()?;
        Some(self.ours.as_secs_f64() / best.as_secs_f64())
    }
}

/// The two lines of headings; blanks set a column's width.
const HEADINGS: [[&str; 2]; 21] = [
    ["", "scene            "],
    ["", "  objects"],
    ["", "  parse"],
    ["", "  lower"],
    ["", "  build"],
    ["", "  render"],
    ["whole", "process"],
    ["first", "picture"],
    ["Mrays", "camera"],
    ["", "bounce"],
    ["", "shadow"],
    ["", "   all"],
    ["Mray/s", "per core"],
    ["B/object", "open"],
    ["", "headless"],
    ["peers", "povray"],
    ["", "tachyon"],
    ["", " embree"],
    ["vs best", "ratio"],
    ["", " kept"],
    ["", "target"],
];

/// Prints the headings.
pub(crate) fn heading() {
    for line in 0..2 {
        print_cells(&HEADINGS.map(|heading| heading[line].trim().to_owned()));
    }
}

/// Prints a row, with the ratio kept for it.
pub(crate) fn print(row: &Row<'_>, kept: Option<f64>) {
    let of_phases = |show: &dyn Fn(&Phases) -> String| row.phases.map_or_else(String::new, show);
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
        PEERS.map(|peer| in_milliseconds(row.of(peer).map(|timed| timed.wall)));
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
        to_hundredths(row.ratio()),
        to_hundredths(kept),
        match row.target {
            Target::Nothing => String::new(),
            Target::Ratio(ratio) => format!("<= {ratio}"),
        },
    ]);
}

/// Prints cells below their headings, the first left-aligned, the others right-aligned.
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

fn to_hundredths(ratio: Option<f64>) -> String {
    ratio.map_or_else(String::new, |ratio| format!("{ratio:.2}"))
}

fn milliseconds(time: Duration) -> String {
    let time = time.as_secs_f64() * 1e3;
    if time < 100.0 {
        format!("{time:.1}")
    } else {
        format!("{time:.0}")
    }
}
