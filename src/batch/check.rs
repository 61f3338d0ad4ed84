//! Reads scenes, and says what is wrong with them and their pictures.

use std::path::PathBuf;

use super::finding::{self, Naming};
use super::reading::Over;
use super::{Error, Messages, Reading, Tracing, messages};
use text::counted;

/// Scenes to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// The scene files.
    pub scenes: Vec<PathBuf>,
    /// How they are read.
    pub reading: Reading,
}

/// Reads scenes and the files they reference, and prints all findings and a summary to standard
/// error. Every scene is checked. Returns the error of the first scene that is unreadable or
/// invalid; [`Error::Invalid`] counts the errors of all scenes.
pub fn check(work: &Check) -> Result<(), Error> {
    let begun = work.reading.begin();
    begun.inspect_err(|error| Messages::Text.error(error))?;
    let mut first_failure = None;
    let mut errors = 0;
    let mut warnings = 0;
    let mut notes = 0;
    for path in &work.scenes {
        let over = Over::default();
        match work.reading.load(Messages::Text, path, Some(&over)) {
            Ok(mut loaded) => {
                errors += loaded.findings.errors();
                warnings += loaded.findings.warnings();
                notes += loaded.findings.notes();
                if 0 < loaded.findings.errors() {
                    first_failure.get_or_insert(Failure::Invalid);
                }
                finding::print_of_scene(path, &mut loaded, &Tracing::of_scene(), Naming::File);
            }
            Err(Error::Invalid { errors: more }) => {
                errors += more;
                first_failure.get_or_insert(Failure::Invalid);
            }
            Err(error) => {
                errors += 1;
                Messages::Text.error(&error);
                first_failure.get_or_insert(Failure::Unreadable(error));
            }
        }
    }
    let notes = match notes {
        0 => String::new(),
        notes => format!(", {}", counted(notes, "note")),
    };
    messages::print(&format!(
        "{} checked: {}, {}{notes}",
        counted(work.scenes.len(), "scene"),
        counted(errors, "error"),
        counted(warnings, "warning"),
    ));
    match first_failure {
        None => Ok(()),
        Some(Failure::Invalid) => Err(Error::Invalid { errors }),
        Some(Failure::Unreadable(error)) => Err(error),
    }
}

/// What is wrong with a scene.
enum Failure {
    /// It has errors, which are counted with those of the other scenes.
    Invalid,
    /// It cannot be read.
    Unreadable(Error),
}
