//! Ambient light, Phong's model and shadows.

use super::*;

/// A floor whose top is the plane y = 0, with the coefficients of SPEC §9.
fn floor(exponent: f64) -> (Shape, Coefficients) {
    let material = Coefficients {
        ambient: Rgb::splat(0.1),
        diffuse: Rgb::splat(0.9),
        specular: Rgb::splat(0.9),
        exponent,
        ..BLACK
    };
    (
        cuboid([-100.0, -1.0, -100.0], [200.0, 1.0, 200.0]),
        material,
    )
}

/// The level of the floor at the origin, for these positions of the eye and the lights.
fn floor_level(exponent: f64, eye: [f64; 3], lights: &[[f64; 3]]) -> f64 {
    let lights: Vec<_> = lights
        .iter()
        .map(|&position| white_light(position))
        .collect();
    level(scene(&[floor(exponent)], &lights), 8, ray(eye, [0.0; 3]))
}

#[test]
fn phong_at_a_point() {
    let half = 0.5f64.sqrt();
    for (case, eye, light, expected) in [
        ("eye and light above", [0.0, 2.0, 0.0], [0.0, 5.0, 0.0], 1.9),
        ("eye 45° off", [2.0, 2.0, 0.0], [0.0, 5.0, 0.0], 1.0),
        (
            "light 45° off",
            [0.0, 2.0, 0.0],
            [5.0, 5.0, 0.0],
            0.1 + 0.9 * half,
        ),
        (
            "eye in the mirror direction",
            [2.0, 2.0, 0.0],
            [-5.0, 5.0, 0.0],
            1.0 + 0.9 * half,
        ),
        (
            "light below the surface",
            [2.0, 2.0, 0.0],
            [0.0, -5.0, 0.0],
            0.1,
        ),
    ] {
        // At 45° the highlight is (√½)²⁰⁰ = (½)¹⁰⁰, negligible beside the tolerance of 1e-12.
        let seen = floor_level(200.0, eye, &[light]);
        assert!(
            (seen - expected).abs() < 1e-12,
            "{case}: {seen} is not {expected}"
        );
    }
}

#[test]
fn lights_add_up() {
    let one = floor_level(7.0, [1.0, 2.0, 0.0], &[[0.0, 5.0, 0.0]]);
    let two = floor_level(7.0, [1.0, 2.0, 0.0], &[[3.0, 5.0, 1.0]]);
    let both = floor_level(7.0, [1.0, 2.0, 0.0], &[[0.0, 5.0, 0.0], [3.0, 5.0, 1.0]]);
    assert_near(both, one + two - 0.1, 1e-15);
}

/// With the eye at an angle a to the mirror direction the highlight is cosⁿ a, by general power.
#[test]
fn highlights_are_powers_of_the_cosine() {
    for (exponent, read_as) in [
        (0.0, 0.0),
        (1.0, 1.0),
        (2.5, 2.5),
        (5.0, 5.0),
        (37.0, 37.0),
        (4096.0, 4096.0),
        (4097.0, 4097.0),
        (-3.0, 0.0),
    ] {
        for degrees in [0.0, 1.0, 10.0, 60.0, 89.0f64] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let seen = floor_level(
                exponent,
                [sine * 2.0, cosine * 2.0, 0.0],
                &[[0.0, 5.0, 0.0]],
            );
            let expected = 0.1 + 0.9 + 0.9 * cosine.powf(read_as);
            assert!(
                (seen - expected).abs() < 1e-11,
                "cos^{exponent} {degrees}°: {seen}, {expected}"
            );
        }
    }
}

/// With exponent 0 the highlight is 1 up to a right angle from the mirrored light, 0 beyond.
#[test]
fn the_highlight_ends_where_the_cosine_becomes_negative() {
    let light = [[-5.0, 5.0, 0.0]];
    let diffuse = 0.1 + 0.9 * 0.5f64.sqrt();
    assert_near(floor_level(0.0, [-2.0, 1.9, 0.0], &light), diffuse, 1e-12);
    assert_near(
        floor_level(0.0, [-2.0, 2.1, 0.0], &light),
        diffuse + 0.9,
        1e-12,
    );
}

