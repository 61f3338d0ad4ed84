//! Arguments and ranges that several commands have in common.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use batch::{Output, Reading, Target, Up, Warnings};
use config::MAX_THREADS;
use image_file::{FORMATS, ImageFormat, known_extensions};
use scene::MAX_SPP;

#[derive(Args, Debug)]
pub(super) struct AssetArguments {
    /// Also read pictures and meshes from this folder; repeatable. Always allowed are the scene's folder
    /// and the one above it, unless that is /, your home or writable by everyone
    #[arg(long = "assets", value_name = "DIR")]
    pub(super) folders: Vec<PathBuf>,
}

/// The arguments that say how scenes are read.
#[derive(Args, Debug)]
pub(super) struct ReadingArguments {
    /// Treat warnings in the scene as errors; notes are unaffected
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    up: UpArgument,
    #[command(flatten)]
    assets: AssetArguments,
}

#[derive(Args, Debug)]
pub(super) struct UpArgument {
    /// Axis of a mesh, opened like a scene, that points up [default: z for .stl, otherwise y]
    #[arg(long, value_name = "AXIS", value_enum)]
    up: Option<UpChoice>,
}

impl UpArgument {
    pub(super) fn up(self) -> Option<Up> {
        self.up.map(|up| match up {
            UpChoice::Y => Up::Y,
            UpChoice::Z => Up::Z,
        })
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum UpChoice {
    Y,
    Z,
}

impl ReadingArguments {
    pub(super) fn into_reading(self) -> Reading {
        Reading {
            warnings: if self.strict {
                Warnings::Refused
            } else {
                Warnings::Allowed
            },
            assets: self.assets.folders,
            up: self.up.up(),
        }
    }
}

pub(super) fn spp_range() -> impl TypedValueParser<Value = u32> {
    whole_number(1, MAX_SPP)
}

pub(super) fn threads_range() -> impl TypedValueParser<Value = u16> {
    whole_number(1, MAX_THREADS)
}

/// Parses whole numbers in a range.
pub(super) fn whole_number<N>(least: N, most: N) -> impl TypedValueParser<Value = N>
where
    N: FromStr + PartialOrd + Display + Copy + Send + Sync + 'static,
{
    move |text: &str| {
        let number = text.parse().ok();
        let number = number.filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| format!("expected a whole number from {least} to {most}"))
    }
}

/// The format of a picture file by its extension.
pub(super) fn picture_format(path: &Path) -> Result<ImageFormat, String> {
    ImageFormat::of_path(path).ok_or_else(|| {
        format!(
            "cannot tell the format of {}: use the extension {}",
            path.display(),
            known_extensions()
        )
    })
}

/// The help of `-o` for pictures.
pub(super) fn output_help() -> String {
    let known = known_extensions();
    format!("Picture file, in the format of its extension: {known}; - for standard output")
}

/// Where a picture goes, and in which format: by default that of the file's extension.
pub(super) fn target(
    path: PathBuf,
    format: Option<ImageFormat>,
    force: bool,
) -> Result<Target, String> {
    let to_stdout = path == Path::new("-");
    let format = match format {
        Some(format) => format,
        None if to_stdout => ImageFormat::Bmp,
        None => picture_format(&path).map_err(|reason| format!("{reason}, or --format"))?,
    };
    Ok(Target {
        output: destination(path, force),
        format,
    })
}

/// Where a file goes; `-` is standard output.
pub(super) fn destination(path: PathBuf, force: bool) -> Output {
    match (path.as_os_str() == "-", force) {
        (false, _) => Output::File(path),
        (true, false) => Output::Stdout,
        (true, true) => Output::StdoutTerminal,
    }
}

/// The names of the picture formats, as values of an option.
pub(super) fn picture_names() -> impl Iterator<Item = PossibleValue> {
    FORMATS.into_iter().map(|(format, extensions)| {
        PossibleValue::new(format.name()).aliases(extensions.iter().copied())
    })
}

/// Reads the name of a picture format.
pub(super) fn format_names() -> impl TypedValueParser<Value = ImageFormat> {
    let names = PossibleValuesParser::new(picture_names());
    names.try_map(|name| format_named(&name).ok_or("unknown format"))
}

/// The picture format with a name or extension.
pub(super) fn format_named(name: &str) -> Option<ImageFormat> {
    let mut formats = FORMATS.into_iter();
    let known = formats.find(|(_, extensions)| extensions.contains(&name));
    known.map(|(format, _)| format)
}
