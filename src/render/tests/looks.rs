//! Cost, samples and noise of light, texture coordinates and sides, and exposure.

use super::*;
use crate::Aov;
use scene::Emitter;

const SIZE: [u32; 2] = [41, 31];
const CENTRE: usize = 15 * 41 + 20;

/// A white ball in the middle, lit from the eye.
fn ball() -> Arc<Scene> {
    let white = Coefficients {
        diffuse: Rgb::splat(0.6),
        ..grey(0.1)
    };
    let ball = (sphere([0.0; 3], 1.0), white);
    Arc::new(scene(&[ball], &[white_light([0.0, 0.0, 5.0])]))
}

fn seen(integrator: Integrator, spp: u32, aov: Option<Aov>) -> Settings {
    let [width, height] = SIZE;
    Settings {
        integrator,
        aov,
        // One bounce: paths that leave the ball end in the void.
        depth: 1,
        ..settings(width, height, spp)
    }
}

/// The last frame of a job.
fn frame(job: Job) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(2);
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

/// A lit pixel costs a camera ray and a shadow ray, and by paths the ray of the bounce too; one that
/// misses costs a camera ray.
#[test]
fn cost_counts_all_rays_of_a_pixel() {
    for (integrator, lit) in [(Integrator::Whitted, 2.0), (Integrator::Path, 3.0)] {
        for (frames, spp) in [
            (Frames::Live, 1),
            (Frames::Live, 4),
            (Frames::LastWithValues, 4),
        ] {
            let job = Job {
                frames,
                ..job(&ball(), seen(integrator, spp, Some(Aov::Cost)))
            };
            let frame = frame(job);
            assert_eq!(frame.values[CENTRE], [lit; 3], "{integrator:?} {frames:?}");
            assert_eq!(frame.values[0], [1.0; 3]);
            assert_eq!(frame.range, Some([1.0, lit.into()]));
            let rays: f32 = frame.values.iter().map(|value| value[0]).sum();
            assert_eq!((rays * spp as f32) as u64, frame.progress.rays);
        }
    }
}

/// The cost of glass over a mirror is that of its whole tree of rays.
#[test]
fn cost_includes_secondary_rays() {
    let glass = Coefficients {
        reflection: 0.5,
        transmission: 0.5,
        index: 1.5,
        ..grey(0.1)
    };
    let scene = scene(&[(sphere([0.0; 3], 1.0), glass)], &[]);
    // At depth 1: the camera ray, the mirrored and the refracted one.
    for (depth, rays) in [(0, 1), (1, 3)] {
        let (seen, _) = look(scene.clone(), depth, ray([0.0, 0.3, 5.0], [0.0, 0.0, 0.0]));
        assert_eq!(seen.rays, rays, "depth {depth}");
    }
}

#[test]
fn switching_between_light_and_its_aovs_traces_nothing() {
    let (mut renderer, woken) = renderer(2);
    let mut show = |aov| {
        let job = job(&ball(), seen(Integrator::Path, 8, aov));
        let generation = restart(&mut renderer, job);
        finish(&renderer, &woken, generation)
    };
    let light = show(None);
    assert!(0 < light.progress.rays);
    for aov in [Aov::Cost, Aov::Samples, Aov::Noise] {
        let reused = show(Some(aov));
        // The rays of the light count on.
        assert_eq!(reused.progress.rays, light.progress.rays, "{aov:?}");
        assert_eq!(reused.progress.noise, light.progress.noise);
        let anew = frame(job(&ball(), seen(Integrator::Path, 8, Some(aov))));
        assert_eq!(
            (&reused.pixels, &reused.values),
            (&anew.pixels, &anew.values)
        );
        assert_eq!((&reused.errors, reused.range), (&light.errors, anew.range));
    }
    let again = show(None);
    assert_eq!(again.progress.rays, light.progress.rays);
    assert_eq!(again.pixels, light.pixels);
    let side = show(Some(Aov::Side));
    assert_ne!(side.progress.rays, light.progress.rays);
}

/// What the picture's noise averages is the noise of its pixels.
#[test]
fn the_errors_of_pixels_add_up_to_the_noise_of_the_picture() {
    let noisy = frame(job(&ball(), seen(Integrator::Path, 4, Some(Aov::Noise))));
    let squares = |errors: &mut dyn Iterator<Item = f32>| -> f64 {
        errors.map(|error| f64::from(error).powi(2)).sum()
    };
    let noise = noisy.progress.noise.expect("the samples were doubled");
    let mean = squares(&mut noisy.errors.iter().copied()) / noisy.errors.len() as f64;
    assert_near(mean.sqrt(), noise, 1e-6);
    let shown: Vec<f32> = noisy.values.iter().map(|value| value[0]).collect();
    assert_eq!(shown, noisy.errors);
    let most = shown.iter().copied().fold(0.0, f32::max);
    assert!(0.0 < most && noisy.range == Some([0.0, most.into()]));
    let once = frame(job(&ball(), seen(Integrator::Path, 1, None)));
    assert!(once.errors.is_empty());
}

