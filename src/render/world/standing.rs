//! Places on which things can stand: the tops of objects.

use glam::DVec3;

use super::picking::distance_to_surface;
use geometry::Shape;
use scene::Object;

/// How often the search for the top halves its steps, which begin at half the object's width.
const HALVINGS: usize = 24;
/// Most steps of one length.
const MOST_STEPS: usize = 64;

/// The height of an object's top above a point, along the unit vector `up`, looked at from above all of
/// it; `None` if nothing of it is above or below the point.
pub fn top_at(object: &Object, place: DVec3, up: DVec3) -> Option<f64> {
    let bounds = object.shape.bounds();
    if !bounds.is_bounded() {
        return None;
    }
    let above = bounds.half_diagonal() * 2.0 + (bounds.centre() - place).dot(up);
    let origin = place + above * up;
    distance_to_surface([object].into_iter(), [origin, -up], f64::INFINITY)
        .map(|distance| above - distance)
}

/// The highest point of an object along the unit vector `up`: of a level top its middle, otherwise the
/// one that is found uphill from a point of its surface. `None` if that leads nowhere.
pub fn summit(object: &Object, from: DVec3, up: DVec3) -> Option<DVec3> {
    if let Shape::Mesh(instance) = &object.shape {
        let corners = instance
            .placed_triangles()
            .flat_map(|triangle| triangle.corners);
        return corners.max_by(|a, b| a.dot(up).total_cmp(&b.dot(up)));
    }
    let bounds = object.shape.bounds();
    let height = |place: DVec3| top_at(object, place, up).map(|top| place + top * up);
    let middle = height(bounds.centre());
    let mut step = bounds.half_diagonal();
    let tolerance = 1e-9 * step;
    // A place on the edge may be missed by the ray.
    let inwards = from + 1e-6 * (bounds.centre() - from);
    let mut best = height(from).or_else(|| height(inwards)).or(middle)?;
    let across = [
        up.any_orthonormal_vector(),
        up.cross(up.any_orthonormal_vector()),
    ];
    for _ in 0..HALVINGS {
        step *= 0.5;
        for _ in 0..MOST_STEPS {
            let around = across
                .into_iter()
                .flat_map(|axis| [step * axis, -step * axis]);
            let found = around.filter_map(|offset| height(best + offset));
            let higher = found.max_by(|a, b| a.dot(up).total_cmp(&b.dot(up)));
            match higher.filter(|higher| best.dot(up) + tolerance < higher.dot(up)) {
                Some(higher) => best = higher,
                None => break,
            }
        }
    }
    let is_level = |middle: &DVec3| best.dot(up) <= middle.dot(up) + 1e3 * tolerance;
    Some(middle.filter(is_level).unwrap_or(best))
}

/// Whether a point is within the box around an object.
pub fn surrounds(object: &Object, point: DVec3) -> bool {
    let bounds = object.shape.bounds();
    bounds.min.cmple(point).all() && point.cmple(bounds.max).all()
}
