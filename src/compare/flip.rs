//! FLIP: the difference that a person sees who flips between two pictures. Andersson, Nilsson,
//! Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for Alternating
//! Images (2020), for pictures in sRGB at 67 pixels per degree: a display 0.7 m wide with 3840
//! pixels, seen from 0.7 m.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::blur::{BLOCK, Plane, kernel, normalised};
use scene::{Image, Rgb};

/// Pixels per degree of the field of view.
const DENSITY: f64 = 3840.0 * PI / 180.0;

/// The mean difference of two pictures of the same size, 0 to 1.
pub(super) fn mean(a: &Seen, b: &Seen) -> f64 {
    let map = map(a, b);
    map.iter().sum::<f64>() / map.len().max(1) as f64
}

/// What is seen of a picture.
#[derive(Debug)]
pub(super) struct Seen {
    colours: Vec<Rgb>,
    features: Features,
}

impl Seen {
    pub(super) fn of(image: &Image) -> Self {
        let planes = opponent(image);
        Self {
            colours: perceived(&planes),
            features: Features::of(&planes[0]),
        }
    }
}

/// The difference at each pixel, 0 to 1.
fn map(a: &Seen, b: &Seen) -> Vec<f64> {
    let edges = [a, b].map(|seen| &seen.features.edges.values);
    let points = [a, b].map(|seen| &seen.features.points.values);
    let largest = hyab(lab(Rgb::Y), lab(Rgb::Z)).powf(0.7);
    let pixels = a.colours.par_iter().with_min_len(BLOCK).zip(&b.colours);
    let at_each = pixels.enumerate().map(|(at, (a, b))| {
        let gap = |[a, b]: [&Vec<f64>; 2]| (a[at] - b[at]).abs();
        let feature = (gap(edges).max(gap(points)) / 2_f64.sqrt()).sqrt();
        colour_difference(*a, *b, largest).powf(1.0 - feature)
    });
    at_each.collect()
}

/// The planes of a picture in `YCxCz`, an opponent colour space that is linear in light.
fn opponent(image: &Image) -> [Plane; 3] {
    let curve: Vec<f64> = (0..=255)
        .map(|byte| linear(f64::from(byte) / 255.0))
        .collect();
    let channel = |at: usize| {
        Plane::of(image, |pixel| {
            let colour = Rgb::from_array(pixel.map(|byte| curve[usize::from(byte)]));
            let [x, y, z] = relative(colour).to_array();
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)][at]
        })
    };
    [channel(0), channel(1), channel(2)]
}

/// The colours that remain after the contrast sensitivity of the eye, in L*a*b* with the Hunt
/// effect: chroma is seen the less, the darker it is.
fn perceived(planes: &[Plane; 3]) -> Vec<Rgb> {
    let [y, cx, cz] = [0, 1, 2].map(|at| sensed(&planes[at], SENSITIVITIES[at]));
    let luminances = y.values.par_iter().with_min_len(BLOCK);
    let channels = luminances.zip(&cx.values).zip(&cz.values);
    let colour = channels.map(|((y, cx), cz)| {
        let y = (y + 16.0) / 116.0;
        let relative = Rgb::new(y + cx / 500.0, y, y - cz / 200.0);
        let rgb = XYZ_TO_RGB.map(|row| row.dot(relative * white()).clamp(0.0, 1.0));
        lab(Rgb::from_array(rgb))
    });
    colour.collect()
}

/// Two Gaussians [a, b]: the contrast sensitivity in space is Σ a √(π/b) exp(−π² x² / b), x in
/// degrees (table 1).
type Sensitivity = [[f64; 2]; 2];

const SENSITIVITIES: [Sensitivity; 3] = [
    [[1.0, 0.0047], [0.0, 1e-5]],
    [[1.0, 0.0053], [0.0, 1e-5]],
    [[34.1, 0.04], [13.5, 0.025]],
];

/// A plane seen with a contrast sensitivity.
fn sensed(plane: &Plane, sensitivity: Sensitivity) -> Plane {
    // Three standard deviations of the widest Gaussian.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * DENSITY).ceil() as usize;
    let gaussian = |b: f64| kernel(radius, |x| (-(PI * x / DENSITY).powi(2) / b).exp());
    let parts = sensitivity.map(|[a, b]| {
        let gaussian = gaussian(b);
        let sum: f64 = gaussian.iter().sum();
        (a * (PI / b).sqrt() * sum * sum, normalised(&gaussian))
    });
    let total: f64 = parts.iter().map(|(weight, _)| weight).sum();
    let [(first, near), (second, far)] = parts;
    let seen = plane.convolved(&near, &near);
    if second == 0.0 {
        return seen;
    }
    seen.with(&plane.convolved(&far, &far), |a, b| {
        (first * a + second * b) / total
    })
}

