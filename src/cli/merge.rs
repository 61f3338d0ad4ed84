//! The arguments of `merge`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{format_names, output_help, target};
use batch::{Merge, MergePurpose};
use image_file::ImageFormat;

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight render scene.ray -o scene.png --shard 0/2     on one machine
  halflight render scene.ray -o scene.png --shard 1/2     on another
  halflight merge scene.*.part -o scene.png               the same bytes as from one
  halflight merge --missing scene.*.part                  the shards to run again: 3,7-9

Exit code 3 means that the parts cannot be merged: some are missing, damaged, incomplete, traced to \
different numbers of samples or of another picture. With --missing it means that they are of different \
pictures, or that none is a part; shards that are missing give 0, like none.";

#[derive(Args, Debug)]
pub(super) struct MergeArguments {
    /// Part files, in any order
    #[arg(required = true, value_name = "PART")]
    parts: Vec<PathBuf>,
    #[arg(short, long, value_name = "FILE", help = output_help(), required_unless_present = "missing")]
    output: Option<PathBuf>,
    /// Picture format, regardless of the file's extension [default for -o -: bmp]
    #[arg(long, value_name = "FORMAT", value_parser = format_names(), requires = "output")]
    format: Option<ImageFormat>,
    /// List incomplete shards in the form --array takes, instead of merging
    #[arg(long, conflicts_with = "output")]
    missing: bool,
    /// Write to standard output even if it is a terminal
    #[arg(long, requires = "output")]
    force: bool,
}

impl MergeArguments {
    pub(super) fn into_merge(self) -> Result<Merge, String> {
        let purpose = match self.output {
            None => MergePurpose::Missing,
            Some(path) => MergePurpose::Write(target(path, self.format, self.force)?),
        };
        Ok(Merge {
            parts: self.parts,
            purpose,
        })
    }
}
