//! What a list of a text's nodes shows: those called by some words, and those outside folded groups.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::{Node, SceneText, Source};

/// Whether an object is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// It is.
    Shown,
    /// It is not.
    Hidden,
}

impl Source {
    /// The rows of the nodes whose name or comment contains `words`, in lower case, ascending;
    /// `among` limits the search to some rows.
    pub fn rows_called(&self, words: &str, among: Option<&[usize]>) -> Vec<usize> {
        let nodes = self.nodes();
        let holds = |text: &str| contains(text, words);
        let is_called = |row: &usize| {
            let node = nodes.get(*row);
            node.is_some_and(|node| {
                holds(&self.name(node)) || self.comment(node).is_some_and(holds)
            })
        };
        match among {
            Some(rows) => rows.par_iter().copied().filter(is_called).collect(),
            None => (0..nodes.len()).into_par_iter().filter(is_called).collect(),
        }
    }

    /// The groups that hold an object, the innermost first.
    pub fn groups_of(&self, object: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(self.group_of(object), |&group| self.group_of(group))
    }

    /// Whether an object holds others, which can be folded away.
    pub fn is_foldable(&self, object: usize) -> bool {
        let [own, next] = [object, object + 1].map(|at| self.depth(Node::Object(at)));
        own < next || self.operation(object).is_some()
    }
}

/// The objects outside folded ones, ascending, in a text where each object follows its group.
pub(super) fn unfolded(source: &(impl SceneText + ?Sized), folded: &BTreeSet<usize>) -> Vec<usize> {
    let count = source.nodes().objects;
    let mut is_hidden = vec![false; count];
    for object in 0..count {
        let group = source.group_of(object);
        is_hidden[object] = group.is_some_and(|group| is_hidden[group] || folded.contains(&group));
    }
    (0..count).filter(|&object| !is_hidden[object]).collect()
}

/// Whether a text contains words in lower case, ignoring case.
fn contains(text: &str, words: &str) -> bool {
    if !text.is_ascii() {
        return text.to_lowercase().contains(words);
    }
    let windows = text.as_bytes().windows(words.len().max(1));
    let mut windows = windows.map(|window| window.eq_ignore_ascii_case(words.as_bytes()));
    words.is_empty() || windows.any(|is_same| is_same)
}

#[cfg(test)]
mod tests {
    use super::contains;

    #[test]
    fn words_are_found_in_any_case() {
        for (text, words, found) in [
            ("Sphere", "sph", true),
            ("the MOON", "moon", true),
            ("Größe", "grö", true),
            ("moon", "moons", false),
            ("", "a", false),
            ("moon", "", true),
        ] {
            assert_eq!(contains(text, words), found, "{text} {words}");
        }
    }
}
