//! Records: runs of numbers that the table of fields gives a meaning, checked against their ranges.

use glam::{DMat3, DVec3};

use super::form::digits::UNIT_TOLERANCE;
use super::report::{Name, out_of_range};
use super::schema::{Field, Kind};
use geometry::{FLATTEST, normalise};
use text::{Diagnostic, Findings, Span, concise};

/// The numbers of one node, as far as the text gives them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record<'a> {
    /// The node.
    pub(super) name: Name,
    /// The numbers; NaN where a token could not be read.
    pub(super) values: &'a [f64],
    /// The token of each number.
    pub(super) spans: &'a [Span],
}

/// The numbers of one field of a record.
struct FieldSlice<'a> {
    field: &'static Field,
    values: &'a [f64],
    spans: &'a [Span],
}

impl<'a> Record<'a> {
    /// The complete fields, with their numbers.
    fn parts(
        self,
        fields: impl Iterator<Item = &'static Field>,
    ) -> impl Iterator<Item = FieldSlice<'a>> {
        let mut at = 0;
        fields.map_while(move |field| {
            let range = at..at + field.kind.components();
            at = range.end;
            Some(FieldSlice {
                field,
                values: self.values.get(range.clone())?,
                spans: self.spans.get(range)?,
            })
        })
    }

    /// Splits off the first `count` numbers as a record of their own.
    pub(super) fn split_at(self, count: usize) -> (Self, Self) {
        let (values, spans) = (self.values.split_at(count), self.spans.split_at(count));
        let part = |values, spans| Self {
            name: self.name,
            values,
            spans,
        };
        (part(values.0, spans.0), part(values.1, spans.1))
    }

    /// Reports numbers outside their ranges and invalid directions.
    pub(super) fn check(self, fields: impl Iterator<Item = &'static Field>, report: &mut Findings) {
        for part in self.parts(fields) {
            match part.field.kind {
                Kind::Direction | Kind::Axis => self.check_direction(&part, report),
                Kind::HalfSpace if DVec3::from_slice(part.values) == DVec3::ZERO => {
                    report.error(|| {
                        let name = what(self.name, part.field, "");
                        let message = format!("{name}: its normal must not be zero");
                        Diagnostic::error(part.spans[0].to(part.spans[2]), message, "a direction")
                    });
                }
                // Checked when they were read.
                Kind::Choice(_) | Kind::Reference(_) | Kind::Name(_) | Kind::Word => {}
                _ => self.check_numbers(&part, report),
            }
        }
    }

    fn check_numbers(self, part: &FieldSlice, report: &mut Findings) {
        let field = part.field;
        if let Some([least, greatest]) = field.usual.ends()
            && part
                .values
                .iter()
                .all(|&value| least <= value && value <= greatest)
        {
            return;
        }
        let names = field.kind.component_names();
        for ((&value, &span), component) in part.values.iter().zip(part.spans).zip(names) {
            if value.is_nan() || field.usual.contains(value) {
                continue;
            }
            // Formatted only for a message that is kept.
            let what = || what(self.name, field, component);
            let diagnostic = || out_of_range(field, span, value, &what());
            if field.allowed.contains(value) {
                report.warning(diagnostic);
            } else {
                report.error(diagnostic);
            }
        }
    }

    fn check_direction(self, part: &FieldSlice, report: &mut Findings) {
        let vector = DVec3::from_slice(part.values);
        if vector.is_nan() {
            return;
        }
        let span = part.spans[0].to(part.spans[2]);
        let what = || what(self.name, part.field, "");
        // Scaled so that no square overflows.
        let largest = vector.abs().max_element();
        let length = largest * (vector / largest).length();
        if normalise(vector).is_none() {
            report.error(|| {
                let message = format!("{}: must not be zero", what());
                Diagnostic::error(span, message, "a direction of unit length")
            });
        } else if UNIT_TOLERANCE < (length - 1.0).abs() {
            report.warning(|| {
                let message = format!("{}: has length {}, not 1", what(), rounded(length));
                let hint = match part.field.kind {
                    Kind::Axis => "it is used as given: the width is a multiple of its length",
                    _ => "it is normalised; sizes have fields of their own",
                };
                Diagnostic::warning(span, message, "a direction of unit length").with_hint(hint)
            });
        }
    }

    /// Reports directions that do not form a right-handed orthogonal frame.
    pub(super) fn check_frame(
        self,
        fields: impl Iterator<Item = &'static Field>,
        report: &mut Findings,
    ) {
        let Some(frame) = self.frame(fields) else {
            return;
        };
        let determinant = determinant(&frame);
        if determinant.is_some_and(|det| det.abs() < FLATTEST) {
            report.error(|| flat(self.name, &frame));
            return;
        }
        let [a, b, c] = &frame;
        for (first, second) in [(a, b), (a, c), (b, c)] {
            self.check_angle(first, second, report);
        }
        if determinant.is_some_and(|det| det < 0.0) {
            report.warning(|| {
                let cross = format!("{} × {}", a.key, b.key);
                let message = format!("{} {}: points opposite to {cross}", self.name, c.key);
                Diagnostic::warning(c.span, message, format!("the direction {cross}"))
                    .with_hint("the left-handed frame is used as given")
            });
        }
    }

    fn check_angle(self, first: &Axis, second: &Axis, report: &mut Findings) {
        let dot = match (first.direction, second.direction) {
            (Some(first), Some(second)) => first.dot(second),
            _ => return,
        };
        if UNIT_TOLERANCE < dot.abs() {
            report.warning(|| {
                let message = format!(
                    "{} {}: not at a right angle to {} (dot product {})",
                    self.name,
                    second.key,
                    first.key,
                    rounded(dot)
                );
                let expected = format!("a direction at 90° to {}", first.key);
                Diagnostic::warning(second.span, message, expected)
                    .with_hint("the skewed frame is used as given")
            });
        }
    }

    /// The three directions of a shape; `None` if it has fewer.
    fn frame(self, fields: impl Iterator<Item = &'static Field>) -> Option<[Axis; 3]> {
        let mut axes = self
            .parts(fields)
            .filter(|part| matches!(part.field.kind, Kind::Direction | Kind::Axis))
            .map(|part| Axis {
                key: part.field.key,
                direction: normalise(DVec3::from_slice(part.values)),
                span: part.spans[0].to(part.spans[2]),
            });
        Some([axes.next()?, axes.next()?, axes.next()?])
    }
}

