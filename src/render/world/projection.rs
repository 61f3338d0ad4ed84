//! Camera rays.

use glam::DVec3;

use crate::sampling::warp;
use geometry::lanes::{Lanes, Vector};
use geometry::{Ray, Rays, normalise};
use scene::{Camera, Focus, Lens, Size};

/// A camera prepared to generate rays for a raster of pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    bundle: Bundle,
    /// Half extents of the picture: on the plane one unit in front of the eye, or in world units
    /// for parallel rays.
    half_width: f64,
    half_height: f64,
    /// Near and far limits of visible distances along the view.
    depths: [f64; 2],
    focus: Focus,
    raster: Size,
}

/// The geometry of the rays.
#[derive(Clone, Copy, Debug)]
enum Bundle {
    FromTheEye,
    SideBySide,
}

impl Projection {
    /// Prepares a camera for `raster` pixels. The aspect ratio is the camera's own, so that a
    /// preview of only approximately that ratio shows the same framing.
    pub(crate) fn new(camera: &Camera, raster: Size) -> Self {
        let forward = direction(offset(camera.eye, camera.target));
        let right = direction(forward.cross(upright(forward, direction(camera.up))));
        let (bundle, half_height) = match camera.lens {
            Lens::Perspective(angle) => {
                let half_angle = angle * (std::f64::consts::PI / 360.0);
                (Bundle::FromTheEye, libm::tan(half_angle))
            }
            Lens::Orthographic(height) => (Bundle::SideBySide, 0.5 * height),
        };
        let aspect = f64::from(camera.size.width) / f64::from(camera.size.height);
        Self {
            eye: camera.eye,
            forward,
            right,
            up: right.cross(forward),
            bundle,
            half_width: half_height * aspect * camera.pixel_aspect,
            half_height,
            depths: camera.depths,
            focus: camera.focus,
            raster,
        }
    }

    /// Returns the ray through a point of the raster, in pixels from its top left corner, from the
    /// near limit on, and its length. With a lens it passes through the point of the lens that
    /// `lens` gives in the unit square, or through the centre.
    pub(crate) fn ray(
        &self,
        x: f64,
        y: f64,
        lens: impl FnOnce() -> Option<[f64; 2]>,
    ) -> (Ray, f64) {
        let (rays, slant) = self.middles(x, y);
        let mut ray = Ray {
            origin: rays.origin.into(),
            direction: rays.direction.into(),
        };
        if self.has_lens()
            && let Some(place) = lens()
        {
            ray = self.through_lens(&ray, slant, place);
        }
        (ray, self.reach(slant))
    }

    /// Where a point is in the raster, in pixels from its top left corner; `None` behind the eye.
    pub(crate) fn pixel(&self, point: DVec3) -> Option<[f64; 2]> {
        let offset = point - self.eye;
        let depth = self.scale_at(point);
        let across = offset.dot(self.right) / (self.half_width * depth);
        let up = offset.dot(self.up) / (self.half_height * depth);
        let shown = [
            0.5 * (1.0 + across) * f64::from(self.raster.width),
            0.5 * (1.0 - up) * f64::from(self.raster.height),
        ];
        let is_seen = 0.0 < depth && 0.0 < offset.dot(self.forward);
        (is_seen && shown.iter().all(|at| at.is_finite())).then_some(shown)
    }

    /// The width of a pixel at the distance of a point, in world units.
    pub(crate) fn pixel_width(&self, point: DVec3) -> f64 {
        2.0 * self.half_width * self.scale_at(point).abs() / f64::from(self.raster.width)
    }

