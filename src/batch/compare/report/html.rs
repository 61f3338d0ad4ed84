//! Many comparisons as one page that needs nothing else: it is read and printed without scripts, and with
//! them a click on a column's head sorts its rows.

use std::fmt::Write;

use hmac_sha256::Hash;

use super::markup::escaped;
use super::names;
use crate::compare::compared::Class;
use crate::compare::row::{Row, Tally, by};
use crate::compare::table::decibels;
use crate::compare::thumbnail::Thumbnail;
use ::compare::Comparison;
use text::base64;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The columns, and whether their values are numbers.
const COLUMNS: [(&str, bool); 11] = [
    ("submission", false),
    ("reference", false),
    ("own picture", false),
    ("differences", false),
    ("verdict", false),
    ("differing", true),
    ("PSNR (dB)", true),
    ("SSIM", true),
    ("FLIP", true),
    ("worst pixel", false),
    ("why", false),
];

/// The page.
pub(super) fn page(class: &Class<'_>) -> String {
    // Nothing is loaded, and no other script is run, whatever the page holds.
    let script = base64(&Hash::hash(SCRIPT.as_bytes()));
    let policy = format!(
        "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{script}'; \
         base-uri 'none'; form-action 'none'"
    );
    let title = escaped(&format!("Compared with {}", class.reference_words()));
    let tally = escaped(&Tally::of(&class.rows).words());
    let rule = escaped(&class.rule_words());
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{tally}. {rule}.</p>\n"
    );
    text.push_str(&references(class));
    text.push_str("<table>\n<thead><tr>");
    for (name, is_number) in COLUMNS {
        let kind = if is_number { " class=\"number\"" } else { "" };
        // Writing to a string cannot fail.
        let _ = write!(text, "<th scope=\"col\"{kind}>{name}</th>");
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &class.rows {
        let _ = writeln!(text, "{}", line(class, row));
    }
    let _ = write!(
        text,
        "</tbody>\n</table>\n<p>Differences: black where both agree, then blue, red, yellow and, from 64 \
         levels of 255, white.</p>\n<script>{SCRIPT}</script>\n</body>\n</html>\n"
    );
    text
}

/// The pictures of the references, each of them once: rows refer to them.
fn references(class: &Class<'_>) -> String {
    let mut text = String::from("<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>\n");
    for (at, (_, picture)) in class.references.iter().enumerate() {
        let Some(Thumbnail { size, address }) = picture else {
            continue;
        };
        let (width, height) = (size.width, size.height);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "<image id=\"reference-{at}\" width=\"{width}\" height=\"{height}\" href=\"{address}\"/>"
        );
    }
    text.push_str("</defs></svg>\n");
    text
}

fn line(class: &Class<'_>, row: &Row) -> String {
    let [name, reference] = names(row).map(|name| escaped(&name));
    let shown = row
        .reference
        .as_deref()
        .and_then(|path| class.reference(path));
    let shown = shown.map_or_else(String::new, |(at, Thumbnail { size, .. })| {
        let (width, height) = (size.width, size.height);
        format!(
            "<svg width=\"{width}\" height=\"{height}\" role=\"img\" aria-label=\"reference\">\
             <use href=\"#reference-{at}\"/></svg>"
        )
    });
    let thumbnails = row.thumbnails.as_ref();
    let own = picture(thumbnails.and_then(|of| of.own.as_ref()), "submission");
    let difference = picture(
        thumbnails.and_then(|of| of.difference.as_ref()),
        "differences",
    );
    let found = row.comparison();
    let number = |value: Option<f64>, shown: String| {
        let key = value.map_or_else(String::new, |value| value.to_string());
        format!("<td class=\"number\" data-key=\"{key}\">{shown}</td>")
    };
    let share = found.map_or_else(String::new, |found| {
        let share = 100.0 * found.differing as f64 / found.size.pixels() as f64;
        format!("{}<br>{share:.2} % of {}", found.differing, by(found.size))
    });
    let ssim = found.and_then(|found| found.ssim);
    let worst = row.worst().map_or_else(String::new, |worst| {
        let [reference, own] = worst
            .colours
            .map(|of| of.map(|level| level.to_string()).join(" "));
        format!("{},{}<br>{reference} →<br>{own}", worst.x, worst.y)
    });
    let findings = row.findings_words();
    let why = [row.reason().unwrap_or_default(), findings];
    let why: Vec<_> = why
        .iter()
        .filter(|part| !part.is_empty())
        .map(|part| escaped(part))
        .collect();
    let verdict = row.verdict_word();
    let numbers = [
        number(found.map(|found| found.differing as f64), share),
        number(
            found.map(Comparison::psnr),
            found.map_or_else(String::new, |found| decibels(found.psnr())),
        ),
        number(
            ssim,
            ssim.map_or_else(String::new, |ssim| format!("{ssim:.5}")),
        ),
        number(
            found.map(|found| found.flip),
            found.map_or_else(String::new, |found| format!("{:.5}", found.flip)),
        ),
    ];
    format!(
        "<tr class=\"{verdict}\"><th scope=\"row\">{name}</th><td>{shown}<br>{reference}</td><td>{own}</td>\
         <td>{difference}</td><td class=\"verdict\">{verdict}</td>{}<td>{worst}</td><td>{}</td></tr>",
        numbers.concat(),
        why.join("<br>")
    )
}

fn picture(of: Option<&Thumbnail>, what: &str) -> String {
    of.map_or_else(String::new, |Thumbnail { size, address }| {
        let (width, height) = (size.width, size.height);
        format!("<img width=\"{width}\" height=\"{height}\" alt=\"{what}\" src=\"{address}\">")
    })
}
