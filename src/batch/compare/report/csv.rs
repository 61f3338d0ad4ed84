//! Many comparisons as a table for spreadsheets, by RFC 4180.

use crate::compare::compared::Class;
use crate::compare::row::Row;
use ::compare::Comparison;

const HEAD: [&str; 14] = [
    "submission",
    "reference",
    "verdict",
    "width",
    "height",
    "differing",
    "largest",
    "mse",
    "psnr",
    "ssim",
    "flip",
    "worst",
    "findings",
    "reason",
];

/// A head and a line for each submission. What is not known is empty, as is the PSNR of equal pictures.
pub(super) fn table(class: &Class<'_>) -> String {
    let head = HEAD.map(cell).join(",");
    let lines = class.rows.iter().map(|row| line(row).join(","));
    let lines: Vec<_> = std::iter::once(head).chain(lines).collect();
    lines.join("\r\n") + "\r\n"
}

fn line(row: &Row) -> [String; HEAD.len()] {
    let [submission, reference] = super::names(row);
    let found = row.comparison();
    let number = |number: Option<f64>| {
        let known = number.filter(|number| number.is_finite());
        known.map_or_else(String::new, |number| number.to_string())
    };
    let count = |count: Option<u64>| count.map_or_else(String::new, |count| count.to_string());
    let worst = row.worst().map(|worst| format!("{} {}", worst.x, worst.y));
    [
        cell(&submission),
        cell(&reference),
        cell(row.verdict_word()),
        count(found.map(|found| found.size.width.into())),
        count(found.map(|found| found.size.height.into())),
        count(found.map(|found| found.differing as u64)),
        count(found.map(|found| found.largest.into())),
        number(found.map(|found| found.mse)),
        number(found.map(Comparison::psnr)),
        number(found.and_then(|found| found.ssim)),
        number(found.map(|found| found.flip)),
        cell(&worst.unwrap_or_default()),
        cell(&row.findings_words()),
        cell(&row.reason().unwrap_or_default()),
    ]
}

/// A text as a cell. One that a spreadsheet would take for a formula gets an apostrophe in front, which
/// makes it a text there.
fn cell(text: &str) -> String {
    const STARTS: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];
    let is_formula = text.starts_with(STARTS);
    let text = if is_formula {
        format!("'{text}")
    } else {
        text.to_owned()
    };
    if text.contains(['"', ',', '\r', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_texts() {
        for (text, expected) in [
            ("a b", "a b"),
            ("a,b", "\"a,b\""),
            ("say \"a\"", "\"say \"\"a\"\"\""),
            ("a\r\nb", "\"a\r\nb\""),
            ("=1+1", "'=1+1"),
            ("@SUM(A1,2)", "\"'@SUM(A1,2)\""),
            ("-1", "'-1"),
            ("+1", "'+1"),
            ("\t=1", "'\t=1"),
            ("\r=1", "\"'\r=1\""),
        ] {
            assert_eq!(cell(text), expected);
        }
    }
}
