//! Lowering of `.ray`: by blocks where the text is regular, otherwise in order.

use std::sync::Arc;

use super::blocks;
use super::origins::{ObjectPlace, Origins};
use super::reader::{Reader, is_word};
use super::tree::Tree;
use super::view_comment::{ViewComment, find, find_rendering};
use crate::Lowered;
use crate::rendering::RenderPlace;
use scene::{Materials, Objects, Scene, Setting, bounds};
use text::{Diagnostic, Findings, Span};

/// Lowers a text.
pub(super) fn lower(text: &str, tree: &Tree) -> (Origins, Lowered) {
    let blocks = |report| blocks::read(text, &tree.tokens, report);
    lower_by(text, tree, blocks)
}

/// Lowers a text that need not be regular.
#[cfg(test)]
pub(super) fn lower_in_order(text: &str, tree: &Tree) -> (Origins, Lowered) {
    lower_by(text, tree, Err)
}

/// Returns the errors of every text that begins with these tokens.
pub(super) fn errors_of_beginning(text: &str, tree: &Tree) -> Findings {
    /// Longer than any word of the language.
    const LONGEST_WORD: usize = 1 << 10;
    let mut report = Findings::default();
    // The last token may be incomplete.
    let whole = tree.tokens.len().saturating_sub(1);
    if let Some(last) = tree.tokens.get(whole)
        && LONGEST_WORD < last.len()
        && is_word(last.of(text))
    {
        report.error(|| {
            let message = format!("a word of more than {LONGEST_WORD} bytes");
            Diagnostic::error(last, message, "a number or the type of an object")
        });
        return report;
    }
    let mut reader = Reader::new(text, &tree.tokens, 0..whole, report);
    reader.is_beginning = true;
    reader.read();
    reader.report
}

/// Lowers a text by blocks if possible, otherwise in order.
fn lower_by<'a>(
    text: &'a str,
    tree: &'a Tree,
    blocks: impl FnOnce(Findings) -> Result<(Reader<'a>, (Objects, Materials), Span), Findings>,
) -> (Origins, Lowered) {
    let mut report = Findings::default();
    let view = find(text, &tree.tokens, &mut report);
    let render = find_rendering(text, &tree.tokens, &mut report);
    let (mut reader, (objects, materials), count) = match blocks(report) {
        Ok(read) => read,
        Err(report) => {
            let all = 0..tree.tokens.len();
            let mut reader = Reader::new(text, &tree.tokens, all, report);
            let count = reader.read();
            let objects = std::mem::take(&mut reader.objects).into();
            let materials = std::mem::take(&mut reader.materials);
            // After an error a block may be without any.
            let materials = materials.into_iter().filter(|block| !block.is_empty());
            let materials = materials.map(Arc::from).collect();
            (reader, (objects, Materials::of_blocks(materials)), count)
        }
    };
    let read = ObjectsRead {
        places: Arc::new(std::mem::take(&mut reader.places)),
        objects,
        materials,
    };
    joined(tree, (view, render), (reader, count), read)
}

/// The objects of a text.
pub(super) struct ObjectsRead {
    pub(super) places: Arc<Vec<ObjectPlace>>,
    pub(super) objects: Objects,
    pub(super) materials: Materials,
}

/// Joins what the comments, the header with the place of the number of objects, and the objects of a
/// text mean.
pub(super) fn joined(
    tree: &Tree,
    (view, render): (ViewComment, Option<RenderPlace>),
    (mut reader, count): (Reader<'_>, Span),
    read: ObjectsRead,
) -> (Origins, Lowered) {
    let ObjectsRead {
        places,
        objects,
        materials,
    } = read;
    reader.origins.view = view;
    reader.origins.render = render;
    reader.origins.objects = places;
    reader.origins.tokens = tree.tokens.len();
    // A view with both eye and target can be checked even if not all objects are known.
    let judged = reader.report.errors() == 0 || view.has_eye_and_target();
    let camera = judged.then(|| {
        let bounds = || bounds(objects.iter());
        view.camera(bounds, count, &mut reader.report)
    });
    let camera = camera.filter(|_| reader.report.errors() == 0);
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
        diagnostics: reader.report.sorted(),
    };
    (reader.origins, lowered)
}
