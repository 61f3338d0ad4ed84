//! Surfaces: which of local light, mirror and boundary matters.

use std::mem;

use super::{Judge, found, term};
use crate::explain::ray_kind::RayKind;
use crate::explain::record::{RayEnd, Shading, Stop};
use crate::explain::verdict::{Finding, TermSource, Verdict};
use crate::material::facets_reflectance;
use crate::picture::luminance;
use geometry::{Ray, Side};
use scene::{Emitter, Highlight, Light, Material, Rgb};

/// A part of the light that leaves a surface.
struct Part {
    /// How much of what arrives it could send on.
    potential: f64,
    /// What it adds, as displayed.
    actual: f64,
    findings: Vec<Finding>,
}

impl Judge<'_> {
    /// What explains the light from a surface at the end of a ray.
    pub(super) fn surface(
        &self,
        ray: usize,
        shading: &Shading,
        judged: &mut [Vec<Finding>],
    ) -> Vec<Finding> {
        let object = shading.hit.object;
        if is_black(&shading.material) {
            let material = shading.hit.material;
            return vec![found(Verdict::Black { object, material }, ray)];
        }
        let mut local = self.local(ray, shading);
        let mut parts: Vec<_> = self.children[ray]
            .iter()
            .map(|&child| {
                let findings = mem::take(&mut judged[child]);
                self.secondary(ray, (child, findings), shading)
            })
            .collect();
        parts.extend(self.cut(ray, shading));
        let total = self.totals[ray];
        let is_dark = self.is_dark(total);
        let worth = |part: &Part| {
            if is_dark {
                part.potential
            } else {
                part.actual + 0.01 * part.potential
            }
        };
        let specular = parts.iter().filter(|part| !self.is_scattered(part));
        let specular = specular.map(|part| part.potential).fold(0.0, f64::max);
        // Without direct light, its absence explains a dim surface, whatever else lights it.
        let leads = local.lacks_first && specular <= local.part.potential && self.is_dim(total);
        if leads {
            local.part.actual = f64::INFINITY;
            local.part.potential = f64::INFINITY;
        }
        parts.insert(0, local.part);
        parts.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        let mut findings: Vec<_> = parts.into_iter().flat_map(|part| part.findings).collect();
        self.add_inside(ray, shading, &mut findings);
        findings
    }

    /// Whether a part is light scattered by a path.
    fn is_scattered(&self, part: &Part) -> bool {
        let ray = part.findings.first().map(|finding| finding.ray);
        let kind = ray.map(|ray| self.case.rays[ray].kind);
        matches!(kind, Some(RayKind::Diffuse | RayKind::Glossy))
    }

    /// A ray that starts at the surface, with what explains its light.
    fn secondary(
        &self,
        ray: usize,
        (child, mut findings): (usize, Vec<Finding>),
        shading: &Shading,
    ) -> Part {
        let kind = self.case.rays[child].kind;
        let object = shading.hit.object;
        let total = self.totals[child];
        if !self.is_dark(total) {
            let seen = match &self.case.rays[self.brightest(child)].end {
                RayEnd::Surface(shading) => Some(shading.hit.object),
                RayEnd::Missed { .. } | RayEnd::Light(_) | RayEnd::OverBudget => None,
            };
            // What is seen there has its own pixels to be explained by.
            findings.retain(|finding| is_lack(&finding.verdict, kind));
            let source = TermSource::Ray { kind, object, seen };
            findings.insert(0, term(source, total, child));
        }
        if kind == RayKind::TotalReflection {
            // A ray that is cut is the cause, unless it would be reflected further on and on.
            let first = findings.first();
            let is_cause = first.is_some_and(|first| self.is_cut_short(first));
            let total = found(Verdict::TotalReflection { object }, ray);
            findings.insert(usize::from(is_cause), total);
        }
        let weight = self.case.rays[child].weight.abs().max_element();
        Part {
            potential: weight / self.weight_at(ray, shading),
            actual: self.shown(total),
            findings,
        }
    }

    /// The ray that adds most among one and those that descend from it: what it leads to, such as
    /// what is seen through both sides of a glass. Of equal ones the first.
    fn brightest(&self, ray: usize) -> usize {
        let shown = |ray: usize| self.shown(self.case.rays[ray].contribution);
        let mut best = ray;
        let mut left = vec![ray];
        while let Some(ray) = left.pop() {
            if shown(best) < shown(ray) {
                best = ray;
            }
            left.extend(self.children[ray].iter().rev());
        }
        best
    }

    /// Whether a finding is that rays are cut by the depth where they would get out.
    fn is_cut_short(&self, finding: &Finding) -> bool {
        let shading = self.case.rays[finding.ray].shading();
        let boundary = shading.and_then(|shading| shading.boundary);
        let is_total = boundary.is_some_and(|boundary| boundary.total);
        matches!(finding.verdict, Verdict::Depth { .. }) && !is_total
    }

    /// Rays that are cut by the maximum number of bounces.
    fn cut(&self, ray: usize, shading: &Shading) -> Option<Part> {
        let boundary = shading.boundary.map_or(Rgb::ZERO, |boundary| boundary.tint);
        let potential = shading.mirror.max(boundary).abs().max_element();
        let missing = potential * self.case.rays[ray].weight * shading.transmitted;
        let is_cut = shading.stop == Some(Stop::Depth) && self.is_visible(missing);
        let verdict = Verdict::Depth {
            object: shading.hit.object,
            depth: self.case.depth,
        };
        is_cut.then(|| Part {
            potential,
            actual: 0.0,
            findings: vec![found(verdict, ray)],
        })
    }

    /// The weight of what leaves a surface in the sample; not 0.
    fn weight_at(&self, ray: usize, shading: &Shading) -> f64 {
        let weight = self.case.rays[ray].weight * shading.transmitted;
        weight.abs().max_element().max(f64::MIN_POSITIVE)
    }

    /// Emission, ambient light and lights.
    fn local(&self, ray: usize, shading: &Shading) -> Local {
        let object = shading.hit.object;
        let weight = self.case.rays[ray].weight * shading.transmitted;
        let mut terms = vec![
            (TermSource::Emission { object }, shading.emission),
            (TermSource::Ambient { object }, shading.ambient),
            (TermSource::Caustics { object }, shading.caustics),
        ];
        terms.extend(shading.lights.iter().map(|term| {
            let light = term.light;
            (TermSource::Light { light, object }, term.radiance)
        }));
        terms.extend(shading.emitters.iter().map(|term| {
            let emitter = term.object;
            (TermSource::Emitter { emitter, object }, term.radiance)
        }));
        let mut ordinary: Vec<_> = terms
            .into_iter()
            .map(|(source, radiance)| (source, weight * radiance))
            .filter(|(_, part)| self.is_visible(*part))
            .collect();
        ordinary.sort_by(|(_, a), (_, b)| luminance(*b).total_cmp(&luminance(*a)));
        let lights = shading.lights.iter().map(|term| term.radiance);
        let emitters = shading.emitters.iter().map(|term| term.radiance);
        let direct: Rgb = lights.chain(emitters).chain([shading.caustics]).sum();
        let direct = self.shown(weight * (direct + shading.unlisted.radiance));
        let lacks = self.lacks(ray, shading, weight);
        let contribution = self.case.rays[ray].contribution;
        let is_unlit = direct < super::DARK && self.is_dim(contribution);
        let lacks_first = !lacks.findings.is_empty() && (is_unlit || 2.0 * direct < lacks.lost);
        let ordinary = ordinary
            .into_iter()
            .map(|(source, part)| term(source, part, ray));
        let findings = if lacks_first {
            lacks.findings.into_iter().chain(ordinary).collect()
        } else {
            ordinary.chain(lacks.findings).collect()
        };
        let potential = if shading.lit {
            reflectance(&shading.material).max(shading.material.emission.max_element())
        } else {
            0.0
        };
        Local {
            part: Part {
                potential,
                actual: self.shown(contribution),
                findings,
            },
            lacks_first,
        }
    }

    /// Adds that a ray starts inside an object: first where that makes it dark.
    fn add_inside(&self, ray: usize, shading: &Shading, findings: &mut Vec<Finding>) {
        let hit = &shading.hit;
        if ray != 0 || hit.side == Side::Front || !hit.solid {
            return;
        }
        let object = hit.object;
        let origin = self.case.rays[ray].origin;
        let line = Ray {
            origin,
            direction: self.case.rays[ray].direction,
        };
        if let Some(clipped) = self.too_near(&line) {
            // The near limit has cut it open.
            let at = if self.is_dim(self.totals[ray]) {
                0
            } else {
                findings.len()
            };
            findings.insert(at, clipped);
            return;
        }
        let inside = found(Verdict::Inside { object }, ray);
        let lights = self.case.world.lights().iter();
        let is_lit = |light: &Light| light.colour != Rgb::ZERO && self.encloses(object, light);
        let is_room = lights.into_iter().any(is_lit);
        if shading.boundary.is_none() && !is_room && self.is_dim(self.totals[ray]) {
            findings.insert(0, inside);
        } else {
            findings.push(inside);
        }
    }

    /// Whether a light is inside an object, judging by six directions.
    pub(super) fn encloses(&self, object: u32, light: &Light) -> bool {
        let Emitter::Point { position, .. } = light.emitter else {
            return false;
        };
        let shape = &self.case.world.scene.objects[object as usize].shape;
        let axes = [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::Z];
        let mut directions = axes.into_iter().flat_map(|axis| [axis, -axis]);
        directions.all(|direction| {
            let ray = Ray {
                origin: position,
                direction,
            };
            shape.hit(&ray, f64::INFINITY).is_some()
        })
    }
}

