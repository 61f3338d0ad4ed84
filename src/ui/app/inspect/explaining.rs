//! Explaining the pixel under the cross: asking for its rays and walking through them.

use std::collections::BTreeSet;

use ratatui::layout::Rect;

use super::inspecting::{cross, free_side, node_under_cross, pick_node, reveal_cross, start};
use crate::app::shared::cursor::moved;
use crate::app::shared::inspection::{Cross, Explained};
use crate::app::shared::rays::{self, Segment};
use crate::app::{Fold, Shared, display};
use crate::keymap::{Context, Mode};
use crate::layout;
use crate::msg::{Effect, Question};
use crate::text_width::{shorten, wrap};
use explain::{RayLine, RayPart, Subject, verdicts};
use language::Node;
use render::{Explanation, NO_OBJECT};

/// Most lines of the verdict.
const VERDICT: u16 = 3;
/// Lines of the values of a line, with their title.
const VALUES: u16 = 10;
/// Fewest lines of the tree with its verdict, below which values are cut.
const TREE: u16 = 8;

/// The width below which a tree takes that of the values, too.
const NARROW: u16 = 32;

/// Where an explanation is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayPanels {
    /// The tree with its title and the verdict.
    pub tree: Rect,
    /// The verdict.
    pub verdict: Rect,
    /// The lines of the tree.
    pub lines: Rect,
    /// The values of the line under the cursor, with their title.
    pub values: Rect,
    /// Whether they hide a part of the picture.
    pub is_over_picture: bool,
}

/// Explains a pixel of the picture on screen.
pub(crate) fn explain_at(shared: &mut Shared, pixel: Cross) {
    start(shared);
    shared.inspection.cross = Some(pixel);
    reveal_cross(shared);
    start_explaining(shared);
}

/// Explains the pixel under the cross.
pub(super) fn start_explaining(shared: &mut Shared) {
    shared.inspection.explained = Some(Explained::default());
}

/// Asks for the explanation of the pixel under the cross, unless that is what was asked last.
pub(super) fn follow(shared: &mut Shared) -> Option<Effect> {
    let pixel = cross(shared)?.pixel;
    let (target, picture) = (shared.seen(), shared.picture());
    if picture.is_outdated() || shared.pictures.due {
        return None;
    }
    let frame = picture.latest.clone()?;
    if shared.context() != Context::Rays {
        return None;
    }
    let explained = shared.inspection.explained.as_mut()?;
    let question = Question {
        target,
        generation: frame.generation,
        pixel,
        sample: explained.sample,
    };
    if explained.asked.replace(question) == Some(question) {
        return None;
    }
    Some(Effect::Explain(question, frame))
}

/// Shows an explanation if it is the one asked for last.
pub(crate) fn explained(shared: &mut Shared, question: Question, answer: Option<Box<Explanation>>) {
    let explained = shared.inspection.explained.as_mut();
    let Some(explained) = explained.filter(|explained| explained.asked == Some(question)) else {
        return;
    };
    let is_other = |old: &Explanation| old.pixel != question.pixel || old.sample != question.sample;
    if explained.answer.as_deref().is_none_or(is_other) {
        (explained.at, explained.top) = (0, 0);
        explained.folded.clear();
    }
    explained.answer = answer;
    let verdict = verdict(shared);
    if let Some(explained) = &mut shared.inspection.explained {
        explained.verdict = verdict;
    }
}

/// The verdict on the explanation on screen; `None` if its scene may not be the text's.
fn verdict(shared: &Shared) -> Option<String> {
    let frame = shared.picture().latest.as_ref();
    let frame = frame.filter(|_| shows_text(shared))?;
    let subject = Subject {
        source: shared.source(),
        scene: shared.scene.as_deref()?,
        camera: &frame.query.as_ref()?.camera,
        size: frame.whole(),
    };
    let verdicts = verdicts(explanation(shared)?, &subject);
    let first = verdicts.into_iter().next()?;
    Some(match first.help {
        Some(help) => format!("{}: {help}", first.text),
        None => first.text,
    })
}

