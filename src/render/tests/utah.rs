//! The rules of `.xml`, each against a value worked out by hand.

use super::*;

/// What a ray that has bounced `bounces` times at most brings.
fn brings(scene: &str, bounces: u32, ray: Ray) -> Rgb {
    look(xml(scene), bounces, ray).0.radiance
}

fn assert_colour(seen: Rgb, expected: Rgb, case: &str) {
    assert!(
        (seen - expected).abs().max_element() < 1e-12,
        "{case}: {seen} is not {expected}"
    );
}

const GROUND: &str = "<object type='plane' material='m'><scale value='100'/></object>";

/// The ground at the origin, seen from above at 45°.
fn ground(material: &str, lights: &str) -> Rgb {
    let scene = format!("{GROUND}{material}{lights}");
    brings(&scene, 0, ray([1.0, 0.0, 1.0], [0.0; 3]))
}

/// Eye at 45°; light straight above: N·L = 1, H is 22.5° off, R is straight up, 45° off the eye.
/// Light from 45° on the other side: N·L = √½, H = N, R = V.
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
        // From the side where x grows negative the light across comes toward the eye's mirror image.
        let seen = ground(&material(kind), light);
        assert_colour(seen, expected, &format!("{kind} {light}"));
    }
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

/// The light stands 3 above the ground: I / (2·3)², and in front or behind alike.
#[test]
fn point_lights_fade_and_backs_are_lit_as_fronts() {
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

/// Glass is as good a blocker as any.
#[test]
fn anything_blocks_light() {
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
    // A light just where it shines has no direction.
    let inside = matt.replace("z='5'", "z='0'");
    assert_colour(ground(&inside, ""), Rgb::ZERO, "at the light");
}

/// A mirror of some colour under a sky of another; its back mirrors nothing.
#[test]
fn fronts_mirror_the_environment() {
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

/// What clear glass mirrors and what it lets through adds up to 1, whatever the way.
#[test]
fn clear_glass_in_an_even_environment_is_not_seen() {
    for index in [1.0, 1.5, 0.7, 2.4] {
        let scene = glass_ball(&format!("<refraction value='1' index='{index}'/>"));
        for aside in [0.0, 0.3, 0.6, 0.9, 0.99] {
            let seen = brings(&scene, 60, ray([aside, 0.0, 5.0], [aside, 0.0, 0.0]));
            // What is still inside after so many bounces is lost.
            assert_near(seen.x, 1.0, 1e-6);
        }
    }
}

/// Through the middle of a ball of diameter 2: F = .04 is mirrored; the rest loses A = e^−2a on each
/// way across and F of it stays in: F + (1 − F)² A / (1 − F A).
#[test]
fn absorption_goes_by_the_way_inside() {
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

/// From inside glass upward at its surface, 2 above a white floor: what is mirrored meets the floor
/// after 2 / cos θ. The critical angle of 1.5 is 41.8°.
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

/// Roughness ½: α = ¼, g = 2 · 16 − 2 = 30; half metal: F0 = ½ .04 + ½ colour.
#[test]
fn microfacets_without_paths() {
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

/// Plane: ((x + 1) / 2, (y + 1) / 2); sphere: longitude and latitude. Squares of half the width.
#[test]
fn places_on_planes_and_spheres() {
    let board = "<material name='m'><diffuse value='0'/><specular value='0'/>
        <emission texture='checkerboard'><color1 r='1' g='0' b='0'/><color2 r='0' g='0' b='1'/>
        </emission></material>";
    let (red, blue) = (Rgb::X, Rgb::Z);
    for (shape, from, to, expected) in [
        ("plane", [-0.5, -0.5, 1.0], [-0.5, -0.5, 0.0], red),
        ("plane", [0.5, -0.5, 1.0], [0.5, -0.5, 0.0], blue),
        ("plane", [0.5, 0.5, -1.0], [0.5, 0.5, 0.0], red),
        // −y is longitude u < ½, below the equator v < ½.
        ("sphere", [3.0, -3.0, -1.0], [0.0; 3], red),
        ("sphere", [3.0, -3.0, 1.0], [0.0; 3], blue),
        ("sphere", [3.0, 3.0, 1.0], [0.0; 3], red),
    ] {
        let scene = format!("<object type='{shape}' material='m'/>{board}");
        let seen = brings(&scene, 0, ray(from, to));
        assert_colour(seen, expected, &format!("{shape} {to:?} from {from:?}"));
    }
}

/// A board over the whole picture: quarters of it, each by its own pixel.
#[test]
fn the_background_goes_by_pixel() {
    let scene = xml_seen_by(
        "<camera><width value='4'/><height value='2'/></camera>",
        "<background texture='checkerboard'><color1 value='0'/><color2 value='1'/></background>",
    );
    let scene = Arc::new(scene);
    let (renderer, woken) = renderer(1);
    for spp in [1, 4] {
        let generation = restart(&renderer, job(&scene, settings(4, 2, spp)));
        let frame = finish(&renderer, &woken, generation);
        let row = frame
            .pixels
            .iter()
            .map(|pixel| pixel[0])
            .collect::<Vec<_>>();
        assert_eq!(row, [0, 0, 255, 255, 255, 255, 0, 0], "{spp}");
    }
}

/// The mean of a ray's radiance over many samples of one pixel.
fn mean(scene: &str, ray: Ray, samples: u32) -> f64 {
    let world = world(xml(scene));
    let mut tracer = tracer(&world, 1);
    let each = (0..samples).map(|index| {
        let sample = Sample {
            sampler: Sampler::new(0, 0, index, 0),
            ..centred(ray, f64::INFINITY)
        };
        tracer.radiance(&sample).radiance.x
    });
    each.sum::<f64>() / f64::from(samples)
}

/// A cone whose half angle has the tangent ½ around a glowing ball that takes half its width: of the
/// directions (1 − cos β) / (1 − cos α) meet the ball. Refracted without bending: the same.
#[test]
fn spread_rays_fill_their_cone_evenly() {
    let wide = 0.5f64.atan();
    let narrow = wide / 2.0;
    let expected = (1.0 - narrow.cos()) / (1.0 - wide.cos());
    let radius = 5.0 * narrow.sin();
    let glow = |z: f64| {
        format!(
            "<material name='glow'><diffuse value='0'/><specular value='0'/><emission value='1'/>
             </material><object type='sphere' material='glow'><scale value='{radius}'/>
             <translate z='{z}'/></object>"
        )
    };
    for (case, material, z) in [
        ("mirrored", "<reflection value='1' glossiness='.5'/>", 5.0),
        (
            "refracted",
            "<refraction value='1' glossiness='.5' index='1'/>",
            -5.0,
        ),
    ] {
        let scene = format!(
            "{GROUND}<material name='m'><diffuse value='0'/><specular value='0'/>{material}</material>{}",
            glow(z)
        );
        // Past the ball, whose surface begins at 5 − r.
        let down = ray([0.0, 0.0, 1.0], [0.0; 3]);
        for (samples, expected) in [(4096, expected), (1, 1.0)] {
            let seen = mean(&scene, down, samples);
            assert!((seen - expected).abs() < 2e-3, "{case}: {seen}");
        }
    }
}

/// A plane whose edge stands under the middle of a light hides half of it.
#[test]
fn shadows_of_a_large_light_are_soft() {
    let scene = |edge: f64| {
        format!(
            "{GROUND}<material name='m'><diffuse value='1'/><specular value='0'/></material>
             <light type='point'><intensity value='1'/><position z='4'/><size value='1'/></light>
             <object type='plane'><scale value='10'/><translate x='{}' z='2'/></object>",
            edge + 10.0
        )
    };
    let down = ray([-1.0, 0.0, 1.0], [0.0; 3]);
    // Nothing is hidden: the mean of N·L over a cone is ½ (1 + cos), with cos = √15 / 4.
    let whole = 0.5 * (1.0 + 15.0f64.sqrt() / 4.0);
    assert_near(mean(&scene(0.0), down, 4096), 0.5 * whole, 1e-3);
    assert_near(mean(&scene(5.0), down, 4096), whole, 1e-4);
    assert_near(mean(&scene(-5.0), down, 4096), 0.0, 0.0);
    // The first sample sees the middle only.
    assert_near(mean(&scene(0.01), down, 1), 1.0, 0.0);
    assert_near(mean(&scene(-0.01), down, 1), 0.0, 0.0);
}

/// The edge of a half plane at twice the focal distance: a lens of radius r sees it through a disc of
/// radius r there; at the focal distance it is sharp.
#[test]
fn a_lens_blurs_what_is_out_of_focus() {
    let share = |edge: f64, distance: f64| {
        let camera = "<camera><position z='0'/><target z='-1'/><fov value='40'/><dof value='.5'/>
             <focaldist value='4'/><width value='1'/><height value='1'/></camera>";
        let scene = format!(
            "<object type='plane'><scale value='50'/><translate x='{}' z='-{distance}'/></object>",
            edge + 50.0
        );
        let scene = xml_seen_by(camera, &scene);
        let projection = super::super::camera::Projection::new(&scene.camera, scene.camera.size);
        let world = world(scene);
        let mut tracer = tracer(&world, 0);
        let count = 4096;
        let each = (0..count).map(|index| {
            let sampler = Sampler::new(0, 0, index, 0);
            let lens = || sampler.pair(Sampler::ROOT, super::super::sampler::Use::Lens);
            let (ray, reach) = projection.ray(0.5, 0.5, lens);
            tracer.radiance(&centred(ray, reach)).radiance.x
        });
        each.sum::<f64>() / f64::from(count)
    };
    // Of a unit disc, what lies beyond half the radius: (acos ½ − ½ √¾) / π.
    let segment = (0.5f64.acos() - 0.5 * 0.75f64.sqrt()) / std::f64::consts::PI;
    for (edge, distance, expected) in [
        (0.0, 8.0, 0.5),
        (0.25, 8.0, segment),
        (-0.25, 8.0, 1.0 - segment),
        (0.6, 8.0, 0.0),
        (0.01, 4.0, 0.0),
        (-0.01, 4.0, 1.0),
    ] {
        assert_near(share(edge, distance), expected, 2e-3);
    }
}