    /// The part of a line inside the picture and between the depth limits, as its ends in pixels;
    /// `None` if all of it is outside.
    pub(crate) fn line(&self, ends: [DVec3; 2]) -> Option<[[f64; 2]; 2]> {
        let [start, end] = ends;
        let depths = ends.map(|end| (end - self.eye).dot(self.forward));
        let farthest = depths[0].max(depths[1]);
        let near = self.depths[0].max(NEAR * farthest);
        if farthest <= 0.0 {
            return None;
        }
        let mut part = [0.0, 1.0];
        cut(&mut part, near - depths[0], depths[0] - depths[1]);
        cut(&mut part, depths[0] - self.depths[1], depths[1] - depths[0]);
        let [from, to] = part;
        if to < from {
            return None;
        }
        let shown = |share: f64| self.pixel(start + share * (end - start));
        let (a, b) = (shown(from)?, shown(to)?);
        let limits = [self.raster.width, self.raster.height].map(f64::from);
        let mut part = [0.0, 1.0];
        for axis in 0..2 {
            cut(&mut part, -a[axis], a[axis] - b[axis]);
            cut(&mut part, a[axis] - limits[axis], b[axis] - a[axis]);
        }
        let [from, to] = part;
        let at = |share: f64| [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
        (from <= to).then(|| [at(from), at(to)])
    }

    /// About how many pixels a sphere is wide; `None` if it is outside the picture or the depth
    /// limits.
    pub(crate) fn diameter(&self, centre: DVec3, radius: f64) -> Option<f64> {
        let offset = centre - self.eye;
        let depth = offset.dot(self.forward);
        if depth + radius <= self.depths[0] || self.depths[1] <= depth - radius {
            return None;
        }
        let (nearest, scale, slant) = match self.bundle {
            Bundle::FromTheEye => (depth.max(radius), depth, 1.0),
            Bundle::SideBySide => (1.0, 1.0, 0.0),
        };
        for (axis, half) in [(self.right, self.half_width), (self.up, self.half_height)] {
            // The distance from the plane through the eye and the edge of the picture.
            let beyond = offset.dot(axis).abs() - half * scale;
            if radius * libm::sqrt(1.0 + slant * half * half) < beyond {
                return None;
            }
        }
        Some(radius * f64::from(self.raster.width) / (self.half_width * nearest))
    }

    /// The directions to the right, up and into the picture.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        [self.right, self.up, self.forward]
    }

    /// The near and far limits of visible distances along the view.
    pub(crate) fn depths(&self) -> [f64; 2] {
        self.depths
    }

    /// The size of the picture's plane at a point, relative to one unit in front of the eye.
    fn scale_at(&self, point: DVec3) -> f64 {
        match self.bundle {
            Bundle::FromTheEye => (point - self.eye).dot(self.forward),
            Bundle::SideBySide => 1.0,
        }
    }

    /// Returns the rays of a camera without a lens, in each lane.
    #[inline(always)]
    pub(crate) fn rays<N: Lanes>(&self, x: N, y: N) -> (Rays<N>, N) {
        let (rays, slant) = self.middles(x, y);
        (rays, self.reach(slant))
    }

    /// Whether rays depend on the point on the lens.
    pub(crate) fn has_lens(&self) -> bool {
        self.focus.lens_radius != 0.0
    }

    /// Returns the rays through the centre of the lens, and the cosines of their angle to the view.
    #[inline(always)]
    fn middles<N: Lanes>(&self, x: N, y: N) -> (Rays<N>, N) {
        let all = |value: f64| x.all(value);
        let (one, two) = (all(1.0), all(2.0));
        let across = all(self.half_width) * (two * x / all(self.raster.width.into()) - one);
        let upward = all(self.half_height) * (one - two * y / all(self.raster.height.into()));
        let [eye, forward, right, up] =
            [self.eye, self.forward, self.right, self.up].map(|vector| Vector::all(x, vector));
        let aside = right.scaled(across) + up.scaled(upward);
        let mut rays = match self.bundle {
            Bundle::FromTheEye => Rays {
                origin: eye,
                direction: (forward + aside).unit(),
            },
            Bundle::SideBySide => Rays {
                origin: eye + aside,
                direction: forward,
            },
        };
        let near = self.depths[0];
        let slant = rays.direction.dot(forward);
        if 0.0 < near {
            rays.origin = rays.at(all(near) / slant);
        }
        (rays, slant)
    }

    /// Length of rays between near and far limit, given the cosines of their angles to the view.
    #[inline(always)]
    fn reach<N: Lanes>(&self, slant: N) -> N {
        let [near, far] = self.depths;
        slant.all(far - near) / slant
    }

    /// Returns the ray from a point of the lens to where the ray through its centre meets the plane
    /// in focus (Cook and others, "Distributed Ray Tracing", 1984).
    fn through_lens(&self, middle: &Ray, slant: f64, place: [f64; 2]) -> Ray {
        let sharp = middle.at(self.focus.distance / slant);
        let place = self.focus.lens_radius * warp::in_disc(place);
        let origin = middle.origin + place.x * self.right + place.y * self.up;
        Ray {
            origin,
            direction: (sharp - origin).normalize(),
        }
    }
}

/// The part of a line's depth that is too close to the eye to be projected.
const NEAR: f64 = 1e-6;

/// Cuts the part of a line to where `outside + share · change` is at most 0 (Liang and Barsky, "A new
/// concept and method for line clipping", 1984).
fn cut(part: &mut [f64; 2], outside: f64, change: f64) {
    if change < 0.0 {
        part[0] = part[0].max(-outside / change);
    } else if 0.0 < change {
        part[1] = part[1].min(-outside / change);
    } else if 0.0 < outside {
        part[1] = f64::NEG_INFINITY;
    }
}

