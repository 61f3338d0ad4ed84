//! Noise estimates.

use glam::DVec2;

use super::*;
use crate::Aov;
use crate::engine::{Doubling, Step};

/// A wall of squares in two greys, with so many per pixel that samples are random.
pub(super) fn wall() -> Arc<Scene> {
    let wall = cuboid([-20.0, -15.0, -1.0], [40.0, 30.0, 1.0]);
    let mut scene = scene(&[(wall, BLACK)], &[]);
    scene.materials = [painted(grey(1.0), Some(0))].into_iter().collect();
    let repeat = DVec2::new(40.0 * 161.803_398_9, 30.0 * 141.421_356_2);
    scene.textures = vec![checker(repeat, [Rgb::splat(0.2), Rgb::splat(0.8)])];
    scene.camera.lens = Lens::Orthographic(30.0);
    Arc::new(scene)
}

fn traced(settings: Settings, threads: usize) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(threads);
    let job = Job {
        frames: Frames::LastWithValues,
        ..job(&wall(), settings)
    };
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

/// Means of n samples that are 0.2 or 0.8 deviate from 0.5 by 0.3 / √n.
#[test]
fn noise_matches_theory_and_the_picture_and_decreases() {
    for spp in [2, 4, 8, 16, 32] {
        let frame = traced(settings(40, 30, spp), 2);
        let noise = frame.progress.noise.expect("the samples were doubled");
        let theory = 0.3 / f64::from(spp).sqrt();
        assert_near(noise, theory, 0.2 * theory);
        let square = |value: &[f32; 3]| (f64::from(value[0]) - 0.5).powi(2);
        let mean = frame.values.iter().map(square).sum::<f64>() / frame.values.len() as f64;
        assert_near(noise, mean.sqrt(), 0.2 * theory);
    }
}

#[test]
fn noise_does_not_depend_on_the_number_of_threads() {
    let alone = traced(settings(40, 30, 8), 1).progress.noise;
    assert_eq!(traced(settings(40, 30, 8), 4).progress.noise, alone);
    // A last pass that does not double the samples keeps the estimate.
    assert_eq!(traced(settings(40, 30, 9), 2).progress.noise, alone);
}

#[test]
fn noise_is_unknown_for_one_sample_and_for_aovs() {
    assert_eq!(traced(settings(40, 30, 1), 1).progress.noise, None);
    let albedo = Settings {
        aov: Some(Aov::Albedo),
        ..settings(40, 30, 8)
    };
    assert_eq!(traced(albedo, 1).progress.noise, None);
}

/// The estimated error of a pixel, from its sums before and after a step.
fn error(step: &Step, transfer: Transfer, before: [f64; 3], after: [f64; 3]) -> f64 {
    let settings = Settings {
        transfer,
        ..settings(1, 1, 8)
    };
    let doubling = Doubling::of(step, &settings).expect("as many as before");
    doubling.squared_error(before.into(), after.into()).sqrt()
}

#[test]
fn an_error_is_half_the_difference_of_displayed_halves() {
    let check = |before, after, expected| {
        let error = error(&Step::Samples(4..8), Transfer::Linear, before, after);
        assert_eq!(error, expected, "{before:?} {after:?}");
    };
    // Means of 4 samples: 0.25 and 0.75 in red, equal in the other channels.
    check([1.0, 4.0, 0.0], [4.0, 8.0, 0.0], 0.25);
    // Values above white are displayed as white.
    check([4.0, 8.0, 400.0], [40.0, 800.0, 1000.0], 0.0);
    check([0.0; 3], [0.0, 0.0, f64::INFINITY], 0.5);
    check([0.0; 3], [f64::NAN; 3], 0.0);
    let curved = error(
        &Step::Samples(1..2),
        Transfer::Srgb,
        [0.0; 3],
        [0.001, 0.0, 0.0],
    );
    assert_near(curved, 0.5 * 0.012_92, 1e-12);
}
