//! Conversion between cameras and view comments.

use std::fmt::Write;

use super::origins::Origins;
use super::schema::VIEW;
use crate::camera::Pinhole;
use crate::schema::Field;
use crate::view::{Numbers, beginning, line_ending, literal, take};
use scene::Camera;
use text::{Edit, Span, spell_like};

/// The fields of the view.
pub(super) fn fields() -> impl Iterator<Item = &'static Field> {
    VIEW.fields()
}

/// The numbers of a view without a comment, in the order of [`VIEW`], but for eye and target.
pub(super) const DEFAULT: [f64; VIEW.numbers()] = [
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 45.0, 800.0, 600.0,
];

/// The positions of the numbers.
pub(super) const PLACES: Pinhole = Pinhole {
    eye: VIEW.at("eye"),
    target: VIEW.at("target"),
    up: VIEW.at("up"),
    fov: VIEW.at("fov"),
    size: VIEW.at("size"),
};

/// The numbers of a camera, in the order of [`VIEW`].
pub(super) fn numbers(camera: &Camera) -> Numbers {
    PLACES.numbers(camera, &DEFAULT)
}

/// Returns the edits that change the text's camera from `before` to `camera`.
pub(super) fn edits(text: &str, origins: &Origins, before: &Camera, camera: &Camera) -> Vec<Edit> {
    let (old, new) = (numbers(before), numbers(camera));
    let parts = origins
        .view
        .map_or([None; VIEW.slots.len()], |view| view.parts);
    let mut edits = Vec::new();
    let mut missing = String::new();
    let (mut old, mut new) = (&old[..], &new[..]);
    for (field, part) in VIEW.fields().zip(parts) {
        let (old, new) = (take(&mut old, field), take(&mut new, field));
        if let Some(spans) = part {
            let changed = old
                .iter()
                .zip(new)
                .zip(spans)
                .filter(|((old, new), _)| old != new);
            edits.extend(changed.map(|((_, &value), span)| Edit {
                span,
                text: spell_like(span.of(text), value + 0.0),
            }));
        } else if old != new || (field.key == "eye" && before.lens != camera.lens) {
            // A missing eye depends on the angle of view, so a new angle must pin it.
            write_part(&mut missing, field, new);
        }
    }
    Edit::sort(&mut edits);
    if !missing.is_empty() {
        edits.push(match origins.view {
            Some(view) => Edit {
                span: Span::at(view.comment.end()),
                text: missing,
            },
            None => new_comment(text, &missing),
        });
    }
    edits
}

/// Inserts a view comment as the text's first line, with the text's line ending.
fn new_comment(text: &str, parts: &str) -> Edit {
    Edit {
        span: Span::at(beginning(text)),
        text: format!("// view:{parts}{}", line_ending(text)),
    }
}

fn write_part(out: &mut String, field: &Field, values: &[f64]) {
    out.push(' ');
    out.push_str(field.key);
    for &value in values {
        // Writing to a string cannot fail.
        let _ = write!(out, " {}", literal(field, value));
    }
}
