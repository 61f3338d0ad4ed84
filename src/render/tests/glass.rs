//! Mirrors, glass and absorption, against values computed by hand.

use super::highlights::{GROUND, assert_colour, brings};
use super::*;

/// A coloured mirror under a coloured sky; its back reflects nothing.
#[test]
fn front_faces_reflect_the_environment() {
    let scene = format!(
        "{GROUND}<material name='m'><diffuse value='0'/><specular value='0'/>
         <reflection r='1' g='.5' b='0'/></material>
         <environment r='.5' g='.5' b='.5'/><background value='7'/>"
    );
    let from_above = ray([1.0, 0.0, 1.0], [0.0; 3]);
    assert_colour(
        brings(&scene, 1, from_above),
        Rgb::new(0.5, 0.25, 0.0),
        "front",
    );
    assert_colour(brings(&scene, 0, from_above), Rgb::ZERO, "no bounces");
    let from_below = ray([1.0, 0.0, -1.0], [0.0; 3]);
    assert_colour(brings(&scene, 1, from_below), Rgb::ZERO, "back");
    let past = ray([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]);
    assert_colour(brings(&scene, 1, past), Rgb::splat(7.0), "background");
}

fn glass_ball(glass: &str) -> String {
    format!(
        "<object type='sphere' material='m'/><environment value='1'/>
         <material name='m'><diffuse value='0'/><specular value='0'/>{glass}</material>"
    )
}

/// The reflection and transmission of clear glass add up to 1 along every path.
#[test]
fn clear_glass_in_a_uniform_environment_is_invisible() {
    for index in [1.0, 1.5, 0.7, 2.4] {
        let scene = glass_ball(&format!("<refraction value='1' index='{index}'/>"));
        for aside in [0.0, 0.3, 0.6, 0.9, 0.99] {
            let seen = brings(&scene, 60, ray([aside, 0.0, 5.0], [aside, 0.0, 0.0]));
            // Light still inside at the last bounce is lost.
            assert_near(seen.x, 1.0, 1e-6);
        }
    }
}

/// Through the centre of a ball of diameter 2: F = .04 is reflected; the rest loses A = e^−2a on
/// each crossing, and F of it stays inside: F + (1 − F)² A / (1 − F A).
#[test]
fn absorption_depends_on_the_distance_inside() {
    let share = 0.04;
    for (index, share) in [(1.5, share), (1.0, 0.0), (0.0, 0.0), (-3.0, 0.0)] {
        let scene = glass_ball(&format!(
            "<refraction value='1' index='{index}'/><absorption r='.5' g='0' b='3'/>"
        ));
        let seen = brings(&scene, 60, ray([0.0, 0.0, 5.0], [0.0; 3]));
        let expected = Rgb::new(0.5, 0.0, 3.0).map(|absorption| {
            let left = (-2.0f64 * absorption).exp();
            share + (1.0 - share) * (1.0 - share) * left / (1.0 - share * left)
        });
        assert_colour(seen, expected, &format!("index {index}"));
    }
}

/// From inside glass up to its surface, 2 above a white floor: reflected light hits the floor after
/// 2 / cos θ. The critical angle of 1.5 is 41.8°.
#[test]
fn total_internal_reflection() {
    for (degrees, beyond) in [
        (0.0, false),
        (30.0, false),
        (41.0, false),
        (42.0, true),
        (80.0, true),
    ] {
        let angle = f64::to_radians(degrees);
        let scene = "<object type='plane' material='m'><scale value='1000'/></object>
            <object type='plane'><scale value='1000'/><translate z='-2'/></object>
            <material name='m'><refraction value='.5' index='1.5'/><absorption value='.25'/></material>";
        let toward = [angle.sin(), 0.0, angle.cos()];
        let start = toward.map(|x| -x);
        let seen = brings(scene, 1, ray(start, [0.0; 3])).x;
        let refracted = (1.0 - (1.5 * angle.sin()).powi(2)).max(0.0).sqrt();
        let share = if beyond {
            1.0
        } else {
            0.04 + 0.96 * (1.0 - refracted).powi(5)
        };
        let left = (-0.25 * 2.0 / angle.cos()).exp();
        assert_near(seen, 0.5 * share * left, 1e-12);
    }
}
