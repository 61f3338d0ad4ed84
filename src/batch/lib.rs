//! Headless work, a command a file: check, render (a picture, a part of one, or a sequence), merge,
//! show, compare, explain, convert and bench. Knows no terminals, except for a progress line if standard error is one.

mod animated;
mod bench;
mod compare;
mod convert;
mod explain;
mod finding;
mod frames;
mod graded;
mod ledger;
mod lists;
mod machine;
mod merge;
mod messages;
mod numbers;
mod output;
mod parts;
mod progress;
mod render;
mod report;
mod show;
mod signals;
mod stats;
mod stdout;
mod still;
mod tracing;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::render::Refusal;
use assets::{Assets, NoFolder};
use file::ReadError;
use image_file::Unreadable;
use language::{
    Language, Lowered, Node, Outlook, Prospect, Source, UnknownLanguage, errors_of_beginning,
    outlook,
};
use memory::OutOfMemory;
use part::Unmerged;
use scene::{Camera, Rendering, Scene, Size, Viewpoint};
use text::{Diagnostic, Findings, Span, counted, percentage};

use finding::Naming;

pub use bench::{Bench, bench};
pub use compare::{Compare, Report, Verdict, compare};
pub use convert::{Convert, convert};
pub use explain::{Explain, explain};
pub use frames::{Finished, FrameSource, Sequence, SequenceOutput, render_sequence};
pub use merge::{Merge, MergePurpose, merge};
use messages::Messages;
pub use output::Output;
pub use parts::{Existing, Parts};
pub use progress::ProgressStyle;
pub use render::{Purpose, Render, render};
pub use show::{Show, show};
pub use signals::Signal;
pub use tracing::Tracing;
pub use track::MAX_FRAMES;

/// Formats errors in a text for standard error, each with its place, an excerpt and a hint.
pub fn annotated(name: &str, text: &str, errors: &[Diagnostic]) -> String {
    report::render(name, text, errors, report::Style::of_error_stream())
}

/// Why headless work failed. The work has already printed it.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// An assets folder cannot be read.
    #[error(transparent)]
    Assets(#[from] NoFolder),
    /// A file whose extension is not that of a scene.
    #[error(transparent)]
    UnknownLanguage(#[from] UnknownLanguage),
    /// Scenes have errors, which were printed.
    #[error("nothing was rendered: the scene has {}", counted(*.errors, "error"))]
    Invalid {
        /// The number of errors.
        errors: usize,
    },
    /// A track has errors, which were printed.
    #[error("nothing was rendered: the track has {}", counted(*.errors, "error"))]
    InvalidTrack {
        /// The number of errors.
        errors: usize,
    },
    /// A file of a scene could not be read, which was printed.
    #[error("nothing was rendered: {needed_by} every file of the scene")]
    Incomplete {
        /// What it is needed by, with its verb.
        needed_by: &'static str,
    },
    /// A frame of a sequence cannot be rendered, for reasons that were printed; those before it are.
    #[error("frame {frame} was not rendered: {reason}")]
    NoFrame {
        /// The number of the frame.
        frame: u32,
        /// Why not.
        reason: String,
    },
    /// A scene has errors, or loses something in another language, all of which was printed.
    #[error("nothing was written: there {}", if *.errors == 1 { "is 1 error".to_owned() } else { format!("are {errors} errors") })]
    Unconverted {
        /// The number of errors.
        errors: usize,
    },
    /// The picture cannot be rendered, for a reason known before tracing.
    #[error("{0}")]
    Refused(String),
    /// A picture to compare cannot be decoded.
    #[error("{path} {source}", path = path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: Unreadable,
    },
    /// A picture does not say what it is made from.
    #[error("{} does not say what it is made from", .0.display())]
    NoProvenance(PathBuf),
    /// A file is of no format that says what a picture is made from.
    #[error("{} is not a PNG or EXR file", .0.display())]
    NeverRecorded(PathBuf),
    /// The picture file cannot be created.
    #[error("{path}: {source}", path = path.display())]
    Create {
        /// The file.
        path: PathBuf,
        /// The error of the file system.
        source: io::Error,
    },
    /// The picture cannot be written.
    #[error("{to}: {source}")]
    Write {
        /// The file name, or `standard output`.
        to: String,
        /// The error of the system.
        source: io::Error,
    },
    /// A part file cannot be written.
    #[error("{path}: {source}", path = path.display())]
    Part {
        /// The part file.
        path: PathBuf,
        /// Why not.
        source: part::Refused,
    },
    /// Parts cannot be merged.
    #[error(transparent)]
    Unmerged(#[from] Unmerged),
    /// A signal stopped the tracing, which can be continued.
    #[error(
        "stopped by {}; {} of the work is saved in {path}: rerun with --resume to continue",
        signal.name(), percentage(*done), path = path.display()
    )]
    Kept {
        /// The part file.
        path: PathBuf,
        /// The signal.
        signal: Signal,
        /// The fraction of the work done, 0 to 1.
        done: f64,
    },
    /// A signal stopped a sequence, whose finished frames are kept.
    #[error(
        "stopped by {} at frame {frame}; finished frames are kept: rerun {}to continue",
        signal.name(), if *is_again { "without --again " } else { "" }
    )]
    KeptFrames {
        /// The signal.
        signal: Signal,
        /// The number of the frame that was not finished.
        frame: u32,
        /// Whether finished frames were rendered again.
        is_again: bool,
    },
    /// The machine cannot trace the picture.
    #[error(transparent)]
    Untraced(#[from] Refusal),
    /// The renderer ended without a picture.
    #[error("the renderer stopped early; please report this with the scene")]
    Stopped,
}

