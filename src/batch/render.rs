//! `halflight render`, from its arguments to its files: planned once, then carried out.
//!
//! ```text
//!                ┌▶ Estimate    printed
//! Render ─▶ Plan ┼▶ Picture     traced as a whole, or block by block into a part file; written
//!                ├▶ Numbered    each frame that is not finished is planned, traced, written, listed
//!                └▶ Movie       each frame is planned, traced, added to the file
//! ```
//!
//! [`plan`] consumes the arguments: what carries a plan out has nothing else to go by. It reads the
//! scene, and refuses whatever can be refused before tracing, in the order of its checks. The frames
//! of a sequence are planned there too, but each when its turn comes, because their scenes are read
//! one after the other.

mod animated;
mod arguments;
mod frames;
mod ledger;
mod lists;
mod numbers;
mod parts;
mod picture;
mod plan;
mod sequence;
mod shot;
mod tally;

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::output::{Output, Target};
use super::stats::Times;
use super::tracing::{Execution, Still};
use super::{Error, stdout};
use image_file::{ImageFormat, MovieFormat, Pattern};
use language::{Prospect, Source};

use ledger::Ledger;
use parts::Opened;
use sequence::Sequence;

pub use arguments::{
    Existing, Finished, FrameSource, Parts, PictureWork, Purpose, Render, SequenceOutput,
    SequenceWork, Work,
};

/// Renders a picture or a sequence. Warnings, notes and progress go to standard error. A reader that
/// closes the pipe early is not an error. If interrupted, leaves of each file either the old or the
/// new one, see [`deliver`](file::deliver).
pub fn render(asked: Render) -> Result<(), Error> {
    let messages = asked.tracing.execution.messages();
    let done = Plan::of(asked).and_then(Plan::carry_out);
    done.inspect_err(|error| messages.error(error))
}

/// What is to be done; only the frames of sequences are still to be planned.
enum Plan {
    /// Print about how many bytes of memory a picture would take.
    Estimate(u64),
    /// Trace and write a picture.
    Picture(Box<PicturePlan>, Way),
    /// Trace and write the frames of a sequence, a file each.
    Numbered(NumberedPlan),
    /// Trace the frames of a sequence and write them to one file.
    Movie(MoviePlan),
}

impl Plan {
    fn of(asked: Render) -> Result<Self, Error> {
        let Render {
            work,
            tracing,
            reading,
        } = asked;
        match work {
            Work::Picture(work) => plan::picture(work, &tracing, &reading),
            Work::Sequence(work) => plan::sequence(work, tracing, reading),
        }
    }

    fn carry_out(self) -> Result<(), Error> {
        match self {
            Self::Estimate(bytes) => {
                // As batch systems take it.
                let line = format!("{}M\n", bytes.div_ceil(1 << 20));
                stdout::print(&line).map_err(stdout::error)
            }
            Self::Picture(plan, way) => picture::render(*plan, way),
            Self::Numbered(plan) => frames::numbered(plan),
            Self::Movie(plan) => frames::movie(plan),
        }
    }
}

/// A picture, or a part of one, whose scene is read.
struct PicturePlan {
    /// The scene file.
    scene: PathBuf,
    /// What the scene's text shows of the picture.
    prospects: Vec<Prospect>,
    still: Still,
    execution: Execution,
    /// Where the picture goes, unless only a part of it is traced.
    target: Target,
    /// Where figures about the render go.
    stats: Option<Output>,
    /// The bytes of memory that it takes, about.
    estimate: u64,
    times: Times,
}

/// The way in which a picture is traced.
enum Way {
    /// In passes over all of it. The digest of its scene is computed meanwhile.
    Whole {
        source: Source,
        /// The files that the scene references, by name.
        found: BTreeMap<String, PathBuf>,
    },
    /// Block by block, into a part file.
    Part {
        /// The text of the scene, if it is short.
        source: Option<Source>,
        part: Box<Opened>,
    },
}

/// A sequence of pictures, and what tells which of them are finished.
struct NumberedPlan {
    sequence: Sequence,
    /// The names of the pictures.
    pattern: Pattern,
    format: ImageFormat,
    finished: Finished,
    ledger: Ledger,
}

/// A sequence in one file.
struct MoviePlan {
    sequence: Sequence,
    to: Output,
    format: MovieFormat,
    /// Frames per second.
    rate: u32,
}
