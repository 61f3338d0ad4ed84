//! Lights in path tracing: their intensity, size and falloff.

use std::f64::consts::PI;

use super::highlights::GROUND;
use super::paths::{assert_unbiased, mean};
use super::*;
use scene::Emitter;

/// A light of radius r at height h above a white floor: the floor reflects E / π, E = π L (r / h)²,
/// and L = π I / (π r² a²), with the factor π of scenes not made for path tracing: I / (a h)² for any
/// r. With gamma it is L = I / (π r²), whatever the attenuation a.
#[test]
fn lights_with_a_size_match_their_intensity() {
    for radius in [0.1, 1.0, 3.9] {
        for (gamma, attenuation, expected) in [
            ("", 1.0, 0.5),
            ("", 2.0, 0.125),
            (" gamma='sRGB'", 0.0, 0.5 / PI),
            (" gamma='sRGB'", 2.0, 0.5 / PI),
        ] {
            let scene = xml_seen_by(
                &format!("<camera{gamma}/>"),
                &format!(
                    "{GROUND}<material name='m'><diffuse value='1'/><specular value='0'/></material>
                     <light type='point'><intensity value='8'/><position z='4'/>
                     <size value='{radius}'/><attenuation value='{attenuation}'/></light>"
                ),
            );
            let down = ray([0.5, 0.0, 0.05], [0.0; 3]);
            // By next event estimation alone, and with multiple importance sampling.
            assert_unbiased(&scene, 0, down, expected, "asked");
            assert_unbiased(&scene, 1, down, expected, "asked and met");
        }
    }
}

/// A light of radius r at height h that neither fades nor is a radiometric quantity is sampled as in
/// Whitted ray tracing, and not seen: the floor reflects I times the mean of N·L over the cone that the
/// light subtends, ½ (1 + cos α), at any depth.
#[test]
fn lights_with_a_size_that_do_not_fade_light_as_without_path_tracing() {
    let lamp =
        "<light type='point'><intensity value='3'/><position z='4'/><size value='2'/></light>";
    let scene = xml(&format!(
        "{GROUND}<material name='m'><diffuse value='1'/><specular value='0'/></material>{lamp}"
    ));
    let expected = 3.0 * 0.5 * (1.0 + 0.75f64.sqrt());
    let down = ray([0.5, 0.0, 0.05], [0.0; 3]);
    for depth in [0, 1] {
        assert_unbiased(&scene, depth, down, expected, "asked only");
    }
    let up = ray([0.0; 3], [0.0, 0.0, 1.0]);
    assert_near(mean(xml(lamp), 4, up, 16), 0.0, 0.0);
}

/// With `falloff square`, a point light of intensity I at distance d reaches a white floor with I / d²,
/// in both integrators, unless its own terms fade it; those of a size have the radiance that gives the
/// same.
#[test]
fn lights_fade_by_the_square_where_their_own_terms_do_not() {
    let floor = |light: &str| {
        xml(&format!(
            "{GROUND}<material name='m'><diffuse value='1'/><specular value='0'/></material>{light}"
        ))
    };
    let lamp = |terms: &str| {
        floor(&format!(
            "<light type='point'><intensity value='8'/><position z='4'/>{terms}</light>"
        ))
    };
    let mut halved = lamp("");
    if let Emitter::Point { falloff, .. } = &mut halved.lights[0].emitter {
        falloff.radial = [2.0, 0.0, 0.0];
    }
    let distant = "<light type='direct'><intensity value='8'/><direction z='-1'/></light>";
    for (case, scene, plain, square) in [
        ("a point", lamp(""), 8.0, 0.5),
        ("attenuated", lamp("<attenuation value='2'/>"), 0.125, 0.125),
        ("a constant term", halved, 4.0, 0.25),
        ("distant", floor(distant), 8.0, 8.0),
    ] {
        for (falloff, expected) in [(FalloffRule::None, plain), (FalloffRule::Square, square)] {
            let rules = WorldSettings { falloff, ..PATHS };
            let scene = Arc::new(scene.clone());
            let world = World::build(scene, &Images::default(), rules, None, &|| false);
            let world = world.expect("nothing cancels the building");
            let sample = centred(ray([0.5, 0.0, 0.05], [0.0; 3]), f64::INFINITY);
            for integrator in Integrator::ALL {
                let mut tracer = Tracer::new(&world, integrator, 0, &|| false);
                let seen = tracer.radiance(&sample).radiance.x;
                assert_near(seen, expected, 1e-12 * expected);
                assert!(seen.is_finite(), "{case}");
            }
        }
    }
    for radius in [0.1, 1.0, 3.9] {
        let scene = lamp(&format!("<size value='{radius}'/>"));
        let faded = crate::light::faded(&scene.lights, FalloffRule::Square);
        let lights = faded.expect("its falloff is constant");
        let scene = Scene { lights, ..scene };
        let down = ray([0.5, 0.0, 0.05], [0.0; 3]);
        assert_unbiased(&scene, 1, down, 0.5, "a size");
    }
}

