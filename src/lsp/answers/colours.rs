//! Colours as the editor's swatches and pickers.

use std::iter;

use language::FieldSpans;
use language::schema::Kind;
use serde_json::{Value, json};
use text::{Edit, Span, parse_number, spell_like};

use crate::document::Document;

/// The maximum number of swatches.
const MOST: usize = 5_000;

/// The place of the factor among the components of [`Kind::ScaledColour`].
const FACTOR: usize = 3;

/// The red, green and blue that a field states.
pub(crate) fn stated(document: &Document, placed: &FieldSpans) -> Option<[f64; 3]> {
    let number = |span: &Span| parse_number(document.source.leaf_text(*span)).ok();
    let numbers: Option<Vec<f64>> = placed.spans.iter().map(number).collect();
    numbers?.try_into().ok()
}

/// A colour in the text.
struct Swatch {
    /// The places of red, green and blue; one if a single number stands for all.
    places: Vec<Span>,
    parts: [f64; 3],
}

impl Swatch {
    fn span(&self) -> Span {
        self.places[0].to(self.places[self.places.len() - 1])
    }
}

/// The colours of nodes that overlap a span.
fn swatches(document: &Document, span: Span) -> impl Iterator<Item = Swatch> {
    let stated_here = document.stated_in(span);
    let whole = stated_here.filter(|placed| placed.field.kind == Kind::Colour);
    let whole = whole.filter_map(|placed| {
        let parts = stated(document, &placed)?;
        let places = placed.spans;
        Some(Swatch { places, parts })
    });
    let nodes = document.source.nodes_in(span).into_iter();
    let fields = nodes.flat_map(|node| document.source.fields(node));
    whole.chain(fields.filter_map(|placed| grey(document, &placed)))
}

/// The grey of a colour of which the text states only a factor of white.
fn grey(document: &Document, placed: &FieldSpans) -> Option<Swatch> {
    let is_white = (0..FACTOR).all(|part| placed.default_of(part) == Some("1"));
    let is_stated = placed.default_of(FACTOR).is_none();
    if placed.field.kind != Kind::ScaledColour || !is_white || !is_stated {
        return None;
    }
    let place = placed.spans[FACTOR];
    let grey = parse_number(document.source.leaf_text(place).trim()).ok()?;
    Some(Swatch {
        places: vec![place],
        parts: [grey; 3],
    })
}

/// The answer to `textDocument/documentColor`. A picker cannot hold parts above 1: such colours have no
/// swatch.
pub(crate) fn all(document: &Document) -> Value {
    let all = swatches(document, Span::new(0, document.text().len()));
    let shown = all.filter(|swatch| swatch.parts.iter().all(|part| (0.0..=1.0).contains(part)));
    let colour = |swatch: Swatch| {
        let [red, green, blue] = swatch.parts;
        json!({
            "range": document.range(swatch.span()),
            "color": { "red": red, "green": green, "blue": blue, "alpha": 1 },
        })
    };
    shown.map(colour).take(MOST).collect()
}

/// The answer to `textDocument/colorPresentation`: the colour spelled like the one at a span.
pub(crate) fn presentation(document: &Document, span: Span, colour: &Value) -> Value {
    let Some(swatch) = swatches(document, span).find(|swatch| swatch.span() == span) else {
        return json!([]);
    };
    let parts = ["red", "green", "blue"].map(|name| colour.get(name).and_then(Value::as_f64));
    let [Some(red), Some(green), Some(blue)] = parts else {
        return json!([]);
    };
    let parts = [red, green, blue].map(|part| (1000.0 * part).round() / 1000.0);
    let is_grey = parts == [parts[0]; 3];
    let edit = match swatch.places[..] {
        [factor] if !is_grey => in_attributes(document, factor, parts),
        _ => Some(spelled(document, &swatch, parts)),
    };
    let shown =
        edit.map(|edit| json!([{ "label": edit.text, "textEdit": document.text_edit(&edit) }]));
    shown.unwrap_or_else(|| json!([]))
}

/// The edit that writes these parts where a colour has its own.
fn spelled(document: &Document, swatch: &Swatch, parts: [f64; 3]) -> Edit {
    let span = swatch.span();
    let places = swatch.places.iter();
    let edits = iter::zip(places, parts).map(|(place, part)| {
        let text = spell_like(document.source.leaf_text(*place), part);
        let start = place.start() - span.start();
        let span = Span::new(start, start + place.len());
        Edit { span, text }
    });
    let edits: Vec<_> = edits.collect();
    let mut text = span.of(document.text()).to_owned();
    text::apply(&mut text, &edits);
    Edit { span, text }
}

/// The edit that writes these parts as attributes of their own, instead of the one with this value.
fn in_attributes(document: &Document, value: Span, parts: [f64; 3]) -> Option<Edit> {
    let text = document.text();
    let quote = text[value.end()..].chars().next()?;
    let before = text[..value.start()].strip_suffix(quote)?.trim_end();
    let name = before.strip_suffix('=')?.trim_end().strip_suffix("value")?;
    let attributes = iter::zip(["r", "g", "b"], parts);
    let attributes = attributes.map(|(name, part)| format!("{name}={quote}{part}{quote}"));
    Some(Edit {
        span: Span::new(name.len(), value.end() + quote.len_utf8()),
        text: attributes.collect::<Vec<_>>().join(" "),
    })
}
