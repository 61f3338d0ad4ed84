//! A motion in progress: what moves, along which axis, and how far.

use glam::DVec3;

use crate::app::values::typed;
use document::StepName;
use language::{Along, Motion, Node, Pose};
use scene::Camera;
use text::{decimals, rounded};

/// The angle of one step, and of the grid of angles, in degrees.
const ROTATION: [f64; 2] = [1.0, 15.0];
/// The change of the factor in one step, and in one of the grid.
const SCALE: [f64; 2] = [0.05, 0.25];
/// Steps of a move in one of the grid.
const GRID: f64 = 10.0;

/// How things are transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Moves.
    Move,
    /// Rotates.
    Rotate,
    /// Scales.
    Scale,
}

impl Tool {
    /// The name of the keys that start it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Move => "move",
            Self::Rotate => "rotate",
            Self::Scale => "scale",
        }
    }
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

/// What MOVE moves: `None` outside of that mode.
pub type Moving = Option<Transform>;

/// A motion in progress.
#[derive(Clone, Debug)]
pub struct Transform {
    /// What it does.
    pub tool: Tool,
    /// What it is locked to.
    pub lock: Lock,
    /// Whether amounts are rounded.
    pub snap: Snap,
    /// The typed amount; empty if none is.
    pub typed: String,
    /// The nodes that move.
    pub(crate) nodes: Vec<Node>,
    /// The place and the axes of the selected one before.
    pub(crate) pose: Pose,
    /// The camera of the picture before.
    pub(crate) camera: Camera,
    /// The text's camera before.
    pub(crate) own: Camera,
    /// The steps to the right and up.
    pub(crate) steps: [f64; 2],
    /// The width of a pixel, in world units.
    pub(crate) pixel: f64,
    /// The length of one step of a move, in world units.
    pub(crate) step: f64,
    /// The decimals that a step needs.
    pub(crate) step_decimals: usize,
}

impl Transform {
    /// The decimals of the numbers that it changes: for moves by steps, what a cell can show.
    /// Otherwise more, so that nothing of a typed amount is lost, nor of a small fraction, and that the
    /// parts of what is rotated or scaled stay together within a hundredth of a pixel.
    pub(crate) fn decimals(&self) -> usize {
        const MORE: usize = 2;
        let own = match (self.typed.as_str(), self.tool) {
            ("", Tool::Move) => return self.step_decimals,
            (typed, Tool::Move) => {
                let numbers = self.typed_numbers().unwrap_or_default();
                let own = numbers.into_iter().map(|number| decimals_of(number.abs()));
                own.fold(decimals(typed), usize::max)
            }
            (typed, Tool::Rotate | Tool::Scale) => decimals(typed),
        };
        self.step_decimals.max(own) + MORE
    }

    /// The amount along the locked axis, or in the first direction: in world units, degrees, or as
    /// a factor.
    pub fn amount(&self) -> f64 {
        if !self.typed.is_empty() {
            let none = if self.tool == Tool::Scale { 1.0 } else { 0.0 };
            return self.typed_numbers().map_or(none, |typed| typed[0]);
        }
        let steps = self.steps[0] + self.steps[1];
        let [step, grid] = match self.tool {
            Tool::Move => [self.step, GRID * self.step],
            Tool::Rotate => ROTATION,
            Tool::Scale => SCALE,
        };
        let amount = self.snapped(steps * step, grid);
        match self.tool {
            Tool::Scale => (1.0 + amount).max(SCALE[0]),
            Tool::Move | Tool::Rotate => amount,
        }
    }

