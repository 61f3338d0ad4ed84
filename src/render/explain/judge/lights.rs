//! Why lights add nothing, or little, at a surface.

use super::surface::reflectance;
use super::{DARK, Judge, found};
use crate::explain::record::{LightTerm, Shading, UnlitReason};
use crate::explain::verdict::{Finding, Verdict, angle};
use geometry::{Ray, Side, normalise};
use scene::{Emitter, Integrator, Light, Rgb, Scene};

/// Missing light at a surface.
pub(super) struct Lacks {
    /// Why, most important first.
    pub(super) findings: Vec<Finding>,
    /// The light lost in shadows and outside cones, as displayed.
    pub(super) lost: f64,
}

/// A reason with how much light it may cost.
type Reason = (f64, Verdict);

impl Judge<'_> {
    /// Why lights add nothing, or little, at the end of a ray; `weight` is the weight of the surface's
    /// light in the sample.
    pub(super) fn lacks(&self, ray: usize, shading: &Shading, weight: Rgb) -> Lacks {
        let object = shading.hit.object;
        let none = self.case.world.ambient == Rgb::ZERO;
        let no_ambient = found(Verdict::NoAmbient { object, none }, ray);
        if reflectance(&shading.material) == 0.0 {
            let reflects = shading.material.ambient.is_some_and(|ka| ka != Rgb::ZERO);
            let lacks = reflects && shading.ambient == Rgb::ZERO;
            return Lacks {
                findings: lacks.then_some(no_ambient).into_iter().collect(),
                lost: 0.0,
            };
        }
        if !shading.lit {
            return Lacks {
                findings: vec![found(Verdict::UnlitSide { object }, ray)],
                lost: 0.0,
            };
        }
        let (mut reasons, lost) = self.reasons(shading, weight);
        reasons.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut findings: Vec<_> = reasons
            .into_iter()
            .map(|(_, verdict)| found(verdict, ray))
            .collect();
        let is_dim = self.is_dim(weight * shading.radiance);
        let has_ambient = self.case.integrator == Integrator::Whitted;
        if is_dim && has_ambient && shading.ambient == Rgb::ZERO {
            findings.push(no_ambient);
        }
        Lacks { findings, lost }
    }

    /// Why lights add nothing, or little, at a surface that they could light, in no order; and the light
    /// lost in shadows and outside cones, as displayed.
    fn reasons(&self, shading: &Shading, weight: Rgb) -> (Vec<Reason>, f64) {
        let object = shading.hit.object;
        let mut reasons: Vec<Reason> = self.no_lights(shading).into_iter().collect();
        let mut lost = 0.0;
        let mut off = Vec::new();
        let mut away = Vec::new();
        for term in &shading.lights {
            let light = &self.case.world.lights()[term.light as usize];
            match term.dark {
                Some(UnlitReason::SwitchedOff) => {
                    off.push((term.light, term.reflected.max_element()));
                }
                Some(UnlitReason::AtThePoint) => {
                    let verdict = Verdict::AtTheLight {
                        light: term.light,
                        object,
                    };
                    reasons.push((0.5 * light.colour.abs().max_element(), verdict));
                }
                Some(UnlitReason::FacesAway) => match self.around(term, shading) {
                    Some(reason) => reasons.push(reason),
                    None => away.push(term.light),
                },
                dark => {
                    let Some((loss, verdict)) = self.reason(term, light, dark, shading, weight)
                    else {
                        continue;
                    };
                    if matches!(
                        verdict,
                        Verdict::Shadow { .. }
                            | Verdict::Enclosed { .. }
                            | Verdict::OutsideCone { .. }
                    ) {
                        lost += self.shown(weight * (loss / term.chance));
                    }
                    reasons.push((loss, verdict));
                }
            }
        }
        let lights = self
            .case
            .world
            .lights()
            .iter()
            .filter(|light| is_direct(light))
            .count();
        if !off.is_empty() {
            let loss = off.iter().map(|(_, loss)| *loss).fold(0.0, f64::max);
            let all = off.len() == lights;
            let verdict = Verdict::SwitchedOff {
                lights: off.iter().map(|(light, _)| *light).collect(),
                all,
            };
            reasons.push((if all { f64::INFINITY } else { loss }, verdict));
        }
        if !away.is_empty() {
            let all = away.len() + off.len() == lights;
            let verdict = Verdict::FacesAway {
                lights: away,
                all,
                cosine: 0.0,
                object,
            };
            reasons.push((0.01, verdict));
        }
        (reasons, lost)
    }

    /// That nothing in the scene can light a surface; not if ambient light does.
    fn no_lights(&self, shading: &Shading) -> Option<Reason> {
        let scene = &self.case.world.scene;
        if self.case.world.lights().iter().any(is_direct) || shading.ambient != Rgb::ZERO {
            return None;
        }
        let others = match self.case.integrator {
            Integrator::Whitted => shines(scene),
            Integrator::Path | Integrator::Photon if shines(scene) => return None,
            Integrator::Path | Integrator::Photon => self.case.world.ambient != Rgb::ZERO,
        };
        Some((f64::INFINITY, Verdict::NoLights { others }))
    }

    /// That a light from which a surface faces away is inside an object that the surface is not in.
    fn around(&self, term: &LightTerm, shading: &Shading) -> Option<Reason> {
        let light = &self.case.world.lights()[term.light as usize];
        let own = shading.hit.object;
        let object = if shading.hit.side == Side::Front && self.encloses(own, light) {
            own
        } else {
            self.opaque_around(light, shading)?
        };
        let verdict = Verdict::Enclosed {
            light: term.light,
            object,
        };
        Some((0.5 * light.colour.abs().max_element(), verdict))
    }

    /// The opaque object that a light is in and the surface is outside of: whatever way light goes, it meets
    /// that first.
    fn opaque_around(&self, light: &Light, shading: &Shading) -> Option<u32> {
        let Emitter::Point { position, .. } = light.emitter else {
            return None;
        };
        let world = self.case.world;
        let toward = Ray {
            origin: position,
            direction: normalise(shading.hit.point - position)?,
        };
        let nearest = world.nearest(&toward, f64::INFINITY)?;
        let object = &world.scene.objects[nearest.object as usize];
        let is_outside = nearest.hit.t < position.distance(shading.hit.point);
        let is_opaque = world.transmission(object.material_at(nearest.hit)) == 0.0;
        let is_between = is_outside && is_opaque && nearest.object != shading.hit.object;
        let is_around = is_between && self.encloses(nearest.object, light);
        is_around.then_some(nearest.object)
    }

    /// Why a light in front of a surface adds nothing, or little.
    fn reason(
        &self,
        term: &LightTerm,
        light: &Light,
        dark: Option<UnlitReason>,
        shading: &Shading,
        weight: Rgb,
    ) -> Option<Reason> {
        let object = shading.hit.object;
        let reflected = term.reflected.abs().max_element();
        let loss = (term.reflected * term.arriving).abs().max_element();
        let colour = light.colour.abs().max_element();
        let transmittance = term.transmittance.unwrap_or(1.0);
        let shadow = || self.shadow(term, light, (loss, object));
        match dark {
            Some(UnlitReason::Blocked) if is_facet_away(term, shading) => {
                let light = term.light;
                return Some((loss, Verdict::Facet { light, object }));
            }
            Some(UnlitReason::Blocked) => return Some(shadow()),
            Some(UnlitReason::Hidden) => {
                let verdict = Verdict::Shadow {
                    light: term.light,
                    blockers: Vec::new(),
                    transmittance: 0.0,
                    object,
                };
                return Some((loss, verdict));
            }
            Some(UnlitReason::OutsideCone) => return Some(outside_cone(term, light)),
            Some(UnlitReason::Attenuated) => return Some(self.attenuated(term, light)),
            Some(UnlitReason::NotReflected) => return Some(not_reflected(term, object)),
            Some(_) => return None,
            None => {}
        }
        let is_seen = DARK <= self.shown(weight * term.radiance);
        if is_seen || !self.is_dim(weight * shading.radiance) {
            // Light filtered by transparent objects is less, but not gone.
            return (transmittance < 0.5).then(shadow);
        }
        // The smallest factor of the product that the light is.
        let factors = [
            transmittance,
            term.spot,
            term.radial,
            colour,
            term.cosine,
            reflected / term.cosine,
        ];
        let least = (0..factors.len()).min_by(|&a, &b| factors[a].total_cmp(&factors[b]))?;
        Some(match least {
            0 => shadow(),
            1 => outside_cone(term, light),
            2 => self.attenuated(term, light),
            3 => {
                let verdict = Verdict::Dim {
                    light: term.light,
                    colour: light.colour,
                };
                (reflected * term.radial * term.spot, verdict)
            }
            4 => {
                let verdict = Verdict::FacesAway {
                    lights: vec![term.light],
                    all: false,
                    cosine: term.cosine,
                    object,
                };
                (0.01, verdict)
            }
            _ => not_reflected(term, object),
        })
    }

    fn attenuated(&self, term: &LightTerm, light: &Light) -> Reason {
        let verdict = Verdict::Attenuated {
            light: term.light,
            distance: term.distance,
            radial: term.radial,
            rule: self.case.world.rule_of(term.light),
        };
        (reflected_colour(term, light), verdict)
    }

    fn shadow(&self, term: &LightTerm, light: &Light, (loss, object): (f64, u32)) -> Reason {
        let transmittance = term.transmittance.unwrap_or(0.0);
        let mut blockers: Vec<_> = term
            .crossed
            .iter()
            .filter(|crossing| crossing.transmittance < 0.5)
            .map(|crossing| crossing.object)
            .collect();
        let opaque = |crossing: &&crate::explain::record::Crossing| crossing.transmittance == 0.0;
        let mut opaque = term.crossed.iter().filter(opaque);
        let around = opaque.find(|crossing| self.encloses(crossing.object, light));
        if blockers.is_empty() {
            blockers.extend(term.crossed.iter().map(|crossing| crossing.object));
        }
        let verdict = match around {
            Some(crossing) => Verdict::Enclosed {
                light: term.light,
                object: crossing.object,
            },
            None => Verdict::Shadow {
                light: term.light,
                blockers,
                transmittance,
                object,
            },
        };
        ((1.0 - transmittance) * loss, verdict)
    }
}

