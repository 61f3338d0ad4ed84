//! The roles that the leaves of a `.ray` text play.

use super::schema::{AMBIENT, LIGHT, ShapeKind};
use super::tree::begins_comment;
use crate::roles::{ANYWHERE, Role, Roles, role};
use text::Span;

/// The roles of leaves: a number's is its place in its object, light or colour. `at_ends` tells
/// whether the text begins and ends where the whole one does.
pub(super) fn roles(text: &str, leaves: &[Span], [at_start, at_end]: [bool; 2]) -> Roles {
    let mut roles = vec![ANYWHERE; leaves.len()];
    let is_token = |leaf: &Span| !begins_comment(leaf.of(text).as_bytes());
    let tokens = (0..).zip(leaves).filter(|(_, leaf)| is_token(leaf));
    let mut head = Vec::new();
    // The next number's index in its object, and the number of its shape's numbers.
    let mut place: Option<(usize, usize)> = None;
    for (at, leaf) in tokens {
        if let Some(kind) = ShapeKind::of_word(leaf.of(text)) {
            place = Some((0, kind.geometry()));
        } else if let Some((index, shape)) = &mut place {
            roles[at] = match index.checked_sub(*shape) {
                None => role(b's', *index),
                Some(index) => role(b'm', index),
            };
            *index += 1;
        } else {
            head.push(at);
        }
    }
    let is_cut = !at_start || (place.is_none() && !at_end);
    if !is_cut && place.is_some() {
        for (number, &at) in head.iter().enumerate() {
            roles[at] = role_of_head(number, head.len());
        }
    }
    let unknown = head.last().filter(|_| is_cut);
    let unknown = unknown.map_or(0, |at| at + 1);
    Roles { roles, unknown }
}

/// The role of a number before the first object, of so many.
fn role_of_head(number: usize, count: usize) -> Role {
    match number.checked_sub(AMBIENT.numbers()) {
        _ if lights_in_head(count).is_none() => ANYWHERE,
        None => role(b'a', number),
        Some(0) => role(b'n', 0),
        _ if number + 1 == count => role(b'n', 1),
        Some(light) => role(b'l', (light - 1) % LIGHT.numbers()),
    }
}

/// The number of lights in so many numbers before the first object, if they are whole: ambient light,
/// a count, lights, and another count.
pub(super) fn lights_in_head(numbers: usize) -> Option<usize> {
    let lights = numbers.checked_sub(AMBIENT.numbers() + 2)?;
    let each = LIGHT.numbers();
    (lights % each == 0).then_some(lights / each)
}