/// How strongly edges and points are seen around each pixel.
#[derive(Debug)]
struct Features {
    edges: Plane,
    points: Plane,
}

impl Features {
    /// The features of the achromatic plane.
    fn of(y: &Plane) -> Self {
        // Half the width of 0.082 degrees of a detector.
        let deviation = 0.5 * 0.082 * DENSITY;
        let radius = (3.0 * deviation).ceil() as usize;
        let gaussian = |x: f64| (-0.5 * (x / deviation).powi(2)).exp();
        let smooth = normalised(&kernel(radius, gaussian));
        let strength = |across: &[f64]| {
            let grey = y.with(y, |y, _| (y + 16.0) / 116.0);
            let [x, y] = [
                grey.convolved(across, &smooth),
                grey.convolved(&smooth, across),
            ];
            x.with(&y, f64::hypot)
        };
        Self {
            edges: strength(&balanced(&kernel(radius, |x| -x * gaussian(x)))),
            points: strength(&balanced(&kernel(radius, |x| {
                ((x / deviation).powi(2) - 1.0) * gaussian(x)
            }))),
        }
    }
}

/// A kernel whose positive weights add up to 1, and its negative ones to −1.
fn balanced(kernel: &[f64]) -> Vec<f64> {
    let sum = |of: f64| -> f64 { kernel.iter().map(|weight| (of * weight).max(0.0)).sum() };
    let (positive, negative) = (sum(1.0), sum(-1.0));
    let weight = |&weight: &f64| weight / if 0.0 < weight { positive } else { negative };
    kernel.iter().map(weight).collect()
}

/// The difference of two colours in L*a*b*, 0 to 1: `HyAB` to the power of 0.7, of which the range up
/// to 0.4 of the largest (between green and blue) takes 0.95 (equations 5 to 8).
fn colour_difference(a: Rgb, b: Rgb, largest: f64) -> f64 {
    let knee = 0.4 * largest;
    let difference = hyab(a, b).powf(0.7);
    if difference < knee {
        0.95 / knee * difference
    } else {
        0.95 + 0.05 * (difference - knee) / (largest - knee)
    }
}

/// The distance of two colours: that of lightness plus that of chroma.
fn hyab(a: Rgb, b: Rgb) -> f64 {
    (a.x - b.x).abs() + f64::hypot(a.y - b.y, a.z - b.z)
}

/// A linear colour in L*a*b*, with chroma scaled by lightness / 100 (Hunt).
fn lab(colour: Rgb) -> Rgb {
    const DELTA: f64 = 6.0 / 29.0;
    let curve = |t: f64| {
        if DELTA.powi(3) < t {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    };
    let [x, y, z] = relative(colour).to_array().map(curve);
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    Rgb::new(lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z))
}

/// XYZ of a linear colour, divided by those of white.
fn relative(colour: Rgb) -> Rgb {
    Rgb::from_array(RGB_TO_XYZ.map(|row| row.dot(colour))) / white()
}

fn white() -> Rgb {
    Rgb::from_array(RGB_TO_XYZ.map(|row| row.dot(Rgb::ONE)))
}

/// Rows of the matrix from linear sRGB to CIE XYZ (IEC 61966-2-1), and of its inverse.
const RGB_TO_XYZ: [Rgb; 3] = [
    Rgb::new(0.412_390_799, 0.357_584_339, 0.180_480_788),
    Rgb::new(0.212_639_006, 0.715_168_679, 0.072_192_315),
    Rgb::new(0.019_330_819, 0.119_194_780, 0.950_532_152),
];
const XYZ_TO_RGB: [Rgb; 3] = [
    Rgb::new(3.240_969_942, -1.537_383_178, -0.498_610_760),
    Rgb::new(-0.969_243_636, 1.875_967_502, 0.041_555_057),
    Rgb::new(0.055_630_080, -0.203_976_959, 1.056_971_514),
];

/// The inverse of the sRGB transfer function.
fn linear(encoded: f64) -> f64 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}
