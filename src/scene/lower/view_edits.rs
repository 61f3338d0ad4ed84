//! Writing a camera back into a `.ray` text, as its view comment.

use std::cmp::Ordering;
use std::fmt::Write;

use crate::scene::fields::VIEW;
use crate::scene::{Camera, Origins};
use crate::text::{Edit, Span, spell_like};

/// Numbers in the order of [`VIEW`].
type Numbers = [[f64; 3]; VIEW.len()];

/// The edits after which the text, whose camera is `before`, says `camera`.
pub(super) fn view_edits(
    text: &str,
    origins: &Origins,
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    let (old, new) = (numbers(before), numbers(camera));
    let parts = origins.view.map_or([None; VIEW.len()], |view| view.parts);
    let mut edits = Vec::new();
    let mut missing = String::new();
    for (index, field) in VIEW.iter().enumerate() {
        let components = field.kind.components();
        let (old, new) = (&old[index][..components], &new[index][..components]);
        if let Some(spans) = parts[index] {
            let changed = old
                .iter()
                .zip(new)
                .zip(spans)
                .filter(|((old, new), _)| differ(**old, **new));
            edits.extend(changed.map(|((_, &value), span)| Edit {
                span,
                text: spell_like(span.of(text), value),
            }));
        } else if old != new || (field.key == "eye" && differ(before.fov, camera.fov)) {
            // A missing eye follows the angle of view, so a new angle must pin it.
            write_part(&mut missing, field.key, new);
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
    const MARK: &str = "\u{FEFF}";
    let start = if text.starts_with(MARK) {
        MARK.len()
    } else {
        0
    };
    let newline = text.find('\n');
    let ending = match newline.and_then(|at| at.checked_sub(1)) {
        Some(before) if text.as_bytes()[before] == b'\r' => "\r\n",
        _ => "\n",
    };
    Edit {
        span: Span::at(start),
        text: format!("// view:{parts}{ending}"),
    }
}

fn write_part(out: &mut String, key: &str, values: &[f64]) {
    out.push(' ');
    out.push_str(key);
    for value in values {
        // Writing to a string cannot fail.
        let _ = write!(out, " {value}");
    }
}

/// Whether the text must change to say another number; it says 0 for both zeros.
fn differ(old: f64, new: f64) -> bool {
    old.partial_cmp(&new) != Some(Ordering::Equal)
}

/// A camera's numbers, 0 for −0.
fn numbers(camera: &Camera) -> Numbers {
    camera.numbers().map(|part| part.map(|number| number + 0.0))
}
