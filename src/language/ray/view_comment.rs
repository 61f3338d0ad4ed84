//! The comments of a `.ray` text that have a meaning, which other readers of the format skip: that of
//! the render settings, `// render: KEY VALUE …`, and that of the view:
//! `// view: eye x y z target x y z up x y z fov deg size w h`, any subset, in any order.

use std::ops::Range;

use glam::DVec3;

use super::schema::VIEW;
use super::tree::{self, Tokens, comment_of_line};
use crate::camera::{CameraSpans, Pinhole, check, default_eye_and_target};
use crate::field_spans::FieldSpans;
use crate::record::what;
use crate::report::{Name, number_in_comment, quoted};
use crate::words::{Words, after_key};
use geometry::{Aabb, normalise};
use scene::Camera;
use text::{Diagnostic, Findings, Span, alternatives};

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

/// Indices in [`VIEW`].
const EYE: usize = VIEW.slot("eye");
const TARGET: usize = VIEW.slot("target");
const UP: usize = VIEW.slot("up");

/// The direction of the default eye from the centre of the scene.
const DEFAULT_SIDE: DVec3 = DVec3::new(0.4, 0.3, 1.0);

/// What a text says of its view.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewComment {
    /// The whole comment, if there is one.
    pub(super) comment: Option<Span>,
    /// Whether it states each field of [`VIEW`].
    states: [bool; VIEW.slots.len()],
    /// All numbers, with defaults for those that are not stated.
    numbers: [f64; VIEW.numbers()],
    /// The tokens of those that are.
    spans: [Span; VIEW.numbers()],
}

/// The view of a text without a view comment.
impl Default for ViewComment {
    fn default() -> Self {
        Self {
            comment: None,
            states: [false; VIEW.slots.len()],
            numbers: DEFAULT,
            spans: [Span::default(); VIEW.numbers()],
        }
    }
}

impl ViewComment {
    /// Whether it states both eye and target.
    pub(super) fn has_eye_and_target(&self) -> bool {
        self.states[EYE] && self.states[TARGET]
    }

    /// The fields of the view, without places if they are not stated.
    pub(super) fn fields(&self) -> Vec<FieldSpans> {
        let fields = VIEW.fields().enumerate().map(|(at, field)| {
            let spans = self.tokens(at).unwrap_or_default().to_vec();
            FieldSpans::explicit(field, spans)
        });
        fields.collect()
    }

    /// The tokens of a field's numbers, if it is stated.
    fn tokens(&self, field: usize) -> Option<&[Span]> {
        self.states[field].then(|| &self.spans[numbers_of(field)])
    }

    /// The span of a field, or of the whole comment if that does not state it.
    fn span(&self, field: usize) -> Option<Span> {
        match self.tokens(field) {
            Some(tokens) => Some(tokens[0].to(tokens[tokens.len() - 1])),
            None => self.comment,
        }
    }

    /// Reads the numbers of a field from the words after its key.
    fn read_field(
        &mut self,
        field: usize,
        text: &str,
        words: &mut Words<'_>,
        report: &mut Findings,
    ) -> Result<(), Diagnostic> {
        let is_up = field == UP;
        let (numbers, field) = (numbers_of(field), VIEW.field(field));
        for (at, component) in numbers.zip(field.kind.component_names()) {
            let what = || what(Name::View, field, component);
            let end = || Span::at(self.comment.unwrap_or_default().end());
            let span = words.next().unwrap_or_else(end);
            let word = span.of(text);
            if span.is_empty() || VIEW.fields().any(|field| field.key == word) {
                let message = format!("{}: missing", what());
                return Err(Diagnostic::warning(span, message, field.allowed.words()));
            }
            self.numbers[at] = number_in_comment(field, span, word, report, what)?;
            self.spans[at] = span;
        }
        if is_up && normalise(PLACES.up.vector(&self.numbers)).is_none() {
            let span = PLACES.up.span(&self.spans);
            let message = format!("{}: must not be zero", what(Name::View, field, ""));
            return Err(Diagnostic::warning(span, message, "a direction"));
        }
        Ok(())
    }

