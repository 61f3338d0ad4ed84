//! Moving, rotating and scaling in MOVE mode. Every change is made to the text at once and replaces
//! the one before, so that the whole is one undo step.

use crossterm::event::{KeyCode, KeyEvent};
use glam::DVec3;

use super::state::{Lock, Moving, Snap, Tool, Transform, decimals_of, round_up};
use crate::app::refusing::Refusable;
use crate::app::shared::change::Change;
use crate::app::shared::line;
use crate::app::{Shared, Stride, display, text};
use crate::keymap::{Mode, types_amount};
use ::text::Edit;
use language::{Along, Language, Motion, Node, Pose};
use render::{camera_axes, pixel_width};
use scene::{Camera, Size};

/// Decimals with which a motion is tried.
const TRIED_DECIMALS: usize = 9;

/// Starts to move, rotate or scale the targets.
pub(crate) fn start(moving: &mut Moving, shared: &mut Shared, tool: Tool) {
    if shared.refuses_structure() {
        return;
    }
    let Some(transform) = begun(shared, tool).or_fail(shared) else {
        return;
    };
    shared.overlays.messages.end_passing();
    shared.motion = Some(text::begin_live_edit(shared));
    *moving = Some(transform);
    shared.mode = Mode::Move;
}

/// A motion of the targets that has not moved them yet.
fn begun(shared: &Shared, tool: Tool) -> Result<Transform, String> {
    let selected = shared.cursor.selected();
    let nodes = shared.targets();
    let node = if nodes.contains(&selected) {
        selected
    } else {
        nodes[0]
    };
    let cameras = shared.camera().zip(shared.own_camera());
    let ((camera, own), (_, size)) = cameras
        .zip(shared.raster())
        .ok_or("there is no picture to move it in")?;
    if nodes.contains(&Node::View)
        && let Some(reason) = refuses_camera(shared, tool)
    {
        return Err(reason);
    }
    let pose = pose_for(shared, tool, node, &nodes)?;
    let pixel =
        width_of_pixel_at(pose.centre, &camera, size) / display::magnification(shared, size);
    let step = round_up(pixel);
    Ok(Transform {
        tool,
        lock: Lock::default(),
        snap: Snap::default(),
        typed: String::new(),
        nodes,
        pose,
        camera,
        own,
        steps: [0.0; 2],
        pixel,
        step,
        step_decimals: decimals_of(step),
    })
}

/// The place from which a tool transforms nodes: that of `node`, one of them.
///
/// # Errors
///
/// Fails with the reason if the tool would change none of them.
pub(crate) fn pose_for(
    shared: &Shared,
    tool: Tool,
    node: Node,
    nodes: &[Node],
) -> Result<Pose, String> {
    let lacks = match tool {
        Tool::Move => "has no position",
        Tool::Rotate => "has no direction",
        Tool::Scale => "cannot be scaled",
    };
    let refused = |lacks| Err(format!("{} {lacks}", shared.source().name(node)));
    let pose = match (pose(shared, node), node) {
        (Some(pose), _) => pose,
        // A direction is the same everywhere.
        (None, Node::Light(_)) if tool == Tool::Rotate => Pose {
            centre: DVec3::ZERO,
            axes: DVec3::AXES,
        },
        (None, Node::Light(_)) => return refused(lacks),
        (None, _) => return refused("has no position"),
    };
    let is_unchanged = |motion: &Motion| {
        let edits = shared.source().motion(nodes, motion, TRIED_DECIMALS);
        !nodes.contains(&Node::View) && edits.is_ok_and(|edits| edits.is_empty())
    };
    match tried(tool, pose.centre) {
        Some(motion) if is_unchanged(&motion) => refused(lacks),
        _ => Ok(pose),
    }
}

/// The place of a node; that of a combination is the middle of what it draws.
fn pose(shared: &Shared, node: Node) -> Option<Pose> {
    let stated = shared.source().pose(node);
    match node {
        _ if stated.is_some() => stated,
        Node::View => {
            let own = shared.own_camera()?;
            let [right, up, into] = camera_axes(&own);
            Some(Pose {
                centre: own.eye,
                axes: [right, up, -into],
            })
        }
        Node::Object(index) => {
            let scene = shared.scene.as_ref()?;
            let drawn = shared.source().drawn(index)?;
            let bounds = scene.objects.get(drawn as usize)?.shape.bounds();
            bounds.is_bounded().then(|| Pose {
                centre: bounds.centre(),
                axes: DVec3::AXES,
            })
        }
        _ => None,
    }
}

/// Moves by steps to the right and up.
pub(super) fn step(moving: &mut Moving, shared: &mut Shared, right: i8, up: i8, stride: Stride) {
    let factor = stride.of(1.0);
    change(moving, shared, |transform| {
        transform.typed.clear();
        transform.steps[0] += factor * f64::from(right);
        transform.steps[1] += factor * f64::from(up);
    });
}

/// Moves by pixels of the picture to the right and up, so that a thing follows the pointer.
pub(super) fn drag(moving: &mut Moving, shared: &mut Shared, right: f64, up: f64) {
    change(moving, shared, |transform| {
        let pixels = match transform.tool {
            Tool::Move => transform.pixel / transform.step,
            Tool::Rotate | Tool::Scale => 1.0,
        };
        transform.typed.clear();
        transform.steps[0] += pixels * right;
        transform.steps[1] += pixels * up;
    });
}

/// Locks an axis of the world, then of the thing itself, then none.
pub(super) fn lock_axis(moving: &mut Moving, shared: &mut Shared, axis: usize) {
    change(moving, shared, |transform| {
        transform.lock = match transform.lock {
            Lock::World(locked) if locked == axis => Lock::Own(axis),
            Lock::Own(locked) if locked == axis => Lock::Free,
            _ => Lock::World(axis),
        };
    });
}

