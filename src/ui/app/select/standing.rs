//! Where a new thing stands: on the surface that is looked at, neither in it nor above it.

use glam::DVec3;

use crate::app::shared::inspection::Cross;
use crate::app::{Shared, inspect, transform};
use language::Node;
use render::{
    SurfacePoint, distance_to_surface, pixel_width, project_point, summit, surface_under,
    surrounds, top_at,
};
use scene::{Camera, Object, Scene, Size};

/// The fraction of the picture's height that a new thing takes up.
const SHARE: f64 = 0.2;
/// The cosine of the steepest slope on which things stand where one points.
const LEVEL: f64 = 0.97;
/// The gap below something flat, which would share all its points with the surface, as a part of half its
/// size.
const GAP: f64 = 0.02;
/// Directions in which the ground around a place is looked at.
const AROUND: usize = 8;

/// Where a new thing comes to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Its centre.
    pub(super) centre: DVec3,
    /// Half its size.
    pub(super) half: f64,
    /// The axis of the world that points up.
    pub(super) up: DVec3,
    /// The decimals that its numbers need.
    pub(super) decimals: usize,
    /// The object that it stands on.
    pub(super) on: Option<Node>,
}

/// The place of a new thing, which reaches from its centre as far down as it is wide, unless it is flat.
pub(super) fn place_for_new(shared: &Shared, is_flat: bool) -> Place {
    let up = vertical(shared);
    let free = |centre, half| Place {
        centre,
        half,
        up,
        decimals: transform::decimals_of(0.2 * half),
        on: None,
    };
    let Some(((scene, camera), (_, size))) =
        (shared.scene.as_ref().zip(shared.camera())).zip(shared.raster())
    else {
        let centre = shared.camera().map_or(DVec3::ZERO, |camera| camera.target);
        return free(centre, 1.0);
    };
    let size_at = |point: DVec3| {
        let half = 0.5 * SHARE * f64::from(size.height) * pixel_width(point, &camera, size);
        transform::round_up(half)
    };
    let ground = Ground {
        scene,
        camera: &camera,
        size,
        up,
    };
    let pointed = surface_looked_at(shared);
    let around = pointed.map_or(camera.target, |(_, found)| found.point);
    let half = size_at(around);
    let stand = match pointed {
        Some((object, found)) => ground.stand_at(object, found, half),
        None => ground.below(camera.target, half),
    };
    let Some((object, point)) = stand else {
        let beside = pointed.map_or(around, |(_, found)| found.point + half * found.normal);
        return free(beside, half);
    };
    let height = if is_flat { GAP * half } else { half };
    let decimals = transform::decimals_of(0.001 * half);
    let index = scene
        .objects
        .iter()
        .position(|other| std::ptr::eq(other, object));
    let on = index.and_then(|index| u32::try_from(index).ok());
    Place {
        centre: point + height * up,
        half,
        up,
        decimals,
        on: on.map(|index| Node::Object(shared.source().object(index))),
    }
}

/// The axis of the world that points up: that of the language's scenes, unless the camera, which does not
/// look along it, says otherwise.
fn vertical(shared: &Shared) -> DVec3 {
    let usual = shared.source().language().vertical();
    let camera = shared.scene.as_ref().map(|scene| scene.camera);
    let Some(camera) = camera else {
        return usual;
    };
    let forward = (camera.target - camera.eye).normalize_or_zero();
    let other = if usual == DVec3::Y {
        DVec3::Z
    } else {
        DVec3::Y
    };
    let is_other = camera.up.dot(usual).abs() < camera.up.dot(other).abs();
    if is_other && forward.dot(usual).abs() < LEVEL {
        other
    } else {
        usual
    }
}

/// A scene in which things are put down.
struct Ground<'s> {
    scene: &'s Scene,
    camera: &'s Camera,
    size: Size,
    up: DVec3,
}

