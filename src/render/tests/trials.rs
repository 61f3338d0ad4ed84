//! What trials of settings show, given the pictures.

use std::ops::ControlFlow;

use super::*;
use crate::render::{Advice, Fault, Trials, Tried};
use crate::scene::{FalloffRule, Rendering};

/// A scene with a material that sends back this much, and this environment.
fn reflecting(sent_back: f64, around: f64) -> Scene {
    let diffuse = Coefficients {
        diffuse: Rgb::splat(sent_back),
        ..BLACK
    };
    let mut scene = scene(&[(sphere([0.0; 3], 1.0), diffuse)], &[]);
    scene.ambient = Rgb::ZERO;
    scene.setting.environment = Tinted {
        colour: Rgb::splat(around),
        texture: None,
    };
    scene
}

fn settings(integrator: Integrator, depth: u32) -> Settings {
    let size = Size {
        width: 640,
        height: 480,
    };
    let asked = Rendering {
        integrator: Some(integrator),
        depth: Some(depth),
        noise: Some(0.1),
        ..Rendering::default()
    };
    Settings::new(size, &asked)
}

/// A picture three quarters of which are this bright, and the rest an eighth of that.
fn picture(size: Size, grey: f32) -> Frame {
    let column = |at: usize| at as u32 % size.width * 4 / size.width;
    let grey = |at: usize| if column(at) == 0 { 0.125 * grey } else { grey };
    Frame {
        values: (0..size.pixels()).map(|at| [grey(at); 3]).collect(),
        objects: vec![0; size.pixels()],
        ..Frame::drawn(size, Vec::new())
    }
}

/// What is tried where pictures are as bright as `shade` says and a sample takes so many rays, and the
/// advice.
fn tried(
    mut next: Tried,
    rate: u64,
    shade: impl Fn(&Settings) -> f32,
) -> (Vec<Settings>, Option<Advice>) {
    let mut tried = Vec::new();
    loop {
        let trials = match next {
            ControlFlow::Continue(trials) => trials,
            ControlFlow::Break(advice) => return (tried, advice),
        };
        let settings = trials.settings();
        assert_eq!((settings.noise, settings.aov), (None, None));
        tried.push(settings);
        let mut picture = picture(settings.size, shade(&settings));
        picture.progress.rays = rate * settings.size.pixels() as u64 * u64::from(settings.spp);
        next = trials.after(&picture);
    }
}

/// The depths of what is tried where pictures are as bright as `shade` says, and the advice.
fn advice(trials: Tried, shade: impl Fn(&Settings) -> f32) -> (Vec<u32>, Option<Advice>) {
    let (settings, advice) = tried(trials, 4, shade);
    let depths = settings.iter().map(|settings| settings.depth);
    (depths.collect(), advice)
}

#[test]
fn depths_are_tried_where_light_grows_or_comes_back_whole() {
    let (path, whitted) = (Integrator::Path, Integrator::Whitted);
    for (sent_back, around, integrator, depth, expected) in [
        (1.5, 0.0, path, 64, &[64, 64, 2, 4, 8, 16, 32][..]),
        (1.5, 0.0, path, 8, &[8, 8, 2, 4]),
        (1.0, 1.0, path, 4, &[4, 4, 1, 2]),
        (1.0, 0.0, path, 8, &[8, 8, 2, 4]),
        (0.9, 1.0, path, 64, &[64, 64]),
        (1.5, 1.0, whitted, 8, &[8, 8]),
    ] {
        let scene = reflecting(sent_back, around);
        let trials = Trials::of_scene(&scene, &settings(integrator, depth), None);
        // Bright only as it is.
        let shade = |settings: &Settings| if settings.depth == depth { 9.0 } else { 0.2 };
        assert_eq!(advice(trials, shade).0, expected, "{sent_back} {around}");
    }
}

#[test]
fn the_best_setting_is_named_and_none_that_does_not_help() {
    let exposure = |stops| {
        Some(Rendering {
            exposure: Some(stops),
            ..Rendering::default()
        })
    };
    let depth = |depth| {
        Some(Rendering {
            depth: Some(depth),
            ..Rendering::default()
        })
    };
    for (now, by_depth, fault, cure) in [
        (0.5, 0.2, None, None),
        // Noise may hide that a picture is too bright, or that it is not.
        (3.0, 0.4, Some(Fault::Burnt), depth(2)),
        (3.0, 0.01, Some(Fault::Burnt), exposure(-2.0)),
        (0.05, 0.4, Some(Fault::Black(13)), exposure(4.0)),
        (0.0, 0.4, Some(Fault::Black(0)), None),
    ] {
        let scene = reflecting(1.5, 0.0);
        let trials = Trials::of_scene(&scene, &settings(Integrator::Path, 4), None);
        let shade = |settings: &Settings| if settings.depth == 4 { now } else { by_depth };
        let expected = fault.map(|fault| Advice {
            fault,
            cure,
            is_tried: true,
        });
        assert_eq!(advice(trials, shade).1, expected, "{now}");
    }
}

#[test]
fn small_pictures_keep_the_shape() {
    for (size, expected) in [
        ([640, 480], [64, 48]),
        ([9, 5], [9, 5]),
        ([100_000, 1], [64, 1]),
        ([300, 400], [48, 64]),
    ] {
        let [size, expected] = [size, expected].map(|[width, height]| Size { width, height });
        let settings = Settings {
            size,
            ..settings(Integrator::Path, 4)
        };
        let trials = Trials::of_scene(&reflecting(0.5, 0.0), &settings, None);
        let ControlFlow::Continue(trials) = trials else {
            panic!("there is something to trace");
        };
        assert_eq!(trials.settings().size, expected);
    }
}

