//! Ray–shape intersection in `f64`, one shape per file. Independent of lights, materials and text.
//!
//! Formulas of the simple solids are written once, for single rays and packets of eight
//! ([`lanes`]).
//!
//! A hit is found in two steps: [`Shape::hit`] returns a distance for every candidate, and
//! [`Shape::surface`] the point and normal, for the nearest hit only. [`Shape::spans`] returns the
//! parts of a line inside a solid, more than one if the solid is not convex; squares and meshes are
//! surfaces without an inside. [`Shape::outline`] returns lines along the surface, for wireframes, and
//! [`Shape::patch`] parts of it from which points are chosen. There is no epsilon: the point is
//! re-projected onto its surface, and [`Surface::leave`] starts a secondary ray a few ulps off the
//! surface.

mod aabb;
mod cancelled;
mod chart;
mod cone;
mod csg;
mod cuboid;
mod cylinder;
mod double_double;
mod ellipsoid;
mod frame_numbers;
mod hit;
pub mod lanes;
mod line;
mod mesh;
mod outline;
mod patch;
mod plane;
mod quadric;
mod ray;
mod shape;
mod side;
mod smooth;
mod solid;
mod sphere;
mod surface;
mod transform;
mod triangle;

#[cfg(test)]
mod tests;

pub use aabb::Aabb;
pub use cancelled::IsCancelled;
pub use chart::Chart;
pub use cone::Cone;
pub use csg::{Csg, Node, Operation};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use ellipsoid::Ellipsoid;
pub use frame_numbers::{FrameNumbers, direction_of};
pub use hit::{Crossings, Hit, Hits, Spans};
pub use mesh::{
    ABSENT, Attribute, Instance, Mesh, MeshError, MeshLine, MeshLines, MeshParts, NearestOnLines,
    RoughLine, SlotRun, Triangle, TriangleRun, TriangleRuns,
};
pub use outline::Detail;
pub use patch::{Ball, Flat, Parallelograms, Patch};
pub use plane::Plane;
pub use quadric::{Quadric, principal_axes};
pub use ray::{Packet, Packets, Ray, Rays};
pub use shape::Shape;
pub use side::Side;
pub use solid::Solid;
pub use sphere::{Sphere, may_meet, sphere_hits, sphere_surfaces};
pub use surface::{Shaded, Surface, Surfaces, ulp};
pub use transform::{Affine, FLATTEST, normalise};
