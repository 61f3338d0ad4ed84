//! Many comparisons as the tests of a `JUnit` report: a submission that differs is a failure, one that
//! cannot be compared an error.

use std::fmt::Write;

use super::markup::escaped;
use super::{names, summary};
use crate::compare::Verdict;
use crate::compare::compared::Class;
use crate::compare::row::{Row, Tally};

/// The report.
pub(super) fn suite(class: &Class<'_>) -> String {
    let Tally {
        different, failed, ..
    } = Tally::of(&class.rows);
    let counts = format!(
        "tests=\"{}\" failures=\"{different}\" errors=\"{failed}\"",
        class.rows.len()
    );
    let name = escaped(&format!("compare with {}", class.reference_words()));
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {counts}>\n\
         <testsuite name=\"{name}\" {counts} skipped=\"0\">\n"
    );
    for row in &class.rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", test(row));
    }
    text.push_str("</testsuite>\n</testsuites>\n");
    text
}

fn test(row: &Row) -> String {
    let [name, reference] = names(row).map(|name| escaped(&name));
    let summary = escaped(&summary(row));
    let reason = row.reason().unwrap_or_else(|| "pixels differ".to_owned());
    let reason = escaped(&reason);
    let inside = match row.verdict() {
        Some(Verdict::Alike) => format!("<system-out>{summary}</system-out>"),
        Some(Verdict::Different) => {
            format!("<failure type=\"different\" message=\"{reason}\">{summary}</failure>")
        }
        None => format!("<error type=\"failed\" message=\"{reason}\">{summary}</error>"),
    };
    format!("<testcase classname=\"{reference}\" name=\"{name}\">{inside}</testcase>")
}