/// Returns the up direction: the camera's, or if parallel to the view, the world axis most nearly
/// perpendicular to the view (ties: x, then y, then z).
fn upright(forward: DVec3, up: DVec3) -> DVec3 {
    if Camera::LEAST_SINE <= forward.cross(up).length() {
        return up;
    }
    let alignment = forward.abs();
    if alignment.x <= alignment.y && alignment.x <= alignment.z {
        DVec3::X
    } else if alignment.y <= alignment.z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}

/// The vector between two points, halved if it would overflow `f64`.
fn offset(from: DVec3, to: DVec3) -> DVec3 {
    let whole = to - from;
    if whole.is_finite() {
        whole
    } else {
        0.5 * to - 0.5 * from
    }
}

/// The direction of a vector; zero for a zero vector.
fn direction(vector: DVec3) -> DVec3 {
    normalise(vector).unwrap_or(DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Focus;

    fn camera(up: DVec3) -> Camera {
        Camera {
            eye: DVec3::new(0.0, 0.0, 5.0),
            target: DVec3::ZERO,
            up,
            lens: Lens::Perspective(90.0),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: Size {
                width: 4,
                height: 2,
            },
        }
    }

    fn assert_near(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-15, "{a} is not {b}");
    }

    /// At a field of view of 90°, the plane one unit ahead spans −1..1 vertically and −2..2 across.
    #[test]
    fn pixel_centres_follow_the_formula() {
        let projection = Projection::new(
            &camera(DVec3::Y),
            Size {
                width: 4,
                height: 2,
            },
        );
        let through = |x, y, z| DVec3::new(x, y, z).normalize();
        assert_near(
            projection.ray(0.5, 0.5, || None).0.direction,
            through(-1.5, 0.5, -1.0),
        );
        assert_near(
            projection.ray(3.5, 1.5, || None).0.direction,
            through(1.5, -0.5, -1.0),
        );
        assert_near(
            projection.ray(2.0, 1.0, || None).0.direction,
            through(0.0, 0.0, -1.0),
        );
    }

    #[test]
    fn another_raster_keeps_the_framing() {
        let fine = Projection::new(
            &camera(DVec3::Y),
            Size {
                width: 4,
                height: 2,
            },
        );
        let coarse = Projection::new(
            &camera(DVec3::Y),
            Size {
                width: 3,
                height: 1,
            },
        );
        assert_near(
            fine.ray(4.0, 2.0, || None).0.direction,
            coarse.ray(3.0, 1.0, || None).0.direction,
        );
    }

    #[test]
    fn up_parallel_to_the_view_is_replaced_by_the_least_aligned_axis() {
        let projection = Projection::new(
            &camera(DVec3::Z),
            Size {
                width: 4,
                height: 2,
            },
        );
        // n = −z; x and y are equally distant from it, and x comes first.
        assert_near(projection.up, DVec3::X);
    }

    #[test]
    fn every_finite_view_gives_finite_rays() {
        let extremes = [0.0, 5e-324, 1e-300, 1.0, 1e300, 9e307, f64::MAX];
        let values: Vec<f64> = extremes.into_iter().flat_map(|x| [x, -x]).collect();
        let raster = Size {
            width: 3,
            height: 2,
        };
        for (&a, &b) in values
            .iter()
            .flat_map(|a| values.iter().map(move |b| (a, b)))
        {
            for fov in [1e-300, 45.0, 180.0f64.next_down()] {
                let camera = Camera {
                    eye: DVec3::new(a, b, -a),
                    target: DVec3::new(-a, -b, b),
                    up: DVec3::new(b, a, 0.0),
                    lens: Lens::Perspective(fov),
                    pixel_aspect: 1.0,
                    depths: Camera::ALL_DEPTHS,
                    focus: Focus::PINHOLE,
                    size: raster,
                };
                // Scenes with such a view are rejected.
                if camera.eye == camera.target {
                    continue;
                }
                let projection = Projection::new(&camera, raster);
                for (x, y) in [(0.0, 0.0), (1.5, 1.0), (3.0, 2.0)] {
                    let (ray, _) = projection.ray(x, y, || None);
                    assert_eq!(ray.origin, camera.eye);
                    assert!(
                        (ray.direction.length() - 1.0).abs() < 1e-15,
                        "{camera:?}: {ray:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_length_of_up_does_not_matter() {
        for length in [1e-300, 1.0, 1e300] {
            let projection = Projection::new(
                &camera(DVec3::Y * length),
                Size {
                    width: 4,
                    height: 2,
                },
            );
            assert_near(projection.up, DVec3::Y);
        }
    }
}
