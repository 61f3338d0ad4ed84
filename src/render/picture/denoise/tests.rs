use rayon::ThreadPoolBuilder;

use super::*;
use crate::integrators::Guide;

const WIDTH: usize = 96;
const HEIGHT: usize = 64;

/// A white wall, seen straight on.
const WALL: Guide = Guide {
    normal: [0.0, 0.0, 1.0],
    albedo: [1.0; 3],
    nearness: 0.25,
};

/// A picture of surfaces, light on them and its variance, each by column and row.
fn picture(
    guide: impl Fn(usize, usize) -> Guide,
    value: impl Fn(usize, usize) -> [f32; 3],
    variance: f32,
) -> (Guides, Vec<[f32; 3]>, Vec<f32>) {
    let places = || (0..WIDTH * HEIGHT).map(|at| (at % WIDTH, at / WIDTH));
    let guides = Guides {
        samples: 1,
        sums: places().map(|(x, y)| guide(x, y)).collect(),
    };
    let values = places().map(|(x, y)| value(x, y)).collect();
    (guides, values, vec![variance; WIDTH * HEIGHT])
}

fn denoised((guides, values, variances): &(Guides, Vec<[f32; 3]>, Vec<f32>)) -> Vec<[f32; 3]> {
    let noisy = Noisy {
        level: Level::new(),
        width: WIDTH,
        values,
        variances,
        guides,
    };
    noisy.denoised(&|| false)
}

/// Independent noise of variance 1 and mean 0: uniform over 2√3, by a hash of the place.
fn noise(x: usize, y: usize) -> f32 {
    let mut hash = (y * WIDTH + x) as u32 ^ 0x9E37_79B9;
    for _ in 0..2 {
        hash = (hash ^ hash >> 16).wrapping_mul(0x85EB_CA6B);
        hash = (hash ^ hash >> 13).wrapping_mul(0xC2B2_AE35);
    }
    (f64::from(hash) / f64::from(u32::MAX) - 0.5) as f32 * 12.0_f32.sqrt()
}

/// The mean square of the differences of the red channel from a value.
fn squared_error(values: &[[f32; 3]], expected: impl Fn(usize, usize) -> f32) -> f32 {
    let error = |at: usize| values[at][0] - expected(at % WIDTH, at / WIDTH);
    let squares = (0..values.len()).map(|at| error(at) * error(at));
    squares.sum::<f32>() / values.len() as f32
}

