//! Compares two pictures, each from a picture file or traced from a scene; or, in the folder of this file,
//! many with one.

mod class;
mod compared;
mod matching;
mod report;
mod row;
mod side;
mod table;
mod thumbnail;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::output::Output;
use super::{Error, Messages, Reading, Tracing, stdout};
use compare::{Comparison, Difference, SizesDiffer, heat_map};
use image_file::{ImageFormat, Picture};
use render::{Frame, Frames};
use scene::{Image, Size};
use side::{Model, is_picture, read, trace};
use text::visible;

pub use report::ReportFormat;

/// Pictures to compare with one, or with those of a folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Compare {
    /// The picture or scene to compare with, or a folder of such.
    pub reference: PathBuf,
    /// The pictures and scenes to compare, or folders of such; never empty.
    pub submissions: Vec<PathBuf>,
    /// The largest difference of a channel, in levels, that does not count.
    pub tolerance: u8,
    /// The number of pixels that may differ by more.
    pub max_differing: usize,
    /// How the figures are printed.
    pub report: Report,
    /// Where the differences are drawn, of two files.
    pub output: Option<(PathBuf, ImageFormat)>,
    /// The documents that are written about all of them.
    pub reports: Vec<(PathBuf, ReportFormat)>,
    /// How scenes are traced.
    pub tracing: Tracing,
    /// How scenes are read.
    pub reading: Reading,
}

impl Compare {
    /// The files that are written.
    fn outputs(&self) -> impl Iterator<Item = &Path> {
        let drawn = self.output.iter().map(|(path, _)| path.as_path());
        drawn.chain(self.reports.iter().map(|(path, _)| path.as_path()))
    }

    /// The two files, if there are no more and no document is to be written.
    fn sides(&self) -> Option<[&Path; 2]> {
        let [submission] = &self.submissions[..] else {
            return None;
        };
        let is_of_files =
            self.reports.is_empty() && !self.reference.is_dir() && !submission.is_dir();
        is_of_files.then_some([&self.reference, submission])
    }
}

/// How figures are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    /// As a table for people.
    Text,
    /// As a JSON object.
    Json,
}

/// Whether two pictures are alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As many pixels as permitted differ, or fewer.
    Alike,
    /// More pixels differ, or the sizes.
    Different,
}

/// Compares pictures and prints the figures to standard output: of two files all of them, of more a row for
/// each. Of more, those that cannot be compared are rows as well, and the first such error is returned at the
/// end.
pub fn compare(work: &Compare) -> Result<Verdict, Error> {
    match work.sides() {
        Some(sides) => compare_two(work, sides).inspect_err(|error| Messages::Text.error(error)),
        None => class::compare(work),
    }
}

fn compare_two(work: &Compare, sides: [&Path; 2]) -> Result<Verdict, Error> {
    work.reading.begin()?;
    check(work, sides)?;
    let [a, b] = images(work, sides)?;
    let found = Comparison::of(&a, &b, work.tolerance);
    let verdict = Verdict::of(&found, work.max_differing);
    let report = match work.report {
        Report::Text => table(work, sides, &found, verdict),
        Report::Json => format!("{:#}\n", object(work, sides, &found, verdict)),
    };
    stdout::print(&report).map_err(stdout::error)?;
    match (&work.output, &found) {
        (Some((path, format)), Ok(found)) => {
            draw(path, *format, found.size, heat_map(a.pixels(), b.pixels()))?;
            if found.largest == 0 {
                Messages::Text.note(&format!("no differences: {} is black", path.display()));
            }
        }
        (Some((path, _)), Err(_)) => Messages::Text.note(&format!(
            "{} is not written: pictures of different sizes have no differences to draw",
            path.display()
        )),
        (None, _) => {}
    }
    Ok(verdict)
}

impl Verdict {
    fn of(found: &Result<Comparison, SizesDiffer>, max_differing: usize) -> Self {
        match found {
            Ok(found) if found.differing <= max_differing => Self::Alike,
            _ => Self::Different,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Alike => "alike",
            Self::Different => "different",
        }
    }
}

