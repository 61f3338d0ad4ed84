//! A camera as the `camera`, `resolution` and `viewport` records of a `.dat` text.

use super::origins::{Origins, VIEW};
use super::table::RecordKind;
use super::tree::Tree;
use crate::language::table::Field;
use crate::language::view::{Numbers, beginning, differ, line_ending, literal};
use crate::scene::{Camera, Lens, Size};
use crate::text::{Edit, Span, spell_like};

/// What a text says that shows everything: `.dat` has no number for infinitely far.
const FARTHEST: f64 = 1e30;

/// The words that begin each record of [`VIEW`].
const WORDS: [&str; 3] = ["camera", "resolution", "viewport"];

/// The fields of the view.
pub(super) fn fields() -> impl Iterator<Item = &'static Field> {
    VIEW.into_iter().flat_map(RecordKind::fields)
}

/// A camera's numbers, in the order of [`fields`]. An angle of view is said by the focal length,
/// which leaves the resolution as it is; the height of an orthographic view by the resolution.
pub(super) fn numbers(camera: &Camera, origins: &Origins) -> Numbers {
    let rows = f64::from(camera.size.height);
    let (projection, focal, up) = match camera.lens {
        Lens::Perspective(angle) => {
            let up = origins.resolution[1];
            let focal = 0.5 * rows * up / libm::tan(0.5 * angle.to_radians());
            (0.0, plain(focal), up)
        }
        Lens::Orthographic(height) => (1.0, origins.focal, plain(height / rows)),
    };
    let across = if camera.pixel_aspect == 1.0 {
        up
    } else {
        plain(up * camera.pixel_aspect)
    };
    let [near, far] = camera.depths;
    vec![
        vec![projection],
        camera.eye.to_array().into(),
        camera.target.to_array().into(),
        camera.up.to_array().into(),
        vec![focal],
        vec![near],
        vec![far.min(FARTHEST)],
        vec![across, up],
        vec![camera.size.width.into(), rows],
    ]
}

/// The number that people would write: one of fifteen digits where that is the same but for the
/// rounding of the few operations that lead from a camera's numbers to the text's and back.
fn plain(number: f64) -> f64 {
    let short = format!("{number:.14e}").parse().unwrap_or(number);
    if (short - number).abs() <= 8.0 * f64::EPSILON * number.abs() {
        short
    } else {
        number
    }
}

/// The camera of which these are the numbers; `base` is one of the same text.
pub(super) fn camera(numbers: &Numbers, base: &Camera, origins: &Origins) -> Camera {
    let vector = |at: usize| glam::DVec3::from_slice(&numbers[at]);
    let [across, up] = [numbers[7][0], numbers[7][1]];
    let extent = numbers[8][1] * up;
    let before = self::numbers(base, origins);
    let (projection, focal) = (numbers[0][0], numbers[4][0]);
    let lens = match base.lens {
        // Seen from the target, the picture keeps its size.
        Lens::Orthographic(height) if projection == 0.0 => {
            let distance = (base.eye - base.target).length();
            Lens::Perspective(2.0 * libm::atan(0.5 * height / distance).to_degrees())
        }
        Lens::Perspective(angle) if projection != 0.0 => {
            let distance = (base.eye - base.target).length();
            Lens::Orthographic(2.0 * distance * libm::tan(0.5 * angle.to_radians()))
        }
        lens if before[4] == numbers[4] && before[7] == numbers[7] && before[8] == numbers[8] => {
            lens
        }
        Lens::Perspective(_) => {
            Lens::Perspective(2.0 * libm::atan(0.5 * extent / focal).to_degrees())
        }
        Lens::Orthographic(_) => Lens::Orthographic(extent),
    };
    Camera {
        eye: vector(1),
        target: vector(2),
        up: vector(3),
        lens,
        pixel_aspect: if before[7] == numbers[7] {
            base.pixel_aspect
        } else {
            across / up
        },
        depths: if before[5..7] == numbers[5..7] {
            base.depths
        } else {
            [numbers[5][0].max(0.0), numbers[6][0]]
        },
        focus: base.focus,
        size: Size {
            width: numbers[8][0] as u32,
            height: numbers[8][1] as u32,
        },
    }
}

/// The edits after which the text, whose camera is `before`, says `camera`.
pub(super) fn edits(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    let (old, new) = (numbers(before, origins), numbers(camera, origins));
    let mut edits = Vec::new();
    let mut missing = String::new();
    let mut index = 0;
    for ((record, kind), word) in origins.view.iter().zip(VIEW).zip(WORDS) {
        let fields: Vec<_> = kind.fields().collect();
        let own = index..index + fields.len();
        index = own.end;
        let (old, new) = (&old[own.clone()], &new[own]);
        // A missing resolution follows the focal length, so a new lens must pin it.
        let is_moved = kind == RecordKind::Resolution && before.lens != camera.lens;
        match record {
            Some(record) => {
                let spans = tree.tokens_of(*record).get(1..).unwrap_or_default();
                let numbers =
                    fields
                        .iter()
                        .zip(old.iter().zip(new))
                        .flat_map(|(field, (old, new))| {
                            old.iter().zip(new).map(move |pair| (*field, pair))
                        });
                let changed = numbers
                    .zip(spans)
                    .filter(|((_, (old, new)), _)| differ(**old, **new));
                edits.extend(changed.map(|((field, (_, &number)), &span)| Edit {
                    span,
                    text: respelled(span.of(text), field, number),
                }));
            }
            None if old != new || is_moved => {
                missing.push_str(&record_of(word, &fields, new));
                missing.push_str(line_ending(text));
            }
            None => {}
        }
    }
    if !missing.is_empty() {
        edits.push(Edit {
            span: Span::at(beginning(text)),
            text: missing,
        });
    }
    edits.sort_by_key(|edit| edit.span.start());
    edits
}

/// A number spelled like the literal it replaces, if that is one.
fn respelled(old: &str, field: &Field, number: f64) -> String {
    match field.kind {
        crate::language::table::Kind::Choice(_) => literal(field, number),
        _ => spell_like(old, number + 0.0),
    }
}

/// A whole record.
fn record_of(word: &str, fields: &[&'static Field], numbers: &[Vec<f64>]) -> String {
    let parts = fields.iter().zip(numbers).map(|(field, numbers)| {
        let literals: Vec<_> = numbers
            .iter()
            .map(|&number| literal(field, number))
            .collect();
        literals.join(" ")
    });
    let parts: Vec<_> = parts.collect();
    format!("{word} {}", parts.join("  "))
}
