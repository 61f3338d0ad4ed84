//! Photons beside what cuts the disc that they are gathered in.

use super::photons::{
    PHOTONS, Traced, assert_alike_along, cosine_over_square, onto_ground, world_by,
};
use super::*;

/// A mirror overhead, a light below it, and what is beneath: the image of the light is at
/// (1.5, 0, 7).
const OVERHEAD: &str = "<object type='plane' material='mirror'><scale value='2'/>
        <rotate x='1' angle='180'/><translate x='1.5' z='4'/></object>
    <light type='point'><intensity value='8'/><attenuation value='1'/>
        <position x='1.5' z='1'/></light>
    <material name='white'><diffuse value='1'/><specular value='0'/></material>
    <material name='black'><diffuse value='0'/><specular value='0'/></material>
    <material name='mirror'><diffuse value='0'/><specular value='0'/><reflection value='1'/></material>";

/// A plane from x = 0 to where no photon arrives.
const GROUND: &str =
    "<object type='plane' material='white'><scale value='20'/><translate x='20'/></object>";

/// Rays down to the ground at a distance from x = 0.
fn down_at(x: f64) -> Vec<Ray> {
    let ray = |number| {
        let y = (f64::from(number) - 15.5) / 8.0;
        ray([x + 0.01, y, 0.02], [x, y, 0.0])
    };
    (0..32).map(ray).collect()
}

/// The mean over rays and some seeds of what photons bring, as a share of what the image of the light
/// would bring them.
fn share(scene: &Scene, rays: &[Ray], image: [f64; 3], (count, seeds): (u32, u32)) -> f64 {
    let world = world_by(scene, PHOTONS);
    let traced = |depth| Traced {
        depth,
        count,
        maps: 64,
    };
    let direct = Traced {
        maps: 1,
        ..traced(0)
    }
    .mean(&world, rays, 0)
    .x;
    let sum: f64 = (0..seeds)
        .map(|seed| traced(1).mean(&world, rays, seed).x - direct)
        .sum();
    let at = |ray: &Ray| ray.at(-ray.origin.z / ray.direction.z);
    let expected: f64 = rays
        .iter()
        .map(|ray| 8.0 * cosine_over_square(at(ray), image))
        .sum();
    sum / f64::from(seeds) / (expected / rays.len() as f64)
}

/// The kernels of the first maps have a radius of .7. What cuts them turns no light, so that the ground
/// beside it gets all that the mirror brings.
#[test]
fn photons_beside_a_cut_are_as_bright_as_elsewhere() {
    let cuts = [
        (
            "a wall",
            "<object type='plane' material='black'><scale value='4'/><rotate angle='90' y='1'/></object>
             <object type='plane' material='white'><scale value='20'/></object>",
        ),
        ("an edge", GROUND),
        (
            "a fold",
            "<object type='plane' material='white'><scale x='2' y='20'/><translate x='-2'/>
             <rotate angle='-60' y='1'/></object>",
        ),
    ];
    for (cut, objects) in cuts {
        let ground = if cut == "a wall" { "" } else { GROUND };
        let scene = xml(&format!("{OVERHEAD}{ground}{objects}"));
        for (x, error) in [(0.3, 0.01), (0.05, 0.05)] {
            let share = share(&scene, &down_at(x), [1.5, 0.0, 7.0], (1 << 10, 8));
            assert!((share - 1.0).abs() < error, "{cut} at {x}: {share}");
        }
    }
}

/// Light that the wall itself mirrors falls off away from it: what is left of the disc is darker
/// than the point.
#[test]
fn the_slope_of_light_beside_a_wall_is_made_up_for() {
    let scene = xml("<object type='plane' material='white'><scale value='20'/></object>
        <object type='plane' material='mirror'><scale value='4'/><rotate angle='90' y='1'/></object>
        <material name='white'><diffuse value='1'/><specular value='0'/></material>
        <material name='mirror'><diffuse value='0'/><specular value='0'/><reflection value='1'/></material>
        <light type='point'><intensity value='8'/><attenuation value='1'/>
        <position x='2' z='3'/></light>");
    let share = share(&scene, &down_at(0.3), [-2.0, 0.0, 3.0], (1 << 12, 8));
    assert!((share - 1.0).abs() < 0.01, "{share}");
}

/// A table of which some or all places of the disc around its points, with a radius of .7, miss: it is
/// as bright as it would be as a part of a larger one.
#[test]
fn photons_on_what_is_much_smaller_than_the_disc_are_divided_by_that() {
    for half in [0.05, 0.1] {
        let scene = xml(&format!(
            "{OVERHEAD}<object type='plane' material='white'><scale value='{half}'/>
             <translate x='1.5'/></object>
             <object type='plane' material='white'><scale value='20'/><translate z='-1'/></object>"
        ));
        let ray = |number: u32| {
            let along = |number: u32| half * (f64::from(number) - 1.5) / 2.0;
            let (x, y) = (1.5 + along(number % 4), along(number / 4));
            ray([x + 0.001, y, 0.002], [x, y, 0.0])
        };
        let rays: Vec<_> = (0..16).map(ray).collect();
        let share = share(&scene, &rays, [1.5, 0.0, 7.0], (1 << 10, 24));
        assert!((share - 1.0).abs() < 0.15, "{half}: {share}");
    }
}

/// The light that a small table gets as a whole, all of it near an edge or beside what stands on it, by
/// photons and by paths.
#[test]
fn photons_on_a_small_table_bring_what_paths_find() {
    let scene = xml("<object type='plane' material='white'/>
        <object type='sphere' material='glass'><scale value='.4'/><translate x='.5' z='.5'/></object>
        <object type='sphere' material='black'><scale value='.3'/><translate x='-.4' z='.2'/></object>
        <material name='white'><diffuse value='1'/><specular value='0'/></material>
        <material name='black'><diffuse value='0'/><specular value='0'/></material>
        <material name='glass'><diffuse value='0'/><specular value='0'/>
        <refraction value='1' index='1.5'/></material>
        <light type='point'><intensity value='8'/><position x='-1' z='3'/><size value='.7'/>
        <attenuation value='1'/></light>");
    let rays = onto_ground(0.99, 256);
    assert_alike_along(&rays, &scene, PHOTONS, 5, "a small table");
}
