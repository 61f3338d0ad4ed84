//! Render settings in a text, in the place that other readers of its language skip: one table of keys
//! for all languages.

use super::placed::{Implicit, ImplicitAttribute, Insertion, Piece, Placed, Wanted};
use super::report::{did_you_mean, no_number, number, quoted};
use super::table::{Field, Kind, Range};
use super::view::line_from;
use super::words::Words;
use crate::scene::{
    EXPOSURES, FalloffRule, Filter, GlossRule, Integrator, MAX_DEPTH, MAX_SPP, Rendering, Transfer,
};
use crate::text::{
    Diagnostic, Edit, Findings, SKIPPED, Severity, Span, is_integer, line_end, nearest_word,
    next_line, parse_number,
};

/// The keys, in the order of the interface.
pub(super) const RENDER: &[Field; 9] = &[
    choice(
        "integrator",
        &[
            Integrator::Whitted.name(),
            Integrator::Path.name(),
            Integrator::Photon.name(),
        ],
        "How light is traced: Whitted ray tracing, path tracing, or paths with photons for caustics.",
    ),
    count(
        "depth",
        Range::Whole(0, MAX_DEPTH),
        "The maximum number of bounces; otherwise 8, or 64 with path tracing.",
    ),
    count(
        "spp",
        Range::Whole(1, MAX_SPP),
        "Samples per pixel of full-size pictures, at most where noise is set.",
    ),
    choice(
        "filter",
        &[
            Filter::Box.name(),
            Filter::Gaussian.name(),
            Filter::BlackmanHarris.name(),
        ],
        "The pixel filter of full-size pictures.",
    ),
    choice(
        "transfer",
        &[Transfer::Linear.name(), Transfer::Srgb.name()],
        "The curve from colours to 8-bit values.",
    ),
    Field {
        allowed: Range::Within(*EXPOSURES.start(), *EXPOSURES.end()),
        usual: Range::Within(*EXPOSURES.start(), *EXPOSURES.end()),
        unit: "stops",
        ..Field::number(
            "exposure",
            Range::Any,
            0.5,
            "Colours are multiplied by 2 to this power before the transfer curve.",
        )
    },
    choice(
        "falloff",
        &[FalloffRule::None.name(), FalloffRule::Square.name()],
        "square: point lights without a falloff of their own fall off with the squared distance.",
    ),
    choice(
        "gloss",
        &[GlossRule::None.name(), GlossRule::Exponent.name()],
        "exponent: the glossiness of blinn materials spreads their reflection and refraction.",
    ),
    Field {
        allowed: Range::Below(1.0),
        ..Field::number(
            "noise",
            Range::Below(1.0),
            0.005,
            "Adaptive sampling: pixels below this displayed error take no more samples. 0: off.",
        )
    },
];

const fn choice(key: &'static str, words: &'static [&'static str], doc: &'static str) -> Field {
    Field {
        kind: Kind::Choice(words),
        ..Field::point(key, doc)
    }
}

const fn count(key: &'static str, range: Range, doc: &'static str) -> Field {
    Field {
        allowed: range,
        ..Field::number(key, range, 1.0, doc)
    }
}

/// The key of a render setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderKey(&'static str);

impl RenderKey {
    /// All keys.
    pub fn all() -> impl Iterator<Item = Self> {
        RENDER.iter().map(|field| Self(field.key))
    }

    /// The key with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|key| key.0 == name)
    }

    /// The name, such as `depth`.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// The keys of what is asked for, each with its value as the text spells it.
    pub fn stated(asked: &Rendering) -> impl Iterator<Item = (Self, String)> {
        let stated = spelled(asked).into_iter();
        stated.map(|(key, value)| (Self(key), value))
    }

    /// The value that is asked for, or else the default, as the text spells it.
    pub fn value(self, asked: &Rendering) -> String {
        let stated = spelled(asked).into_iter().find(|(key, _)| *key == self.0);
        stated.map_or_else(|| default_of(self.0, asked).to_owned(), |(_, value)| value)
    }

    /// This one of these settings alone.
    #[must_use]
    pub fn alone(self, asked: &Rendering) -> Rendering {
        let others = Self::all().filter(|key| *key != self);
        let alone = others.fold(*asked, |asked, key| key.cleared(&asked));
        Rendering {
            clamp: None,
            ..alone
        }
    }

    /// These settings without this one.
    pub fn cleared(self, asked: &Rendering) -> Rendering {
        let mut asked = *asked;
        set(&mut asked, self.0, None);
        asked
    }
}

