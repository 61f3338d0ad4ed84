//! Tests of the shapes against hand-computed values, twice the precision, and properties.

mod charts;
mod csg;
mod csg_faces;
mod exact;
mod known;
mod lanes;
mod leaving;
mod mesh_known;
mod meshes;
mod numbers;
mod planes;
mod properties;
mod quadric_bounds;
mod quadric_parallel;
mod quadrics;
mod random;
mod rows;
mod runs;
mod scale;
mod silhouettes;
mod smooth;

use glam::DVec3;

use super::transform::normalise;
use super::{
    Aabb, Affine, Cone, Crossings, Cuboid, Cylinder, Ellipsoid, Ray, Shape, Solid, Spans, Sphere,
};

/// The simple solids.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Sphere,
    Ellipsoid,
    Cuboid,
    Cylinder,
    Cone,
}

const KINDS: [Kind; 5] = [
    Kind::Sphere,
    Kind::Ellipsoid,
    Kind::Cuboid,
    Kind::Cylinder,
    Kind::Cone,
];

/// A frame as in a scene file. A sphere uses the first length only.
#[derive(Clone, Copy, Debug)]
struct Frame {
    origin: DVec3,
    directions: [DVec3; 3],
    lengths: DVec3,
}

impl Frame {
    fn upright(origin: DVec3, lengths: DVec3) -> Self {
        Self {
            origin,
            directions: DVec3::AXES,
            lengths,
        }
    }

    fn affine(&self) -> Option<Affine> {
        Affine::new(self.origin, self.directions, self.lengths)
    }

    fn shape(&self, kind: Kind) -> Shape {
        Shape::Solid(self.solid(kind))
    }

    fn solid(&self, kind: Kind) -> Solid {
        let affine = || self.affine().expect("the frame spans a volume");
        match kind {
            Kind::Sphere => Solid::Sphere(Sphere {
                centre: self.origin,
                radius: self.lengths.x,
            }),
            Kind::Ellipsoid => Solid::Ellipsoid(Box::new(Ellipsoid(affine()))),
            Kind::Cuboid => Solid::Cuboid(Box::new(Cuboid(affine()))),
            Kind::Cylinder => Solid::Cylinder(Box::new(Cylinder(affine()))),
            Kind::Cone => Solid::Cone(Box::new(Cone(affine()))),
        }
    }

    /// The frame as used by a solid of this kind.
    fn of(self, kind: Kind) -> Self {
        if kind == Kind::Sphere {
            Self::upright(self.origin, DVec3::splat(self.lengths.x))
        } else {
            self
        }
    }

    /// Maps a unit solid's point to the world.
    fn world(&self, position: DVec3) -> DVec3 {
        let mut point = self.origin;
        for axis in 0..3 {
            point += position[axis] * self.lengths[axis] * unit(self.directions[axis]);
        }
        point
    }
}

fn unit(v: DVec3) -> DVec3 {
    normalise(v).expect("the vector has a direction")
}

fn ray(origin: DVec3, toward: DVec3) -> Ray {
    Ray {
        origin,
        direction: unit(toward - origin),
    }
}

/// The only span of a line in a convex solid.
fn only_span(shape: &Shape, ray: &Ray) -> Option<Crossings> {
    let mut spans = Spans::new();
    shape.spans(ray, &mut spans);
    assert!(spans.len() < 2, "{shape:?} is convex");
    spans.pop()
}
