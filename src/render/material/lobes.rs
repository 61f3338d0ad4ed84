//! The non-specular part of a surface in path tracing: evaluation and importance sampling of its
//! diffuse and glossy lobes.
//!
//! Mirrors and dielectrics are excluded: they scatter into one direction or a narrow cone.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::microfacet::Microfacets;
use super::optics::{power, reflect, schlick, strength};
use super::point::Point;
use crate::material::facets_reflectance;
use crate::sampling::warp;
use geometry::lanes::{Lanes, Vector};
use scene::{Gloss, Highlight, Material, Rgb};

/// The diffuse and glossy lobes of a surface at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobes {
    /// Diffuse BRDF.
    diffuse: Rgb,
    glossy: Glossy,
    /// A highlight of lights only, which is not part of the BRDF.
    highlight: Option<Gloss>,
    /// Probability of sampling the cosine lobe instead of the glossy lobe.
    even: f64,
}

/// A glossy lobe.
#[derive(Clone, Copy, Debug)]
enum Glossy {
    None,
    /// Around the mirror direction.
    Phong(Gloss),
    /// By the half vector of view and light.
    Blinn(Gloss),
    /// Microfacets: reflectance at normal incidence, and α. Perfect ones are a mirror instead.
    Microfacets(Rgb, f64),
}

/// Light scattered between two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scattered {
    /// BRDF times the cosine to the normal.
    pub(crate) value: Rgb,
    /// Probability density with which [`Lobes::choose`] returns the direction, per steradian.
    pub(crate) density: f64,
}

/// The diffuse lobes of surfaces, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Diffuse<N> {
    /// BRDFs.
    pub(crate) colour: Vector<N>,
    /// See [`Lobes`].
    pub(crate) even: N,
}

impl<N: Lanes> Diffuse<N> {
    /// Adds the glossy lobe, given its value without the cosine of incidence, and its density; returns
    /// the value of both times that cosine, and the density of choosing either.
    #[inline(always)]
    pub(crate) fn scatter(&self, cosine: N, glossy: (Vector<N>, N)) -> (Vector<N>, N) {
        let (value, density) = glossy;
        let (zero, one, pi) = (cosine.all(0.0), cosine.all(1.0), cosine.all(PI));
        let is_above = zero.below(cosine);
        let value = (self.colour + value).scaled(cosine);
        let density = self.even * cosine / pi + (one - self.even) * density;
        (
            Vector::select(is_above, value, Vector::all(zero, DVec3::ZERO)),
            N::select(is_above, density, zero),
        )
    }
}

/// Continuations by the lobes, in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LobeSamples<N: Lanes> {
    /// Factor on the throughput.
    pub(crate) weight: Vector<N>,
    /// The probability density of the direction per steradian.
    pub(crate) density: N,
    pub(crate) leads_on: N::Mask,
}

impl<N: Lanes> LobeSamples<N> {
    /// Creates continuations from the probability of continuing by the lobes, and what these scatter from
    /// the direction, with the density by which they choose it.
    #[inline(always)]
    pub(crate) fn new(chance: N, (value, density): (Vector<N>, N)) -> Self {
        let density = chance * density;
        Self {
            weight: value.over(density),
            density,
            leads_on: !value.is_zero() & density.all(0.0).below(density),
        }
    }
}

impl Lobes {
    /// Returns the lobes of a surface at a point, and approximately their maximum reflectance.
    #[inline(always)]
    pub(crate) fn of(point: &Point, material: &Material) -> (Self, f64) {
        let mut highlight = None;
        let (glossy, gloss) = match material.highlight {
            Highlight::ModifiedPhong(gloss)
            | Highlight::Blinn(gloss)
            | Highlight::PlainBlinn(gloss)
                if gloss.specular == Rgb::ZERO =>
            {
                (Glossy::None, 0.0)
            }
            Highlight::None => (Glossy::None, 0.0),
            Highlight::Phong(gloss) => {
                highlight = Some(gloss);
                (Glossy::None, 0.0)
            }
            Highlight::ModifiedPhong(gloss) => (Glossy::Phong(gloss), strength(gloss.specular)),
            Highlight::Blinn(gloss) | Highlight::PlainBlinn(gloss) => {
                (Glossy::Blinn(gloss), strength(gloss.specular))
            }
            Highlight::Microfacet {
                roughness,
                metallic,
            } => {
                let f0 = facets_reflectance(material, metallic);
                let alpha = roughness * roughness;
                if Microfacets::is_perfect(alpha) {
                    (Glossy::None, 0.0)
                } else {
                    // At grazing incidence everything is reflected.
                    let gloss = strength(f0).max(0.25);
                    (Glossy::Microfacets(f0, alpha), gloss)
                }
            }
        };
        let albedo = material.diffuse();
        let diffuse = strength(albedo);
        let total = diffuse + gloss;
        // Where the shading normal leans away from the eye, no direction of the glossy lobe is
        // valid.
        let leans = point.normal.dot(point.view) <= 0.0;
        let even = if total == 0.0 || leans {
            1.0
        } else {
            diffuse / total
        };
        let lobes = Self {
            diffuse: albedo / PI,
            glossy,
            highlight,
            even,
        };
        (lobes, total)
    }