/// The render settings that a text states, and where.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RenderPlace {
    /// The comment or element that states them.
    pub(super) whole: Span,
    /// In the order of [`RENDER`].
    pub(super) parts: [Option<Part>; RENDER.len()],
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
        if spelled(&self.rendering)
            .iter()
            .any(|(stated, _)| *stated == key)
        {
            self.holds_more = true;
            report.warning(|| {
                let message = format!("render {key}: given twice");
                Diagnostic::warning(part.whole, message, "each key once")
                    .with_hint("the first one counts")
            });
            return;
        }
        match value(&RENDER[at], part.value, word, report) {
            Ok(value) => {
                self.parts[at] = Some(part);
                set(&mut self.rendering, key, Some(value));
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
            let before = text[..part.whole.start()].trim_end_matches([' ', '\t']);
            Span::new(before.len(), part.whole.end())
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
            Self::Line => {
                let (start, end) = (line_from(text, whole.start()), line_end(text, whole.end()));
                let before = Span::new(start, whole.start());
                let behind = Span::new(whole.end(), end);
                let is_blank = |span: Span| span.of(text).trim().is_empty();
                if is_blank(before) && is_blank(behind) {
                    Span::new(start, next_line(text, end))
                } else {
                    Span::new(
                        text[..whole.start()].trim_end_matches([' ', '\t']).len(),
                        whole.end(),
                    )
                }
            }
        }
    }
}

/// Reads the settings of a comment from its words; `None` if the first is no key: then it is only a
/// comment, with a warning if that looks like a misspelt key.
pub(super) fn read_comment(
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
                let field = RENDER.iter().find(|field| field.key == word);
                let expected = field.map_or_else(String::new, Field::expected);
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
    let keys = RENDER.map(|field| field.key);
    let meant = nearest_word(name, keys)?;
    if value.is_empty() && second.is_none() {
        return None;
    }
    let message = format!("render: {} is no key: the comment is ignored", quoted(word));
    let warning = Diagnostic::warning(first, message, keys.join(", "));
    Some(warning.with_hint(format!("did you mean `{meant} VALUE`?")))
}

/// The warning for render settings after the first.
pub(super) fn given_again(span: Span) -> Diagnostic {
    let message = "render: already given, these settings are ignored";
    Diagnostic::warning(span, message, "render settings once")
}

fn index_of(key: &str) -> Option<usize> {
    RENDER.iter().position(|field| field.key == key)
}

fn unknown_key(span: Span, key: &str) -> Diagnostic {
    let keys = RENDER.map(|field| field.key);
    let message = format!("render: unknown key {}", quoted(key));
    let diagnostic = Diagnostic::warning(span, message, keys.join(", "));
    did_you_mean(diagnostic, nearest_word(key, keys), Some(SKIPPED))
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
    let is_count = matches!(field.allowed, Range::Whole(..));
    let read = if is_count {
        parse_number(word)
    } else {
        number(span, word, report, what)
    };
    let expected = field.allowed.words();
    let value =
        read.map_err(|error| no_number(Severity::Warning, span, word, &what(), &expected, error))?;
    if !field.allowed.contains(value) || (is_count && !is_integer(word)) {
        let message = format!("{}: must be {}", what(), field.allowed.limits());
        return Err(Diagnostic::warning(span, message, expected));
    }
    Ok(value)
}

/// Sets a setting to a number or the index of a word.
fn set(rendering: &mut Rendering, key: &str, value: Option<f64>) {
    fn chosen<T: Copy, const N: usize>(all: [T; N], value: Option<f64>) -> Option<T> {
        all.get(value? as usize).copied()
    }
    let count = value.map(|value| value as u32);
    match key {
        "integrator" => rendering.integrator = chosen(Integrator::ALL, value),
        "depth" => rendering.depth = count,
        "spp" => rendering.spp = count,
        "filter" => rendering.filter = chosen(Filter::ALL, value),
        "transfer" => rendering.transfer = chosen(Transfer::ALL, value),
        "falloff" => rendering.falloff = chosen(FalloffRule::ALL, value),
        "gloss" => rendering.gloss = chosen(GlossRule::ALL, value),
        "noise" => rendering.noise = value,
        _ => rendering.exposure = value,
    }
}

/// The values that are asked for, as the text spells them, in the order of [`RENDER`].
pub(super) fn spelled(rendering: &Rendering) -> Vec<(&'static str, String)> {
    let Rendering {
        integrator,
        depth,
        spp,
        filter,
        transfer,
        exposure,
        falloff,
        gloss,
        noise,
        clamp: _,
    } = *rendering;
    let word = |name: &'static str| name.to_owned();
    let values = [
        integrator.map(|integrator| word(integrator.name())),
        depth.map(|depth| depth.to_string()),
        spp.map(|spp| spp.to_string()),
        filter.map(|filter| word(filter.name())),
        transfer.map(|transfer| word(transfer.name())),
        exposure.map(super::view::spelled),
        falloff.map(|falloff| word(falloff.name())),
        gloss.map(|gloss| word(gloss.name())),
        noise.map(super::view::spelled),
    ];
    let keys = RENDER.iter().map(|field| field.key);
    let stated = keys.zip(values);
    stated
        .filter_map(|(key, value)| Some((key, value?)))
        .collect()
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
) -> Vec<Placed> {
    let stated = place.map_or_else(Default::default, |place| place.parts);
    let own = place.map(|place| place.rendering).unwrap_or_default();
    let effective = own.or(*defaults);
    let placed = |(field, part): (&'static Field, Option<Part>)| {
        if let Some(part) = part {
            return Placed::explicit(field, vec![part.value]);
        }
        let default = default_of(field.key, &effective);
        Placed {
            field,
            spans: vec![Span::at(insertion.span.start())],
            implicit: Some(Box::new(Implicit {
                defaults: vec![Some(default)],
                attributes: vec![ImplicitAttribute {
                    component: 0,
                    name: field.key,
                    default,
                    is_required: false,
                }],
                element,
                insertion: insertion.clone(),
            })),
        }
    };
    RENDER.iter().zip(stated).map(placed).collect()
}

