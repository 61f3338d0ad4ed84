//! The configuration: a TOML file with the user's preferences, among them keys. What is given on
//! the command line takes precedence over it, and it over the environment.
//!
//! Says where a file is wrong; prints a configuration and the keys. Knows settings and actions by their
//! names, but not what they do.

mod keys;
mod print;
mod read;
mod settings;
mod value;

#[cfg(test)]
mod tests;

use std::env;
use std::path::{Path, PathBuf};

use file::ReadError;
use text::Diagnostic;
use ui::Options;

pub use print::{print_config, print_keys};
pub use read::read;
pub use settings::{COLOURS, MAX_BANDWIDTH, MAX_THREADS, POLLS};

/// Where the configuration comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Source {
    /// `halflight/config.toml` in `$XDG_CONFIG_HOME` or in `~/.config`, if it exists; a place
    /// that cannot hold files, or another user's unreadable file, counts as none.
    #[default]
    Usual,
    /// This file.
    File(PathBuf),
    /// Nowhere: everything has its default.
    None,
}

/// The device that holds no configuration, as other programs take it.
const NOTHING: &str = "/dev/null";

/// Why a configuration cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file has errors.
    #[error("{name} has errors")]
    Faulty {
        /// Name of the file.
        name: String,
        /// Its text.
        text: String,
        /// The errors.
        errors: Vec<Diagnostic>,
    },
}

/// Completes options by a configuration.
pub fn complete(options: Options, source: &Source) -> Result<Options, Error> {
    Ok(options.or(load(source)?))
}

fn load(source: &Source) -> Result<Options, Error> {
    let path = match source {
        Source::None => None,
        Source::File(path) => Some(path.clone()),
        Source::Usual => place(),
    };
    let path = path.filter(|path| !file::is_same(path, Path::new(NOTHING)));
    let Some(path) = path else {
        return Ok(Options::default());
    };
    let text = match file::read_small_text(&path) {
        Ok(text) => text,
        Err(_) if *source == Source::Usual && !file::is_own(&path) => {
            return Ok(Options::default());
        }
        Err(error) => return Err(error.into()),
    };
    read(&text).map_err(|errors| Error::Faulty {
        name: path.display().to_string(),
        text,
        errors,
    })
}

/// The path of the usual file; `None` if no home is known.
pub fn place() -> Option<PathBuf> {
    let set = |name: &str| {
        let folder = env::var_os(name).map(PathBuf::from);
        folder.filter(|folder| folder.is_absolute())
    };
    let folder = set("XDG_CONFIG_HOME").or_else(|| Some(set("HOME")?.join(".config")));
    folder.map(|folder| folder.join("halflight").join("config.toml"))
}
