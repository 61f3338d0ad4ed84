//! Conversion between cameras and view comments.

use std::fmt::Write;

use glam::DVec3;

use super::origins::Origins;
use super::table::VIEW;
use crate::slot::At;
use crate::table::{self, Field};
use crate::view::{Numbers, beginning, line_ending, literal, take};
use scene::{Camera, Focus, Lens, Size};
use text::{Edit, Span, spell_like};

/// The fields of the view.
pub(super) fn fields() -> impl Iterator<Item = &'static Field> {
    VIEW.iter()
}

/// The content of a view comment, with defaults for missing parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) eye: DVec3,
    pub(super) target: DVec3,
    pub(super) up: DVec3,
    pub(super) fov: f64,
    pub(super) size: Size,
}

const EYE: At<3> = At::of(VIEW, "eye");
const TARGET: At<3> = At::of(VIEW, "target");
const UP: At<3> = At::of(VIEW, "up");
const FOV: At<1> = At::of(VIEW, "fov");
const SIZE: At<2> = At::of(VIEW, "size");

impl View {
    /// Defaults for missing parts, except eye and target.
    const DEFAULT: Self = Self {
        eye: DVec3::ZERO,
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov: 45.0,
        size: Size {
            width: 800,
            height: 600,
        },
    };

    /// The camera it describes.
    pub(super) fn camera(&self) -> Camera {
        Camera {
            eye: self.eye,
            target: self.target,
            up: self.up,
            lens: Lens::Perspective(self.fov),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: self.size,
        }
    }

    /// The view that describes a camera.
    fn of(camera: &Camera) -> Self {
        let (Lens::Perspective(fov) | Lens::Orthographic(fov)) = camera.lens;
        Self {
            eye: camera.eye,
            target: camera.target,
            up: camera.up,
            fov,
            size: camera.size,
        }
    }

    /// The view with these numbers, in the order of [`VIEW`].
    fn from_numbers(numbers: &[f64]) -> Self {
        let [width, height] = SIZE.get(numbers);
        Self {
            eye: EYE.vector(numbers),
            target: TARGET.vector(numbers),
            up: UP.vector(numbers),
            fov: FOV.number(numbers),
            size: Size {
                width: width as u32,
                height: height as u32,
            },
        }
    }

    /// The view with these parts, each the numbers of its field in [`VIEW`], or defaults.
    pub(super) fn from_parts<'p>(parts: impl Iterator<Item = Option<&'p [f64]>>) -> Self {
        let mut numbers = Self::DEFAULT.numbers();
        let mut rest = &mut numbers[..];
        for (field, part) in VIEW.iter().zip(parts) {
            let (own, behind) = rest.split_at_mut(field.kind.components());
            if let Some(part) = part {
                own.copy_from_slice(part);
            }
            rest = behind;
        }
        Self::from_numbers(&numbers)
    }

    /// The numbers of the view, in the order of [`VIEW`].
    fn numbers(&self) -> Numbers {
        let mut numbers = vec![0.0; table::numbers(VIEW)];
        EYE.put(&mut numbers, self.eye.into());
        TARGET.put(&mut numbers, self.target.into());
        UP.put(&mut numbers, self.up.into());
        FOV.put(&mut numbers, [self.fov]);
        let Size { width, height } = self.size;
        SIZE.put(&mut numbers, [width.into(), height.into()]);
        numbers
    }
}

/// The numbers of a camera, in the order of [`VIEW`].
pub(super) fn numbers(camera: &Camera) -> Numbers {
    View::of(camera).numbers()
}

/// The camera described by these numbers.
pub(super) fn camera(numbers: &Numbers) -> Camera {
    View::from_numbers(numbers).camera()
}

/// Returns the edits that change the text's camera from `before` to `camera`.
pub(super) fn edits(text: &str, origins: &Origins, before: &Camera, camera: &Camera) -> Vec<Edit> {
    let (old, new) = (numbers(before), numbers(camera));
    let parts = origins.view.map_or([None; VIEW.len()], |view| view.parts);
    let mut edits = Vec::new();
    let mut missing = String::new();
    let (mut old, mut new) = (&old[..], &new[..]);
    for (field, part) in VIEW.iter().zip(parts) {
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