/// What a setting is if only the others are asked for.
fn default_of(key: &str, asked: &Rendering) -> &'static str {
    match key {
        "integrator" => asked.integrator().name(),
        "depth" => match asked.integrator() {
            Integrator::Whitted => "8",
            Integrator::Path | Integrator::Photon => "64",
        },
        "spp" if asked.noise().is_some() => "4096",
        "spp" => "16",
        "filter" => asked.filter.unwrap_or_default().name(),
        "transfer" => asked.transfer.unwrap_or_default().name(),
        "falloff" => asked.falloff.unwrap_or_default().name(),
        "gloss" => asked.gloss.unwrap_or_default().name(),
        _ => "0",
    }
}

/// Where further settings are inserted: at the end of the comment, or in a new one, the first line of
/// the text at `start`, which begins with `opening`.
pub(super) fn insertion(
    place: Option<&RenderPlace>,
    start: usize,
    opening: &'static str,
    line_ending: &'static str,
) -> Insertion {
    match place {
        Some(place) => Insertion {
            span: Span::at(place.whole.end()),
            before: Vec::new(),
            between: Vec::new(),
            after: Vec::new(),
        },
        None => Insertion {
            span: Span::at(start),
            before: vec![Piece::Literal(opening)],
            between: Vec::new(),
            after: vec![Piece::Literal(line_ending)],
        },
    }
}

/// Returns the edits that insert these values into a comment where the text omits them.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    super::placed::insertions(text, wanted, |implicit, values| {
        let names = implicit.attributes.iter().map(|attribute| attribute.name);
        let words = names
            .zip(values)
            .map(|(name, (_, value))| format!(" {name} {value}"));
        words.collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::DEFAULT_SPP;

    #[test]
    fn the_words_of_the_table_are_the_names_of_the_settings() {
        let words = |key: &str| match index_of(key).map(|at| RENDER[at].kind) {
            Some(Kind::Choice(words)) => words.to_vec(),
            other => panic!("{key}: {other:?}"),
        };
        assert_eq!(words("integrator"), Integrator::ALL.map(Integrator::name));
        assert_eq!(words("filter"), Filter::ALL.map(Filter::name));
        assert_eq!(words("transfer"), Transfer::ALL.map(Transfer::name));
        assert_eq!(words("falloff"), FalloffRule::ALL.map(FalloffRule::name));
        assert_eq!(words("gloss"), GlossRule::ALL.map(GlossRule::name));
    }

    #[test]
    fn shown_defaults_are_those_in_use() {
        for integrator in Integrator::ALL {
            let asked = Rendering {
                integrator: Some(integrator),
                ..Rendering::default()
            };
            let depth = integrator.default_depth().to_string();
            assert_eq!(default_of("depth", &asked), depth);
        }
        let none = Rendering::default();
        assert_eq!(default_of("spp", &none), DEFAULT_SPP.to_string());
        let adaptive = Rendering {
            noise: Some(0.5),
            ..none
        };
        assert_eq!(default_of("spp", &adaptive), adaptive.spp().to_string());
        for field in RENDER {
            let default = default_of(field.key, &none);
            let read = value(field, Span::at(0), default, &mut Findings::default());
            assert!(read.is_ok(), "{}", field.key);
        }
    }

    #[test]
    fn spelled_settings_read_back_as_they_were() {
        let settings = Rendering {
            integrator: Some(Integrator::Path),
            depth: Some(0),
            spp: Some(MAX_SPP),
            filter: Some(Filter::BlackmanHarris),
            transfer: Some(Transfer::Srgb),
            exposure: Some(-0.1),
            falloff: Some(FalloffRule::Square),
            gloss: Some(GlossRule::Exponent),
            noise: Some(0.02),
            clamp: None,
        };
        let text = words(&settings);
        let body = Span::new(0, text.len());
        let mut report = Findings::default();
        let place = read_comment(&text, body, body, &mut report).expect("its first word is a key");
        assert_eq!(place.rendering, settings);
        assert!(report.is_empty());
    }
}
