//! Merges part files to a picture.

use std::path::PathBuf;

use super::finding::print_biases;
use super::output::Target;
use super::{Error, Messages, stdout};
use image_file::Picture;
use shards::ranges;

/// Part files to merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merge {
    /// The part files, in any order.
    pub parts: Vec<PathBuf>,
    /// What to do with them.
    pub purpose: MergePurpose,
}

/// What to do with part files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MergePurpose {
    /// Write the picture.
    Write(Target),
    /// Print which shards have blocks that are missing.
    Missing,
}

/// Merges part files, or prints what they lack.
pub fn merge(work: &Merge) -> Result<(), Error> {
    try_merge(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_merge(work: &Merge) -> Result<(), Error> {
    match &work.purpose {
        MergePurpose::Write(target) => {
            target.output.check()?;
            target
                .output
                .check_is_not(&work.parts, "it is one of the parts")?;
            let merged = shards::merge(&work.parts, target.format.frames())?;
            print_biases(Messages::Text, &merged.frame, &merged.picture);
            if let Some(reason) = target.format.refuses(merged.frame.size) {
                return Err(Error::Refused(format!("the picture is {reason}")));
            }
            target.write(Picture {
                provenance: Some(&merged.picture),
                ..Picture::of(&merged.frame)
            })
        }
        MergePurpose::Missing => {
            let (shards, damaged) = shards::missing(&work.parts)?;
            for damage in damaged {
                Messages::Text.note(&damage.to_string());
            }
            let line = match ranges(&shards) {
                none if none.is_empty() => none,
                ranges => ranges + "\n",
            };
            stdout::print(&line).map_err(stdout::error)
        }
    }
}