    /// Returns the camera of the view, with defaults for missing parts. `bounds` is called only if a
    /// default needs it. Reports an unusable camera at the view or, without one, at `otherwise`.
    pub(super) fn camera(
        &self,
        bounds: impl FnOnce() -> Aabb,
        otherwise: Span,
        report: &mut Findings,
    ) -> Camera {
        let mut numbers = self.numbers;
        if !self.has_eye_and_target() {
            let fov = PLACES.fov.number(&numbers);
            let (eye, centre) = default_eye_and_target(bounds(), fov, DEFAULT_SIDE);
            if !self.states[EYE] {
                PLACES.eye.put(&mut numbers, eye.into());
            }
            if !self.states[TARGET] {
                PLACES.target.put(&mut numbers, centre.into());
            }
        }
        let camera = PLACES.camera(&numbers);
        let span = |field| self.span(field).unwrap_or(otherwise);
        let [eye, target] = match (self.states[EYE], self.states[TARGET]) {
            (true, true) => [span(EYE), span(TARGET)],
            (false, true) => [span(TARGET); 2],
            (_, false) => [span(EYE); 2],
        };
        let places = CameraSpans {
            eye,
            target,
            up: span(UP),
            whole: otherwise,
            remedy: "give eye and target in a comment: // view: eye x y z target x y z",
        };
        check(&camera, &places, report);
        camera
    }
}

/// The indices of a field's numbers.
fn numbers_of(field: usize) -> Range<usize> {
    let before = VIEW.fields().take(field);
    let first = before.map(|field| field.kind.components()).sum();
    first..first + VIEW.field(field).kind.components()
}

/// Finds the first well-formed view comment. Warns of malformed ones, which are ignored entirely,
/// and of well-formed ones after the first.
pub(super) fn find(text: &str, tokens: &Tokens, report: &mut Findings) -> ViewComment {
    let mut found = ViewComment::default();
    for (comment, body) in keyed(text, tokens, tree::VIEW) {
        let mut findings = Findings::default();
        match read(text, comment, body, &mut findings) {
            Err(malformed) => report.warning(|| Diagnostic {
                message: format!("{}; the whole comment is ignored", malformed.message),
                ..malformed
            }),
            Ok(view) if found.comment.is_none() => {
                report.append(findings);
                found = view;
            }
            Ok(_) => report.warning(|| {
                let message = "view: already given, this comment is ignored";
                Diagnostic::warning(comment, message, "one view comment")
            }),
        }
    }
    found
}

/// The comments with a key, and what follows it.
pub(super) fn keyed<'t>(
    text: &'t str,
    tokens: &'t Tokens,
    key: &'static str,
) -> impl Iterator<Item = (Span, Span)> + 't {
    tokens.keyed().filter_map(move |start| {
        let comment = comment_of_line(text, start)?;
        Some((comment, after_key(text, comment, "//", key)?))
    })
}

/// Reads a view comment; an error is a warning for the text. Reports what is skipped.
fn read(
    text: &str,
    comment: Span,
    body: Span,
    report: &mut Findings,
) -> Result<ViewComment, Diagnostic> {
    let mut view = ViewComment {
        comment: Some(comment),
        ..ViewComment::default()
    };
    let mut words = Words::new(text, body);
    while let Some(key) = words.next() {
        let word = key.of(text);
        let Some(field) = VIEW.fields().position(|field| field.key == word) else {
            return Err(unknown_word(key, word));
        };
        if std::mem::replace(&mut view.states[field], true) {
            let message = format!("view {word}: given twice");
            return Err(Diagnostic::warning(key, message, "each part once"));
        }
        view.read_field(field, text, &mut words, report)?;
    }
    Ok(view)
}

fn unknown_word(span: Span, word: &str) -> Diagnostic {
    let keys = || VIEW.fields().map(|field| field.key);
    let message = format!("view: unknown word {}", quoted(word));
    let diagnostic = Diagnostic::warning(span, message, alternatives(keys()));
    match keys().find(|key| key.eq_ignore_ascii_case(word)) {
        Some(key) => diagnostic
            .with_hint(format!("write `{key}`"))
            .with_fix(span, key),
        None => diagnostic,
    }
}
