//! The insertion of fields that an `.xml` text omits.

use super::tree::escaped;
use crate::field_spans::{self, Implicit, Wanted};
use text::Edit;

/// Returns the edits that insert these values where the text omits them.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    field_spans::insertions(text, wanted, markup)
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
            Some((_, value)) => &**value,
            None if attribute.is_required => &*attribute.default,
            None => continue,
        };
        let value = escaped(value, '"');
        markup.extend([" ", attribute.name, "=\"", &value, "\""]);
    }
    markup.extend(implicit.element.map(|_| "/>"));
    markup
}
