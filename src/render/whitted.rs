//! Whitted's recursive ray tracing (Whitted, "An Improved Illumination Model for Shaded Display",
//! 1980).

use glam::DVec3;

use super::frame::NO_OBJECT;
use super::intersect::Nearest;
use super::optics::{Dielectric, index, reflect, refract, spread, transmitted};
use super::phong;
use super::probe::{Asked, Counts, Matter, Point, Probe, RAY_BUDGET, Sample, Seen, ask};
use super::sampler::{Sampler, Use};
use super::utah::Shading;
use crate::geometry::Ray;
use crate::scene::{Light, Phong, Rgb};

/// A ray that goes on from a point.
struct Branch {
    /// Which one of the point's it is.
    number: u32,
    direction: DVec3,
    /// Which part of its radiance leaves the point toward where the ray came from.
    weight: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
}

/// A ray yet to be traced.
#[derive(Clone, Copy, Debug)]
struct Pending {
    ray: Ray,
    /// Which part of its radiance reaches the eye.
    weight: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
    bounce: u32,
    /// Its place in the tree of rays, for numbers of its own.
    node: u32,
}

/// The rays of a camera sample.
#[derive(Debug, Default)]
struct Tree {
    pending: Vec<Pending>,
    traced: u32,
}

/// A ray that has come to a surface.
#[derive(Debug)]
struct Arrived<'w> {
    /// The number of its tree.
    tree: usize,
    /// The number of its ray in the front.
    ray: usize,
    /// Which part of its radiance reaches the eye.
    weight: Rgb,
    point: Point,
    matter: Matter<'w>,
    /// What leaves the point toward where the ray came from.
    radiance: Rgb,
}

/// Camera samples on their way side by side: one ray of each at a time.
#[derive(Debug, Default)]
pub(crate) struct Wave<'w> {
    trees: Vec<Tree>,
    /// The numbers of the trees that are not done.
    growing: Vec<usize>,
    front: Vec<(usize, Pending)>,
    rays: Vec<Ray>,
    limits: Vec<f64>,
    nearest: Vec<Option<Nearest>>,
    arrived: Vec<Arrived<'w>>,
    /// The numbers of those that ask for light, and what they would send back of it.
    asking: Vec<(usize, Rgb)>,
    /// By light: the last object that kept it from a surface.
    blockers: Vec<Option<u32>>,
    transmittances: Vec<f64>,
}

impl<'w, C: Fn() -> bool> Probe<'w, C> {
    /// Radiance along camera rays. The rays of each are traced depth first, reflection before
    /// refraction; those beyond the budget bring nothing.
    ///
    /// Many samples are traced at once, one ray of each at a time, so that rays and shadow rays meet
    /// the scene side by side. What each sample adds up, and in which order, is its own.
    pub(crate) fn by_whitted(
        &mut self,
        wave: &mut Wave<'w>,
        samples: &[Sample],
        seen: &mut Vec<Seen>,
    ) {
        wave.start(samples, seen);
        while wave.advance(samples, &mut self.counts) && !(self.cancelled)() {
            self.world
                .nearest_each(&wave.rays, &wave.limits, &mut wave.nearest);
            self.arrive(wave, samples, seen);
            self.light(wave, samples);
            self.go_on(wave, samples, seen);
        }
    }

    /// Takes the front to the surfaces that it meets.
    fn arrive(&self, wave: &mut Wave<'w>, samples: &[Sample], seen: &mut [Seen]) {
        let world = self.world;
        wave.arrived.clear();
        for (number, (nearest, &(tree, ref ray))) in
            wave.nearest.iter().zip(&wave.front).enumerate()
        {
            let seen = &mut seen[tree];
            let Some(nearest) = *nearest else {
                let screen = samples[tree].screen;
                seen.radiance += ray.weight * world.around(&ray.ray, ray.bounce, screen);
                continue;
            };
            if ray.bounce == 0 {
                seen.object = nearest.object;
            }
            let (point, matter) = world.arrive(&ray.ray, nearest);
            let ambient = world.scene.ambient;
            let (radiance, weight) = match &matter {
                Matter::Flat(colour) => {
                    seen.radiance += ray.through(nearest) * *colour;
                    continue;
                }
                Matter::Phong(material) => (material.ambient * ambient, ray.weight),
                Matter::Utah(shading) => {
                    let own = if shading.is_lit(point.front) {
                        shading.emission + ambient * shading.diffuse
                    } else {
                        Rgb::ZERO
                    };
                    (own, ray.through(nearest))
                }
            };
            wave.arrived.push(Arrived {
                tree,
                ray: number,
                weight,
                point,
                matter,
                radiance,
            });
        }
    }

