//! Intersection of rays with a world in packets of eight.
//!
//! When only one ray is left, it is tested against all spheres of a run at once. Rejected: doing so for
//! two rays as well (no less time).

use std::ops::Range;

use super::intersect::{Closest, Crossed, NearestHits, Occlusion, Passed};
use super::structures::Search;
use super::{World, runs_in_file_order};
use accel::Order;
use geometry::lanes::{Eight, Lanes, Simd, SimdBase, Vector, WIDTH, dispatch, each_bit, mask};
use geometry::{Hit, Hits, Packet, Rays, Shape, Sphere, sphere_hits};
use scene::Object;

impl World {
    /// Returns [`World::nearest`] for each ray, packet by packet.
    pub(crate) fn nearest_each(&self, packets: &[Packet], nearest: &mut Vec<NearestHits>) {
        nearest.clear();
        dispatch!(self.level, simd => {
            for packet in packets {
                nearest.push(self.nearest_together(simd, packet));
            }
        });
    }

    /// Returns [`World::transmittance`] for each ray up to its end. `blocker` is a likely occluder
    /// to try first; it is set to the last simple object that blocked a ray.
    pub(crate) fn transmittance_each(
        &self,
        packets: &[Packet],
        occlusion: Occlusion,
        blocker: &mut Option<u32>,
        crossed: &mut Crossed,
        transmittances: &mut Vec<f64>,
    ) {
        transmittances.clear();
        crossed.touched.clear();
        dispatch!(self.level, simd => {
            for packet in packets {
                self.transmittance_together(simd, packet, occlusion, blocker, crossed, transmittances);
            }
        });
    }

    #[inline(always)]
    fn transmittance_together<S: Simd>(
        &self,
        simd: S,
        packet: &Packet,
        occlusion: Occlusion,
        blocker: &mut Option<u32>,
        crossed: &mut Crossed,
        transmittances: &mut Vec<f64>,
    ) {
        crossed.begin(packet.lanes.count_ones() as usize);
        let rays = packet.rays.load(simd);
        let mut open = packet.lanes;
        let closed = Eight::splat(simd, -1.0);
        let mut limits = Lanes::select(mask(simd, open), packet.ends.load(simd), closed);
        if let Some(object) = *blocker
            && let Some(hits) = self.hits(&rays, object, open, &limits, Search::Blocker)
        {
            let blocked = self.blocked(object, &hits, occlusion);
            crossed.touch(object, hits.lanes);
            open &= !blocked;
            close(&mut limits, blocked);
        }
        self.visit_together(
            &rays,
            open,
            limits,
            Order::LargeFirst,
            #[inline(always)]
            |places, lanes, mut limits| {
                let left = lanes & open;
                if left.is_power_of_two() {
                    let lane = left.trailing_zeros();
                    self.meet_alone(
                        packet,
                        lane as usize,
                        &limits,
                        places,
                        Search::Blocker,
                        #[inline(always)]
                        |object, hit| {
                            crossed.touch(object, left);
                            let material = self.scene.objects[object as usize].material_at(hit);
                            if self.blocks(material, occlusion) {
                                self.remember(blocker, object);
                                open &= !left;
                            } else {
                                crossed.passed.push(Passed {
                                    ray: lane,
                                    object,
                                    material,
                                });
                            }
                        },
                    );
                    close(&mut limits, left & !open);
                    return limits;
                }
                let spheres = self.spheres.run(&places);
                for (at, place) in places.enumerate() {
                    let lanes = lanes & open;
                    let at = (spheres.at(at), self.order()[place]);
                    let hits = self.hits_at(&rays, at, lanes, &limits, Search::Blocker);
                    let Some(hits) = hits else { continue };
                    let object = self.order()[place];
                    let blocked = self.blocked(object, &hits, occlusion);
                    crossed.touch(object, hits.lanes);
                    if blocked != 0 {
                        self.remember(blocker, object);
                        open &= !blocked;
                        close(&mut limits, blocked);
                    }
                    let mut passed = hits.lanes & !blocked;
                    while passed != 0 {
                        let lane = passed.trailing_zeros();
                        passed &= passed - 1;
                        let hit = hits.hit(lane as usize);
                        let material = self.scene.objects[object as usize].material_at(hit);
                        crossed.passed.push(Passed {
                            ray: lane,
                            object,
                            material,
                        });
                    }
                }
                limits
            },
        );
        crossed.passed.sort_unstable();
        let mut next = 0;
        for lane in 0..packet.lanes.count_ones() {
            let mut transmittance = 1.0;
            while let Some(passed) = crossed.passed.get(next)
                && passed.ray == lane
            {
                transmittance *= self.transmission(passed.material);
                next += 1;
            }
            let is_open = open >> lane & 1 == 1;
            transmittances.push(if is_open { transmittance } else { 0.0 });
        }
    }

