//! Conversion between cameras and the `camera` element.

use glam::DVec3;

use super::Source;
use super::origins::Origins;
use super::table::camera::{self, PARAMETERS, index_of};
use crate::SceneText;
use crate::field_spans::FieldSpans;
use crate::schema::Field;
use crate::view::{Numbers, literal, take};
use scene::{Camera, Focus, Lens, Size};
use text::{Edit, spell_like};

/// Indices in [`PARAMETERS`].
const POSITION: usize = index_of(&camera::POSITION);
const TARGET: usize = index_of(&camera::TARGET);
const UP: usize = index_of(&camera::UP);
const FOV: usize = index_of(&camera::FOV);
const FOCAL_DISTANCE: usize = index_of(&camera::FOCAL_DISTANCE);
const LENS_RADIUS: usize = index_of(&camera::LENS_RADIUS);
const WIDTH: usize = index_of(&camera::WIDTH);
const HEIGHT: usize = index_of(&camera::HEIGHT);

/// Indices of the vectors, in the order of [`Origins::factors`].
const VECTORS: [usize; 3] = [POSITION, TARGET, UP];

/// The fields of the view that belong to the camera.
pub(super) fn fields(origins: &Origins) -> impl Iterator<Item = &'static Field> {
    let factors = origins.factors;
    PARAMETERS
        .iter()
        .enumerate()
        .map(move |(at, parameter)| match factors.get(at) {
            Some(Some(_)) => &parameter.scaled,
            _ => &parameter.field,
        })
}

/// The content of the camera element, with defaults for missing parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) position: DVec3,
    pub(super) target: DVec3,
    pub(super) up: DVec3,
    pub(super) fov: f64,
    pub(super) focus: Focus,
    pub(super) size: Size,
}

impl View {
    /// The camera it describes.
    pub(super) fn camera(&self) -> Camera {
        Camera {
            eye: self.position,
            target: self.target,
            up: self.up,
            lens: Lens::Perspective(self.fov),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: self.focus,
            size: self.size,
        }
    }

    /// The view that describes a camera.
    fn of(camera: &Camera) -> Self {
        let (Lens::Perspective(fov) | Lens::Orthographic(fov)) = camera.lens;
        Self {
            position: camera.eye,
            target: camera.target,
            up: camera.up,
            fov,
            focus: camera.focus,
            size: camera.size,
        }
    }

    /// The view with these numbers of its fields.
    fn from_numbers(numbers: &[&[f64]]) -> Self {
        let vector = |at: usize| {
            let factor = numbers[at].get(3).copied().unwrap_or(1.0);
            factor * DVec3::from_slice(numbers[at])
        };
        Self {
            position: vector(POSITION),
            target: vector(TARGET),
            up: vector(UP),
            fov: numbers[FOV][0],
            focus: Focus {
                distance: numbers[FOCAL_DISTANCE][0],
                lens_radius: numbers[LENS_RADIUS][0],
            },
            size: Size {
                width: numbers[WIDTH][0] as u32,
                height: numbers[HEIGHT][0] as u32,
            },
        }
    }

    /// The numbers of the view's fields. A vector keeps the factor that the text multiplies it by,
    /// if possible.
    fn numbers(&self, origins: &Origins) -> Vec<Vec<f64>> {
        let mut numbers = vec![Vec::new(); PARAMETERS.len()];
        let vectors = [self.position, self.target, self.up];
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
        numbers[FOV] = vec![self.fov];
        numbers[FOCAL_DISTANCE] = vec![self.focus.distance];
        numbers[LENS_RADIUS] = vec![self.focus.lens_radius];
        numbers[WIDTH] = vec![self.size.width.into()];
        numbers[HEIGHT] = vec![self.size.height.into()];
        numbers
    }
}

/// The numbers of a camera, in the order of [`fields`].
pub(super) fn numbers(camera: &Camera, origins: &Origins) -> Numbers {
    View::of(camera).numbers(origins).concat()
}

/// The camera described by these numbers.
pub(super) fn camera(numbers: &Numbers, origins: &Origins) -> Camera {
    let mut rest = &numbers[..];
    let numbers: Vec<_> = fields(origins)
        .map(|field| take(&mut rest, field))
        .collect();
    View::from_numbers(&numbers).camera()
}

/// Returns the edits that turn the text's camera `before` into `camera`. `fields` are the view's.
pub(super) fn edits(
    source: &Source,
    fields: &[FieldSpans],
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    let (text, origins) = (&source.text, &source.origins);
    let [mut old, new] = [before, camera].map(|camera| View::of(camera).numbers(origins));
    for (at, factor) in VECTORS.into_iter().zip(origins.factors) {
        // A vector that the text multiplies by 0 needs another factor.
        if factor.is_some_and(|factor| factor != old[at][3]) && old[at] != new[at] {
            old[at] = vec![f64::NAN; 4];
        }
    }
    let wanted: Vec<_> = fields
        .iter()
        .zip(old.iter().zip(&new))
        .map(|(placed, (old, new))| {
            let components = old.iter().zip(new).enumerate();
            let changed = components.filter(|(_, (old, new))| old != new);
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
    source.edits(&wanted)
}
