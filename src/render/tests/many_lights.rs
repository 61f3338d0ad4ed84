//! Many lights, of which paths choose one at each surface, against the same lights sampled one by one.

use super::emitters::{estimate, means};
use super::*;
use crate::light::ManyLights;
use scene::{Emitter, Falloff, Shadows};

/// Lamps that fade with the square of the distance, with this radius, above and beside a ball on a
/// table, among lights that do not fade.
pub(super) fn lamps(count: usize, size: f64) -> Scene {
    let shiny = Coefficients {
        diffuse: Rgb::splat(0.5),
        specular: Rgb::splat(0.2),
        exponent: 20.0,
        ..BLACK
    };
    let mut random = Random(9);
    let mut lights = vec![white_light([3.0, 4.0, 5.0])];
    for _ in 0..count {
        let position = 6.0 * random.point(1.0) - DVec3::new(3.0, 3.0, 0.5);
        lights.push(Light {
            emitter: Emitter::Point {
                position,
                radius: size,
                falloff: Falloff {
                    radial: [0.0, 0.0, 0.5],
                    spot: None,
                },
            },
            colour: Rgb::splat(random.next()),
            ..white_light([0.0; 3])
        });
    }
    lights.push(white_light([-3.0, 1.0, 7.0]));
    let objects = [
        (sphere([0.0, 0.0, 0.5], 1.0), shiny),
        (cuboid([-9.0, -9.0, -2.0], [18.0, 18.0, 1.0]), shiny),
    ];
    scene(&objects, &lights)
}

/// The same world in which every light is sampled at every surface.
fn one_by_one(world: &World) -> World {
    World {
        many_lights: Arc::new(ManyLights::none(&world.scene.lights)),
        ..world.clone()
    }
}

#[test]
fn one_of_many_lights_has_the_mean_of_all() {
    for size in [0.0, 0.3] {
        let world = world(lamps(40, size));
        assert!(!world.many_lights.is_empty());
        let all = one_by_one(&world);
        for (depth, toward) in [
            (0, [2.0, 1.0, -1.0]),
            (1, [-1.5, -2.0, -1.0]),
            (2, [0.0, -0.3, 1.4]),
        ] {
            let seen = ray([1.0, -4.0, 5.0], toward);
            let [mean, error] = estimate(&means(&world, depth, seen, 64));
            let [expected, spread] = estimate(&means(&all, depth, seen, 16));
            assert!(0.0 < expected, "{size} {depth}");
            assert!(
                (mean - expected).abs() <= 3.0 * error.hypot(spread) + 1e-9,
                "{size} {depth}: {mean} ± {error}, one by one {expected} ± {spread}"
            );
            assert!(error < 0.05 * expected, "{size} {depth}: {error}");
        }
    }
}

/// A number leads to one light, so that the chances of all lights in front of a surface add up to 1.
#[test]
fn chances_of_lights_are_those_of_their_choice() {
    let scene = lamps(40, 0.3);
    let many = ManyLights::build(&scene.lights, None, &|| false).expect("nothing cancels");
    let at = (DVec3::new(0.0, 0.0, -9.0), DVec3::Z);
    for place in 0..100 {
        let number = (f64::from(place) + 0.5) / 100.0;
        let (light, chance) = many
            .choose(at, [0.0, 0.0, number, 0.0])
            .expect("all are above");
        assert_near(many.chance(light as u32, at), chance, 1e-12);
    }
    let sum: f64 = (1..=40).map(|light| many.chance(light, at)).sum();
    assert_near(sum, 1.0, 1e-12);
    // Those that do not fade are sampled in any case.
    assert!(many.others().eq([0, 41]));
    for light in [0, 41] {
        assert_eq!(many.chance(light, at), 1.0);
    }
}

#[test]
fn few_lights_are_sampled_one_by_one() {
    for (count, is_empty) in [(0, true), (16, true), (17, false)] {
        let lights = lamps(count, 0.0).lights;
        let many = ManyLights::build(&lights, None, &|| false).expect("nothing cancels");
        assert_eq!(many.is_empty(), is_empty, "{count}");
        let others = if is_empty { lights.len() } else { 2 };
        assert_eq!(many.others().count(), others, "{count}");
    }
    // Those that cast no shadows, and dark ones, do not count.
    let mut lights = lamps(18, 0.0).lights;
    lights[3].shadows = Shadows::Off;
    lights[4].colour = Rgb::ZERO;
    let many = ManyLights::build(&lights, None, &|| false).expect("nothing cancels");
    assert!(many.is_empty());
}

#[test]
fn the_choice_is_kept_while_the_lights_are_the_same() {
    let mut lights = lamps(40, 0.0).lights;
    let build = |lights: &[Light], known| {
        ManyLights::build(lights, known, &|| false).expect("nothing cancels")
    };
    let first = build(&lights, None);
    assert!(Arc::ptr_eq(&first, &build(&lights, Some(&first))));
    // The last one does not fade.
    let fewer = build(&lights[..41], Some(&first));
    assert!(fewer.others().eq([0]));
    let more = build(&lights, Some(&fewer));
    assert!(more.others().eq([0, 41]));
    lights[5].colour *= 2.0;
    assert!(!Arc::ptr_eq(&first, &build(&lights, Some(&first))));
}