    /// Of the lanes that hit an object, returns those that it blocks completely.
    #[inline(always)]
    fn blocked(&self, object: u32, hits: &Hits, occlusion: Occlusion) -> u32 {
        let Object { shape, material } = &self.scene.objects[object as usize];
        if !matches!(shape, Shape::Mesh(_) | Shape::Csg(_)) {
            let blocks = self.blocks(*material, occlusion);
            return if blocks { hits.lanes } else { 0 };
        }
        let mut blocked = 0;
        let mut lanes = hits.lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros();
            lanes &= lanes - 1;
            let hit = hits.hit(lane as usize);
            let material = self.scene.objects[object as usize].material_at(hit);
            blocked |= u32::from(self.blocks(material, occlusion)) << lane;
        }
        blocked
    }

    #[inline(always)]
    fn nearest_together<S: Simd>(&self, simd: S, packet: &Packet) -> NearestHits {
        let rays = packet.rays.load(simd);
        if let Some(tree) = &self.tree
            && !tree.takes_together(&rays)
        {
            let mut nearest = NearestHits::NONE;
            for lane in each_bit(packet.lanes) {
                let lane = lane % WIDTH;
                let (ray, end) = (packet.ray(lane), packet.ends.0[lane]);
                let alone = simd.vectorize(
                    #[inline(always)]
                    || self.nearest_alone(simd, &ray, end),
                );
                nearest.put(lane, alone);
            }
            return nearest;
        }
        let reach = rays.origin.length();
        let closed = Eight::splat(simd, -1.0);
        let limits = Lanes::select(mask(simd, packet.lanes), packet.ends.load(simd), closed);
        let mut closest = Closest::before(limits, reach);
        self.visit_together(
            &rays,
            packet.lanes,
            limits,
            Order::NearFirst,
            #[inline(always)]
            |places, lanes, _| {
                if lanes.is_power_of_two() {
                    let lane = lanes.trailing_zeros() as usize % WIDTH;
                    let mut alone = closest.lane(lane);
                    self.meet_alone(
                        packet,
                        lane,
                        &closest.limit,
                        places,
                        Search::Nearest,
                        #[inline(always)]
                        |object, hit| alone.offer_one(object, hit),
                    );
                    closest.put(lane, alone);
                    return closest.limit;
                }
                let spheres = self.spheres.run(&places);
                for (at, place) in places.enumerate() {
                    let (limits, object) = (&closest.limit, self.order()[place]);
                    let at = (spheres.at(at), object);
                    let hits = self.hits_at(&rays, at, lanes, limits, Search::Nearest);
                    if let Some(hits) = hits {
                        let ends = [hits.distances(simd), hits.parts(simd)];
                        closest.offer(object, ends, mask(simd, hits.lanes));
                    }
                }
                closest.limit
            },
        );
        let (mut nearest, tied) = closest.best_each(packet.lanes);
        for lane in each_bit(tied) {
            let lane = lane % WIDTH;
            let (ray, limit) = (packet.ray(lane), closest.limit[lane]);
            nearest.put(lane, self.first_in_file(simd, &ray, limit));
        }
        nearest
    }

    /// Runs [`World::meet`] for one ray of a packet.
    #[inline(always)]
    fn meet_alone<S: Simd>(
        &self,
        packet: &Packet,
        lane: usize,
        limits: &Eight<S>,
        places: Range<usize>,
        search: Search,
        met: impl FnMut(u32, Hit),
    ) {
        let ray = packet.ray(lane);
        self.meet(limits.simd, &ray, limits[lane], places, search, met);
    }

    /// Runs [`World::hits`] for an object, given its sphere if it is one: copies of spheres close in
    /// space are close in memory.
    #[inline(always)]
    fn hits_at<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        (sphere, object): (Option<Sphere>, u32),
        lanes: u32,
        limits: &Eight<S>,
        search: Search,
    ) -> Option<Hits> {
        let Some(Sphere { centre, radius }) = sphere else {
            return self.hits(rays, object, lanes, limits, search);
        };
        let like = limits;
        sphere_hits(
            Vector::all(*like, centre),
            like.all(radius),
            rays,
            *limits,
            lanes,
        )
    }

    /// Intersects an object with the rays of a packet whose bit in `lanes` is 1.
    ///
    /// Not inlined but compiled for the vectors of `simd`: it holds the code of all shapes.
    #[inline(always)]
    fn hits<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        object: u32,
        lanes: u32,
        limits: &Eight<S>,
        search: Search,
    ) -> Option<Hits> {
        let simd = limits.simd;
        simd.vectorize(
            #[inline(always)]
            || match &self.scene.objects[object as usize].shape {
                Shape::Mesh(instance) => {
                    let search = self.search(object, search);
                    let structures = &self.structures;
                    limits.outlined(
                        #[inline(always)]
                        || structures.hits(object, instance, rays, lanes, limits, search),
                    )
                }
                shape => shape.hits(rays, *limits, lanes),
            },
        )
    }

    /// Remembers an object that blocks light, to be tried first, if that is no slower than testing
    /// its bounding boxes.
    fn remember(&self, blocker: &mut Option<u32>, object: u32) {
        let shape = &self.scene.objects[object as usize].shape;
        if !matches!(shape, Shape::Mesh(_) | Shape::Csg(_)) {
            *blocker = Some(object);
        }
    }

    /// Visits ranges of [`World::order`] that include at least all objects that some ray may hit.
    #[inline(always)]
    fn visit_together<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        lanes: u32,
        limits: Eight<S>,
        order: Order,
        mut visit: impl FnMut(Range<usize>, u32, Eight<S>) -> Eight<S>,
    ) {
        if let Some(tree) = &self.tree {
            tree.traverse_packet(rays, lanes, limits, order, visit);
            return;
        }
        // Outlined, because the traversal inlines `visit` as well.
        limits.outlined(
            #[inline(always)]
            || {
                let mut limits = limits;
                for run in runs_in_file_order(self.scene.objects.len()) {
                    limits = visit(run, lanes, limits);
                }
            },
        );
    }
}

/// Disables some rays, by limits below 0.
#[inline(always)]
fn close<S: Simd>(limits: &mut Eight<S>, mut lanes: u32) {
    while lanes != 0 {
        limits[lanes.trailing_zeros() as usize % WIDTH] = -1.0;
        lanes &= lanes - 1;
    }
}
