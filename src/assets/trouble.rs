//! Why files are not read, and how that is told.

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::PathBuf;

use super::LIMITS;
use crate::file::{ReadError, directory_of};
use crate::image_file::{Unreadable, known_extensions};
use crate::language::{FileKind, NamedFile};
use crate::memory::OutOfMemory;
use crate::text::{Diagnostic, Findings, without_codes};

/// What is wrong with pictures, by name.
pub type Troubles = BTreeMap<String, Trouble>;

/// What is wrong with a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// What, as the end of a sentence.
    reason: String,
    /// What helps.
    hint: Option<String>,
    /// What is seen of it.
    shown: Shown,
}

/// What is seen of a picture that can't be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// The renderer's stand-in.
    Magenta,
    /// The last one that could.
    Last,
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Magenta => "magenta stands for it",
            Self::Last => "its last picture is kept",
        })
    }
}

impl Trouble {
    /// What is wrong, at a name's place in the text.
    pub(super) fn at(&self, file: &NamedFile) -> Diagnostic {
        let message = format!("{}: {}; {}", file.what, self.reason, self.shown);
        let expected = format!("a picture file: {}", known_extensions());
        let warning = Diagnostic::warning(file.span, message, expected);
        match &self.hint {
            Some(hint) => warning.with_hint(hint),
            None => warning,
        }
    }
}

/// Adds what is wrong with a scene's pictures to what is wrong with its text.
pub fn report(troubles: &Troubles, files: &[NamedFile], mut findings: Findings) -> Findings {
    if troubles.is_empty() {
        return findings;
    }
    for file in files.iter().filter(|file| file.kind == FileKind::Picture) {
        if let Some(trouble) = troubles.get(&file.path) {
            findings.warning(|| trouble.at(file));
        }
    }
    findings.sorted()
}

/// Why a file was not read.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error("an absolute path is not read")]
    Absolute(PathBuf),
    #[error("is outside {allowed}")]
    Outside { real: PathBuf, allowed: String },
    /// With the places where it was looked for.
    #[error("no such file")]
    Missing(Vec<PathBuf>),
    #[error("{}", without_codes(&.0.to_string()))]
    Io(io::Error),
    #[error("is {0}, not a file")]
    NotRegular(&'static str),
    #[error("the scene's files have more than {} MiB together", LIMITS.bytes >> 20)]
    TooLong,
    #[error("the scene's meshes have more than {} triangles together", LIMITS.triangles)]
    TooManyTriangles,
    #[error("{0}")]
    NoMemory(#[from] OutOfMemory),
    #[error("{0}")]
    Unreadable(#[from] Unreadable),
}

impl Failure {
    /// What it means for whoever looks at a picture.
    pub(super) fn trouble(&self, shown: Shown) -> Trouble {
        Trouble {
            reason: self.to_string(),
            hint: self.hint(),
            shown,
        }
    }

    /// What helps.
    pub(super) fn hint(&self) -> Option<String> {
        match self {
            Self::Missing(places) if !places.is_empty() => {
                let places = places.iter().map(|place| place.display().to_string());
                let places: Vec<_> = places.collect();
                Some(format!("it is looked for as {}", places.join(", ")))
            }
            _ => self.remedy(),
        }
    }

    /// How the file is read all the same.
    pub(super) fn remedy(&self) -> Option<String> {
        match self {
            Self::Absolute(real) | Self::Outside { real, .. } => {
                let folder = directory_of(real).display();
                Some(format!("--assets {folder} lets it be read"))
            }
            _ => None,
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::Missing(Vec::new()),
            _ => Self::Io(error),
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::NotRegular { kind, .. } => Self::NotRegular(kind),
            ReadError::TooLong { .. } => Self::TooLong,
            ReadError::Io { source, .. } => Self::Io(source),
            ReadError::NoMemory { reason, .. } => Self::NoMemory(reason),
            ReadError::NoThreads(reason) => Self::Io(io::Error::other(reason)),
            ReadError::NotFound { .. } | ReadError::NotUtf8 { .. } | ReadError::Binary { .. } => {
                Self::Missing(Vec::new())
            }
        }
    }
}
