//! Telling apart what two texts made from the same one each add under the same name.

use std::collections::{BTreeSet, HashSet};

use super::copies::unused;
use super::tree::{self, Tree, escaped, quote};
use text::{Edit, Span};

/// Returns the edits that rename the materials that `text` defines in addition to `base`, where
/// `theirs` defines others of the same name in addition to it; what has them follows.
pub(super) fn set_apart(text: &str, tree: &Tree, base: &str, theirs: &str) -> Vec<Edit> {
    let mine = values(text, tree, "material", "name");
    let others = [base, theirs].map(|other| names(other, &tree::parse(other)));
    let [base, theirs] = &others;
    let mut taken: HashSet<String> = others.iter().flatten().cloned().collect();
    taken.extend(mine.iter().map(|(_, name)| name.clone()));
    let own: BTreeSet<_> = mine.iter().map(|(_, name)| name).collect();
    let both = own
        .into_iter()
        .filter(|&name| theirs.contains(name) && !base.contains(name));
    let mut edits = Vec::new();
    for name in both {
        let new = unused(name, &taken);
        let users = values(text, tree, "object", "material");
        let all = mine.iter().chain(&users).filter(|(_, of)| of == name);
        edits.extend(all.map(|&(span, _)| Edit {
            span,
            text: escaped(&new, quote(text, span)).into_owned(),
        }));
        taken.insert(new);
    }
    Edit::sort(&mut edits);
    edits
}

fn names(text: &str, tree: &Tree) -> HashSet<String> {
    let named = values(text, tree, "material", "name").into_iter();
    named.map(|(_, name)| name).collect()
}

/// The values of an attribute of all elements of a kind.
fn values(text: &str, tree: &Tree, kind: &str, attribute: &str) -> Vec<(Span, String)> {
    let elements = tree.elements.iter().enumerate();
    let elements = elements.filter(|(_, element)| element.name.of(text).eq_ignore_ascii_case(kind));
    let values = elements.filter_map(|(element, _)| {
        let value = tree.attribute(text, element, attribute)?;
        Some((value.value, value.unescaped(text).to_owned()))
    });
    values.collect()
}
