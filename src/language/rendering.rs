//! Render settings in a text, in the place that other readers of its language skip, for all languages.

use std::sync::LazyLock;

use super::field_spans::{Component, FieldSpans, Insertion, Piece, Wanted};
use super::report::{number_in_comment, quoted};
use super::roles::{ANYWHERE, Role, role};
use super::schema::{Field, Kind, Named, Range};
use super::view::{beginning, line_ending, whole_lines};
use super::words::Words;
use scene::{RenderKey, Rendering, Values};
use text::{Diagnostic, Edit, Findings, SKIPPED, Span, did_you_mean, nearest_word};

/// The settings that texts may state, as fields in the order of the interface.
static FIELDS: LazyLock<Vec<(RenderKey, Field)>> =
    LazyLock::new(|| RenderKey::of_text().map(|key| (key, field(key))).collect());

/// The settings that texts may state.
pub fn settings() -> Vec<Named> {
    let named = |(key, field): &'static (RenderKey, Field)| Named {
        name: field.key,
        field,
        component: 0,
        default: key.value(&Rendering::default()),
    };
    FIELDS.iter().map(named).collect()
}

fn field(key: RenderKey) -> Field {
    let setting = key.setting();
    let number = |range: Range| Field {
        allowed: range,
        unit: setting.unit,
        ..Field::number(key.name(), range, setting.step, setting.doc)
    };
    match setting.values {
        Values::Words { names, .. } => Field {
            kind: Kind::Choice(names),
            ..Field::point(key.name(), setting.doc)
        },
        Values::Whole(least, most) => number(Range::Whole(least, most)),
        Values::Within(least, most) => number(Range::Within(least, most)),
        Values::Below(limit) => number(Range::Below(limit)),
        Values::NotNegative => number(Range::NotNegative),
    }
}

/// The render settings that a text states, and where.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RenderPlace {
    /// The comment or element that states them.
    pub(super) whole: Span,
    /// In the order of [`FIELDS`].
    parts: [Option<Part>; RenderKey::COUNT],
    /// Whether the comment or element holds anything else.
    pub(super) holds_more: bool,
    /// The settings.
    pub(super) rendering: Rendering,
}

/// The place of one setting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// From its key to the end of its value.
    pub(super) whole: Span,
    /// Its value.
    pub(super) value: Span,
}

impl RenderPlace {
    /// The place of a comment or element that states nothing yet.
    pub(super) fn new(whole: Span) -> Self {
        Self {
            whole,
            ..Self::default()
        }
    }

    /// Reads a setting. What is wrong with it is a warning, and it is skipped, but stays the place to edit
    /// unless the setting is stated again.
    pub(super) fn read(&mut self, key: &str, word: &str, part: Part, report: &mut Findings) {
        let Some(at) = index_of(key) else {
            self.holds_more = true;
            report.warning(|| unknown_key(part.whole, key));
            return;
        };
        let (stated, field) = &FIELDS[at];
        if stated.get(&self.rendering).is_some() {
            self.holds_more = true;
            report.warning(|| {
                let message = format!("render {key}: given twice");
                Diagnostic::warning(part.whole, message, "each key once")
                    .with_hint("the first one counts")
            });
            return;
        }
        match value(field, part.value, word, report) {
            Ok(value) => {
                self.parts[at] = Some(part);
                self.rendering = stated.with(value, &self.rendering);
            }
            Err(bad) => {
                self.holds_more = true;
                self.parts[at].get_or_insert(part);
                report.warning(|| {
                    let hint = match &bad.hint {
                        Some(hint) => format!("{SKIPPED}; {hint}"),
                        None => SKIPPED.to_owned(),
                    };
                    bad.with_hint(hint)
                });
            }
        }
    }

    /// Returns the edit that removes a setting, or all of the comment or element if that holds nothing
    /// else; `None` if it is not stated.
    pub(super) fn removal(&self, text: &str, key: &str, around: Around) -> Option<Edit> {
        let part = self.parts[index_of(key)?]?;
        let is_only = self.parts.iter().flatten().count() == 1 && !self.holds_more;
        let span = if is_only {
            around.of(text, self.whole)
        } else {
            with_blanks(text, part.whole)
        };
        Some(Edit {
            span,
            text: String::new(),
        })
    }
}

/// What is removed with a comment or element.
#[derive(Clone, Copy, Debug)]
pub(super) enum Around {
    /// Its line, if nothing else is on it.
    Line,
    /// The line end and indentation before it.
    Lead(Span),
}

