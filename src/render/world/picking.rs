//! Places in a picture and in space: what point a pixel shows, and where a point is in the picture.

use glam::DVec3;

use super::projection::Projection;
use geometry::Ray;
use scene::{Camera, Object, Size};

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where it is.
    pub point: DVec3,
    /// The unit normal that faces the camera.
    pub normal: DVec3,
}

/// The point of an object that the centre of a pixel shows, in a picture of this size; `None` if
/// the ray misses it.
pub fn surface_under(
    object: &Object,
    camera: &Camera,
    raster: Size,
    [x, y]: [u32; 2],
) -> Option<SurfacePoint> {
    let projection = Projection::new(camera, raster);
    let (ray, reach) = projection.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, || None);
    let hit = object.shape.hit(&ray, reach)?;
    let surface = object.shape.surface(&ray, hit);
    let towards = if surface.normal.dot(ray.direction) < 0.0 {
        surface.normal
    } else {
        -surface.normal
    };
    Some(SurfacePoint {
        point: surface.point,
        normal: towards,
    })
}

/// The distance from a point along a unit vector to the nearest of these objects' surfaces, if that is
/// less than `limit`.
pub fn distance_to_surface<'o>(
    objects: impl Iterator<Item = &'o Object>,
    [origin, direction]: [DVec3; 2],
    limit: f64,
) -> Option<f64> {
    let ray = Ray { origin, direction };
    let hits = objects.filter_map(|object| Some(object.shape.hit(&ray, limit)?.t));
    hits.min_by(f64::total_cmp)
}

/// Where a point is in a picture of this size, in pixels from its top left corner; `None` behind the
/// eye.
pub fn project_point(point: DVec3, camera: &Camera, raster: Size) -> Option<[f64; 2]> {
    Projection::new(camera, raster).pixel(point)
}

/// The part of a line that is inside a picture of this size, as its ends in pixels from the top left
/// corner; `None` if none is.
pub fn project_line(ends: [DVec3; 2], camera: &Camera, raster: Size) -> Option<[[f64; 2]; 2]> {
    Projection::new(camera, raster).line(ends)
}

/// The width of a pixel at the distance of a point, in world units.
pub fn pixel_width(point: DVec3, camera: &Camera, raster: Size) -> f64 {
    Projection::new(camera, raster).pixel_width(point)
}

/// The directions to the right, up and into the picture, as unit vectors.
pub fn camera_axes(camera: &Camera) -> [DVec3; 3] {
    let size = Size {
        width: 1,
        height: 1,
    };
    Projection::new(camera, size).axes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::{Shape, Solid, Sphere};
    use scene::{Focus, Lens};

    fn camera(lens: Lens) -> Camera {
        Camera {
            eye: DVec3::new(0.0, 0.0, 10.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            lens,
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: Size {
                width: 200,
                height: 100,
            },
        }
    }

    #[test]
    fn points_and_pixels_belong_together() {
        let raster = Size {
            width: 20,
            height: 10,
        };
        let object = Object {
            shape: Shape::Solid(Solid::Sphere(Sphere {
                centre: DVec3::ZERO,
                radius: 4.0,
            })),
            material: 0,
        };
        for (height, limit, expected) in
            [(6.0, 5.0, Some(2.0)), (6.0, 2.0, None), (-6.0, 9.0, None)]
        {
            let from = [DVec3::new(0.0, height, 0.0), DVec3::NEG_Y];
            assert_eq!(
                distance_to_surface([&object].into_iter(), from, limit),
                expected
            );
        }
        for lens in [Lens::Perspective(60.0), Lens::Orthographic(10.0)] {
            let camera = camera(lens);
            for pixel in [[10, 5], [8, 3], [12, 6]] {
                let surface = surface_under(&object, &camera, raster, pixel).expect("it is hit");
                assert!((surface.point.length() - 4.0).abs() < 1e-12);
                assert!((surface.normal - surface.point / 4.0).length() < 1e-12);
                let [x, y] = project_point(surface.point, &camera, raster).expect("it is in front");
                let centre = pixel.map(|at| f64::from(at) + 0.5);
                assert!(
                    (x - centre[0]).abs() < 1e-9 && (y - centre[1]).abs() < 1e-9,
                    "{x} {y}"
                );
            }
            assert_eq!(surface_under(&object, &camera, raster, [0, 0]), None);
        }
        let orthographic = camera(Lens::Orthographic(10.0));
        assert_eq!(pixel_width(DVec3::ZERO, &orthographic, raster), 1.0);
        let perspective = camera(Lens::Perspective(90.0));
        let width = pixel_width(DVec3::ZERO, &perspective, raster);
        assert!((width - 2.0).abs() < 1e-12, "{width}");
        assert_eq!(
            project_point(DVec3::new(0.0, 0.0, 11.0), &perspective, raster),
            None
        );
        assert_eq!(
            camera_axes(&perspective),
            [DVec3::X, DVec3::Y, DVec3::NEG_Z]
        );
    }
}
