//! Intersection of rays with a world: nearest hits and transmittance.

use std::cmp::Ordering;
use std::ops::Range;

use super::dependencies::Dependencies;
use super::spheres::MayMeet;
use super::structures::Search;
use super::{World, runs_in_file_order};
use geometry::lanes::{Eight, Lanes, Simd, SimdBase, WIDTH, bits, dispatch, each_bit};
use geometry::{Hit, Hits, Ray, Shape};

/// What shadow rays pass through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Occlusion {
    /// Surfaces whose materials transmit light, attenuated by them.
    ByMaterial,
    /// Nothing.
    Complete,
}

/// A surface that a shadow ray passes. Sorted, the surfaces of each ray are in file order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Passed {
    /// The number of the ray in its packet.
    pub(crate) ray: u32,
    pub(crate) object: u32,
    /// The object's material at the hit.
    pub(crate) material: u32,
}

/// The objects hit by shadow rays.
#[derive(Debug, Default)]
pub(crate) struct Crossed {
    /// Surfaces that transmit light.
    pub(crate) passed: Vec<Passed>,
    /// Whether to record dependencies.
    pub(crate) notes: bool,
    /// The dependencies of each ray of the current batch, if recorded.
    pub(crate) touched: Vec<Dependencies>,
    /// Index in `touched` of the first ray of the current packet.
    first: usize,
}

impl Crossed {
    /// Begins a packet of this many rays.
    #[inline]
    pub(crate) fn begin(&mut self, rays: usize) {
        self.passed.clear();
        if self.notes {
            self.first = self.touched.len();
            self.touched
                .resize(self.first + rays, Dependencies::default());
        }
    }

    /// Records that the rays whose bit in `lanes` is 1 depend on an object.
    #[inline]
    pub(crate) fn touch(&mut self, object: u32, mut lanes: u32) {
        if !self.notes {
            return;
        }
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            self.touched[self.first + lane] |= Dependencies::object(object);
        }
    }
}

/// The nearest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Index of the object.
    pub(crate) object: u32,
    /// The hit on its surface.
    pub(crate) hit: Hit,
}

/// The nearest hits of the rays of a packet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestHits {
    pub(crate) hits: Hits,
    /// The indices of the objects hit.
    objects: [f64; WIDTH],
}

impl NearestHits {
    /// No ray hits.
    pub(crate) const NONE: Self = Self {
        hits: Hits::NONE,
        objects: [0.0; WIDTH],
    };

    /// The nearest hit of the ray in a lane.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Option<Nearest> {
        (self.hits.lanes >> lane & 1 == 1).then(|| Nearest {
            object: self.objects[lane] as u32,
            hit: self.hits.hit(lane),
        })
    }

    /// Replaces the nearest hit of the ray in a lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, nearest: Option<Nearest>) {
        self.hits.put(lane, nearest.map(|nearest| nearest.hit));
        if let Some(Nearest { object, .. }) = nearest {
            self.objects[lane] = object.into();
        }
    }

    /// The lanes of rays that hit an object.
    #[inline(always)]
    pub(crate) fn lanes_of<S: Simd>(&self, simd: S, object: u32) -> u32 {
        let objects = Eight::load_array(simd, self.objects);
        bits::<S>(objects.equals(objects.all(object.into()))) & self.hits.lanes
    }
}

/// The nearest of the objects hit so far, in each lane.
///
/// Of objects hit within 64 ulp of the least distance, the first in the file counts, so that
/// touching solids show no speckle. Which of several such hits comes first depends on the traversal
/// until the least distance is known, so ties, which are rare, are only detected here.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest<N> {
    /// The least distance, infinite before the first hit, and what is hit there.
    t: N,
    object: N,
    part: N,
    /// 1 if another object may be hit at the least distance, else 0: a number, so that lanes can be
    /// taken out and put back.
    tied: N,
    /// Distance along the ray up to which a hit may still count.
    pub(crate) limit: N,
    /// Distance of the ray's origin from the world's origin.
    reach: N,
}

impl<N: Lanes> Closest<N> {
    #[inline(always)]
    pub(crate) fn before(limit: N, reach: N) -> Self {
        let zero = reach.all(0.0);
        Self {
            t: reach.all(f64::INFINITY),
            object: zero,
            part: zero,
            tied: zero,
            limit,
            reach,
        }
    }