/// A scene that white lights light.
fn lit(lights: usize) -> Scene {
    let lights = vec![white_light([0.0, 0.0, 9.0]); lights];
    let mut scene = scene(&[(sphere([0.0; 3], 1.0), grey(0.5))], &lights);
    scene.ambient = Rgb::ZERO;
    scene
}

/// The longer sides and samples of all that is traced of a dark picture, whatever a sample takes.
#[test]
fn trials_take_a_limited_number_of_rays() {
    let (path, whitted, photon) = (Integrator::Path, Integrator::Whitted, Integrator::Photon);
    for (integrator, depth, lights, rate, expected) in [
        (whitted, 2, 1, 3, &[(64, 1), (64, 16), (512, 1)][..]),
        (whitted, 64, 1, 3, &[(4, 1), (64, 1), (64, 16), (512, 1)]),
        (whitted, 64, 0, 4096, &[(16, 1)]),
        (whitted, 4096, 9000, 9, &[]),
        (path, 8, 1, 6, &[(64, 1), (64, 16), (256, 1)]),
        (path, 4096, 1, 6, &[(4, 1), (64, 1), (64, 16), (256, 1)]),
        (path, 4096, 1, 200, &[(4, 1), (64, 1), (64, 2)]),
        (path, 4096, 1, 8000, &[(4, 1)]),
        (photon, 4096, 1, 6, &[(64, 1), (64, 1), (256, 1)]),
    ] {
        let scene = lit(lights);
        let trials = Trials::of_scene(&scene, &settings(integrator, depth), None);
        let (settings, _) = tried(trials, rate, |_| 1e-4);
        let traced = settings.iter().map(|it| (it.size.width, it.spp));
        assert_eq!(
            traced.collect::<Vec<_>>(),
            expected,
            "{depth} {lights} {rate}"
        );
        let samples = settings
            .iter()
            .map(|it| it.size.pixels() as u64 * u64::from(it.spp));
        assert!(samples.sum::<u64>() * rate <= 4_000_000, "{depth} {rate}");
    }
}

/// What the picture itself shows is said where nothing can be tried.
#[test]
fn a_fault_is_said_without_a_cure_where_trials_take_too_long() {
    let (scene, settings) = (lit(9000), settings(Integrator::Whitted, 64));
    for (grey, fault) in [
        (0.0, Some(Fault::Black(0))),
        (0.3, None),
        (2.0, Some(Fault::Burnt)),
    ] {
        let frame = picture(settings.size, grey);
        let (traced, advice) = tried(
            Trials::of_picture(&frame, &scene, &settings, None),
            1,
            |_| 1.0,
        );
        let expected = fault.map(|fault| Advice {
            fault,
            cure: None,
            is_tried: false,
        });
        assert_eq!((traced.len(), advice), (0, expected), "{grey}");
    }
}

/// Pictures of few samples, of which this share is bright and the rest black.
#[test]
fn noise_hides_no_fault_from_the_trials() {
    for (integrator, share, is_judged) in [
        (Integrator::Path, 0.2, true),
        (Integrator::Path, 0.3, false),
        (Integrator::Whitted, 0.009, true),
        (Integrator::Whitted, 0.02, false),
    ] {
        let (scene, settings) = (lit(1), settings(integrator, 8));
        let mut frame = picture(settings.size, 0.0);
        let lit = (share * frame.values.len() as f64) as usize;
        frame.values[..lit].fill([0.9; 3]);
        let (traced, advice) = tried(
            Trials::of_picture(&frame, &scene, &settings, None),
            4,
            |_| 0.05,
        );
        let fault = advice.map(|advice| advice.fault);
        assert_eq!(fault, is_judged.then_some(Fault::Black(13)), "{share}");
        assert_eq!(traced.is_empty(), !is_judged);
    }
}

/// A picture with a bright pixel in every square.
#[test]
fn single_bright_samples_do_not_hide_that_a_picture_is_black() {
    for (integrator, expected) in [
        (Integrator::Path, Some(Fault::Black(4))),
        (Integrator::Whitted, None),
    ] {
        let mut next = Trials::of_scene(&lit(1), &settings(integrator, 2), None);
        let advice = loop {
            let trials = match next {
                ControlFlow::Continue(trials) => trials,
                ControlFlow::Break(advice) => break advice,
            };
            let mut picture = picture(trials.settings().size, 0.0);
            let width = picture.size.width as usize;
            for (at, value) in picture.values.iter_mut().enumerate() {
                if (at % width % 8, at / width % 8) == (1, 2) {
                    *value = [50.0; 3];
                }
            }
            next = trials.after(&picture);
        };
        assert_eq!(advice.map(|advice| advice.fault), expected);
    }
}

/// What the text shows to be wrong is mended only by what is better than the picture itself.
#[test]
fn no_setting_is_named_with_which_a_picture_is_worse() {
    for (now, by_square, is_named) in [(0.3, 0.1, false), (0.3, 0.4, true)] {
        let settings = settings(Integrator::Photon, 8);
        let trials = Trials::of_scene(&lit(1), &settings, Some(Fault::WithoutPhotons));
        let (_, advice) = tried(trials, 4, |settings| match settings.falloff {
            FalloffRule::Square => by_square,
            FalloffRule::None => now,
        });
        let cure = advice.and_then(|advice| advice.cure);
        assert_eq!(cure.is_some(), is_named, "{now} {by_square}: {advice:?}");
    }
}
