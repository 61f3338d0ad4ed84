//! Distributed directions and positions: rough mirrors, lights with a size, lenses.

use super::highlights::GROUND;
use super::*;

/// The mean of a ray's radiance over many samples of one pixel.
fn mean(scene: &str, ray: Ray, samples: u32) -> f64 {
    mean_by((Integrator::Whitted, PATHS), scene, ray, samples)
}

/// The same by an integrator, with rules.
fn mean_by(
    (integrator, rules): (Integrator, WorldSettings),
    scene: &str,
    ray: Ray,
    samples: u32,
) -> f64 {
    let scene = Arc::new(xml(scene));
    let world = World::build(scene, &Images::default(), rules, None, &|| false);
    let world = world.expect("nothing cancels the building");
    let mut tracer = Tracer::new(&world, integrator, 1, &|| false);
    let each = (0..samples).map(|index| {
        let sample = Sample {
            sampler: Sampler::new(0, 0, index, 0),
            ..centred(ray, f64::INFINITY)
        };
        tracer.radiance(&sample).radiance.x
    });
    each.sum::<f64>() / f64::from(samples)
}

/// A cone with half angle tangent ½ around a glowing ball of half its width: the fraction (1 − cos
/// β) / (1 − cos α) of its directions hits the ball. The same holds for refraction without bending.
#[test]
fn spread_rays_fill_their_cone_uniformly() {
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

/// Seen from straight above, a facet at angle θ off the normal N turns the view by 2θ, and P(θ < t) =
/// 1 − cos^(g+1) t: the fraction of directions that hit a glowing ball of angular radius β about N is
/// 1 − cos^(g+1)(β / 2). Behind the surface, glass turns the view by θ − asin(sin θ / 1.5), and passes
/// 1 − F at angle θ.
#[test]
fn exponents_spread_mirrors_and_glass_about_their_half_vectors() {
    let below = |exponent: f64, narrow: f64| {
        // By the midpoints of equal probabilities.
        const STEPS: u32 = 100_000;
        let passes = (0..STEPS).map(|step| {
            let share = (f64::from(step) + 0.5) / f64::from(STEPS);
            let cosine = (1.0 - share).powf(1.0 / (exponent + 1.0));
            let angle = cosine.acos();
            let turned = angle - (angle.sin() / 1.5).asin();
            let reflected = 0.04 + 0.96 * (1.0 - cosine).powi(5);
            if turned < narrow {
                1.0 - reflected
            } else {
                0.0
            }
        });
        passes.sum::<f64>() / f64::from(STEPS)
    };
    let spread = WorldSettings {
        gloss: GlossRule::Exponent,
        ..PATHS
    };
    for (exponent, narrow) in [(8.0, 0.3), (20.0, 0.2), (200.0, 0.1)] {
        let radius = 5.0 * f64::sin(narrow);
        let scene = |material: &str, kind: &str, z: f64| {
            format!(
                "{GROUND}<material name='m' type='{kind}'><diffuse value='0'/><specular value='0'/>
                 <glossiness value='{exponent}'/>{material}</material>
                 <material name='glow'><diffuse value='0'/><specular value='0'/><emission value='1'/>
                 </material><object type='sphere' material='glow'><scale value='{radius}'/>
                 <translate z='{z}'/></object>"
            )
        };
        // The cone of the slot is ignored.
        let mirror = "<reflection value='1' glossiness='.7'/>";
        let glass = "<refraction value='1' index='1.5'/>";
        let down = ray([0.0, 0.0, 1.0], [0.0; 3]);
        let above = 1.0 - f64::cos(narrow / 2.0).powf(exponent + 1.0);
        for integrator in Integrator::ALL {
            for (scene, expected) in [
                (scene(mirror, "blinn", 5.0), above),
                (scene(glass, "blinn", -5.0), below(exponent, narrow)),
            ] {
                let seen = mean_by((integrator, spread), &scene, down, 1 << 14);
                assert!(
                    (seen - expected).abs() < 4e-3,
                    "{exponent}: {seen} is not {expected}"
                );
            }
            // A phong material is not spread by its exponent.
            let phong = scene("<reflection value='1'/>", "phong", 5.0);
            assert_near(mean_by((integrator, spread), &phong, down, 16), 1.0, 0.0);
        }
        // The first sample is at the centre.
        let centre = mean_by(
            (Integrator::Whitted, spread),
            &scene(mirror, "blinn", 5.0),
            down,
            1,
        );
        assert_near(centre, 1.0, 0.0);
    }
}

/// A plane whose edge lies below the centre of a light hides half of it.
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
    // Without occlusion, the mean of N·L over a cone is ½ (1 + cos), with cos = √15 / 4.
    let whole = 0.5 * (1.0 + 15.0f64.sqrt() / 4.0);
    assert_near(mean(&scene(0.0), down, 4096), 0.5 * whole, 1e-3);
    assert_near(mean(&scene(5.0), down, 4096), whole, 1e-4);
    assert_near(mean(&scene(-5.0), down, 4096), 0.0, 0.0);
    // The first sample uses the centre only.
    assert_near(mean(&scene(0.01), down, 1), 1.0, 0.0);
    assert_near(mean(&scene(-0.01), down, 1), 0.0, 0.0);
}

/// The edge of a half plane at twice the focal distance: a lens of radius r sees it through a disc
/// of radius r there; at the focal distance it is sharp.
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
        let projection = crate::world::Projection::new(&scene.camera, scene.camera.size);
        let world = world(scene);
        let mut tracer = tracer(&world, 0);
        let count = 4096;
        let each = (0..count).map(|index| {
            let sampler = Sampler::new(0, 0, index, 0);
            let lens = || sampler.pair(Sampler::ROOT, crate::sampling::Purpose::Lens);
            let (ray, reach) = projection.ray(0.5, 0.5, lens);
            tracer.radiance(&centred(ray, reach)).radiance.x
        });
        each.sum::<f64>() / f64::from(count)
    };
    // The fraction of a unit disc beyond half its radius: (acos ½ − ½ √¾) / π.
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
