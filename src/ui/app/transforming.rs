//! Moving, rotating and scaling in MOVE mode. Every change is made to the text at once and replaces
//! the one before, so that the whole is one undo step.

use crossterm::event::{KeyCode, KeyEvent};
use glam::DVec3;

use super::transform::{Lock, Snap, Transform, decimals_of, round_up};
use super::{Shared, Stride, Tool, line};
use crate::language::{Along, Language, Motion, Node, Pose, StructureError};
use crate::render::{axes, pixel_width};
use crate::scene::{Camera, Size};
use crate::text::Edit;
use crate::ui::keymap::{Mode, types_amount};

/// Decimals with which a motion is tried.
const TRIED_DECIMALS: usize = 9;

impl Shared {
    /// Starts to move, rotate or scale the targets.
    pub(super) fn start_transform(&mut self, tool: Tool) {
        if self.refuses_structure() {
            return;
        }
        let selected = self.cursor.selected();
        let nodes = self.targets();
        let node = if nodes.contains(&selected) {
            selected
        } else {
            nodes[0]
        };
        let Some((camera, (_, size))) = self.camera().zip(self.raster()) else {
            self.overlays.fail("there is no picture to move it in");
            return;
        };
        let Some(own) = self.own_camera() else {
            return;
        };
        if nodes.contains(&Node::View)
            && let Some(reason) = self.refuses_camera(tool)
        {
            self.overlays.fail(reason);
            return;
        }
        let pose = match self.pose_for(tool, node, &nodes) {
            Ok(pose) => pose,
            Err(reason) => {
                self.overlays.fail(reason);
                return;
            }
        };
        let magnification = self
            .frame_window()
            .map_or(1.0, |frame_window| frame_window.magnification(size));
        let pixel = pixel_at(pose.centre, &camera, size) / magnification;
        let step = round_up(pixel);
        let live_edit = self.begin_live_edit();
        self.pictures.transform = Some(Transform {
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
            live_edit,
        });
        self.mode = Mode::Move;
    }

    /// The place from which a tool transforms nodes: that of `node`, one of them.
    ///
    /// # Errors
    ///
    /// Fails with the reason if the tool would change none of them.
    pub(super) fn pose_for(&self, tool: Tool, node: Node, nodes: &[Node]) -> Result<Pose, String> {
        let lacks = match tool {
            Tool::Move => "has no position",
            Tool::Rotate => "has no direction",
            Tool::Scale => "cannot be scaled",
        };
        let refused = |lacks| Err(format!("{} {lacks}", self.source().name(node)));
        let pose = match (self.pose(node), node) {
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
            let edits = self.source().motion(nodes, motion, TRIED_DECIMALS);
            !nodes.contains(&Node::View) && edits.is_ok_and(|edits| edits.is_empty())
        };
        match tried(tool, pose.centre) {
            Some(motion) if is_unchanged(&motion) => refused(lacks),
            _ => Ok(pose),
        }
    }

    /// The place of a node; that of a combination is the middle of what it draws.
    fn pose(&self, node: Node) -> Option<Pose> {
        self.source().pose(node).or_else(|| {
            let index = match node {
                Node::Object(index) => index,
                Node::View => {
                    let own = self.own_camera()?;
                    let [right, up, into] = axes(&own);
                    return Some(Pose {
                        centre: own.eye,
                        axes: [right, up, -into],
                    });
                }
                _ => return None,
            };
            let scene = self.scene.as_ref()?;
            let drawn = self.source().drawn(index)?;
            let bounds = scene.objects.get(drawn as usize)?.shape.bounds();
            bounds.is_bounded().then(|| Pose {
                centre: bounds.centre(),
                axes: DVec3::AXES,
            })
        })
    }

    /// Why the text's camera cannot be transformed, if it cannot.
    pub(super) fn refuses_camera(&self, tool: Tool) -> Option<String> {
        match (tool, self.document.language()) {
            // Only a comment states a view there, which is written on request.
            (_, Language::Ray) => {
                let view = self.key_for("camera");
                Some(format!("{view} moves the camera"))
            }
            (Tool::Scale, _) => {
                let key = |name| self.key_for(name);
                Some(format!(
                    "a camera has no size: {} and {} in VIEW change what it sees",
                    key("narrower-view"),
                    key("wider-view")
                ))
            }
            (Tool::Move | Tool::Rotate, _) => None,
        }
    }

    /// Moves by steps to the right and up.
    pub(super) fn step_transform(&mut self, right: i8, up: i8, stride: Stride) {
        let factor = stride.of(1.0);
        self.change_transform(|transform| {
            transform.typed.clear();
            transform.steps[0] += factor * f64::from(right);
            transform.steps[1] += factor * f64::from(up);
        });
    }

