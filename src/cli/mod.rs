//! Arguments and exit codes; no work.

mod choices;

use std::ffi::OsString;
use std::fmt::Write;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand, value_parser};

use choices::{AovChoice, ColourChoice, FilterChoice, IntegratorChoice, TransferChoice};

use crate::batch::{self, Check, Output, Render, Warnings};
use crate::file::ReadError;
use crate::image_file::{FORMATS, ImageFormat, known_extensions};
use crate::render::{DEFAULT_SPP, MAX_SPP};
use crate::scene::Size;
use crate::text::{slips, visible};
use crate::ui;
use crate::ui::terminal::Mouse;

/// Done.
pub const DONE: u8 = 0;
/// Writing or the machine failed on the way.
pub const FAILED: u8 = 1;
/// The arguments make no sense.
pub const USAGE: u8 = 2;
/// A scene is wrong.
pub const INVALID: u8 = 65;
/// A scene is missing or can't be read.
pub const NO_INPUT: u8 = 66;
/// The picture's file can't be created.
pub const NO_OUTPUT: u8 = 73;

/// The interface's terminal is gone: what shells report for `SIGHUP`.
pub const HUNG_UP: u8 = 129;
/// The interface was interrupted from outside: what shells report for `SIGINT`.
pub const INTERRUPTED: u8 = 130;
/// Another signal asked the interface to end: with the signal's number added, what shells report for it.
pub const SIGNALLED: u8 = 128;

/// What the user wants done.
#[derive(Clone, Debug)]
pub enum Command {
    /// Open the interface.
    Interface(ui::Options),
    /// Make a picture.
    Render(Render),
    /// Say what was detected of the terminal and the machine, for this scene.
    Doctor(Option<PathBuf>),
    /// Say what is wrong with scenes.
    Check(Check),
}

/// A text to print instead of doing anything, and the exit code to end with.
#[derive(Debug, PartialEq, Eq)]
pub struct Stop {
    /// The text, safe to print.
    pub text: String,
    /// [`DONE`] if the text was asked for and goes to the output stream, else [`USAGE`].
    pub code: u8,
}

/// Understands the arguments, the program's name first.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Command, Stop> {
    let said = Cli::try_parse_from(arguments).map_err(|error| Stop::of(&error))?;
    match said.command {
        Some(Subcommands::Render(render)) => render
            .meaning()
            .map(Command::Render)
            .map_err(|reason| refusal(Some("render"), reason)),
        Some(Subcommands::Check {
            scenes,
            strictness,
            assets,
        }) => Ok(Command::Check(Check {
            scenes,
            warnings: strictness.meaning(),
            assets: assets.folders,
        })),
        Some(Subcommands::Doctor { scene }) => Ok(Command::Doctor(scene)),
        None => said
            .interface
            .meaning()
            .map(Command::Interface)
            .map_err(|reason| refusal(None, reason)),
    }
}

/// Refuses arguments that clap has taken, with the usage of the command they are for.
fn refusal(command: Option<&str>, reason: String) -> Stop {
    let mut cli = Cli::command();
    // Without this a command's usage lacks the program's name.
    cli.build();
    let of_command = command.and_then(|name| cli.find_subcommand_mut(name).cloned());
    let error = of_command
        .unwrap_or(cli)
        .error(ErrorKind::ValueValidation, reason);
    Stop::of(&error)
}

/// The exit code that headless work ends with.
pub fn exit_code(outcome: &Result<(), batch::Error>) -> u8 {
    use batch::Error;
    let Err(error) = outcome else {
        return DONE;
    };
    match error {
        Error::Read(error) => read_code(error),
        Error::Assets(_) => NO_INPUT,
        Error::UnknownLanguage(_) | Error::Invalid { .. } => INVALID,
        Error::Refused(_) => USAGE,
        Error::Create { .. } => NO_OUTPUT,
        Error::Write { .. } | Error::Untraced(_) | Error::Stopped => FAILED,
    }
}

