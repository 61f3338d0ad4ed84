//! The table of settings other than keys.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::scene::{Filter, Integrator, MAX_DEPTH, MAX_SPP};
use crate::ui::terminal::{Choice, ColourDepth, Mouse};
use crate::ui::{Options, Pixels, Theme};

/// Possible intervals between checks of files, in milliseconds.
pub const POLLS: RangeInclusive<u64> = 10..=3_600_000;
/// The highest limit of terminal output, in kilobytes per second.
pub const MAX_BANDWIDTH: u32 = 4_000_000;
/// The highest number of threads: more than any machine has cores.
pub const MAX_THREADS: u16 = 1024;

/// The words for colour depths.
pub const COLOURS: [(&str, Choice); 5] = [
    ("auto", Choice::Auto),
    ("24", Choice::Fixed(ColourDepth::TrueColour)),
    ("256", Choice::Fixed(ColourDepth::Palette256)),
    ("16", Choice::Fixed(ColourDepth::Palette16)),
    ("mono", Choice::Fixed(ColourDepth::Mono)),
];
/// The words for integrators.
pub const INTEGRATORS: [(&str, Integrator); 3] = [
    (Integrator::Whitted.name(), Integrator::Whitted),
    (Integrator::Path.name(), Integrator::Path),
    (Integrator::Photon.name(), Integrator::Photon),
];
/// The words for pixel filters.
pub const FILTERS: [(&str, Filter); 3] = [
    (Filter::Box.name(), Filter::Box),
    (Filter::Gaussian.name(), Filter::Gaussian),
    (Filter::BlackmanHarris.name(), Filter::BlackmanHarris),
];

/// A setting: one declaration for reading, errors and printing.
pub(super) struct Setting {
    pub(super) name: &'static str,
    /// Description, printed above it.
    pub(super) words: &'static str,
    /// What applies if it is not set, as TOML.
    pub(super) default: &'static str,
    pub(super) kind: Kind,
}

/// The values of a setting, and where they are kept.
pub(super) enum Kind {
    /// A whole number.
    Integer {
        range: RangeInclusive<i64>,
        set: fn(&mut Options, i64),
        get: fn(&Options) -> Option<i64>,
    },
    /// One of some words.
    Word {
        words: fn() -> Vec<&'static str>,
        set: fn(&mut Options, &str),
        get: fn(&Options) -> Option<&'static str>,
    },
    /// True or false.
    Switch {
        set: fn(&mut Options, bool),
        get: fn(&Options) -> Option<bool>,
    },
    /// Any text but an empty one.
    Text {
        set: fn(&mut Options, &str),
        get: fn(&Options) -> Option<&str>,
    },
    /// A list of folders.
    Folders {
        set: fn(&mut Options, Vec<PathBuf>),
        get: fn(&Options) -> &[PathBuf],
    },
}

