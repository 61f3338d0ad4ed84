//! The arguments of `render`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use super::choices::{AovChoice, ProgressChoice};
use super::shared::{
    ReadingArguments, destination, format_named, output_help, picture_format, picture_names,
    target, whole_number,
};
use super::tracing::TracingArguments;
use batch::{
    Existing, Finished, FrameSource, MAX_FRAMES, Output, Parts, PictureWork, Purpose, Render,
    SequenceOutput, SequenceWork, Work,
};
use image_file::{ImageFormat, MovieFormat, NoPattern, Pattern};
use render::Aov;
use shards::{MOST_SHARDS, Shard};

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight render scene.ray -o scene.bmp
  halflight render scene.ray -o scene.png --size 1920x1080 --spp 64
  halflight render scene.ray -o - --format ppm | display

GIF is reduced to 256 colours and JPEG has quality 95. EXR and HDR keep unclamped values; the \
other formats keep every pixel with 8 bits per channel.

SCENE may be a folder of scenes, the frames of a sequence, numbered from 0; %05d in FILE is replaced \
by the frame number. Frames that are already finished are skipped, by whichever shard. Y4M and GIF hold \
a whole sequence:
  halflight render scene.ray --turntable 36 -o turn.gif
  halflight render scene.ray --turntable 250 -o - --format y4m | ffmpeg -i - turn.mp4
  halflight render scene.ray --track scene.toml -o frame.%05d.png
  halflight render shots/ -o shot.%05d.png --frames 0-99

The same scene and options give the same bytes on every machine and with any number of threads.";

#[derive(Args, Debug)]
pub(super) struct RenderArguments {
    /// Scene file: .ray, .dat, .xml or .test; or a mesh: .obj, .ply or .stl; or a folder of scenes, the frames of a
    /// sequence
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    #[arg(short, long, value_name = "FILE", help = output_or_frames_help())]
    output: PathBuf,
    /// Picture format, regardless of the file's extension [default for -o -: bmp]
    #[arg(long, value_name = "FORMAT", value_parser = picture_or_movie())]
    format: Option<Format>,
    #[command(flatten)]
    tracing: TracingArguments,
    #[command(flatten)]
    reading: ReadingArguments,
    #[command(flatten)]
    content: ContentArguments,
    /// Trace only shard K of N, numbered from 0, into a part file next to FILE; see merge
    #[arg(long, value_name = "K/N", value_parser = parse_shard)]
    shard: Option<Shard>,
    #[command(flatten)]
    sequence: SequenceArguments,
    /// Checkpoint to a part file next to FILE, and continue from one that exists: after SIGTERM,
    /// SIGHUP, SIGUSR1 or a crash, or with a larger --spp; frames in files of their own always continue,
    /// .y4m and .gif never
    #[arg(long, conflicts_with = "again")]
    resume: bool,
    /// Show progress as a line on a terminal (auto), as lines of JSON on standard error, or not
    #[arg(long, value_name = "STYLE", value_enum, default_value_t)]
    progress: ProgressChoice,
    /// Write statistics about the render to this file as JSON: times, rays, memory, noise; - for
    /// standard output
    #[arg(long, value_name = "FILE")]
    stats: Option<PathBuf>,
    /// Print an estimate of the memory needed, such as 340M, instead of rendering
    #[arg(long)]
    estimate: bool,
    /// Write to standard output even if it is a terminal
    #[arg(long)]
    force: bool,
}

/// What a picture holds besides its light as traced, or instead of it.
#[derive(Args, Debug)]
struct ContentArguments {
    /// Also render these AOVs, separated by commas, as layers of an EXR, such as
    /// depth,normal,object,albedo,samples; not with --shard (use --aov for one at a time)
    #[arg(
        long,
        value_name = "AOVS",
        value_enum,
        value_delimiter = ',',
        conflicts_with = "aov"
    )]
    layers: Vec<AovChoice>,
    /// Reduce the noise of light, guided by surfaces and by the noise of each pixel: a picture of few
    /// samples looks like one of many, but is no longer unbiased; cannot be combined with --shard or
    /// --resume
    #[arg(long)]
    denoise: bool,
}

/// What the frames of a sequence are.
#[derive(Args, Debug)]
struct SequenceArguments {
    /// Render N frames of a full turn around the view's target
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(1, MAX_FRAMES))]
    turntable: Option<u32>,
    /// Render the frames of a track file, which changes fields of the scene and moves the camera; see
    /// scenes/README.md
    #[arg(long, value_name = "FILE", conflicts_with = "turntable")]
    track: Option<PathBuf>,
    /// Render only these frames of a sequence, numbered from 0 [default: all]
    #[arg(long, value_name = "A-B", value_parser = parse_frames)]
    frames: Option<[u32; 2]>,
    /// Frames per second of Y4M, 1 to 100, and GIF, 1 to 50 [default: the track's, or 24]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(1, 100_u32))]
    fps: Option<u32>,
    /// Render frames again that are already finished, one file each
    #[arg(long)]
    again: bool,
}

