//! Paths traced together, one bounce of each at a time, so that their rays and shadow rays form
//! packets. The order of summation within each path does not depend on the others.
//!
//! A bounce has these steps: [trace](trace_rays) its rays, sample [lights](super::light_samples) and
//! [emitters](super::emitter_samples) at their hits, add photons, and
//! [shade and continue](shade_and_continue) from there.

use std::borrow::Cow;

use super::emission::emission;
use super::emitter_samples::{EmitterSamples, add_emitters};
use super::light_samples::{LightSamples, add_lights};
use super::shadow_rays::VertexLight;
use super::vertices::{Continuations, Vertices};
use super::{Continuation, Path, PathHit, classify_hit, continue_path, gathers};
use crate::integrators::caustics::caustics;
use crate::integrators::hit_material::HitMaterial;
use crate::integrators::probe::{Probe, Sample, SampleResult};
use crate::integrators::vertex::Vertex;
use crate::material::BsdfSample;
use crate::sampling::{Draws, Fours, Purpose};
use crate::world::{Dependencies, HitPoints, Nearest, NearestHits, World};
use geometry::Packets;
use geometry::lanes::WIDTH;
use scene::{Material, Rgb};

/// How many paths are traced together: with four times as many, tracing takes 2 % longer.
const TOGETHER: usize = 64;

/// Scratch space for paths traced together.
#[derive(Debug, Default)]
pub(crate) struct PathWave {
    pub(crate) paths: Vec<Path>,
    /// Indices of the unfinished paths.
    growing: Vec<usize>,
    /// Their rays, nearest hits and surface points.
    rays: Packets,
    pub(crate) nearest: Vec<NearestHits>,
    hit_points: Vec<HitPoints>,
    /// The numbers of the paths' samplers at a bounce.
    pub(crate) draws: Draws,
    /// The light of the surfaces that the paths met.
    pub(crate) sums: Vec<VertexLight>,
    pub(crate) of_lights: LightSamples,
    pub(crate) of_emitters: EmitterSamples,
}

/// The surfaces that the rays of a bounce hit.
pub(crate) struct SurfaceHits<'w> {
    /// The places of the rays, what they hit, and the materials there.
    hits: Vec<(usize, Nearest, HitMaterial<'w>)>,
    /// Materials with maps applied.
    mapped: Vec<Material>,
}

/// How a path leaves a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Departure {
    /// The radiance of the surface toward the path; 0 where it is not lit.
    pub(crate) radiance: Rgb,
    /// What of it arrives in the pixel.
    pub(crate) arriving: Rgb,
    /// The direction sampled.
    pub(crate) next: Option<BsdfSample>,
    pub(crate) continuation: Continuation,
}

/// Estimates the radiance along camera rays of samples with the same index.
pub(crate) fn by_paths(
    probe: &mut Probe<'_>,
    wave: &mut PathWave,
    samples: &[Sample],
    seen: &mut Vec<SampleResult>,
) {
    let index = |sample: &Sample| sample.sampler.index();
    assert!(
        samples
            .windows(2)
            .all(|pair| index(&pair[0]) == index(&pair[1]))
    );
    seen.resize(samples.len(), SampleResult::NOTHING);
    for (samples, seen) in samples.chunks(TOGETHER).zip(seen.chunks_mut(TOGETHER)) {
        wave.start(probe.world, samples);
        while !wave.growing.is_empty() && !(probe.cancelled)() {
            bounce(probe, wave, samples, seen);
            wave.draws.node += 1;
        }
    }
}

/// Follows each path to its next surface and on from there.
fn bounce(
    probe: &mut Probe<'_>,
    wave: &mut PathWave,
    samples: &[Sample],
    seen: &mut [SampleResult],
) {
    let hits = trace_rays(probe, wave, samples, seen);
    let vertices = hits.vertices(probe.world, wave, samples);
    let vertices = Vertices::collect(&vertices);
    let PathWave {
        paths,
        growing,
        draws,
        sums,
        of_lights,
        of_emitters,
        ..
    } = wave;
    add_lights(probe, &vertices, sums, (draws, of_lights), seen);
    add_emitters(probe, &vertices, sums, (draws, of_emitters), seen);
    add_caustics(probe, &vertices, sums, draws.node);
    growing.clear();
    let level = probe.world.level;
    let batches = vertices.iter().zip(draws.four(Purpose::Bounce, level));
    for ((vertices, numbers), sums) in batches.zip(sums.chunks(WIDTH)) {
        let by_lobes = vertices.sample(level, numbers);
        let batch = (vertices, numbers, &by_lobes);
        for (lane, sum) in sums.iter().enumerate() {
            let (path, sample) = (&mut paths[sum.path], &samples[sum.path]);
            let departure = shade_and_continue(probe, batch, lane, sum, path, sample);
            seen[sum.path].radiance += departure.arriving;
            if let Continuation::Goes { .. } = departure.continuation {
                growing.push(sum.path);
            }
        }
    }
}