/// The exit code that the interface ends with.
pub fn interface_exit_code(outcome: &Result<ui::Ending, ui::Error>) -> u8 {
    match outcome {
        Ok(ui::Ending::Quit) => DONE,
        Ok(ui::Ending::HungUp) => HUNG_UP,
        Ok(ui::Ending::Interrupted) => INTERRUPTED,
        Ok(ui::Ending::Terminated { signal }) => SIGNALLED + signal,
        Err(ui::Error::Read(error)) => read_code(error),
        Err(ui::Error::UnknownLanguage(_)) => INVALID,
        Err(ui::Error::Folder { .. } | ui::Error::Assets(_)) => NO_INPUT,
        Err(ui::Error::NoSuch { .. } | ui::Error::NoTerminal | ui::Error::DumbTerminal) => USAGE,
        Err(ui::Error::Terminal(_)) => FAILED,
    }
}

fn read_code(error: &ReadError) -> u8 {
    match error {
        ReadError::NotUtf8 { .. } | ReadError::Binary { .. } => INVALID,
        ReadError::NoMemory { .. } | ReadError::NoThreads(_) => FAILED,
        ReadError::Io { source, .. } if source.kind() == std::io::ErrorKind::OutOfMemory => FAILED,
        ReadError::NotFound { .. }
        | ReadError::NotRegular { .. }
        | ReadError::TooLong { .. }
        | ReadError::Io { .. } => NO_INPUT,
    }
}

impl Stop {
    fn of(error: &clap::Error) -> Self {
        // The text repeats arguments, which may hold anything.
        let mut text = String::new();
        for line in error.to_string().lines() {
            // Writing to a string can't fail.
            let _ = writeln!(text, "{}", visible(line));
        }
        Self {
            text,
            code: if error.use_stderr() { USAGE } else { DONE },
        }
    }
}

/// A progressive ray tracer that lives in the terminal.
#[derive(Debug, Parser)]
#[command(
    version,
    after_help = EXAMPLES,
    args_conflicts_with_subcommands = true
)]
struct Cli {
    #[command(flatten)]
    interface: InterfaceArguments,
    #[command(subcommand)]
    command: Option<Subcommands>,
}