    /// Adds what surfaces send back of the light of all lights, in file order.
    fn light(&mut self, wave: &mut Wave<'_>, samples: &[Sample]) {
        let lights = &self.world.scene.lights;
        wave.blockers.resize(lights.len(), None);
        for (number, light) in lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            wave.asking.clear();
            wave.rays.clear();
            wave.limits.clear();
            for (index, arrived) in wave.arrived.iter_mut().enumerate() {
                let node = wave.front[arrived.ray].1.node;
                let sampler = samples[arrived.tree].sampler;
                let place = || sampler.pair(node, Use::Light(number as u32));
                let Some(asked) = arrived.ask(light, place) else {
                    continue;
                };
                match asked.shadow {
                    None => arrived.radiance += asked.unblocked,
                    Some(shadow) => {
                        wave.asking.push((index, asked.unblocked));
                        wave.rays.push(shadow.ray);
                        wave.limits.push(shadow.end);
                    }
                }
            }
            self.counts.rays += wave.rays.len() as u64;
            self.world.transmittance_each(
                &wave.rays,
                &wave.limits,
                &mut wave.blockers[number],
                &mut self.crossed,
                &mut wave.transmittances,
            );
            let asking = wave.asking.iter().zip(&wave.transmittances);
            for (&(index, unblocked), &transmittance) in asking {
                wave.arrived[index].radiance += transmittance * unblocked;
            }
        }
    }

    /// Adds what leaves surfaces to what is seen, and leaves the rays that go on pending.
    fn go_on(&self, wave: &mut Wave<'_>, samples: &[Sample], seen: &mut [Seen]) {
        for arrived in &wave.arrived {
            seen[arrived.tree].radiance += arrived.weight * arrived.radiance;
            let (_, ray) = &wave.front[arrived.ray];
            if ray.bounce < self.depth {
                let pending = &mut wave.trees[arrived.tree].pending;
                arrived.branch(ray, samples[arrived.tree].sampler, pending);
            }
        }
    }
}

impl Wave<'_> {
    /// Plants a tree for each sample.
    fn start(&mut self, samples: &[Sample], seen: &mut Vec<Seen>) {
        self.trees.resize_with(samples.len(), Tree::default);
        self.growing.clear();
        self.growing.extend(0..samples.len());
        for (tree, sample) in self.trees.iter_mut().zip(samples) {
            tree.traced = 0;
            tree.pending.clear();
            tree.pending.push(Pending {
                ray: sample.ray,
                weight: Rgb::ONE,
                absorption: Rgb::ZERO,
                bounce: 0,
                node: Sampler::ROOT,
            });
            seen.push(Seen {
                radiance: Rgb::ZERO,
                object: NO_OBJECT,
            });
        }
    }

    /// Takes the next ray of each tree to the front; `false` if there is none.
    fn advance(&mut self, samples: &[Sample], counts: &mut Counts) -> bool {
        self.front.clear();
        self.rays.clear();
        self.limits.clear();
        let Self {
            trees,
            growing,
            front,
            rays,
            limits,
            ..
        } = self;
        growing.retain(|&number| {
            let tree = &mut trees[number];
            let Some(next) = tree.pending.pop() else {
                return false;
            };
            if tree.traced == RAY_BUDGET {
                counts.over_budget += 1;
                return false;
            }
            tree.traced += 1;
            rays.push(next.ray);
            limits.push(match next.bounce {
                0 => samples[number].reach,
                _ => f64::INFINITY,
            });
            front.push((number, next));
            true
        });
        counts.rays += rays.len() as u64;
        !rays.is_empty()
    }
}

