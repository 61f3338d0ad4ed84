//! The insertion of fields that an `.xml` text omits.

use super::tree::escaped;
use crate::language::placed::{Implicit, Insertion, Piece, Wanted};
use crate::text::Edit;

/// Returns the edits that insert these values where the text omits them. Insertions at one place
/// are combined.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let mut insertions: Vec<(&Insertion, Vec<String>)> = Vec::new();
    for (placed, values) in wanted {
        let mut missing = values.clone();
        missing.retain(|(component, _)| placed.default_of(*component).is_some());
        let Some(implicit) = placed.implicit.as_ref().filter(|_| !missing.is_empty()) else {
            continue;
        };
        let inserted = markup(implicit, &missing);
        match insertions
            .iter_mut()
            .find(|(place, _)| **place == implicit.insertion)
        {
            Some((_, all)) => all.push(inserted),
            None => insertions.push((&implicit.insertion, vec![inserted])),
        }
    }
    let edits = insertions.into_iter();
    edits.map(|(place, all)| edit(text, place, &all)).collect()
}

/// The attributes with these values, in their element if that is missing too.
fn markup(implicit: &Implicit, values: &[(usize, String)]) -> String {
    let mut markup = String::new();
    markup.extend(implicit.element.into_iter().flat_map(|name| ["<", name]));
    for attribute in &implicit.attributes {
        let value = values
            .iter()
            .find(|(component, _)| attribute.component == *component);
        let value = match value {
            Some((_, value)) => value,
            None if attribute.is_required => attribute.default,
            None => continue,
        };
        let value = escaped(value, '"');
        markup.extend([" ", attribute.name, "=\"", &value, "\""]);
    }
    markup.extend(implicit.element.map(|_| "/>"));
    markup
}

/// The edit that inserts all of these at one place.
fn edit(text: &str, place: &Insertion, all: &[String]) -> Edit {
    let copied = |pieces: &[Piece]| -> String {
        let pieces = pieces.iter().map(|piece| match piece {
            Piece::Literal(literal) => literal,
            Piece::Copy(span) => span.of(text),
        });
        pieces.collect()
    };
    let [before, between, after] =
        [&place.before, &place.between, &place.after].map(|pieces| copied(pieces));
    Edit {
        span: place.span,
        text: [before, all.join(&between), after].concat(),
    }
}
