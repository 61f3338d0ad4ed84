//! The object that is selected when a scene opens.

use std::iter::once;

use crate::app::Shared;
use language::Node;
use render::{distance_to_surface, surface_under};
use scene::{Camera, Objects};

/// Objects beyond which none is looked for: each is intersected without the help of a hierarchy.
const MOST: usize = 20_000;

/// The places that are looked at, the best first, in eighths of the picture's height from its middle.
const PLACES: [[i64; 2]; 9] = [
    [0, 0],
    [0, 1],
    [-1, 0],
    [1, 0],
    [0, 2],
    [-2, 0],
    [2, 0],
    [0, -1],
    [0, -2],
];

/// The object in the middle of the picture, or near it, that is not all around the camera: its changes are
/// seen. Otherwise the first one.
pub(super) fn first_selected(shared: &Shared) -> Node {
    let scene = shared.scene.as_deref().zip(shared.camera());
    let scene = scene.filter(|(scene, _)| scene.objects.len() <= MOST);
    let found = scene.and_then(|(scene, camera)| {
        let objects = &scene.objects;
        PLACES
            .iter()
            .find_map(|place| shown_at(objects, &camera, *place))
    });
    Node::Object(found.map_or(0, |number| shared.source().object(number)))
}

/// The number of the object shown at a place, unless it is all around the camera.
fn shown_at(objects: &Objects, camera: &Camera, [right, down]: [i64; 2]) -> Option<u32> {
    let eighth = i64::from(camera.size.height / 8);
    let at = |side: u32, offset: i64| {
        let at = i64::from(side / 2) + offset * eighth;
        u32::try_from(at).ok().filter(|at| *at < side)
    };
    let pixel = [at(camera.size.width, right)?, at(camera.size.height, down)?];
    let hits = objects.iter().enumerate().filter_map(|(number, object)| {
        let point = surface_under(object, camera, camera.size, pixel)?.point;
        Some((point.distance(camera.eye), point, number))
    });
    let (_, point, number) = hits.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let back = (camera.eye - point).normalize_or_zero();
    let behind = distance_to_surface(once(&objects[number]), [camera.eye, back], f64::INFINITY);
    let number = u32::try_from(number).ok()?;
    behind.is_none().then_some(number)
}