impl<'s> Ground<'s> {
    /// Where something stands when one points at a surface: there if that is nearly level, otherwise on
    /// top of the object if the top is in the picture, otherwise on what is below.
    fn stand_at(
        &self,
        object: &'s Object,
        found: SurfacePoint,
        half: f64,
    ) -> Option<(&'s Object, DVec3)> {
        let is_around = surrounds(object, self.camera.eye);
        if LEVEL <= found.normal.dot(self.up) {
            return Some((
                object,
                self.cleared(object, self.tidy(object, found.point, half), half),
            ));
        }
        let top = (!is_around)
            .then(|| summit(object, found.point, self.up))
            .flatten();
        if let Some(top) = top.filter(|top| self.is_in_picture(*top)) {
            return Some(self.on_what_is_there(object, self.tidy(object, top, half), half));
        }
        self.below(found.point + half * found.normal, half)
    }

    /// The place below a point of the air.
    fn below(&self, point: DVec3, half: f64) -> Option<(&'s Object, DVec3)> {
        let ray = [point, -self.up];
        let distance = |object: &'s Object| {
            // Inside an object there is no place to stand.
            let far = distance_to_surface([object].into_iter(), ray, f64::INFINITY)?;
            Some((object, far))
        };
        let hits = self.scene.objects.iter().filter_map(distance);
        let (object, far) = hits.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let found = point - far * self.up;
        let is_top = top_at(object, found, self.up).is_some_and(|top| top <= 1e-6 * (1.0 + far));
        (is_top || surrounds(object, self.camera.eye))
            .then(|| (object, self.tidy(object, found, half)))
    }

    /// A place on top of an object, or on what already stands there.
    fn on_what_is_there(&self, object: &'s Object, point: DVec3, half: f64) -> (&'s Object, DVec3) {
        let others = self
            .scene
            .objects
            .iter()
            .filter(|other| !std::ptr::eq(*other, object));
        let others = others.filter(|other| !surrounds(other, self.camera.eye));
        let near = 1e-6 * half;
        let ray = [point - near * self.up, self.up];
        let others = others.filter_map(|other| {
            let far = distance_to_surface([other].into_iter(), ray, 2.0 * half)?;
            Some((other, far))
        });
        let first = others.min_by(|a, b| a.1.total_cmp(&b.1));
        let top = first.and_then(|(other, _)| Some((other, top_at(other, point, self.up)?)));
        match top {
            Some((other, top)) => (other, point + top * self.up),
            None => (object, point),
        }
    }

    /// A place raised until the ground of this object around it is not above it.
    fn cleared(&self, object: &Object, point: DVec3, half: f64) -> DVec3 {
        let side = self.up.any_orthonormal_vector();
        let rim = (0..AROUND).filter_map(|step| {
            let angle = std::f64::consts::TAU * step as f64 / AROUND as f64;
            let (sine, cosine) = libm::sincos(angle);
            let place = point + half * (cosine * side + sine * self.up.cross(side));
            let start = place + half * self.up;
            let ray = [start, -self.up];
            let far = distance_to_surface([object].into_iter(), ray, half)?;
            Some(half - far)
        });
        point + rim.fold(0.0, f64::max) * self.up
    }

    /// A place of the surface near another, at round numbers across it.
    fn tidy(&self, object: &Object, point: DVec3, half: f64) -> DVec3 {
        let scale = libm::pow(10.0, transform::decimals_of(0.2 * half) as f64);
        let round = (point * scale).round() / scale;
        let round = round + (point - round).dot(self.up) * self.up;
        let start = round + half * self.up;
        match distance_to_surface([object].into_iter(), [start, -self.up], 2.0 * half) {
            Some(far) => start - far * self.up,
            None => point,
        }
    }

    fn is_in_picture(&self, point: DVec3) -> bool {
        let limits = [self.size.width, self.size.height].map(f64::from);
        project_point(point, self.camera, self.size)
            .is_some_and(|[x, y]| 0.0 <= x && 0.0 <= y && x < limits[0] && y < limits[1])
    }
}

