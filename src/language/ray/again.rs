//! Incremental lowering of a long `.ray` text. After an edit of one object's numbers, only the block
//! of that object is read again; after an edit of the header or a comment, no object is. Gives up
//! wherever anything else may have changed.

use std::sync::Arc;

use rayon::prelude::*;

use super::blocks::{self, Block, block};
use super::lower;
use super::origins::{Origins, ViewPlace};
use super::tree::Tree;
use super::view_comment::{find, find_rendering, has_eye_and_target};
use crate::language::node::Node;
use crate::language::{Before, Lowered};
use crate::scene::blocks::BLOCK;
use crate::scene::{Object, Objects, Scene};
use crate::text::{Diagnostic, Findings, Span, are_plain_numbers, line_end};

/// Lowers a text after an edit that replaced the bytes `old` by `changed`.
pub(super) fn lower(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    before: &Before<'_>,
    [old, changed]: [Span; 2],
) -> Option<(Origins, Lowered)> {
    let is_same =
        origins.tokens == tree.tokens.len() && origins.keyed == tree.tokens.keyed().count();
    if !is_same {
        return None;
    }
    let moved = Moved { old, changed };
    if is_within_comment(text, tree, origins, &moved) {
        return without_objects(text, tree, origins, before, &moved);
    }
    // If as many tokens as before have changed and are plain, all others keep their meaning.
    if changed.is_empty() || !are_plain_numbers(changed.of(text)) {
        return None;
    }
    let before_end = |end: usize| {
        let tokens = &tree.tokens;
        tokens.partition_point(|token| token.end() < end)
    };
    let (first, last) = (before_end(changed.start() + 1), before_end(changed.end()));
    let ends = tree.tokens.get(first)?.start()..tree.tokens.get(last)?.end();
    if ends != changed.range() {
        return None;
    }
    let node = origins.node_of_token(first)?;
    if origins.node_of_token(last) != Some(node) {
        return None;
    }
    let object = match node {
        Node::Ambient | Node::Light(_) => {
            return without_objects(text, tree, origins, before, &moved);
        }
        Node::Object(object) => object,
        _ => return None,
    };
    // A view without eye or target depends on all objects.
    if !origins
        .view
        .is_some_and(|view| has_eye_and_target(&view.parts))
    {
        return None;
    }
    let first = object - object % BLOCK;
    let of_block = |at: usize| origins.objects.get(at).map(|place| place.token as usize);
    let end = of_block(first + BLOCK).unwrap_or(tree.tokens.len());
    let range = of_block(first)?..end;
    let Block {
        materials,
        objects,
        report,
    } = block(text, &tree.tokens, range.clone(), first)?;
    let spans = tree.tokens.range(range);
    // Findings about objects of a block are reported at one of its tokens.
    let of_block = |place: usize| {
        let of_token = spans.binary_search_by_key(&place, |token| token.start());
        of_token.is_ok()
    };
    let mut kept = kept_findings(before.diagnostics, &moved, |place| !of_block(place))?;
    kept.append(report);
    let lowered = Lowered {
        diagnostics: (kept.len() == kept.warnings()).then(|| kept.sorted())?,
        scene: Some(scene(before.scene, first, objects, materials)),
    };
    let origins = Origins {
        view: origins.view.map(|view| moved.view(&view)),
        render: (origins.render).map(|render| render.moved(|span| moved.span(span))),
        objects: Arc::clone(&origins.objects),
        ..*origins
    };
    Some((origins, lowered))
}

/// Whether an edit has changed nothing but the view's comment or that of the render settings.
fn is_within_comment(text: &str, tree: &Tree, origins: &Origins, moved: &Moved) -> bool {
    let holds = |comment: Span, edit: Span| {
        comment.start() + "//".len() <= edit.start() && edit.end() <= comment.end()
    };
    let mut comments = origins.comments().map(|(_, comment)| comment);
    let Some(before) = comments.find(|comment| holds(*comment, moved.old)) else {
        return false;
    };
    let mut keyed = tree.tokens.keyed();
    keyed.any(|start| start == before.start())
        && holds(
            Span::new(before.start(), line_end(text, before.start())),
            moved.changed,
        )
}

