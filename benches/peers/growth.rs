//! The growth of time and memory with objects and lights: two tables with plots.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::cases::{self, Case};
use crate::phases::{self, Phases};
use crate::plot::{self, Series};
use crate::setting::SCRATCH;
use crate::{programs, scenes};

/// The largest number of objects is 10 · 10 to this power.
const DECADES: u32 = 6;

/// Times below this, in milliseconds, are too inaccurate for a growth.
const CERTAIN: f64 = 10.0;

/// Prints both tables and writes the plots.
pub(crate) fn measure() {
    objects();
    lights();
}

/// The measurements for one number of objects.
struct Step {
    count: f64,
    /// The times in milliseconds: parse, lower, build, render.
    times: [f64; 4],
    /// Bytes besides the text: of an open scene, and at the peak of a headless render.
    bytes: [f64; 2],
}

const TIMES: [&str; 4] = ["parse", "lower", "build", "render"];
const BYTES: [&str; 2] = ["open", "headless"];

fn objects() {
    println!("spheres that fill a constant part of a cube, milliseconds and bytes");
    print!("{:>10} {:>8}", "objects", "text MB");
    for name in TIMES {
        print!(" {name:>9} {:>6}", "growth");
    }
    for name in BYTES {
        print!(" {name:>10} {:>6}", "growth");
    }
    println!(" {:>9} {:>8}", "ns/object", "n log n");
    let bare = programs::peak_of(&cases::bare());
    let mut steps: Vec<Step> = Vec::new();
    for decade in 0..=DECADES {
        let count = 10_usize.pow(decade + 1);
        let path = write("spheres.ray", &scenes::random_spheres(count, 1));
        let case = Case {
            depth: Some(0),
            ..Case::plain(&count.to_string(), path.clone())
        };
        let phases = phases::measure(&case);
        let peak = programs::peak_of(&case).saturating_sub(bare + phases.text);
        // It may be as large as a gigabyte.
        let _ = std::fs::remove_file(path);
        let step = Step {
            count: count as f64,
            times: times(&phases),
            bytes: [phases.open, peak].map(|bytes| bytes as f64),
        };
        print_step(&step, steps.last(), phases.text);
        steps.push(step);
    }
    println!("growth: the exponent since the previous step; * if worse than n log n");
    let series = |name: &'static str, value: &dyn Fn(&Step) -> f64| Series {
        name,
        points: steps.iter().map(|step| (step.count, value(step))).collect(),
    };
    let guide = |value: &dyn Fn(&Step) -> f64| {
        let last = steps
            .last()
            .map_or((1.0, 1.0), |last| (last.count, value(last)));
        let scale = last.1 / (last.0 * last.0.ln());
        series("n log n", &|step| scale * step.count * step.count.ln())
    };
    let mut all: Vec<_> = TIMES
        .iter()
        .enumerate()
        .map(|(at, name)| series(name, &|step| step.times[at]))
        .collect();
    all.push(guide(&|step| step.times[2]));
    draw("objects-time.png", "objects", "ms", &all);
    let mut all: Vec<_> = BYTES
        .iter()
        .enumerate()
        .map(|(at, name)| series(name, &|step| step.bytes[at]))
        .collect();
    all.push(guide(&|step| step.bytes[0]));
    draw("objects-memory.png", "objects", "bytes", &all);
}

fn print_step(step: &Step, before: Option<&Step>, text: usize) {
    let n_log_n = |count: f64| count * count.ln();
    let most = before.map(|before| {
        (n_log_n(step.count) / n_log_n(before.count)).log10() / (step.count / before.count).log10()
    });
    let growth = |now: f64, then: Option<f64>, certain: f64| {
        let (Some(before), Some(then), Some(most)) = (before, then, most) else {
            return String::new();
        };
        if now < certain || then <= 0.0 {
            return String::new();
        }
        let exponent = (now / then).log10() / (step.count / before.count).log10();
        let mark = if most < exponent { "*" } else { "" };
        format!("{exponent:.2}{mark}")
    };
    let mut line = format!("{:>10} {:>8.1}", step.count, text as f64 / 1e6);
    for (at, &time) in step.times.iter().enumerate() {
        let grown = growth(time, before.map(|before| before.times[at]), CERTAIN);
        let _ = write!(line, " {time:>9.2} {grown:>6}");
    }
    for (at, &bytes) in step.bytes.iter().enumerate() {
        let grown = growth(bytes, before.map(|before| before.bytes[at]), 1e6);
        let _ = write!(line, " {bytes:>10} {grown:>6}");
    }
    let each = 1e6 * step.times[..3].iter().sum::<f64>() / step.count;
    let most = most.map_or_else(String::new, |most| format!("{most:.2}"));
    println!("{line} {each:>9.0} {most:>8}");
}

fn lights() {
    println!("\nlights around a sphereflake of 7,381 mirrors, depth 4");
    println!(
        "{:>10} {:>9} {:>8} {:>8} {:>7} {:>6}",
        "lights", "render ms", "ms/light", "Mrays", "Mray/s", "growth"
    );
    let mut points: Vec<(f64, f64)> = Vec::new();
    for count in [1_usize, 2, 4, 8, 16] {
        let case = Case {
            depth: Some(4),
            ..Case::plain(
                "lights",
                write("lights.ray", &scenes::lit_sphereflake(4, count)),
            )
        };
        let phases = phases::measure(&case);
        let time = milliseconds(phases.render);
        let growth = points.last().map(|&(lights, before)| {
            format!("{:.2}", (time / before).ln() / (count as f64 / lights).ln())
        });
        println!(
            "{count:>10} {time:>9.1} {:>8.1} {:>8.2} {:>7.2} {:>6}",
            time / count as f64,
            phases.rays as f64 / 1e6,
            phases.rays as f64 / 1e3 / time,
            growth.unwrap_or_default()
        );
        points.push((count as f64, time));
    }
    let name = "render";
    draw(
        "lights-time.png",
        "lights",
        "ms",
        &[Series { name, points }],
    );
}

fn times(phases: &Phases) -> [f64; 4] {
    [phases.parse, phases.lower, phases.build, phases.render].map(milliseconds)
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn draw(name: &str, across: &str, up: &str, series: &[Series]) {
    let path = Path::new(SCRATCH).join(name);
    plot::draw(&path, across, up, series);
    println!("plot: {}", path.display());
}

fn write(name: &str, text: &str) -> PathBuf {
    let path = Path::new(SCRATCH).join(name);
    std::fs::write(&path, text).expect("the scratch folder is writable");
    path
}
