//! What is wrong with a long text, as far as its beginning tells.

use super::{Language, dat, ray, xml};
use crate::text::Findings;

/// The errors of every text that begins like this, with the warnings so far; none where what follows
/// may make a scene of it.
pub fn errors_of_beginning(language: Language, beginning: &str) -> Findings {
    let findings = match language {
        Language::Ray => ray::errors_of_beginning(beginning),
        Language::Dat => dat::errors_of_beginning(beginning),
        Language::Xml => xml::errors_of_beginning(beginning),
    };
    findings.sorted()
}
