//! Copied elements of `.xml`, whose names must not be those of others.

use std::collections::HashSet;

use super::tree::{self, Tree, escaped, quote};
use crate::StructureError;
use text::{Edit, Span, apply, visible};

/// The elements that can be inserted into a scene, in the order of their sets of names.
const KINDS: [&str; 3] = ["light", "material", "object"];

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
        let tree = tree::parse(&text);
        if let Some(fault) = &tree.fault {
            return foreign(fault.message.clone());
        }
        let mut found = 0;
        for child in tree.children(0) {
            let name = tree.elements[child].name.of(&text);
            if !KINDS.iter().any(|kind| kind.eq_ignore_ascii_case(name)) {
                let name = visible(name);
                return foreign(format!(
                    "expected lights, materials or objects, not <{name}>"
                ));
            }
            found += 1;
        }
        let is_one = tree
            .elements
            .first()
            .is_some_and(|root| root.whole.len() == text.len());
        if found == 0 || !is_one {
            return foreign("expected elements of lights, materials or objects".to_owned());
        }
        Ok(Self { text, tree })
    }

    /// Whether all elements are of this kind.
    pub(super) fn is_all(&self, kind: &str) -> bool {
        let mut children = self.tree.children(0);
        children.all(|child| self.is(child, kind))
    }

    fn is(&self, element: usize, kind: &str) -> bool {
        let name = self.tree.elements[element].name.of(&self.text);
        name.eq_ignore_ascii_case(kind)
    }

    /// Replaces names in use, and references to materials of the copies.
    pub(super) fn rename(&mut self, taken: &[HashSet<&str>; 3]) {
        let mut edits = Vec::new();
        let mut materials = Vec::new();
        for (kind, taken) in KINDS.iter().zip(taken) {
            let mut taken: HashSet<String> = taken.iter().map(|&name| name.to_owned()).collect();
            for element in 0..self.tree.elements.len() {
                let is_file = self
                    .value(element, "type")
                    .is_some_and(|(_, of)| of.eq_ignore_ascii_case("obj"));
                if !self.is(element, kind) || is_file {
                    continue;
                }
                let Some((span, name)) = self.value(element, "name") else {
                    continue;
                };
                if !taken.insert(name.to_owned()) {
                    let unused = unused(name, &taken);
                    taken.insert(unused.clone());
                    if *kind == "material" {
                        materials.push((name.to_owned(), unused.clone()));
                    }
                    edits.push(self.replaced(span, &unused));
                }
            }
        }
        for element in 0..self.tree.elements.len() {
            let Some((span, name)) = self.value(element, "material") else {
                continue;
            };
            let renamed = materials.iter().rev().find(|(old, _)| old == name);
            edits.extend(renamed.map(|(_, new)| self.replaced(span, new)));
        }
        Edit::sort(&mut edits);
        apply(&mut self.text, &edits);
        self.tree = tree::parse(&self.text);
    }

    fn value(&self, element: usize, attribute: &str) -> Option<(Span, &str)> {
        let value = self.tree.attribute(&self.text, element, attribute)?;
        Some((value.value, value.unescaped(&self.text)))
    }

    fn replaced(&self, span: Span, name: &str) -> Edit {
        Edit {
            span,
            text: escaped(name, quote(&self.text, span)).into_owned(),
        }
    }

    /// The elements, the first at this indentation and the others as before relative to it.
    pub(super) fn indented(&self, indent: &str, ending: &str) -> String {
        let inner = &self.text[OPEN.len()..self.text.len() - CLOSE.len()];
        let lines: Vec<_> = inner
            .lines()
            .map(|line| line.trim_end_matches('\r'))
            .collect();
        let is_blank = |line: &&str| line.trim().is_empty();
        let start = lines.iter().take_while(|line| is_blank(line)).count();
        let behind = lines[start..]
            .iter()
            .rev()
            .take_while(|line| is_blank(line))
            .count();
        let lines = &lines[start..lines.len() - behind];
        let width = |line: &str| line.len() - line.trim_start_matches([' ', '\t']).len();
        let old = lines.first().map_or(0, |line| width(line));
        let moved = lines.iter().map(|line| match width(line).min(old) {
            _ if is_blank(line) => String::new(),
            cut => format!("{indent}{}", &line[cut..]),
        });
        moved.collect::<Vec<_>>().join(ending)
    }
}

/// A name like this one that is not taken: with the least free number from 2.
pub(super) fn unused(name: &str, taken: &HashSet<String>) -> String {
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
