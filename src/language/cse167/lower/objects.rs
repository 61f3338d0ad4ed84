//! Lights, spheres, meshes and the piles of vertices.

use std::borrow::Cow;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Lowering;
use crate::cse167::schema::{
    DIRECTIONAL, MAXVERTNORMS, MAXVERTS, QUAD_LIGHT, TRI, TRI_NORMAL, VERTEX, VERTEX_NORMAL,
};
use crate::engine::places::Place;
use crate::engine::reader::Reading;
use crate::form::scaling;
use crate::node::Node;
use crate::report::quoted;
use crate::schema::{Category, Range, Record};
use geometry::{
    ABSENT, Affine, Attribute, Ellipsoid, Instance, Mesh, MeshParts, Shape, Solid, Sphere,
    normalise,
};
use scene::{Emitter, Faces, Falloff, Light, Material, Object, Rgb, Shadows};
use text::{Diagnostic, Span, counted, is_integer};

/// Where an object is, and what it is made of.
#[derive(Clone, Copy, Debug)]
pub(in crate::cse167) struct Placed {
    /// From its space to the world.
    pub(in crate::cse167) transform: DAffine3,
    /// Its centre in the world.
    pub(in crate::cse167) centre: DVec3,
}

/// The piles of vertices, and the mesh that is open.
#[derive(Debug, Default)]
pub(super) struct Meshes {
    plain: Pile,
    with_normals: Pile,
    normals: Vec<DVec3>,
    open: Option<OpenMesh>,
    /// The first triangle without area, and their number.
    degenerate: Option<(Span, usize)>,
}

/// Vertices, numbered from 0.
#[derive(Debug, Default)]
struct Pile {
    vertices: Vec<DVec3>,
    /// The declared number.
    most: Option<(f64, Span)>,
}

/// A mesh that more triangles may join.
#[derive(Debug)]
struct OpenMesh {
    last: usize,
    head: Span,
    material: usize,
    transform: DAffine3,
    parts: MeshParts,
    /// The position in the mesh of each vertex used, by its pile and number.
    used: HashMap<(bool, u32), u32>,
}