#[test]
fn lights_with_a_size_are_visible() {
    let lamp = |z: f64| {
        format!(
            "<light type='point'><intensity value='12'/><position z='{z}'/><size value='2'/><attenuation value='1'/></light>"
        )
    };
    let up = ray([0.0; 3], [0.0, 0.0, 1.0]);
    assert_near(mean(xml(&lamp(5.0)), 4, up, 16), 3.0, 1e-12);
    assert_near(mean(xml(&lamp(1.0)), 4, up, 16), 0.0, 0.0);
    assert_near(mean(xml(&lamp(-5.0)), 4, up, 16), 0.0, 0.0);
    let hidden = format!(
        "{}<object type='sphere' material='m'><translate z='2'/></object>
         <material name='m'><diffuse value='0'/><specular value='0'/><emission value='7'/></material>",
        lamp(5.0)
    );
    assert_near(mean(xml(&hidden), 4, up, 16), 7.0, 1e-12);
}

/// A light behind another adds nothing, one beside it everything, at any place in the world.
#[test]
fn lights_with_a_size_occlude_each_other() {
    for far in [0.0, 1e6, 1e7] {
        let lamp = |x: f64, z: f64, size: f64, intensity: f64| {
            format!(
                "<light type='point'><intensity value='{intensity}'/>
                 <position x='{}' z='{z}'/><size value='{size}'/><attenuation value='1'/></light>",
                far + x
            )
        };
        let floor = format!(
            "<object type='plane' material='m'><scale value='100'/><translate x='{far}'/></object>
             <material name='m'><diffuse value='1'/><specular value='0'/></material>"
        );
        let down = ray([far, 0.0, 0.5], [far, 0.0, 0.0]);
        // A dark light of radius 2 at half the height hides the bright one completely; cosines are
        // those of lights straight above.
        for (x, expected) in [(0.0, 0.0), (50.0, 0.5)] {
            let lights = lamp(0.0, 4.0, 1.0, 8.0) + &lamp(x, 2.5, 2.0, 0.0);
            let scene = xml(&format!("{floor}{lights}"));
            for depth in [0, 1] {
                let seen = mean(scene.clone(), depth, down, 1 << 14);
                assert_near(seen, expected, 2e-3);
            }
        }
    }
}

/// A tiny light acts like a point light.
#[test]
fn tiny_lights_act_like_points() {
    for size in ["1e-9", "1e-150", "1e-300", "5e-324"] {
        let scene = xml(&format!(
            "{GROUND}<material name='m'><diffuse value='1'/><specular value='0'/></material>
             <light type='point'><intensity value='8'/><position z='4'/><size value='{size}'/><attenuation value='1'/></light>"
        ));
        let down = ray([0.0, 0.0, 0.5], [0.0; 3]);
        assert_near(mean(scene, 1, down, 64), 0.5, 1e-12);
    }
}
