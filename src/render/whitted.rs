//! Whitted's recursive ray tracing with Phong highlights (Whitted, "An Improved Illumination Model
//! for Shaded Display", 1980).

use glam::DVec3;

use super::frame::NO_OBJECT;
use super::looks::Look;
use super::world::{Nearest, World};
use crate::geometry::{Ray, Surface, ulp};
use crate::scene::{Falloff, Light, Phong, Rgb, Shadows, Source};

/// Rays that one camera sample may trace, shadow rays apart. With reflection and transmission both
/// 1 a tree of depth 30 would have two thousand million.
const RAY_BUDGET: u32 = 4096;

/// Traces samples; keeps its scratch space and counts from one to the next.
#[derive(Debug)]
pub(crate) struct Tracer<'w> {
    world: &'w World,
    depth: u32,
    pending: Vec<Pending>,
    crossed: Vec<(u32, u32)>,
    /// What was traced so far.
    pub(crate) counts: Counts,
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Rays, shadow rays included.
    pub(crate) rays: u64,
    /// Samples that ran out of their budget.
    pub(crate) over_budget: u64,
}

impl Counts {
    /// What was added since `before`.
    pub(crate) fn since(self, before: Self) -> Self {
        Self {
            rays: self.rays - before.rays,
            over_budget: self.over_budget - before.over_budget,
        }
    }

    /// Both counts together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            over_budget: self.over_budget + other.over_budget,
        }
    }
}

/// What a camera ray brings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Radiance.
    pub(crate) radiance: Rgb,
    /// The first object met, or [`NO_OBJECT`].
    pub(crate) object: u32,
}

/// A ray yet to be traced.
#[derive(Clone, Copy, Debug)]
struct Pending {
    ray: Ray,
    /// Which part of its radiance reaches the eye.
    weight: f64,
    bounce: u32,
}

/// A lit point.
struct Point<'m> {
    surface: Surface,
    /// The normal to shade with, its bumps included: turned round where the back was hit.
    normal: DVec3,
    /// Whether the ray came from outside.
    front: bool,
    /// Unit vector toward where the ray came from.
    view: DVec3,
    /// With its textures.
    material: &'m Phong,
}