fn most_apart(values: &[[f32; 3]], others: &[[f32; 3]]) -> f32 {
    let apart = values.as_flattened().iter().zip(others.as_flattened());
    apart.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_constant_picture_stays() {
    let constant = picture(|_, _| WALL, |_, _| [0.3, 0.2, 0.1], 0.01);
    assert!(most_apart(&denoised(&constant), &constant.1) < 1e-6);
}

#[test]
fn every_bit_stays_without_noise() {
    let value = |x, y| [noise(x, y), f32::NAN, -0.0];
    let exact = picture(|_, _| WALL, value, 0.0);
    let bits = |values: &[[f32; 3]]| values.as_flattened().iter().map(|v| v.to_bits()).collect();
    let (before, after): (Vec<_>, Vec<_>) = (bits(&exact.1), bits(&denoised(&exact)));
    assert!(before == after);
    // Also far from noise elsewhere.
    let mut noisy = picture(|_, _| WALL, |x, y| [noise(x, y); 3], 0.0);
    for (at, variance) in noisy.2.iter_mut().enumerate() {
        *variance = if at % WIDTH < 8 { 1.0 } else { 0.0 };
    }
    let after = denoised(&noisy);
    let rows = || noisy.1.chunks(WIDTH).zip(after.chunks(WIDTH));
    assert!(rows().all(|(before, after)| before[10..] == after[10..]));
    assert!(rows().any(|(before, after)| before[..8] != after[..8]));
}

/// Light that the noise would let mix everywhere, on either side of an edge.
#[test]
fn edges_of_surfaces_stay_sharp() {
    let sides: [(Guide, &str); 3] = [
        (
            Guide {
                normal: [0.6, 0.0, 0.8],
                ..WALL
            },
            "normal",
        ),
        (
            Guide {
                nearness: 0.2,
                ..WALL
            },
            "depth",
        ),
        (
            Guide {
                albedo: [0.0; 3],
                ..WALL
            },
            "albedo",
        ),
    ];
    for (right, name) in sides {
        let is_left = |x: usize| x < WIDTH / 2;
        let edge = picture(
            |x, _| if is_left(x) { WALL } else { right },
            |x, _| if is_left(x) { [0.8; 3] } else { [0.2; 3] },
            1.0,
        );
        let apart = most_apart(&denoised(&edge), &edge.1);
        assert!(apart < 0.01, "{name}: {apart}");
    }
}

/// The floor recedes: its nearness falls from row to row, but it is one surface.
#[test]
fn planes_seen_at_an_angle_are_one_surface() {
    let floor = |_, y| Guide {
        nearness: 0.02 + 0.01 * y as f32,
        ..WALL
    };
    let noisy = picture(floor, |x, y| [1.0 + 0.1 * noise(x, y); 3], 0.01);
    let left = squared_error(&denoised(&noisy), |_, _| 1.0);
    assert!(left < 0.01 / 20.0, "{left}");
}

/// Squares of 4 pixels in two albedos under even light with noise in proportion to it.
#[test]
fn textures_stay_sharp() {
    let albedo = |x: usize, y: usize| {
        if (x / 4 + y / 4).is_multiple_of(2) {
            0.8
        } else {
            0.2
        }
    };
    let guide = |x, y| Guide {
        albedo: [albedo(x, y); 3],
        ..WALL
    };
    let value = |x, y| [albedo(x, y) * (1.0 + 0.3 * noise(x, y)); 3];
    let mut noisy = picture(guide, value, 0.0);
    for (at, variance) in noisy.2.iter_mut().enumerate() {
        let deviation = 0.3 * albedo(at % WIDTH, at / WIDTH);
        *variance = deviation * deviation;
    }
    let after = denoised(&noisy);
    let before = squared_error(&noisy.1, albedo);
    let left = squared_error(&after, albedo);
    assert!(left < before / 20.0, "{left} of {before}");
    for (at, value) in after.iter().enumerate() {
        let (x, y) = (at % WIDTH, at / WIDTH);
        let expected = albedo(x, y);
        assert!((value[0] - expected).abs() < 0.35 * expected, "{x},{y}");
    }
}

/// Where all pixels mix, the variance left is the sum of the squares of their weights.
#[test]
fn noise_shrinks_by_the_weights_of_what_mixes() {
    let noisy = picture(|_, _| WALL, |x, y| [5.0 + noise(x, y); 3], 1e6);
    let mut weights = vec![1.0_f32];
    for step in STEPS {
        let reach = step;
        let mut wider = vec![0.0; weights.len() + 2 * reach];
        for (at, weight) in weights.iter().enumerate() {
            for tap in -1..=1_isize {
                let to = (at + reach).wrapping_add_signed(tap * step as isize);
                wider[to] += weight * SPLINE[tap.unsigned_abs()];
            }
        }
        weights = wider;
    }
    let across: f32 = weights.iter().map(|weight| weight * weight).sum();
    let expected = across * across;
    let after = denoised(&noisy);
    // The edges of the picture have fewer neighbours, and one picture is one sample.
    let left = squared_error(&after, |_, _| 5.0);
    assert!(
        (expected / 4.0..4.0 * expected).contains(&left),
        "{left} {expected}"
    );
    // With the variance that it has, nearly all mix.
    let honest = picture(|_, _| WALL, |x, y| [5.0 + noise(x, y); 3], 1.0);
    let left = squared_error(&denoised(&honest), |_, _| 5.0);
    assert!(left < 1.0 / 50.0, "{left}");
}

#[test]
fn the_less_noise_the_closer_to_the_input() {
    let value = |x, y| [noise(x, y), 0.5, 0.1];
    let apart = [1.0, 1e-2, 1e-4, 1e-6, 1e-8].map(|variance| {
        let noisy = picture(|_, _| WALL, value, variance);
        most_apart(&denoised(&noisy), &noisy.1)
    });
    assert!(apart.is_sorted_by(|more, less| more >= less), "{apart:?}");
    assert!(apart[1] < apart[0], "{apart:?}");
    assert!(apart[4] < 1e-3, "{apart:?}");
}

/// A mirror that shows a lamp in a quarter of one pixel's samples is no brighter around it.
#[test]
fn glints_do_not_glow() {
    let mut glint = picture(|_, _| WALL, |x, y| [0.1 + 0.01 * noise(x, y); 3], 1e-4);
    let at = 30 * WIDTH + 40;
    (glint.1[at], glint.2[at]) = ([100.0; 3], 2500.0);
    let mut after = denoised(&glint);
    after[at] = [0.1; 3];
    assert!(most_apart(&after, &vec![[0.1; 3]; WIDTH * HEIGHT]) < 0.02);
}

/// The corner of a lamp in a mirror: its noise is not that of the mirror around it, which has none.
#[test]
fn images_of_lamps_in_mirrors_do_not_glow() {
    const MIRROR: Guide = Guide {
        albedo: [0.0; 3],
        ..WALL
    };
    let mut image = picture(|_, _| MIRROR, |_, _| [0.1; 3], 1e-6);
    let corner = [30 * WIDTH + 40, 30 * WIDTH + 41, 31 * WIDTH + 40];
    for at in corner {
        (image.1[at], image.2[at]) = ([100.0; 3], 2500.0);
    }
    let mut after = denoised(&image);
    for at in corner {
        after[at] = [0.1; 3];
    }
    assert!(most_apart(&after, &vec![[0.1; 3]; WIDTH * HEIGHT]) < 0.01);
}

/// The soft edge of a shadow, by samples of which each is lit or not: where few are, most pixels seem to
/// have no noise, and neighbours are several standard deviations apart.
#[test]
fn soft_shadows_get_smooth() {
    const HALF: u32 = 8;
    let lit = |x: usize| ((x as f32 - 36.0) / 24.0).clamp(0.0, 1.0);
    let is_lit =
        |x: usize, y, sample| noise(x, y + HEIGHT * sample) < (2.0 * lit(x) - 1.0) * 3.0_f32.sqrt();
    let half = |x, y, half: u32| {
        let samples = half * HALF..(half + 1) * HALF;
        let lit = samples.filter(|&sample| is_lit(x, y, sample as usize));
        lit.count() as f32 / HALF as f32
    };
    let value = |x, y| [0.5 * (half(x, y, 0) + half(x, y, 1)); 3];
    let mut noisy = picture(|_, _| WALL, value, 0.0);
    for (at, variance) in noisy.2.iter_mut().enumerate() {
        let (x, y) = (at % WIDTH, at / WIDTH);
        let error = 0.5 * (half(x, y, 0) - half(x, y, 1));
        *variance = error * error;
    }
    let before = squared_error(&noisy.1, |x, _| lit(x));
    let left = squared_error(&denoised(&noisy), |x, _| lit(x));
    assert!(left < before / 20.0, "{left} of {before}");
}

/// A single sample tells nothing of its noise; its neighbours do.
#[test]
fn single_samples_take_their_noise_from_around() {
    let single = picture(|_, _| WALL, |x, y| [5.0 + noise(x, y); 3], UNKNOWN);
    let left = squared_error(&denoised(&single), |_, _| 5.0);
    assert!(left < 1.0 / 50.0, "{left}");
}

#[test]
fn what_is_not_finite_stays_alone() {
    let mut noisy = picture(|_, _| WALL, |_, _| [1.0; 3], 0.1);
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX];
    for (at, odd) in odd.into_iter().enumerate() {
        noisy.1[(10 + at) * WIDTH + 10 * at] = [odd; 3];
        noisy.2[(10 + at) * WIDTH + 10 * at] = odd.abs();
    }
    let after = denoised(&noisy);
    let is_odd = |at: &usize| noisy.1[*at] != [1.0; 3];
    let bits = |value: f32| value.to_bits();
    for at in (0..after.len()).filter(is_odd) {
        assert_eq!(after[at].map(bits), noisy.1[at].map(bits));
    }
    let others = |at: &usize| !is_odd(at);
    for at in (0..after.len()).filter(others) {
        assert!((after[at][0] - 1.0).abs() < 1e-5, "{at}: {:?}", after[at]);
    }
}

#[test]
fn pictures_of_any_shape_are_denoised() {
    for (width, height) in [(1, 1), (1, 40), (40, 1), (3, 2), (33, 5)] {
        let guides = Guides {
            samples: 2,
            sums: vec![Guide::default(); width * height],
        };
        let values = vec![[0.5; 3]; width * height];
        let noisy = Noisy {
            level: Level::new(),
            width,
            values: &values,
            variances: &vec![0.1; width * height],
            guides: &guides,
        };
        assert!(most_apart(&noisy.denoised(&|| false), &values) < 1e-6);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let guide = |x, y: usize| Guide {
        nearness: 0.1 + 0.001 * (x + y) as f32,
        ..WALL
    };
    let noisy = picture(guide, |x, y| [1.0 + noise(x, y), noise(y, x), 1.0], UNKNOWN);
    let with = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| denoised(&noisy))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(8));
}
