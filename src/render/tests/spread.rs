//! Distributed directions and positions: rough mirrors, lights with a size, lenses.

use super::highlights::GROUND;
use super::*;

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