/// Snaps amounts to a grid, or no longer.
pub(super) fn toggle_snap(moving: &mut Moving, shared: &mut Shared) {
    change(moving, shared, |transform| {
        transform.snap = match transform.snap {
            Snap::Off => Snap::Grid,
            Snap::Grid => Snap::Off,
        };
    });
}

/// Types a character of the amount; returns whether it is one.
pub(crate) fn type_amount(moving: &mut Moving, shared: &mut Shared, key: KeyEvent) -> bool {
    let typed = moving.as_ref().map_or("", |transform| &transform.typed);
    match key.code {
        KeyCode::Char(character)
            if types_amount(character, typed) && typed.len() < line::LONGEST =>
        {
            change(moving, shared, |transform| transform.typed.push(character));
            true
        }
        KeyCode::Backspace if !typed.is_empty() => {
            change(moving, shared, |transform| {
                transform.typed.pop();
            });
            true
        }
        _ => false,
    }
}

/// Keeps the change and ends.
pub(crate) fn confirm(moving: &mut Moving, shared: &mut Shared) {
    if let Some(transform) = moving
        && !transform.typed.is_empty()
        && let Err(reason) = transform.typed_numbers()
    {
        shared.fail(reason);
        return;
    }
    match (moving.take(), shared.motion.take()) {
        (Some(transform), Some(live_edit)) if live_edit.is_applied => {
            shared.cursor.changed = Some(Change::Moved {
                motion: transform.motion(camera_axes(&transform.camera)),
                decimals: transform.decimals(),
                words: transform.words(),
            });
            shared.overlays.show_passing(transform.words());
        }
        _ => shared.say("nothing has changed"),
    }
    shared.overlays.messages.end_passing();
    text::keep_live_edit(shared);
    shared.mode = Mode::Select;
}

/// Puts the text back and ends, in SELECT.
pub(super) fn cancel(moving: &mut Moving, shared: &mut Shared) {
    *moving = None;
    if let Some(live_edit) = shared.motion.take() {
        text::end_live_edit(shared, live_edit);
    }
    shared.mode = Mode::Select;
}

/// Changes the motion, and the text with it.
fn change(moving: &mut Moving, shared: &mut Shared, change: impl FnOnce(&mut Transform)) {
    let (Some(transform), Some(mut live_edit)) = (moving.as_mut(), shared.motion.take()) else {
        return;
    };
    if text::leaves_live_edit(shared, &live_edit, "transformation") {
        *moving = None;
        shared.mode = Mode::Select;
        return;
    }
    change(transform);
    let edits = |shared: &Shared| edits_of_motion(shared, transform);
    let outcome = text::try_instead(shared, &mut live_edit, edits);
    if outcome.or_fail(shared).is_some() {
        if live_edit.is_applied {
            let targets = shared.targets_name(&transform.nodes);
            shared.document.name_step(transform.step_name(&targets));
        }
        shared.overlays.show_passing(transform.words());
    }
    shared.motion = Some(live_edit);
}

/// The edits that a motion makes to the text before it.
fn edits_of_motion(shared: &Shared, transform: &Transform) -> Result<Vec<Edit>, String> {
    let motion = transform.motion(camera_axes(&transform.camera));
    if motion.is_identity() {
        return Ok(Vec::new());
    }
    let (decimals, own) = (transform.decimals(), &transform.own);
    let mut nodes = transform.nodes.clone();
    nodes.retain(|node| *node != Node::View);
    let moved = shared.source().motion(&nodes, &motion, decimals);
    let mut edits = moved.map_err(|refused| refused.to_string())?;
    if nodes.len() < transform.nodes.len() {
        let moved = motion.camera(own, decimals);
        edits.extend(shared.source().view_edits(own, &moved));
        Edit::sort(&mut edits);
    }
    Ok(edits)
}

/// Why the text's camera cannot be transformed, if it cannot.
fn refuses_camera(shared: &Shared, tool: Tool) -> Option<String> {
    match (tool, shared.document.language()) {
        // Only a comment states a view there, which is written on request.
        (_, Language::Ray) => {
            let view = shared.key_for("camera");
            Some(format!("{view} moves the camera"))
        }
        (Tool::Scale, _) => {
            let [narrower, wider] =
                ["narrower-view", "wider-view"].map(|name| shared.key_for(name));
            Some(format!(
                "a camera has no size: {narrower} and {wider} in VIEW change what it sees"
            ))
        }
        (Tool::Move | Tool::Rotate, _) => None,
    }
}

/// Whether the targets have a place that a tool changes.
pub(crate) fn is_movable(shared: &Shared, tool: Tool) -> bool {
    let has_place = |node: &Node| match node {
        Node::View => refuses_camera(shared, tool).is_none(),
        Node::Object(_) => true,
        node => shared.source().pose(*node).is_some(),
    };
    shared.targets().iter().all(has_place)
}

/// A motion by a tool about a point, to find out whether it changes anything; `None` if it certainly
/// does.
fn tried(tool: Tool, about: DVec3) -> Option<Motion> {
    match tool {
        Tool::Move => None,
        Tool::Rotate => Some(Motion::Rotate {
            // An axis about which nothing is likely to be symmetric.
            axis: DVec3::new(0.36, 0.48, 0.8),
            angle: 40.0,
            about,
        }),
        Tool::Scale => Some(Motion::Scale {
            factor: 2.0,
            along: Along::All,
            about,
        }),
    }
}

/// The width of a pixel at a point in world units; at the target if the point is the eye itself.
fn width_of_pixel_at(point: DVec3, camera: &Camera, size: Size) -> f64 {
    match pixel_width(point, camera, size) {
        0.0 => pixel_width(camera.target, camera, size),
        width => width,
    }
}
