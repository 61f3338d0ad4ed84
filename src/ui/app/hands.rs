//! Moving, turning and scaling by hand, in MOVE mode. Every change is made to the text at once and
//! replaces the one before, so that the whole is one undo step.

use crossterm::event::{KeyCode, KeyEvent};
use glam::DVec3;

use super::App;
use super::menu::{decimals_of, round_up};
use crate::language::{Along, Motion, Node, Pose};
use crate::render::{axes, pixel_width};
use crate::text::{Edit, parse_number};
use crate::ui::keymap::{Mode, Stride};

/// The angle of one step, and of the grid of angles, in degrees.
const TURN: [f64; 2] = [1.0, 15.0];
/// The change of the factor in one step, and in one of the grid.
const SCALE: [f64; 2] = [0.05, 0.25];
/// Steps of a move in one of the grid.
const GRID: f64 = 10.0;

/// What the hand does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Moves.
    Move,
    /// Turns.
    Turn,
    /// Scales.
    Scale,
}

/// The axis that a motion is locked to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lock {
    /// None: the screen's plane, the direction of view, or all directions.
    #[default]
    Free,
    /// An axis of the world: 0 is x.
    World(usize),
    /// An axis of the thing itself.
    Own(usize),
}

/// Whether amounts are rounded to a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Snap {
    /// Any amount.
    #[default]
    Off,
    /// Whole steps of the grid.
    Grid,
}

/// A motion in progress.
#[derive(Clone, Debug)]
pub struct Hand {
    /// What it does.
    pub tool: Tool,
    /// What it is locked to.
    pub lock: Lock,
    /// Whether amounts are rounded.
    pub snap: Snap,
    /// The typed amount; empty if none is.
    pub typed: String,
    /// The nodes that move.
    nodes: Vec<Node>,
    /// The place and the axes of the selected one before.
    pose: Pose,
    /// The steps to the right and up.
    steps: [f64; 2],
    /// The length of one step of a move, in world units.
    step: f64,
    /// The decimals that a step needs.
    decimals: usize,
    /// The text's revision after the last change; another one ends the motion.
    revision: u64,
    /// Whether the text is changed.
    is_applied: bool,
}

impl Hand {
    /// The amount along the locked axis, or in the first direction: in world units, degrees, or as
    /// a factor.
    pub fn amount(&self) -> f64 {
        if let Ok(typed) = parse_number(&self.typed) {
            return typed;
        }
        let steps = self.steps[0] + self.steps[1];
        let [step, grid] = match self.tool {
            Tool::Move => [self.step, GRID * self.step],
            Tool::Turn => TURN,
            Tool::Scale => SCALE,
        };
        let amount = self.snapped(steps * step, grid);
        match self.tool {
            Tool::Scale => (1.0 + amount).max(SCALE[0]),
            Tool::Move | Tool::Turn => amount,
        }
    }

    fn snapped(&self, amount: f64, grid: f64) -> f64 {
        match self.snap {
            Snap::Off => amount,
            Snap::Grid => grid * (amount / grid).round(),
        }
    }

    /// The axis it is locked to, in world space.
    pub fn axis(&self) -> Option<DVec3> {
        match self.lock {
            Lock::Free => None,
            Lock::World(axis) => Some(DVec3::AXES[axis]),
            Lock::Own(axis) => Some(self.pose.axes[axis]),
        }
    }

    /// The point that it turns and scales about: where the selected thing was.
    pub fn pivot(&self) -> DVec3 {
        self.pose.centre
    }

    /// The motion, for a camera with these directions to the right, up and into the picture.
    fn motion(&self, [right, up, into]: [DVec3; 3]) -> Motion {
        let about = self.pose.centre;
        match self.tool {
            Tool::Move => Motion::Move(match self.axis() {
                Some(axis) => self.amount() * axis,
                None if self.typed.is_empty() => {
                    let [across, upwards] = self
                        .steps
                        .map(|steps| self.snapped(steps * self.step, GRID * self.step));
                    across * right + upwards * up
                }
                None => self.amount() * right,
            }),
            Tool::Turn => Motion::Turn {
                axis: self.axis().unwrap_or(-into),
                angle: self.amount(),
                about,
            },
            Tool::Scale => Motion::Scale {
                factor: self.amount(),
                along: match self.lock {
                    Lock::Free => Along::All,
                    Lock::World(axis) => Along::World(axis),
                    Lock::Own(axis) => Along::Own(axis),
                },
                about,
            },
        }
    }

    /// What it does, in a few words: `move along x by 0.5`.
    pub fn words(&self) -> String {
        let along = match self.lock {
            Lock::Free => String::new(),
            Lock::World(axis) => format!(" {}", ["x", "y", "z"][axis]),
            Lock::Own(axis) => format!(" own {}", ["x", "y", "z"][axis]),
        };
        let amount = if self.typed.is_empty() {
            let decimals = if self.tool == Tool::Move {
                self.decimals
            } else {
                2
            };
            format!("{:.decimals$}", self.amount() + 0.0)
        } else {
            format!("{}_", self.typed)
        };
        let grid = match self.snap {
            Snap::Off => "",
            Snap::Grid => " on the grid",
        };
        match (self.tool, self.lock) {
            (Tool::Move, Lock::Free) if self.typed.is_empty() => {
                let [right, up] = self
                    .steps
                    .map(|steps| self.snapped(steps * self.step, GRID * self.step));
                let decimals = self.decimals;
                format!("move: {right:.decimals$} right, {up:.decimals$} up{grid}")
            }
            (Tool::Move, _) => format!("move along{along}: {amount}{grid}"),
            (Tool::Turn, _) => format!("turn about{along}: {amount}°{grid}"),
            (Tool::Scale, _) => format!("scale{along}: ×{amount}{grid}"),
        }
        .replace("along:", "to the right:")
        .replace("about:", "in the picture:")
    }
}