    /// Takes hits of an object at distances, where the mask is true.
    #[inline(always)]
    pub(crate) fn offer(&mut self, object: u32, [t, part]: [N; 2], is_hit: N::Mask) {
        let one = t.all(1.0);
        let counts = is_hit & t.below(self.limit);
        let is_nearer = t.below(self.t);
        self.tied = N::select(counts & !is_nearer, one, self.tied);
        let is_nearer = counts & is_nearer;
        let end = t + t.all(64.0) * self.reach.larger(t).ulp();
        let is_tied = N::select(self.t.up_to(end), one, t.all(0.0));
        self.tied = N::select(is_nearer, is_tied, self.tied);
        self.object = N::select(is_nearer, t.all(object.into()), self.object);
        self.part = N::select(is_nearer, part, self.part);
        self.t = N::select(is_nearer, t, self.t);
        let limit = self.limit.smaller(end + end.ulp());
        self.limit = N::select(is_nearer, limit, self.limit);
    }
}

impl Closest<f64> {
    /// Takes a hit of an object.
    #[inline(always)]
    pub(crate) fn offer_one(&mut self, object: u32, hit: Hit) {
        self.offer(object, [hit.t, hit.part.into()], true);
    }

    fn best(&self) -> Option<Nearest> {
        (self.t != f64::INFINITY).then_some(Nearest {
            object: self.object as u32,
            hit: Hit {
                t: self.t,
                part: self.part as u32,
            },
        })
    }
}

impl<S: Simd> Closest<Eight<S>> {
    /// The nearest object in a lane.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Closest<f64> {
        Closest {
            t: self.t[lane],
            object: self.object[lane],
            part: self.part[lane],
            tied: self.tied[lane],
            limit: self.limit[lane],
            reach: self.reach[lane],
        }
    }

    /// Replaces the nearest object in a lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, closest: Closest<f64>) {
        self.t[lane] = closest.t;
        self.object[lane] = closest.object;
        self.part[lane] = closest.part;
        self.tied[lane] = closest.tied;
        self.limit[lane] = closest.limit;
    }

    /// The nearest hits in the given lanes, and the lanes of those that are tied.
    #[inline(always)]
    pub(crate) fn best_each(&self, lanes: u32) -> (NearestHits, u32) {
        let met = self.t.below(self.t.all(f64::INFINITY));
        let is_tied = self.tied.all(0.0).below(self.tied);
        let nearest = NearestHits {
            hits: Hits::of(lanes & bits::<S>(met), self.t, self.part),
            objects: *self.object,
        };
        (nearest, lanes & bits::<S>(is_tied))
    }
}

impl World {
    /// Returns the nearest object hit before `limit`; of those within 64 ulp of the least distance,
    /// the first in the file.
    pub(crate) fn nearest(&self, ray: &Ray, limit: f64) -> Option<Nearest> {
        dispatch!(self.level, simd => self.nearest_alone(simd, ray, limit))
    }

    /// The transmittance along the ray up to `distance`: the product of kt over every solid whose
    /// surface is crossed, each once, in file order. `crossed` is scratch space.
    pub(crate) fn transmittance(
        &self,
        ray: &Ray,
        distance: f64,
        occlusion: Occlusion,
        crossed: &mut Crossed,
    ) -> f64 {
        dispatch!(self.level, simd => {
            self.transmittance_alone(simd, ray, distance, occlusion, crossed)
        })
    }