/// A direction of a frame; `None` if it is zero or unreadable.
struct Axis {
    key: &'static str,
    direction: Option<DVec3>,
    span: Span,
}

/// The determinant of the unit directions; `None` if one could not be read.
fn determinant([a, b, c]: &[Axis; 3]) -> Option<f64> {
    Some(DMat3::from_cols(a.direction?, b.direction?, c.direction?).determinant())
}

/// The error for directions that span no volume: at the first that is parallel to another,
/// otherwise at the third.
fn flat(name: Name, [a, b, c]: &[Axis; 3]) -> Diagnostic {
    let parallel = |first: &Axis, second: &Axis| {
        let across = first
            .direction
            .zip(second.direction)
            .map(|(u, v)| u.cross(v));
        across.is_some_and(|across| across.length() < FLATTEST)
    };
    let pair = [(a, b), (a, c), (b, c)]
        .into_iter()
        .find(|(first, second)| parallel(first, second));
    match pair {
        Some((first, second)) => Diagnostic::error(
            second.span,
            format!("{name} {}: is parallel to {}", second.key, first.key),
            format!("a direction at 90° to {}", first.key),
        ),
        None => Diagnostic::error(
            c.span,
            format!("{name} {}: lies in the plane of the other two", c.key),
            "a direction out of their plane",
        ),
    }
}

/// A field's component as named in messages: `object 2 (box) corner x`.
pub(super) fn what(name: Name, field: &Field, component: &str) -> String {
    let space = if component.is_empty() { "" } else { " " };
    match name {
        // The record is its only field.
        Name::Record(word) if word == field.key => format!("{word}{space}{component}"),
        _ => format!("{name} {}{space}{component}", field.key),
    }
}

/// A computed value for a message, rounded to four digits.
fn rounded(value: f64) -> String {
    match format!("{value:.3e}").parse() {
        Ok(rounded) if f64::is_finite(rounded) => concise(rounded),
        _ => "above 1.8e308".to_owned(),
    }
}