impl Arrived<'_> {
    /// What is sent back of a light's light.
    #[inline]
    fn ask(&self, light: &Light, place: impl FnOnce() -> Option<[f64; 2]>) -> Option<Asked> {
        let point = &self.point;
        match &self.matter {
            Matter::Phong(material) => ask(point, light, None, |toward, cosine| {
                phong::reflected(material, point, toward, cosine)
            }),
            Matter::Utah(shading) if shading.is_lit(point.front) => {
                let place = (0.0 < light.radius).then(place).flatten();
                ask(point, light, place, |toward, cosine| {
                    cosine * shading.reflected(point.normal, point.view, toward)
                })
            }
            Matter::Utah(_) | Matter::Flat(_) => None,
        }
    }

    /// Leaves the rays that go on pending, the mirrored one to be traced first.
    fn branch(&self, ray: &Pending, sampler: Sampler, pending: &mut Vec<Pending>) {
        match &self.matter {
            Matter::Flat(_) => {}
            Matter::Phong(material) => self.branch_clear(ray, material, pending),
            Matter::Utah(shading) => self.branch_by_fresnel(ray, shading, sampler, pending),
        }
    }

    /// The mirrored and the refracted ray.
    fn branch_clear(&self, ray: &Pending, material: &Phong, pending: &mut Vec<Pending>) {
        let point = &self.point;
        let direction = ray.ray.direction;
        let mut mirrored_weight = material.reflection;
        let clear = |number, direction, weight| Branch {
            number,
            direction,
            weight: Rgb::splat(weight),
            absorption: Rgb::ZERO,
        };
        if material.transmission != 0.0 {
            let index = index(material.index);
            let ratio = if point.front { 1.0 / index } else { index };
            match refract(direction, point.normal, ratio) {
                Some(refracted) => {
                    let branch = clear(0, refracted, material.transmission);
                    self.push(ray, &branch, pending);
                }
                // Total internal reflection: both rays go the same way and are traced as one.
                None => mirrored_weight += material.transmission,
            }
        }
        let mirrored = clear(1, reflect(direction, point.normal), mirrored_weight);
        self.push(ray, &mirrored, pending);
    }

    /// The same where how much goes which way depends on the angle.
    fn branch_by_fresnel(
        &self,
        ray: &Pending,
        shading: &Shading,
        sampler: Sampler,
        pending: &mut Vec<Pending>,
    ) {
        let point = &self.point;
        let direction = ray.ray.direction;
        let losses = shading.losses(point.front);
        let mut by_mirror = if point.front {
            shading.mirror()
        } else {
            Rgb::ZERO
        };
        let mut by_glass = Rgb::ZERO;
        if shading.refraction != Rgb::ZERO {
            let Dielectric {
                reflectance,
                refracted,
            } = Dielectric::new(direction, point.normal, shading.indices(point.front));
            by_glass = reflectance * shading.refraction;
            if let Some(refracted) = refracted {
                let numbers = || sampler.pair(ray.node, Use::Refraction);
                let branch = Branch {
                    number: 0,
                    direction: spread(refracted, shading.refraction_spread, -point.normal, numbers),
                    weight: (1.0 - reflectance) * shading.refraction,
                    absorption: losses.refracted,
                };
                self.push(ray, &branch, pending);
            }
        }
        if shading.reflection_spread == shading.refraction_spread {
            by_mirror += by_glass;
            by_glass = Rgb::ZERO;
        }
        let mirrored = reflect(direction, point.normal);
        let numbers = || sampler.pair(ray.node, Use::Reflection);
        // The one pushed last is traced first.
        for (number, tangent, weight) in [
            (1, shading.refraction_spread, by_glass),
            (2, shading.reflection_spread, by_mirror),
        ] {
            let branch = Branch {
                number,
                direction: spread(mirrored, tangent, point.normal, numbers),
                weight,
                absorption: losses.mirrored,
            };
            self.push(ray, &branch, pending);
        }
    }

    fn push(&self, ray: &Pending, branch: &Branch, pending: &mut Vec<Pending>) {
        if branch.weight == Rgb::ZERO {
            return;
        }
        pending.push(Pending {
            ray: self.point.leave(branch.direction),
            weight: self.weight * branch.weight,
            absorption: branch.absorption,
            bounce: ray.bounce + 1,
            node: Sampler::child(ray.node, branch.number),
        });
    }
}

impl Pending {
    /// Which part of the radiance at a hit reaches the eye.
    fn through(&self, nearest: Nearest) -> Rgb {
        self.weight * transmitted(self.absorption, nearest.hit.t)
    }
}
