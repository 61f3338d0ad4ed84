//! What trials of settings show, given the pictures.

use std::ops::ControlFlow;

use super::*;
use crate::{Advice, Fault, SettingSearch};
use scene::Rendering;

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

/// The depths of what is tried where pictures are as bright as `shade` says, and the advice.
fn advice(trials: SettingSearch, shade: impl Fn(&Settings) -> f32) -> (Vec<u32>, Option<Advice>) {
    let mut tried = Vec::new();
    let mut next = trials;
    loop {
        let settings = next.settings();
        assert_eq!((settings.noise, settings.aov), (0.0, None));
        tried.push(settings.depth);
        match next.after(&picture(settings.size, shade(&settings))) {
            ControlFlow::Continue(trials) => next = trials,
            ControlFlow::Break(advice) => return (tried, advice),
        }
    }
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
        let trials = SettingSearch::of_scene(&scene, &settings(integrator, depth), None);
        let trials = trials.expect("it is small");
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
        (3.0, 0.4, Some(Fault::Overexposed), depth(2)),
        (3.0, 0.01, Some(Fault::Overexposed), exposure(-2.0)),
        (0.05, 0.4, Some(Fault::Black(13)), exposure(4.0)),
        (0.0, 0.4, Some(Fault::Black(0)), None),
    ] {
        let scene = reflecting(1.5, 0.0);
        let trials = SettingSearch::of_scene(&scene, &settings(Integrator::Path, 4), None);
        let trials = trials.expect("it is small");
        let shade = |settings: &Settings| if settings.depth == 4 { now } else { by_depth };
        let expected = fault.map(|fault| Advice { fault, cure });
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
        let trials = SettingSearch::of_scene(&reflecting(0.5, 0.0), &settings, None);
        assert_eq!(trials.expect("it is small").settings().size, expected);
    }
}