    /// Returns each object that a ray hits before a limit, by its nearest hit, nearest first.
    pub(crate) fn crossings(&self, ray: &Ray, limit: f64) -> Vec<Nearest> {
        let mut crossed = Vec::new();
        dispatch!(self.level, simd => {
            self.visit(simd, ray, limit, |places| {
                self.meet(simd, ray, limit, places, Search::Nearest, |object, hit| {
                    crossed.push(Nearest { object, hit });
                });
                limit
            });
        });
        let order = |crossing: &Nearest| (crossing.hit.t, crossing.object);
        crossed.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(Ordering::Equal));
        crossed
    }

    /// The same as [`Self::nearest`] if only these objects, in file order, may be hit.
    pub(crate) fn nearest_of(&self, objects: &[u32], ray: &Ray, limit: f64) -> Option<Nearest> {
        dispatch!(self.level, simd => {
            let hit = |&object: &u32, limit| {
                let hit = self.hit(simd, object, ray, limit, Search::Nearest)?;
                Some(Nearest { object, hit })
            };
            let mut closest = Closest::before(limit, ray.origin.length());
            for object in objects {
                if let Some(Nearest { object, hit }) = hit(object, closest.limit) {
                    closest.offer_one(object, hit);
                }
            }
            if closest.tied == 0.0 {
                closest.best()
            } else {
                objects.iter().find_map(|object| hit(object, closest.limit))
            }
        })
    }

    #[inline(always)]
    pub(crate) fn nearest_alone<S: Simd>(&self, simd: S, ray: &Ray, limit: f64) -> Option<Nearest> {
        let mut closest = Closest::before(limit, ray.origin.length());
        self.visit(
            simd,
            ray,
            limit,
            #[inline(always)]
            |places| {
                let limit = closest.limit;
                self.meet(
                    simd,
                    ray,
                    limit,
                    places,
                    Search::Nearest,
                    #[inline(always)]
                    |object, hit| closest.offer_one(object, hit),
                );
                closest.limit
            },
        );
        if closest.tied == 0.0 {
            closest.best()
        } else {
            self.first_in_file(simd, ray, closest.limit)
        }
    }

    #[inline(always)]
    fn transmittance_alone<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        distance: f64,
        occlusion: Occlusion,
        crossed: &mut Crossed,
    ) -> f64 {
        crossed.touched.clear();
        crossed.begin(1);
        let mut blocked = false;
        self.visit(
            simd,
            ray,
            distance,
            #[inline(always)]
            |places| {
                self.meet(
                    simd,
                    ray,
                    distance,
                    places,
                    Search::Blocker,
                    #[inline(always)]
                    |object, hit| {
                        crossed.touch(object, 1);
                        let material = self.scene.objects[object as usize].material_at(hit);
                        if self.blocks(material, occlusion) {
                            blocked = true;
                        } else {
                            crossed.passed.push(Passed {
                                ray: 0,
                                object,
                                material,
                            });
                        }
                    },
                );
                if blocked { -1.0 } else { distance }
            },
        );
        if blocked {
            return 0.0;
        }
        crossed.passed.sort_unstable();
        crossed
            .passed
            .iter()
            .map(|passed| self.transmission(passed.material))
            .product()
    }

    /// Whether a material blocks shadow rays.
    #[inline]
    pub(crate) fn blocks(&self, material: u32, occlusion: Occlusion) -> bool {
        occlusion == Occlusion::Complete || self.transmission(material) == 0.0
    }

    /// Returns the first object in the file that is hit before a limit, which settles ties.
    #[inline(never)]
    pub(crate) fn first_in_file<S: Simd>(&self, simd: S, ray: &Ray, limit: f64) -> Option<Nearest> {
        // A function that is not inlined does not inherit the vector instructions of its caller.
        simd.vectorize(
            #[inline(always)]
            || {
                let mut first: Option<Nearest> = None;
                self.visit(
                    simd,
                    ray,
                    limit,
                    #[inline(always)]
                    |places| {
                        for &object in &self.order()[places] {
                            if first.is_none_or(|before| object < before.object)
                                && let Some(hit) =
                                    self.hit(simd, object, ray, limit, Search::Nearest)
                            {
                                first = Some(Nearest { object, hit });
                            }
                        }
                        limit
                    },
                );
                first
            },
        )
    }

    /// Reports the objects of a run that the ray hits before a limit.
    #[inline(always)]
    pub(crate) fn meet<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        limit: f64,
        places: Range<usize>,
        search: Search,
        mut met: impl FnMut(u32, Hit),
    ) {
        let order = &self.order()[places.clone()];
        let run = self.spheres.run(&places);
        let MayMeet { spheres, others } = run.may_meet(simd, ray);
        for at in each_bit(spheres) {
            if let Some(hit) = run.at(at).and_then(|sphere| sphere.hit(ray, limit)) {
                met(order[at], hit);
            }
        }
        for at in each_bit(others) {
            if let Some(hit) = self.hit(simd, order[at], ray, limit, search) {
                met(order[at], hit);
            }
        }
    }

    /// Intersects an object; shapes other than meshes always return their nearest hit.
    #[inline(always)]
    pub(crate) fn hit<S: Simd>(
        &self,
        simd: S,
        object: u32,
        ray: &Ray,
        limit: f64,
        search: Search,
    ) -> Option<Hit> {
        match &self.scene.objects[object as usize].shape {
            Shape::Mesh(instance) => {
                let search = self.search(object, search);
                let structures = &self.structures;
                structures.hit(simd, object, instance, ray, limit, search)
            }
            shape => shape.hit(ray, limit),
        }
    }

    /// Returns the search an object needs: in an opaque mesh any hit is as good as the nearest.
    pub(crate) fn search(&self, object: u32, search: Search) -> Search {
        match (search, self.opaque.get(object as usize)) {
            (Search::Blocker, Some(true)) => Search::Blocker,
            _ => Search::Nearest,
        }
    }

    /// Visits runs of [`World::order`] that include at least all objects the ray may hit.
    #[inline(always)]
    fn visit<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(Range<usize>) -> f64,
    ) {
        let Some(tree) = &self.tree else {
            // Outlined, because the traversal inlines `visit` as well.
            simd.vectorize(
                #[inline(always)]
                || {
                    for run in runs_in_file_order(self.scene.objects.len()) {
                        if visit(run) < 0.0 {
                            return;
                        }
                    }
                },
            );
            return;
        };
        tree.traverse(simd, ray, limit, visit);
    }
}
