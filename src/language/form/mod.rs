//! The form of a solid without regard to its kind: a frame and half its extents. Solids of one form
//! fill the same box, so that one kind can replace another.

pub(crate) mod digits;

use glam::{DMat3, DVec3};

use digits::{Lengths, UNIT_TOLERANCE};
use geometry::normalise;
use scene::Camera;

pub(crate) use digits::{rotation, rounded};

/// An oriented box that a solid fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    /// Its centre.
    pub(super) centre: DVec3,
    /// Unit vectors along its edges; for a solid of revolution the last is its axis.
    pub(super) axes: [DVec3; 3],
    /// Half the length along each axis, above 0.
    pub(super) half: [f64; 3],
}

impl Form {
    /// A cube of this half edge in a right-handed frame whose last axis is `up`: y or, otherwise, z.
    pub(super) fn upright(centre: DVec3, half: f64, up: DVec3) -> Self {
        let axes = if up == DVec3::Y {
            [DVec3::Z, DVec3::X, DVec3::Y]
        } else {
            [DVec3::X, DVec3::Y, DVec3::Z]
        };
        Self {
            centre,
            axes,
            half: [half; 3],
        }
    }

    /// Whether its axes are those of the world, in any order.
    pub(super) fn is_aligned(&self) -> bool {
        let is_world = |axis: &DVec3| 1.0 - axis.abs().max_element() < 1e-9;
        self.axes.iter().all(is_world)
    }

    /// Half the extents along the world's axes of an aligned solid that resembles this one: each
    /// along the axis of the frame that is nearest to it.
    pub(super) fn aligned(&self) -> [f64; 3] {
        DVec3::AXES.map(|world| {
            let share = |axis: &DVec3| axis.dot(world).abs();
            let nearest =
                (0..3).max_by(|&a, &b| share(&self.axes[a]).total_cmp(&share(&self.axes[b])));
            nearest.map_or(self.half[0], |axis| self.half[axis])
        })
    }
}

/// A change of the place, direction or size of things, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Moves by this vector.
    Move(DVec3),
    /// Rotates about an axis of unit length through a point, right-handed, in degrees.
    Rotate {
        /// The unit vector of the axis.
        axis: DVec3,
        /// The angle in degrees.
        angle: f64,
        /// A point on the axis.
        about: DVec3,
    },
    /// Scales about a point, along one axis or all.
    Scale {
        /// The factor, above 0.
        factor: f64,
        /// What it applies to.
        along: Along,
        /// The point that stays.
        about: DVec3,
    },
}

/// The directions that a scaling applies to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// All directions.
    All,
    /// This axis of the world: 0 is x, 1 is y, 2 is z.
    World(usize),
    /// This axis of the thing's own frame.
    Own(usize),
}

/// The largest angle as a share of the turn itself, so that small turns are made as well.
const SHARE: f64 = 0.01;

impl Motion {
    /// Whether it changes nothing.
    pub fn is_identity(&self) -> bool {
        match *self {
            Self::Move(by) => by == DVec3::ZERO,
            Self::Rotate { angle, .. } => angle % 360.0 == 0.0,
            Self::Scale { factor, .. } => factor == 1.0,
        }
    }

    /// Where a point moves, unless it scales along one axis of the thing's own.
    pub(super) fn point(&self, point: DVec3) -> DVec3 {
        match *self {
            Self::Move(by) => point + by,
            Self::Rotate { about, .. } | Self::Scale { about, .. } => {
                about + self.linear() * (point - about)
            }
        }
    }

    /// The direction of a unit vector afterwards.
    pub(super) fn direction(&self, direction: DVec3) -> DVec3 {
        match self {
            Self::Rotate { .. } => self.linear() * direction,
            Self::Move(_) | Self::Scale { .. } => direction,
        }
    }

    /// A camera after the motion, with its target. Points are rounded to this number of decimals
    /// where they change.
    #[must_use]
    pub fn camera(&self, camera: &Camera, decimals: usize) -> Camera {
        let place = |old: DVec3, new: DVec3| {
            let component = |at: usize| rounded(old[at], new[at], decimals);
            DVec3::from_array([0, 1, 2].map(component))
        };
        let Camera {
            eye, target, up, ..
        } = *camera;
        Camera {
            eye: place(eye, self.point(eye)),
            target: place(target, self.point(target)),
            up: turned(up, self),
            ..*camera
        }
    }

