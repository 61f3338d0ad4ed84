//! Paths traced alone, by formulas for one surface and one light: what waves of them are compared with.

#![cfg(test)]

use glam::DVec3;

use super::emission::{Target, emission, sent_by_object, sent_by_sky};
use super::emitter_samples::samples_emitters;
use super::{Continuation, Path, PathHit, classify_hit, continue_path, density_of};
use crate::integrators::caustics::caustics;
use crate::integrators::direct::{LightGeometry, Shadow, sent_back, shadow, shadowed};
use crate::integrators::probe::{Probe, Sample};
use crate::integrators::vertex::Vertex;
use crate::light::{SphereLight, Spheres, incoming, light_sphere, luminous_sphere};
use crate::sampling::{Purpose, Sampler, weight_over_density};
use crate::world::Occlusion;
use geometry::Ray;
use geometry::lanes::Vector;
use scene::{Light, Rgb};

/// What a surface reflects of a light if nothing is in between.
struct Unshadowed {
    light: Rgb,
    /// `None` if the light casts no shadows.
    shadow: Option<Shadow<f64>>,
}

/// Estimates the radiance along a camera ray.
pub(crate) fn radiance_alone(probe: &mut Probe<'_>, sample: &Sample) -> Rgb {
    let world = probe.world;
    let mut path = Path::new(sample);
    let mut radiance = Rgb::ZERO;
    loop {
        let nearest = world.nearest(&path.ray, path.reach(sample));
        let nearest = match classify_hit(probe, &mut path, sample, nearest) {
            PathHit::Nothing(around) => return radiance + path.of_nothing(world, around),
            PathHit::Light {
                radiance: sent,
                weight,
                ..
            } => return radiance + path.throughput * sent * weight,
            PathHit::Surface(nearest) => nearest,
        };
        let mut mapped = None;
        let (point, material) = world.shading_point(&path.ray, nearest, &mut mapped);
        let vertex = Vertex::new(world, nearest, point, material);
        if material.is_lit(point.side) {
            radiance += path.throughput * local(probe, &path, &vertex, sample.sampler);
        }
        let numbers = sample.sampler.four(path.bounce, Purpose::Bounce);
        let next = vertex.sample(&path.ray, numbers, (sample.sampler, path.bounce));
        let continuation = continue_path(probe, &mut path, next, numbers);
        if !matches!(continuation, Continuation::Goes { .. }) {
            return radiance;
        }
    }
}

/// The radiance of a surface toward a path.
fn local(probe: &mut Probe<'_>, path: &Path, vertex: &Vertex<'_>, sampler: Sampler) -> Rgb {
    let world = probe.world;
    let bounce = path.bounce;
    let mut of_lights = Rgb::ZERO;
    for number in world.many_lights.others() {
        let [u, v, ..] = sampler.four(bounce, Purpose::Light(number as u32));
        of_lights += of_light(probe, (number, 1.0), vertex, bounce, [u, v]);
    }
    let numbers = sampler.four(bounce, Purpose::ManyLights);
    let at = place_of(vertex);
    if !world.many_lights.is_empty()
        && let Some(chosen) = world.many_lights.choose(at, numbers)
    {
        let [u, v, ..] = numbers;
        of_lights += of_light(probe, chosen, vertex, bounce, [u, v]);
    }
    let mut local = emission(world, path, vertex).0 + of_lights;
    if probe.photon_map.is_some() {
        local += caustics(probe, vertex, bounce);
    }
    if samples_emitters(probe, vertex, bounce) {
        let of_object = of_object(
            probe,
            vertex,
            bounce,
            sampler.four(bounce, Purpose::Emitter),
        );
        let of_sky = of_sky(probe, vertex, bounce, sampler.four(bounce, Purpose::Sky));
        local += of_object + of_sky;
    }
    local
}

/// The point and the shading normal.
fn place_of(vertex: &Vertex<'_>) -> (DVec3, DVec3) {
    (vertex.point.surface.point, vertex.point.normal)
}

/// The light that a surface reflects of the light with this index, which was chosen with this
/// probability. `place`, in the unit square, is where a light with a size is sampled.
fn of_light(
    probe: &mut Probe<'_>,
    (number, chance): (usize, f64),
    vertex: &Vertex<'_>,
    bounce: u32,
    place: [f64; 2],
) -> Rgb {
    let light = &probe.world.lights()[number];
    let unshadowed = match luminous_sphere(light) {
        Some(sphere) => of_sphere_light(probe, (vertex, bounce), (light, &sphere), chance, place),
        None => of_point_light(vertex, light, place),
    };
    let Some(Unshadowed {
        light: unblocked,
        shadow,
    }) = unshadowed
    else {
        return Rgb::ZERO;
    };
    let unblocked = unblocked / chance;
    let arriving = shadow.map_or(unblocked, |shadow| {
        let occlusion = probe.occlusion(light);
        let transmittance =
            probe
                .world
                .transmittance(&shadow.ray(), shadow.ends, occlusion, &mut probe.crossed);
        shadowed(unblocked, transmittance)
    });
    light.scale * arriving
}

