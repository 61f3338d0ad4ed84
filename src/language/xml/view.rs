//! Conversion between cameras and the `camera` element.

use glam::DVec3;

use super::Source;
use super::origins::Origins;
use super::schema::CAMERA;
use crate::schema::Field;
use crate::view::{Numbers, spelled, take};
use crate::{Node, SceneText};
use scene::{Camera, Focus, Lens, Size};
use text::Edit;

/// The fields of the view that belong to the camera.
pub(super) fn fields(origins: &Origins) -> impl Iterator<Item = &'static Field> {
    let factors = origins.factors;
    CAMERA
        .iter()
        .enumerate()
        .map(move |(at, parameter)| match factors.get(at) {
            Some(Some(_)) => &parameter.scaled,
            _ => &parameter.field,
        })
}

/// The camera with these vectors and numbers, in the order of the table.
pub(super) fn camera_of(
    [eye, target, up]: [DVec3; 3],
    [fov, distance, lens_radius, width, height]: [f64; 5],
) -> Camera {
    Camera {
        eye,
        target,
        up,
        lens: Lens::Perspective(fov),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus {
            distance,
            lens_radius,
        },
        size: Size {
            width: width as u32,
            height: height as u32,
        },
    }
}

/// The numbers of each field of a camera, in the order of [`fields`]. A vector keeps the factor that
/// the text multiplies it by, if possible.
fn numbers_of(camera: &Camera, origins: &Origins) -> Vec<Vec<f64>> {
    let vectors = [camera.eye, camera.target, camera.up].into_iter();
    let vectors = vectors.zip(origins.factors).map(|(vector, factor)| {
        let Some(factor) = factor else {
            return vector.to_array().to_vec();
        };
        let parts = vector / factor;
        let (parts, factor) = if parts * factor == vector {
            (parts, factor)
        } else {
            (vector, 1.0)
        };
        vec![parts.x, parts.y, parts.z, factor]
    });
    let (Lens::Perspective(fov) | Lens::Orthographic(fov)) = camera.lens;
    let (focus, Size { width, height }) = (camera.focus, camera.size);
    let numbers = [
        fov,
        focus.distance,
        focus.lens_radius,
        width.into(),
        height.into(),
    ];
    vectors.chain(numbers.map(|number| vec![number])).collect()
}

/// The numbers of a camera, in the order of [`fields`].
pub(super) fn numbers(camera: &Camera, origins: &Origins) -> Numbers {
    numbers_of(camera, origins).concat()
}

/// The camera described by these numbers.
pub(super) fn camera(numbers: &Numbers, origins: &Origins) -> Camera {
    let mut rest = &numbers[..];
    let parts = fields(origins).map(|field| take(&mut rest, field));
    let parts: Vec<_> = parts.collect();
    let vector = |at: usize| {
        let factor = parts[at].get(3).copied().unwrap_or(1.0);
        factor * DVec3::from_slice(parts[at])
    };
    camera_of(
        [0, 1, 2].map(vector),
        [3, 4, 5, 6, 7].map(|at| parts[at][0]),
    )
}

/// Returns the edits that turn the text's camera `before` into `camera`.
pub(super) fn edits(source: &Source, before: &Camera, camera: &Camera) -> Vec<Edit> {
    let fields = source.fields(Node::View);
    let origins = &source.origins;
    let [mut old, new] = [before, camera].map(|camera| numbers_of(camera, origins));
    for (at, factor) in origins.factors.into_iter().enumerate() {
        // A vector that the text multiplies by 0 needs another factor.
        if factor.is_some_and(|factor| factor != old[at][3]) && old[at] != new[at] {
            old[at] = vec![f64::NAN; 4];
        }
    }
    let wanted = fields.iter().zip(old.iter().zip(&new));
    let wanted = wanted.map(|(placed, (old, new))| {
        let new: Vec<_> = new.iter().map(|number| number + 0.0).collect();
        (placed, source.changed(placed, old, &new, spelled))
    });
    source.edits(&wanted.collect::<Vec<_>>())
}