/// Reads all but the objects, which an edit has not changed.
fn without_objects(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    before: &Before<'_>,
    moved: &Moved,
) -> Option<(Origins, Lowered)> {
    let mut report = Findings::default();
    let view = find(text, &tree.tokens, &mut report);
    let render = find_rendering(text, &tree.tokens, &mut report);
    let (mut reader, count) = blocks::header(text, &tree.tokens, &origins.objects)?;
    report.append(std::mem::take(&mut reader.report));
    // Findings about objects are reported at one of their tokens.
    let first = origins.objects.first()?.token as usize;
    let of_object = |place: usize| {
        let token = tree.tokens.partition_point(|token| token.start() < place);
        let token = (first <= token).then(|| tree.tokens.get(token)).flatten();
        token.is_some_and(|token| token.start() == place)
    };
    report.append(kept_findings(before.diagnostics, moved, of_object)?);
    reader.report = report;
    let known = lower::ObjectsRead {
        places: Arc::clone(&origins.objects),
        objects: before.scene.objects.clone(),
        materials: before.scene.materials.clone(),
    };
    let (origins, lowered) = lower::joined(tree, (view, render), (reader, count), known);
    let found = &lowered.diagnostics;
    (found.len() == found.warnings()).then_some((origins, lowered))
}

/// Maps places in the old text to the new one.
struct Moved {
    old: Span,
    changed: Span,
}

impl Moved {
    fn place(&self, place: usize) -> usize {
        if place < self.old.end() {
            place
        } else {
            place - self.old.end() + self.changed.end()
        }
    }

    fn span(&self, span: Span) -> Span {
        Span::new(self.place(span.start()), self.place(span.end()))
    }

    fn view(&self, view: &ViewPlace) -> ViewPlace {
        ViewPlace {
            comment: self.span(view.comment),
            parts: view
                .parts
                .map(|part| part.map(|spans| spans.map(|span| self.span(span)))),
        }
    }
}

/// The findings before an edit that are kept, by their places in the new text; `None` if some were
/// omitted.
fn kept_findings(
    before: &Findings,
    moved: &Moved,
    is_kept: impl Fn(usize) -> bool,
) -> Option<Findings> {
    if before.errors() != 0 || before.len() != before.warnings() {
        return None;
    }
    let mut report = Findings::default();
    for diagnostic in before.iter() {
        let span = moved.span(diagnostic.span);
        if is_kept(span.start()) {
            report.warning(|| Diagnostic {
                span,
                ..diagnostic.clone()
            });
        }
    }
    Some(report)
}

/// The scene with one block of objects replaced.
fn scene(
    before: &Scene,
    first: usize,
    objects: Vec<Object>,
    materials: Vec<crate::scene::Material>,
) -> Scene {
    let index = |object: usize| before.objects.get(object).map(|object| object.material);
    let base = index(first).unwrap_or_default();
    let next = first + objects.len();
    let end = index(next).map_or(before.materials.len(), |index| index as usize);
    let more = materials.len() as i32 - (end as i32 - base as i32);
    let mut blocks = before.objects.blocks().to_vec();
    let based = objects.into_iter().map(|object| Object {
        material: base + object.material,
        ..object
    });
    blocks[first / BLOCK] = based.collect();
    let after = &mut blocks[first / BLOCK + 1..];
    // Threads do not pay off for small scenes.
    if more != 0 && !after.is_empty() {
        after.par_iter_mut().for_each(|block| {
            for object in Arc::make_mut(block) {
                object.material = object.material.wrapping_add_signed(more);
            }
        });
    }
    let mut scene = Scene {
        camera: before.camera,
        ambient: before.ambient,
        lights: before.lights.clone(),
        materials: before.materials.clone(),
        textures: before.textures.clone(),
        objects: Objects::of_blocks(blocks),
        setting: before.setting.clone(),
    };
    scene.materials.replace(base as usize..end, materials);
    scene
}
