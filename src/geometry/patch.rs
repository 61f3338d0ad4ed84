//! Parts of surfaces, in the form that sampling points on them needs.

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, Vector, WIDTH};
use super::mesh::gathered;
use super::{Aabb, Affine, Instance, Shape, Solid};

/// A part of a shape's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Patch {
    /// A triangle, which is half of the parallelogram.
    Triangle(Flat),
    /// A parallelogram.
    Parallelogram(Flat),
    /// An ellipsoid.
    Ball(Ball),
}

/// A parallelogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// A corner.
    pub corner: DVec3,
    /// The sides that start there.
    pub sides: [DVec3; 2],
    /// The outward geometric normal, as long as its area.
    pub normal: DVec3,
}

/// Parallelograms, in each lane: see [`Flat`].
#[derive(Clone, Copy, Debug)]
pub struct Parallelograms<N> {
    /// A corner.
    pub corner: Vector<N>,
    /// The sides that start there.
    pub sides: [Vector<N>; 2],
    /// The outward geometric normal, as long as its area.
    pub normal: Vector<N>,
}

/// An affine image of the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The centre.
    pub centre: DVec3,
    /// The columns of the unit-to-world matrix.
    pub axes: [DVec3; 3],
    /// The rows of the world-to-unit matrix.
    pub duals: [DVec3; 3],
}

impl Shape {
    /// The number of parts that [`Shape::patch`] describes; 0 for shapes without such a form.
    pub fn patches(&self) -> u32 {
        match self {
            Self::Solid(Solid::Sphere(_) | Solid::Ellipsoid(_)) | Self::Plane(_) => 1,
            Self::Mesh(instance) => instance.mesh().len() as u32,
            Self::Solid(_) | Self::Csg(_) => 0,
        }
    }

    /// A part of the surface, by its number in [`Hit::part`](super::Hit::part).
    pub fn patch(&self, part: u32) -> Option<Patch> {
        match self {
            Self::Solid(Solid::Sphere(sphere)) => {
                let unit = [DVec3::X, DVec3::Y, DVec3::Z];
                Some(Patch::Ball(Ball {
                    centre: sphere.centre,
                    axes: unit.map(|axis| sphere.radius * axis),
                    duals: unit.map(|axis| axis / sphere.radius),
                }))
            }
            Self::Solid(Solid::Ellipsoid(ellipsoid)) => Some(Patch::Ball(Ball {
                centre: ellipsoid.0.origin(),
                axes: ellipsoid.0.axes(),
                duals: ellipsoid.0.duals(),
            })),
            Self::Plane(plane) => {
                let [x, y, _] = plane.0.axes();
                let corner = plane.0.origin() - x - y;
                let sides = [2.0 * x, 2.0 * y].map(Vector::from);
                let square = Parallelograms::new(corner.into(), sides, &plane.0);
                Some(Patch::Parallelogram(square.into()))
            }
            Self::Mesh(instance) => {
                let corners = instance.mesh().vertices(part).map(Vector::from);
                Some(Patch::Triangle(instance.placed(corners).into()))
            }
            Self::Solid(_) | Self::Csg(_) => None,
        }
    }
}

impl Instance {
    /// The triangles with these numbers in lanes, at least one, as halves of parallelograms.
    #[inline(always)]
    pub fn triangles<S: Simd>(
        &self,
        simd: S,
        triangles: &[u32; WIDTH],
        lanes: u32,
    ) -> Parallelograms<Eight<S>> {
        let vertices = |lane: usize| self.mesh().vertices(triangles[lane]);
        self.placed(gathered(simd, lanes, vertices))
    }

    /// Triangles with vertices in unit space.
    #[inline(always)]
    fn placed<N: Lanes>(&self, [a, b, c]: [Vector<N>; 3]) -> Parallelograms<N> {
        let place = |vector: DVec3| Vector::all(a.x, vector);
        let axes = self.frame().axes().map(place);
        let corner = place(self.frame().origin()) + a.combine(axes);
        let sides = [(b - a).combine(axes), (c - a).combine(axes)];
        Parallelograms::new(corner, sides, self.frame())
    }
}

impl Patch {
    /// The area; for a ball that of its largest cross section, roughly, which is what it shows of
    /// itself from any direction.
    pub fn area(&self) -> f64 {
        match self {
            Self::Triangle(flat) => 0.5 * flat.area(),
            Self::Parallelogram(flat) => flat.area(),
            Self::Ball(ball) => {
                let [x, y, z] = ball.axes;
                let sections = [x.cross(y), y.cross(z), z.cross(x)].map(DVec3::length);
                std::f64::consts::PI * sections.into_iter().fold(0.0, f64::max)
            }
        }
    }

    /// The tight axis-aligned box.
    pub fn bounds(&self) -> Aabb {
        let of = |corners: &[DVec3]| {
            corners
                .iter()
                .map(|&corner| Aabb {
                    min: corner,
                    max: corner,
                })
                .fold(Aabb::EMPTY, Aabb::union)
        };
        match self {
            Self::Triangle(Flat {
                corner,
                sides: [x, y],
                ..
            }) => of(&[*corner, *corner + *x, *corner + *y]),
            Self::Parallelogram(Flat {
                corner,
                sides: [x, y],
                ..
            }) => of(&[*corner, *corner + *x, *corner + *y, *corner + *x + *y]),
            Self::Ball(Ball {
                centre,
                axes: [x, y, z],
                ..
            }) => {
                let half = (*x * *x + *y * *y + *z * *z).map(f64::sqrt);
                Aabb {
                    min: *centre - half,
                    max: *centre + half,
                }
            }
        }
    }
}

impl<N: Lanes> Parallelograms<N> {
    /// Sides that turn counter-clockwise around the outward normal in the space that a frame maps to the
    /// world, which may mirror it.
    #[inline(always)]
    fn new(corner: Vector<N>, sides: [Vector<N>; 2], frame: &Affine) -> Self {
        let [x, y, z] = frame.axes();
        let across = sides[0].cross(sides[1]);
        let is_mirrored = x.cross(y).dot(z) < 0.0;
        Self {
            corner,
            sides,
            normal: if is_mirrored { -across } else { across },
        }
    }
}

impl From<Parallelograms<f64>> for Flat {
    fn from(all: Parallelograms<f64>) -> Self {
        Self {
            corner: all.corner.into(),
            sides: all.sides.map(DVec3::from),
            normal: all.normal.into(),
        }
    }
}

impl From<&Flat> for Parallelograms<f64> {
    fn from(flat: &Flat) -> Self {
        Self {
            corner: flat.corner.into(),
            sides: flat.sides.map(Vector::from),
            normal: flat.normal.into(),
        }
    }
}

impl Flat {
    /// The area of the parallelogram.
    pub fn area(&self) -> f64 {
        self.normal.length()
    }
}

impl Ball {
    /// Maps a vector of the unit sphere's space to the world.
    pub fn to_world(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        v.x * x + v.y * y + v.z * z
    }

    /// Maps a vector of the world to the unit sphere's space.
    pub fn to_unit(&self, v: DVec3) -> DVec3 {
        DVec3::from_array(self.duals.map(|dual| dual.dot(v)))
    }

    /// The factor on volumes of the unit sphere's space.
    pub fn volume(&self) -> f64 {
        let [x, y, z] = self.axes;
        x.dot(y.cross(z)).abs()
    }
}