const EXAMPLES: &str = "\
Examples:
  halflight scene.ray                             edit and see a scene
  halflight render scene.ray -o scene.bmp         make a picture
  halflight render scene.ray -o - --format ppm | ssh far 'cat > scene.ppm'
  halflight check scenes/*.ray                    say what is wrong with scenes
  halflight doctor                                say what was detected, and why

A scene named like a command is opened as ./render, ./check or ./doctor. Scenes are read from \
files, not from standard input, pipes or devices.

Exit codes: 0 success, 1 write or system error, 2 wrong arguments, 65 invalid scene, \
66 scene not found or unreadable, 73 picture file cannot be created, 129 terminal gone, \
130 SIGINT, 143 SIGTERM, 128 + N another signal N. Ctrl-C quits the interface with 0, as q does.";

#[derive(Debug, Subcommand)]
enum Subcommands {
    /// Make a picture of a scene
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArguments),
    /// Say what is wrong with scenes, without tracing them
    Check {
        /// Scene files
        #[arg(required = true, value_name = "SCENE")]
        scenes: Vec<PathBuf>,
        #[command(flatten)]
        strictness: StrictnessArguments,
        #[command(flatten)]
        assets: AssetArguments,
    },
    /// Say what was detected of the terminal and the machine, and why
    Doctor {
        /// Scene file whose folder is examined [default: the current folder]
        #[arg(value_name = "SCENE")]
        scene: Option<PathBuf>,
    },
}

#[derive(Args, Debug)]
struct StrictnessArguments {
    /// Treat the scene's warnings as errors; notes and findings about the picture stay as they are
    #[arg(long)]
    strict: bool,
}

impl StrictnessArguments {
    fn meaning(&self) -> Warnings {
        if self.strict {
            Warnings::Refused
        } else {
            Warnings::Allowed
        }
    }
}

#[derive(Args, Debug)]
struct AssetArguments {
    /// Let the scene read pictures and meshes from this folder too; may be given several times.
    /// Without it they are read from the scene's folder and the one above it only
    #[arg(long = "assets", value_name = "DIR")]
    folders: Vec<PathBuf>,
}

#[derive(Args, Debug)]
struct InterfaceArguments {
    /// Scene file to open: .ray, .dat or .xml
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    // Read so that a second scene is refused as such and not as an unknown command.
    #[arg(hide = true)]
    surplus: Vec<PathBuf>,
    /// Compare the file's content every MS milliseconds (10 to 3600000; 500 unless given), for
    /// network file systems, which send no notices of changes
    #[arg(
        long, value_name = "MS", num_args = 0..=1, require_equals = true,
        default_missing_value = "500", value_parser = value_parser!(u64).range(10..=3_600_000)
    )]
    poll: Option<u64>,
    /// Send the terminal at most so many kilobytes (1000 bytes) a second, up to 4000000; 0 means no
    /// limit
    #[arg(long, value_name = "KB/s", value_parser = value_parser!(u32).range(..=4_000_000))]
    bandwidth: Option<u32>,
    /// Colours that the terminal is sent
    #[arg(
        long,
        alias = "colour",
        value_name = "COLOURS",
        value_enum,
        default_value_t
    )]
    color: ColourChoice,
    /// Leave the mouse to the terminal
    #[arg(long)]
    no_mouse: bool,
    /// Samples a pixel, 1 to 65536, of full-size traces and of exports [default: 16]
    #[arg(long, value_name = "N", value_parser = spp_range())]
    spp: Option<u32>,
    /// Bounces of a ray, up to 4096; 0 is none [default: 8, with path tracing 64]
    #[arg(long, value_name = "N", value_parser = depth_range())]
    depth: Option<u32>,
    /// How light is gathered at first; P changes it [default: whitted, unless the scene says path]
    #[arg(long, value_name = "HOW", value_enum)]
    integrator: Option<IntegratorChoice>,
    /// What full-size traces and exports filter pixels by; the preview has the box
    #[arg(long, value_name = "FILTER", value_enum, default_value_t)]
    filter: FilterChoice,
    /// Threads that trace, 1 to 1024 [default: one fewer than the machine's cores]
    #[arg(long, value_name = "N", value_parser = threads_range())]
    threads: Option<u16>,
    #[command(flatten)]
    assets: AssetArguments,
}

impl InterfaceArguments {
    fn meaning(self) -> Result<ui::Options, String> {
        if let Some(meant) = self.scene.as_deref().and_then(command_meant) {
            let said = self.scene.unwrap_or_default();
            return Err(format!(
                "no command is called `{}`: did you mean {meant}?",
                said.display()
            ));
        }
        if let Some(second) = self.surplus.first() {
            return Err(format!(
                "one scene is opened at a time, {} is a second one; the commands are render, \
                 check and doctor",
                second.display()
            ));
        }
        Ok(ui::Options {
            scene: self.scene,
            poll: self.poll.map(Duration::from_millis),
            bandwidth: self.bandwidth.map(|kilobytes| kilobytes * 1000),
            colour: self.color.meaning(),
            mouse: if self.no_mouse { Mouse::Off } else { Mouse::On },
            spp: self.spp,
            depth: self.depth,
            integrator: self.integrator.map(IntegratorChoice::meaning),
            filter: self.filter.meaning(),
            threads: self.threads.map(usize::from),
            assets: self.assets.folders,
        })
    }
}

/// The command that a word for a scene was probably meant to be: scenes have an extension.
fn command_meant(scene: &Path) -> Option<String> {
    let word = scene.to_str().filter(|word| !word.contains(['.', '/']))?;
    let cli = Cli::command();
    let mut names = cli.get_subcommands().map(clap::Command::get_name);
    let meant = names.find(|name| slips(word, name) <= 2)?;
    Some(meant.to_owned())
}

const RENDER_EXAMPLES: &str = "\
Examples:
  halflight render scene.ray -o scene.bmp
  halflight render scene.ray -o scene.png --size 1920x1080 --spp 64
  halflight render scene.ray -o - --format ppm | display

GIF keeps 256 colours, JPEG has quality 95; EXR and HDR hold unclamped values, the other formats \
every pixel in 8 bits a channel.

The same scene and options give the same bytes on every machine and with any number of threads.";

#[derive(Args, Debug)]
struct RenderArguments {
    /// Scene file: .ray, .dat or .xml
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Picture file, in the format its extension says (.bmp, .ppm, .png, .tiff, .gif,
    /// .jpeg, .exr, .hdr); - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format of the picture, whatever the file's name [default for -o -: bmp]
    #[arg(long, value_name = "FORMAT", value_parser = format_names())]
    format: Option<ImageFormat>,
    /// Width and height in pixels, such as 800x600, at most 268435456 pixels in all (as 16384x16384)
    /// [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<Size>,
    /// Samples a pixel, 1 to 65536
    #[arg(long, value_name = "N", default_value_t = DEFAULT_SPP, value_parser = spp_range())]
    spp: u32,
    /// Bounces of a ray, up to 4096; 0 is none [default: 8, with path tracing 64]
    #[arg(long, value_name = "N", value_parser = depth_range())]
    depth: Option<u32>,
    /// How light is gathered [default: whitted, unless the scene says path]
    #[arg(long, value_name = "HOW", value_enum)]
    integrator: Option<IntegratorChoice>,
    /// What pixels are filtered by
    #[arg(long, value_name = "FILTER", value_enum, default_value_t)]
    filter: FilterChoice,
    /// Chooses among equally good sample patterns, 0 to 4294967295
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Show the first surface under each pixel instead of light
    #[arg(long, value_name = "WHAT", value_enum)]
    aov: Option<AovChoice>,
    /// How colours become 8-bit values [default: linear, unless the scene says srgb]
    #[arg(long, value_name = "CURVE", value_enum)]
    transfer: Option<TransferChoice>,
    /// Threads that trace, 1 to 1024 [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads_range())]
    threads: Option<u16>,
    #[command(flatten)]
    strictness: StrictnessArguments,
    #[command(flatten)]
    assets: AssetArguments,
    /// Write the picture even to a terminal
    #[arg(long)]
    force: bool,
}

impl RenderArguments {
    fn meaning(self) -> Result<Render, String> {
        let to_stdout = self.output == Path::new("-");
        let format = match self.format {
            Some(format) => format,
            None if to_stdout => ImageFormat::Bmp,
            None => ImageFormat::of_path(&self.output).ok_or_else(|| {
                format!(
                    "can't tell the format of {}: give it an extension of {}, or use --format",
                    self.output.display(),
                    known_extensions()
                )
            })?,
        };
        let all_cores = || thread::available_parallelism().map_or(1, NonZero::get);
        Ok(Render {
            scene: self.scene,
            warnings: self.strictness.meaning(),
            output: match (to_stdout, self.force) {
                (false, _) => Output::File(self.output),
                (true, false) => Output::Stdout,
                (true, true) => Output::StdoutTerminal,
            },
            format,
            size: self.size,
            spp: self.spp,
            depth: self.depth,
            integrator: self.integrator.map(IntegratorChoice::meaning),
            filter: self.filter.meaning(),
            seed: self.seed,
            aov: self.aov.map(AovChoice::meaning),
            transfer: self.transfer.map(TransferChoice::meaning),
            threads: self.threads.map_or_else(all_cores, usize::from),
            assets: self.assets.folders,
        })
    }
}

fn spp_range() -> impl TypedValueParser<Value = u32> {
    value_parser!(u32).range(1..=i64::from(MAX_SPP))
}

fn depth_range() -> impl TypedValueParser<Value = u32> {
    // No sample has rays for more bounces: see the ray budget of the renderer.
    value_parser!(u32).range(..=4096)
}

fn threads_range() -> impl TypedValueParser<Value = u16> {
    // More than any machine has; far more could not be started.
    value_parser!(u16).range(1..=1024)
}

fn format_names() -> impl TypedValueParser<Value = ImageFormat> {
    let names = FORMATS.map(|(format, extensions)| {
        PossibleValue::new(format.name()).aliases(extensions.iter().copied())
    });
    PossibleValuesParser::new(names).try_map(|said| {
        let mut formats = FORMATS.into_iter();
        let known = formats.find(|(_, extensions)| extensions.contains(&said.as_str()));
        known.map(|(format, _)| format).ok_or("unknown format")
    })
}

fn parse_size(said: &str) -> Result<Size, String> {
    Size::parse(said)
        .ok_or_else(|| "expected two whole numbers of at least 1, such as 800x600".to_owned())
}

#[cfg(test)]
mod tests;