/// Both faces of a solid are shaded alike: in a glass ball, the far wall is lit by a light inside.
#[test]
fn inner_faces_are_lit_from_inside() {
    let glass = Coefficients {
        diffuse: Rgb::splat(0.5),
        ..BLACK
    };
    let ball = (sphere([0.0; 3], 1.0), glass);
    let inside = scene(&[ball], &[white_light([0.0; 3])]);
    assert_near(
        level(inside, 0, ray([0.5, 0.0, 0.0], [1.0, 0.0, 0.0])),
        0.5,
        1e-12,
    );
}

#[test]
fn shadows_multiply_transmissions_once_per_solid() {
    let pane = |height: f64, transmission: f64| {
        (
            cuboid([-1.0, height, -1.0], [2.0, 0.1, 2.0]),
            Coefficients {
                transmission,
                ..BLACK
            },
        )
    };
    let lit = |panes: &[(Shape, Coefficients)]| {
        let mut objects = vec![(
            floor(1.0).0,
            Coefficients {
                diffuse: Rgb::ONE,
                ..BLACK
            },
        )];
        objects.extend_from_slice(panes);
        level(
            scene(&objects, &[white_light([0.0, 4.0, 0.0])]),
            0,
            ray([2.0, 0.5, 0.0], [0.0; 3]),
        )
    };
    assert_near(lit(&[]), 1.0, 1e-12);
    assert_near(lit(&[pane(1.0, 0.0)]), 0.0, 0.0);
    // The ray enters and leaves each pane, which counts once.
    assert_near(lit(&[pane(1.0, 0.5)]), 0.5, 1e-12);
    assert_near(lit(&[pane(1.0, 0.5), pane(2.0, 0.4)]), 0.2, 1e-12);
    assert_near(
        lit(&[pane(1.0, 0.5), pane(2.0, 0.0), pane(3.0, 0.4)]),
        0.0,
        0.0,
    );
    assert_near(lit(&[pane(5.0, 0.0)]), 1.0, 1e-12);
    // The light is inside the pane: one surface is crossed.
    assert_near(
        lit(&[(
            cuboid([-1.0, 3.0, -1.0], [2.0, 2.0, 2.0]),
            Coefficients {
                transmission: 0.3,
                ..BLACK
            },
        )]),
        0.3,
        1e-12,
    );
}

/// A light outside lights the inside of a glass block through its own wall, which counts once.
#[test]
fn a_solid_shadows_itself_where_the_ray_crosses_it_again() {
    let block = Coefficients {
        diffuse: Rgb::ONE,
        transmission: 0.25,
        ..BLACK
    };
    let inside = scene(
        &[(cuboid([-1.0; 3], [2.0; 3]), block)],
        &[white_light([0.0, 3.0, 0.0])],
    );
    // Seen from inside, the normal of the block's floor is flipped upward, and the light comes
    // through its top.
    assert_near(
        level(inside, 0, ray([0.0; 3], [0.0, -1.0, 0.0])),
        0.25,
        1e-12,
    );
}

/// A light on a surface is not blocked by it, regardless of rounding.
#[test]
fn a_light_on_a_surface_is_not_blocked_by_it() {
    for step in 0..1000 {
        let angle = f64::from(step) * 0.0061;
        let light = [1.3 + 0.7 * angle.cos(), 2.0 + 0.7 * angle.sin(), 0.1];
        let radius = ((light[0] - 1.3f64).powi(2) + (light[1] - 2.0f64).powi(2) + 0.01).sqrt();
        let lamp = (sphere([1.3, 2.0, 0.0], radius), BLACK);
        let floor = (
            floor(1.0).0,
            Coefficients {
                diffuse: Rgb::ONE,
                ..BLACK
            },
        );
        // The lower half of the lamp faces the floor below it.
        if light[1] < 1.9 {
            let below = [light[0], 0.0, light[2]];
            let eye = [light[0] + 3.0, 1.0, light[2] - 4.0];
            let seen = level(
                scene(&[floor, lamp], &[white_light(light)]),
                0,
                ray(eye, below),
            );
            assert_near(seen, 1.0, 1e-9);
        }
    }
}