/// Emission, ambient light and lights of a surface.
struct Local {
    part: Part,
    /// Whether missing light explains it better than the light that is there.
    lacks_first: bool,
}

/// Whether a verdict on what a bright ray brings is worth telling at the surface it comes from.
fn is_lack(verdict: &Verdict, kind: RayKind) -> bool {
    let is_scattered = matches!(kind, RayKind::Diffuse | RayKind::Glossy);
    !is_scattered
        && matches!(
            verdict,
            Verdict::Depth { .. } | Verdict::TotalReflection { .. }
        )
}

/// How much of a light's light a material reflects at most.
pub(super) fn reflectance(material: &Material) -> f64 {
    let highlight = match material.highlight {
        Highlight::None => Rgb::ZERO,
        Highlight::Phong(gloss)
        | Highlight::ModifiedPhong(gloss)
        | Highlight::Blinn(gloss)
        | Highlight::PlainBlinn(gloss) => gloss.specular,
        Highlight::Microfacet { metallic, .. } => facets_reflectance(material, metallic),
    };
    material.diffuse().max(highlight).abs().max_element()
}

/// Whether a material reflects, transmits and emits nothing.
fn is_black(material: &Material) -> bool {
    let ambient = material.ambient.unwrap_or_default();
    let others = [
        ambient,
        material.emission,
        material.mirror.tint,
        material.dielectric.tint,
    ];
    reflectance(material) == 0.0 && others == [Rgb::ZERO; 4]
}
