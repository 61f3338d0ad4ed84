//! The comments of a `.ray` text that have a meaning, which other readers of the format skip: that of
//! the render settings, `// render: KEY VALUE …`, and that of the view:
//! `// view: eye x y z target x y z up x y z fov deg size w h`, any subset, in any order.

use glam::DVec3;

use super::origins::ViewPlace;
use super::schema::VIEW;
use super::tree::{self, Tokens, after_key, comment_of_line};
use super::view;
use crate::camera::{CameraSpans, check, default_eye_and_target};
use crate::record::what;
use crate::rendering::{RenderPlace, given_again, read_comment};
use crate::report::{Name, no_number, number, quoted};
use crate::schema::{Field, Kind};
use crate::words::Words;
use geometry::{Aabb, normalise};
use scene::Camera;
use text::{Diagnostic, Findings, Severity, Span, is_integer, parse_number};

/// Indices in [`VIEW`].
const EYE: usize = VIEW.slot("eye");
const TARGET: usize = VIEW.slot("target");
const UP: usize = VIEW.slot("up");

/// The direction of the default eye from the centre of the scene.
const DEFAULT_SIDE: DVec3 = DVec3::new(0.4, 0.3, 1.0);

/// The content of a view comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewComment {
    comment: Span,
    parts: [Option<FieldNumbers>; VIEW.slots.len()],
}

/// The numbers of one field; the arrays are filled up to its number of components.
#[derive(Clone, Copy, Debug, Default)]
struct FieldNumbers {
    spans: [Span; 3],
    values: [f64; 3],
}

impl FieldNumbers {
    fn vector(&self) -> DVec3 {
        DVec3::from_array(self.values)
    }
}

impl ViewComment {
    /// The places of its parts.
    pub(super) fn place(&self) -> ViewPlace {
        ViewPlace {
            comment: self.comment,
            parts: self.parts.map(|part| part.map(|part| part.spans)),
        }
    }

    /// Whether it states both eye and target.
    pub(super) fn has_eye_and_target(&self) -> bool {
        has_eye_and_target(&self.parts)
    }

    /// The span of a part, or of the whole comment if the part is missing.
    fn span(&self, part: usize) -> Span {
        self.parts[part].map_or(self.comment, |found| {
            found.spans[0].to(found.spans[VIEW.field(part).kind.components() - 1])
        })
    }
}

/// Whether these parts of a view include both eye and target.
pub(super) fn has_eye_and_target<T>(parts: &[Option<T>; VIEW.slots.len()]) -> bool {
    parts[EYE].is_some() && parts[TARGET].is_some()
}

/// Finds the first well-formed view comment. Warns of malformed ones, which are ignored entirely,
/// and of well-formed ones after the first.
pub(super) fn find(text: &str, tokens: &Tokens, report: &mut Findings) -> Option<ViewComment> {
    let mut found = None;
    for (comment, body) in keyed(text, tokens, tree::VIEW) {
        let mut findings = Findings::default();
        match read(text, comment, body, &mut findings) {
            Err(malformed) => report.warning(|| Diagnostic {
                message: format!("{}; the whole comment is ignored", malformed.message),
                ..malformed
            }),
            Ok(view) if found.is_none() => {
                report.append(findings);
                found = Some(view);
            }
            Ok(_) => report.warning(|| {
                let message = "view: already given, this comment is ignored";
                Diagnostic::warning(comment, message, "one view comment")
            }),
        }
    }
    found
}

/// Finds the first comment with render settings. Warns of those after it.
pub(super) fn find_rendering(
    text: &str,
    tokens: &Tokens,
    report: &mut Findings,
) -> Option<RenderPlace> {
    let mut found: Option<RenderPlace> = None;
    for (comment, body) in keyed(text, tokens, tree::RENDER) {
        let mut findings = Findings::default();
        let Some(place) = read_comment(text, comment, body, &mut findings) else {
            report.append(findings);
            continue;
        };
        if found.is_some() {
            report.warning(|| given_again(comment));
        } else {
            report.append(findings);
            found = Some(place);
        }
    }
    found
}

/// The comments with a key, and what follows it.
fn keyed<'t>(
    text: &'t str,
    tokens: &'t Tokens,
    key: &'static str,
) -> impl Iterator<Item = (Span, Span)> + 't {
    tokens.keyed().filter_map(move |start| {
        let comment = comment_of_line(text, start)?;
        Some((comment, after_key(text, comment, key)?))
    })
}

