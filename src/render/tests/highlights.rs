//! Direct light, highlights of each kind and opaque shadows, against values computed by hand.

use super::*;

/// The radiance along a ray, followed up to `bounces` bounces.
pub(super) fn brings(scene: &str, bounces: u32, ray: Ray) -> Rgb {
    look(xml(scene), bounces, ray).0.radiance
}

pub(super) fn assert_colour(seen: Rgb, expected: Rgb, case: &str) {
    assert!(
        (seen - expected).abs().max_element() < 1e-12,
        "{case}: {seen} is not {expected}"
    );
}

pub(super) const GROUND: &str = "<object type='plane' material='m'><scale value='100'/></object>";

/// The ground at the origin, seen from above at 45°.
pub(super) fn ground(material: &str, lights: &str) -> Rgb {
    let scene = format!("{GROUND}{material}{lights}");
    brings(&scene, 0, ray([1.0, 0.0, 1.0], [0.0; 3]))
}

/// Eye at 45°; light from straight above: N·L = 1, H is 22.5° off N, R is vertical and 45° off the
/// eye. Light from 45° on the other side: N·L = √½, H = N, R = V.
#[test]
fn highlights_of_blinn_and_phong() {
    let material = |kind: &str| {
        format!(
            "<material type='{kind}' name='m'><diffuse r='.5' g='.25' b='0'/>
             <specular value='.75'/><glossiness value='10'/></material>"
        )
    };
    let diffuse = Rgb::new(0.5, 0.25, 0.0);
    let above = "<light type='direct'><intensity value='2'/><direction z='-1'/></light>";
    let across = "<light type='direct'><intensity value='1'/><direction x='3' z='-3'/></light>";
    let half = 0.5f64.sqrt();
    for (kind, light, expected) in [
        (
            "blinn",
            above,
            2.0 * (diffuse + 0.75 * 22.5f64.to_radians().cos().powi(10)),
        ),
        ("phong", above, 2.0 * (diffuse + 0.75 * half.powi(10))),
        ("blinn", across, half * (diffuse + 0.75)),
        ("phong", across, half * (diffuse + 0.75)),
        ("lambert", across, half * (diffuse + 0.75)),
    ] {
        // The light `across` comes from negative x and is mirrored exactly to the eye.
        let seen = ground(&material(kind), light);
        assert_colour(seen, expected, &format!("{kind} {light}"));
    }
}

/// Roughness ½: α = ¼, g = 2 · 16 − 2 = 30; half metallic: F0 = ½ .04 + ½ colour.
#[test]
fn microfacets_in_whitted_ray_tracing() {
    let material = "<material type='microfacet' name='m'><color r='1' g='.5' b='0'/>
        <roughness value='.5'/><metallic value='.5'/><ior value='1.5'/></material>";
    let light = "<light type='direct'><intensity value='1'/><direction z='-1'/></light>";
    let straight = Rgb::new(0.52, 0.27, 0.02);
    let diffuse = Rgb::new(0.5, 0.25, 0.0);
    let highlight = 22.5f64.to_radians().cos().powi(30);
    assert_colour(
        ground(material, light),
        diffuse + highlight * straight,
        "lit",
    );
    let mirrored = format!("{GROUND}{material}<environment value='2'/>");
    let seen = brings(&mirrored, 1, ray([1.0, 0.0, 1.0], [0.0; 3]));
    assert_colour(seen, 2.0 * straight, "mirrored");
    let perfect = material.replace("'.5'/><metallic", "'0'/><metallic");
    let across = "<light type='direct'><intensity value='1'/><direction x='1' z='-1'/></light>";
    let seen = ground(&perfect, across);
    assert!(seen.is_finite(), "{seen}");
}

#[test]
fn defaults_ambient_light_emission_and_no_material() {
    let ambient = "<light type='ambient'><intensity r='.5' g='1' b='2'/></light>";
    let level = Rgb::new(0.5, 1.0, 2.0);
    for (case, material, expected) in [
        ("diffuse .5", "<material name='m'/>", 0.5 * level),
        (
            "emission is added",
            "<material name='m'><emission value='3'/></material>",
            0.5 * level + 3.0,
        ),
        ("no such material", "", Rgb::ONE),
    ] {
        assert_colour(ground(material, ambient), expected, case);
    }
}

/// The light is 3 above the ground: I / (2·3)², on front and back faces alike.
#[test]
fn point_lights_fall_off_and_light_both_faces() {
    let matt = "<material name='m'><diffuse value='1'/><specular value='0'/></material>";
    let lamp = |z: f64, attenuation: f64| {
        format!(
            "<light type='point'><intensity value='36'/><position z='{z}'/>
             <attenuation value='{attenuation}'/></light>"
        )
    };
    for (attenuation, expected) in [(2.0, 1.0), (0.0, 36.0)] {
        let seen = ground(matt, &lamp(3.0, attenuation));
        assert_colour(seen, Rgb::splat(expected), "in front");
        let scene = format!("{GROUND}{matt}{}", lamp(-3.0, attenuation));
        let behind = ray([1.0, 0.0, -1.0], [0.0; 3]);
        assert_colour(brings(&scene, 0, behind), Rgb::splat(expected), "behind");
    }
    assert_colour(ground(matt, &lamp(-3.0, 0.0)), Rgb::ZERO, "the other side");
}

/// Glass blocks light like any other material.
#[test]
fn every_material_blocks_light() {
    let matt = "<material name='m'><diffuse value='1'/><specular value='0'/></material>
        <material name='glass'><refraction value='1' index='1.5'/></material>
        <light type='point'><intensity value='1'/><position z='5'/></light>";
    for (case, object, expected) in [
        ("nothing", "", 1.0),
        (
            "glass between",
            "<object type='sphere' material='glass'><translate z='3'/></object>",
            0.0,
        ),
        (
            "glass beyond the light",
            "<object type='sphere' material='glass'><translate z='7'/></object>",
            1.0,
        ),
        (
            "a plane between, from behind",
            "<object type='plane'><rotate x='1' angle='180'/><translate z='2'/></object>",
            0.0,
        ),
    ] {
        assert_colour(ground(matt, object), Rgb::splat(expected), case);
    }
    // A light at the shaded point has no direction.
    let inside = matt.replace("z='5'", "z='0'");
    assert_colour(ground(&inside, ""), Rgb::ZERO, "at the light");
}