    /// Its linear part.
    pub(super) fn linear(&self) -> DMat3 {
        match *self {
            Self::Move(_) => DMat3::IDENTITY,
            Self::Rotate { axis, angle, .. } => rotation(axis, angle),
            Self::Scale { factor, along, .. } => match along {
                Along::All => DMat3::from_diagonal(DVec3::splat(factor)),
                Along::World(axis) | Along::Own(axis) => {
                    let mut factors = DVec3::ONE;
                    factors[axis] = factor;
                    DMat3::from_diagonal(factors)
                }
            },
        }
    }

    /// The form after the motion; `None` if it would no longer be a box.
    pub(super) fn applied(&self, form: &Form) -> Option<Form> {
        let mut moved = Form {
            centre: self.point(form.centre),
            axes: form.axes.map(|axis| self.direction(axis)),
            half: form.half,
        };
        match *self {
            Self::Scale {
                factor,
                along,
                about,
            } => match along {
                Along::All => moved.half = form.half.map(|half| factor * half),
                Along::Own(axis) => {
                    let direction = form.axes[axis];
                    let offset = (form.centre - about).dot(direction);
                    moved.centre = form.centre + (factor - 1.0) * offset * direction;
                    moved.half[axis] *= factor;
                }
                Along::World(axis) => {
                    // Only a box whose edges have the direction of the axis stays a box.
                    let is_along = |of: &DVec3| 1.0 - of.dot(DVec3::AXES[axis]).abs() < 1e-9;
                    let own = form.axes.iter().position(is_along)?;
                    moved.half[own] *= factor;
                }
            },
            Self::Rotate { .. } => moved.axes = straightened(moved.axes, form.axes),
            Self::Move(_) => {}
        }
        Some(moved)
    }
}

/// Makes turned directions orthonormal again if they were so before but for digits that were left out, so
/// that many turns add up to no skew.
fn straightened(turned: [DVec3; 3], before: [DVec3; 3]) -> [DVec3; 3] {
    let [a, b, c] = before;
    let is_straight = [a.dot(b), a.dot(c), b.dot(c)]
        .iter()
        .all(|dot| dot.abs() <= UNIT_TOLERANCE);
    if is_straight {
        orthonormal(turned).unwrap_or(turned)
    } else {
        turned
    }
}

/// The orthonormal frame nearest to three directions that has the last one and their handedness, by
/// Gram–Schmidt; `None` if the first is parallel to the last, or one is 0.
pub(super) fn orthonormal([first, second, last]: [DVec3; 3]) -> Option<[DVec3; 3]> {
    let c = normalise(last)?;
    let first = normalise(first)?;
    let across = first - first.dot(c) * c;
    // The rest of a parallel direction is rounding.
    let a = normalise(across).filter(|_| 1e-9 < across.length())?;
    let b = c.cross(a);
    let b = if b.dot(second) < 0.0 { -b } else { b };
    Some([a, b, c])
}

/// The images of x, y and z under the shortest rotation from +z to a unit vector: Rodrigues'
/// formula with the axis z × n and the cosine n.z.
pub(super) fn rotated(n: DVec3) -> [DVec3; 3] {
    let across = n.x * n.x + n.y * n.y;
    // 1 / (1 + n.z), without cancellation for negative n.z.
    let share = if 0.0 <= n.z {
        1.0 / (1.0 + n.z)
    } else if across == 0.0 {
        return [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z];
    } else {
        (1.0 - n.z) / across
    };
    [
        DVec3::new(1.0 - share * n.x * n.x, -share * n.x * n.y, -n.x),
        DVec3::new(-share * n.x * n.y, 1.0 - share * n.y * n.y, -n.y),
        n,
    ]
}

/// The factor of a uniform scaling; `None` if the matrix is anything more.
pub(super) fn scaling([x, y, z]: [DVec3; 3]) -> Option<f64> {
    let size = x.x;
    let is_all = x == size * DVec3::X && y == size * DVec3::Y && z == size * DVec3::Z;
    (is_all && 0.0 < size && size.is_finite()).then_some(size)
}

