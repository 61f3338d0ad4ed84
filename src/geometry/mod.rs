//! Rays against shapes, in `f64`, one shape a file. Knows no lights, materials or text.
//!
//! Formulas of the simple solids are written once, for one ray and for eight side by side ([`lanes`]).
//!
//! Hits come in two steps: [`Shape::hit`] gives a distance for every candidate, and
//! [`Shape::surface`] the point and normal once, for the winner. [`Shape::spans`] gives all of a
//! line that is inside, which is more than one span if the solid is not convex; squares and meshes
//! are surfaces without an inside. There is no epsilon: the point is re-projected onto its surface,
//! and a ray that leaves it starts [`Surface::leave`], a few units in the last place off the
//! surface.

mod aabb;
mod chart;
mod cone;
mod csg;
mod cuboid;
mod cylinder;
mod double_double;
mod ellipsoid;
pub mod lanes;
mod line;
mod mesh;
mod plane;
mod quadric;
mod ray;
mod shape;
mod sphere;
mod surface;
mod transform;
mod triangle;

#[cfg(test)]
mod tests;

pub use aabb::Aabb;
pub use chart::Chart;
pub use cone::Cone;
pub use csg::{Csg, Node, Operation};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use ellipsoid::Ellipsoid;
pub use mesh::{
    ABSENT, Attribute, Instance, Mesh, MeshError, MeshLine, MeshLines, MeshParts, SlotRun,
};
pub use plane::Plane;
pub use quadric::Quadric;
pub use ray::{Packet, Packets, Ray, Rays};
pub use shape::{Crossings, Hit, Hits, Shape, Spans};
pub use sphere::{Sphere, sphere_hits, sphere_surfaces};
pub use surface::{Surface, Surfaces, ulp};
pub use transform::{Affine, FLATTEST, normalise};
