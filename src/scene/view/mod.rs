//! A camera in the words of each language: as the literals of the view's fields, and as the edits
//! that make a text say it.

mod dat;
mod ray;
mod xml;

use super::fields::{Field, Kind, place_of};
use super::{Camera, Node, Origins};
use crate::format::Tree;
use crate::text::{Edit, line_end, next_line, parse_number};

/// The numbers of each of the view's fields; for a choice, the place of the word.
type Numbers = Vec<Vec<f64>>;

/// What the fields of the view would say of a camera, one literal a component, in the order of
/// [`Origins::fields`].
pub fn view_literals(origins: &Origins, camera: &Camera) -> Vec<Vec<String>> {
    let (fields, numbers) = view(origins, camera);
    let literals = |(field, numbers): (&&Field, Vec<f64>)| {
        let spell = |number| literal(field, number);
        numbers.into_iter().map(spell).collect()
    };
    fields.iter().zip(numbers).map(literals).collect()
}

/// The camera after a component of a field of the view says something else.
///
/// # Errors
///
/// What it must be, if it can't be that.
pub fn view_saying(
    origins: &Origins,
    camera: &Camera,
    (field, component): (usize, usize),
    said: &str,
) -> Result<Camera, String> {
    let (fields, mut numbers) = view(origins, camera);
    let (Some(field), Some(number)) = (
        fields.get(field),
        numbers
            .get_mut(field)
            .and_then(|field| field.get_mut(component)),
    ) else {
        return Ok(*camera);
    };
    *number = match field.kind {
        Kind::Choice(words) => {
            let place = place_of(words, said);
            place.ok_or_else(|| words.join(" or "))? as f64
        }
        _ => parse_number(said)
            .ok()
            .filter(|&number| field.allowed.contains(number))
            .ok_or_else(|| field.allowed.limits())?,
    };
    Ok(match origins {
        Origins::Ray(_) => ray::camera(&numbers, camera),
        Origins::Dat(origins) => dat::camera(&numbers, camera, origins),
        Origins::Xml(_) => xml::camera(&numbers, camera),
    })
}

/// The edits that make the text say this camera: numbers that it states differently are replaced,
/// missing parts are added. `before` is the camera as lowered; only parts that differ from it are
/// written, and those whose defaults would move with them.
pub fn view_edits(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    match (origins, tree) {
        (Origins::Ray(origins), Tree::Ray(_)) => ray::edits(text, origins, before, camera),
        (Origins::Dat(origins), Tree::Dat(tree)) => dat::edits(text, tree, origins, before, camera),
        (Origins::Xml(own), Tree::Xml(_)) => {
            let fields = origins.fields(tree, Node::View);
            xml::edits(text, tree, own, &fields, before, camera)
        }
        _ => Vec::new(),
    }
}

fn view(origins: &Origins, camera: &Camera) -> (Vec<&'static Field>, Numbers) {
    match origins {
        Origins::Ray(_) => (ray::fields().collect(), ray::numbers(camera)),
        Origins::Dat(origins) => (dat::fields().collect(), dat::numbers(camera, origins)),
        Origins::Xml(origins) => (
            xml::fields(origins).collect(),
            xml::numbers(camera, origins),
        ),
    }
}

/// How a number of a field is written where none stood before.
fn literal(field: &Field, number: f64) -> String {
    match field.kind {
        Kind::Choice(words) => words[number as usize % words.len()].to_owned(),
        _ if 1e16 <= number.abs() => format!("{number:e}"),
        // The sum is the same number, and 0 for −0.
        _ => (number + 0.0).to_string(),
    }
}

/// Whether the text must change to say another number; it says 0 for both zeros.
fn differ(old: f64, new: f64) -> bool {
    old.partial_cmp(&new) != Some(std::cmp::Ordering::Equal)
}

/// How the text's first line ends; all others are taken to end so, too.
pub(super) fn line_ending(text: &str) -> &'static str {
    let from = line_end(text, 0);
    let end = &text[from..next_line(text, from)];
    ["\n", "\r", "\r\n"]
        .into_iter()
        .find(|&known| known == end)
        .unwrap_or(if end.is_empty() { "\n" } else { "\r\r\n" })
}

/// Where the text begins, after a byte order mark.
fn beginning(text: &str) -> usize {
    const MARK: char = '\u{FEFF}';
    if text.starts_with(MARK) {
        MARK.len_utf8()
    } else {
        0
    }
}
