//! Command-line arguments and exit codes. Does no work itself.

mod bench;
mod choices;
mod compare;
mod convert;
mod explain;
mod interface;
mod manual;
mod merge;
mod render;
mod rendering;
mod shared;
mod show;
mod tracing;

use std::env;
use std::ffi::{OsStr, OsString};
use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use bench::BenchArguments;
use compare::CompareArguments;
use convert::ConvertArguments;
use explain::ExplainArguments;
use interface::InterfaceArguments;
pub use interface::Purpose;
use merge::MergeArguments;
use render::RenderArguments;
use shared::ReadingArguments;
use show::ShowArguments;

use ::render::{CPU_LEVEL_VARIABLE, CPU_LEVELS};
use batch::{Bench, Check, Compare, Convert, Explain, Merge, Render, Samples, Show, Verdict};
use file::ReadError;
use shards::Unmerged;
use text::{alternatives, nearest_word, visible};

/// Parts cannot be merged.
pub const INCOMPLETE: u8 = 3;
/// Stopped with what was traced kept, or another process is writing it: try again.
pub const TRY_AGAIN: u8 = 75;
/// Success.
pub const DONE: u8 = 0;
/// A write or system error.
pub const FAILED: u8 = 1;
/// Compared pictures differ, or a picture is of another scene.
pub const DIFFERENT: u8 = 1;
/// Wrong arguments.
pub const USAGE: u8 = 2;
/// A scene or picture has errors.
pub const INVALID: u8 = 65;
/// A scene, picture, part or folder to read is missing or unreadable.
pub const NO_INPUT: u8 = 66;
/// The picture or another output cannot be created.
pub const NO_OUTPUT: u8 = 73;
/// A write or system error of `show` or `compare`, where 1 has another meaning.
pub const NO_IO: u8 = 74;

/// The terminal of the interface is gone; the code shells report for `SIGHUP`.
pub const HUNG_UP: u8 = 129;
/// The interface was interrupted from outside; the code shells report for `SIGINT`.
pub const INTERRUPTED: u8 = 130;
/// Another signal ended the interface. Shells report this plus the number of the signal.
pub const SIGNALLED: u8 = 128;

/// A parsed command line.
#[derive(Clone, Debug)]
pub enum Command {
    /// Open the interface, or print how it is configured.
    Interface(ui::Options, config::Source, Purpose),
    /// Render a picture or a sequence of pictures.
    Render(Render),
    /// Measure scenes.
    Bench(Bench),
    /// Merge part files.
    Merge(Merge),
    /// Show what a picture is made from.
    Show(Show),
    /// Compare two pictures.
    Compare(Compare),
    /// Explain a pixel.
    Explain(Explain),
    /// Convert a scene to another language.
    Convert(Convert),
    /// Write the sample scenes.
    Samples(Samples),
    /// Report what was detected about the terminal and the machine, for this scene.
    Doctor(Option<PathBuf>),
    /// Report errors and warnings in scenes.
    Check(Check),
    /// Serve an editor on standard input and output.
    Lsp,
}

/// A text to print instead of running a command, and the exit code.
#[derive(Debug, PartialEq, Eq)]
pub struct Stop {
    /// The text, safe to print.
    pub text: String,
    /// [`DONE`] if the text was requested and goes to standard output, otherwise [`USAGE`].
    pub code: u8,
}

/// Parses the arguments, the first of which is the program's name, and checks the environment of
/// the command.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Command, Stop> {
    let command = parse_arguments(arguments)?;
    match check_cap(env::var_os(CPU_LEVEL_VARIABLE).as_deref()) {
        Some(reason) => Err(refusal(None, reason)),
        None => Ok(command),
    }
}

/// Why the value of [`CPU_LEVEL_VARIABLE`] is refused, if it is.
fn check_cap(cap: Option<&OsStr>) -> Option<String> {
    let is_known = |cap: &OsStr| cap.is_empty() || CPU_LEVELS.iter().any(|known| cap == *known);
    let unknown = cap.filter(|cap| !is_known(cap))?;
    Some(format!(
        "{CPU_LEVEL_VARIABLE}={}: expected {}",
        unknown.display(),
        alternatives(CPU_LEVELS)
    ))
}

