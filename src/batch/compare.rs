//! Compares two pictures, each from a picture file or traced from a scene.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::as_recorded::AsRecorded;
use super::output::Output;
use super::tracing::Tracer;
use super::{Error, Messages, Reading, Tracing, stdout};
use compare::{Comparison, Difference, SizesDiffer, heat_map};
use image_file::{ImageFormat, Picture, Recorded, in_8_bits};
use language::Language;
use render::{Frame, Frames};
use scene::{Image, Size};
use text::visible;

/// Two pictures to compare.
#[derive(Clone, Debug, PartialEq)]
pub struct Compare {
    /// The files of the pictures or scenes.
    pub sides: [PathBuf; 2],
    /// The largest difference of a channel, in levels, that does not count.
    pub tolerance: u8,
    /// The number of pixels that may differ by more.
    pub max_differing: usize,
    /// How the figures are printed.
    pub report: Report,
    /// Where the differences are drawn.
    pub output: Option<(PathBuf, ImageFormat)>,
    /// How scenes are traced.
    pub tracing: Tracing,
    /// How scenes are read.
    pub reading: Reading,
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

/// Compares two pictures and prints the figures to standard output.
pub fn compare(work: &Compare) -> Result<Verdict, Error> {
    try_compare(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_compare(work: &Compare) -> Result<Verdict, Error> {
    work.reading.begin()?;
    check(work)?;
    let [a, b] = images(work)?;
    let found = Comparison::of(&a, &b, work.tolerance);
    let verdict = match &found {
        Ok(found) if found.differing <= work.max_differing => Verdict::Alike,
        _ => Verdict::Different,
    };
    let report = match work.report {
        Report::Text => table(work, &found, verdict),
        Report::Json => format!("{:#}\n", object(work, &found, verdict)),
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

/// Checks before any work that the picture of the differences can be written.
fn check(work: &Compare) -> Result<(), Error> {
    let Some((path, format)) = &work.output else {
        return Ok(());
    };
    let output = Output::File(path.clone());
    output.check_is_not(&work.sides, "it is one of those compared")?;
    if format.frames() != Frames::Last {
        return Err(Error::Refused(format!(
            "a picture of differences has 8 bits per channel: name a .png, not .{}",
            format.name()
        )));
    }
    output.check()
}

/// The pictures of both sides. A scene is traced as the picture on the other side was.
fn images(work: &Compare) -> Result<[Image; 2], Error> {
    let [a, b] = &work.sides;
    let [first, second] = [a, b].map(|path| is_picture(path).then(|| read(path)).transpose());
    Ok(match (first?, second?) {
        (Some(first), Some(second)) => [first.image, second.image],
        (Some(picture), None) => {
            let traced = trace(work, b, Some((a.as_path(), &picture)))?;
            [picture.image, traced]
        }
        (None, Some(picture)) => [
            trace(work, a, Some((b.as_path(), &picture)))?,
            picture.image,
        ],
        (None, None) => [trace(work, a, None)?, trace(work, b, None)?],
    })
}

fn is_picture(path: &Path) -> bool {
    Language::of_path(path).is_err() && !assets::is_mesh(path)
}

fn read(path: &Path) -> Result<Recorded, Error> {
    let mut file = file::open(path)?;
    Recorded::read(&mut file).map_err(|source| Error::Picture {
        path: path.to_owned(),
        source,
    })
}

/// Traces a scene, to be compared with a picture if there is one.
fn trace(work: &Compare, path: &Path, picture: Option<(&Path, &Recorded)>) -> Result<Image, Error> {
    let holds_light = picture.is_some_and(|(_, picture)| picture.holds_light);
    let mut as_recorded =
        picture.map(|(of, read)| AsRecorded::new([path, of], read, &work.tracing));
    let over = match &as_recorded {
        Some(as_recorded) => as_recorded.over(),
        None => work.tracing.over(),
    };
    let mut loaded = work.reading.load(Messages::Text, path, Some(&over))?;
    let scene = loaded.take_scene()?;
    if let Some((output, _)) = &work.output {
        let reason = format!("{} uses it", path.display());
        Output::File(output.clone()).check_is_not(&loaded.read.files, &reason)?;
    }
    let own = scene.camera.size;
    let tracing = match &mut as_recorded {
        Some(as_recorded) => as_recorded.tracing(&scene),
        None => work.tracing.clone(),
    };
    let frames = if holds_light {
        Frames::LastWithValues
    } else {
        Frames::Last
    };
    let job = tracing.job(scene, loaded.read.images, frames)?;
    if let Some(as_recorded) = &as_recorded {
        as_recorded.tell(&job, own);
    }
    let frame = Tracer::new(tracing.execution).trace(job, None, || {})?;
    let pixels = if holds_light {
        in_8_bits(&frame)
    } else {
        Some(frame.pixels.clone())
    };
    pixels
        .and_then(|pixels| Image::new(frame.size, pixels))
        .ok_or(Error::Stopped)
}

/// The figures as a table.
fn table(work: &Compare, found: &Result<Comparison, SizesDiffer>, verdict: Verdict) -> String {
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
    let [a, b] = [0, 1].map(|side| visible(&work.sides[side].to_string_lossy()).into_owned());
    let verdict = match verdict {
        Verdict::Alike => "alike",
        Verdict::Different => "different",
    };
    let _ = writeln!(text, "{a} and {b} are {verdict}");
    text
}

/// The figures as JSON. The keys are part of the interface of the command.
fn object(work: &Compare, found: &Result<Comparison, SizesDiffer>, verdict: Verdict) -> Value {
    let sides = [0, 1].map(|side| work.sides[side].to_string_lossy());
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