impl Around {
    fn of(self, text: &str, whole: Span) -> Span {
        match self {
            Self::Lead(lead) => lead.to(whole),
            Self::Line => whole_lines(text, whole).unwrap_or_else(|| with_blanks(text, whole)),
        }
    }
}

/// A span with the blanks before it.
fn with_blanks(text: &str, span: Span) -> Span {
    let before = text[..span.start()].trim_end_matches([' ', '\t']);
    Span::new(before.len(), span.end())
}

/// Reads the first of these comments that states settings, each given with what follows its key. Warns
/// of those after it.
pub(super) fn first_comment(
    text: &str,
    comments: impl Iterator<Item = (Span, Span)>,
    report: &mut Findings,
) -> Option<RenderPlace> {
    let mut first = None;
    for (comment, body) in comments {
        let mut findings = Findings::default();
        let place = read_comment(text, comment, body, &mut findings);
        if first.is_some() && place.is_some() {
            report.warning(|| {
                let message = "render: already given, these settings are ignored";
                Diagnostic::warning(comment, message, "render settings once")
            });
            continue;
        }
        report.append(findings);
        first = first.or(place);
    }
    first
}

/// Reads the settings of a comment from its words; `None` if the first is no key: then it is only a
/// comment, with a warning if that looks like a misspelt key.
fn read_comment(
    text: &str,
    comment: Span,
    body: Span,
    report: &mut Findings,
) -> Option<RenderPlace> {
    let mut words = Words::new(text, body);
    let first = words.next()?;
    if index_of(first.of(text)).is_none() {
        if let Some(warning) = misspelt(text, first, words.next()) {
            report.warning(|| warning);
        }
        return None;
    }
    let mut words = Words::new(text, body).peekable();
    let mut place = RenderPlace::new(comment);
    while let Some(key) = words.next() {
        let word = key.of(text);
        let value = words.next_if(|next| index_of(next.of(text)).is_none());
        if index_of(word).is_none() {
            // What follows may be its values.
            let mut end = value.unwrap_or(key);
            while let Some(next) = words.next_if(|next| index_of(next.of(text)).is_none()) {
                end = next;
            }
            place.holds_more = true;
            report.warning(|| unknown_key(key.to(end), word));
            continue;
        }
        let Some(value) = value else {
            place.holds_more = true;
            report.warning(|| {
                let at = index_of(word);
                let expected = at.map_or_else(String::new, |at| FIELDS[at].1.expected());
                Diagnostic::warning(key, format!("render {word}: no value"), expected)
                    .with_hint(SKIPPED)
            });
            continue;
        };
        let part = Part {
            whole: key.to(value),
            value,
        };
        place.read(word, value.of(text), part, report);
    }
    Some(place)
}

/// The warning for a comment whose first word looks like a misspelt key with a value behind it, as in
/// `spp=4` or `integrater path`.
fn misspelt(text: &str, first: Span, second: Option<Span>) -> Option<Diagnostic> {
    let word = first.of(text);
    let (name, value) = word.split_once('=').unwrap_or((word, ""));
    let meant = nearest_word(name, keys())?;
    if value.is_empty() && second.is_none() {
        return None;
    }
    let message = format!("render: {} is no key: the comment is ignored", quoted(word));
    let warning = Diagnostic::warning(first, message, listed());
    let right = format!("{meant} {value}");
    let warning = warning.with_hint(format!("did you mean `{meant} VALUE`?"));
    Some(warning.with_fix(first, right.trim_end()))
}

/// The parts of a comment that states settings, each with its role in a merge: what is before the first
/// key, each key with its value, and the mark that ends the comment. Empty for any other comment.
pub fn parts_of_comment(text: &str, comment: Span) -> Vec<(Span, Role)> {
    const NAME: &str = "render:";
    const SETTING: u8 = b'R';
    let of = comment.of(text);
    let Some(at) = of.find(NAME) else {
        return Vec::new();
    };
    let start = comment.start() + at + NAME.len();
    let end = comment.start() + of.strip_suffix("-->").unwrap_or(of).len();
    if end < start {
        return Vec::new();
    }
    let mut parts = vec![(Span::new(comment.start(), start), ANYWHERE)];
    for word in Words::new(text, Span::new(start, end)) {
        match (index_of(word.of(text)), parts.len()) {
            (Some(key), _) => parts.push((word, role(SETTING, key))),
            (None, 1) => return Vec::new(),
            (None, last) => parts[last - 1].0 = parts[last - 1].0.to(word),
        }
    }
    if end < comment.end() {
        parts.push((Span::new(end, comment.end()), ANYWHERE));
    }
    parts
}

