//! The arguments of `explain`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{ReadingArguments, whole_number};
use super::tracing::SampleArguments;
use batch::{Explain, Report};
use scene::MAX_SPP;

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight explain scene.ray 400 300
  halflight explain scene.xml 12 40 --size 320x240 --integrator path --sample 3
  halflight explain scene.dat 0 0 --json

Prints a verdict, which says why the pixel is dark, bright or odd and what would change it, and the \
tree of rays behind one sample: what each hit, the light of every light factor by factor, and what \
blocks it. The root is the sample of the picture to the last bit; pixels are counted from the top \
left corner of the whole picture, from 0. Light is printed before exposure; the displayed colour \
and the words dark and bright apply after it.";

#[derive(Args, Debug)]
pub(super) struct ExplainArguments {
    /// Scene file: .ray, .dat, .xml or .test; or a mesh: .obj, .ply or .stl
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Column of the pixel, from 0 at the left
    #[arg(value_name = "X", allow_negative_numbers = true, value_parser = whole_number(0, u32::MAX))]
    x: u32,
    /// Row of the pixel, from 0 at the top
    #[arg(value_name = "Y", allow_negative_numbers = true, value_parser = whole_number(0, u32::MAX))]
    y: u32,
    /// Index of the sample, 0 to 65535: 0 is the centre of the pixel
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true, value_parser = whole_number(0, MAX_SPP - 1))]
    sample: u32,
    /// Print the explanation as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    samples: SampleArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl ExplainArguments {
    pub(super) fn into_explain(self) -> Explain {
        Explain {
            scene: self.scene,
            pixel: [self.x, self.y],
            sample: self.sample,
            report: if self.json {
                Report::Json
            } else {
                Report::Text
            },
            tracing: self.samples.into_tracing(),
            reading: self.reading.into_reading(),
        }
    }
}
