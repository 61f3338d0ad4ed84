//! The objects near a point, so that short rays around it need not be tested against all others.

use std::ops::ControlFlow;

use glam::DVec3;

use super::intersect::Nearest;
use super::{MOST_WITHOUT_TREE_FOR_PATHS, World};
use geometry::{Aabb, Ray, Shape, Solid};

/// At most this many objects are listed.
const MOST_LISTED: usize = MOST_WITHOUT_TREE_FOR_PATHS;

/// The objects that rays within a ball may meet.
pub(crate) struct Nearby<'w> {
    world: &'w World,
    /// In file order, and how many; `None` if there are too many.
    listed: Option<([u32; MOST_LISTED], usize)>,
}

impl<'w> Nearby<'w> {
    /// Those within a radius of a point.
    pub(crate) fn new(world: &'w World, point: DVec3, radius: f64) -> Self {
        let objects = &world.scene.objects;
        let (mut list, mut count) = ([0; MOST_LISTED], 0);
        let mut add = |number: u32| {
            if !may_reach(&objects[number as usize].shape, point, radius) {
                return ControlFlow::Continue(());
            }
            let Some(place) = list.get_mut(count) else {
                return ControlFlow::Break(());
            };
            *place = number;
            count += 1;
            ControlFlow::Continue(())
        };
        let listed = if let Some(tree) = &world.tree {
            let cube = Aabb {
                min: point - radius,
                max: point + radius,
            };
            tree.overlapping(cube, |run| {
                tree.order()[run].iter().copied().try_for_each(&mut add)
            })
        } else {
            (0..objects.len() as u32).try_for_each(add)
        };
        list[..count].sort_unstable();
        Self {
            world,
            listed: listed.is_continue().then_some((list, count)),
        }
    }

    /// The same as [`World::nearest`] for a ray within the ball up to the limit.
    pub(crate) fn nearest(&self, ray: &Ray, limit: f64) -> Option<Nearest> {
        match &self.listed {
            Some((list, count)) => self.world.nearest_of(&list[..*count], ray, limit),
            None => self.world.nearest(ray, limit),
        }
    }

    /// Whether no other object than this reaches into a smaller ball around the same point.
    pub(crate) fn is_alone(&self, object: u32, point: DVec3, radius: f64) -> bool {
        self.listed.as_ref().is_some_and(|(list, count)| {
            list[..*count].iter().all(|&other| {
                let shape = &self.world.scene.objects[other as usize].shape;
                other == object || !may_reach(shape, point, radius)
            })
        })
    }
}

/// Whether a shape may reach into a ball.
fn may_reach(shape: &Shape, point: DVec3, radius: f64) -> bool {
    let bounds = shape.bounds();
    let beyond = (bounds.min - point).max(point - bounds.max);
    if radius * radius < beyond.max(DVec3::ZERO).length_squared() {
        return false;
    }
    // A large sphere is a dome around all.
    if let Shape::Solid(Solid::Sphere(sphere)) = shape {
        let rounding = 1e-9 * (sphere.radius + sphere.centre.length());
        let distance = (point - sphere.centre).length();
        return (distance - sphere.radius).abs() <= radius + rounding;
    }
    true
}
