//! What is wrong with a long text, as far as its beginning tells.

use super::{dat, ray};
use crate::format::{self, Format, Tree, xml};
use crate::text::Findings;

/// The errors of every text that begins like this, with the warnings so far; none where what follows
/// may make a scene of it.
pub fn errors_of_beginning(format: Format, beginning: &str) -> Findings {
    let mut findings = Findings::default();
    if format == Format::Xml {
        if let Some(fault) = xml::fault_of_beginning(beginning) {
            findings.error(|| fault);
        }
        return findings;
    }
    match format::parse(format, beginning) {
        Tree::Ray(tree) => findings = ray::errors_of_beginning(beginning, &tree),
        Tree::Dat(tree) => findings = dat::errors_of_beginning(beginning, &tree),
        Tree::Xml(_) => {}
    }
    findings.sorted()
}
