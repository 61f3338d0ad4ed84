//! Paths traced together, one bounce of each at a time, so that their rays and shadow rays form
//! packets. The order of summation within each path does not depend on the others.

use std::borrow::Cow;

use super::next_event_wave::{Meeting, NextEventWave};
use super::vertices::Vertices;
use super::{Continuation, Path, PathHit};
use crate::integrators::probe::{Probe, Sample, SampleResult};
use crate::integrators::vertex::Vertex;
use crate::integrators::wave::Found;
use crate::material::BsdfSample;
use crate::sampling::{Draws, Fours, Use};
use crate::world::{Dependencies, Landing, NearestHits};
use geometry::Packets;
use geometry::lanes::WIDTH;
use scene::Rgb;

/// How many paths are traced together: with four times as many, tracing takes 2 % longer.
const TOGETHER: usize = 64;

/// Scratch space for paths traced together.
#[derive(Debug, Default)]
pub(crate) struct PathWave {
    paths: Vec<Path>,
    /// Indices of the unfinished paths.
    growing: Vec<usize>,
    /// Their rays, nearest hits and surface points.
    rays: Packets,
    nearest: Vec<NearestHits>,
    landings: Vec<Landing>,
    /// The numbers of the paths' samplers at a bounce.
    draws: Draws,
    next_events: NextEventWave,
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Estimates the radiance along camera rays of samples with the same index.
    pub(crate) fn by_paths(
        &mut self,
        wave: &mut PathWave,
        samples: &[Sample],
        seen: &mut Vec<SampleResult>,
    ) {
        let index = |sample: &Sample| sample.sampler.index();
        debug_assert!(
            samples
                .windows(2)
                .all(|pair| index(&pair[0]) == index(&pair[1]))
        );
        seen.resize(samples.len(), SampleResult::NOTHING);
        wave.next_events.start(self.world);
        for (samples, seen) in samples.chunks(TOGETHER).zip(seen.chunks_mut(TOGETHER)) {
            wave.paths.clear();
            wave.paths.extend(samples.iter().map(Path::new));
            wave.growing.clear();
            wave.growing.extend(0..samples.len());
            wave.draws.node = 0;
            while !wave.growing.is_empty() && !(self.cancelled)() {
                self.bounce(wave, samples, seen);
                wave.draws.node += 1;
            }
        }
    }