/// All settings other than keys.
pub(super) const SETTINGS: &[Setting] = &[
    Setting {
        name: "theme",
        words: "Colours of the interface: \"dark\", \"light\" or \"mono\"",
        default: "\"dark\"",
        kind: Kind::Word {
            words: || Theme::ALL.map(Theme::name).to_vec(),
            set: |options, word| options.theme = Theme::named(word),
            get: |options| options.theme.map(Theme::name),
        },
    },
    Setting {
        name: "color",
        words: "Colour depth of the terminal: \"auto\", \"24\", \"256\", \"16\" or \"mono\"",
        default: "\"auto\"",
        kind: Kind::Word {
            words: || COLOURS.map(|(word, _)| word).to_vec(),
            set: |options, word| options.colour = meant(&COLOURS, word),
            get: |options| word_for(&COLOURS, options.colour),
        },
    },
    Setting {
        name: "pixels",
        words: "What pixels are drawn with: \"half\", \"quadrant\", \"sextant\" or \"octant\" blocks, \"kitty\", \"sixel\"\n\
                # or \"iterm\" pictures, or \"auto\": pictures if the terminal reports them, otherwise half blocks",
        default: "\"auto\"",
        kind: Kind::Word {
            words: || Pixels::ALL.map(Pixels::name).to_vec(),
            set: |options, word| options.pixels = Pixels::named(word),
            get: |options| options.pixels.map(Pixels::name),
        },
    },
    Setting {
        name: "mouse",
        words: "Whether to capture the mouse",
        default: "true",
        kind: Kind::Switch {
            set: |options, is_on| options.mouse = Some(if is_on { Mouse::On } else { Mouse::Off }),
            get: |options| options.mouse.map(|mouse| mouse == Mouse::On),
        },
    },
    Setting {
        name: "editor",
        words: "The editor to open; otherwise that of VISUAL or EDITOR",
        default: "\"vi\"",
        kind: Kind::Text {
            set: |options, text| options.editor = Some(text.to_owned()),
            get: |options| options.editor.as_deref(),
        },
    },
    Setting {
        name: "bandwidth",
        words: "Limit of terminal output, in KB/s, 0 for none; otherwise it is measured",
        default: "128",
        kind: Kind::Integer {
            range: 0..=MAX_BANDWIDTH as i64,
            set: |options, number| options.bandwidth = Some(number as u32 * 1000),
            get: |options| options.bandwidth.map(|bytes| i64::from(bytes / 1000)),
        },
    },
    Setting {
        name: "poll",
        words: "Check files for changes every so many milliseconds instead of being notified",
        default: "500",
        kind: Kind::Integer {
            range: *POLLS.start() as i64..=*POLLS.end() as i64,
            set: |options, number| options.poll = Some(Duration::from_millis(number as u64)),
            get: |options| options.poll.map(|time| time.as_millis() as i64),
        },
    },
    Setting {
        name: "spp",
        words: "Samples per pixel of full-size traces and exports",
        default: "16",
        kind: Kind::Integer {
            range: 1..=MAX_SPP as i64,
            set: |options, number| options.rendering.spp = Some(number as u32),
            get: |options| options.rendering.spp.map(i64::from),
        },
    },
    Setting {
        name: "depth",
        words: "Maximum number of bounces; otherwise 8, or 64 with path tracing",
        default: "8",
        kind: Kind::Integer {
            range: 0..=MAX_DEPTH as i64,
            set: |options, number| options.rendering.depth = Some(number as u32),
            get: |options| options.rendering.depth.map(i64::from),
        },
    },
    Setting {
        name: "integrator",
        words: "Integrator to start with, \"whitted\", \"path\" or \"photon\"; otherwise the scene decides",
        default: "\"whitted\"",
        kind: Kind::Word {
            words: || INTEGRATORS.map(|(word, _)| word).to_vec(),
            set: |options, word| options.rendering.integrator = meant(&INTEGRATORS, word),
            get: |options| word_for(&INTEGRATORS, options.rendering.integrator),
        },
    },
    Setting {
        name: "filter",
        words: "Pixel filter: \"box\", \"gaussian\" or \"blackman-harris\"",
        default: "\"box\"",
        kind: Kind::Word {
            words: || FILTERS.map(|(word, _)| word).to_vec(),
            set: |options, word| options.rendering.filter = meant(&FILTERS, word),
            get: |options| word_for(&FILTERS, options.rendering.filter),
        },
    },
    Setting {
        name: "threads",
        words: "Number of tracing threads; otherwise one per core, one fewer for the preview",
        default: "2",
        kind: Kind::Integer {
            range: 1..=MAX_THREADS as i64,
            set: |options, number| options.threads = Some(number as usize),
            get: |options| options.threads.map(|count| count as i64),
        },
    },
    Setting {
        name: "assets",
        words: "More folders from which pictures and meshes may be read, as absolute paths",
        default: "[]",
        kind: Kind::Folders {
            set: |options, folders| options.assets = folders,
            get: |options| &options.assets,
        },
    },
];

/// The path of a folder; `None` if it is relative, which would depend on the current folder.
pub(super) fn folder(text: &str) -> Option<PathBuf> {
    Some(PathBuf::from(text)).filter(|path| path.is_absolute())
}

/// A folder as it is read; `None` if it is not text.
pub(super) fn as_text(folder: &Path) -> Option<&str> {
    folder.to_str()
}

fn meant<T: Copy>(words: &[(&str, T)], word: &str) -> Option<T> {
    let mut words = words.iter();
    words
        .find(|(known, _)| *known == word)
        .map(|&(_, value)| value)
}

fn word_for<T: PartialEq>(words: &[(&'static str, T)], value: Option<T>) -> Option<&'static str> {
    let value = value?;
    let mut words = words.iter();
    words
        .find(|(_, known)| *known == value)
        .map(|(word, _)| *word)
}
