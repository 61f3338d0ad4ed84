//! Nearest hits: ties, trees, contact shadows, the background.

use super::*;

#[test]
fn a_ray_that_hits_nothing_is_black() {
    let (seen, _) = look(
        scene(&[(sphere([0.0; 3], 1.0), grey(1.0))], &[]),
        8,
        ray([0.0, 0.0, 5.0], [0.0, 3.0, 0.0]),
    );
    assert_eq!(
        seen,
        SampleResult {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
            touched: Dependencies::default(),
            rays: 1,
        }
    );
}

/// Two boxes share the plane of their tops, off the axes so that their rounding differs. Every ray
/// onto the shared part sees the first in the file, with and without a tree.
#[test]
fn of_coincident_faces_the_first_in_the_file_is_seen() {
    let turned = |corner: DVec3, size: f64| {
        let along = DVec3::new(0.8, 0.0, -0.6);
        let across = DVec3::new(0.6, 0.0, 0.8);
        let frame = Affine::new(
            corner,
            [along, DVec3::Y, across],
            DVec3::new(size, 0.3 * size, size),
        );
        Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame.expect("orthogonal")))))
    };
    let low = (turned(DVec3::new(-1.7, -0.3, -0.9), 3.3), grey(0.25));
    let high = (turned(DVec3::new(-1.1, 0.39, -0.4), 1.0), grey(0.75));
    // Tops at −0.3 + 0.99 and at 0.39 + 0.3, which may round differently.
    let crowd = (0..20).map(|k| {
        (
            sphere([50.0 + 3.0 * f64::from(k), 0.0, 0.0], 1.0),
            grey(0.1),
        )
    });
    for (first, second, expected) in [(&low, &high, 0.25), (&high, &low, 0.75)] {
        for others in [0, 20] {
            let objects: Vec<_> = [first.clone(), second.clone()]
                .into_iter()
                .chain(crowd.clone().take(others))
                .collect();
            let world = world(scene(&objects, &[]));
            let mut tracer = tracer(&world, 0);
            let mut random = Random(7);
            for _ in 0..4000 {
                let on_top = DVec3::new(-0.9, 0.69, -0.3)
                    + random.next() * 0.5 * DVec3::new(0.8, 0.0, -0.6)
                    + random.next() * 0.5 * DVec3::new(0.6, 0.0, 0.8);
                let eye = DVec3::new(-3.0, 4.0, 5.0) + random.point(2.0);
                let towards = Ray {
                    origin: eye,
                    direction: (on_top - eye).normalize(),
                };
                let seen = tracer.radiance(&centred(towards, f64::INFINITY)).radiance.x;
                assert_eq!(seen, expected, "toward {on_top}");
            }
        }
    }
}

/// Of a hundred copies of one ball, the first is seen.
#[test]
fn of_identical_objects_the_first_in_the_file_is_seen() {
    let mut objects = vec![(sphere([9.0, 0.0, 0.0], 1.0), grey(0.0))];
    objects.extend((0..100).map(|_| (sphere([0.1, 0.2, 0.3], 1.0), grey(0.5))));
    let world = world(scene(&objects, &[]));
    let mut random = Random(3);
    for _ in 0..500 {
        let origin = DVec3::new(0.0, 0.0, 5.0);
        let direction = (random.point(0.5) - origin).normalize();
        let met = world
            .nearest(&Ray { origin, direction }, f64::INFINITY)
            .expect("the ball is in the way");
        assert_eq!(met.object, 1);
    }
}

/// The tree agrees with testing every object, even for objects thinner than rounding errors.
#[test]
fn the_tree_matches_brute_force() {
    let mut random = Random(1);
    let objects: Vec<_> = (0..300)
        .map(|k| {
            let (at, size) = (random.point(10.0), 0.1 + random.next());
            let axes = [0, 1, 2].map(|_| random.point(1.0));
            let sheet = DVec3::new(size, size, 10_f64.powf(-20.0 * random.next()));
            let frame = Affine::new(at, axes, sheet).expect("a volume");
            let shape = match k % 4 {
                0 => sphere(at.to_array(), size),
                1 => cuboid(at.to_array(), [size, 2.0 * size, 0.5 * size]),
                2 => Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(frame)))),
                _ => Shape::Solid(Solid::Cone(Box::new(Cone(frame)))),
            };
            (shape, grey(0.5))
        })
        .collect();
    let world = world(scene(&objects, &[]));
    for number in 0..9000 {
        let far = [1.0, 30.0, 3e3][number % 3];
        let origin = far * random.point(12.0);
        let toward = random.point(10.0) - if far == 1.0 { DVec3::ZERO } else { origin };
        let ray = Ray {
            origin,
            direction: toward.normalize(),
        };
        let tried = objects
            .iter()
            .enumerate()
            .filter_map(|(object, (shape, _))| {
                Some((shape.hit(&ray, f64::INFINITY)?.t, object as u32))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let found = world
            .nearest(&ray, f64::INFINITY)
            .map(|nearest| (nearest.hit.t, nearest.object));
        assert_eq!(found, tried);
    }
}

/// Points of a floor of size 10⁶ next to a ball of radius r resting on it, lit from above at an
/// angle: shadows agree with exact geometry for all sizes of the ball.
#[test]
fn contact_shadows() {
    for radius in [1.0, 1e-3] {
        let floor = cuboid([-5e5, -1.0, -5e5], [1e6, 1.0, 1e6]);
        let ball = sphere([0.0, radius, 0.0], radius);
        let light = DVec3::new(3e3, 4e3, 0.0);
        let matte = Coefficients {
            diffuse: Rgb::ONE,
            ..BLACK
        };
        let world = world(scene(
            &[(floor, matte), (ball, BLACK)],
            &[white_light(light.to_array())],
        ));
        let mut tracer = tracer(&world, 0);
        let mut random = Random(5);
        let mut shadowed = 0;
        for _ in 0..20_000 {
            // Within 2 r of the contact; the eye looks straight down at the point, from below the
            // ball where possible.
            let place =
                DVec3::new(random.next() * 4.0 - 3.0, 0.0, random.next() * 4.0 - 2.0) * radius;
            let to_light = light - place;
            let centre = DVec3::new(0.0, radius, 0.0) - place;
            let along = centre.dot(to_light) / to_light.length();
            let off = (centre.length_squared() - along * along).max(0.0).sqrt();
            // Rounding of the reference formula leaves these undecided.
            if (off / radius - 1.0).abs() < 1e-6 {
                continue;
            }
            let eye = DVec3::new(place.x, place.y + 1e-2 * radius, place.z);
            let under = centre.with_y(radius - 1e-2 * radius).length() < radius;
            let down = Ray {
                origin: eye,
                direction: DVec3::NEG_Y,
            };
            let seen = tracer.radiance(&centred(down, f64::INFINITY));
            if under || seen.object != 0 {
                continue;
            }
            shadowed += u32::from(off < radius);
            assert_eq!(
                seen.radiance.x == 0.0,
                off < radius,
                "floor at {place}, radius {radius}"
            );
        }
        assert!(1000 < shadowed, "the test saw {shadowed} shadowed points");
    }
}
