//! Why files cannot be read, and how that is reported.

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::PathBuf;

use super::LIMITS;
use file::{ReadError, directory_of};
use image_file::{Unreadable, known_extensions};
use language::{FileKind, NamedFile};
use memory::OutOfMemory;
use text::{Diagnostic, Findings, without_codes};

/// The errors of pictures by name.
pub type PictureErrors = BTreeMap<String, PictureError>;

/// The error of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureError {
    /// The reason, as the end of a sentence.
    reason: String,
    /// What the user may do, or the paths tried.
    hint: Option<String>,
    /// What is shown instead.
    shown: Substitute,
}

/// What is shown instead of a picture that cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Substitute {
    /// Magenta, because no version could be read so far.
    Magenta,
    /// The last version that could be read.
    Last,
}

impl fmt::Display for Substitute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Magenta => "shown in magenta",
            Self::Last => "its last picture is kept",
        })
    }
}

impl PictureError {
    /// The warning at a place in the text that names the picture.
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

/// Adds the errors of a scene's pictures to the findings in its text, and names the files that these
/// are about by their paths in `places`.
pub fn report(
    picture_errors: &PictureErrors,
    files: &[NamedFile],
    places: &BTreeMap<String, PathBuf>,
    findings: Findings,
) -> Findings {
    let path = |name: &str| {
        let path = places.get(name)?;
        let short = path.strip_prefix(".").unwrap_or(path);
        Some(short.display().to_string())
    };
    let mut findings = findings.citing(path);
    if picture_errors.is_empty() {
        return findings;
    }
    for file in files.iter().filter(|file| file.kind == FileKind::Picture) {
        if let Some(error) = picture_errors.get(&file.path) {
            findings.warning(|| error.at(file));
        }
    }
    findings.sorted()
}

/// Why a file could not be read.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error("absolute paths are not allowed")]
    Absolute(PathBuf),
    #[error("is outside {allowed}")]
    Outside { real: PathBuf, allowed: String },
    /// With the paths that were tried.
    #[error("no such file")]
    Missing(Vec<PathBuf>),
    #[error("{}", without_codes(&.0.to_string()))]
    Io(io::Error),
    #[error("is {0}, not a file")]
    NotRegular(&'static str),
    #[error("the scene's files have more than {} MiB in total", LIMITS.bytes >> 20)]
    TooLong,
    #[error("the scene's meshes have more than {} triangles in total", LIMITS.triangles)]
    TooManyTriangles,
    #[error("{0}")]
    NoMemory(#[from] OutOfMemory),
    #[error("{0}")]
    Unreadable(#[from] Unreadable),
}

impl Failure {
    /// The error for a picture with this failure.
    pub(super) fn picture_error(&self, shown: Substitute) -> PictureError {
        PictureError {
            reason: self.to_string(),
            hint: self.hint(),
            shown,
        }
    }

    /// A hint for the user: the paths tried, or the remedy.
    pub(super) fn hint(&self) -> Option<String> {
        match self {
            Self::Missing(places) if !places.is_empty() => {
                let places = places.iter().map(|place| place.display().to_string());
                let places: Vec<_> = places.collect();
                Some(format!("looked for {}", places.join(", ")))
            }
            _ => self.remedy(),
        }
    }

    /// The option that would allow the file to be read.
    pub(super) fn remedy(&self) -> Option<String> {
        match self {
            Self::Absolute(real) | Self::Outside { real, .. } => {
                let folder = directory_of(real).display();
                Some(format!("allow it with --assets {folder}"))
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
            ReadError::NotFound { .. }
            | ReadError::NoFolder { .. }
            | ReadError::NotUtf8 { .. }
            | ReadError::Binary { .. } => Self::Missing(Vec::new()),
        }
    }
}
