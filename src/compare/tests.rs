use super::*;

const SIZE: Size = Size {
    width: 48,
    height: 40,
};

type Channel = fn(u32, u32, u32) -> u32;

fn ramps(x: u32, y: u32, channel: u32) -> u32 {
    (4 * x + 3 * y + 40 * channel) % 256
}

/// Differs by at most 3 levels.
fn noisy(x: u32, y: u32, channel: u32) -> u32 {
    (ramps(x, y, channel) + x * y * (channel + 1) % 7).clamp(3, 258) - 3
}

/// Has a bright rectangle.
fn edged(x: u32, y: u32, channel: u32) -> u32 {
    if (20..30).contains(&x) && (10..25).contains(&y) {
        230
    } else {
        ramps(x, y, channel)
    }
}

fn inverse(x: u32, y: u32, channel: u32) -> u32 {
    255 - ramps(x, y, channel)
}

fn image(size: Size, channel: Channel) -> Image {
    let rows = 0..size.height;
    let places = rows.flat_map(|y| (0..size.width).map(move |x| (x, y)));
    let pixels = places.map(|(x, y)| [0, 1, 2].map(|at| channel(x, y, at) as u8));
    Image::new(size, pixels.collect()).expect("pixels for the size")
}

#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} is not {expected}"
    );
}

/// The figures are those of scikit-image 0.26 (`gaussian_weights=True, sigma=1.5,
/// use_sample_covariance=False, data_range=255, channel_axis=2`) and of flip-evaluator 1.7, which
/// computes in `f32`.
#[test]
fn figures_agree_with_independent_programs() {
    let cases: [(Channel, [f64; 6]); 3] = [
        (
            noisy,
            [1920.0, 3.0, 4.721_701, 41.389_818, 0.978_970_4, 0.030_443],
        ),
        (
            edged,
            [
                150.0,
                230.0,
                333.387_847,
                22.901_306,
                0.833_558_2,
                0.094_841,
            ],
        ),
        (
            inverse,
            [
                1920.0,
                255.0,
                21_939.666_667,
                4.718_503,
                -0.243_559_5,
                0.930_220,
            ],
        ),
    ];
    for (other, [differing, largest, mse, psnr, ssim, flip]) in cases {
        let found = Comparison::of(&image(SIZE, ramps), &image(SIZE, other), 0);
        let found = found.expect("equal sizes");
        assert_eq!(found.differing, differing as usize);
        assert_eq!(f64::from(found.largest), largest);
        assert_near(found.mse, mse, 1e-6);
        assert_near(found.psnr(), psnr, 1e-6);
        assert_near(found.ssim.expect("large enough"), ssim, 1e-7);
        assert_near(found.flip, flip, 1e-5);
    }
}

#[test]
fn equal_pictures_have_no_difference() {
    let picture = image(SIZE, ramps);
    let found = Comparison::of(&picture, &picture, 0).expect("equal sizes");
    assert_eq!((found.differing, found.largest), (0, 0));
    assert_eq!((found.mse, found.flip), (0.0, 0.0));
    assert_eq!(found.psnr(), f64::INFINITY);
    assert_near(found.ssim.expect("large enough"), 1.0, 1e-12);
    assert_eq!(found.worst, []);
}

#[test]
fn pixels_within_the_tolerance_do_not_count() {
    for (tolerance, differing) in [(2, true), (3, false)] {
        let found = Comparison::of(&image(SIZE, ramps), &image(SIZE, noisy), tolerance);
        assert_eq!(0 < found.expect("equal sizes").differing, differing);
    }
}

#[test]
fn small_pictures_have_no_structural_similarity() {
    for (width, height, fits) in [
        (10, 40, false),
        (40, 10, false),
        (11, 11, true),
        (1, 1, false),
    ] {
        let picture = image(Size { width, height }, ramps);
        let found = Comparison::of(&picture, &picture, 0).expect("equal sizes");
        assert_eq!(found.ssim.is_some(), fits, "{width}×{height}");
    }
}

#[test]
fn pictures_of_different_sizes_are_refused() {
    let other = Size {
        width: 40,
        height: 48,
    };
    let found = Comparison::of(&image(SIZE, ramps), &image(other, ramps), 0);
    assert_eq!(found, Err(SizesDiffer([SIZE, other])));
}

#[test]
fn the_worst_pixels_are_listed_one_a_tile_worst_first() {
    let black = image(SIZE, |_, _, _| 0);
    let spotted = image(SIZE, |x, y, channel| match (x, y, channel) {
        (3, 2, 0) => 9,
        (5, 2, 0) | (20, 20, _) => 10,
        (40, 39, 1) => 200,
        _ => 0,
    });
    let found = Comparison::of(&black, &spotted, 0).expect("equal sizes");
    let worst: Vec<_> = found.worst.iter().map(|found| (found.x, found.y)).collect();
    assert_eq!(worst, [(40, 39), (20, 20), (5, 2)]);
    assert_eq!(found.worst[0].colours, [[0, 0, 0], [0, 200, 0]]);
}

#[test]
fn the_heat_map_is_black_where_pictures_agree_and_white_where_they_differ_much() {
    let size = Size {
        width: 4,
        height: 1,
    };
    let levels: Channel = |x, _, channel| {
        let most = [0, 1, 64, 255][x as usize];
        if channel == 1 { most } else { 0 }
    };
    let [black, spotted] = [image(size, |_, _, _| 0), image(size, levels)];
    let map = heat_map(black.pixels(), spotted.pixels());
    assert_eq!([map[0], map[2], map[3]], [[0; 3], [255; 3], [255; 3]]);
    assert!(map[1] != [0; 3], "{:?}", map[1]);
}

/// Sums are added in the order of the taps, whatever is done at once.
#[test]
fn a_prepared_reference_gives_the_same_figures() {
    let reference = Reference::new(image(SIZE, ramps));
    for other in [ramps as Channel, noisy, edged, inverse] {
        let other = image(SIZE, other);
        let found = Comparison::of(reference.image(), &other, 2);
        assert_eq!(reference.compared(&other, 2), found);
    }
}
