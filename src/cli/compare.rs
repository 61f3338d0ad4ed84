//! The arguments of `compare`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::shared::{ReadingArguments, picture_format, whole_number};
use super::tracing::TracingArguments;
use batch::{Compare, Report, ReportFormat};

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight compare mine.bmp theirs.ppm
  halflight compare scene.ray reference.bmp --spp 1 --tolerance 2 --max-differing 20
  halflight compare before.xml after.xml --json -o difference.png
  halflight compare reference.ppm class/ --tolerance 2 --max-differing 50 --report class.html
  halflight compare solutions/ class/ --report class.csv --report class.xml

Of two files, a scene is traced with the settings recorded in the PNG or EXR it is compared with \
(size, view, samples and all others) unless an option overrides them. The defaults listed with the \
options apply only to settings that are not recorded. With other pictures it is traced at their \
size, unless --size or --region is given. The settings used are printed to standard error. Pictures \
are compared as they are displayed: with 8 bits per channel. The worst pixels listed come from \
different blocks of 16 × 16 pixels.

More files, folders and --report give a row for each submission: alike, different, or failed with \
its reason, which never ends the run. Folders are searched for pictures and scenes by their \
extensions; hidden files are left out and links are not followed. If REFERENCE is a folder, class/ann/glass.ppm is \
compared with ann/glass.ppm in it, else with glass.ppm, else with glass of another extension. The \
reference alone says how submitted scenes are traced, whatever they ask for: at its size and with its \
settings, but from their own views. If both are scenes, the row says where the rays of the worst pixel \
part. Names are printed with control characters escaped.

A report's extension is its format: .html is one page with small pictures, to sort and print; .csv \
follows RFC 4180, with an apostrophe before what would be a formula; .json is what --json prints of \
many: reference, tolerance, max_differing, the numbers alike, different and failed, and submissions, \
each with submission, reference, verdict, alike, size, differing, largest, mse, psnr (null if \
infinite), ssim, flip, worst, findings and reason; .xml is a JUnit report, in which different is a failure and failed \
an error.

Exit codes: 0 alike, 1 different, 2 wrong arguments, 65 invalid scene or picture, 66 not found or \
unreadable, 73 difference picture or report cannot be created, 74 write or system error. Nothing but a \
difference gives 1; of many, the code is that of the first that failed, else 1 if any is different.";

#[derive(Args, Debug)]
pub(super) struct CompareArguments {
    /// Picture or scene to compare with, or a folder of such
    #[arg(value_name = "REFERENCE")]
    reference: PathBuf,
    /// Pictures, scenes or folders of such to compare with it
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// Largest difference of a channel, in levels of 255, that does not count
    #[arg(long, value_name = "LEVELS", default_value_t = 0, allow_negative_numbers = true, value_parser = whole_number(0, u8::MAX))]
    tolerance: u8,
    /// Number of pixels that may differ by more than the tolerance
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true, value_parser = whole_number(0, usize::MAX))]
    max_differing: usize,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Also write a picture of the differences of two files: black where both agree, then blue, red, yellow and,
    /// from 64 levels, white
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write a report, in the format of its extension: .html, .csv, .json, or .xml
    /// for continuous integration; repeatable
    #[arg(long = "report", value_name = "FILE")]
    reports: Vec<PathBuf>,
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
        let reports = self.reports.into_iter().map(|path| {
            let format = report_format(&path)?;
            Ok::<_, String>((path, format))
        });
        Ok(Compare {
            reference: self.reference,
            submissions: self.submissions,
            tolerance: self.tolerance,
            max_differing: self.max_differing,
            report: if self.json {
                Report::Json
            } else {
                Report::Text
            },
            output: output.transpose()?,
            reports: reports.collect::<Result<_, _>>()?,
            tracing: self.tracing.into_tracing(),
            reading: self.reading.into_reading(),
        })
    }
}

/// The format of a report by its extension.
fn report_format(path: &Path) -> Result<ReportFormat, String> {
    let is_it = |extension: &str| {
        let own = path.extension().and_then(|own| own.to_str());
        own.is_some_and(|own| own.eq_ignore_ascii_case(extension))
    };
    let mut formats = ReportFormat::ALL.into_iter();
    let format = formats.find(|(_, extension)| is_it(extension));
    format.map(|(format, _)| format).ok_or_else(|| {
        let known = ReportFormat::ALL.map(|(_, extension)| format!(".{extension}"));
        let path = path.display();
        format!(
            "cannot tell the format of {path}: use the extension {}",
            text::alternatives(&known)
        )
    })
}