    /// The numbers typed: one or, to move along x, y and z, three.
    ///
    /// # Errors
    ///
    /// Fails with what is wrong with them.
    pub(crate) fn typed_numbers(&self) -> Result<Vec<f64>, String> {
        let numbers = typed::numbers(&self.typed)?;
        let is_vector = self.tool == Tool::Move && self.lock == Lock::Free;
        match numbers.len() {
            1 => Ok(numbers),
            3 if is_vector => Ok(numbers),
            _ if is_vector => Err("expected one number, or three for x, y and z".to_owned()),
            _ => Err("expected one number".to_owned()),
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

    /// The point that it is rotated and scaled about: where the selected thing was.
    pub fn pivot(&self) -> DVec3 {
        self.pose.centre
    }

    /// The motion, for a camera with these directions to the right, up and into the picture.
    pub(crate) fn motion(&self, [right, up, into]: [DVec3; 3]) -> Motion {
        let about = self.pose.centre;
        match self.tool {
            Tool::Move => Motion::Move(self.way(right, up)),
            Tool::Rotate => Motion::Rotate {
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

    /// How far and where it moves. Rounded here, so that all things keep their places to each other.
    fn way(&self, right: DVec3, up: DVec3) -> DVec3 {
        let way = match (self.axis(), self.typed_numbers().as_deref()) {
            (None, Ok(&[x, y, z])) => DVec3::new(x, y, z),
            (Some(axis), _) => self.amount() * axis,
            (None, _) if self.typed.is_empty() => {
                let [across, upwards] = self.in_plane();
                across * right + upwards * up
            }
            (None, _) => self.amount() * right,
        };
        way.map(|component| rounded(component, self.decimals()))
    }

    /// The distances to the right and up of a move that is locked to no axis.
    fn in_plane(&self) -> [f64; 2] {
        let grid = GRID * self.step;
        self.steps
            .map(|steps| self.snapped(steps * self.step, grid))
    }

    /// What it does, in a few words: `move along x: 0.5`.
    pub fn words(&self) -> String {
        let axis = match self.lock {
            Lock::Free => None,
            Lock::World(axis) => Some(["x", "y", "z"][axis]),
            Lock::Own(axis) => Some(["own x", "own y", "own z"][axis]),
        };
        let amount = match (self.typed.as_str(), self.tool) {
            ("", Tool::Move) => format!("{:.*}", self.step_decimals, self.amount() + 0.0),
            ("", Tool::Rotate | Tool::Scale) => format!("{:.2}", self.amount() + 0.0),
            (typed, _) => typed.to_owned(),
        };
        let what = match (self.tool, axis) {
            (Tool::Move, Some(axis)) => format!("move along {axis}: {amount}"),
            (Tool::Move, None) if self.typed.is_empty() => {
                let [right, up] = self.in_plane();
                let decimals = self.step_decimals;
                format!("move: {right:.decimals$} right, {up:.decimals$} up")
            }
            (Tool::Move, None) => format!("move to the right: {amount}"),
            (Tool::Rotate, Some(axis)) => format!("rotate about {axis}: {amount}°"),
            (Tool::Rotate, None) => format!("rotate in the picture: {amount}°"),
            (Tool::Scale, Some(axis)) => format!("scale along {axis}: ×{amount}"),
            (Tool::Scale, None) => format!("scale: ×{amount}"),
        };
        match self.snap {
            Snap::Off => what,
            Snap::Grid => format!("{what} on the grid"),
        }
    }

    /// The name of the undo step that transforms these things.
    pub(crate) fn step_name(&self, targets: &str) -> StepName {
        let (verb, done) = match self.tool {
            Tool::Move => ("move", "moved"),
            Tool::Rotate => ("rotate", "rotated"),
            Tool::Scale => ("scale", "scaled"),
        };
        let words = self.words();
        let how = words.strip_prefix(verb).unwrap_or_default();
        StepName::done(format!("{done} {targets}{how}"))
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not below a number above 0.
pub(crate) fn round_up(number: f64) -> f64 {
    if !number.is_normal() || number < 0.0 {
        return 1.0;
    }
    let power = libm::floor(libm::log10(number)) as i32;
    let rounds = [1.0, 2.0, 5.0, 10.0].map(|digit| decimal(digit, power));
    let fits = |round: &f64| number <= *round * (1.0 + 1e-9);
    rounds.into_iter().find(fits).unwrap_or(number)
}

/// A digit times a power of ten, as written.
fn decimal(digit: f64, power: i32) -> f64 {
    format!("{digit}e{power}").parse().unwrap_or(digit)
}

/// The decimals that numbers in steps of this size need.
pub(crate) fn decimals_of(step: f64) -> usize {
    let power = libm::floor(libm::log10(step));
    if power.is_finite() {
        (-power).clamp(0.0, 12.0) as usize
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        for (number, round, decimals) in [
            (0.03, 0.05, 2),
            (0.05, 0.05, 2),
            (1.0, 1.0, 0),
            (7.0, 10.0, 0),
            (120.0, 200.0, 0),
            (0.0, 1.0, 0),
        ] {
            assert_eq!(round_up(number), round);
            assert_eq!(decimals_of(round), decimals, "{round}");
        }
    }
}
