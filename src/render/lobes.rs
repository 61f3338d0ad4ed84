//! What a surface of `.xml` does with light along paths: how much it sends back between two
//! directions, and directions chosen by that.
//!
//! Mirrors and glass are not of it: theirs is one direction, or a narrow cone.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::microfacet::Microfacets;
use super::optics::{power, reflect, schlick};
use super::probe::Point;
use super::utah::{Gloss, Shading};
use super::warp;
use crate::scene::Rgb;

/// The part of a surface at a point that sends light back in all directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobes {
    diffuse: Rgb,
    gloss: Gloss,
    /// How likely a direction is chosen by the cosine and not by the gloss.
    even: f64,
}

/// Light sent back between two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scattered {
    /// The BRDF times the cosine to the normal.
    pub(crate) value: Rgb,
    /// How likely [`Lobes::choose`] is to give the direction, per steradian.
    pub(crate) density: f64,
}

impl Lobes {
    /// The lobes of a surface at a point, and how much they send back at most, roughly.
    pub(crate) fn of(point: &Point, shading: &Shading) -> (Self, f64) {
        let gloss = match shading.gloss {
            Gloss::Blinn(colour, _) | Gloss::Phong(colour, _) => strength(colour),
            // A perfect one is a mirror.
            Gloss::Microfacet(_, alpha) if Microfacets::is_perfect(alpha) => 0.0,
            // At grazing angles it sends back all.
            Gloss::Microfacet(straight, _) => strength(straight).max(0.25),
        };
        let diffuse = strength(shading.diffuse);
        let total = diffuse + gloss;
        // From below the normal, where it leans past the eye, none of the gloss's directions is right.
        let leans = point.normal.dot(point.view) <= 0.0;
        let even = if total == 0.0 || leans {
            1.0
        } else {
            diffuse / total
        };
        let lobes = Self {
            diffuse: shading.diffuse,
            gloss: shading.gloss,
            even,
        };
        (lobes, total)
    }

    /// What goes from the direction `toward` to the eye: BRDF kd/π + ks(g+2)/8π (N·H)^g, or
    /// ks(g+1)/2π (R·V)^g (the normalised forms of Blinn's and Phong's highlights), or that of little
    /// mirrors.
    pub(crate) fn scatter(&self, point: &Point, toward: DVec3) -> Scattered {
        let cosine = point.normal.dot(toward);
        if cosine <= 0.0 || cosine.is_nan() {
            return Scattered {
                value: Rgb::ZERO,
                density: 0.0,
            };
        }
        let view = point.view;
        let (glossy, density) = match self.gloss {
            Gloss::Blinn(colour, exponent) => {
                let exponent = exponent.max(0.0);
                let halfway = (toward + view).normalize();
                let raised = power(point.normal.dot(halfway).min(1.0), exponent);
                let density = (exponent + 1.0) / TAU * raised / (4.0 * view.dot(halfway));
                (colour * ((exponent + 2.0) / (8.0 * PI) * raised), density)
            }
            Gloss::Phong(colour, exponent) => {
                let exponent = exponent.max(0.0);
                let raised = power(reflect(-view, point.normal).dot(toward).min(1.0), exponent);
                let density = (exponent + 1.0) / TAU * raised;
                (colour * density, density)
            }
            Gloss::Microfacet(_, alpha) if Microfacets::is_perfect(alpha) => (Rgb::ZERO, 0.0),
            Gloss::Microfacet(straight, alpha) => {
                let facets = Microfacets::new(point.normal, alpha);
                let halfway = (toward + view).normalize();
                let colour = straight + (Rgb::ONE - straight) * schlick(view.dot(halfway));
                let (value, density) = facets.scatter(view, toward, halfway);
                (colour * value, density)
            }
        };
        Scattered {
            value: cosine * (self.diffuse / PI + glossy),
            density: self.even * cosine / PI + (1.0 - self.even) * density,
        }
    }

    /// A direction, by three numbers in 0..1. It may lead below the surface, where nothing comes from.
    pub(crate) fn choose(&self, point: &Point, lobe: f64, place: [f64; 2]) -> DVec3 {
        if lobe < self.even {
            return warp::by_cosine(point.normal, place);
        }
        match self.gloss {
            Gloss::Blinn(_, exponent) => {
                let exponent = exponent.max(0.0);
                let halfway = warp::by_power_of_cosine(point.normal, exponent, place);
                reflect(-point.view, halfway)
            }
            Gloss::Phong(_, exponent) => {
                let mirrored = reflect(-point.view, point.normal);
                warp::by_power_of_cosine(mirrored, exponent.max(0.0), place)
            }
            Gloss::Microfacet(_, alpha) => {
                let halfway = Microfacets::new(point.normal, alpha).choose(point.view, place);
                reflect(-point.view, halfway)
            }
        }
    }
}

/// How much a colour lets through, for chances.
pub(crate) fn strength(colour: Rgb) -> f64 {
    let strength = colour.abs().max_element();
    if strength.is_finite() { strength } else { 1.0 }
}
