//! Objects: their positions, after all transforms around them, and their materials.

use std::collections::BTreeSet;

use glam::{DAffine3, DVec3};

use super::Lowering;
use crate::form::scaling;
use crate::node::Node;
use crate::report::quoted;
use crate::schema::{Range, SIZES};
use crate::xml::origins::Role;
use crate::xml::parameter::Type;
use crate::xml::schema::{GROUP, OBJ, PLANE, SPHERE};
use geometry::{Affine, Ellipsoid, Plane, Shape, Solid, Sphere};
use scene::{Material, Object, Rgb};
use text::{Diagnostic, Span, nearest_word};

/// An object's frame; `None` if its error was already reported.
type Frame = Option<DAffine3>;

impl Lowering<'_> {
    /// Lowers all objects, each before those in it.
    pub(super) fn place_objects(&mut self) {
        let count = self.origins.objects().len();
        let mut frames: Vec<Frame> = Vec::with_capacity(count);
        for index in 0..count {
            let place = &self.origins.objects()[index];
            let (kind, element) = (place.kind, place.element as usize);
            let parent = self.tree.elements[element].parent;
            let outer = match parent.map(|parent| self.origins.roles[parent as usize]) {
                Some(Role::Node(Node::Object(outer))) => frames[outer],
                _ => Some(DAffine3::IDENTITY),
            };
            let errors = self.report.errors();
            let own = self.transform_of(element).unwrap_or(DAffine3::IDENTITY);
            let is_valid = errors == self.report.errors();
            let frame = outer.filter(|_| is_valid).map(|outer| outer * own);
            frames.push(frame);
            let material = self.material_of(element);
            self.origins.set_material(index, material);
            let shaped = if *kind == GROUP {
                None
            } else if *kind == OBJ {
                self.mesh(element, frame, material)
            } else {
                let shape = frame.and_then(|frame| self.shape(kind, element, frame));
                shape.map(|shape| (shape, material.unwrap_or_else(|| self.white())))
            };
            if let Some((shape, material)) = shaped {
                self.origins.drawn.push(index);
                self.objects.push(Object {
                    shape,
                    material: material as u32,
                });
            }
        }
    }

    /// The product of an element's transforms, the first applied first; `None` if there are none.
    pub(super) fn transform_of(&mut self, element: usize) -> Option<DAffine3> {
        let mut all: Option<DAffine3> = None;
        let tree = self.tree;
        for child in tree.children(element) {
            let Role::Transform(parameter) = self.origins.roles[child] else {
                continue;
            };
            let vector = self.vector_in(Some(child), parameter);
            let angle = self.angle_in(child, parameter);
            if parameter.element == "scale" && vector.to_array().contains(&0.0) {
                self.flat(child);
            } else if parameter.element == "rotate" && vector == DVec3::ZERO {
                let (name, span) = (self.display_name(child), self.attributes_span(child));
                let message = || format!("{name}: the axis is zero");
                self.warn(span, message, "an axis: x, y, z", "the rotation is ignored");
            }
            let one = parameter.matrix(vector, angle);
            all = Some(all.map_or(one, |before| one * before));
        }
        all
    }

    fn flat(&mut self, element: usize) {
        let (name, span) = (self.display_name(element), self.attributes_span(element));
        self.report.error(|| {
            let message = format!("{name}: must not be 0 along any axis");
            Diagnostic::error(span, message, "numbers other than 0")
                .with_hint("to flatten it, scale by a small number, or use a plane")
        });
    }

    /// The index of the default material.
    pub(super) fn white(&mut self) -> usize {
        *self.white.get_or_insert_with(|| {
            self.materials.push(Material::unlit(Rgb::ONE));
            self.materials.len() - 1
        })
    }

    /// The shape of a sphere or plane in its frame; `None`, with an error, if it has no volume.
    fn shape(&mut self, kind: &Type, element: usize, frame: DAffine3) -> Option<Shape> {
        let columns = [frame.x_axis, frame.y_axis, frame.z_axis];
        if *kind == SPHERE
            && let Some(radius) = scaling(columns)
            && Range::Size.contains(radius)
            && frame.translation.is_finite()
        {
            return Some(Shape::Solid(Solid::Sphere(Sphere {
                centre: frame.translation,
                radius,
            })));
        }
        let affine = self.affine(element, frame)?;
        Some(if *kind == PLANE {
            Shape::Plane(Box::new(Plane(affine)))
        } else {
            Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(affine))))
        })
    }

    /// An object's frame; `None`, with an error, if it is not invertible.
    pub(super) fn affine(&mut self, element: usize, frame: DAffine3) -> Option<Affine> {
        let columns = [frame.x_axis, frame.y_axis, frame.z_axis];
        let affine = Affine::of_matrix(columns, frame.translation);
        if affine.is_none() {
            self.no_volume(element);
            return None;
        }
        let are_sizes = columns.map(|column| Range::Size.contains(column.length()));
        if are_sizes != [true; 3] {
            self.no_size(element, &frame);
            return None;
        }
        affine
    }

    /// Reports an object whose size is beyond all bounds, at the last of its own transforms that scale it.
    pub(super) fn no_size(&mut self, element: usize, frame: &DAffine3) {
        let (name, tree) = (self.display_name(element), self.tree);
        let scales = tree.children(element).filter(|&child| {
            matches!(self.origins.roles[child], Role::Transform(one) if one.element == "scale")
        });
        let span = match scales.last() {
            Some(scale) => self.attributes_span(scale),
            None => tree.elements[element].name,
        };
        let [least, beyond] = SIZES;
        let expected = format!("a size of at least {least:e} and less than {beyond:e}");
        let columns = [frame.x_axis, frame.y_axis, frame.z_axis];
        let reason = if columns.iter().all(|column| column.is_normalized()) {
            "it is too large"
        } else {
            "its transforms make it too small or too large"
        };
        let message = || format!("{name}: {reason}");
        self.error(span, message, &expected);
    }

    pub(super) fn no_volume(&mut self, element: usize) {
        let (name, span) = (self.display_name(element), self.place(element));
        let message = || format!("{name}: its transforms flatten it or are too large");
        self.error(span, message, "invertible transforms");
    }

    /// The index of an object's material.
    fn material_of(&mut self, element: usize) -> Option<usize> {
        let name = self.word(element, "material")?;
        let found = self.named.get(name).copied();
        if found.is_none() {
            let span = self.value(element, "material").map(|at| at.value);
            let named = &self.named;
            self.report
                .warning(|| unknown_material(name, span.unwrap_or_default(), named.keys()));
        }
        found
    }
}

/// The warning for a name that no material has.
fn unknown_material<'n>(
    name: &str,
    span: Span,
    named: impl Iterator<Item = &'n &'n str>,
) -> Diagnostic {
    const FLAT: &str = "the object is drawn flat white";
    // Sorted, so that the answer is always the same.
    let known: BTreeSet<_> = named.copied().collect();
    let meant = nearest_word(name, known);
    let message = format!("material: no material named {}", quoted(name));
    let warning = Diagnostic::warning(span, message, "the name of a material");
    match meant {
        None => warning.with_hint(FLAT),
        Some(meant) => {
            let warning = warning.with_hint(format!("{FLAT}; did you mean `{meant}`?"));
            let is_plain = !meant.contains(['&', '<', '"', '\'']);
            if is_plain {
                warning.with_fix(span, meant)
            } else {
                warning
            }
        }
    }
}
