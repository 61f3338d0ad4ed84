//! CSG solids and unbounded solids among others.

use super::*;
use geometry::{Csg, Operation, Quadric};

fn made(operation: Operation, first: Shape, second: Shape) -> Shape {
    Shape::Csg(Arc::new(Csg::new(vec![
        operand(first, 0),
        operand(second, 0),
        Node::Operation {
            operation,
            first: 0,
            second: 1,
        },
    ])))
}

/// An unbounded solid among many bounded ones: the ground y ≤ 0 under balls.
#[test]
fn unbounded_solids_are_visible_among_others() {
    let ground = Quadric::new([0., 0., 0., 0., 0., 0., 0.5, 0., 0., 0.], &[]);
    let mut objects = vec![(Shape::Solid(Solid::Quadric(Box::new(ground))), grey(0.5))];
    for ball in 1..=8 {
        objects.push((sphere([3.0 * f64::from(ball), 1.0, 0.0], 1.0), grey(1.0)));
    }
    for (from, toward, expected) in [
        ([0.0, 9.0, 9.0], [-5.0, 0.0, 0.0], 0.5),
        ([0.0, 9.0, 9.0], [1e7, 0.0, 1e7], 0.5),
        ([12.0, 1.0, 9.0], [12.0, 1.0, 0.0], 1.0),
        ([0.0, 9.0, 9.0], [0.0, 9.1, 0.0], 0.0),
    ] {
        assert_near(
            level(scene(&objects, &[]), 0, ray(from, toward)),
            expected,
            0.0,
        );
    }
}

const GLASS: Coefficients = Coefficients {
    transmission: 0.5,
    index: 1.5,
    ..BLACK
};

/// A wall behind a glass solid, or none, with a light in front of both.
fn behind_glass(glass: Option<Shape>) -> Scene {
    let wall = Coefficients {
        ambient: Rgb::splat(0.1),
        diffuse: Rgb::splat(0.9),
        ..BLACK
    };
    let mut objects = vec![(cuboid([-20.0, -20.0, -6.0], [40.0, 40.0, 1.0]), wall)];
    let index = objects.len();
    if let Some(shape) = glass {
        objects.push((shape, GLASS));
    }
    let mut scene = scene(&objects, &[white_light([0.2, 0.1, 9.0])]);
    // The leaves of a CSG solid refer to material 0.
    scene
        .materials
        .edit(|materials| materials.rotate_left(index));
    for number in 0..scene.objects.len() {
        let object = &mut scene.objects[number];
        object.material = (object.material + 1) % scene.materials.len() as u32;
    }
    scene
}

/// Shadows and refraction through CSG solids: two touching halves of a slab act as one slab, and so
/// does a larger one cut to size.
#[test]
fn csg_solids_transmit_light_like_equal_simple_solids() {
    let slab = |z: f64, depth: f64| cuboid([-6.0, -6.0, z], [12.0, 12.0, depth]);
    let larger = cuboid([-7.0, -7.0, -1.0], [14.0, 14.0, 2.0]);
    let outside = [
        cuboid([-30.0, -30.0, 1.0], [60.0, 60.0, 60.0]),
        cuboid([-6.0, -6.0, -1.0], [12.0, 12.0, 5.0]),
    ];
    let [above, tall] = outside;
    let plain = world(behind_glass(Some(slab(-1.0, 2.0))));
    let likes = [
        made(Operation::Union, slab(-1.0, 1.0), slab(0.0, 1.0)),
        made(Operation::Intersection, larger, slab(-4.0, 9.0)),
        made(Operation::Difference, tall, above),
    ];
    let likes = likes.map(|shape| world(behind_glass(Some(shape))));
    for index in 0..4_000 {
        let mut random = Numbers::new(index);
        let toward = [random.between(-9.0, 9.0), random.between(-9.0, 9.0), 0.0];
        let ray = ray([0.3, 0.2, 20.0], toward);
        let of = |world| {
            tracer(world, 8)
                .radiance(&centred(ray, f64::INFINITY))
                .radiance
                .x
        };
        for like in &likes {
            assert_near(of(like), of(&plain), 1e-9);
        }
    }
    // Vertically, the slab transmits half of the view at each face, and half of the light.
    let down = ray([0.0, 0.0, 8.0], [0.0; 3]);
    let open = level(behind_glass(None), 8, down);
    let through = level(behind_glass(Some(slab(-1.0, 2.0))), 8, down);
    assert_near(through, 0.25 * (0.1 + 0.5 * (open - 0.1)), 1e-9);
}

/// An index of 0 does not refract, and opaque solids are not entered.
#[test]
fn an_index_of_0_counts_as_air() {
    for (index, transmission, expected) in [(0.0, 1.0, 0.6), (1.0, 1.0, 0.6), (0.0, 0.0, 0.0)] {
        let ball = Coefficients {
            transmission,
            index,
            ..BLACK
        };
        let wall = cuboid([-9.0, -9.0, -9.0], [18.0, 18.0, 1.0]);
        let scene = scene(&[(sphere([0.0; 3], 1.0), ball), (wall, grey(0.6))], &[]);
        let aside = ray([0.7, 0.3, 5.0], [0.7, 0.3, 0.0]);
        assert_near(level(scene, 8, aside), expected, 1e-15);
    }
}
