//! Moving, turning and scaling by transform, in MOVE mode. Every change is made to the text at once and
//! replaces the one before, so that the whole is one undo step.

use crossterm::event::{KeyCode, KeyEvent};
use glam::DVec3;

use super::App;
use super::transform::{Lock, Snap, Transform, decimals_of, round_up};
use crate::language::{Language, Node, Pose, StructureError};
use crate::render::{axes, pixel_width};
use crate::scene::{Camera, Size};
use crate::text::Edit;
use crate::ui::keymap::{Mode, Stride, Tool};

impl App {
    /// Starts to move, turn or scale the targets.
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
        let Some(pose) = self.pose(node) else {
            let name = self.source().name(node);
            self.overlays.fail(format!("{name} has no position"));
            return;
        };
        let pixel = pixel_at(pose.centre, &camera, size);
        let step = round_up(pixel);
        let trial = self.begin_trial();
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
            trial,
        });
        self.mode = Mode::Move;
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
    pub(super) fn refuses_camera(&self, tool: Tool) -> Option<&'static str> {
        match (tool, self.document.language()) {
            // Only a comment states a view there, which S writes.
            (_, Language::Ray) => Some("v moves the camera"),
            (Tool::Scale, _) => Some("a camera has no size: [ and ] in VIEW change what it sees"),
            (Tool::Move | Tool::Turn, _) => None,
        }
    }

    /// Moves by steps to the right and up.
    pub(super) fn step_transform(&mut self, right: f64, up: f64, stride: Stride) {
        let factor = stride.of(1.0);
        self.change_transform(|transform| {
            transform.typed.clear();
            transform.steps[0] += factor * right;
            transform.steps[1] += factor * up;
        });
    }

    /// Moves by pixels of the picture to the right and up, so that a thing follows the pointer.
    pub(super) fn drag_transform(&mut self, right: f64, up: f64) {
        self.change_transform(|transform| {
            let pixels = match transform.tool {
                Tool::Move => transform.pixel / transform.step,
                Tool::Turn | Tool::Scale => 1.0,
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
                if character.is_ascii_digit() || matches!(character, '.' | '-' | '+') =>
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
        self.overlays
            .warn("Enter confirms the change first; Esc cancels it");
    }

    /// Keeps the change and ends.
    pub(super) fn confirm_transform(&mut self) {
        match self.pictures.transform.take() {
            Some(transform) if transform.trial.is_applied => self.overlays.say(transform.words()),
            _ => self.overlays.say("nothing has changed"),
        }
        self.keep_trial();
        self.mode = Mode::Select;
    }

    /// Puts everything back and ends.
    pub(super) fn cancel_transform(&mut self) {
        if let Some(transform) = self.pictures.transform.take() {
            self.end_trial(transform.trial);
        }
        self.mode = Mode::Select;
    }

    /// Changes the motion, and the text with it.
    fn change_transform(&mut self, change: impl FnOnce(&mut Transform)) {
        let Some(mut transform) = self.pictures.transform.take() else {
            return;
        };
        if self.is_overtaken(&transform.trial) {
            self.mode = Mode::Select;
            self.overlays
                .warn("the scene has changed on disk; the transformation so far is kept");
            return;
        }
        change(&mut transform);
        let own = transform.clone();
        let outcome = self.try_instead(&mut transform.trial, |app| {
            let edits = app.edits_of_motion(&own);
            edits.map_err(|refused| refused.to_string())
        });
        match outcome {
            Ok(()) => self.overlays.say(transform.words()),
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
            edits.sort_by_key(|edit| edit.span);
        }
        Ok(edits)
    }
}

/// The width of a pixel at a point in world units; at the target if the point is the eye itself.
fn pixel_at(point: DVec3, camera: &Camera, size: Size) -> f64 {
    match pixel_width(point, camera, size) {
        0.0 => pixel_width(camera.target, camera, size),
        width => width,
    }
}
