//! The names of files beside a scene, of which none is read.

use std::fs;
use std::path::Path;

use assets::{is_mesh, is_picture};
use language::{FileKind, Language};
use text::Span;

use super::{Choices, Icon, Item};
use crate::document::Document;

/// The maximum number of files listed.
const MOST: usize = 200;

/// The maximum number of entries of a folder looked at.
const MOST_SEEN: usize = 2_000;

/// The files that a value at a span may name, in the folder that is typed before an offset.
pub(super) fn choices(document: &Document, (span, at): (Span, usize), kind: FileKind) -> Choices {
    let typed = &document.text()[span.start()..at];
    let folder = typed.rfind('/').map_or("", |end| &typed[..=end]);
    let mut choices = Choices {
        span,
        ..Choices::default()
    };
    let is_outside = folder.starts_with('/') || folder.split('/').any(|part| part == "..");
    let Some(beside) = document.path().parent().filter(|_| !is_outside) else {
        return choices;
    };
    let Ok(entries) = fs::read_dir(beside.join(folder)) else {
        return choices;
    };
    let mut seen = 0;
    for entry in entries.take(MOST_SEEN).filter_map(Result::ok) {
        seen += 1;
        let name = entry.file_name().to_string_lossy().into_owned();
        // Links to folders are not followed.
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let is_fitting = match kind {
            FileKind::Picture => is_picture(Path::new(&name)),
            FileKind::Mesh => is_mesh(Path::new(&name)),
        };
        if name.starts_with('.') || !(is_folder || is_fitting) || !can_be_spelled(document, &name) {
            continue;
        }
        let (end, icon) = if is_folder {
            ("/", Icon::Folder)
        } else {
            ("", Icon::File)
        };
        choices.items.push(Item {
            word: format!("{folder}{name}{end}"),
            icon,
            detail: String::new(),
            doc: "",
        });
    }
    choices
        .items
        .sort_by(|one, other| one.word.cmp(&other.word));
    choices.is_cut = MOST < choices.items.len() || seen == MOST_SEEN;
    choices.items.truncate(MOST);
    choices
}

/// Whether a name can stand in the text: a record separates its words by white space.
fn can_be_spelled(document: &Document, name: &str) -> bool {
    let is_plain = !name.contains(|c: char| c.is_control() || c == char::REPLACEMENT_CHARACTER);
    let is_word = !name.contains(char::is_whitespace);
    is_plain && (is_word || document.source.language() == Language::Xml)
}