/// The explanation on screen.
pub(crate) fn explanation(shared: &Shared) -> Option<&Explanation> {
    shared.inspection.explained.as_ref()?.answer.as_deref()
}

/// The lines of the explanation on screen.
pub(crate) fn ray_lines(shared: &Shared) -> Vec<RayLine> {
    match (&shared.inspection.explained, explanation(shared)) {
        (Some(explained), Some(explanation)) => listed(explanation, &explained.folded),
        _ => Vec::new(),
    }
}

/// The lines of an explanation that tell of light, without those inside of folded rays.
fn listed(explanation: &Explanation, folded: &BTreeSet<usize>) -> Vec<RayLine> {
    let mut lines = explain::lines(explanation, |ray| folded.contains(&ray));
    lines.retain(|line| line.part.is_light());
    lines
}

/// The line of the explanation under the cursor.
pub(crate) fn ray_line(shared: &Shared) -> Option<RayLine> {
    let at = shared.inspection.explained.as_ref()?.at;
    ray_lines(shared).get(at).copied()
}

/// The node that a line of the explanation is about: an object or a light.
pub(crate) fn ray_node(shared: &Shared, line: RayLine) -> Option<Node> {
    line.node(explanation(shared)?, |object| object_named(shared, object))
}

/// Whether the scene of the picture on screen is the text's.
fn shows_text(shared: &Shared) -> bool {
    shared.error_count() == 0 && !shared.picture().is_outdated() && !shared.pictures.due
}

/// The object that pictures call by this number; `None` if that may be of another scene.
pub(crate) fn object_named(shared: &Shared, number: u32) -> Option<Node> {
    let is_known = number != NO_OBJECT && shows_text(shared);
    is_known.then(|| Node::Object(shared.source().object(number)))
}

/// The node of the line under the cursor.
pub(super) fn explained_node(shared: &Shared) -> Option<Node> {
    ray_node(shared, ray_line(shared)?)
}

/// The path of light from the eye to what the line under the cursor shows.
pub(crate) fn ray_path(shared: &Shared) -> Vec<Segment> {
    match (explanation(shared), ray_line(shared)) {
        (Some(explanation), Some(line)) => rays::path(explanation, &line),
        _ => Vec::new(),
    }
}

/// Selects the object or light of the line under the cursor, and ends inspecting.
pub(super) fn select_explained(shared: &mut Shared) {
    match explained_node(shared) {
        Some(node) => pick_node(shared, node),
        None => shared.say("no object or light"),
    }
}

/// Shows the light of the line under the cursor alone in the preview, or all again.
pub(super) fn solo_explained(shared: &mut Shared) {
    match explained_node(shared) {
        Some(node @ Node::Light(_)) => display::toggle_solo_of(shared, &[node]),
        _ if shared.pictures.solo.is_some() => display::toggle_solo_of(shared, &[]),
        _ => {
            let solo = shared.key_for("solo");
            shared.say(format!("{solo} works on the line of a light"));
        }
    }
}

/// Moves the cursor of the explanation by some lines.
pub(crate) fn move_in_rays(shared: &mut Shared, by: isize) {
    let count = ray_lines(shared).len();
    if let Some(explained) = &mut shared.inspection.explained {
        explained.at = moved(explained.at, by, count);
    }
}

/// Moves the cursor of the explanation to the line under the pointer.
pub(super) fn click_ray(shared: &mut Shared, panels: &RayPanels, at: (u16, u16)) {
    let count = ray_lines(shared).len();
    if let Some(explained) = &mut shared.inspection.explained
        && panels.lines.contains(at.into())
    {
        let line = explained.top + usize::from(at.1 - panels.lines.y);
        explained.at = line.min(count.saturating_sub(1));
    }
}

