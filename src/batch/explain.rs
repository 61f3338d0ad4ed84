//! Explains a pixel of a scene: the verdict and the tree of rays behind it.

mod json;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::finding::{Naming, Suspect, Text, place_after};
use super::tracing::Tracer;
use super::{Error, Messages, Reading, Report, Tracing, stdout};
use explain::{Line, Sentence, Subject, Words, number, words};
use render::{Explanation, Frames, PreparedScene};
use scene::Size;
use text::visible;

/// A pixel to explain.
#[derive(Clone, Debug, PartialEq)]
pub struct Explain {
    /// The scene file.
    pub scene: PathBuf,
    /// The pixel of the whole picture, from the left and from the top.
    pub pixel: [u32; 2],
    /// The index of the sample.
    pub sample: u32,
    /// How the explanation is printed.
    pub report: Report,
    /// How the picture is traced.
    pub tracing: Tracing,
    /// How the scene is read.
    pub reading: Reading,
}

/// Explains a pixel and prints the verdict and the tree of rays to standard output.
pub fn explain(work: &Explain) -> Result<(), Error> {
    try_explain(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_explain(work: &Explain) -> Result<(), Error> {
    work.reading.begin()?;
    let over = work.tracing.over();
    let mut loaded = work
        .reading
        .load(Messages::Text, &work.scene, Some(&over))?;
    let scene = loaded.take_scene()?;
    let job = work.tracing.job(scene, loaded.read.images, Frames::Last)?;
    let size = job.settings.size;
    check_pixel(work.pixel, size)?;
    let prepared = PreparedScene::new(&job, &|| false).ok_or(Error::Stopped)?;
    let explained = prepared.query().explain(work.pixel, work.sample, &|| false);
    let explanation = explained.ok_or(Error::Stopped)?;
    let subject = Subject {
        source: &loaded.source,
        scene: &job.scene,
        camera: &job.camera,
        size,
    };
    let words = words(&explanation, &subject);
    let report = match work.report {
        Report::Text => text(&loaded.path, &explanation, &words),
        Report::Json => {
            let object = json::object(&loaded.path, &explanation, &words, &subject);
            format!("{object:#}\n")
        }
    };
    stdout::print(&report).map_err(stdout::error)?;
    let text = Text {
        messages: Messages::Text,
        path: &loaded.path,
        naming: Naming::Implied,
        source: Some(&loaded.source),
        prospects: &loaded.prospects,
    };
    // Elsewhere the pixel is as it is for a reason of its own.
    let is_of_picture = words.verdicts[0].may_be_of_picture();
    let suspect = is_of_picture.then(|| Suspect::of_scene(job, &loaded.prospects));
    if let Some(suspect) = suspect.flatten() {
        suspect.print(&text, || Tracer::new(work.tracing.execution));
    }
    Ok(())
}

/// Refuses a pixel outside the picture.
fn check_pixel([x, y]: [u32; 2], Size { width, height }: Size) -> Result<(), Error> {
    if x < width && y < height {
        return Ok(());
    }
    Err(Error::Refused(format!(
        "pixel {x},{y} is outside the picture of {width}x{height}: X is 0 to {}, Y is 0 to {}",
        width - 1,
        height - 1
    )))
}

/// The explanation for people.
fn text(scene: &Path, explanation: &Explanation, words: &Words) -> String {
    let name = scene.to_string_lossy();
    let Explanation {
        pixel: [x, y],
        sample,
        radiance,
        displayed: [red, green, blue],
        ..
    } = explanation;
    let linear = radiance.to_array().map(number).join(" ");
    let mut text =
        format!("pixel {x},{y} of {name}, sample {sample}: {linear}, 8-bit {red} {green} {blue}\n");
    for (number, sentence) in words.verdicts.iter().enumerate() {
        let kind = if number == 0 { "verdict" } else { "also" };
        add_sentence(&mut text, &name, kind, sentence);
    }
    text.push('\n');
    for line in &words.lines {
        add_line(&mut text, &name, line);
    }
    let lines = text.lines().map(visible);
    lines.fold(String::new(), |text, line| text + &line + "\n")
}

fn add_sentence(text: &mut String, name: &str, kind: &str, sentence: &Sentence) {
    let place = place_after(name, sentence.place);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{kind}: {}{place}", sentence.text);
    if let Some(help) = &sentence.help {
        let _ = writeln!(text, "  help: {help}");
    }
}

fn add_line(text: &mut String, name: &str, line: &Line) {
    /// Deeper lines are indented no further, so that long paths stay readable.
    const DEEPEST: usize = 20;
    let indent = "  ".repeat(line.depth.min(DEEPEST));
    let adds = line.adds.map_or(String::new(), |adds| {
        let [red, green, blue] = adds.to_array().map(number);
        format!(": adds {red} {green} {blue}")
    });
    let place = place_after(name, line.place);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{indent}{}{adds}{place}", line.text);
}
