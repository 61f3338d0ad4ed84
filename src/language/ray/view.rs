//! A camera as the view comment of a `.ray` text.

use std::fmt::Write;

use super::origins::Origins;
use super::table::VIEW;
use crate::language::table::Field;
use crate::language::view::{Numbers, beginning, differ, line_ending, literal};
use crate::scene::{Camera, Lens, Size};
use crate::text::{Edit, Span, spell_like};

/// The fields of the view.
pub(super) fn fields() -> impl Iterator<Item = &'static Field> {
    VIEW.iter()
}

/// A camera's numbers, in the order of [`VIEW`].
pub(super) fn numbers(camera: &Camera) -> Numbers {
    let (Lens::Perspective(angle) | Lens::Orthographic(angle)) = camera.lens;
    let Size { width, height } = camera.size;
    vec![
        camera.eye.to_array().into(),
        camera.target.to_array().into(),
        camera.up.to_array().into(),
        vec![angle],
        vec![width.into(), height.into()],
    ]
}

/// The camera of which these are the numbers; `base` is one of the same text.
pub(super) fn camera(numbers: &Numbers, base: &Camera) -> Camera {
    let vector = |at: usize| glam::DVec3::from_slice(&numbers[at]);
    Camera {
        eye: vector(0),
        target: vector(1),
        up: vector(2),
        lens: Lens::Perspective(numbers[3][0]),
        size: Size {
            width: numbers[4][0] as u32,
            height: numbers[4][1] as u32,
        },
        ..*base
    }
}

/// The edits after which the text, whose camera is `before`, says `camera`.
pub(super) fn edits(text: &str, origins: &Origins, before: &Camera, camera: &Camera) -> Vec<Edit> {
    let (old, new) = (numbers(before), numbers(camera));
    let parts = origins.view.map_or([None; VIEW.len()], |view| view.parts);
    let mut edits = Vec::new();
    let mut missing = String::new();
    for (index, field) in VIEW.iter().enumerate() {
        let (old, new) = (&old[index], &new[index]);
        if let Some(spans) = parts[index] {
            let changed = old
                .iter()
                .zip(new)
                .zip(spans)
                .filter(|((old, new), _)| differ(**old, **new));
            edits.extend(changed.map(|((_, &value), span)| Edit {
                span,
                text: spell_like(span.of(text), value + 0.0),
            }));
        } else if old != new || (field.key == "eye" && before.lens != camera.lens) {
            // A missing eye follows the angle of view, so a new angle must pin it.
            write_part(&mut missing, field, new);
        }
    }
    edits.sort_by_key(|edit| edit.span.start());
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

/// A view comment as the text's first line, ended as its lines are.
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