/// The object and the point of its surface under the cross, or without a cross under the middle of the
/// picture, if there is one.
fn surface_looked_at(shared: &Shared) -> Option<(&Object, SurfacePoint)> {
    let Cross { pixel, size } = inspect::cross(shared)?;
    let Ok(Some(Node::Object(index))) = inspect::node_at(shared, pixel) else {
        return None;
    };
    let scene = shared.scene.as_ref()?;
    let object = scene.objects.get(shared.source().drawn(index)? as usize)?;
    Some((
        object,
        surface_under(object, &shared.camera()?, size, pixel)?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::tests::open;

    /// A ground, a sphere and a small box on it, a wall that is higher than the picture, and a ball on top
    /// of a box.
    const TEXT: &str = "0.1 0.1 0.1\n1\n5 5 5  1 1 1\n6\n\
        box -50 -1 -50  1 0 0  0 1 0  0 0 1  100 1 100  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n\
        sphere 0 1 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n\
        box 2 0 0  1 0 0  0 1 0  0 0 1  1 0.5 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n\
        box -20 0 -6  1 0 0  0 1 0  0 0 1  40 90 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n\
        box -3 0 0  1 0 0  0 1 0  0 0 1  1 0.5 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n\
        sphere -2.5 0.75 0.5 0.25  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";

    #[test]
    fn things_stand_on_what_is_pointed_at_or_beside_it() {
        let app = open(TEXT);
        let scene = app.shared.scene.expect("a scene");
        let camera = Camera {
            eye: DVec3::new(0.0, 3.0, 12.0),
            target: DVec3::Y,
            up: DVec3::Y,
            ..scene.camera
        };
        let size = Size {
            width: 80,
            height: 60,
        };
        let ground = Ground {
            scene: &scene,
            camera: &camera,
            size,
            up: DVec3::Y,
        };
        let slant = 0.5_f64.sqrt();
        for (name, object, point, normal, on, stands) in [
            (
                "the ground",
                0,
                [4.0, 0.0, 3.0],
                [0.0, 1.0, 0.0],
                0,
                [4.0, 0.0, 3.0],
            ),
            (
                "a flank",
                1,
                [slant, 1.0 + slant, 0.0],
                [slant, slant, 0.0],
                1,
                [0.0, 2.0, 0.0],
            ),
            (
                "below the middle",
                1,
                [slant, 1.0 - slant, 0.0],
                [slant, -slant, 0.0],
                1,
                [0.0, 2.0, 0.0],
            ),
            (
                "the side of a box",
                2,
                [2.5, 0.2, 1.0],
                [0.0, 0.0, 1.0],
                2,
                [2.5, 0.5, 0.5],
            ),
            (
                "a wall",
                3,
                [1.0, 2.0, -5.0],
                [0.0, 0.0, 1.0],
                0,
                [1.0, 0.0, -4.8],
            ),
            (
                "a laden box",
                4,
                [-2.5, 0.2, 1.0],
                [0.0, 0.0, 1.0],
                5,
                [-2.5, 1.0, 0.5],
            ),
        ] {
            let found = SurfacePoint {
                point: point.into(),
                normal: normal.into(),
            };
            let stand = ground.stand_at(&scene.objects[object], found, 0.2);
            let (other, place) = stand.expect("it stands");
            let at = scene.objects.iter().position(|it| std::ptr::eq(it, other));
            assert_eq!(at, Some(on), "{name}");
            assert!(
                (place - DVec3::from(stands)).length() < 1e-6,
                "{name}: {place}"
            );
        }
        // In the air it falls to the ground; beside all there is nowhere to stand.
        let below = |point| ground.below(point, 0.2).map(|(_, place)| place.round());
        assert_eq!(
            below(DVec3::new(7.0, 4.0, 3.0)),
            Some(DVec3::new(7.0, 0.0, 3.0))
        );
        assert_eq!(below(DVec3::new(0.0, -4.0, 3.0)), None);
    }
}