/// Folds or unfolds the ray of the line under the cursor; if it is already, goes out of it or into
/// it.
pub(super) fn fold_ray(shared: &mut Shared, fold: Fold) {
    let (Some(line), Some(explained)) = (ray_line(shared), &mut shared.inspection.explained) else {
        return;
    };
    let Some(explanation) = explained.answer.as_deref() else {
        return;
    };
    let is_ray = line.part == RayPart::Whole;
    let is_open = is_ray
        && !explained.folded.contains(&line.ray)
        && explain::is_foldable(explanation, line.ray);
    let parent = match line.part {
        RayPart::Whole => explanation.rays[line.ray].parent,
        _ => Some(line.ray),
    };
    match fold {
        Fold::Unselected if is_open => explained.at += 1,
        Fold::Unselected => {
            explained.folded.remove(&line.ray);
        }
        _ if is_open => {
            explained.folded.insert(line.ray);
        }
        _ => {
            let is_parent = |of: &RayLine| Some(of.ray) == parent && of.part == RayPart::Whole;
            let lines = listed(explanation, &explained.folded);
            let at = lines.iter().position(is_parent);
            explained.at = at.unwrap_or(explained.at);
        }
    }
}

/// Explains another sample of the pixel.
pub(super) fn change_sample(shared: &mut Shared, step: i32) {
    let count = sample_count(shared);
    if let Some(explained) = &mut shared.inspection.explained {
        let last = count.saturating_sub(1);
        explained.sample = explained.sample.saturating_add_signed(step).min(last);
    }
}

/// The number of samples of the pixels on screen so far.
pub(crate) fn sample_count(shared: &Shared) -> u32 {
    let latest = shared.picture().latest.as_ref();
    latest.map_or(1, |frame| frame.progress.spp.max(1))
}

/// Where the explanation is drawn: in place of the list and the fields, or over the picture on the
/// side away from the cross.
pub(crate) fn ray_panels(shared: &Shared) -> Option<RayPanels> {
    shared.inspection.explained.as_ref()?;
    let areas = shared.areas();
    let is_over_picture = areas.list.is_empty();
    let (tree, values) = if is_over_picture {
        layout::over_picture(areas.picture, free_side(shared))
    } else if areas.list.x == areas.fields.x || areas.list.width < NARROW {
        // The tree needs more room than the list, and the values less than fields.
        let column = areas.list.union(areas.fields);
        let values = VALUES.min(column.height.saturating_sub(TREE));
        layout::split_bottom(column, values)
    } else {
        (areas.list, areas.fields)
    };
    let room = layout::contents(tree);
    let verdict = verdict_lines(shared, room.width).len();
    let verdict = u16::try_from(verdict).unwrap_or(VERDICT);
    let (verdict, lines) = layout::split_top(room, verdict);
    Some(RayPanels {
        tree,
        verdict,
        lines,
        values,
        is_over_picture,
    })
}

/// The verdict in lines of this width, with a blank before each.
pub(crate) fn verdict_lines(shared: &Shared, width: u16) -> Vec<String> {
    let explained = shared.inspection.explained.as_ref();
    let verdict = explained.and_then(|explained| explained.verdict.as_deref());
    let width = usize::from(width.saturating_sub(1));
    let mut lines = verdict.map_or_else(Vec::new, |verdict| wrap(verdict, width));
    if usize::from(VERDICT) < lines.len() {
        lines.truncate(VERDICT.into());
        if let Some(last) = lines.last_mut() {
            *last = shorten(&format!("{last} …"), width).into_owned();
        }
    }
    lines
}

/// Scrolls so that the line under the cursor is visible.
pub(super) fn scroll_rays(shared: &mut Shared) {
    let rows = ray_panels(shared).map_or(0, |panels| usize::from(panels.lines.height));
    let count = ray_lines(shared).len();
    if let Some(explained) = &mut shared.inspection.explained {
        let at = explained.at.min(count.saturating_sub(1));
        explained.at = at;
        explained.top = layout::first_shown(explained.top, at, count, rows);
    }
}

/// Whether the explained thing is a light.
pub(super) fn explains_light(shared: &Shared) -> bool {
    matches!(explained_node(shared), Some(Node::Light(_)))
}

/// The node that the editor is to show: what is inspected, otherwise the selected one.
pub(crate) fn node_in_focus(shared: &Shared) -> Node {
    let inspected = match shared.context() {
        Context::Rays => explained_node(shared),
        Context::In(Mode::Inspect) => node_under_cross(shared).ok().flatten(),
        _ => None,
    };
    inspected.unwrap_or_else(|| shared.cursor.selected())
}
