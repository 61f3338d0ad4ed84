//! Headless work, one file per command: check, render (a picture, a part of one, or a sequence), merge,
//! show, compare, explain, convert and bench. Knows no terminals, except for a progress line if
//! standard error is one. `render` is the longest: its file tells how it is planned and carried out.

mod as_recorded;
mod bench;
mod check;
mod compare;
mod convert;
mod explain;
mod finding;
mod folders;
mod machine;
mod merge;
mod messages;
mod output;
mod progress;
mod reading;
mod render;
mod report;
mod samples;
mod show;
mod signals;
mod stats;
mod stdout;
mod tracing;

use std::io;
use std::path::PathBuf;

use ::render::Refusal;
use assets::NoFolder;
pub use assets::Up;
use file::ReadError;
use image_file::Unreadable;
use language::UnknownLanguage;
use shards::Unmerged;
use text::{Diagnostic, counted, percentage};

pub use bench::{Bench, bench};
pub use check::{Check, check};
pub use compare::{Compare, Report, ReportFormat, Verdict, compare};
pub use convert::{Convert, convert};
pub use explain::{Explain, explain};
pub use merge::{Merge, MergePurpose, merge};
use messages::Messages;
pub use output::{Output, Target};
pub use progress::ProgressStyle;
pub use reading::{Reading, Warnings};
pub use render::{
    Existing, Finished, FrameSource, Parts, PictureWork, Purpose, Render, SequenceOutput,
    SequenceWork, Work, render,
};
pub use samples::{Samples, write_samples};
pub use show::{Show, show};
pub use signals::Signal;
pub use tracing::{Execution, Tracing};
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
    #[error("the scene has {}", counted(*.errors, "error"))]
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
    #[error("{} has no Halflight metadata", .0.display())]
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
        source: shards::Refused,
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
        signal.name(), match finished {
            Finished::Skipped => "",
            Finished::Rendered => "without --again ",
        }
    )]
    KeptFrames {
        /// The signal.
        signal: Signal,
        /// The number of the frame that was not finished.
        frame: u32,
        /// What became of frames that were finished before.
        finished: Finished,
    },
    /// The machine cannot trace the picture.
    #[error(transparent)]
    Untraced(#[from] Refusal),
    /// The renderer ended without a picture.
    #[error("the renderer stopped early; please report this with the scene")]
    Stopped,
}
