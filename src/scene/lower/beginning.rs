//! What is wrong with a long text, as far as its beginning tells.

use super::{dat, ray};
use crate::format::{self, Format, Tree, xml};
use crate::text::{Diagnostic, Findings, Span};

/// Tokens are shorter than this.
const LONGEST_TOKEN: usize = 1 << 16;

/// The errors of any text that begins like this, with its warnings so far; none where what follows may
/// make a scene of it. Nothing but white space and comments, a token of 64 KiB that has no end, and a
/// `.dat` text without a known record count as errors: a scene that has those for a megabyte is none.
pub fn errors_of_beginning(format: Format, beginning: &str) -> Findings {
    let mut findings = Findings::default();
    let nothing = |of| {
        let message = format!("the first {} bytes hold no scene", beginning.len());
        Diagnostic::error(Span::at(0), message, "a scene").with_hint(format!("they are {of}"))
    };
    if format == Format::Xml {
        if beginning.trim_ascii().is_empty() {
            findings.error(|| nothing("white space"));
        } else if let Some(fault) = xml::fault_of_beginning(beginning) {
            findings.error(|| fault);
        }
        return findings;
    }
    let tree = format::parse(format, beginning);
    let (last, count) = match &tree {
        Tree::Ray(tree) => {
            let count = tree.tokens.len();
            (
                count.checked_sub(1).and_then(|at| tree.tokens.get(at)),
                count,
            )
        }
        Tree::Dat(tree) => (tree.tokens.last().copied(), tree.tokens.len()),
        Tree::Xml(_) => (None, 0),
    };
    // A comment's marker that is cut looks like a token.
    let is_cut = |last: &Span| count == 1 && last.len() == 1 && last.end() == beginning.len();
    match last.filter(|last| !is_cut(last)) {
        None => findings.error(|| nothing("white space and comments")),
        Some(last) if LONGEST_TOKEN < last.len() => findings.error(|| {
            let message = format!("a word or number of more than {LONGEST_TOKEN} bytes");
            Diagnostic::error(last, message, "white space")
        }),
        Some(_) => {
            findings = match &tree {
                Tree::Ray(tree) => ray::errors_of_beginning(beginning, tree),
                Tree::Dat(tree) => dat::errors_of_beginning(beginning, tree),
                Tree::Xml(_) => findings,
            }
        }
    }
    findings.sorted()
}
