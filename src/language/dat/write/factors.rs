//! Materials: one colour, and a factor on it for each of their three colours.

use std::fmt::Write;

use super::camera::near;
use crate::coefficients::Coefficients;
use crate::losses::{Loss, Losses, Of};
use crate::spelling::{numbers, vector};
use scene::Rgb;

const COLOURS: Loss = Loss {
    keys: &["ka", "kd", "ks", "specular", "diffuse"],
    lost: "ambient, diffuse and specular colours that are not multiples of one another",
    instead: "written as the nearest multiples of the diffuse colour",
};

pub(super) fn write(
    text: &mut String,
    index: usize,
    of: &Coefficients,
    ambient: Rgb,
    losses: &mut Losses<'_>,
) {
    let factors = Factors::of(of, ambient);
    if !factors.is_exact {
        losses.add(Of::Material(index as u32), &COLOURS);
    }
    // Writing to a string cannot fail.
    let _ = write!(text, "mat ID {}", index + 1);
    vector(text, factors.colour);
    text.push(' ');
    numbers(text, factors.of);
    numbers(text, [of.exponent]);
    text.push(' ');
    numbers(text, [of.transmission, of.reflection, of.index]);
    text.push('\n');
}

/// A colour, and its factors for ambient, diffuse and specular reflection.
struct Factors {
    colour: Rgb,
    of: [f64; 3],
    is_exact: bool,
}

impl Factors {
    /// The factors of a material. Without ambient light, its ambient reflectance may be any.
    fn of(material: &Coefficients, ambient: Rgb) -> Self {
        let wanted = [material.ambient, material.diffuse, material.specular];
        let counts = [ambient != Rgb::ZERO, true, true];
        let is_grey = |colour: &Rgb| *colour == Rgb::splat(colour.x);
        if wanted.iter().all(is_grey) {
            return Self {
                colour: Rgb::ONE,
                of: wanted.map(|colour| colour.x),
                is_exact: true,
            };
        }
        let [dim, body, shine] = wanted;
        let bases = [body, dim, shine]
            .into_iter()
            .filter(|base| *base != Rgb::ZERO);
        let base = bases.clone().next().unwrap_or(Rgb::ONE);
        // Most colours are not multiples, and the search is long.
        let may_fit = (0..3).all(|at| !counts[at] || is_about_multiple(base, wanted[at]));
        for colour in bases.filter(|_| may_fit).flat_map(colours) {
            let exact = [0, 1, 2].map(|at| factor(colour, wanted[at]));
            let fits = (0..3).all(|at| exact[at].is_some() || !counts[at]);
            if fits {
                let of =
                    [0, 1, 2].map(|at| exact[at].unwrap_or_else(|| nearest(colour, wanted[at])));
                return Self {
                    colour,
                    of,
                    is_exact: true,
                };
            }
        }
        Self {
            colour: base,
            of: wanted.map(|wanted| nearest(base, wanted)),
            is_exact: false,
        }
    }
}

/// Whether a colour is a multiple of another but for rounding.
fn is_about_multiple(colour: Rgb, wanted: Rgb) -> bool {
    let rest = wanted - nearest(colour, wanted) * colour;
    rest.abs().max_element() <= 1e-12 * wanted.abs().max_element()
}

/// Colours that a colour may be a multiple of: itself, and quotients by usual factors.
fn colours(base: Rgb) -> impl Iterator<Item = Rgb> {
    let largest = base.abs().max_element();
    let usual = (1..=20).map(|twentieth| f64::from(twentieth) / 20.0);
    let factors = [1.0, largest].into_iter().chain(usual);
    factors.flat_map(move |factor| {
        let exact = base / factor;
        let short = exact
            .to_array()
            .map(|part| near(part).next().unwrap_or(part));
        [Rgb::from_array(short), exact]
    })
}

/// The number by which a colour gives another exactly.
fn factor(colour: Rgb, wanted: Rgb) -> Option<f64> {
    near(nearest(colour, wanted)).find(|factor| *factor * colour == wanted)
}

/// The number by which a colour comes nearest to another.
fn nearest(colour: Rgb, wanted: Rgb) -> f64 {
    let factor = colour.dot(wanted) / colour.length_squared();
    if factor.is_finite() { factor } else { 0.0 }
}