/// How warnings of a scene are treated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Warnings {
    /// Reported only.
    #[default]
    Allowed,
    /// Treated as errors.
    Refused,
}

impl Warnings {
    /// Turns warnings into errors if they are refused.
    fn apply(self, findings: Findings) -> Findings {
        match self {
            Self::Allowed => findings,
            Self::Refused => findings.strict(),
        }
    }
}

/// Scenes to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// The scene files.
    pub scenes: Vec<PathBuf>,
    /// How their warnings are treated.
    pub warnings: Warnings,
    /// Additional folders that referenced files may be read from.
    pub assets: Vec<PathBuf>,
}

/// Reads scenes and the files they reference, and prints all findings and a summary to standard
/// error. Every scene is checked. Returns the error of the first scene that is unreadable or
/// invalid; [`Error::Invalid`] counts the errors of all scenes.
pub fn check(work: &Check) -> Result<(), Error> {
    memory::start_threads_or_none();
    if let Err(error) = assets::check_folders(&work.assets) {
        let error = error.into();
        Messages::Text.error(&error);
        return Err(error);
    }
    let mut first = None;
    let mut errors = 0;
    let mut warnings = 0;
    for path in &work.scenes {
        match load(
            Messages::Text,
            path,
            &work.assets,
            work.warnings,
            Some(&Over::default()),
        ) {
            Ok(mut loaded) => {
                errors += loaded.findings.errors();
                warnings += loaded.findings.warnings();
                if 0 < loaded.findings.errors() {
                    first.get_or_insert(Error::Invalid { errors: 0 });
                }
                finding::print_of_scene(path, &mut loaded, &Tracing::of_scene(), Naming::File);
            }
            Err(Error::Invalid { errors: more }) => {
                errors += more;
                first.get_or_insert(Error::Invalid { errors: 0 });
            }
            Err(error) => {
                errors += 1;
                Messages::Text.error(&error);
                first.get_or_insert(error);
            }
        }
    }
    messages::print(&format!(
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

/// A scene that was read.
struct Loaded {
    /// `None` if there are errors.
    scene: Option<Scene>,
    /// The files it references.
    read: assets::Loaded,
    /// Slow to free for a large scene.
    source: Source,
    /// The span that sets the size of the picture, if there is one.
    size: Option<Span>,
    /// All of its findings, which were printed.
    findings: Findings,
    /// What the text shows of its picture.
    prospects: Vec<Prospect>,
}

/// What takes precedence over what a text says of its picture.
#[derive(Clone, Debug, Default)]
struct Over {
    rendering: Rendering,
    view: Viewpoint,
    size: Option<Size>,
}

impl Over {
    /// The camera in effect, given the scene's own; otherwise what is wrong with the view.
    fn camera(&self, own: &Camera) -> Result<Camera, &'static str> {
        let size = self.size.unwrap_or(own.size);
        // The requested size sets the aspect ratio.
        self.view.of(own).map(|camera| Camera { size, ..camera })
    }
}

/// Reads a scene and the files it references, from `folders` too, and prints all findings,
/// including those about the resulting picture, with `over` in precedence to the text's settings,
/// if given.
fn load(
    messages: Messages,
    path: &Path,
    folders: &[PathBuf],
    warnings: Warnings,
    over: Option<&Over>,
) -> Result<Loaded, Error> {
    let language = Language::of_path(path).map_err(|unknown| {
        // An error in opening the file comes before its extension.
        file::open(path).map_or_else(Error::from, |_| unknown.into())
    })?;
    if let Some(beginning) = file::read_beginning(path)? {
        check_beginning(messages, path, language, &beginning, warnings)?;
    }
    let text = file::read_text(path)?;
    for copy in file::backups(path) {
        messages.note(&file::interruption(path.display(), &copy));
    }
    let no_memory = |reason| ReadError::NoMemory {
        path: path.to_owned(),
        reason,
    };
    language::fits(language, &text, 0).map_err(no_memory)?;
    let mut source = Source::new(language, Arc::new(text));
    let (lowered, read) = lower(messages, path, &mut source, folders).map_err(no_memory)?;
    let mut findings = lowered.diagnostics;
    let mut prospects = Vec::new();
    if let Some((scene, over)) = lowered.scene.as_ref().zip(over) {
        let asked = over.rendering.or(scene.setting.rendering);
        // A view that cannot be is refused later.
        let camera = over.camera(&scene.camera).unwrap_or(scene.camera);
        for Outlook { warning, prospect } in outlook(&source, scene, &camera, &asked) {
            findings.warning(|| warning);
            prospects.push(prospect);
        }
    }
    let findings = warnings.apply(findings.sorted());
    messages.all_findings(path, source.text(), &findings);
    Ok(Loaded {
        size: size_span(&source),
        scene: lowered.scene.filter(|_| findings.errors() == 0),
        read,
        findings,
        prospects,
        source,
    })
}

/// Checks the beginning of a long scene, so that the rest is not read if nothing in it can correct
/// the errors. Prints them.
fn check_beginning(
    messages: Messages,
    path: &Path,
    language: Language,
    beginning: &str,
    warnings: Warnings,
) -> Result<(), Error> {
    let findings = errors_of_beginning(language, beginning);
    if findings.errors() == 0 {
        return Ok(());
    }
    let findings = warnings.apply(findings);
    messages.all_findings(path, beginning, &findings);
    let read = counted(beginning.len(), "byte");
    let note = format!("{}: only the first {read} were read", path.display());
    messages.note(&note);
    Err(Error::Invalid {
        errors: findings.errors(),
    })
}

/// Lowers a text with the files it references, and returns both. The diagnostics include those of the
/// files; files found elsewhere than at the path written are printed as notes.
fn lower(
    messages: Messages,
    path: &Path,
    source: &mut Source,
    folders: &[PathBuf],
) -> Result<(Lowered, assets::Loaded), OutOfMemory> {
    let (lowered, loaded) = Assets::new(folders).lower(path, source)?;
    for (name, found) in &loaded.elsewhere {
        let found = match found.parent() {
            Some(parent) if parent.as_os_str().is_empty() => Path::new(".").join(found),
            _ => found.clone(),
        };
        messages.note(&format!("{name} is read from {}", found.display()));
    }
    Ok((lowered, loaded))
}

/// The span that sets the size of the picture, if there is one.
fn size_span(source: &Source) -> Option<Span> {
    let view = source.fields(Node::View);
    let written = view.iter().filter(|placed| placed.is_explicit());
    let sizes = written.filter(|placed| placed.field.kind.is_size());
    sizes
        .flat_map(|size| size.spans.iter().copied())
        .reduce(Span::to)
}