/// The light reflected from a light without a radiance.
fn of_point_light(vertex: &Vertex<'_>, light: &Light, place: [f64; 2]) -> Option<Unshadowed> {
    let Vertex { point, bsdf, .. } = vertex;
    let from = point.surface.point;
    let chosen = light_sphere(light).and_then(|sphere| sphere.choose(from, place));
    let incoming = chosen.or_else(|| incoming(light, from.into()))?;
    let to_light = LightGeometry::new(&point.into(), light, incoming);
    if !to_light.is_lit {
        return None;
    }
    let toward = to_light.toward.into();
    let scattered = bsdf.lobes.scatter(point, toward);
    let reflected = scattered.value + bsdf.lobes.highlight(point, toward);
    Some(Unshadowed {
        light: sent_back(light, from, || toward, reflected)?,
        shadow: to_light.shadow,
    })
}

/// The light reflected from a light with a size, chosen with a probability and sampled at the given
/// place.
fn of_sphere_light(
    probe: &Probe<'_>,
    (vertex, bounce): (&Vertex<'_>, u32),
    (light, sphere): (&Light, &SphereLight),
    chance: f64,
    place: [f64; 2],
) -> Option<Unshadowed> {
    let Vertex { point, bsdf, .. } = vertex;
    let from = point.surface.point;
    let incoming = sphere.choose(from, place)?;
    let toward = incoming.toward.into();
    let scattered = bsdf.lobes.scatter(point, toward);
    let highlight = bsdf.lobes.highlight(point, toward);
    let ray = point.leave(toward);
    let sphere_lights = &probe.world.sphere_lights;
    let hides = |place: Vector<f64>| sphere_lights.hide(sphere, &ray, place.into());
    let is_dark = scattered.value == Rgb::ZERO && highlight == Rgb::ZERO;
    if is_dark || incoming.source.is_some_and(hides) {
        return None;
    }
    let by_path = density_of(probe, bsdf, scattered, bounce);
    let scattered = (scattered.value.into(), by_path);
    let spheres = Spheres::from(sphere);
    let reflected = spheres.reflected(from.into(), chance, scattered, highlight.into());
    Some(Unshadowed {
        light: reflected.into(),
        shadow: shadow(&point.surface.into(), light, incoming),
    })
}

/// The light that a surface reflects of an object that emits light, chosen by numbers in 0..1.
fn of_object(probe: &Probe<'_>, vertex: &Vertex<'_>, bounce: u32, numbers: [f64; 4]) -> Rgb {
    let world = probe.world;
    let [u, v, ..] = numbers;
    let from = vertex.point.surface.point;
    let picked = world.emitters.pick(place_of(vertex), numbers);
    let choice =
        picked.and_then(|picked| world.emitters.choose(&world.scene, from, picked, [u, v]));
    let Some(choice) = choice else {
        return Rgb::ZERO;
    };
    let target = Target {
        part: (choice.object, choice.part),
        side: choice.side,
    };
    let ray = vertex.point.leave(choice.toward);
    let emitted = || {
        let nearest = world.nearest(&ray, choice.reach);
        sent_by_object(world, target, &ray, nearest)
    };
    of_emitter(probe, (vertex, bounce), (&ray, choice.density), emitted)
}

/// The light that a surface reflects of the environment, chosen by numbers in 0..1.
fn of_sky(probe: &mut Probe<'_>, vertex: &Vertex<'_>, bounce: u32, [u, v, ..]: [f64; 4]) -> Rgb {
    let world = probe.world;
    let Some(toward) = world.sky.choose([u, v]) else {
        return Rgb::ZERO;
    };
    let ray = vertex.point.leave(toward);
    let occlusion = Occlusion::Complete;
    let transmittance = world.transmittance(&ray, f64::INFINITY, occlusion, &mut probe.crossed);
    let emitted = || sent_by_sky(world, &ray, transmittance);
    let density = world.sky.density(toward);
    of_emitter(probe, (vertex, bounce), (&ray, density), emitted)
}

/// The light that a surface reflects of what is emitted toward it along a ray, chosen with a density.
fn of_emitter(
    probe: &Probe<'_>,
    (vertex, bounce): (&Vertex<'_>, u32),
    (ray, by_light): (&Ray, f64),
    emitted: impl FnOnce() -> Option<Rgb>,
) -> Rgb {
    let Vertex { point, bsdf, .. } = vertex;
    let scattered = bsdf.lobes.scatter(point, ray.direction);
    if scattered.value == Rgb::ZERO || by_light == 0.0 {
        return Rgb::ZERO;
    }
    let by_path = density_of(probe, bsdf, scattered, bounce);
    let reflected = |emitted| scattered.value * emitted * weight_over_density(by_light, by_path);
    emitted().map_or(Rgb::ZERO, reflected)
}