impl<'w> Tracer<'w> {
    /// A tracer that follows rays to bounce `depth`.
    pub(crate) fn new(world: &'w World, depth: u32) -> Self {
        Self {
            world,
            depth,
            pending: Vec::new(),
            crossed: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// Radiance along a camera ray, which is followed as far as `reach`. Rays are traced depth
    /// first, reflection before refraction; those beyond the budget bring nothing. Stops early,
    /// with a useless result, once `cancelled` says so.
    pub(crate) fn radiance(
        &mut self,
        camera_ray: Ray,
        reach: f64,
        cancelled: impl Fn() -> bool,
    ) -> Seen {
        let mut seen = Seen {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
        };
        let mut traced = 0;
        self.pending.clear();
        self.pending.push(Pending {
            ray: camera_ray,
            weight: 1.0,
            bounce: 0,
        });
        while let Some(next) = self.pending.pop() {
            if traced == RAY_BUDGET {
                self.counts.over_budget += 1;
                break;
            }
            traced += 1;
            self.counts.rays += 1;
            let reach = if next.bounce == 0 {
                reach
            } else {
                f64::INFINITY
            };
            let Some(nearest) = self.world.nearest(&next.ray, reach) else {
                continue;
            };
            if next.bounce == 0 {
                seen.object = nearest.object;
            }
            seen.radiance += next.weight * self.local(&next, nearest);
            if traced.is_multiple_of(64) && cancelled() {
                break;
            }
        }
        seen
    }

    /// Ambient and direct light at a hit; leaves the rays that go on from it pending.
    fn local(&mut self, arrived: &Pending, nearest: Nearest) -> Rgb {
        let scene = &self.world.scene;
        let object = &scene.objects[nearest.object as usize];
        let surface = object.shape.surface(&arrived.ray, nearest.hit);
        let look = &self.world.looks[object.material_at(nearest.hit) as usize];
        let (material, emission) = match look {
            Look::Lit(material, emission) => (material, *emission),
            Look::Flat(colour) => return *colour,
        };
        let direction = arrived.ray.direction;
        let front = direction.dot(surface.normal) < 0.0;
        let (normal, textured) =
            self.world
                .textured(&arrived.ray, nearest, material, surface.shading);
        let point = Point {
            surface,
            // Which side is seen is the surface's to say, not the bumps'.
            normal: if front { normal } else { -normal },
            front,
            view: -direction,
            material: textured.as_ref().unwrap_or(material),
        };
        let mut radiance = emission + point.material.ambient * scene.ambient;
        for light in &scene.lights {
            radiance += self.direct(&point, light);
        }
        if arrived.bounce < self.depth {
            self.branch(arrived, &point);
        }
        radiance
    }

    /// Light from one light, by way of Phong's model.
    fn direct(&mut self, point: &Point<'_>, light: &Light) -> Rgb {
        let to_light = match light.source {
            Source::Point { position, .. } => (position - point.surface.point).normalize(),
            Source::Distant(toward) => toward,
            Source::Everywhere => return Rgb::ZERO,
        };
        let cosine = point.normal.dot(to_light);
        // It is NaN where the light stands at the point itself.
        if cosine <= 0.0 || cosine.is_nan() {
            return Rgb::ZERO;
        }
        let mirrored = 2.0 * cosine * point.normal - to_light;
        let highlight = phong(mirrored.dot(point.view), point.material.exponent);
        let reflected = point.material.diffuse * cosine + point.material.specular * highlight;
        if reflected == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let share = match &light.source {
            Source::Point { position, falloff } => {
                falloff.share(position.distance(point.surface.point), to_light)
            }
            Source::Distant(_) | Source::Everywhere => 1.0,
        };
        if share == 0.0 {
            return Rgb::ZERO;
        }
        self.visibility(point, light, to_light) * (reflected * (share * light.colour))
    }

    /// The part of the light that reaches the point.
    fn visibility(&mut self, point: &Point<'_>, light: &Light, to_light: DVec3) -> f64 {
        if light.shadows == Shadows::Off {
            return 1.0;
        }
        self.counts.rays += 1;
        let origin = point.surface.leave(to_light);
        let Source::Point { position, .. } = light.source else {
            let ray = Ray {
                origin,
                direction: to_light,
            };
            return self
                .world
                .transmittance(&ray, f64::INFINITY, &mut self.crossed);
        };
        let way = position - origin;
        let distance = way.length();
        // The surface that a light lies on does not block it: the way ends before that surface, by
        // as much as rounding may displace it.
        let reach = origin.abs().max(position.abs()).max_element();
        let ray = Ray {
            origin,
            direction: way / distance,
        };
        let end = distance - 32.0 * ulp(reach.max(distance));
        self.world.transmittance(&ray, end, &mut self.crossed)
    }

    /// Leaves the mirrored and the refracted ray pending, the mirrored one to be traced first.
    fn branch(&mut self, arrived: &Pending, point: &Point) {
        let direction = arrived.ray.direction;
        let Phong {
            reflection,
            transmission,
            index,
            ..
        } = *point.material;
        let mut mirrored_weight = reflection;
        if transmission != 0.0 {
            let index = if 0.0 < index { index } else { 1.0 };
            let ratio = if point.front { 1.0 / index } else { index };
            match refract(direction, point.normal, ratio) {
                Some(refracted) => self.push(arrived, point, refracted, transmission),
                // Total internal reflection: both rays go the same way and are traced as one.
                None => mirrored_weight += transmission,
            }
        }
        if mirrored_weight != 0.0 {
            let mirrored = direction - 2.0 * direction.dot(point.normal) * point.normal;
            self.push(arrived, point, mirrored.normalize(), mirrored_weight);
        }
    }

    fn push(&mut self, arrived: &Pending, point: &Point<'_>, direction: DVec3, weight: f64) {
        let ray = Ray {
            origin: point.surface.leave(direction),
            direction,
        };
        let weight = arrived.weight * weight;
        self.pending.push(Pending {
            ray,
            weight,
            bounce: arrived.bounce + 1,
        });
    }
}

impl Falloff {
    /// The part of the light that goes a distance in the direction from `to_light`, a unit vector.
    fn share(&self, distance: f64, to_light: DVec3) -> f64 {
        let [a0, a1, a2] = self.radial;
        let spread = a0 + a1 * distance + a2 * distance * distance;
        let radial = if 0.0 < spread { 1.0 / spread } else { 1.0 };
        let angular = self.spot.map_or(1.0, |(direction, exponent)| {
            let cosine = -direction.dot(to_light);
            // Behind a spot light it is dark, whatever the exponent.
            if cosine <= 0.0 {
                0.0
            } else {
                phong(cosine, exponent)
            }
        });
        radial * angular
    }
}

/// Snell's law: the refracted unit direction for a unit `direction` meeting a surface whose
/// `normal` is turned against it, `ratio` = n1/n2. `None` on total internal reflection.
pub(crate) fn refract(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cosine = -direction.dot(normal);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if squared < 0.0 {
        return None;
    }
    Some((ratio * direction + (ratio * cosine - squared.sqrt()) * normal).normalize())
}

/// Phong's highlight: cosineⁿ, 0 for a negative cosine; 0⁰ = 1, and n < 0 reads as 0. Whole
/// exponents to 4096 go by repeated squaring, which is exact to a few ulp, the same on every
/// machine and ten times as fast as the general power.
pub(crate) fn phong(cosine: f64, exponent: f64) -> f64 {
    if cosine < 0.0 {
        return 0.0;
    }
    let exponent = exponent.max(0.0);
    let whole = exponent as u32;
    if f64::from(whole) != exponent || 4096 < whole {
        return libm::pow(cosine, exponent);
    }
    let (mut power, mut square, mut rest) = (1.0, cosine, whole);
    while rest != 0 {
        if rest & 1 == 1 {
            power *= square;
        }
        square *= square;
        rest >>= 1;
    }
    power
}
