//! The view comment of a `.ray` text, invisible to other readers of the format:
//! `// view: eye x y z target x y z up x y z fov deg size w h`, any subset, in any order.

use glam::DVec3;

use super::origins::ViewPlace;
use super::table::VIEW;
use super::tree::{self, Comment, Marker};
use crate::geometry::{Aabb, normalise};
use crate::language::camera::{Places, check, default_eye_and_target};
use crate::language::record::what;
use crate::language::report::Name;
use crate::language::report::{no_number, number, quoted};
use crate::language::table::{Field, Kind};
use crate::scene::{Camera, Focus, Lens, Size};
use crate::text::{Diagnostic, Findings, Severity, Span, is_integer, parse_number};

/// Places in [`VIEW`].
const EYE: usize = 0;
const TARGET: usize = 1;
const UP: usize = 2;

/// From where the default view looks, seen from the centre of the scene.
const DEFAULT_SIDE: DVec3 = DVec3::new(0.4, 0.3, 1.0);

/// What a view comment says.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    comment: Span,
    parts: [Option<Part>; VIEW.len()],
}

/// The numbers of one field; of the arrays, as many entries as the field has components.
#[derive(Clone, Copy, Debug, Default)]
struct Part {
    spans: [Span; 3],
    values: [f64; 3],
}

impl Part {
    fn vector(&self) -> DVec3 {
        DVec3::from_array(self.values)
    }
}

impl View {
    /// Where it stands.
    pub(super) fn place(&self) -> ViewPlace {
        ViewPlace {
            comment: self.comment,
            parts: self.parts.map(|part| part.map(|part| part.spans)),
        }
    }

    /// Whether it says both where the camera stands and where it looks.
    pub(super) fn is_placed(&self) -> bool {
        says_place(&self.parts)
    }

    /// The text of a part, or of the whole comment if the part is missing.
    fn span(&self, part: usize) -> Span {
        self.parts[part].map_or(self.comment, |found| {
            found.spans[0].to(found.spans[VIEW[part].kind.components() - 1])
        })
    }
}

/// Whether these parts of a view say both where the camera stands and where it looks.
pub(super) fn says_place<T>(parts: &[Option<T>; VIEW.len()]) -> bool {
    parts[EYE].is_some() && parts[TARGET].is_some()
}

/// The first well-formed view comment. Warns of malformed ones, which are ignored whole, and of
/// well-formed ones after the first.
pub(super) fn find(text: &str, comments: &[Comment], report: &mut Findings) -> Option<View> {
    let mut found = None;
    for comment in comments {
        let Some(body) = body(text, comment) else {
            continue;
        };
        let mut read_over = Findings::default();
        match read(text, comment.span, body, &mut read_over) {
            Err(malformed) => report.warning(|| Diagnostic {
                message: format!("{}; the whole comment is ignored", malformed.message),
                ..malformed
            }),
            Ok(view) if found.is_none() => {
                report.append(read_over);
                found = Some(view);
            }
            Ok(_) => report.warning(|| {
                let message = "view: said before, this comment is ignored";
                Diagnostic::warning(comment.span, message, "one view comment")
            }),
        }
    }
    found
}

/// What follows `view:` in a comment that begins so.
fn body(text: &str, comment: &Comment) -> Option<Span> {
    const BLANK: [char; 7] = [' ', '\t', '\r', '\x0B', '\x0C', '\u{A0}', '\u{FEFF}'];
    if comment.marker != Marker::Slashes {
        return None;
    }
    let said = comment.span.of(text).strip_prefix("//")?;
    let body = said.trim_start_matches(BLANK).strip_prefix("view:")?;
    Some(Span::new(
        comment.span.end() - body.len(),
        comment.span.end(),
    ))
}

/// Reads the parts of a view comment; the error is a warning. What is read over is reported.
fn read(text: &str, comment: Span, body: Span, report: &mut Findings) -> Result<View, Diagnostic> {
    let mut parts = [None; VIEW.len()];
    let words = tree::words(text, body);
    let mut rest = words.iter().copied();
    while let Some(key) = rest.next() {
        let word = key.of(text);
        let Some(index) = VIEW.iter().position(|field| field.key == word) else {
            return Err(unknown_word(key, word));
        };
        let field = &VIEW[index];
        if parts[index].is_some() {
            let message = format!("view {word}: said twice");
            return Err(Diagnostic::warning(key, message, "each part once"));
        }
        parts[index] = Some(read_part(text, field, &mut rest, comment.end(), report)?);
    }
    Ok(View { comment, parts })
}

fn unknown_word(span: Span, word: &str) -> Diagnostic {
    let message = format!("view: unknown word {}", quoted(word));
    let diagnostic = Diagnostic::warning(span, message, "eye, target, up, fov or size");
    let meant = VIEW
        .iter()
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
) -> Result<Part, Diagnostic> {
    let mut part = Part::default();
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
            Err(_) if VIEW.iter().any(|field| field.key == word) => return Err(missing(span)),
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

/// The camera: what the view says, and defaults for what it does not. `bounds` is asked for only
/// if a default needs it. Reports a camera that cannot be used at the view or, without one, at
/// `otherwise`.
pub(super) fn camera(
    view: Option<&View>,
    bounds: impl FnOnce() -> Aabb,
    otherwise: Span,
    report: &mut Findings,
) -> Camera {
    let [eye, target, up, fov, size] = view.map_or([None; VIEW.len()], |view| view.parts);
    let fov = fov.map_or(45.0, |fov| fov.values[0]);
    let (eye, target) = match (eye, target) {
        (Some(eye), Some(target)) => (eye.vector(), target.vector()),
        (eye, target) => {
            let (default_eye, centre) = default_eye_and_target(bounds(), fov, DEFAULT_SIDE);
            (
                eye.map_or(default_eye, |eye| eye.vector()),
                target.map_or(centre, |target| target.vector()),
            )
        }
    };
    let camera = Camera {
        eye,
        target,
        up: up.map_or(DVec3::Y, |up| up.vector()),
        lens: Lens::Perspective(fov),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus::PINHOLE,
        size: size.map_or(
            Size {
                width: 800,
                height: 600,
            },
            |size| Size {
                width: size.values[0] as u32,
                height: size.values[1] as u32,
            },
        ),
    };
    let part = |part| view.map_or(otherwise, |view: &View| view.span(part));
    let said = |part: usize| view.is_some_and(|view| view.parts[part].is_some());
    let [eye, target] = match (said(EYE), said(TARGET)) {
        (true, true) => [part(EYE), part(TARGET)],
        (false, true) => [part(TARGET); 2],
        (_, false) => [part(EYE); 2],
    };
    let places = Places {
        eye,
        target,
        up: part(UP),
        whole: otherwise,
        remedy: "say eye and target in a comment: // view: eye x y z target x y z",
    };
    check(&camera, &places, report);
    camera
}
