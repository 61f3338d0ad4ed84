//! Headless work: check and render. Knows no terminals, but for a progress line where the error
//! stream is one.

mod progress;
mod render;
mod report;
mod stdout;
mod threads;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::assets::{self, Assets, NoFolder, Wanted};
use crate::file::{self, ReadError};
use crate::language::{
    self, Language, Lowered, Node, Source, UnknownLanguage, errors_of_beginning,
};
use crate::memory::OutOfMemory;
use crate::render::Refusal;
use crate::scene::{Images, Meshes, Scene};
use crate::text::{Diagnostic, Findings, Span, counted, visible, without_codes};

pub use render::{Output, Render, render};

/// Why headless work did not come to its end. Whoever gets it has nothing to print: the work did.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene can't be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A folder to read from can't be read.
    #[error(transparent)]
    Assets(#[from] NoFolder),
    /// A file that is not a scene by its name.
    #[error(transparent)]
    UnknownLanguage(#[from] UnknownLanguage),
    /// Scenes have errors, which were printed.
    #[error("no picture was made: the scene has {}", counted(*.errors, "error"))]
    Invalid {
        /// How many.
        errors: usize,
    },
    /// The picture asked for can't be made, for a reason known before tracing.
    #[error("{0}")]
    Refused(String),
    /// There can be no file of that name.
    #[error("{path}: {source}", path = path.display())]
    Create {
        /// The file.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
    /// The picture can't be written.
    #[error("{to}: {source}")]
    Write {
        /// Where to: a file's name, or what else it is.
        to: String,
        /// What the system said.
        source: io::Error,
    },
    /// The machine can't trace the picture.
    #[error(transparent)]
    Untraced(#[from] Refusal),
    /// The renderer ended without a picture.
    #[error("the renderer stopped early; please report this with the scene")]
    Stopped,
}

/// How warnings of a scene are treated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Warnings {
    /// They are reported only.
    #[default]
    Allowed,
    /// They are errors.
    Refused,
}

impl Warnings {
    /// The same findings under this treatment.
    fn judge(self, findings: Findings) -> Findings {
        match self {
            Self::Allowed => findings,
            Self::Refused => findings.strict(),
        }
    }
}

/// Bytes of a scene that may be read with several threads. Starting them costs a small one too much.
const LARGE: u64 = 1 << 14;

/// Scenes to look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// The scene files.
    pub scenes: Vec<PathBuf>,
    /// How their warnings are treated.
    pub warnings: Warnings,
    /// Folders that the files they name may be read from besides their surroundings.
    pub assets: Vec<PathBuf>,
}

/// Reads scenes with the files they name and prints what is wrong with them, then a line that sums it
/// up, all to the error stream. Every scene is looked at. The error of the first scene that can't be
/// read or is wrong is returned; for wrong ones, with the errors of all.
pub fn check(work: &Check) -> Result<(), Error> {
    if let Err(error) = assets::check_folders(&work.assets) {
        let error = error.into();
        tell_error(&error);
        return Err(error);
    }
    let mut first = None;
    let mut errors = 0;
    let mut warnings = 0;
    for path in &work.scenes {
        match load(path, &work.assets, work.warnings) {
            Ok(loaded) => {
                errors += loaded.errors;
                warnings += loaded.warnings;
                if 0 < loaded.errors {
                    first.get_or_insert(Error::Invalid { errors: 0 });
                }
            }
            Err(Error::Invalid { errors: more }) => {
                errors += more;
                first.get_or_insert(Error::Invalid { errors: 0 });
            }
            Err(error) => {
                errors += 1;
                tell_error(&error);
                first.get_or_insert(error);
            }
        }
    }
    print(&format!(
        "{} checked: {}, {}",
        counted(work.scenes.len(), "scene"),
        counted(errors, "error"),
        counted(warnings, "warning"),
    ));
    match first {
        None => Ok(()),
        Some(Error::Invalid { .. }) => Err(Error::Invalid { errors }),
        Some(error) => Err(error),
    }
}

/// A scene file as far as it was understood.
struct Loaded {
    /// `None` where there are errors.
    scene: Option<Scene>,
    /// The pictures of its textures.
    images: Images,
    /// Where the files stand that it names.
    files: Vec<PathBuf>,
    /// Of a large scene it takes long to free.
    source: Source,
    /// Where the text says the picture's size, if it does.
    size: Option<Span>,
    errors: usize,
    warnings: usize,
}

/// Reads a scene with the files it names, from `folders` too, and prints what is wrong with it.
fn load(path: &Path, folders: &[PathBuf], warnings: Warnings) -> Result<Loaded, Error> {
    let language = Language::of_path(path).map_err(|unknown| {
        // What can't be opened is not a scene under any name.
        file::open(path).map_or_else(Error::from, |_| unknown.into())
    })?;
    if let Some(beginning) = file::read_beginning(path)? {
        check_beginning(path, language, &beginning, warnings)?;
    }
    if LARGE < path.metadata().map_or(0, |metadata| metadata.len()) {
        threads::settle();
    }
    let text = file::read_text(path)?;
    for copy in file::backups(path) {
        tell("note", &file::interruption(path.display(), &copy));
    }
    let no_memory = |reason| ReadError::NoMemory {
        path: path.to_owned(),
        reason,
    };
    language::fits(language, &text, 0).map_err(no_memory)?;
    let mut source = Source::new(language, Arc::new(text));
    let (lowered, images, files) = mean(path, &mut source, folders).map_err(no_memory)?;
    let findings = warnings.judge(lowered.diagnostics);
    print_all_findings(path, source.text(), &findings);
    let (errors, warnings) = (findings.errors(), findings.warnings());
    Ok(Loaded {
        size: size_place(&source),
        scene: lowered.scene.filter(|_| errors == 0),
        images,
        files,
        errors,
        warnings,
        source,
    })
}

/// Checks the beginning of a long scene, so that the rest is not read if that can't help. Prints the
/// errors.
fn check_beginning(
    path: &Path,
    language: Language,
    beginning: &str,
    warnings: Warnings,
) -> Result<(), Error> {
    let findings = errors_of_beginning(language, beginning);
    if findings.errors() == 0 {
        return Ok(());
    }
    let findings = warnings.judge(findings);
    print_all_findings(path, beginning, &findings);
    let read = counted(beginning.len(), "byte");
    let note = format!("only the first {read} of {} were read", path.display());
    tell("note", &note);
    Err(Error::Invalid {
        errors: findings.errors(),
    })
}

/// What a text means with the files it names, the pictures among these, and where all of them
/// stand. All that is wrong with any of them is among its diagnostics; prints which were found
/// elsewhere than by their names.
fn mean(
    path: &Path,
    source: &mut Source,
    folders: &[PathBuf],
) -> Result<(Lowered, Images, Vec<PathBuf>), OutOfMemory> {
    let mut assets = Assets::new(folders);
    let mut lowered = source.lower(&Meshes::default())?;
    let mut files = source.files();
    let mut wanted = Wanted::new(path, &files);
    if !files.is_empty() {
        threads::settle();
    }
    let mut loaded = assets.read(&wanted);
    if !wanted.meshes.is_empty() {
        lowered = source.lower(&loaded.meshes)?;
        // Meshes may name pictures.
        files = source.files();
        let named = wanted;
        wanted = Wanted::new(path, &files);
        if wanted != named {
            loaded = assets.read(&wanted);
        }
    }
    lowered.diagnostics = assets::report(&loaded.troubles, &files, lowered.diagnostics);
    for (name, place) in &loaded.elsewhere {
        tell("note", &format!("{name} is read from {}", place.display()));
    }
    Ok((lowered, loaded.images, loaded.files))
}

/// Where a text says the picture's size, if it does.
fn size_place(source: &Source) -> Option<Span> {
    let view = source.fields(Node::View);
    let said = view.iter().filter(|placed| placed.is_said());
    let sizes = said.filter(|placed| placed.field.kind.is_size());
    sizes
        .flat_map(|size| size.spans.iter().copied())
        .reduce(Span::to)
}

/// Prints the findings that are kept, and how many more there are.
fn print_all_findings(path: &Path, text: &str, findings: &Findings) {
    print_findings(path, text, findings);
    let more = findings.errors() + findings.warnings() - findings.len();
    if 0 < more {
        let more = counted(more, "more finding");
        tell("note", &format!("{more} not shown"));
    }
}

fn print_findings(path: &Path, text: &str, findings: &[Diagnostic]) {
    print(&report::render(
        &path.to_string_lossy(),
        text,
        findings,
        report::Style::of_error_stream(),
    ));
}

/// Prints an error; of a file that is not text, with the line in question.
fn tell_error(error: &Error) {
    let Error::Read(ReadError::NotUtf8 {
        path,
        text,
        span,
        byte,
        encoding,
        ..
    }) = error
    else {
        tell("error", &error.to_string());
        return;
    };
    let message = format!("the byte 0x{byte:02X} is not UTF-8 text");
    let wrong = Diagnostic::error(*span, message, "UTF-8 text").with_hint(format!(
        "convert the file, for example with: iconv -f {encoding} -t UTF-8"
    ));
    print_findings(path, text, &[wrong]);
}

/// Prints one line about the whole work: `error: no such file`.
fn tell(kind: &str, message: &str) {
    print(&format!("{kind}: {}", visible(&without_codes(message))));
}

/// Prints lines to the error stream. There is nobody to tell if that fails.
fn print(lines: &str) {
    if !lines.is_empty() {
        let _ = writeln!(io::stderr().lock(), "{lines}");
    }
}
