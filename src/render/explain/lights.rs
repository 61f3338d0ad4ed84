//! The light of one light at a point, factor by factor.

use glam::DVec3;

use super::record::{Crossing, LightTerm, UnlitReason};
use crate::integrators::{LightGeometry, ShadingPoints};
use crate::light::{Incoming, falloff_shares, incoming};
use crate::material::Point;
use crate::world::{Crossed, Nearest, Occlusion, World};
use geometry::Ray;
use scene::{Emitter, Light, Material, Rgb};

/// Objects listed on a shadow ray.
const MOST_CROSSED: usize = 16;

/// A point that lights may light.
#[derive(Clone, Copy)]
pub(super) struct LitPoint<'r> {
    pub(super) world: &'r World,
    pub(super) point: &'r Point,
    pub(super) material: &'r Material,
}

impl LitPoint<'_> {
    /// Describes the light with this index, sampled where `chosen` says if that is not its centre;
    /// `reflected` gives the reflectance for its geometry, and `added` is what the integrator added
    /// for it. `None` for ambient light.
    pub(super) fn term(
        &self,
        number: usize,
        chosen: Option<Incoming<f64>>,
        reflected: impl FnOnce(&LightGeometry<f64>) -> Rgb,
        added: Rgb,
    ) -> Option<LightTerm> {
        let light = &self.world.lights()[number];
        let from = self.point.surface.point;
        let centre = incoming(light, from.into())?;
        let incoming = chosen.unwrap_or(centre);
        let to_light = LightGeometry::new(&ShadingPoints::from(self.point), light, incoming);
        let toward = DVec3::from(to_light.toward);
        let [radial, spot] = shares(light, from, toward);
        let source = incoming.source.map(DVec3::from);
        let reflected = if to_light.is_lit {
            reflected(&to_light)
        } else {
            Rgb::ZERO
        };
        let arriving = radial * spot * light.colour;
        let mut term = LightTerm {
            light: number as u32,
            chance: 1.0,
            toward,
            distance: source.map_or(f64::INFINITY, |source| source.distance(from)),
            cosine: to_light.cosine,
            radial,
            spot,
            arriving,
            reflected,
            densities: None,
            transmittance: None,
            crossed: Vec::new(),
            radiance: added,
            dark: None,
        };
        // Otherwise the integrators ask for no shadow.
        let is_asked = reflected != Rgb::ZERO && radial * spot != 0.0;
        if let Some(shadow) = to_light.shadow.filter(|_| is_asked) {
            let ray = Ray {
                origin: shadow.rays.origin.into(),
                direction: shadow.rays.direction.into(),
            };
            self.cross(&mut term, &ray, shadow.ends);
        }
        term.dark = (added == Rgb::ZERO).then(|| self.dark(&term, light));
        Some(term)
    }

    /// Records what a shadow ray crosses.
    fn cross(&self, term: &mut LightTerm, ray: &Ray, end: f64) {
        let world = self.world;
        let transmittance =
            world.transmittance(ray, end, Occlusion::ByMaterial, &mut Crossed::default());
        term.transmittance = Some(transmittance);
        let crossing = |nearest: Nearest| {
            let object = &world.scene.objects[nearest.object as usize];
            let material = object.material_at(nearest.hit);
            Crossing {
                object: nearest.object,
                material,
                t: nearest.hit.t,
                transmittance: world.transmission(material),
            }
        };
        if transmittance != 1.0 {
            let crossed = world.crossings(ray, end).into_iter().map(crossing);
            term.crossed.extend(crossed.take(MOST_CROSSED));
        }
    }

    /// Why a light adds nothing.
    fn dark(&self, term: &LightTerm, light: &Light) -> UnlitReason {
        if light.colour == Rgb::ZERO {
            UnlitReason::SwitchedOff
        } else if !self.material.is_lit(self.point.side) {
            UnlitReason::UnlitSide
        } else if term.cosine.is_nan() {
            UnlitReason::AtThePoint
        } else if term.cosine <= 0.0 {
            UnlitReason::FacesAway
        } else if term.spot == 0.0 {
            UnlitReason::OutsideCone
        } else if term.radial == 0.0 {
            UnlitReason::Attenuated
        } else if term.transmittance == Some(0.0) {
            UnlitReason::Blocked
        } else {
            UnlitReason::NotReflected
        }
    }
}

/// The factors of attenuation by distance and by angle.
fn shares(light: &Light, point: DVec3, toward: DVec3) -> [f64; 2] {
    match &light.emitter {
        Emitter::Point {
            position, falloff, ..
        } => falloff_shares(falloff, position.distance(point), toward),
        Emitter::Distant(_) | Emitter::Ambient => [1.0; 2],
    }
}