    /// The highlight that [`Lobes::scatter`] excludes, if there is one.
    #[inline]
    pub(crate) fn gloss(&self) -> Option<Gloss> {
        self.highlight
    }

    /// Returns the highlight of light from the direction `toward` that [`Lobes::scatter`] excludes:
    /// ks (R·V)^g / π for any cosine above 0.
    pub(crate) fn highlight(&self, point: &Point, toward: DVec3) -> Rgb {
        let cosine = point.normal.dot(toward);
        match self.highlight {
            Some(gloss) if 0.0 < cosine => {
                let mirrored = 2.0 * cosine * point.normal - toward;
                gloss.specular * power(mirrored.dot(point.view), gloss.exponent) / PI
            }
            _ => Rgb::ZERO,
        }
    }

    /// Evaluates light scattered from the direction `toward` to the eye: BRDF kd/π + ks(g+2)/8π
    /// (N·H)^g, or ks(g+1)/2π (R·V)^g (the normalised Blinn and Phong lobes), or that of
    /// microfacets.
    #[inline]
    pub(crate) fn scatter(&self, point: &Point, toward: DVec3) -> Scattered {
        let cosine = point.normal.dot(toward);
        if cosine <= 0.0 || cosine.is_nan() {
            return Scattered {
                value: Rgb::ZERO,
                density: 0.0,
            };
        }
        let (glossy, density) = match self.glossy {
            Glossy::None => (Rgb::ZERO, 0.0),
            _ => self.scatter_glossy(point, toward),
        };
        let (value, density) = self.diffuse().scatter(cosine, (glossy.into(), density));
        Scattered {
            value: value.into(),
            density,
        }
    }

    /// The diffuse lobe.
    #[inline(always)]
    pub(crate) fn diffuse(&self) -> Diffuse<f64> {
        Diffuse {
            colour: self.diffuse.into(),
            even: self.even,
        }
    }

    /// Whether there is a glossy lobe.
    #[inline]
    pub(crate) fn is_glossy(&self) -> bool {
        !matches!(self.glossy, Glossy::None)
    }

    /// The value of the glossy lobe without the cosine of incidence, and its density.
    pub(crate) fn scatter_glossy(&self, point: &Point, toward: DVec3) -> (Rgb, f64) {
        let view = point.view;
        match self.glossy {
            Glossy::None => (Rgb::ZERO, 0.0),
            Glossy::Blinn(Gloss { specular, exponent }) => {
                let exponent = exponent.max(0.0);
                let halfway = (toward + view).normalize();
                let raised = power(point.normal.dot(halfway).min(1.0), exponent);
                let density = (exponent + 1.0) / TAU * raised / (4.0 * view.dot(halfway));
                (specular * ((exponent + 2.0) / (8.0 * PI) * raised), density)
            }
            Glossy::Phong(Gloss { specular, exponent }) => {
                let exponent = exponent.max(0.0);
                let raised = power(reflect(-view, point.normal).dot(toward).min(1.0), exponent);
                let density = (exponent + 1.0) / TAU * raised;
                (specular * density, density)
            }
            Glossy::Microfacets(f0, alpha) => {
                let facets = Microfacets::new(point.normal, alpha);
                let halfway = (toward + view).normalize();
                let colour = f0 + (Rgb::ONE - f0) * schlick(view.dot(halfway));
                let (value, density) = facets.scatter(view, toward, halfway);
                (colour * value, density)
            }
        }
    }

    /// Whether a number in 0..1 chooses the diffuse lobe.
    #[inline]
    pub(crate) fn is_diffuse(&self, lobe: f64) -> bool {
        lobe < self.even
    }

    /// Samples a direction by three numbers in 0..1. It may point below the surface, into darkness.
    #[inline]
    pub(crate) fn choose(&self, point: &Point, lobe: f64, place: [f64; 2]) -> DVec3 {
        match self.glossy {
            _ if self.is_diffuse(lobe) => warp::by_cosine(point.normal.into(), place).into(),
            Glossy::None => warp::by_cosine(point.normal.into(), place).into(),
            Glossy::Blinn(Gloss { exponent, .. }) => {
                let exponent = exponent.max(0.0);
                let halfway = warp::by_power_of_cosine(point.normal, exponent, place);
                reflect(-point.view, halfway)
            }
            Glossy::Phong(Gloss { exponent, .. }) => {
                let mirrored = reflect(-point.view, point.normal);
                warp::by_power_of_cosine(mirrored, exponent.max(0.0), place)
            }
            Glossy::Microfacets(_, alpha) => {
                let halfway = Microfacets::new(point.normal, alpha).choose(point.view, place);
                reflect(-point.view, halfway)
            }
        }
    }
}