impl Lowering<'_> {
    pub(super) fn light(&mut self, read: &Reading<'_>) {
        self.reader.places.own.lights.push(self.state.transform);
        let Some(numbers) = read.numbers() else {
            self.lights.push(Light::point(DVec3::ZERO, Rgb::ZERO));
            return;
        };
        let transform = self.state.transform;
        let (vector, colour) = (DVec3::from_slice(numbers), Rgb::from_slice(&numbers[3..]));
        let emitter = if *read.record == DIRECTIONAL {
            let Some(toward) = normalise(transform.transform_vector3(vector)) else {
                self.reader.report.error(|| {
                    let span = read.spans[0].to(read.spans[2]);
                    let message = "directional direction: must not be zero";
                    Diagnostic::error(span, message, "the direction towards the light")
                });
                self.lights.push(Light::point(DVec3::ZERO, Rgb::ZERO));
                return;
            };
            Emitter::Distant(toward)
        } else {
            Emitter::Point {
                position: transform.transform_point3(vector),
                radius: 0.0,
                falloff: Falloff {
                    radial: self.state.attenuation,
                    spot: None,
                },
            }
        };
        self.lights.push(Light {
            emitter,
            colour,
            scale: PI,
            shadows: Shadows::Cast,
        });
    }

    /// Reads a sphere or an area light, whose place is noted.
    pub(super) fn object(&mut self, read: &Reading<'_>) {
        // What is open was noted before it.
        self.close_mesh_before_last();
        let own = self.reader.places.objects().len() - 1;
        let (transform, numbers) = (self.state.transform, read.numbers());
        let (shape, material) = if *read.record == QUAD_LIGHT {
            let shape = numbers.and_then(|numbers| self.parallelogram(read, numbers));
            let colour = numbers.map_or(Rgb::ZERO, |numbers| Rgb::from_slice(&numbers[9..]));
            if shape.is_some() {
                self.area_lights.push((self.objects.len(), colour));
            }
            (shape, 0)
        } else {
            let material = self.material();
            let places = &mut self.reader.places;
            places.refer(Category::Object, own, Node::Material(material));
            (
                numbers.and_then(|numbers| self.sphere(read, numbers)),
                material,
            )
        };
        let centre = shape.as_ref().map(|shape| shape.bounds().centre());
        let centre = centre.unwrap_or_default();
        self.draw(own, Placed { transform, centre }, (shape, material));
    }

    /// Notes where an object is, and draws it if it has a shape.
    fn draw(&mut self, own: usize, place: Placed, (shape, material): (Option<Shape>, usize)) {
        self.reader.places.own.objects.push(place);
        if let Some(shape) = shape {
            self.reader.places.drawn.push(own);
            let material = material as u32;
            self.objects.push(Object { shape, material });
        }
    }

    /// Gives the area lights their materials, behind those that the text states.
    pub(super) fn light_up(&mut self) {
        for &(object, colour) in &self.area_lights {
            self.objects[object].material = self.materials.all.len() as u32;
            self.materials.all.push(Material {
                lit: Faces::Front,
                ..Material::unlit(colour)
            });
        }
    }

    fn sphere(&mut self, read: &Reading<'_>, numbers: &[f64]) -> Option<Shape> {
        let (centre, radius) = (DVec3::from_slice(numbers), numbers[3]);
        let transform = self.state.transform;
        let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
        let origin = transform.transform_point3(centre);
        let scaled = scaling(columns).map(|factor| factor * radius);
        if let Some(radius) = scaled.filter(|radius| Range::Size.contains(*radius)) {
            return Some(Shape::Solid(Solid::Sphere(Sphere {
                centre: origin,
                radius,
            })));
        }
        let columns = columns.map(|column| radius * column);
        let are_sizes = columns.map(|column| Range::Size.contains(column.length())) == [true; 3];
        let affine = Affine::of_matrix(columns, origin).filter(|_| are_sizes);
        if affine.is_none() {
            self.flat(read.spans[0].to(read.spans[3]), "sphere");
        }
        Some(Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(affine?)))))
    }

    fn flat(&mut self, span: Span, name: &str) {
        self.reader.report.error(|| {
            let message =
                format!("{name}: its transforms flatten it or are too large or too small");
            Diagnostic::error(span, message, "invertible transforms")
        });
    }

    /// Two triangles in world space, whose front is the side that shines.
    fn parallelogram(&mut self, read: &Reading<'_>, numbers: &[f64]) -> Option<Shape> {
        let transform = self.state.transform;
        let [corner, first, second] = [0, 3, 6].map(|at| DVec3::from_slice(&numbers[at..]));
        let corner = transform.transform_point3(corner);
        let [first, second] = [first, second].map(|edge| transform.transform_vector3(edge));
        let normal = second.cross(first);
        if normalise(normal).is_none() || !normal.is_finite() {
            self.reader.report.error(|| {
                let span = read.spans[3].to(read.spans[8]);
                let message = "quadLight: its edges are parallel or zero";
                Diagnostic::error(span, message, "two edges in different directions")
            });
            return None;
        }
        let parts = MeshParts {
            positions: vec![
                corner,
                corner + second,
                corner + first + second,
                corner + first,
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..MeshParts::default()
        };
        self.mesh(parts, DAffine3::IDENTITY, read.spans[0])
    }

    fn mesh(&mut self, parts: MeshParts, transform: DAffine3, head: Span) -> Option<Shape> {
        let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
        let affine = Affine::of_matrix(columns, transform.translation);
        let mesh = Mesh::new(parts).ok().zip(affine);
        let shape = mesh.map(|(mesh, affine)| {
            Shape::Mesh(Box::new(Instance::new(Arc::new(mesh), &affine, Vec::new())))
        });
        let shape = shape.filter(|shape| shape.bounds().is_bounded());
        if shape.is_none() {
            self.flat(head, "mesh");
        }
        shape
    }

    /// Reads a vertex, a declared number of vertices, or a triangle.
    pub(super) fn piles(&mut self, at: usize, head: Span, read: &Reading<'_>) {
        let record = read.record;
        // A faulty vertex still has its number.
        let is_vertex = *record == VERTEX || *record == VERTEX_NORMAL;
        let known = read.numbers().map(Cow::Borrowed);
        let Some(numbers) = known.or_else(|| is_vertex.then(|| read.numbers_or_zeros())) else {
            return;
        };
        let text = self.reader.text;
        let counts = [MAXVERTS, MAXVERTNORMS, TRI, TRI_NORMAL];
        let mut words = read.spans.iter().filter(|_| counts.contains(record));
        let is_count = |span: &&Span| {
            let word = span.of(text);
            is_integer(word) && !word.starts_with('-')
        };
        if let Some(bad) = words.find(|span| !is_count(span)) {
            self.reader.report.error(|| {
                let expected = "a whole number, 0 or more";
                let word = quoted(bad.of(text));
                let message = format!("{}: must be {expected}, not {word}", record.name);
                Diagnostic::error(*bad, message, expected)
            });
            return;
        }
        let pile = if [MAXVERTS, VERTEX, TRI].contains(record) {
            &mut self.meshes.plain
        } else {
            &mut self.meshes.with_normals
        };
        if *record == MAXVERTS || *record == MAXVERTNORMS {
            pile.most = Some((numbers[0], read.spans[0]));
        } else if is_vertex {
            pile.vertices.push(DVec3::from_slice(&numbers));
            if *record == VERTEX_NORMAL {
                self.meshes.normals.push(DVec3::from_slice(&numbers[3..]));
            }
        } else if *record == TRI || *record == TRI_NORMAL {
            let count = pile.vertices.len();
            let noun = if *record == TRI {
                "vertex"
            } else {
                "vertexnormal"
            };
            let mut is_known = true;
            for (&index, span) in numbers.iter().zip(&read.spans) {
                if index < count as f64 {
                    continue;
                }
                is_known = false;
                self.reader.report.error(|| {
                    let message = format!("{}: {noun} {index} is not defined above", record.name);
                    let expected = format!("the number of a {noun} above, from 0");
                    let hint = match count {
                        0 => format!("no {noun} is given yet: it must come first"),
                        1 => "given so far: 0".to_owned(),
                        _ => format!("given so far: 0 to {}", count - 1),
                    };
                    Diagnostic::error(*span, message, expected).with_hint(hint)
                });
            }
            if !is_known {
                return;
            }
            let corners = [0, 1, 2].map(|corner| numbers[corner] as u32);
            self.triangle((at, head), record, corners);
        }
    }

    fn triangle(
        &mut self,
        (at, head): (usize, Span),
        record: &'static Record,
        mut corners: [u32; 3],
    ) {
        let has_normals = *record == TRI_NORMAL;
        let pile = if has_normals {
            &self.meshes.with_normals
        } else {
            &self.meshes.plain
        };
        let [a, b, c] = corners.map(|corner| pile.vertices[corner as usize]);
        let across = (b - a).cross(c - a);
        if normalise(across).is_none() {
            self.meshes.degenerate.get_or_insert((head, 0)).1 += 1;
            return;
        }
        if has_normals {
            let sum: DVec3 = corners
                .iter()
                .map(|&corner| self.meshes.normals[corner as usize])
                .sum();
            if sum.dot(across) < 0.0 {
                corners.swap(1, 2);
            }
        }
        let (material, transform) = (self.material(), self.state.transform);
        let joins = |mesh: &OpenMesh| mesh.material == material && mesh.transform == transform;
        if !self.meshes.open.as_ref().is_some_and(joins) {
            self.close_mesh();
            let place = Place {
                record,
                at,
                end: at,
                id: 0,
                refers: [Some(Node::Material(material)), None],
            };
            self.reader.places.push(Category::Object, place);
            self.meshes.open = Some(OpenMesh {
                last: at,
                head,
                material,
                transform,
                parts: MeshParts::default(),
                used: HashMap::new(),
            });
        }
        let meshes = &mut self.meshes;
        let Some(mesh) = &mut meshes.open else {
            return;
        };
        mesh.last = at;
        let pile = if has_normals {
            &meshes.with_normals
        } else {
            &meshes.plain
        };
        let parts = &mut mesh.parts;
        let triangle = corners.map(|corner| {
            *mesh.used.entry((has_normals, corner)).or_insert_with(|| {
                parts.positions.push(pile.vertices[corner as usize]);
                let normal = meshes.normals.get(corner as usize).filter(|_| has_normals);
                parts
                    .normals
                    .values
                    .push(normal.copied().unwrap_or(DVec3::Z));
                parts.positions.len() as u32 - 1
            })
        });
        parts.triangles.push(triangle);
        parts
            .normals
            .corners
            .push(if has_normals { triangle } else { [ABSENT; 3] });
    }

    /// Ends the open mesh, whose place was noted when it began.
    pub(super) fn close_mesh(&mut self) {
        self.close_mesh_at(0);
    }

    /// As [`Lowering::close_mesh`], where another object was noted behind it.
    fn close_mesh_before_last(&mut self) {
        self.close_mesh_at(1);
    }

    fn close_mesh_at(&mut self, behind: usize) {
        let Some(mut mesh) = self.meshes.open.take() else {
            return;
        };
        if mesh
            .parts
            .normals
            .corners
            .iter()
            .all(|corner| *corner == [ABSENT; 3])
        {
            mesh.parts.normals = Attribute::default();
        }
        let own = self.reader.places.objects().len() - 1 - behind;
        // The centre of the box around it before its transforms stays where it is in any turn.
        let corners = || mesh.parts.positions.iter().copied();
        let least = corners().reduce(DVec3::min).unwrap_or_default();
        let most = corners().reduce(DVec3::max).unwrap_or_default();
        let (transform, centre) = (mesh.transform, least.midpoint(most));
        let place = Placed {
            transform,
            centre: transform.transform_point3(centre),
        };
        let shape = self.mesh(mesh.parts, transform, mesh.head);
        self.reader.places.end(Category::Object, own, mesh.last);
        self.draw(own, place, (shape, mesh.material));
    }

    /// Reports the vertices beyond their declared number, and the triangles without area.
    pub(super) fn report_piles(&mut self) {
        let piles = [&self.meshes.plain, &self.meshes.with_normals];
        let counts = piles.map(|pile| (pile.vertices.len(), pile.most));
        for ((count, most), name) in counts.into_iter().zip(["maxverts", "maxvertnorms"]) {
            if let Some((most, span)) = most.filter(|(most, _)| *most < count as f64) {
                self.reader.report.warning(|| {
                    let message = format!("{name}: declares {most}, but there are {count}");
                    Diagnostic::warning(span, message, "as many as there are, or more")
                        .with_fix(span, count.to_string())
                });
            }
        }
        if let Some((head, count)) = self.meshes.degenerate {
            self.reader.report.warning(|| {
                let message = format!("{} without area", counted(count, "triangle"));
                let verb = if count == 1 { "it is" } else { "they are" };
                Diagnostic::warning(head, message, "three corners that are not on one line")
                    .with_hint(format!("{verb} left out"))
            });
        }
    }
}