impl RenderArguments {
    pub(super) fn into_render(self) -> Result<Render, String> {
        let is_moved = self.sequence.turntable.is_some() || self.sequence.track.is_some();
        let work = if is_moved || self.scene.is_dir() {
            Work::Sequence(self.sequence_work()?)
        } else {
            Work::Picture(self.picture_work()?)
        };
        let layers = checked(self.content.layers, &work)?;
        let mut tracing = self.tracing.with(layers, self.content.denoise)?;
        tracing.execution.progress = self.progress.value();
        Ok(Render {
            work,
            tracing,
            reading: self.reading.into_reading(),
        })
    }

    fn picture_work(&self) -> Result<PictureWork, String> {
        if let Some(what) = self.of_sequence() {
            return Err(format!(
                "{what} needs --turntable, --track, or a folder of scenes"
            ));
        }
        let format = match self.format {
            Some(Format::Picture(format)) => Some(format),
            Some(Format::Movie(_)) | None => None,
        };
        let target = target(self.output.clone(), format, self.force)?;
        let to_stdout = |path: &PathBuf| path.as_os_str() == "-";
        if self.stats.as_ref().is_some_and(to_stdout) && !matches!(target.output, Output::File(_)) {
            return Err("-o - and --stats - cannot both use standard output".to_owned());
        }
        if self.shard.is_some() && self.tracing.is_limited() {
            return Err(
                "--time would give shards different numbers of samples: use --spp".to_owned(),
            );
        }
        if self.content.denoise && (self.shard.is_some() || self.resume) {
            let option = self.shard.map_or("--resume", |_| "--shard");
            return Err(format!(
                "--denoise needs the noise of the whole picture, which parts do not record: leave out \
                 {option}"
            ));
        }
        if self.shard.is_some() && !self.content.layers.is_empty() {
            return Err("--layers cannot be sharded: shard each with --aov".to_owned());
        }
        let stats = self.stats.clone();
        Ok(PictureWork {
            scene: self.scene.clone(),
            target,
            purpose: if self.estimate {
                Purpose::Estimate
            } else {
                Purpose::Render
            },
            stats: stats.map(|path| destination(path, true)),
            parts: (self.resume || self.shard.is_some()).then_some(Parts {
                shard: self.shard.unwrap_or(Shard::WHOLE),
                existing: if self.resume {
                    Existing::Continued
                } else {
                    Existing::Refused
                },
            }),
        })
    }

    /// What only a sequence has, if there is any.
    fn of_sequence(&self) -> Option<String> {
        let SequenceArguments {
            frames, fps, again, ..
        } = &self.sequence;
        let options = [
            (frames.is_some(), "--frames"),
            (fps.is_some(), "--fps"),
            (*again, "--again"),
            (self.movie() == Some(MovieFormat::Y4m), "y4m"),
        ];
        let option = options.iter().find(|(is_given, _)| *is_given);
        // Whatever is not there is no folder either.
        let is_pattern = || Pattern::of(&self.output).is_ok() && self.scene.exists();
        match option {
            Some((_, name)) => Some((*name).to_owned()),
            None => is_pattern().then(|| self.output.display().to_string()),
        }
    }

    /// The format of one file for all frames of a sequence.
    fn movie(&self) -> Option<MovieFormat> {
        match (Pattern::of(&self.output), self.format) {
            (_, Some(Format::Movie(format))) => Some(format),
            (Err(_), Some(Format::Picture(ImageFormat::Gif))) => Some(MovieFormat::Gif),
            (Err(_), None) => MovieFormat::of_path(&self.output),
            _ => None,
        }
    }

    fn sequence_work(&self) -> Result<SequenceWork, String> {
        if self.stats.is_some() || self.estimate {
            return Err("--stats and --estimate are for single pictures".to_owned());
        }
        let SequenceArguments {
            turntable, track, ..
        } = &self.sequence;
        if (turntable.is_some() || track.is_some()) && self.scene.is_dir() {
            let option = turntable.map_or("--track", |_| "--turntable");
            return Err(format!(
                "{option} needs one scene, but {} is a folder",
                self.scene.display()
            ));
        }
        Ok(SequenceWork {
            output: match self.movie() {
                Some(format) => self.movie_output(format)?,
                None => self.numbered_output()?,
            },
            shows: self.frame_source(),
            frames: self.sequence.frames,
        })
    }

