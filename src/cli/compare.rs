//! The arguments of `compare`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{ReadingArguments, picture_format, whole_number};
use super::tracing::TracingArguments;
use batch::{Compare, Report};

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight compare mine.bmp theirs.ppm
  halflight compare scene.ray reference.bmp --spp 1 --tolerance 2 --max-differing 20
  halflight compare before.xml after.xml --json -o difference.png

A scene is traced with the settings recorded in the PNG or EXR it is compared with (size, view, \
samples and all others) unless an option overrides them. The defaults listed with the options \
apply only to settings that are not recorded. With other pictures it is traced at their size, \
unless --size or --region is given. The settings used are printed to standard error. Pictures are \
compared as they are displayed: with 8 bits per channel. The worst pixels listed come from \
different blocks of 16 × 16 pixels.

Exit codes: 0 alike, 1 different, 2 wrong arguments, 65 invalid scene or picture, 66 not found or \
unreadable, 73 difference picture cannot be created, 74 write or system error. Nothing but a \
difference gives 1.";

#[derive(Args, Debug)]
pub(super) struct CompareArguments {
    /// Picture or scene
    #[arg(value_name = "A")]
    a: PathBuf,
    /// Picture or scene to compare it with
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Largest difference of a channel, in levels of 255, that does not count
    #[arg(long, value_name = "LEVELS", default_value_t = 0, allow_negative_numbers = true, value_parser = whole_number(0, u8::MAX))]
    tolerance: u8,
    /// Number of pixels that may differ by more than the tolerance
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true, value_parser = whole_number(0, usize::MAX))]
    max_differing: usize,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Also write a picture of the differences: black where both agree, then blue, red, yellow and,
    /// from 64 levels, white
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    tracing: TracingArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl CompareArguments {
    pub(super) fn into_compare(self) -> Result<Compare, String> {
        let output = self.output.map(|path| {
            let format = picture_format(&path)?;
            Ok::<_, String>((path, format))
        });
        Ok(Compare {
            sides: [self.a, self.b],
            tolerance: self.tolerance,
            max_differing: self.max_differing,
            report: if self.json {
                Report::Json
            } else {
                Report::Text
            },
            output: output.transpose()?,
            tracing: self.tracing.into_tracing(),
            reading: self.reading.into_reading(),
        })
    }
}
