//! Microfacets: the distribution of Trowbridge and Reitz ("GGX": Walter and others, "Microfacet
//! Models for Refraction through Rough Surfaces", 2007), with Smith's height-correlated shadowing,
//! sampled by visible normals (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT
//! 7(4), 2018).

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::sampling::warp;

/// Microfacets around a normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Microfacets {
    basis: [DVec3; 3],
    alpha: f64,
}

impl Microfacets {
    /// Below this α they count as one mirror: the lobe is narrower than any pixel.
    const PERFECT: f64 = 1e-4;

    /// Upper limit of α: facets are vertical, and larger values would overflow.
    const ROUGHEST: f64 = 1e6;

    /// Whether they count as one mirror.
    pub(crate) fn is_perfect(alpha: f64) -> bool {
        alpha < Self::PERFECT
    }

    pub(crate) fn new(normal: DVec3, alpha: f64) -> Self {
        let [x, y] = warp::basis(normal);
        Self {
            basis: [x, y, normal],
            alpha: alpha.clamp(Self::PERFECT, Self::ROUGHEST),
        }
    }

    /// Returns D·G / (4 N·L N·V) and the density per steradian with which `toward` is the
    /// reflection of `view` at a facet of [`Microfacets::choose`]. Both are 0 unless both
    /// directions are above the surface.
    pub(crate) fn scatter(&self, view: DVec3, toward: DVec3, halfway: DVec3) -> (f64, f64) {
        let [_, _, normal] = self.basis;
        let [from, to] = [view, toward].map(|direction| normal.dot(direction));
        if from <= 0.0 || to <= 0.0 {
            return (0.0, 0.0);
        }
        let spread = self.distribution(normal.dot(halfway));
        let [lambda_from, lambda_to] = [from, to].map(|cosine| self.lambda(cosine));
        let seen = spread / (1.0 + lambda_from);
        let value = spread / ((1.0 + lambda_from + lambda_to) * 4.0 * from * to);
        // Visible normals have the density D G₁ (V·H) / (N·V); reflection divides by 4 V·H.
        (value, seen / (4.0 * from))
    }

    /// Samples the normal of a facet in proportion to its area visible from `view`.
    pub(crate) fn choose(&self, view: DVec3, [u, v]: [f64; 2]) -> DVec3 {
        let [x, y, normal] = self.basis;
        let alpha = self.alpha;
        let local = DVec3::new(
            alpha * x.dot(view),
            alpha * y.dot(view),
            normal.dot(view).max(0.0),
        );
        // Seen from above, a hemisphere's projected area is a disc, partly hidden behind its rim.
        let stretched = local.normalize_or(DVec3::Z);
        let across = DVec3::new(-stretched.y, stretched.x, 0.0).normalize_or(DVec3::X);
        let up = stretched.cross(across);
        let radius = u.sqrt();
        let (sine, cosine) = libm::sincos(TAU * v);
        let first = radius * cosine;
        let side = 0.5 * (1.0 + stretched.z);
        let second = (1.0 - side) * (1.0 - first * first).max(0.0).sqrt() + side * radius * sine;
        let third = (1.0 - first * first - second * second).max(0.0).sqrt();
        let facet = first * across + second * up + third * stretched;
        let facet = DVec3::new(alpha * facet.x, alpha * facet.y, facet.z.max(0.0));
        let facet = facet.normalize_or(DVec3::Z);
        (facet.x * x + facet.y * y + facet.z * normal).normalize()
    }

    /// D: the density of facet normals, by their cosine to the normal.
    fn distribution(&self, cosine: f64) -> f64 {
        if cosine <= 0.0 {
            return 0.0;
        }
        let square = self.alpha * self.alpha;
        // cos² (α² − 1) + 1 without cancellation near 1.
        let sine = (1.0 - cosine) * (1.0 + cosine);
        let denominator = sine.max(0.0) + cosine * cosine * square;
        square / (PI * denominator * denominator)
    }

    /// Smith's Λ: the ratio of hidden to visible facets.
    fn lambda(&self, cosine: f64) -> f64 {
        let square = cosine * cosine;
        let tangent = ((1.0 - square) / square).max(0.0);
        0.5 * ((1.0 + self.alpha * self.alpha * tangent).sqrt() - 1.0)
    }
}
