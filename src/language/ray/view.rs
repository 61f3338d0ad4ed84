//! Conversion between cameras and view comments.

use super::view_comment::{DEFAULT, PLACES, ViewComment};
use crate::field_spans::FieldSpans;
use crate::view::{Numbers, beginning, line_ending, literals, respelled, take};
use scene::Camera;
use text::{Edit, Span};

/// The numbers of a camera, in the order of the table.
pub(super) fn numbers(camera: &Camera) -> Numbers {
    PLACES.numbers(camera, &DEFAULT)
}

/// Returns the edits that change the camera of a text with this view from `before` to `camera`.
pub(super) fn edits(text: &str, view: &ViewComment, before: &Camera, camera: &Camera) -> Vec<Edit> {
    let [old, new] = [before, camera].map(numbers);
    let fields = view.fields();
    let mut edits = respelled(text, &fields, [&old, &new]);
    let mut missing = String::new();
    let (mut old, mut new) = (&old[..], &new[..]);
    for FieldSpans { field, spans, .. } in &fields {
        let (old, new) = (take(&mut old, field), take(&mut new, field));
        // A missing eye depends on the angle of view, so a new angle must pin it.
        let is_pinned = field.key == "eye" && before.lens != camera.lens;
        if spans.is_empty() && (old != new || is_pinned) {
            let words = literals(&[field], new).concat().join(" ");
            missing.extend([" ", field.key, " ", &words]);
        }
    }
    Edit::sort(&mut edits);
    if !missing.is_empty() {
        edits.push(match view.comment {
            Some(comment) => Edit {
                span: Span::at(comment.end()),
                text: missing,
            },
            None => Edit {
                span: Span::at(beginning(text)),
                text: format!("// view:{missing}{}", line_ending(text)),
            },
        });
    }
    edits
}