fn parse_arguments(arguments: impl IntoIterator<Item = OsString>) -> Result<Command, Stop> {
    let cli = Cli::try_parse_from(arguments).map_err(|error| Stop::of(&error))?;
    match cli.command {
        Some(Subcommands::Render(render)) => render
            .into_render()
            .map(Command::Render)
            .map_err(|reason| refusal(Some("render"), reason)),
        Some(Subcommands::Bench(bench)) => bench
            .into_bench()
            .map(Command::Bench)
            .map_err(|reason| refusal(Some("bench"), reason)),
        Some(Subcommands::Merge(merge)) => merge
            .into_merge()
            .map(Command::Merge)
            .map_err(|reason| refusal(Some("merge"), reason)),
        Some(Subcommands::Show(show)) => Ok(Command::Show(show.into_show())),
        Some(Subcommands::Compare(compare)) => compare
            .into_compare()
            .map(Command::Compare)
            .map_err(|reason| refusal(Some("compare"), reason)),
        Some(Subcommands::Explain(explain)) => Ok(Command::Explain(explain.into_explain())),
        Some(Subcommands::Convert(convert)) => convert
            .into_convert()
            .map(Command::Convert)
            .map_err(|reason| refusal(Some("convert"), reason)),
        Some(Subcommands::Check { scenes, reading }) => Ok(Command::Check(Check {
            scenes,
            reading: reading.into_reading(),
        })),
        Some(Subcommands::Tutor { lesson }) => {
            let options = ui::Options {
                lesson: Some(match lesson {
                    Some(name) => ui::LessonChoice::Begun(name),
                    None => ui::LessonChoice::Continued,
                }),
                ..ui::Options::default()
            };
            Ok(Command::Interface(
                options,
                config::Source::Usual,
                Purpose::Open,
            ))
        }
        Some(Subcommands::Samples { folder }) => Ok(Command::Samples(Samples { folder })),
        Some(Subcommands::Doctor { scene }) => Ok(Command::Doctor(scene)),
        Some(Subcommands::Lsp {
            print_config: None, ..
        }) => Ok(Command::Lsp),
        Some(Subcommands::Lsp { print_config, .. }) => {
            let lines = print_config.map_or("", lsp::Editor::lines);
            Err(Stop::requested(lines.as_bytes()))
        }
        Some(Subcommands::Completions { shell }) => Err(Stop::requested(&completions(shell))),
        Some(Subcommands::Man) => Err(Stop::requested(&manual::page(Cli::command()))),
        None => {
            let interface = cli.interface;
            check_words(interface.scene.as_deref(), &interface.surplus)
                .map(|()| {
                    let (source, purpose) = (interface.configuration(), interface.purpose());
                    Command::Interface(interface.into_options(), source, purpose)
                })
                .map_err(|reason| refusal(None, reason))
        }
    }
}

/// Rejects arguments that clap has accepted, showing the usage of their command.
fn refusal(command: Option<&str>, reason: String) -> Stop {
    let mut cli = Cli::command();
    // Without this, a subcommand's usage lacks the program's name.
    cli.build();
    let of_command = command.and_then(|name| cli.find_subcommand_mut(name).cloned());
    let error = of_command
        .unwrap_or(cli)
        .error(ErrorKind::ValueValidation, reason);
    Stop::of(&error)
}

/// The exit code for headless work.
pub fn exit_code(outcome: &Result<(), batch::Error>) -> u8 {
    outcome.as_ref().map_or_else(failure_code, |()| DONE)
}

fn failure_code(error: &batch::Error) -> u8 {
    use batch::Error;
    match error {
        Error::Read(error) => read_code(error),
        Error::Assets(_) | Error::Unmerged(Unmerged::Io { .. } | Unmerged::NotRegular { .. }) => {
            NO_INPUT
        }
        Error::UnknownLanguage(_)
        | Error::Invalid { .. }
        | Error::InvalidTrack { .. }
        | Error::Incomplete { .. }
        | Error::NoFrame { .. }
        | Error::Unconverted { .. }
        | Error::Picture { .. }
        | Error::NoProvenance(_)
        | Error::NeverRecorded(_) => INVALID,
        Error::Refused(_) => USAGE,
        Error::Create { .. } => NO_OUTPUT,
        Error::Part { source, .. } => match source {
            shards::Refused::Busy => TRY_AGAIN,
            _ => NO_OUTPUT,
        },
        Error::Kept { signal, .. } | Error::KeptFrames { signal, .. } if signal.is_interrupt() => {
            INTERRUPTED
        }
        Error::Kept { .. } | Error::KeptFrames { .. } => TRY_AGAIN,
        Error::Write { .. }
        | Error::Untraced(_)
        | Error::Stopped
        | Error::Unmerged(Unmerged::Refused(_)) => FAILED,
        Error::Unmerged(_) => INCOMPLETE,
    }
}

