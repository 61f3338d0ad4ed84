//! Colours as the editor's swatches and pickers.

use language::FieldSpans;
use language::schema::Kind;
use serde_json::{Value, json};
use text::{Edit, Span, parse_number, spell_like};

use crate::document::Document;

/// The maximum number of swatches.
const MOST: usize = 5_000;

/// The red, green and blue that a field states.
pub(crate) fn stated(document: &Document, placed: &FieldSpans) -> Option<[f64; 3]> {
    let number = |span: &Span| parse_number(document.source.leaf_text(*span)).ok();
    let numbers: Option<Vec<f64>> = placed.spans.iter().map(number).collect();
    numbers?.try_into().ok()
}

/// The answer to `textDocument/documentColor`. A picker cannot hold parts above 1: such colours have no
/// swatch.
pub(crate) fn all(document: &Document) -> Value {
    let fields = document.stated_in(Span::new(0, document.text().len()));
    let fields = fields.filter(|placed| placed.field.kind == Kind::Colour);
    let colour = |placed: FieldSpans| {
        let parts = stated(document, &placed)?;
        let [red, green, blue] = parts;
        let is_shown = parts.iter().all(|part| (0.0..=1.0).contains(part));
        let span = placed.spans[0].to(placed.spans[2]);
        is_shown.then(|| {
            json!({
                "range": document.range(span),
                "color": { "red": red, "green": green, "blue": blue, "alpha": 1 },
            })
        })
    };
    fields.filter_map(colour).take(MOST).collect()
}

/// The answer to `textDocument/colorPresentation`: the colour spelled like the one at a span.
pub(crate) fn presentation(document: &Document, span: Span, colour: &Value) -> Value {
    let is_here = |placed: &FieldSpans| {
        placed.field.kind == Kind::Colour && placed.spans[0].to(placed.spans[2]) == span
    };
    let mut fields = document.stated_in(span);
    let Some(placed) = fields.find(is_here) else {
        return json!([]);
    };
    let parts = ["red", "green", "blue"].map(|name| colour.get(name).and_then(Value::as_f64));
    let edits = placed.spans.iter().zip(parts).filter_map(|(part, value)| {
        let value = (1000.0 * value?).round() / 1000.0;
        let text = spell_like(document.source.leaf_text(*part), value);
        let start = part.start() - span.start();
        let span = Span::new(start, start + part.len());
        Some(Edit { span, text })
    });
    let edits: Vec<_> = edits.collect();
    let mut spelled = span.of(document.text()).to_owned();
    text::apply(&mut spelled, &edits);
    let edit = Edit {
        span,
        text: spelled.clone(),
    };
    json!([{ "label": spelled, "textEdit": document.text_edit(&edit) }])
}
