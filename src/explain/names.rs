//! Names, places and numbers as they are written in explanations.

use std::cell::RefCell;
use std::collections::HashMap;

use glam::DVec3;

use super::{Place, Subject};
use language::Node;
use render::Side;
use scene::Rgb;
use text::{Position, Span};

/// The text and scene that names come from.
pub(super) struct Names<'s> {
    pub(super) subject: &'s Subject<'s>,
    /// Positions found so far, by offset: finding one reads the text up to it.
    positions: RefCell<HashMap<usize, Position>>,
}

impl<'s> Names<'s> {
    pub(super) fn new(subject: &'s Subject<'s>) -> Self {
        Self {
            subject,
            positions: RefCell::default(),
        }
    }

    /// The node of an object of the scene.
    pub(super) fn object_node(&self, object: u32) -> Node {
        Node::Object(self.subject.source.object(object))
    }

    /// The node of a light of the scene.
    pub(super) fn light_node(light: u32) -> Node {
        Node::Light(light as usize)
    }

    /// The number of textures in the list of nodes.
    pub(super) fn textures(&self) -> usize {
        let nodes = self.subject.source.nodes().iter();
        nodes
            .filter(|node| matches!(node, Node::Texture(_)))
            .count()
    }

    /// The node that holds an object's material: its material, or itself.
    pub(super) fn material_node(&self, object: u32) -> Node {
        let object = self.subject.source.object(object);
        let material = self.subject.source.material(object);
        material.map_or(Node::Object(object), Node::Material)
    }

    /// An object's name with its line.
    pub(super) fn object(&self, object: u32) -> String {
        self.node(self.object_node(object))
    }

    /// A light's name with its line.
    pub(super) fn light(&self, light: u32) -> String {
        self.node(Self::light_node(light))
    }

    /// Several lights.
    pub(super) fn lights(&self, lights: &[u32]) -> String {
        several(lights, |light| self.light(light))
    }

    /// Several objects.
    pub(super) fn objects(&self, objects: &[u32]) -> String {
        several(objects, |object| self.object(object))
    }

    /// A node's name with its line: `object 2 (box, line 14)`.
    pub(super) fn node(&self, node: Node) -> String {
        let name = self.subject.source.name(node);
        let Some(Place { line, .. }) = self.place(node) else {
            return name;
        };
        match name.strip_suffix(')') {
            Some(open) => format!("{open}, line {line})"),
            None => format!("{name} (line {line})"),
        }
    }

    /// Where a node is in the text.
    pub(super) fn place(&self, node: Node) -> Option<Place> {
        let span = self.subject.source.span(node);
        (span.start() != span.end()).then(|| self.place_of(span, None))
    }

    /// Where the first of a node's fields with these keys is, or else the node.
    pub(super) fn field(&self, node: Node, keys: &[&str]) -> Option<Place> {
        let fields = self.subject.source.fields(node);
        let found = keys.iter().find_map(|key| {
            let is = |placed: &&language::FieldSpans| placed.field.key == *key;
            let placed = fields.iter().find(is)?;
            let span = placed.spans.first()?;
            Some(self.place_of(*span, Some(placed.field.key)))
        });
        found.or_else(|| self.place(node))
    }

    /// The key of the first of these fields that a node has, for a sentence.
    pub(super) fn key(&self, node: Node, keys: &[&'static str]) -> Option<&'static str> {
        let fields = self.subject.source.fields(node);
        let has = |key: &&&str| fields.iter().any(|placed| placed.field.key == **key);
        keys.iter().find(has).copied()
    }

    fn place_of(&self, span: Span, field: Option<&'static str>) -> Place {
        let text = self.subject.source.text();
        let mut positions = self.positions.borrow_mut();
        let position = positions.entry(span.start());
        let Position { line, column } =
            *position.or_insert_with(|| Position::of(text, span.start()));
        Place {
            line,
            column,
            field,
        }
    }
}

/// The names of some, the first three at most.
fn several(all: &[u32], name: impl Fn(u32) -> String) -> String {
    const MOST: usize = 3;
    let mut names: Vec<_> = all.iter().take(MOST).map(|&one| name(one)).collect();
    if MOST < all.len() {
        names.push(format!("{} more", all.len() - MOST));
    }
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// Rounds a number to four significant digits, without an exponent where it is short without.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() {
            "undefined".to_owned()
        } else {
            let sign = if value < 0.0 { "−" } else { "" };
            format!("{sign}∞")
        };
    }
    let scientific = format!("{value:.3e}");
    let rounded: f64 = scientific.parse().unwrap_or(value) + 0.0;
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e7).contains(&size) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// A point or direction.
pub(super) fn vector(vector: DVec3) -> String {
    format!("({})", settled(&vector.to_array()).join(", "))
}

/// A colour: one number for greys.
pub(super) fn colour(colour: Rgb) -> String {
    let [r, g, b] = colour.to_array().map(number);
    if r == g && g == b {
        r
    } else {
        format!("{r} {g} {b}")
    }
}

/// The channels of a colour, of greys too.
pub(super) fn channels(colour: Rgb) -> String {
    numbers(&colour.to_array())
}

/// A fraction as a percentage with the digits of a number.
pub(super) fn exact_percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// A fraction as a percentage with a decimal at most.
pub(super) fn percent(share: f64) -> String {
    let tenths = (1000.0 * share).round();
    if tenths == 0.0 && 0.0 < share {
        return "less than 0.1 %".to_owned();
    }
    format!("{} %", number(tenths / 10.0))
}

/// The side of a surface.
pub(super) fn side(side: Side) -> &'static str {
    match side {
        Side::Front => "front",
        Side::Back => "back",
    }
}

/// Numbers with blanks between them; rounding errors beside larger ones are 0.
pub fn numbers(of: &[f64]) -> String {
    settled(of).join(" ")
}

/// Numbers, with those that are rounding errors beside the others as 0.
fn settled(of: &[f64]) -> Vec<String> {
    let largest = of.iter().fold(0.0, |most: f64, of| most.max(of.abs()));
    let settled = |of: f64| if of.abs() < 1e-12 * largest { 0.0 } else { of };
    of.iter().map(|&of| number(settled(of))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_errors_are_no_digits() {
        assert_eq!(numbers(&[1.0, 1e-17, -0.25]), "1 0 -0.25");
        assert_eq!(numbers(&[1e-17]), "1e-17");
    }

    #[test]
    fn numbers_have_four_digits() {
        for (value, expected) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.123_456, "0.1235"),
            (-1234.56, "-1235"),
            (1e-9, "1e-9"),
            (3.0e8, "3e8"),
            (f64::INFINITY, "∞"),
            (f64::NAN, "undefined"),
        ] {
            assert_eq!(number(value), expected);
        }
    }
}
