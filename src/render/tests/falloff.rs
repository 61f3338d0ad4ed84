//! Lights of every kind against their formulas at random points.

use super::*;
use scene::{Emitter, Falloff, Shadows};

const TINTED: Coefficients = Coefficients {
    diffuse: Rgb::new(0.5, 0.25, 0.125),
    specular: Rgb::new(0.25, 1.0, 4.0),
    exponent: 3.0,
    ..BLACK
};

/// A white light at the origin, which tests modify.
const WHITE: Light = Light::point(DVec3::ZERO, Rgb::ONE);

/// A floor with its top in the plane y = 0.
fn floor() -> (Shape, Coefficients) {
    (cuboid([-100.0, -1.0, -100.0], [200.0, 1.0, 200.0]), TINTED)
}

/// The radiance of a point of the floor under one light.
fn lit(light: Light, point: DVec3, eye: DVec3, objects: &[(Shape, Coefficients)]) -> Rgb {
    let mut all = vec![floor()];
    all.extend_from_slice(objects);
    let mut scene = scene(&all, &[light]);
    scene.ambient = Rgb::ZERO;
    look(scene, 0, ray(eye.to_array(), point.to_array()))
        .0
        .radiance
}

/// Phong's model for the floor and light from a direction.
fn phong(point: DVec3, eye: DVec3, to_light: DVec3) -> Rgb {
    let view = (eye - point).normalize();
    let mirrored = DVec3::new(-to_light.x, to_light.y, -to_light.z);
    let highlight = mirrored.dot(view).max(0.0).powi(3);
    TINTED.diffuse * to_light.y.max(0.0) + TINTED.specular * highlight
}

#[track_caller]
fn assert_rgb(found: Rgb, expected: Rgb) {
    let error = (found - expected).abs().max_element();
    assert!(
        error <= 1e-12 * (1.0 + expected.max_element()),
        "{found} is not {expected}"
    );
}

#[test]
fn point_lights_fall_off_with_distance_and_angle() {
    let mut dark = 0;
    for index in 0..5_000 {
        let mut random = Numbers::new(index);
        let point = 5.0 * random.in_cube().with_y(0.0);
        let [position, eye] =
            [(); 2].map(|()| (5.0 * random.in_cube()).with_y(random.between(0.5, 9.0)));
        let radial = [(); 3].map(|()| random.between(-1.0, 2.0).max(0.0));
        let exponent = [0.5, 1.0, 2.0, 7.0, 40.5][random.below(5)];
        let is_spot = random.below(2) == 0;
        let direction = random.direction();
        let colour = DVec3::new(1.0, 0.5, 2.0);
        let light = Light {
            emitter: Emitter::Point {
                position,
                radius: 0.0,
                falloff: Falloff {
                    radial,
                    spot: is_spot.then_some((direction, exponent)),
                },
            },
            colour,
            shadows: Shadows::Cast,
            ..WHITE
        };
        let way = point - position;
        let distance = way.length();
        let [a0, a1, a2] = radial;
        let spread = a0 + a1 * distance + a2 * distance * distance;
        let radial = if 0.0 < spread { 1.0 / spread } else { 1.0 };
        let cosine = direction.dot(way / distance);
        let angular = if !is_spot {
            1.0
        } else if cosine <= 0.0 {
            dark += 1;
            0.0
        } else {
            cosine.powf(exponent)
        };
        let expected = radial * angular * colour * phong(point, eye, -way / distance);
        assert_rgb(lit(light, point, eye, &[]), expected);
    }
    assert!(500 < dark, "{dark} behind a spot light");
}

/// Light does not fall off where a0 + a1 d + a2 d² is not positive.
#[test]
fn a_denominator_that_is_not_positive_disables_falloff() {
    for (radial, share) in [
        ([0.0, 0.0, 0.0], 1.0),
        ([-1.0, 0.0, 0.0], 1.0),
        ([1.0, -1.0, 0.0], 1.0),
        ([4.0, -1.0, 0.0], 0.5),
        ([0.0, 0.0, 0.25], 1.0),
    ] {
        let emitter = Emitter::Point {
            position: DVec3::new(0.0, 2.0, 0.0),
            radius: 0.0,
            falloff: Falloff { radial, spot: None },
        };
        let light = Light {
            emitter,
            colour: Rgb::ONE,
            shadows: Shadows::Cast,
            ..WHITE
        };
        let eye = DVec3::new(1.0, 3.0, 0.0);
        let expected = share * phong(DVec3::ZERO, eye, DVec3::Y);
        assert_rgb(lit(light, DVec3::ZERO, eye, &[]), expected);
    }
}

#[test]
fn distant_lights_are_the_same_everywhere() {
    for index in 0..1_000 {
        let mut random = Numbers::new(index);
        let point = 50.0 * random.in_cube().with_y(0.0);
        let eye = point + random.in_cube().with_y(1.5);
        let toward = random.direction();
        let light = Light {
            emitter: Emitter::Distant(toward),
            colour: Rgb::ONE,
            shadows: Shadows::Cast,
            ..WHITE
        };
        let expected = if 0.0 < toward.y {
            phong(point, eye, toward)
        } else {
            Rgb::ZERO
        };
        assert_rgb(lit(light, point, eye, &[]), expected);
    }
}

/// Shadows can be turned off per light. Objects beyond a point light do not block it, but nothing
/// is beyond a distant light.
#[test]
fn shadows_are_set_per_light() {
    let point = Emitter::Point {
        position: DVec3::new(0.0, 4.0, 0.0),
        radius: 0.0,
        falloff: Falloff::NONE,
    };
    let ball = |height: f64, transmission| {
        let material = Coefficients {
            transmission,
            ..BLACK
        };
        (sphere([0.0, height, 0.0], 0.5), material)
    };
    for (emitter, shadows, height, transmission, share) in [
        (point, Shadows::Cast, 2.0, 0.0, 0.0),
        (point, Shadows::Cast, 2.0, 0.25, 0.25),
        (point, Shadows::Off, 2.0, 0.0, 1.0),
        (point, Shadows::Cast, 6.0, 0.0, 1.0),
        (Emitter::Distant(DVec3::Y), Shadows::Cast, 6.0, 0.0, 0.0),
        (Emitter::Distant(DVec3::Y), Shadows::Cast, 1e9, 0.0, 0.0),
        (Emitter::Distant(DVec3::Y), Shadows::Cast, 6.0, 0.25, 0.25),
        (Emitter::Distant(DVec3::Y), Shadows::Off, 6.0, 0.0, 1.0),
        (Emitter::Ambient, Shadows::Cast, 6.0, 0.0, 0.0),
    ] {
        let light = Light {
            emitter,
            colour: Rgb::ONE,
            shadows,
            ..WHITE
        };
        let eye = DVec3::new(2.0, 1.0, 0.0);
        let expected = share * phong(DVec3::ZERO, eye, DVec3::Y);
        let found = lit(light, DVec3::ZERO, eye, &[ball(height, transmission)]);
        assert_rgb(found, expected);
    }
}
