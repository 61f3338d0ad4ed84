//! Pixel filters.

use std::f64::consts::PI;

use super::*;

/// Where the white half of the picture begins, in pixels, which are one unit wide.
const EDGE: f64 = 0.3;

/// A picture of a vertical edge, eight pixels wide, black to its left.
fn edge(filter: Filter, spp: u32) -> Arc<Frame> {
    let white = cuboid([EDGE, -50.0, -1.0], [100.0, 100.0, 1.0]);
    let mut scene = scene(&[(white, grey(1.0))], &[]);
    scene.camera.lens = Lens::Orthographic(2.0);
    scene.camera.size = Size {
        width: 8,
        height: 2,
    };
    let scene = Arc::new(scene);
    let (mut renderer, woken) = renderer(1);
    let job = Job {
        frames: Frames::LastWithValues,
        ..job(
            &scene,
            Settings {
                filter,
                ..settings(8, 2, spp)
            },
        )
    };
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

/// The fraction of a filter beyond `from`, integrated over midpoints of its weights.
fn beyond(from: f64, weight: impl Fn(f64) -> f64) -> f64 {
    const PARTS: u32 = 30_000;
    let sum = |from: f64| -> f64 {
        let places = (0..PARTS).map(|part| 3.0 * (f64::from(part) + 0.5) / f64::from(PARTS) - 1.5);
        places.filter(|&place| from <= place).map(&weight).sum()
    };
    sum(from) / sum(-1.5)
}

/// The weights are written as in the definitions.
#[test]
fn an_edge_is_as_wide_as_the_filter() {
    let gaussian = |x: f64| (-x * x / (2.0 * 0.25)).exp();
    let window = |x: f64| {
        let angle = 2.0 * PI * (x / 3.0 + 0.5);
        0.35875 - 0.48829 * angle.cos() + 0.14128 * (2.0 * angle).cos()
            - 0.01168 * (3.0 * angle).cos()
    };
    let pixel = |x: f64| f64::from(u8::from(x.abs() <= 0.5));
    let check = |filter: Filter, weight: &dyn Fn(f64) -> f64| {
        let frame = edge(filter, 1024);
        for (at, value) in frame.values.iter().enumerate() {
            let centre = (at % 8) as f64 + 0.5 - 4.0;
            let share = beyond(EDGE - centre, weight);
            let error = (f64::from(value[0]) - share).abs();
            assert!(error < 2e-3, "{filter:?} {at}: {value:?} is not {share}");
        }
    };
    check(Filter::Box, &pixel);
    check(Filter::Gaussian, &gaussian);
    check(Filter::BlackmanHarris, &window);
}

/// The first sample is at each pixel's centre with every filter.
#[test]
fn one_sample_is_the_same_with_every_filter() {
    let boxed = edge(Filter::Box, 1);
    for filter in [Filter::Gaussian, Filter::BlackmanHarris] {
        assert_eq!(edge(filter, 1).pixels, boxed.pixels, "{filter:?}");
    }
}
