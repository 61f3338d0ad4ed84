//! The light of one light at a point, factor by factor.

use glam::DVec3;

use super::super::direct::{Facing, Points};
use super::super::lights::{Incoming, SphereLight, incoming};
use super::super::probe::Point;
use super::super::world::World;
use super::record::{Crossing, Dark, LightTerm};
use crate::geometry::Ray;
use crate::scene::{Emitter, Light, Material, Rgb};

/// Objects listed on a shadow ray.
const MOST_CROSSED: usize = 16;

/// A point that a light may light.
pub(super) struct Lit<'r> {
    pub(super) world: &'r World,
    pub(super) point: &'r Point,
    pub(super) material: &'r Material,
    /// What the integrator added for the light.
    pub(super) added: Rgb,
}

/// A shadow ray that the integrator traced.
#[derive(Clone, Copy)]
pub(super) struct Asked {
    /// The reflected light without occlusion.
    pub(super) unblocked: Rgb,
    pub(super) transmittance: f64,
}

impl Lit<'_> {
    /// Describes the light with this index, sampled where `choose` says if it has a size; `asked` is
    /// the shadow ray that the integrator traced to it. `None` for ambient light.
    pub(super) fn term(
        &self,
        number: usize,
        choose: impl FnOnce(&SphereLight) -> Option<Incoming<f64>>,
        asked: Option<Asked>,
    ) -> Option<LightTerm> {
        let light = &self.world.scene.lights[number];
        let from = self.point.surface.point;
        let centre = incoming(light, from.into())?;
        let sphere = light.sphere();
        let incoming = sphere.and_then(|sphere| choose(&sphere)).unwrap_or(centre);
        let facing = Facing::new(&Points::from(self.point), light, incoming);
        let toward = DVec3::from(facing.toward);
        let [radial, spot] = shares(light, from, toward);
        let reflected = if facing.is_lit {
            self.reflected(&facing)
        } else {
            Rgb::ZERO
        };
        let radiance = match asked {
            Some(asked) if asked.transmittance != 0.0 => asked.transmittance * asked.unblocked,
            Some(_) => Rgb::ZERO,
            None => self.added,
        };
        let source = incoming.source.map(DVec3::from);
        let transmittance = asked.map(|asked| asked.transmittance);
        let mut term = LightTerm {
            light: number as u32,
            toward,
            distance: source.map_or(f64::INFINITY, |source| source.distance(from)),
            cosine: facing.cosine,
            radial,
            spot,
            reflected,
            transmittance,
            crossed: Vec::new(),
            radiance,
            dark: None,
        };
        if let Some(shadow) = facing
            .shadow
            .filter(|_| transmittance.is_some_and(|t| t < 1.0))
        {
            let ray = Ray {
                origin: shadow.rays.origin.into(),
                direction: shadow.rays.direction.into(),
            };
            term.crossed = self.crossed(&ray, shadow.ends);
        }
        term.dark = (radiance == Rgb::ZERO).then(|| self.dark(&term, light));
        Some(term)
    }

    fn reflected(&self, facing: &Facing<f64>) -> Rgb {
        let halfway = || {
            let toward = DVec3::from(facing.toward);
            let halfway = (toward + self.point.view).normalize();
            self.point.normal.dot(halfway)
        };
        let material = self.material;
        material.reflected(facing.cosine, facing.mirrored, halfway)
    }

    /// The objects that a shadow ray crosses.
    fn crossed(&self, ray: &Ray, end: f64) -> Vec<Crossing> {
        let crossings = self.world.crossings(ray, end);
        let crossing = |nearest: super::super::intersect::Nearest| {
            let object = &self.world.scene.objects[nearest.object as usize];
            let material = object.material_at(nearest.hit);
            Crossing {
                object: nearest.object,
                material,
                t: nearest.hit.t,
                transmittance: self.world.transmission(material),
            }
        };
        crossings
            .into_iter()
            .map(crossing)
            .take(MOST_CROSSED)
            .collect()
    }

    /// Why a light adds nothing.
    fn dark(&self, term: &LightTerm, light: &Light) -> Dark {
        if light.colour == Rgb::ZERO {
            Dark::SwitchedOff
        } else if !self.material.is_lit(self.point.side) {
            Dark::UnlitSide
        } else if term.cosine.is_nan() {
            Dark::AtThePoint
        } else if term.cosine <= 0.0 {
            Dark::FacesAway
        } else if term.spot == 0.0 {
            Dark::OutsideCone
        } else if term.radial == 0.0 {
            Dark::Attenuated
        } else if term.transmittance == Some(0.0) {
            Dark::Blocked
        } else {
            Dark::NotReflected
        }
    }
}

/// The factors of attenuation by distance and by angle.
fn shares(light: &Light, point: DVec3, toward: DVec3) -> [f64; 2] {
    match &light.emitter {
        Emitter::Point {
            position, falloff, ..
        } => falloff.shares(position.distance(point), toward),
        Emitter::Distant(_) | Emitter::Ambient => [1.0; 2],
    }
}
