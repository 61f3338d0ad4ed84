//! Where headless work writes to.

use std::io;
use std::path::{Path, PathBuf};

use super::{Error, stdout};
use file::Content;
use image_file::{ImageFormat, Picture};

/// A file or standard output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// A file, replaced once its new content is complete.
    File(PathBuf),
    /// Standard output, unless it is a terminal.
    Stdout,
    /// Standard output, even if it is a terminal.
    StdoutTerminal,
}

/// A picture file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// Where the picture goes.
    pub output: Output,
    /// Its format.
    pub format: ImageFormat,
}

impl Target {
    pub(super) fn write(&self, picture: Picture<'_>) -> Result<(), Error> {
        self.output
            .write(&mut |out| self.format.write(picture, out))
    }
}

impl Output {
    /// Checks before any work that this can be written to.
    pub(super) fn check(&self) -> Result<(), Error> {
        match self {
            Self::File(path) => file::check_target(path).map_err(|source| Error::Create {
                path: path.clone(),
                source,
            }),
            Self::Stdout if stdout::is_terminal() => Err(Error::Refused(
                "standard output is a terminal; use -o FILE, a pipe, or --force".to_owned(),
            )),
            Self::Stdout | Self::StdoutTerminal => stdout::check().map_err(stdout::error),
        }
    }

    /// Refuses to overwrite a scene, or a file that it references.
    pub(super) fn check_spares(&self, scene: &Path, files: &[PathBuf]) -> Result<(), Error> {
        self.check_is_not(&[scene], "it is the scene itself")?;
        self.check_is_not(files, "the scene uses it")
    }

    /// Refuses to overwrite any of these files, for this reason.
    pub(super) fn check_is_not(
        &self,
        inputs: &[impl AsRef<Path>],
        reason: &str,
    ) -> Result<(), Error> {
        match self {
            Self::File(path)
                if inputs
                    .iter()
                    .any(|input| file::is_same(path, input.as_ref())) =>
            {
                Err(Error::Refused(format!(
                    "cannot overwrite {}: {reason}; name another file",
                    path.display()
                )))
            }
            Self::File(_) | Self::Stdout | Self::StdoutTerminal => Ok(()),
        }
    }

    /// Refuses to write where something else is written, for this reason.
    pub(super) fn check_is_apart(&self, other: &Path, reason: &str) -> Result<(), Error> {
        match self {
            Self::File(path) if file::is_same_target(path, other) => Err(Error::Refused(format!(
                "cannot write {}: {reason}; name another file",
                path.display()
            ))),
            Self::File(_) | Self::Stdout | Self::StdoutTerminal => Ok(()),
        }
    }

    /// Writes. A reader that closes the pipe early is not an error.
    pub(super) fn write(&self, write: &mut Content<'_>) -> Result<(), Error> {
        let written = match self {
            Self::File(path) => file::deliver(path, write, &|| Ok(())).map(drop),
            Self::Stdout | Self::StdoutTerminal => stdout::write(write),
        };
        written.or_else(|source| match (source.kind(), self) {
            (io::ErrorKind::BrokenPipe, _) => Ok(()),
            (_, Self::Stdout | Self::StdoutTerminal) => Err(stdout::error(source)),
            (
                io::ErrorKind::NotFound
                | io::ErrorKind::PermissionDenied
                | io::ErrorKind::ReadOnlyFilesystem,
                Self::File(path),
            ) => Err(Error::Create {
                path: path.clone(),
                source,
            }),
            (_, Self::File(path)) => Err(Error::Write {
                to: path.display().to_string(),
                source,
            }),
        })
    }
}
