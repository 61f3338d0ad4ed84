//! Many comparisons as a table for people.

use std::fmt::Write;

use super::compared::Class;
use super::row::{Row, Tally, shown};

/// A line for each submission, below it why it is not alike, and the numbers of all at the end.
pub(super) fn table(class: &Class<'_>) -> String {
    let mut text = format!(
        "{:<11}{:>9}{:>9}{:>9}{:>10}{:>10}  {:<11}submission\n",
        "verdict", "differing", "share", "PSNR", "SSIM", "FLIP", "worst"
    );
    for row in &class.rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", line(row).trim_end());
        let findings = row.findings_words();
        for said in [row.reason(), (!findings.is_empty()).then_some(findings)] {
            let Some(said) = said else {
                continue;
            };
            let _ = writeln!(text, "  {said}");
        }
    }
    let _ = writeln!(
        text,
        "{} (against {}; {})",
        Tally::of(&class.rows).words(),
        class.reference_words(),
        class.rule_words()
    );
    text
}

fn line(row: &Row) -> String {
    let name = shown(&row.submission);
    let verdict = row.verdict_word();
    let Some(found) = row.comparison() else {
        return format!("{verdict:<11}{:60}{name}", "");
    };
    let share = 100.0 * found.differing as f64 / found.size.pixels() as f64;
    let psnr = decibels(found.psnr());
    let ssim = found
        .ssim
        .map_or_else(|| "-".to_owned(), |ssim| format!("{ssim:.5}"));
    let worst = row
        .worst()
        .map_or_else(String::new, |worst| format!("{},{}", worst.x, worst.y));
    format!(
        "{verdict:<11}{:>9}{:>9}{psnr:>9}{ssim:>10}{:>10}  {worst:<11}{name}",
        found.differing,
        format!("{share:.2} %"),
        format!("{:.5}", found.flip),
    )
}

/// A signal-to-noise ratio, which is infinite for equal pictures.
pub(super) fn decibels(psnr: f64) -> String {
    if psnr.is_finite() {
        format!("{psnr:.2}")
    } else {
        "∞".to_owned()
    }
}
