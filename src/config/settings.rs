//! The table of settings other than keys.

use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::Duration;

use link::Follow;
use scene::{RenderKey, Rendering, Values};
use ui::terminal::{Choice, ColourDepth, Mouse};
use ui::{Options, Pixels, Theme};

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

/// A setting: one declaration for reading, errors and printing.
#[derive(Clone)]
pub(super) struct Setting {
    pub(super) name: &'static str,
    /// Description, printed above it.
    pub(super) words: &'static str,
    /// What applies if it is not set, as TOML.
    pub(super) default: Cow<'static, str>,
    pub(super) kind: Kind,
}

/// The values of a setting, and where they are kept.
#[derive(Clone)]
pub(super) enum Kind {
    /// A render setting.
    Render(RenderKey),
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

/// The settings before those of rendering.
const INTERFACE: &[Setting] = &[
    Setting {
        name: "theme",
        words: "Colours of the interface: \"dark\", \"light\" or \"mono\"",
        default: Cow::Borrowed("\"dark\""),
        kind: Kind::Word {
            words: || Theme::ALL.map(Theme::name).to_vec(),
            set: |options, word| options.theme = Theme::named(word),
            get: |options| options.theme.map(Theme::name),
        },
    },
    Setting {
        name: "color",
        words: "Colour depth of the terminal: \"auto\", \"24\", \"256\", \"16\" or \"mono\"",
        default: Cow::Borrowed("\"auto\""),
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
        default: Cow::Borrowed("\"auto\""),
        kind: Kind::Word {
            words: || Pixels::ALL.map(Pixels::name).to_vec(),
            set: |options, word| options.pixels = Pixels::named(word),
            get: |options| options.pixels.map(Pixels::name),
        },
    },
    Setting {
        name: "mouse",
        words: "Whether to capture the mouse",
        default: Cow::Borrowed("true"),
        kind: Kind::Switch {
            set: |options, is_on| options.mouse = Some(if is_on { Mouse::On } else { Mouse::Off }),
            get: |options| options.mouse.map(|mouse| mouse == Mouse::On),
        },
    },
    Setting {
        name: "editor",
        words: "The editor to open; otherwise that of VISUAL or EDITOR",
        default: Cow::Borrowed("\"vi\""),
        kind: Kind::Text {
            set: |options, text| options.editor = Some(text.to_owned()),
            get: |options| options.editor.as_deref(),
        },
    },
    Setting {
        name: "follow",
        words: "When to follow a scene that is open in an editor with `halflight lsp`",
        default: Cow::Borrowed("\"typing\""),
        kind: Kind::Word {
            words: || Follow::NAMED.map(|(name, _)| name).to_vec(),
            set: |options, word| options.follow = Follow::named(word),
            get: |options| options.follow.map(Follow::name),
        },
    },
    Setting {
        name: "bandwidth",
        words: "Limit of terminal output, in KB/s, 0 for none; otherwise it is measured",
        default: Cow::Borrowed("128"),
        kind: Kind::Integer {
            range: 0..=MAX_BANDWIDTH as i64,
            set: |options, number| options.bandwidth = Some(number as u32 * 1000),
            get: |options| options.bandwidth.map(|bytes| i64::from(bytes / 1000)),
        },
    },
    Setting {
        name: "poll",
        words: "Check files for changes every so many milliseconds instead of being notified",
        default: Cow::Borrowed("500"),
        kind: Kind::Integer {
            range: *POLLS.start() as i64..=*POLLS.end() as i64,
            set: |options, number| options.poll = Some(Duration::from_millis(number as u64)),
            get: |options| options.poll.map(|time| time.as_millis() as i64),
        },
    },
];

/// The settings that follow those of rendering.
const MACHINE: &[Setting] = &[
    Setting {
        name: "threads",
        words: "Number of tracing threads; otherwise one per core, one fewer for the preview",
        default: Cow::Borrowed("2"),
        kind: Kind::Integer {
            range: 1..=MAX_THREADS as i64,
            set: |options, number| options.threads = Some(number as usize),
            get: |options| options.threads.map(|count| count as i64),
        },
    },
    Setting {
        name: "assets",
        words: "More folders from which pictures and meshes may be read, as absolute paths",
        default: Cow::Borrowed("[]"),
        kind: Kind::Folders {
            set: |options, folders| options.assets = folders,
            get: |options| &options.assets,
        },
    },
];

/// All settings other than keys.
pub(super) fn settings() -> impl Iterator<Item = Setting> {
    let rendering = RenderKey::listed().filter_map(|key| {
        let default = key.value(&Rendering::default());
        Some(Setting {
            name: key.name(),
            words: key.setting().config?,
            default: as_toml(key, default).into(),
            kind: Kind::Render(key),
        })
    });
    let interface = INTERFACE.iter().cloned();
    interface.chain(rendering).chain(MACHINE.iter().cloned())
}

/// The value of a render setting as TOML.
pub(super) fn as_toml(key: RenderKey, value: String) -> String {
    match key.setting().values {
        Values::Words { .. } => format!("\"{value}\""),
        _ => value,
    }
}

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
