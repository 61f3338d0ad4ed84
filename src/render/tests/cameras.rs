//! Camera rays against the formulas of an image plane: `resolution` units per pixel, at the focal
//! length in front of the eye.

use super::*;
use crate::world::Projection;

/// The lens of a camera whose image plane has this height at this distance.
fn lens(is_perspective: bool, height: f64, focal: f64) -> Lens {
    if is_perspective {
        Lens::Perspective(2.0 * (0.5 * height / focal).atan().to_degrees())
    } else {
        Lens::Orthographic(height)
    }
}

#[test]
fn pixels_lie_on_the_image_plane() {
    for index in 0..4_000 {
        let mut random = Numbers::new(index);
        let [eye, target] = [(); 2].map(|()| 5.0 * random.in_cube());
        let up = 3.0 * random.direction();
        let focal = 10_f64.powf(random.between(-2.0, 2.0));
        let [across, upward] = [(); 2].map(|()| focal * 10_f64.powf(random.between(-4.0, -1.0)));
        let [width, height] = [(); 2].map(|()| 1 + random.below(200) as u32);
        let depths @ [near, far] = [random.between(0.0, 2.0), random.between(2.0, 9.0)];
        let is_perspective = index % 2 == 0;
        let camera = Camera {
            eye,
            target,
            up,
            lens: lens(is_perspective, upward * f64::from(height), focal),
            pixel_aspect: across / upward,
            depths,
            focus: Focus::PINHOLE,
            size: Size { width, height },
        };
        let projection = Projection::new(&camera, camera.size);
        let [width, height] = [width, height].map(f64::from);
        let i = random.below(width as usize) as f64 + 0.5;
        let j = random.below(height as usize) as f64 + 0.5;

        let n = (target - eye).normalize();
        let r = n.cross(up).normalize();
        let v = r.cross(n);
        let aside = (i - 0.5 * width) * across * r + (0.5 * height - j) * upward * v;
        let (start, direction) = if is_perspective {
            (eye, (focal * n + aside).normalize())
        } else {
            (eye + aside, n)
        };
        let (ray, reach) = projection.ray(i, j, || None);
        let first = start + near / direction.dot(n) * direction;
        let scale = 1.0 + first.length();
        assert!((ray.direction - direction).length() < 1e-13, "{camera:?}");
        assert!((ray.origin - first).length() < 1e-12 * scale, "{camera:?}");
        let depth = (ray.at(reach) - eye).dot(n);
        assert!((depth - far).abs() < 1e-12 * (scale + reach), "{camera:?}");
    }
}

/// Another size keeps the vertical extent of the image plane and the shape of the pixels.
#[test]
fn another_size_keeps_the_height_of_the_image_plane() {
    let mut camera = scene(&[], &[]).camera;
    // A plane 2 away and 0.6 high, with pixels twice as wide as high.
    camera.lens = lens(true, 0.6, 2.0);
    camera.pixel_aspect = 2.0;
    camera.size = Size {
        width: 30,
        height: 120,
    };
    let projection = Projection::new(&camera, camera.size);
    let expected = DVec3::new(15.0 * 0.01, 0.3, -2.0).normalize();
    let found = projection.ray(30.0, 0.0, || None).0.direction;
    assert!((found - expected).length() < 1e-15, "{found} {expected}");
}

/// Panes across the view at depths 1, 2, 3 with levels .1, .2, .3, seen from the origin along −z.
fn panes() -> Scene {
    let pane = |depth: f64| {
        (
            cuboid([-9.0, -9.0, -depth], [18.0, 18.0, 0.01]),
            grey(0.1 * depth),
        )
    };
    let mut scene = scene(&[pane(1.0), pane(2.0), pane(3.0)], &[]);
    scene.camera.eye = DVec3::ZERO;
    scene.camera.target = DVec3::NEG_Z;
    scene
}

#[test]
fn surfaces_beyond_the_depth_limits_are_invisible() {
    for (depths, expected) in [
        ([0.0, 9.0], 0.1),
        ([0.5, 9.0], 0.1),
        // Clipping reveals what is behind, or the back face when inside a pane.
        ([1.5, 9.0], 0.2),
        ([0.995, 9.0], 0.1),
        ([2.5, 9.0], 0.3),
        ([2.5, 2.9], 0.0),
        ([0.0, 0.5], 0.0),
        ([3.5, f64::INFINITY], 0.0),
    ] {
        for lens in [Lens::Perspective(60.0), Lens::Orthographic(2.0)] {
            let mut scene = panes();
            scene.camera.depths = depths;
            scene.camera.lens = lens;
            let projection = Projection::new(&scene.camera, scene.camera.size);
            let world = world(scene);
            // Corners are like the middle: depths are measured along the view.
            for (x, y) in [(20.0, 15.0), (0.5, 0.5), (39.5, 0.5)] {
                let (ray, reach) = projection.ray(x, y, || None);
                let seen = tracer(&world, 8).radiance(&centred(ray, reach));
                assert_near(seen.radiance.x, expected, 1e-15);
            }
        }
    }
}

/// Secondary rays are not clipped: a mirror shows objects in front of the near limit, and clipped
/// objects cast shadows.
#[test]
fn only_camera_rays_are_clipped() {
    let mirror = Coefficients {
        reflection: 1.0,
        ..BLACK
    };
    let floor = Coefficients {
        diffuse: Rgb::ONE,
        ..BLACK
    };
    let behind_the_eye = (cuboid([-9.0, -9.0, 1.0], [18.0, 18.0, 1.0]), grey(0.7));
    let far_mirror = (cuboid([-9.0, -9.0, -4.0], [18.0, 18.0, 1.0]), mirror);
    let mut reflecting = scene(&[behind_the_eye, far_mirror], &[]);
    reflecting.camera.eye = DVec3::ZERO;
    reflecting.camera.target = DVec3::NEG_Z;
    reflecting.camera.depths = [2.0, 4.0];
    let wall = (cuboid([-9.0, -9.0, -4.0], [18.0, 18.0, 1.0]), floor);
    let pane = (cuboid([-1.0, -1.0, -1.0], [2.0, 2.0, 0.1]), BLACK);
    let mut shaded = scene(&[wall, pane], &[white_light([0.0; 3])]);
    shaded.camera = reflecting.camera;
    for (scene, expected) in [(reflecting, 0.7), (shaded, 0.0)] {
        let projection = Projection::new(&scene.camera, scene.camera.size);
        let (ray, reach) = projection.ray(20.0, 15.0, || None);
        let world = world(scene);
        let seen = tracer(&world, 8).radiance(&centred(ray, reach));
        assert_near(seen.radiance.x, expected, 1e-12);
        assert_ne!(seen.object, NO_OBJECT);
    }
}
