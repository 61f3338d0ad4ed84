//! Copied elements of `.xml`, whose names must not be those of others.

use std::collections::{BTreeSet, HashSet};

use super::tree::{Tree, respelled};
use crate::StructureError;
use crate::schema::Category;
use crate::structure::inner_lines;
use crate::written::Parse;
use text::{Edit, Span, apply, visible};

/// What can be inserted into a scene.
const CATEGORIES: [Category; 3] = [Category::Light, Category::Material, Category::Object];

/// Elements to insert.
#[derive(Debug)]
pub(super) struct Copies {
    /// In a root element of their own.
    text: String,
    tree: Tree,
}

const OPEN: &str = "<xml>";
const CLOSE: &str = "</xml>";

impl Copies {
    /// Reads copied elements.
    ///
    /// # Errors
    ///
    /// Fails if they are not XML, or are anything but lights, materials and objects.
    pub(super) fn of(copied: &str) -> Result<Self, StructureError> {
        let foreign = |reason: String| Err(StructureError::Foreign { reason });
        let text = format!("{OPEN}{copied}{CLOSE}");
        let tree = Tree::parse(&text);
        if let Some(fault) = &tree.fault {
            return foreign(fault.message.clone());
        }
        let is_known = |name: &str| CATEGORIES.iter().any(|category| is(name, *category));
        let strange = tree
            .children(0)
            .map(|child| tree.elements[child].name.of(&text))
            .find(|name| !is_known(name));
        if let Some(name) = strange.map(visible) {
            return foreign(format!(
                "expected lights, materials or objects, not <{name}>"
            ));
        }
        let root = tree.elements.first();
        let is_one = root.is_some_and(|root| root.whole.len() == text.len());
        if tree.children(0).next().is_none() || !is_one {
            return foreign("expected elements of lights, materials or objects".to_owned());
        }
        Ok(Self { text, tree })
    }

    /// Whether all elements are of this category.
    pub(super) fn are_all(&self, category: Category) -> bool {
        let mut children = self.tree.children(0);
        children.all(|child| is(self.tree.elements[child].name.of(&self.text), category))
    }

    /// Replaces names that are taken in their category, and references to materials of the copies.
    pub(super) fn rename(&mut self, taken: impl Fn(Category) -> HashSet<String>) {
        let text = &*self.text;
        let mut edits = Vec::new();
        let mut materials = Vec::new();
        for category in CATEGORIES {
            let mut taken = taken(category);
            for (element, span, name) in values(text, &self.tree, category, "name") {
                let kind = self.tree.attribute(text, element, "type");
                let is_file =
                    kind.is_some_and(|kind| kind.unescaped(text).eq_ignore_ascii_case("obj"));
                if is_file || taken.insert(name.to_owned()) {
                    continue;
                }
                let new = unused(name, &taken);
                edits.push(respelled(text, span, &new));
                if category == Category::Material {
                    materials.push((name, new.clone()));
                }
                taken.insert(new);
            }
        }
        for element in 0..self.tree.elements.len() {
            if let Some(value) = self.tree.attribute(text, element, "material") {
                let name = value.unescaped(text);
                let renamed = materials.iter().rev().find(|(old, _)| *old == name);
                edits.extend(renamed.map(|(_, new)| respelled(text, value.value, new)));
            }
        }
        Edit::sort(&mut edits);
        apply(&mut self.text, &edits);
        self.tree = Tree::parse(&self.text);
    }

    /// The elements, the first at this indentation and the others as before relative to it.
    pub(super) fn indented(&self, indent: &str, ending: &str) -> String {
        let inner = &self.text[OPEN.len()..self.text.len() - CLOSE.len()];
        let lines = inner_lines(inner);
        let width = |line: &str| line.len() - line.trim_start_matches([' ', '\t']).len();
        let old = lines.first().map_or(0, |line| width(line));
        let moved = lines.iter().map(|line| match width(line).min(old) {
            _ if line.trim().is_empty() => String::new(),
            cut => format!("{indent}{}", &line[cut..]),
        });
        moved.collect::<Vec<_>>().join(ending)
    }
}

/// Returns the edits that rename the materials that `text` defines in addition to `base`, where
/// `theirs` defines others of the same name in addition to it; what has them follows.
pub(super) fn set_apart(text: &str, tree: &Tree, [base, theirs]: [&str; 2]) -> Vec<Edit> {
    let names = |text: &str, tree: &Tree| -> BTreeSet<String> {
        let named = values(text, tree, Category::Material, "name");
        named.map(|(_, _, name)| name.to_owned()).collect()
    };
    let mine = names(text, tree);
    let [base, theirs] = [base, theirs].map(|other| names(other, &Tree::parse(other)));
    let all = mine.iter().chain(&base).chain(&theirs);
    let mut taken: HashSet<String> = all.cloned().collect();
    let mut edits = Vec::new();
    for name in mine
        .intersection(&theirs)
        .filter(|name| !base.contains(*name))
    {
        let new = unused(name, &taken);
        let own = values(text, tree, Category::Material, "name");
        let users = values(text, tree, Category::Object, "material");
        let same = own.chain(users).filter(|(_, _, of)| of == name);
        edits.extend(same.map(|(_, span, _)| respelled(text, span, &new)));
        taken.insert(new);
    }
    Edit::sort(&mut edits);
    edits
}

/// Whether this is the name of the elements of a category.
fn is(name: &str, category: Category) -> bool {
    name.eq_ignore_ascii_case(category.word())
}

/// The values of an attribute of all elements of a category, with their places.
fn values<'t>(
    text: &'t str,
    tree: &'t Tree,
    category: Category,
    attribute: &'static str,
) -> impl Iterator<Item = (usize, Span, &'t str)> {
    let elements = tree.elements.iter().enumerate();
    let elements = elements.filter(move |(_, element)| is(element.name.of(text), category));
    elements.filter_map(move |(element, _)| {
        let value = tree.attribute(text, element, attribute)?;
        Some((element, value.value, value.unescaped(text)))
    })
}

/// A name like this one that is not taken: with the least free number from 2.
fn unused(name: &str, taken: &HashSet<String>) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let stem = if stem.len() < name.len() && stem.ends_with(' ') {
        stem.trim_end()
    } else {
        name
    };
    let numbered = (2..).map(|number: u64| format!("{stem} {number}"));
    let mut unused = numbered.filter(|name| !taken.contains(name));
    unused.next().unwrap_or_default()
}