#[test]
fn samples_are_those_taken() {
    let frame = frame(job(
        &ball(),
        seen(Integrator::Whitted, 6, Some(Aov::Samples)),
    ));
    assert!(frame.values.iter().all(|value| *value == [6.0; 3]));
}

/// A sphere's texture begins and ends at −x, and its v rises along z.
#[test]
fn coordinates_and_sides_are_those_of_the_first_surface() {
    let inside = |aov| {
        let mut scene = (*ball()).clone();
        scene.camera.depths = [4.5, 100.0];
        let [width, height] = SIZE;
        let settings = Settings {
            aov,
            ..settings(width, height, 1)
        };
        Job {
            camera: scene.camera,
            ..job(&Arc::new(scene), settings)
        }
    };
    let outside = |aov| job(&ball(), seen(Integrator::Whitted, 1, aov));
    for (job, side, colour, v) in [
        (outside(None), 1.0, [0, 114, 178], 1.0),
        (inside(None), -1.0, [213, 94, 0], 0.0),
    ] {
        let of = |aov| {
            let mut job = job.clone();
            job.settings.aov = Some(aov);
            frame(job)
        };
        let sides = of(Aov::Side);
        assert_eq!(sides.values[CENTRE], [side; 3]);
        assert_eq!(sides.pixels[CENTRE], colour);
        assert_eq!((sides.values[0], sides.pixels[0]), ([0.0; 3], [0; 3]));
        let coordinates = of(Aov::Uv);
        assert_near(coordinates.values[CENTRE][1].into(), v, 1e-6);
        assert_eq!(coordinates.values[0], [0.0; 3]);
    }
}

/// A white ball over a mirror, lit by a point, a light with a size and a distant one.
fn shares_scene() -> Arc<Scene> {
    let white = Coefficients {
        diffuse: Rgb::splat(0.6),
        specular: Rgb::splat(0.2),
        exponent: 20.0,
        ..grey(0.1)
    };
    let mirror = Coefficients {
        reflection: 0.7,
        ..white
    };
    let objects = [
        (sphere([0.0, 0.5, 0.0], 1.0), white),
        (cuboid([-3.0, -1.5, -3.0], [6.0, 1.0, 6.0]), mirror),
    ];
    let mut sized = Light::point(DVec3::new(-2.0, 2.5, 1.0), Rgb::new(6.0, 5.0, 4.0));
    if let Emitter::Point { radius, .. } = &mut sized.emitter {
        *radius = 0.4;
    }
    let mut scene = scene(&objects, &[white_light([3.0, 4.0, 5.0]), sized]);
    scene.setting.background.colour = Rgb::new(0.1, 0.2, 0.4);
    scene.materials[0].emission = Rgb::new(0.0, 0.1, 0.05);
    Arc::new(scene)
}

/// Every share takes the same samples as the whole, so that they add up but for rounding.
#[test]
fn the_shares_of_the_lights_emission_and_indirect_light_add_up() {
    let scene = shares_scene();
    for integrator in Integrator::ALL {
        shares_add_up(&scene, integrator);
    }
    let mut many = Scene::clone(&scene);
    many.lights = many.lights.repeat(9);
    for (number, light) in many.lights.iter_mut().enumerate() {
        if let Emitter::Point { position, .. } = &mut light.emitter {
            position.x += 0.5 * number as f64;
        }
    }
    shares_add_up(&Arc::new(many), Integrator::Path);
}

fn shares_add_up(scene: &Arc<Scene>, integrator: Integrator) {
    let values = |aov| {
        let settings = Settings {
            depth: 4,
            falloff: FalloffRule::Square,
            ..seen(integrator, 4, aov)
        };
        frame(job(scene, settings)).values.clone()
    };
    let whole = values(None);
    let direct = (0..scene.lights.len() as u32).map(Aov::Direct);
    let shares = direct.chain([Aov::Emission, Aov::Indirect]);
    let shares: Vec<_> = shares.map(|share| values(Some(share))).collect();
    for (at, whole) in whole.iter().enumerate() {
        for channel in 0..3 {
            let sum: f32 = shares.iter().map(|share| share[at][channel]).sum();
            let off = (sum - whole[channel]).abs();
            assert!(
                off <= 1e-5 * whole[channel].max(1.0),
                "{integrator:?} {at}: {sum}"
            );
        }
    }
    for share in shares {
        assert!(share.iter().any(|value| value[0] != 0.0 || value[1] != 0.0));
        assert_ne!(share, whole);
    }
}

#[test]
fn live_frames_carry_the_values_that_files_hold() {
    let of = |frames, exposure| {
        let settings = Settings {
            exposure,
            ..seen(Integrator::Whitted, 4, None)
        };
        frame(Job {
            frames,
            ..job(&ball(), settings)
        })
    };
    let live = of(Frames::Live, 0.0);
    assert_eq!(live.values, of(Frames::LastWithValues, 0.0).values);
    assert!(of(Frames::Last, 0.0).values.is_empty());
    // Doubling is exact.
    let brighter = of(Frames::Live, 1.0);
    let doubled: Vec<_> = live
        .values
        .iter()
        .map(|value| value.map(|x| 2.0 * x))
        .collect();
    assert_eq!(brighter.values, doubled);
    assert_ne!(brighter.pixels, live.pixels);
}