fn keys() -> impl Iterator<Item = &'static str> {
    RenderKey::of_text().map(RenderKey::name)
}

fn listed() -> String {
    keys().collect::<Vec<_>>().join(", ")
}

fn index_of(key: &str) -> Option<usize> {
    keys().position(|known| known == key)
}

fn unknown_key(span: Span, key: &str) -> Diagnostic {
    let message = format!("render: unknown key {}", quoted(key));
    // Its value needs no correction.
    let own = Span::new(span.start(), span.start() + key.len());
    let diagnostic = Diagnostic::warning(own, message, listed());
    Diagnostic {
        span,
        ..did_you_mean(diagnostic, nearest_word(key, keys()), Some(SKIPPED))
    }
}

/// The value of a setting: a number, or the index of a word; an error is a warning for the text.
fn value(field: &Field, span: Span, word: &str, report: &mut Findings) -> Result<f64, Diagnostic> {
    let what = || format!("render {}", field.key);
    if let Kind::Choice(words) = field.kind {
        let unknown = || {
            let message = format!("{}: unknown word {}", what(), quoted(word));
            let diagnostic = Diagnostic::warning(span, message, field.expected());
            did_you_mean(diagnostic, nearest_word(word, words.iter().copied()), None)
        };
        let (place, _) = field.chosen(word).ok_or_else(unknown)?;
        return Ok(place as f64);
    }
    number_in_comment(field, span, word, report, what)
}

/// What a text can state of the values that are asked for, as it spells them.
pub(super) fn spelled(rendering: &Rendering) -> Vec<(&'static str, String)> {
    let stated = RenderKey::stated(rendering).filter(|(key, _)| key.setting().is_of_text);
    stated.map(|(key, value)| (key.name(), value)).collect()
}

/// The settings as the words of a comment: ` spp 4 exposure 1`.
pub(super) fn words(rendering: &Rendering) -> String {
    let stated = spelled(rendering).into_iter();
    stated.fold(String::new(), |words, (key, value)| {
        format!("{words} {key} {value}")
    })
}

/// The fields of the settings; those that are not stated are inserted there, in this element if there
/// is none. What is not stated has the defaults of these settings.
pub(super) fn fields(
    place: Option<&RenderPlace>,
    defaults: &Rendering,
    insertion: &Insertion,
    element: Option<&'static str>,
) -> Vec<FieldSpans> {
    let stated = place.map_or_else(Default::default, |place| place.parts);
    let own = place.map(|place| place.rendering).unwrap_or_default();
    let effective = own.or(*defaults);
    let placed = |((key, field), part): (&'static (RenderKey, Field), Option<Part>)| {
        let component = Component {
            name: field.key,
            place: part.map(|part| part.value),
            default: key.value(&effective).into(),
            is_required: false,
        };
        FieldSpans::with_defaults(field, vec![component], element, insertion.clone())
    };
    FIELDS.iter().zip(stated).map(placed).collect()
}

/// Where further settings are inserted: at the end of the comment, or in a new one, the first line of
/// the text, which begins with `opening`.
pub(super) fn insertion(
    text: &str,
    place: Option<&RenderPlace>,
    opening: &'static str,
) -> Insertion {
    match place {
        Some(place) => Insertion::at(place.whole.end()),
        None => Insertion {
            before: vec![Piece::Literal(opening)],
            after: vec![Piece::Literal(line_ending(text))],
            ..Insertion::at(beginning(text))
        },
    }
}

/// Returns the edits that insert these values into a comment where the text omits them.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    super::field_spans::insertions(text, wanted, |implicit, values| {
        let names = implicit.components.iter().map(|own| own.name);
        let words = names
            .zip(values)
            .map(|(name, (_, value))| format!(" {name} {value}"));
        words.collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spelled_settings_read_back_as_they_were() {
        let nothing = Rendering::default();
        for key in RenderKey::of_text() {
            let values = key.setting().values.samples();
            for value in values.into_iter().chain([key.in_use(&nothing)]) {
                let settings = key.with(value, &nothing);
                let text = words(&settings);
                let body = Span::new(0, text.len());
                let mut report = Findings::default();
                let place = read_comment(&text, body, body, &mut report);
                let place = place.expect("its first word is a key");
                assert_eq!(place.rendering, settings, "{text}");
                assert!(report.is_empty(), "{text}");
            }
        }
    }
}