/// Checks before any work that the picture of the differences can be written.
fn check(work: &Compare, sides: [&Path; 2]) -> Result<(), Error> {
    let Some((path, format)) = &work.output else {
        return Ok(());
    };
    let output = Output::File(path.clone());
    output.check_is_not(&sides, "it is one of those compared")?;
    if format.frames() != Frames::Last {
        return Err(Error::Refused(format!(
            "a picture of differences has 8 bits per channel: name a .png, not .{}",
            format.name()
        )));
    }
    output.check()
}

/// The pictures of both sides. A scene is traced as the picture on the other side was.
fn images(work: &Compare, [a, b]: [&Path; 2]) -> Result<[Image; 2], Error> {
    let [first, second] = [a, b].map(|path| is_picture(path).then(|| read(path)).transpose());
    let traced = |path, model| trace(work, path, model)?.image();
    Ok(match (first?, second?) {
        (Some(first), Some(second)) => [first.image, second.image],
        (Some(picture), None) => {
            let traced = traced(b, Some(Model::of(a, &picture)))?;
            [picture.image, traced]
        }
        (None, Some(picture)) => [traced(a, Some(Model::of(b, &picture)))?, picture.image],
        (None, None) => [traced(a, None)?, traced(b, None)?],
    })
}

/// The figures as a table.
fn table(
    work: &Compare,
    sides: [&Path; 2],
    found: &Result<Comparison, SizesDiffer>,
    verdict: Verdict,
) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<18}{value}");
    };
    match found {
        Err(SizesDiffer(sizes)) => {
            let [a, b] = sizes.map(|size| format!("{}x{}", size.width, size.height));
            line("size", format!("{a} and {b}"));
        }
        Ok(found) => {
            let beyond = match work.tolerance {
                0 => String::new(),
                tolerance => format!(" by more than {tolerance} of 255"),
            };
            line(
                "size",
                format!("{}x{}", found.size.width, found.size.height),
            );
            line("differing pixels", found.differing_words() + &beyond);
            for (name, figure) in found.figures() {
                line(name, figure);
            }
            for (at, worst) in found.worst.iter().enumerate() {
                let Difference { x, y, colours } = worst;
                let [a, b] = colours.map(|[r, g, b]| format!("{r:3} {g:3} {b:3}"));
                let name = if at == 0 { "worst pixels" } else { "" };
                line(name, format!("{:<12}{a}   {b}", format!("{x},{y}")));
            }
        }
    }
    let [a, b] = sides.map(|side| visible(&side.to_string_lossy()).into_owned());
    let _ = writeln!(text, "{a} and {b} are {}", verdict.word());
    text
}

/// The figures as JSON. The keys are part of the interface of the command.
fn object(
    work: &Compare,
    sides: [&Path; 2],
    found: &Result<Comparison, SizesDiffer>,
    verdict: Verdict,
) -> Value {
    let sides = sides.map(Path::to_string_lossy);
    let size = |size: Size| json!([size.width, size.height]);
    let mut object = match found {
        Err(SizesDiffer(sizes)) => json!({ "sizes": sizes.map(size) }),
        Ok(found) => {
            let worst = found.worst.iter().map(|worst| {
                let Difference { x, y, colours } = worst;
                json!({ "x": x, "y": y, "a": colours[0], "b": colours[1] })
            });
            json!({
                "size": size(found.size),
                "tolerance": work.tolerance,
                "max_differing": work.max_differing,
                "differing": found.differing,
                "largest": found.largest,
                "mse": found.mse,
                // Infinity is no number of JSON.
                "psnr": found.psnr().is_finite().then(|| found.psnr()),
                "ssim": found.ssim,
                "flip": found.flip,
                "worst": worst.collect::<Value>(),
            })
        }
    };
    object["a"] = json!(sides[0]);
    object["b"] = json!(sides[1]);
    object["alike"] = json!(verdict == Verdict::Alike);
    object
}

fn draw(path: &Path, format: ImageFormat, size: Size, pixels: Vec<[u8; 3]>) -> Result<(), Error> {
    let frame = Frame::drawn(size, pixels);
    Output::File(path.to_owned()).write(&mut |out| format.write(Picture::of(&frame), out))
}