    fn movie_output(&self, format: MovieFormat) -> Result<SequenceOutput, String> {
        if self.shard.is_some() {
            return Err(
                "a .y4m or .gif cannot be sharded: write one file per frame, such as out.%05d.png"
                    .to_owned(),
            );
        }
        if self.resume || self.sequence.again {
            let option = if self.resume { "--resume" } else { "--again" };
            return Err(format!(
                "{option} has no finished frames to go by: a .y4m or .gif is rendered from the \
                 beginning; write one file per frame, such as out.%05d.png"
            ));
        }
        Ok(SequenceOutput::Movie {
            to: destination(self.output.clone(), self.force),
            format,
            rate: self.sequence.fps,
        })
    }

    fn numbered_output(&self) -> Result<SequenceOutput, String> {
        let pattern = Pattern::of(&self.output).map_err(|reason| self.no_pattern(reason))?;
        if self.sequence.fps.is_some() {
            return Err("--fps is for .y4m and .gif: pictures have no rate".to_owned());
        }
        Ok(SequenceOutput::Pictures {
            format: match self.format {
                Some(Format::Picture(format)) => format,
                _ => picture_format(&self.output)?,
            },
            pattern,
            shard: self.shard.unwrap_or(Shard::WHOLE),
            finished: if self.sequence.again {
                Finished::Rendered
            } else {
                Finished::Skipped
            },
        })
    }

    /// Says why the output cannot take the frames of a sequence.
    fn no_pattern(&self, reason: NoPattern) -> String {
        let (scene, output) = (self.scene.display(), self.output.display());
        if self.output.as_os_str() == "-" {
            "-o - takes a sequence with --format y4m or gif".to_owned()
        } else if self.scene.is_dir() {
            format!("{scene} is a folder, which makes a sequence, but {output} {reason}")
        } else {
            format!("{output} {reason}")
        }
    }

    fn frame_source(&self) -> FrameSource {
        let scene = self.scene.clone();
        match (self.sequence.turntable, &self.sequence.track) {
            (Some(count), _) => FrameSource::Turntable { scene, count },
            (None, Some(track)) => FrameSource::Track {
                scene,
                track: track.clone(),
            },
            (None, None) => FrameSource::Folder(scene),
        }
    }
}

/// The AOVs of layers; refuses a layer twice, and layers in a format that has none.
fn checked(layers: Vec<AovChoice>, work: &Work) -> Result<Vec<Aov>, String> {
    let format = match work {
        Work::Picture(picture) => Some(picture.target.format),
        Work::Sequence(sequence) => match &sequence.output {
            SequenceOutput::Pictures { format, .. } => Some(*format),
            SequenceOutput::Movie { .. } => None,
        },
    };
    if !layers.is_empty() && format != Some(ImageFormat::Exr) {
        return Err("--layers needs a .exr: other formats have none".to_owned());
    }
    let mut aovs = Vec::new();
    for aov in layers.into_iter().map(AovChoice::value) {
        if aovs.contains(&aov) {
            return Err(format!("--layers names {} twice", aov.name()));
        }
        aovs.push(aov);
    }
    Ok(aovs)
}

/// The help of `-o` for pictures and sequences.
fn output_or_frames_help() -> String {
    format!(
        "{}. Of a sequence, %05d stands for the number of each frame, or .y4m or .gif holds all",
        output_help()
    )
}

/// A format of one picture, or of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Picture(ImageFormat),
    Movie(MovieFormat),
}

fn picture_or_movie() -> impl TypedValueParser<Value = Format> {
    let names = picture_names().chain([PossibleValue::new("y4m")]);
    PossibleValuesParser::new(names).try_map(|name| {
        let picture = format_named(&name).map(Format::Picture);
        let movie = (name == "y4m").then_some(Format::Movie(MovieFormat::Y4m));
        picture.or(movie).ok_or("unknown format")
    })
}

fn parse_frames(text: &str) -> Result<[u32; 2], String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let numbers = first.parse().ok().zip(last.parse().ok());
    numbers
        .filter(|(first, last)| first <= last)
        .map(|(first, last)| [first, last])
        .ok_or_else(|| "expected a frame or a range of frames, such as 0-99".to_owned())
}

fn parse_shard(text: &str) -> Result<Shard, String> {
    Shard::parse(text).ok_or_else(|| {
        format!("expected K/N with K from 0 to N - 1 and N up to {MOST_SHARDS}, such as 3/8")
    })
}