/// Follows the rays of the paths. What they find other than surfaces is added to `seen`.
pub(crate) fn trace_rays<'w>(
    probe: &mut Probe<'w>,
    wave: &mut PathWave,
    samples: &[Sample],
    seen: &mut [SampleResult],
) -> SurfaceHits<'w> {
    let PathWave {
        paths,
        growing,
        rays,
        nearest,
        hit_points,
        ..
    } = wave;
    let world = probe.world;
    rays.clear();
    for &number in &*growing {
        let path = &paths[number];
        rays.push(&path.ray, path.reach(&samples[number]));
        seen[number].rays += 1;
    }
    probe.counts.rays += growing.len() as u64;
    world.nearest_each(rays, nearest);
    world.hit_points_each(rays, nearest, hit_points);
    let mut mapped = Vec::new();
    let mut hits = Vec::with_capacity(growing.len());
    for (place, &number) in growing.iter().enumerate() {
        let (path, seen) = (&mut paths[number], &mut seen[number]);
        let nearest = nearest[place / WIDTH].get(place % WIDTH);
        match classify_hit(probe, path, &samples[number], nearest) {
            PathHit::Nothing(radiance) => {
                if probe.component.glow(path.bounce) {
                    seen.radiance += path.of_nothing(world, radiance);
                }
            }
            PathHit::Light {
                number,
                radiance,
                weight,
                ..
            } => {
                if gathers(probe.component, number, path) {
                    seen.radiance += path.throughput * radiance * weight;
                }
            }
            PathHit::Surface(nearest) => {
                if path.bounce == 0 {
                    seen.object = nearest.object;
                }
                seen.touched |= Dependencies::object(nearest.object);
                let (hit_points, lane) = (&mut hit_points[place / WIDTH], place % WIDTH);
                let material =
                    match hit_points.material(world, nearest, (&rays[place / WIDTH], lane)) {
                        Cow::Borrowed(material) => HitMaterial::Plain(material),
                        Cow::Owned(material) => {
                            mapped.push(material);
                            HitMaterial::Mapped(mapped.len() - 1)
                        }
                    };
                hits.push((place, nearest, material));
            }
        }
    }
    SurfaceHits { hits, mapped }
}

/// Adds the light of photons at surfaces that are lit.
pub(crate) fn add_caustics(
    probe: &mut Probe<'_>,
    vertices: &[Vertices<'_, '_>],
    sums: &mut [VertexLight],
    bounce: u32,
) {
    if probe.photon_map.is_none() {
        return;
    }
    let all = vertices.iter().flat_map(Vertices::all);
    for (vertex, sum) in all.zip(sums) {
        if sum.is_lit {
            sum.of_photons = caustics(probe, vertex, bounce);
        }
    }
}

/// Continues a path from the surface in a lane of a batch, given the continuations by lobes there.
#[inline(always)]
pub(crate) fn shade_and_continue(
    probe: &mut Probe<'_>,
    (vertices, numbers, by_lobes): (&Vertices<'_, '_>, &Fours, &Continuations),
    lane: usize,
    sum: &VertexLight,
    path: &mut Path,
    sample: &Sample,
) -> Departure {
    let vertex = &vertices.all()[lane];
    let mut radiance = Rgb::ZERO;
    let mut arriving = Rgb::ZERO;
    if sum.is_lit {
        radiance = local(probe, path, vertex, sum);
        arriving = path.throughput * radiance;
    }
    let numbers = numbers.lane(lane);
    let next = if by_lobes.lobes >> lane & 1 == 0 {
        vertex.sample(&path.ray, numbers, (sample.sampler, path.bounce))
    } else {
        by_lobes.lane(lane, &vertex.point)
    };
    Departure {
        radiance,
        arriving,
        next,
        continuation: continue_path(probe, path, next, numbers),
    }
}

/// The radiance of a surface that is lit toward a path.
fn local(probe: &Probe<'_>, path: &Path, vertex: &Vertex<'_>, sum: &VertexLight) -> Rgb {
    let emission = if probe.component.glow(path.bounce) {
        emission(probe.world, path, vertex).0
    } else {
        Rgb::ZERO
    };
    let mut local = emission + sum.of_lights;
    if probe.photon_map.is_some() {
        local += sum.of_photons;
    }
    local + sum.of_emitters
}

impl PathWave {
    /// Starts a path for each sample.
    pub(crate) fn start(&mut self, world: &World, samples: &[Sample]) {
        self.of_lights.start(world);
        self.paths.clear();
        self.paths.extend(samples.iter().map(Path::new));
        self.growing.clear();
        self.growing.extend(0..samples.len());
        self.draws.node = 0;
    }
}

impl SurfaceHits<'_> {
    /// The surfaces, for whose light the wave makes room.
    pub(crate) fn vertices(
        &self,
        world: &World,
        wave: &mut PathWave,
        samples: &[Sample],
    ) -> Vec<Vertex<'_>> {
        let PathWave {
            growing,
            rays,
            hit_points,
            draws,
            sums,
            ..
        } = wave;
        let mut vertices = Vec::with_capacity(self.hits.len());
        sums.clear();
        draws.samplers.clear();
        for &(place, nearest, material) in &self.hits {
            let Some(material) = material.get(&self.mapped) else {
                continue;
            };
            let point = hit_points[place / WIDTH].point(&rays[place / WIDTH], place % WIDTH);
            let path = growing[place];
            vertices.push(Vertex::new(world, nearest, point, material));
            draws.samplers.push(samples[path].sampler);
            sums.push(VertexLight::new(path, material.is_lit(point.side)));
        }
        vertices
    }
}