    /// Follows each path to its next surface and on from there.
    fn bounce(&mut self, wave: &mut PathWave, samples: &[Sample], seen: &mut [SampleResult]) {
        let PathWave {
            paths,
            growing,
            rays,
            nearest,
            landings,
            draws,
            next_events,
        } = wave;
        let world = self.world;
        rays.clear();
        for &number in &*growing {
            let path = &paths[number];
            rays.push(&path.ray, path.reach(&samples[number]));
            seen[number].rays += 1;
        }
        self.counts.rays += growing.len() as u64;
        world.nearest_each(rays, nearest);
        world.land_each(rays, nearest, landings);
        let mut mapped = Vec::new();
        let mut found = Vec::with_capacity(growing.len());
        for (place, &number) in growing.iter().enumerate() {
            let (path, seen) = (&mut paths[number], &mut seen[number]);
            let nearest = nearest[place / WIDTH].get(place % WIDTH);
            match self.meet(path, &samples[number], nearest) {
                PathHit::Nothing(radiance) => seen.radiance += self.of_nothing(path, radiance),
                PathHit::Light {
                    number,
                    radiance,
                    weight,
                    ..
                } => {
                    if self.gathers(number, path) {
                        seen.radiance += path.throughput * radiance * weight;
                    }
                }
                PathHit::Surface(nearest) => {
                    if path.bounce == 0 {
                        seen.object = nearest.object;
                    }
                    seen.touched |= Dependencies::object(nearest.object);
                    let (landing, lane) = (&mut landings[place / WIDTH], place % WIDTH);
                    let material =
                        match landing.material(world, nearest, (&rays[place / WIDTH], lane)) {
                            Cow::Borrowed(material) => Found::Plain(material),
                            Cow::Owned(material) => {
                                mapped.push(material);
                                Found::Mapped(mapped.len() - 1)
                            }
                        };
                    found.push((place, nearest, material));
                }
            }
        }
        let mut meetings = Vec::with_capacity(found.len());
        let mut vertices = Vec::with_capacity(found.len());
        draws.samplers.clear();
        for &(place, nearest, material) in &found {
            let Some(material) = material.material(&mapped) else {
                continue;
            };
            let point = landings[place / WIDTH].point(&rays[place / WIDTH], place % WIDTH);
            let path = growing[place];
            vertices.push(Vertex::new(world, nearest, point, material));
            draws.samplers.push(samples[path].sampler);
            meetings.push(Meeting {
                path,
                is_lit: material.is_lit(point.side),
                light: Rgb::ZERO,
                of_emitters: Rgb::ZERO,
            });
        }
        let vertices = Vertices::collect(&vertices);
        self.add_lights(&vertices, &mut meetings, (draws, next_events), seen);
        self.add_emitters(&vertices, &mut meetings, (draws, next_events), seen);
        growing.clear();
        let batches = vertices.iter().zip(draws.four(Use::Bounce, world.level));
        for ((vertices, numbers), meetings) in batches.zip(meetings.chunks(WIDTH)) {
            let batch = (vertices, numbers, meetings);
            self.go_on(batch, paths, samples, seen, growing);
        }
    }

    /// Adds what the surfaces send back, and continues the paths.
    fn go_on(
        &mut self,
        (vertices, numbers, meetings): (&Vertices<'_, '_>, &Fours, &[Meeting]),
        paths: &mut [Path],
        samples: &[Sample],
        seen: &mut [SampleResult],
        growing: &mut Vec<usize>,
    ) {
        let by_lobes = vertices.sample(self.world.level, numbers);
        for (lane, (vertex, meeting)) in vertices.all().iter().zip(meetings).enumerate() {
            let path = &mut paths[meeting.path];
            if meeting.is_lit {
                let local = self.local(path, vertex, meeting);
                seen[meeting.path].radiance += path.throughput * local;
            }
            let numbers = numbers.lane(lane);
            let next = if by_lobes.lobes >> lane & 1 == 0 {
                vertex.sample(
                    &path.ray,
                    numbers,
                    (samples[meeting.path].sampler, path.bounce),
                )
            } else {
                (by_lobes.lead_on >> lane & 1 == 1).then(|| {
                    let (ray, weight) = (by_lobes.rays.get(lane), by_lobes.weight.get(lane));
                    BsdfSample::by_lobes(&vertex.point, ray, weight, by_lobes.density.0[lane])
                })
            };
            if let Continuation::Goes { .. } = self.onward(path, next, numbers) {
                growing.push(meeting.path);
            }
        }
    }

    /// The contribution of a path that leaves the scene, given the radiance there.
    fn of_nothing(&self, path: &Path, radiance: Rgb) -> Rgb {
        if !self.gather.glow(path.bounce) {
            return Rgb::ZERO;
        }
        let densities = path.densities_of(&self.world.sky);
        let weight = densities.map_or(1.0, |densities| densities.weight);
        path.throughput * radiance * weight
    }

    /// The radiance of a surface toward a path.
    fn local(&mut self, path: &Path, vertex: &Vertex<'_>, meeting: &Meeting) -> Rgb {
        let emission = if self.gather.glow(path.bounce) {
            self.emission(path, vertex)
        } else {
            Rgb::ZERO
        };
        let mut local = emission + meeting.light;
        if self.photon_map.is_some() {
            local += self.caustics(vertex, path.bounce);
        }
        local + meeting.of_emitters
    }
}