/// The exit code for a comparison, of which 1 says nothing but that the pictures differ.
pub fn comparison_exit_code(outcome: &Result<Verdict, batch::Error>) -> u8 {
    match outcome {
        Ok(Verdict::Alike) => DONE,
        Ok(Verdict::Different) => DIFFERENT,
        Err(error) => match failure_code(error) {
            FAILED => NO_IO,
            code => code,
        },
    }
}

/// The exit code for the interface.
pub fn interface_exit_code(outcome: &Result<ui::Ending, ui::Error>) -> u8 {
    match outcome {
        Ok(ui::Ending::Quit) => DONE,
        Ok(ui::Ending::HungUp) => HUNG_UP,
        Ok(ui::Ending::Interrupted) => INTERRUPTED,
        Ok(ui::Ending::Terminated { signal }) => SIGNALLED + signal,
        Err(ui::Error::Read(error)) => read_code(error),
        Err(ui::Error::UnknownLanguage(_) | ui::Error::Faulty { .. }) => INVALID,
        Err(ui::Error::Frame { .. }) => NO_OUTPUT,
        Err(ui::Error::Folder { .. } | ui::Error::Assets(_)) => NO_INPUT,
        Err(ui::Error::NoSuch { .. } | ui::Error::NoTerminal | ui::Error::DumbTerminal) => USAGE,
        Err(ui::Error::NoThreads(_) | ui::Error::NoMemory(_) | ui::Error::Terminal(_)) => FAILED,
    }
}

/// The exit code for a configuration that cannot be used.
pub fn config_exit_code(error: &config::Error) -> u8 {
    match error {
        config::Error::Read(error) => read_code(error),
        config::Error::Faulty { .. } => USAGE,
    }
}

fn read_code(error: &ReadError) -> u8 {
    match error {
        ReadError::NotUtf8 { .. } | ReadError::Binary { .. } => INVALID,
        ReadError::NoMemory { .. } => FAILED,
        ReadError::Io { source, .. } if source.kind() == std::io::ErrorKind::OutOfMemory => FAILED,
        ReadError::NotFound { .. }
        | ReadError::NoFolder { .. }
        | ReadError::NotRegular { .. }
        | ReadError::TooLong { .. }
        | ReadError::Io { .. } => NO_INPUT,
    }
}

impl Stop {
    fn requested(text: &[u8]) -> Self {
        Self {
            text: String::from_utf8_lossy(text).into_owned(),
            code: DONE,
        }
    }

