//! Many comparisons as documents. Whatever names and scenes contain, it is text in them.

mod csv;
mod html;
mod junit;
mod markup;

use serde_json::{Value, json};

use super::Verdict;
use super::compared::Class;
use super::row::{Row, Tally, shown};
use ::compare::Comparison;
use scene::Size;

/// The formats of documents, by their extensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    /// One self-contained page with small pictures, to read, sort and print.
    Html,
    /// A table for spreadsheets, by RFC 4180.
    Csv,
    /// What `--json` prints.
    Json,
    /// Tests as of `JUnit`, for continuous integration.
    Xml,
}

impl ReportFormat {
    /// All of them, with their extensions.
    pub const ALL: [(Self, &str); 4] = [
        (Self::Html, "html"),
        (Self::Csv, "csv"),
        (Self::Json, "json"),
        (Self::Xml, "xml"),
    ];

    /// The document.
    pub(super) fn text(self, class: &Class<'_>) -> String {
        match self {
            Self::Html => html::page(class),
            Self::Csv => csv::table(class),
            Self::Json => json(class),
            Self::Xml => junit::suite(class),
        }
    }
}

/// All of it as JSON. The keys are part of the interface of the command.
pub(super) fn json(class: &Class<'_>) -> String {
    let Tally {
        alike,
        different,
        failed,
    } = Tally::of(&class.rows);
    let object = json!({
        "reference": class.work.reference.to_string_lossy(),
        "tolerance": class.work.tolerance,
        "max_differing": class.work.max_differing,
        "alike": alike,
        "different": different,
        "failed": failed,
        "submissions": class.rows.iter().map(submission).collect::<Value>(),
    });
    format!("{object:#}\n")
}

fn submission(row: &Row) -> Value {
    let size = |size: Size| json!([size.width, size.height]);
    let found = row.comparison();
    // Infinity is no number of JSON.
    let psnr = found.map(Comparison::psnr).filter(|psnr| psnr.is_finite());
    json!({
        "submission": row.submission.to_string_lossy(),
        "reference": row.reference.as_ref().map(|path| path.to_string_lossy()),
        "verdict": row.verdict_word(),
        "alike": row.verdict().map(|verdict| verdict == Verdict::Alike),
        "size": found.map(|found| size(found.size)),
        "differing": found.map(|found| found.differing),
        "largest": found.map(|found| found.largest),
        "mse": found.map(|found| found.mse),
        "psnr": psnr,
        "ssim": found.and_then(|found| found.ssim),
        "flip": found.map(|found| found.flip),
        "worst": row.worst().map(|worst| json!({
            "x": worst.x,
            "y": worst.y,
            "reference": worst.colours[0],
            "submission": worst.colours[1],
        })),
        "findings": row.findings.map(|counts| json!({
            "errors": counts.errors,
            "warnings": counts.warnings,
            "notes": counts.notes,
        })),
        "reason": row.reason(),
    })
}

/// A row in words for where there is no table.
fn summary(row: &Row) -> String {
    let figures = row.comparison().map(|found| {
        let figures = found.figures();
        let figures = figures
            .iter()
            .map(|(name, value)| format!("{name} {value}"));
        let figures: Vec<_> = figures.collect();
        format!("{} differ, {}", found.differing_words(), figures.join(", "))
    });
    let findings = Some(row.findings_words()).filter(|words| !words.is_empty());
    let parts = [row.reason(), figures, findings];
    let parts: Vec<_> = parts.into_iter().flatten().collect();
    parts.join("; ")
}

/// The name of a submission, and of its reference.
fn names(row: &Row) -> [String; 2] {
    let reference = row.reference.as_deref().map(shown);
    [shown(&row.submission), reference.unwrap_or_default()]
}
