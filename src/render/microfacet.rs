//! Little mirrors that lie about a normal: the distribution of Trowbridge and Reitz ("GGX": Walter
//! and others, "Microfacet Models for Refraction through Rough Surfaces", 2007), shadowed by Smith's
//! height-correlated function, chosen by how much of them is seen (Heitz, "Sampling the GGX
//! Distribution of Visible Normals", JCGT 7(4), 2018).

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::warp;

/// Little mirrors about a normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Microfacets {
    basis: [DVec3; 3],
    alpha: f64,
}

impl Microfacets {
    /// Below this α they are one mirror: the lobe is narrower than any pixel.
    const PERFECT: f64 = 1e-4;

    /// From this α on they stand on edge, and more would overflow.
    const ROUGHEST: f64 = 1e6;

    /// Whether they are one mirror.
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

    /// D·G / (4 N·L N·V), and the density per steradian with which `toward` is the mirrored direction
    /// of `view` on a facet of [`Microfacets::choose`]. Both directions are above the surface, or nothing
    /// is sent back.
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
        // Visible normals have the density D G₁ (V·H) / (N·V); mirroring divides by 4 V·H.
        (value, seen / (4.0 * from))
    }

    /// The normal of a facet that is seen from `view`, by how much of it is seen.
    pub(crate) fn choose(&self, view: DVec3, [u, v]: [f64; 2]) -> DVec3 {
        let [x, y, normal] = self.basis;
        let alpha = self.alpha;
        let local = DVec3::new(
            alpha * x.dot(view),
            alpha * y.dot(view),
            normal.dot(view).max(0.0),
        );
        // Seen from above a hemisphere, its projected area is a disc, in part behind its own rim.
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

    /// D: how many of them face a direction, by its cosine to the normal.
    fn distribution(&self, cosine: f64) -> f64 {
        if cosine <= 0.0 {
            return 0.0;
        }
        let square = self.alpha * self.alpha;
        // cos² (α² − 1) + 1 without the difference of two numbers near 1.
        let sine = (1.0 - cosine) * (1.0 + cosine);
        let denominator = sine.max(0.0) + cosine * cosine * square;
        square / (PI * denominator * denominator)
    }

    /// Smith's Λ: what is hidden for each that is seen.
    fn lambda(&self, cosine: f64) -> f64 {
        let square = cosine * cosine;
        let tangent = ((1.0 - square) / square).max(0.0);
        0.5 * ((1.0 + self.alpha * self.alpha * tangent).sqrt() - 1.0)
    }
}