/// The angle, in radians, by which a direction may miss where a motion takes it.
pub(crate) fn tolerance(motion: &Motion) -> f64 {
    let Motion::Rotate { angle, .. } = *motion else {
        return digits::TURN;
    };
    let rest = angle % 360.0;
    let turn = rest.abs().min(360.0 - rest.abs()).to_radians();
    digits::TURN.min(SHARE * turn)
}

/// The direction that is written for one after a motion.
pub(crate) fn turned(old: DVec3, motion: &Motion) -> DVec3 {
    let new = motion.direction(old);
    digits::direction(old, new, Lengths::Unit, tolerance(motion))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: Form = Form {
        centre: DVec3::new(1.0, 2.0, 3.0),
        axes: DVec3::AXES,
        half: [1.0, 2.0, 3.0],
    };

    #[test]
    fn motions_change_place_direction_and_size() {
        let about = DVec3::ZERO;
        let moved = |motion: Motion| motion.applied(&CUBE);
        let by = DVec3::new(0.0, 1.0, 0.0);
        let centre = DVec3::new(1.0, 3.0, 3.0);
        assert_eq!(moved(Motion::Move(by)), Some(Form { centre, ..CUBE }));
        let turned = moved(Motion::Rotate {
            axis: DVec3::Z,
            angle: 90.0,
            about,
        });
        let axes = [DVec3::Y, DVec3::NEG_X, DVec3::Z];
        let centre = DVec3::new(-2.0, 1.0, 3.0);
        assert_eq!(
            turned,
            Some(Form {
                centre,
                axes,
                ..CUBE
            })
        );
        let scaled = |along| {
            moved(Motion::Scale {
                factor: 2.0,
                along,
                about,
            })
        };
        let centre = DVec3::new(2.0, 4.0, 6.0);
        assert_eq!(
            scaled(Along::All),
            Some(Form {
                centre,
                half: [2.0, 4.0, 6.0],
                ..CUBE
            })
        );
        let centre = DVec3::new(1.0, 4.0, 3.0);
        let tall = Form {
            centre,
            half: [1.0, 4.0, 3.0],
            ..CUBE
        };
        assert_eq!(scaled(Along::Own(1)), Some(tall));
        assert_eq!(scaled(Along::World(1)), Some(tall));
        let skewed = Form {
            axes: turned_by(30.0),
            ..CUBE
        };
        let along = Along::World(1);
        assert_eq!(
            Motion::Scale {
                factor: 2.0,
                along,
                about
            }
            .applied(&skewed),
            None
        );
    }

    fn turned_by(angle: f64) -> [DVec3; 3] {
        let turn = rotation(DVec3::Z, angle);
        DVec3::AXES.map(|axis| turn * axis)
    }

    #[test]
    fn many_turns_keep_a_frame_orthonormal() {
        let axis = DVec3::new(1.0, 2.0, -3.0).normalize();
        let mut form = CUBE;
        for _ in 0..10_000 {
            let turn = Motion::Rotate {
                axis,
                angle: 17.0,
                about: form.centre,
            };
            form = turn.applied(&form).expect("a turned box is one");
        }
        let [a, b, c] = form.axes;
        let drift = [
            a.dot(b),
            a.dot(c),
            b.dot(c),
            a.length() - 1.0,
            b.length() - 1.0,
            c.length() - 1.0,
        ];
        assert!(drift.iter().all(|drift| drift.abs() < 1e-12), "{drift:?}");
        // 170,000° are 80° beyond whole turns.
        let expected = rotation(axis, 80.0) * DVec3::X;
        assert!((a - expected).length() < 1e-10, "{a} {expected}");
    }

    #[test]
    fn moved_numbers_are_rounded_and_others_are_kept() {
        for (old, new, decimals, rounded_to) in [
            (0.1, 0.300_000_000_000_000_04, 2, 0.3),
            (0.123_456, 0.123_456, 1, 0.123_456),
            (0.1, 0.100_000_000_000_000_02, 1, 0.1),
            (1.0, -0.001, 1, 0.0),
            // A step keeps the digits that it does not touch; anything else is rounded.
            (0.123, 0.223, 1, 0.223),
            (0.123, 0.213, 1, 0.2),
            (0.0, 3.28, 2, 3.28),
        ] {
            assert_eq!(rounded(old, new, decimals), rounded_to);
        }
    }
}