    /// Moves by pixels of the picture to the right and up, so that a thing follows the pointer.
    pub(super) fn drag_transform(&mut self, right: f64, up: f64) {
        self.change_transform(|transform| {
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
    pub(super) fn lock_axis(&mut self, axis: usize) {
        self.change_transform(|transform| {
            transform.lock = match transform.lock {
                Lock::World(locked) if locked == axis => Lock::Own(axis),
                Lock::Own(locked) if locked == axis => Lock::Free,
                _ => Lock::World(axis),
            };
        });
    }

    pub(super) fn toggle_snap(&mut self) {
        self.change_transform(|transform| {
            transform.snap = match transform.snap {
                Snap::Off => Snap::Grid,
                Snap::Grid => Snap::Off,
            };
        });
    }

    /// Types a character of the amount; returns whether it is one.
    pub(super) fn type_amount(&mut self, key: KeyEvent) -> bool {
        let typed = self
            .pictures
            .transform
            .as_ref()
            .map_or("", |transform| &transform.typed);
        match key.code {
            KeyCode::Char(character)
                if types_amount(character, typed) && typed.len() < line::LONGEST =>
            {
                self.change_transform(|transform| transform.typed.push(character));
                true
            }
            KeyCode::Backspace if !typed.is_empty() => {
                self.change_transform(|transform| {
                    transform.typed.truncate(transform.typed.len() - 1);
                });
                true
            }
            _ => false,
        }
    }

    /// Says what ends the transformation, which other actions have to wait for.
    pub(super) fn warn_of_transform(&mut self) {
        let (confirm, cancel) = (self.key_for("accept"), self.key_for("back"));
        let words = format!("{confirm} confirms the change first; {cancel} cancels it");
        self.overlays.warn(words);
    }

    /// Keeps the change and ends.
    pub(super) fn confirm_transform(&mut self) {
        let transform = self.pictures.transform.as_ref();
        let typed = transform.filter(|transform| !transform.typed.is_empty());
        if let Some(Err(reason)) = typed.map(Transform::typed_numbers) {
            self.overlays.fail(reason);
            return;
        }
        match self.pictures.transform.take() {
            Some(transform) if transform.live_edit.is_applied => {
                self.overlays.say(transform.words());
            }
            _ => self.overlays.say("nothing has changed"),
        }
        self.keep_live_edit();
        self.mode = Mode::Select;
    }

    /// Puts everything back and ends.
    pub(super) fn cancel_transform(&mut self) {
        if let Some(transform) = self.pictures.transform.take() {
            self.end_live_edit(transform.live_edit);
        }
        self.mode = Mode::Select;
    }

    /// Changes the motion, and the text with it.
    fn change_transform(&mut self, change: impl FnOnce(&mut Transform)) {
        let Some(mut transform) = self.pictures.transform.take() else {
            return;
        };
        if self.leaves_live_edit(&transform.live_edit, "transformation") {
            self.mode = Mode::Select;
            return;
        }
        change(&mut transform);
        let own = transform.clone();
        let outcome = self.try_instead(&mut transform.live_edit, |shared| {
            let edits = shared.edits_of_motion(&own);
            edits.map_err(|refused| refused.to_string())
        });
        match outcome {
            Ok(()) => {
                if transform.live_edit.is_applied {
                    let targets = self.targets_name(&transform.nodes);
                    self.document.name_step(transform.step_name(&targets));
                }
                self.overlays.say(transform.words());
            }
            Err(reason) => self.overlays.fail(reason),
        }
        self.pictures.transform = Some(transform);
    }

    /// The edits that a motion makes to the text before it.
    fn edits_of_motion(&self, transform: &Transform) -> Result<Vec<Edit>, StructureError> {
        let motion = transform.motion(axes(&transform.camera));
        if motion.is_identity() {
            return Ok(Vec::new());
        }
        let (decimals, own) = (transform.decimals(), &transform.own);
        let mut nodes = transform.nodes.clone();
        nodes.retain(|node| *node != Node::View);
        let mut edits = self.source().motion(&nodes, &motion, decimals)?;
        if nodes.len() < transform.nodes.len() {
            let moved = motion.camera(own, decimals);
            edits.extend(self.source().view_edits(own, &moved));
            Edit::sort(&mut edits);
        }
        Ok(edits)
    }
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
fn pixel_at(point: DVec3, camera: &Camera, size: Size) -> f64 {
    match pixel_width(point, camera, size) {
        0.0 => pixel_width(camera.target, camera, size),
        width => width,
    }
}
