//! Where something is relative to the picture, and the arrow towards it.

use glam::DVec3;

use super::asking::objects_of;
use super::screen::locates;
use crate::app::Shared;
use language::Node;
use render::{camera_axes, project_point};
use scene::Emitter;

/// An arrow at the edge of the picture, towards something outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arrow {
    /// The sign to draw.
    pub(crate) sign: &'static str,
    /// Its place as parts of the picture's width and height.
    pub(crate) place: [f64; 2],
}

/// Where a point is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spot {
    Inside,
    /// In this direction from the middle, to the right and down.
    Outside([f64; 2]),
    /// Behind the camera, in this direction.
    Behind([f64; 2]),
}

/// The signs and the words of eight directions, from the right clockwise.
const DIRECTIONS: [(&str, &str); 8] = [
    ("→", "to the right"),
    ("↘", "at the lower right"),
    ("↓", "below"),
    ("↙", "at the lower left"),
    ("←", "to the left"),
    ("↖", "at the upper left"),
    ("↑", "above"),
    ("↗", "at the upper right"),
];

/// The arrow towards what the panel is about, if that is outside the picture.
pub(crate) fn arrow(shared: &Shared) -> Option<Arrow> {
    if locates(shared).is_none() || 0 < shared.error_count() {
        return None;
    }
    let direction = match spot(shared, place(shared, shared.cursor.selected())?)? {
        Spot::Inside => return None,
        Spot::Outside(direction) | Spot::Behind(direction) => direction,
    };
    let longest = direction[0].abs().max(direction[1].abs());
    let place = direction.map(|part| 0.5 + 0.5 * part / longest);
    Some(Arrow {
        sign: named(direction).0,
        place,
    })
}

/// The words for a direction.
pub(super) fn words([right, down]: [f64; 2]) -> &'static str {
    named([right, down]).1
}

fn named([right, down]: [f64; 2]) -> (&'static str, &'static str) {
    let eighth = libm::atan2(down, right) * 4.0 / std::f64::consts::PI;
    DIRECTIONS[(eighth.round() as i64).rem_euclid(8) as usize]
}

/// Where a node is in space, if it is anywhere.
pub(super) fn place(shared: &Shared, node: Node) -> Option<DVec3> {
    let scene = shared.scene.as_ref()?;
    let place = match node {
        Node::View => scene.camera.eye,
        Node::Light(light) => match scene.lights.get(light)?.emitter {
            Emitter::Point { position, .. } => position,
            Emitter::Distant(_) | Emitter::Ambient => return None,
        },
        Node::Object(_) => {
            let objects = objects_of(shared, node).into_iter();
            let bounds = objects.filter_map(|object| scene.objects.get(object as usize));
            let corners = bounds.map(|object| {
                let bounds = object.shape.bounds();
                [bounds.min, bounds.max]
            });
            let [least, most] =
                corners.reduce(|all, one| [all[0].min(one[0]), all[1].max(one[1])])?;
            0.5 * least + 0.5 * most
        }
        _ => return None,
    };
    place.is_finite().then_some(place)
}

/// Where a point is relative to the picture.
pub(super) fn spot(shared: &Shared, point: DVec3) -> Option<Spot> {
    let camera = shared.camera()?;
    let (_, size) = shared.raster()?;
    let limits = [size.width, size.height].map(f64::from);
    if let Some([x, y]) = project_point(point, &camera, size) {
        let from_middle = [2.0 * x / limits[0] - 1.0, 2.0 * y / limits[1] - 1.0];
        let is_inside = from_middle.iter().all(|part| part.abs() <= 1.0);
        return Some(if is_inside {
            Spot::Inside
        } else {
            Spot::Outside(from_middle)
        });
    }
    let [right, up, _] = camera_axes(&camera);
    let offset = point - camera.eye;
    let direction = [offset.dot(right), -offset.dot(up)];
    let is_straight = direction
        .iter()
        .all(|part| part.abs() <= 1e-9 * offset.length());
    // Straight behind is one turn away whichever way one turns.
    Some(Spot::Behind(if is_straight {
        [0.0, 1.0]
    } else {
        direction
    }))
}
