//! The arguments of the interface.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{ArgGroup, Args};

use super::choices::{ColourChoice, PixelsChoice, ThemeChoice};
use super::rendering::RenderingArguments;
use super::shared::{AssetArguments, UpArgument, spp_range, threads_range, whole_number};
use config::{MAX_BANDWIDTH, POLLS};
use ui::keymap::Keymap;
use ui::terminal::Mouse;

/// The size of a screen without a terminal, in cells.
const SCREEN: (u16, u16) = (100, 30);

/// What to do with the options of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Open the interface.
    Open,
    /// Print the configuration in use.
    PrintConfig,
    /// Print the keys.
    PrintKeys,
}

#[derive(Args, Debug)]
#[command(group = ArgGroup::new("headless").args(["keys", "frames"]).multiple(true))]
pub(super) struct InterfaceArguments {
    /// Scene file to open: .ray, .dat, .xml or .test; a new scene if it does not exist. Or a mesh (.obj, .ply or
    /// .stl): a new scene around it
    #[arg(value_name = "SCENE")]
    pub(super) scene: Option<PathBuf>,
    // Parsed so that a second scene is not rejected as an unknown command.
    #[arg(hide = true)]
    pub(super) surplus: Vec<PathBuf>,
    /// Check the file for changes every MS milliseconds, 10 to 3600000 (500 if omitted); for
    /// network file systems, which send no change notifications
    #[arg(
        long, value_name = "MS", num_args = 0..=1, require_equals = true,
        default_missing_value = "500", value_parser = whole_number(*POLLS.start(), *POLLS.end())
    )]
    poll: Option<u64>,
    /// Limit terminal output, in KB/s (1000 bytes per second), up to 4000000; 0 means no limit
    #[arg(
        long, value_name = "KB/s", allow_negative_numbers = true,
        value_parser = whole_number(0, MAX_BANDWIDTH)
    )]
    bandwidth: Option<u32>,
    /// Colour depth of the terminal [default: auto]
    #[arg(long, alias = "colour", value_name = "COLOURS", value_enum)]
    color: Option<ColourChoice>,
    /// Colours of the interface [default: dark]
    #[arg(long, value_name = "THEME", value_enum)]
    theme: Option<ThemeChoice>,
    /// How to draw pixels [default: auto]
    #[arg(long, value_name = "PIXELS", value_enum)]
    pixels: Option<PixelsChoice>,
    /// Do not capture the mouse
    #[arg(long)]
    no_mouse: bool,
    /// Samples per pixel of full-size traces and exports, 1 to 65536 [default: the scene's, otherwise
    /// 16]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = spp_range())]
    spp: Option<u32>,
    #[command(flatten)]
    rendering: RenderingArguments,
    /// Number of tracing threads, 1 to 1024 [default: one per core, one fewer for the preview]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads_range())]
    threads: Option<u16>,
    /// Configuration file [default: halflight/config.toml in ~/.config; none with --keys
    /// and --dump-frame]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Print the configuration in use, with every setting and key, instead of opening a scene
    #[arg(long, conflicts_with = "headless")]
    print_config: bool,
    /// Print all keys and the names of their actions instead of opening a scene
    #[arg(long, conflicts_with_all = ["headless", "print_config"])]
    print_keys: bool,
    /// Press the keys of this script instead of reading them from a terminal, and end after the last
    #[arg(long, value_name = "FILE")]
    keys: Option<PathBuf>,
    /// Write the last screen to FILE, which ends in .txt, .ansi or .png; needs no terminal;
    /// repeatable
    #[arg(long = "dump-frame", value_name = "FILE", value_parser = parse_frame)]
    frames: Vec<PathBuf>,
    /// Size of the screen for --keys and --dump-frame, such as 100x30
    #[arg(long, value_name = "COLSxROWS", value_parser = parse_screen, requires = "headless")]
    screen: Option<(u16, u16)>,
    #[command(flatten)]
    up: UpArgument,
    #[command(flatten)]
    assets: AssetArguments,
}

impl InterfaceArguments {
    /// Where the configuration comes from. A script of keys has the same effect for every user.
    pub(super) fn configuration(&self) -> config::Source {
        match &self.config {
            Some(path) => config::Source::File(path.clone()),
            None if self.keys.is_some() || !self.frames.is_empty() => config::Source::None,
            None => config::Source::Usual,
        }
    }

    /// What to do with the options.
    pub(super) fn purpose(&self) -> Purpose {
        match (self.print_config, self.print_keys) {
            (true, _) => Purpose::PrintConfig,
            (_, true) => Purpose::PrintKeys,
            (false, false) => Purpose::Open,
        }
    }

    pub(super) fn into_options(self) -> ui::Options {
        let is_headless = self.keys.is_some() || !self.frames.is_empty();
        ui::Options {
            scene: self.scene,
            up: self.up.up(),
            poll: self.poll.map(Duration::from_millis),
            bandwidth: self.bandwidth.map(|kilobytes| kilobytes * 1000),
            colour: self.color.map(ColourChoice::value),
            theme: self.theme.map(ThemeChoice::value),
            pixels: self.pixels.map(PixelsChoice::value),
            mouse: self.no_mouse.then_some(Mouse::Off),
            editor: None,
            follow: None,
            rendering: self.rendering.rendering(self.spp),
            threads: self.threads.map(usize::from),
            assets: self.assets.folders,
            keymap: Keymap::default(),
            lesson: None,
            rehearsal: is_headless.then(|| ui::Rehearsal {
                keys: self.keys,
                screen: self.screen.unwrap_or(SCREEN),
                frames: self.frames,
            }),
        }
    }
}

fn parse_screen(text: &str) -> Result<(u16, u16), String> {
    ui::parse_screen(text).ok_or_else(|| "expected columns and rows, such as 100x30".to_owned())
}

fn parse_frame(text: &str) -> Result<PathBuf, String> {
    match ui::FrameFormat::of_path(Path::new(text)) {
        Some(_) => Ok(text.into()),
        None => Err("expected a name that ends in .txt, .ansi or .png".to_owned()),
    }
}