    fn of(error: &clap::Error) -> Self {
        // The text quotes arguments, which may contain anything.
        let mut text = String::new();
        for line in error.to_string().lines() {
            // Writing to a string cannot fail.
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
    name = "halflight",
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
  halflight scene.ray                             edit a scene and see it traced
  halflight bunny.ply                             open a mesh (.obj, .ply, .stl) in a new scene
  halflight render scene.ray -o scene.bmp         render a picture
  halflight render scene.ray -o - --format ppm | ssh far 'cat > scene.ppm'
  halflight check scenes/*.ray                    report errors and warnings
  halflight lsp --print-config helix              set up an editor that shows errors as you type
  halflight tutor                                 learn the program in three lessons
  halflight samples scenes                        write the sample scenes into a folder
  halflight doctor                                report what was detected, and why
  halflight scene.ray --keys a.keys --dump-frame a.png    draw the screen after these keys

To open a scene named like a command, write ./render, ./check or ./doctor. Scenes are read from \
files, not from standard input, pipes or devices.

Exit codes: 0 success, 1 write or system error (show and compare: different), 2 wrong arguments or \
configuration, 3 parts cannot be merged, 65 invalid scene or picture, 66 input not found or \
unreadable, 73 output cannot be created, 74 write or system error of show or compare, 75 stopped or \
in use: the same command continues it, 129 terminal gone, 130 SIGINT, 143 SIGTERM, 128 + N any other \
signal N. Ctrl-C quits the interface with 0, like q.";

#[derive(Debug, Subcommand)]
enum Subcommands {
    /// Render a scene to a picture file
    #[command(after_help = render::EXAMPLES)]
    Render(RenderArguments),
    /// Merge the part files of a picture, or list incomplete shards
    #[command(after_help = merge::EXAMPLES)]
    Merge(MergeArguments),
    /// Show what a picture is made from
    #[command(after_help = show::EXAMPLES)]
    Show(ShowArguments),
    /// Compare two pictures, or what scenes show
    #[command(after_help = compare::EXAMPLES)]
    Compare(CompareArguments),
    /// Say why a pixel has its colour, and show the rays behind it
    #[command(after_help = explain::EXAMPLES)]
    Explain(ExplainArguments),
    /// Convert a scene to another language, and say what that cannot express
    #[command(after_help = convert::EXAMPLES)]
    Convert(ConvertArguments),
    /// Measure how fast scenes are loaded and traced on this machine
    #[command(after_help = bench::EXAMPLES)]
    Bench(BenchArguments),
    /// Report errors and warnings in scenes, and pictures that are black or overexposed
    Check {
        /// Scene files, or meshes: .obj, .ply or .stl
        #[arg(required = true, value_name = "SCENE")]
        scenes: Vec<PathBuf>,
        #[command(flatten)]
        reading: ReadingArguments,
    },
    /// Learn the program with your own hands: a lesson beside the picture
    Tutor {
        /// The lesson to begin [default: the one that was left last, otherwise edit]
        #[arg(value_name = "LESSON", value_parser = lessons())]
        lesson: Option<String>,
    },
    /// Print the script by which a shell completes words of the command line
    Completions {
        /// The shell
        #[arg(value_name = "SHELL", value_enum)]
        shell: ShellChoice,
    },
    /// Print the manual page
    Man,
    /// Run a language server for an editor, on standard input and output
    Lsp {
        /// Print the lines to add to an editor's configuration instead
        #[arg(long, value_name = "EDITOR", value_parser = editors())]
        print_config: Option<lsp::Editor>,
        /// Ignored; some editors pass it
        #[arg(long)]
        stdio: bool,
        /// Ignored; some editors pass their process ID
        #[arg(long = "clientProcessId", value_name = "N")]
        client: Option<u32>,
    },
    /// Write the sample scenes, with the pictures and meshes that they name, into a folder
    Samples {
        /// The folder, which is made if it is missing; files in it are never replaced
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Report what was detected about the terminal and the machine, and why
    Doctor {
        /// Scene file whose folder to examine [default: the current folder]
        #[arg(value_name = "SCENE")]
        scene: Option<PathBuf>,
    },
}

/// Parses the name of a lesson.
fn lessons() -> PossibleValuesParser {
    PossibleValuesParser::new(ui::lessons())
}

/// Parses the name of an editor.
fn editors() -> impl TypedValueParser<Value = lsp::Editor> {
    let names = lsp::Editor::ALL.map(lsp::Editor::name);
    let find = |name: String| {
        let mut all = lsp::Editor::ALL.into_iter();
        all.find(|editor| editor.name() == name).ok_or("unknown")
    };
    PossibleValuesParser::new(names).try_map(find)
}

/// A shell that completes words.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ShellChoice {
    Bash,
    Zsh,
    Fish,
}

/// The script by which a shell completes the options of every command.
fn completions(shell: ShellChoice) -> Vec<u8> {
    let shell = match shell {
        ShellChoice::Bash => Shell::Bash,
        ShellChoice::Zsh => Shell::Zsh,
        ShellChoice::Fish => Shell::Fish,
    };
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "halflight", &mut script);
    script
}

/// Refuses words that are not the scene to open: misspelt commands and a second scene.
fn check_words(scene: Option<&Path>, surplus: &[PathBuf]) -> Result<(), String> {
    if let Some((word, command)) = scene.and_then(|scene| Some((scene, likely_command(scene)?))) {
        return Err(format!(
            "unknown command `{}`: did you mean {command}?",
            word.display()
        ));
    }
    match surplus.first() {
        Some(second) => Err(format!(
            "unexpected second scene {}: only one can be opened; the commands are {}",
            second.display(),
            commands()
        )),
        None => Ok(()),
    }
}

/// The names of all commands, as a list in a sentence.
fn commands() -> String {
    let cli = Cli::command();
    let names: Vec<_> = cli.get_subcommands().map(clap::Command::get_name).collect();
    match names.split_last() {
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// The command that was probably meant by a scene name without an extension.
fn likely_command(scene: &Path) -> Option<String> {
    let word = scene.to_str().filter(|word| !word.contains(['.', '/']))?;
    let cli = Cli::command();
    let names = cli.get_subcommands().map(clap::Command::get_name);
    nearest_word(word, names).map(str::to_owned)
}

#[cfg(test)]
mod tests;
