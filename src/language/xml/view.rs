//! A camera as the `camera` element of a `.xml` text.

use super::Source;
use super::origins::Origins;
use super::table::{CAMERA, FOCAL_DISTANCE, FOV, HEIGHT, LENS, POSITION, TARGET, UP, WIDTH};
use crate::language::placed::{self, Placed};
use crate::language::table::Field;
use crate::language::view::{Numbers, differ, literal};
use crate::scene::{Camera, Focus, Lens, Size};
use crate::text::{Edit, spell_like};

/// The vectors, in the order of [`Origins::factors`].
const VECTORS: [usize; 3] = [POSITION, TARGET, UP];

/// The fields of the view that are the camera's.
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

/// A camera's numbers, in the order of [`fields`]. A vector that the text multiplies by a number
/// keeps that, unless it can't.
pub(super) fn numbers(camera: &Camera, origins: &Origins) -> Numbers {
    let (Lens::Perspective(angle) | Lens::Orthographic(angle)) = camera.lens;
    let mut numbers = vec![Vec::new(); CAMERA.len()];
    let vectors = [camera.eye, camera.target, camera.up];
    for ((at, vector), factor) in VECTORS.into_iter().zip(vectors).zip(origins.factors) {
        let Some(factor) = factor else {
            numbers[at] = vector.to_array().into();
            continue;
        };
        let parts = vector / factor;
        let (parts, factor) = if parts * factor == vector {
            (parts, factor)
        } else {
            (vector, 1.0)
        };
        numbers[at] = vec![parts.x, parts.y, parts.z, factor];
    }
    numbers[FOV] = vec![angle];
    numbers[FOCAL_DISTANCE] = vec![camera.focus.distance];
    numbers[LENS] = vec![camera.focus.lens_radius];
    numbers[WIDTH] = vec![camera.size.width.into()];
    numbers[HEIGHT] = vec![camera.size.height.into()];
    numbers
}

/// The camera of which these are the numbers; `base` is one of the same text.
pub(super) fn camera(numbers: &Numbers, base: &Camera) -> Camera {
    let vector = |at: usize| {
        let factor = numbers[at].get(3).copied().unwrap_or(1.0);
        factor * glam::DVec3::from_slice(&numbers[at])
    };
    Camera {
        eye: vector(POSITION),
        target: vector(TARGET),
        up: vector(UP),
        lens: Lens::Perspective(numbers[FOV][0]),
        focus: Focus {
            distance: numbers[FOCAL_DISTANCE][0],
            lens_radius: numbers[LENS][0],
        },
        size: Size {
            width: numbers[WIDTH][0] as u32,
            height: numbers[HEIGHT][0] as u32,
        },
        ..*base
    }
}

/// The edits after which the text, whose camera is `before`, says `camera`. `fields` are the view's.
pub(super) fn edits(
    source: &Source,
    fields: &[Placed],
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    let (text, origins) = (&source.text, &source.origins);
    let (mut old, new) = (numbers(before, origins), numbers(camera, origins));
    for (at, factor) in VECTORS.into_iter().zip(origins.factors) {
        // What the text multiplies by 0 it can say by other numbers only.
        if factor.is_some_and(|factor| differ(factor, old[at][3])) && old[at] != new[at] {
            old[at] = vec![f64::NAN; 4];
        }
    }
    let wanted: Vec<_> = fields
        .iter()
        .zip(old.iter().zip(&new))
        .map(|(placed, (old, new))| {
            let components = old.iter().zip(new).enumerate();
            let changed = components.filter(|(_, (old, new))| differ(**old, **new));
            let spelled = changed.map(|(component, (_, &number))| {
                let spelled = match placed.default_of(component) {
                    Some(_) => literal(placed.field, number),
                    None => spell_like(placed.spans[component].of(text).trim(), number + 0.0),
                };
                (component, spelled)
            });
            (placed, spelled.collect())
        })
        .collect();
    placed::edits(source, &wanted)
}