/// Reads the parts of a view comment; an error is a warning for the text. Reports what is skipped.
fn read(
    text: &str,
    comment: Span,
    body: Span,
    report: &mut Findings,
) -> Result<ViewComment, Diagnostic> {
    let mut parts = [None; VIEW.slots.len()];
    let mut rest = Words::new(text, body);
    while let Some(key) = rest.next() {
        let word = key.of(text);
        let Some(index) = VIEW.fields().position(|field| field.key == word) else {
            return Err(unknown_word(key, word));
        };
        let field = VIEW.field(index);
        if parts[index].is_some() {
            let message = format!("view {word}: given twice");
            return Err(Diagnostic::warning(key, message, "each part once"));
        }
        parts[index] = Some(read_part(text, field, &mut rest, comment.end(), report)?);
    }
    Ok(ViewComment { comment, parts })
}

fn unknown_word(span: Span, word: &str) -> Diagnostic {
    let message = format!("view: unknown word {}", quoted(word));
    let diagnostic = Diagnostic::warning(span, message, "eye, target, up, fov or size");
    let meant = VIEW
        .fields()
        .find(|field| field.key.eq_ignore_ascii_case(word));
    match meant {
        Some(field) => diagnostic.with_hint(format!("write `{}`", field.key)),
        None => diagnostic,
    }
}

/// Reads the numbers of one part from the words after its key.
fn read_part(
    text: &str,
    field: &Field,
    words: &mut impl Iterator<Item = Span>,
    end: usize,
    report: &mut Findings,
) -> Result<FieldNumbers, Diagnostic> {
    let mut part = FieldNumbers::default();
    for (at, component) in field.kind.component_names().iter().enumerate() {
        let what = what(Name::View, field, component);
        let missing =
            |span| Diagnostic::warning(span, format!("{what}: missing"), field.allowed.words());
        let span = words.next().ok_or_else(|| missing(Span::at(end)))?;
        let word = span.of(text);
        let read = if field.kind.is_size() {
            parse_number(word)
        } else {
            number(span, word, report, || what.clone())
        };
        let value = match read {
            Ok(value) => value,
            Err(_) if VIEW.fields().any(|field| field.key == word) => return Err(missing(span)),
            Err(error) => {
                let expected = field.allowed.words();
                let severity = Severity::Warning;
                return Err(no_number(severity, span, word, &what, &expected, error));
            }
        };
        let fits = field.kind != Kind::Pixels || value <= f64::from(u32::MAX);
        let whole = field.kind != Kind::Pixels || is_integer(word);
        if !field.allowed.contains(value) || !fits || !whole {
            let limits = if fits {
                field.allowed.limits()
            } else {
                format!("{} at most", u32::MAX)
            };
            let message = format!("{what}: must be {limits}");
            return Err(Diagnostic::warning(span, message, field.allowed.words()));
        }
        (part.spans[at], part.values[at]) = (span, value);
    }
    if field.kind == Kind::Direction && normalise(part.vector()).is_none() {
        let span = part.spans[0].to(part.spans[2]);
        let message = format!("{}: must not be zero", what(Name::View, field, ""));
        return Err(Diagnostic::warning(span, message, "a direction"));
    }
    Ok(part)
}

/// Returns the camera of the view, with defaults for missing parts. `bounds` is called only if a
/// default needs it. Reports an unusable camera at the view or, without one, at `otherwise`.
pub(super) fn camera(
    comment: Option<&ViewComment>,
    bounds: impl FnOnce() -> Aabb,
    otherwise: Span,
    report: &mut Findings,
) -> Camera {
    let has = |part: usize| comment.is_some_and(|comment| comment.parts[part].is_some());
    let mut numbers = view::DEFAULT;
    let mut rest = &mut numbers[..];
    for (at, field) in VIEW.fields().enumerate() {
        let (own, behind) = rest.split_at_mut(field.kind.components());
        if let Some(part) = comment.and_then(|comment| comment.parts[at]) {
            own.copy_from_slice(&part.values[..own.len()]);
        }
        rest = behind;
    }
    if !(has(EYE) && has(TARGET)) {
        let fov = view::PLACES.fov.number(&numbers);
        let (eye, centre) = default_eye_and_target(bounds(), fov, DEFAULT_SIDE);
        if !has(EYE) {
            view::PLACES.eye.put(&mut numbers, eye.into());
        }
        if !has(TARGET) {
            view::PLACES.target.put(&mut numbers, centre.into());
        }
    }
    let camera = view::PLACES.camera(&numbers);
    let part = |part| comment.map_or(otherwise, |comment: &ViewComment| comment.span(part));
    let [eye, target] = match (has(EYE), has(TARGET)) {
        (true, true) => [part(EYE), part(TARGET)],
        (false, true) => [part(TARGET); 2],
        (_, false) => [part(EYE); 2],
    };
    let places = CameraSpans {
        eye,
        target,
        up: part(UP),
        whole: otherwise,
        remedy: "give eye and target in a comment: // view: eye x y z target x y z",
    };
    check(&camera, &places, report);
    camera
}