impl App {
    /// Starts to move, turn or scale the targets.
    pub(super) fn take_in_hand(&mut self, tool: Tool) {
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
        let (Some(camera), Some((_, size))) = (self.camera(), self.raster()) else {
            self.overlays.fail("no picture to move in");
            return;
        };
        let Some(pose) = self.pose(node) else {
            let reason = match node {
                Node::View => "v moves the camera".to_owned(),
                _ => format!("{} has no place", self.source().name(node)),
            };
            self.overlays.fail(reason);
            return;
        };
        let step = round_up(pixel_width(pose.centre, &camera, size));
        self.document.end_step();
        self.pictures.hand = Some(Hand {
            tool,
            lock: Lock::default(),
            snap: Snap::default(),
            typed: String::new(),
            nodes,
            pose,
            steps: [0.0; 2],
            step,
            decimals: decimals_of(step),
            revision: self.document.revision(),
            is_applied: false,
        });
        self.mode = Mode::Move;
    }

    /// The place of a node; that of a combination is the middle of what it draws.
    fn pose(&self, node: Node) -> Option<Pose> {
        self.source().pose(node).or_else(|| {
            let Node::Object(index) = node else {
                return None;
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

    /// Moves by steps to the right and up.
    pub(super) fn step_hand(&mut self, right: f64, up: f64, stride: Stride) {
        let factor = stride.of(1.0);
        self.change_hand(|hand| {
            hand.typed.clear();
            hand.steps[0] += factor * right;
            hand.steps[1] += factor * up;
        });
    }

    /// Moves by pixels of the picture to the right and up, so that a thing follows the pointer.
    pub(super) fn drag_hand(&mut self, right: f64, up: f64) {
        let Some((camera, (_, size))) = self.camera().zip(self.raster()) else {
            return;
        };
        self.change_hand(|hand| {
            let pixels = match hand.tool {
                Tool::Move => pixel_width(hand.pose.centre, &camera, size) / hand.step,
                Tool::Turn | Tool::Scale => 1.0,
            };
            hand.typed.clear();
            hand.steps[0] += pixels * right;
            hand.steps[1] += pixels * up;
        });
    }

    /// Locks an axis of the world, then of the thing itself, then none.
    pub(super) fn lock_hand(&mut self, axis: usize) {
        self.change_hand(|hand| {
            hand.lock = match hand.lock {
                Lock::World(locked) if locked == axis => Lock::Own(axis),
                Lock::Own(locked) if locked == axis => Lock::Free,
                _ => Lock::World(axis),
            };
        });
    }

    pub(super) fn snap_hand(&mut self) {
        self.change_hand(|hand| {
            hand.snap = match hand.snap {
                Snap::Off => Snap::Grid,
                Snap::Grid => Snap::Off,
            };
        });
    }

    /// Types a character of the amount; returns whether it is one.
    pub(super) fn type_into_hand(&mut self, key: KeyEvent) -> bool {
        let typed = self.pictures.hand.as_ref().map_or("", |hand| &hand.typed);
        match key.code {
            KeyCode::Char(character)
                if character.is_ascii_digit() || matches!(character, '.' | '-' | '+') =>
            {
                self.change_hand(|hand| hand.typed.push(character));
                true
            }
            KeyCode::Backspace if !typed.is_empty() => {
                self.change_hand(|hand| hand.typed.truncate(hand.typed.len() - 1));
                true
            }
            _ => false,
        }
    }

    /// Keeps the change and ends.
    pub(super) fn keep_hand(&mut self) {
        if let Some(hand) = self.pictures.hand.take() {
            self.overlays.say(hand.words());
        }
        self.document.end_step();
        self.mode = Mode::Select;
    }

    /// Puts everything back and ends.
    pub(super) fn put_back(&mut self) {
        if let Some(hand) = self.pictures.hand.take()
            && hand.is_applied
            && hand.revision == self.document.revision()
        {
            self.document.reject();
            self.relower();
        }
        self.document.end_step();
        self.mode = Mode::Select;
    }

    /// Changes the motion, and the text with it.
    fn change_hand(&mut self, change: impl FnOnce(&mut Hand)) {
        let Some(mut hand) = self.pictures.hand.take() else {
            return;
        };
        if hand.revision != self.document.revision() {
            self.mode = Mode::Select;
            self.overlays
                .warn("the scene has changed meanwhile: what was moved is kept");
            return;
        }
        change(&mut hand);
        if hand.is_applied {
            self.document.reject();
        }
        let axes = self
            .camera()
            .map_or([DVec3::X, DVec3::Y, DVec3::NEG_Z], |camera| axes(&camera));
        let edits = self
            .source()
            .motion(&hand.nodes, &hand.motion(axes), hand.decimals);
        let edits = edits.map_err(|refused| refused.to_string());
        let outcome = edits.and_then(|edits| self.apply_motion(&edits));
        hand.is_applied = outcome == Ok(true);
        match outcome {
            Ok(_) => self.overlays.say(hand.words()),
            Err(reason) => self.overlays.fail(reason),
        }
        hand.revision = self.document.revision();
        self.pictures.hand = Some(hand);
    }

    /// Makes edits on the text as it was before the motion; returns whether they change it.
    fn apply_motion(&mut self, edits: &[Edit]) -> Result<bool, String> {
        if edits.is_empty() {
            self.relower();
            return Ok(false);
        }
        let outcome = self.try_edits_anew(edits);
        if outcome.is_err() {
            self.relower();
        }
        outcome.map(|()| true).map_err(|refused| refused.message)
    }
}
