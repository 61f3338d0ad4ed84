//! Camera rays that hit nothing, or not what they should.

use super::{Judge, found};
use crate::explain::record::TracedRay;
use crate::explain::verdict::{DepthLimit, Finding, Verdict};
use geometry::Ray;
use scene::Rgb;

impl Judge<'_> {
    /// Why a camera ray hits nothing.
    pub(super) fn missed(&self, traced: &TracedRay, radiance: Rgb) -> Vec<Finding> {
        let world = self.case.world;
        if world.scene.objects.is_empty() {
            return vec![found(Verdict::NoObjects, 0)];
        }
        let mut findings = Vec::new();
        let ray = Ray {
            origin: traced.origin,
            direction: traced.direction,
        };
        findings.extend(self.too_near(&ray));
        findings.extend(self.too_far(&ray));
        let backward = Ray {
            origin: self.eye(&ray),
            direction: -ray.direction,
        };
        let behind = world.nearest(&backward, f64::INFINITY);
        let behind = behind.map(|nearest| nearest.object);
        findings.push(found(Verdict::Missed { radiance, behind }, 0));
        findings
    }

    /// The object that a camera ray would hit before the near limit.
    pub(super) fn too_near(&self, ray: &Ray) -> Option<Finding> {
        let from = Ray {
            origin: self.eye(ray),
            direction: ray.direction,
        };
        let skipped = from.origin.distance(ray.origin);
        let nearest = self.case.world.nearest(&from, skipped)?;
        let verdict = Verdict::Clipped {
            object: nearest.object,
            depth: nearest.hit.t * self.slant(ray),
            limit: DepthLimit::Near,
            at: self.case.projection.depths()[0],
        };
        Some(found(verdict, 0))
    }

    /// The object that a camera ray that hits nothing would hit beyond the far limit.
    fn too_far(&self, ray: &Ray) -> Option<Finding> {
        let nearest = self.case.world.nearest(ray, f64::INFINITY)?;
        let [near, far] = self.case.projection.depths();
        let verdict = Verdict::Clipped {
            object: nearest.object,
            depth: near + nearest.hit.t * self.slant(ray),
            limit: DepthLimit::Far,
            at: far,
        };
        Some(found(verdict, 0))
    }

    /// Where a camera ray would start without a near limit.
    fn eye(&self, ray: &Ray) -> glam::DVec3 {
        let near = self.case.projection.depths()[0];
        if 0.0 < near {
            ray.at(-near / self.slant(ray))
        } else {
            ray.origin
        }
    }

    /// The cosine between a camera ray and the view.
    fn slant(&self, ray: &Ray) -> f64 {
        let [.., forward] = self.case.projection.axes();
        forward.dot(ray.direction)
    }
}
