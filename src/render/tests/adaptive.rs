//! Adaptive sampling, against uniform pictures of which each pixel shows the one it stopped at.

use super::blocks::assert_same;
use super::noise::wall;
use super::progress::still;
use super::*;
use crate::{Aov, Region};

fn adaptive(settings: Settings, limit: f64) -> Settings {
    Settings {
        noise: limit,
        ..settings
    }
}

fn with_aov(settings: Settings, aov: Aov) -> Settings {
    Settings {
        aov: Some(aov),
        ..settings
    }
}

fn traced(scene: &Arc<Scene>, settings: Settings, threads: usize) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(threads);
    let job = Job {
        frames: Frames::LastWithValues,
        ..job(scene, settings)
    };
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

/// The number of samples of each pixel, computed from the errors of uniform pictures.
fn expected_samples(scene: &Arc<Scene>, uniform: Settings, limit: f64) -> Vec<u32> {
    let Size { width, height } = uniform.size;
    let all: Vec<_> = (0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .collect();
    let mut samples = vec![uniform.spp.min(16); all.len()];
    // The last error of each pixel.
    let mut errors = vec![0.0; all.len()];
    let mut taken = 16;
    while taken < uniform.spp {
        let at = Settings {
            spp: taken,
            ..with_aov(uniform, Aov::Noise)
        };
        let present = traced(scene, at, 2);
        for (at, error) in errors.iter_mut().enumerate() {
            if samples[at] == taken {
                *error = present.values[at][0];
            }
        }
        let is_in = |[x, y]: [u32; 2], square: [u32; 2]| [x / 4, y / 4] == square;
        let noise = |square: [u32; 2]| {
            let errors = all.iter().zip(&errors);
            let own = errors.filter(|(pixel, _)| is_in(**pixel, square));
            let squares: Vec<_> = own.map(|(_, error)| f64::from(*error).powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let next = (2 * taken).min(uniform.spp);
        let before = samples.clone();
        for (at, &[x, y]) in all.iter().enumerate() {
            let near = all.iter().copied().filter(|&[other_x, other_y]| {
                [other_x / 32, other_y / 32] == [x / 32, y / 32]
                    && (other_x / 4).abs_diff(x / 4) <= 1
                    && (other_y / 4).abs_diff(y / 4) <= 1
            });
            let mut squares: Vec<_> = near.map(|[x, y]| [x / 4, y / 4]).collect();
            squares.dedup();
            if before[at] == taken && squares.into_iter().any(|square| limit <= noise(square)) {
                samples[at] = next;
            }
        }
        taken = next;
    }
    samples
}

#[track_caller]
fn assert_expected(scene: &Arc<Scene>, uniform: Settings, limit: f64) {
    let expected = expected_samples(scene, uniform, limit);
    let mut kinds = expected.clone();
    kinds.sort_unstable();
    kinds.dedup();
    assert!(1 < kinds.len(), "it tells nothing: all have {kinds:?}");
    let settings = adaptive(uniform, limit);
    let samples = traced(scene, with_aov(settings, Aov::Samples), 2);
    let shown: Vec<_> = samples.values.iter().map(|value| value[0] as u32).collect();
    assert!(shown == expected);
    let mean = expected.iter().copied().map(f64::from).sum::<f64>() / expected.len() as f64;
    assert_near(samples.progress.mean_spp, mean, 1e-9);
    assert_eq!(Some(&samples.progress.spp), kinds.last());
    let picture = traced(scene, settings, 2);
    for spp in kinds {
        let uniform = traced(scene, Settings { spp, ..uniform }, 2);
        for (at, samples) in expected.iter().enumerate() {
            assert!(*samples != spp || picture.values[at] == uniform.values[at]);
        }
    }
}

#[test]
fn each_pixel_stops_where_its_square_and_those_around_are_below_the_noise() {
    assert_expected(&wall(), settings(70, 41, 64), 0.055);
    // The last pass is no doubling.
    assert_expected(&wall(), settings(40, 30, 40), 0.055);
}

#[test]
fn adaptive_pictures_are_the_same_for_any_number_of_threads() {
    let settings = adaptive(settings(70, 41, 256), 0.05);
    let alone = traced(&wall(), settings, 1);
    for threads in [2, 8] {
        let together = traced(&wall(), settings, threads);
        assert!(together.values == alone.values);
        assert_eq!(together.progress.noise, alone.progress.noise);
        assert_eq!(together.progress.mean_spp, alone.progress.mean_spp);
    }
}

#[test]
fn adaptive_pictures_of_blocks_are_those_of_a_renderer() {
    let scene = wall();
    for (size, spp) in [
        ((75, 40), 128),
        ((300, 3), 64),
        ((6, 70), 64),
        ((1, 1), 32),
        ((75, 40), 40),
    ] {
        assert_same(&scene, adaptive(settings(size.0, size.1, spp), 0.05), None);
    }
    assert_same(&scene, adaptive(settings(75, 40, 100), 0.05), Some(200));
    let region = Settings {
        region: Some(Region {
            x: 7,
            y: 3,
            width: 40,
            height: 35,
        }),
        ..settings(75, 40, 64)
    };
    assert_same(&scene, adaptive(region, 0.05), None);
    let samples = with_aov(settings(75, 40, 64), Aov::Samples);
    assert_same(&scene, adaptive(samples, 0.05), None);
}

#[test]
fn a_stopped_adaptive_picture_continues_to_the_same_one() {
    for (width, height) in [(70, 50), (300, 4)] {
        let settings = adaptive(settings(width, height, 128), 0.02);
        let scene = still();
        let alone = traced(&scene, settings, 2);
        let (mut renderer, woken) = renderer(2);
        // Stopped at a different frame each time.
        for frames in 1..6 {
            restart(&mut renderer, job(&scene, settings));
            for _ in 0..frames {
                woken.recv().expect("a frame");
                if renderer
                    .latest()
                    .is_some_and(|frame| frame.progress.complete)
                {
                    break;
                }
            }
            renderer.stop();
        }
        let generation = restart(&mut renderer, job(&scene, settings));
        let frame = finish(&renderer, &woken, generation);
        assert!(frame.pixels == alone.pixels);
        assert_eq!(frame.progress.mean_spp, alone.progress.mean_spp);
    }
}

#[test]
fn an_adaptive_picture_follows_edits_and_other_limits() {
    let scene = still();
    let mut edited = (*scene).clone();
    edited.materials[0].diffuse = Rgb::new(0.9, 0.1, 0.4);
    let edited = Arc::new(edited);
    let base = settings(48, 36, 32);
    let (mut renderer, woken) = renderer(2);
    for (scene, settings) in [
        (&scene, adaptive(base, 0.02)),
        (&edited, adaptive(base, 0.02)),
        (&edited, adaptive(base, 0.01)),
        (&edited, base),
        (&scene, adaptive(Settings { spp: 64, ..base }, 0.01)),
        (&scene, adaptive(base, 0.01)),
    ] {
        let generation = restart(&mut renderer, job(scene, settings));
        let frame = finish(&renderer, &woken, generation);
        assert!(frame.pixels == traced(scene, settings, 2).pixels);
    }
}

#[test]
fn surfaces_and_shares_of_the_light_are_sampled_uniformly() {
    let scene = still();
    for aov in [Aov::Albedo, Aov::Direct(0)] {
        let uniform = with_aov(settings(40, 30, 32), aov);
        let frame = traced(&scene, adaptive(uniform, 0.5), 2);
        assert!(frame.values == traced(&scene, uniform, 2).values);
        assert_eq!(frame.progress.mean_spp, 32.0);
    }
}

#[test]
fn clamped_samples_keep_their_hue() {
    let mut scene = scene(&[(sphere([0.0; 3], 90.0), BLACK)], &[]);
    scene.materials[0].ambient = Some(Rgb::new(8.0, 2.0, 0.0));
    let scene = Arc::new(scene);
    let shown = |clamp| {
        let settings = Settings {
            clamp,
            ..settings(4, 4, 4)
        };
        traced(&scene, settings, 1).values[0]
    };
    assert_eq!(shown(0.0), [8.0, 2.0, 0.0]);
    assert_eq!(shown(9.0), [8.0, 2.0, 0.0]);
    assert_eq!(shown(2.0), [2.0, 0.5, 0.0]);
}