/// How much a surface would reflect of a light that reached it undiminished.
fn reflected_colour(term: &LightTerm, light: &Light) -> f64 {
    term.reflected.abs().max_element() * light.colour.abs().max_element()
}

fn outside_cone(term: &LightTerm, light: &Light) -> Reason {
    let verdict = Verdict::OutsideCone {
        light: term.light,
        angle: off_axis(light, term),
        spot: term.spot,
    };
    (reflected_colour(term, light) * term.radial, verdict)
}

fn not_reflected(term: &LightTerm, object: u32) -> Reason {
    let verdict = Verdict::NotReflected {
        light: term.light,
        object,
    };
    (0.5 * term.arriving.abs().max_element(), verdict)
}

/// Whether the facet of a mesh faces away from a light that its smooth normal faces.
fn is_facet_away(term: &LightTerm, shading: &Shading) -> bool {
    let hit = &shading.hit;
    let facet = match hit.side {
        Side::Front => hit.geometric,
        Side::Back => -hit.geometric,
    };
    let is_own = term
        .crossed
        .iter()
        .any(|crossing| crossing.object == hit.object);
    !hit.solid && is_own && facet.dot(term.toward) <= 0.0
}

/// Whether a light is not ambient.
fn is_direct(light: &Light) -> bool {
    light.emitter != Emitter::Ambient
}

/// Whether emission or an environment lights the scene in path tracing.
fn shines(scene: &Scene) -> bool {
    let emits = |material: &scene::Material| material.emission != Rgb::ZERO;
    scene.setting.environment.colour != Rgb::ZERO || scene.materials.iter().any(emits)
}

/// The angle between a spot light's direction and a point, in degrees.
fn off_axis(light: &Light, term: &LightTerm) -> f64 {
    match light.emitter {
        Emitter::Point { falloff, .. } => falloff
            .spot
            .map_or(0.0, |(direction, _)| angle(direction, term.toward)),
        Emitter::Distant(_) | Emitter::Ambient => 0.0,
    }
}
