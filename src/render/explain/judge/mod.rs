//! Verdicts over a recorded sample.
//!
//! What is recorded says what happened; a verdict says which part of it matters. Where a pixel is
//! dark, the parts that could have lit it come first, by how much they would have added; elsewhere, the
//! parts that added most.

mod camera;
mod lights;
mod surface;

use super::record::{RayEnd, TracedRay, children};
use super::verdict::{Finding, Term, TermSource, Verdict};
use crate::picture::DisplayTransform;
use crate::world::{Projection, World};
use scene::{Integrator, Rgb};

/// Displayed colours below this, of 1, count as dark: five levels of 255.
const DARK: f64 = 0.02;

/// Displayed colours below this, of 1, are dim: without direct light, its absence explains them.
const DIM: f64 = 0.35;

/// Findings that are kept.
const MOST_FINDINGS: usize = 16;

/// A recorded sample with what is needed to judge it.
pub(super) struct Case<'r> {
    pub(super) world: &'r World,
    pub(super) projection: &'r Projection,
    pub(super) rays: &'r [TracedRay],
    pub(super) display: DisplayTransform,
    /// The exposure.
    pub(super) stops: f64,
    pub(super) integrator: Integrator,
    pub(super) depth: u32,
}

/// Returns the verdicts, the one that best explains the sample first.
pub(super) fn judge(case: &Case<'_>) -> Vec<Finding> {
    let judge = Judge::new(case);
    let mut findings = judge.oddities();
    findings.extend(judge.untraced());
    let is_underexposed = |found: &Finding| matches!(found.verdict, Verdict::Underexposed { .. });
    // Otherwise every surface would be said to reflect too little.
    if !findings.iter().any(is_underexposed) {
        findings.extend(judge.first_ray());
    }
    let mut kept: Vec<Finding> = Vec::new();
    for finding in findings {
        if kept.iter().all(|before| before.verdict != finding.verdict) {
            kept.push(finding);
        }
    }
    if kept.is_empty() {
        kept.push(judge.faint());
    }
    kept.truncate(MOST_FINDINGS);
    kept
}

struct Judge<'r> {
    case: &'r Case<'r>,
    /// For each ray, those that start at its end.
    children: Vec<Vec<usize>>,
    /// For each ray, what it and all rays after it add to the sample.
    totals: Vec<Rgb>,
}

impl<'r> Judge<'r> {
    fn new(case: &'r Case<'r>) -> Self {
        let rays = case.rays;
        let mut totals: Vec<_> = rays.iter().map(|ray| ray.contribution).collect();
        for (number, ray) in rays.iter().enumerate().rev() {
            if let Some(parent) = ray.parent {
                let total = totals[number];
                totals[parent] += total;
            }
        }
        Self {
            case,
            children: children(rays),
            totals,
        }
    }

    /// What explains the light along the camera ray. Rays start at the ends of earlier ones, so they
    /// are judged from the last to the first: of a few thousand bounces between mirrors, calls would
    /// be nested too deep.
    fn first_ray(&self) -> Vec<Finding> {
        let mut judged = vec![Vec::new(); self.case.rays.len()];
        for ray in (0..judged.len()).rev() {
            judged[ray] = self.ray(ray, &mut judged);
        }
        judged.swap_remove(0)
    }

    /// The brightness of a part of the sample as displayed, where 1 is white.
    fn shown(&self, part: Rgb) -> f64 {
        self.case.display.exposed(part).max_element()
    }

    fn is_dark(&self, part: Rgb) -> bool {
        // NaN is displayed as black.
        let shown = self.shown(part);
        shown.is_nan() || shown < DARK
    }

    /// Whether a part changes the displayed colour.
    fn is_visible(&self, part: Rgb) -> bool {
        0.5 / 255.0 <= self.shown(part)
    }

    fn is_dim(&self, part: Rgb) -> bool {
        let shown = self.shown(part);
        shown.is_nan() || shown < DIM
    }

    /// What is wrong wherever the light comes from.
    fn oddities(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        let missing = self.case.rays.iter().enumerate().find_map(|(ray, traced)| {
            let (texture, object) = match &traced.end {
                RayEnd::Missed { missing, .. } => ((*missing)?, None),
                RayEnd::Surface(shading) => (shading.missing?, Some(shading.hit.object)),
                RayEnd::Light(_) | RayEnd::OverBudget => return None,
            };
            let verdict = Verdict::MissingTexture { texture, object };
            (!self.is_dark(traced.weight)).then_some(Finding { verdict, ray })
        });
        findings.extend(missing);
        let total = self.totals[0];
        let exposed = self.case.display.exposed(total);
        if !total.is_finite() {
            findings.push(found(Verdict::NotFinite, 0));
        } else if 1.0 + 1e-9 < exposed.max_element() {
            findings.push(found(Verdict::TooBright { exposed }, 0));
        } else if self.case.stops < 0.0 && self.is_dark(total) && DARK <= total.max_element() {
            let verdict = Verdict::Underexposed {
                stops: self.case.stops,
                radiance: total,
            };
            findings.push(found(verdict, 0));
        }
        findings
    }

    /// The rays that exceed the budget, if their light could be seen.
    fn untraced(&self) -> Option<Finding> {
        let is_untraced = |ray: &&TracedRay| matches!(ray.end, RayEnd::OverBudget);
        let rays = self.case.rays.iter().filter(is_untraced);
        let untraced = rays.clone().count();
        let missing: Rgb = rays.map(|ray| ray.weight).sum();
        self.is_visible(missing)
            .then(|| found(Verdict::Budget { untraced }, 0))
    }

    /// What explains the light along a ray, given what explains it along those that start at its end.
    fn ray(&self, ray: usize, judged: &mut [Vec<Finding>]) -> Vec<Finding> {
        let traced = &self.case.rays[ray];
        match &traced.end {
            RayEnd::Missed { radiance, .. } if ray == 0 => self.missed(traced, *radiance),
            RayEnd::Missed { radiance, .. } if self.is_dark(self.totals[ray]) => {
                let verdict = Verdict::Missed {
                    radiance: *radiance,
                    behind: None,
                };
                vec![found(verdict, ray)]
            }
            RayEnd::Missed { .. } => {
                vec![term(TermSource::Surroundings, traced.contribution, ray)]
            }
            RayEnd::Light(hit) => {
                let light = TermSource::LightItself { light: hit.light };
                vec![term(light, traced.contribution, ray)]
            }
            RayEnd::Surface(shading) => self.surface(ray, shading, judged),
            RayEnd::OverBudget => Vec::new(),
        }
    }

    /// What a sample shows that is too faint for any part of it to count.
    fn faint(&self) -> Finding {
        let first = self.case.rays[0].shading();
        let source = first.map_or(TermSource::Surroundings, |shading| TermSource::Emission {
            object: shading.hit.object,
        });
        term(source, self.totals[0], 0)
    }
}

fn term(source: TermSource, contribution: Rgb, ray: usize) -> Finding {
    let term = Term {
        source,
        contribution,
    };
    found(Verdict::Ordinary(term), ray)
}

fn found(verdict: Verdict, ray: usize) -> Finding {
    Finding { verdict, ray }
}
