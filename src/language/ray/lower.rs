//! Lowering of `.ray`: by blocks where the text is regular, otherwise in order.

use std::sync::Arc;

use super::blocks;
use super::origins::Origins;
use super::reader::{Reader, is_word};
use super::tree::{RENDER, Tokens};
use super::view_comment::{find, keyed};
use crate::Lowered;
use crate::rendering::first_comment;
use scene::{Materials, Objects, Scene, Setting, bounds};
use text::{Diagnostic, Findings};

/// Lowers a text.
pub(super) fn lower(text: &str, tokens: &Tokens) -> (Origins, Lowered) {
    let read = blocks::read(text, tokens);
    let (reader, objects) = read.unwrap_or_else(|| in_order(text, tokens));
    joined(text, tokens, reader, objects)
}

/// Lowers a text that need not be regular.
#[cfg(test)]
pub(super) fn lower_in_order(text: &str, tokens: &Tokens) -> (Origins, Lowered) {
    let (reader, objects) = in_order(text, tokens);
    joined(text, tokens, reader, objects)
}

/// Returns the errors of every text that begins with these tokens.
pub(super) fn errors_of_beginning(text: &str, tokens: &Tokens) -> Findings {
    /// Longer than any word of the language.
    const LONGEST_WORD: usize = 1 << 10;
    // The last token may be incomplete.
    let whole = tokens.len().saturating_sub(1);
    if let Some(last) = tokens.get(whole)
        && LONGEST_WORD < last.len()
        && is_word(last.of(text))
    {
        let mut report = Findings::default();
        report.error(|| {
            let message = format!("a word of more than {LONGEST_WORD} bytes");
            Diagnostic::error(last, message, "a number or the type of an object")
        });
        return report;
    }
    let mut reader = Reader::new(text, tokens, 0..whole);
    reader.is_beginning = true;
    reader.read();
    reader.report
}

/// Reads a text that need not be regular.
fn in_order<'a>(text: &'a str, tokens: &'a Tokens) -> (Reader<'a>, (Objects, Materials)) {
    let mut reader = Reader::new(text, tokens, 0..tokens.len());
    reader.read();
    let materials = std::mem::take(&mut reader.materials).into_iter();
    // After an error a block may be without any.
    let materials = materials.filter(|block| !block.is_empty());
    let materials = Materials::of_blocks(materials.map(Arc::from).collect());
    let objects = std::mem::take(&mut reader.objects).into();
    reader.origins.objects = Arc::new(std::mem::take(&mut reader.places));
    (reader, (objects, materials))
}

/// Joins what the comments, the header and the objects of a text mean. The reader holds the places of the
/// objects.
pub(super) fn joined(
    text: &str,
    tokens: &Tokens,
    mut reader: Reader<'_>,
    (objects, materials): (Objects, Materials),
) -> (Origins, Lowered) {
    let mut report = Findings::default();
    let view = find(text, tokens, &mut report);
    let render = first_comment(text, keyed(text, tokens, RENDER), &mut report);
    report.append(reader.report);
    reader.origins.view = view;
    reader.origins.render = render;
    reader.origins.tokens = tokens.len();
    // A view with both eye and target can be checked even if not all objects are known.
    let judged = report.errors() == 0 || view.has_eye_and_target();
    let camera = judged.then(|| {
        let bounds = || bounds(objects.iter());
        let count = reader.declared.map(|count| count.token);
        view.camera(bounds, count.unwrap_or_default(), &mut report)
    });
    let camera = camera.filter(|_| report.errors() == 0);
    let lowered = Lowered {
        scene: camera.map(|camera| Scene {
            camera,
            ambient: reader.ambient,
            lights: reader.lights,
            materials,
            textures: Vec::new(),
            objects,
            setting: Setting {
                rendering: render.map(|render| render.rendering).unwrap_or_default(),
                ..Setting::default()
            },
        }),
        diagnostics: report.sorted(),
    };
    (reader.origins, lowered)
}
