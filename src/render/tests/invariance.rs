//! Invariants of all scenes: the order of coincident surfaces, and pictures of scaled or moved
//! scenes.

use super::*;
use geometry::lanes::Level;
use geometry::{Cone, Cylinder, Ellipsoid, ulp};

/// A solid of any kind, before transformation.
#[derive(Clone, Copy, Debug)]
struct Form {
    kind: u32,
    origin: DVec3,
    directions: [DVec3; 3],
    lengths: DVec3,
}

impl Form {
    fn random(random: &mut Random) -> Self {
        let along = random.point(1.0).normalize();
        let across = along.cross(random.point(1.0)).normalize();
        Self {
            kind: (5.0 * random.next()) as u32,
            origin: random.point(2.0),
            directions: [along, across, along.cross(across)],
            lengths: 0.2 + 0.8 * DVec3::new(random.next(), random.next(), random.next()),
        }
    }

    /// A solid whose faces often coincide with those of others, up to rounding.
    fn stacked(random: &mut Random) -> Self {
        let mut place = || f64::from((4.0 * random.next()) as i32 - 2);
        let (x, y, z) = (place(), place(), place());
        // A rotated lattice, whose coordinates have no short binary fractions.
        let [along, up, across] = [
            DVec3::new(0.8, 0.0, -0.6),
            DVec3::Y,
            DVec3::new(0.6, 0.0, 0.8),
        ];
        let off = f64::from((5.0 * random.next()) as i32 - 2) * 50.0 * f64::EPSILON;
        Self {
            kind: 2 + (2.0 * random.next()) as u32,
            origin: 0.3 * (x * along + y * up + z * across) + off,
            directions: [along, up, across],
            lengths: DVec3::splat(0.3) * f64::from(1 + (2.0 * random.next()) as i32),
        }
    }

    fn placed(self, size: f64, by: DVec3) -> Shape {
        let (origin, lengths) = (size * self.origin + by, size * self.lengths);
        if self.kind == 0 {
            return sphere(origin.to_array(), lengths.x);
        }
        let frame = Affine::new(origin, self.directions, lengths).expect("it has a volume");
        match self.kind {
            1 => Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(frame)))),
            2 => Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame)))),
            3 => Shape::Solid(Solid::Cylinder(Box::new(Cylinder(frame)))),
            _ => Shape::Solid(Solid::Cone(Box::new(Cone(frame)))),
        }
    }
}

/// Solids of all kinds, matte, mirroring and glass, and two lights.
struct Still {
    solids: Vec<(Form, Coefficients)>,
    lights: [DVec3; 2],
}

impl Still {
    fn random(random: &mut Random) -> Self {
        let count = 3 + (9.0 * random.next()) as usize;
        let mut solid = || {
            let material = Coefficients {
                diffuse: 0.5 * (random.point(1.0) + 1.0),
                specular: Rgb::splat(0.3),
                exponent: 10.0,
                reflection: [0.0, 0.0, 0.4][(3.0 * random.next()) as usize],
                transmission: [0.0, 0.0, 0.6][(3.0 * random.next()) as usize],
                index: 1.3,
                ..grey(0.1)
            };
            (Form::random(random), material)
        };
        Self {
            solids: (0..count).map(|_| solid()).collect(),
            lights: [0, 1].map(|_| 6.0 * random.point(1.0) + DVec3::new(0.0, 3.0, 6.0)),
        }
    }

    /// The scene scaled about the origin, then moved.
    fn placed(&self, size: f64, by: DVec3) -> Arc<Scene> {
        let place = |point: DVec3| size * point + by;
        let objects: Vec<_> = self
            .solids
            .iter()
            .map(|&(solid, material)| (solid.placed(size, by), material))
            .collect();
        let lights = self
            .lights
            .map(|at| Light::point(place(at), Rgb::splat(0.6)));
        let mut scene = scene(&objects, &lights);
        scene.camera.eye = place(scene.camera.eye);
        scene.camera.target = place(scene.camera.target);
        Arc::new(scene)
    }
}

fn picture(scene: &Arc<Scene>) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(2);
    let generation = restart(&mut renderer, job(scene, settings(80, 60, 2)));
    finish(&renderer, &woken, generation)
}

/// SPEC: of the hits within 64 ulp of the least distance the first object of the file wins.
#[test]
fn of_coincident_hits_the_first_in_the_file_wins() {
    let mut random = Random(11);
    let mut ties = 0;
    for round in 0..60 {
        let shapes: Vec<_> = (0..[3, 40][round % 2])
            .map(|_| Form::stacked(&mut random).placed(1.0, DVec3::ZERO))
            .collect();
        let objects: Vec<_> = shapes.iter().map(|shape| (shape.clone(), BLACK)).collect();
        let world = world(scene(&objects, &[]));
        for _ in 0..500 {
            let origin = random.point(3.0);
            let ray = Ray {
                origin,
                direction: (random.point(0.6) - origin).normalize(),
            };
            let hits: Vec<_> = shapes
                .iter()
                .map(|shape| shape.hit(&ray, f64::INFINITY).map(|hit| hit.t))
                .collect();
            let least = hits.iter().flatten().copied().fold(f64::INFINITY, f64::min);
            let window = 64.0 * ulp(origin.length().max(least));
            let is_met = |t: &Option<f64>| t.is_some_and(|t| t <= least + window);
            ties += usize::from(1 < hits.iter().filter(|t| is_met(t)).count());
            let expected = hits.iter().position(is_met);
            let found = world.nearest(&ray, f64::INFINITY);
            assert_eq!(
                found.map(|found| found.object as usize),
                expected,
                "{ray:?}"
            );
        }
    }
    assert!(1000 < ties, "the test saw {ties} ties");
}

/// Camera samples have bitwise the same results with baseline vectors and with the best ones of
/// this machine, in packets and alone.
#[test]
fn radiance_does_not_depend_on_vectors_or_packets() {
    let mut random = Random(14);
    for _ in 0..40 {
        let scene = Still::random(&mut random).placed(1.0, DVec3::ZERO);
        let mut world = world(Scene::clone(&scene));
        let samples: Vec<_> = (0..100)
            .map(|_| {
                let origin = random.point(4.0);
                let direction = (random.point(1.0) - origin).normalize();
                centred(Ray { origin, direction }, f64::INFINITY)
            })
            .collect();
        // Which of several objects blocks a shadow ray, and is recorded, depends on the packet.
        let brought = |seen: &SampleResult| (seen.radiance, seen.object);
        let mut best = Vec::new();
        tracer(&world, 8).trace(&samples, &mut best);
        for (sample, seen) in samples.iter().zip(&best) {
            let alone = tracer(&world, 8).radiance(sample);
            assert_eq!(brought(&alone), brought(seen));
        }
        world.level = Level::baseline();
        let mut plain = Vec::new();
        tracer(&world, 8).trace(&samples, &mut plain);
        assert!(plain.iter().map(brought).eq(best.iter().map(brought)));
    }
}

/// SPEC: scaling a scene by 2^k leaves the picture bitwise the same.
#[test]
fn scaling_a_scene_by_a_power_of_two_keeps_the_picture() {
    let mut random = Random(12);
    for _ in 0..12 {
        let still = Still::random(&mut random);
        let before = picture(&still.placed(1.0, DVec3::ZERO));
        // Sizes and places are about 1: the last of them are just within the limits of sizes.
        for exponent in [-490, -30, -1, 3, 30, 490] {
            let scaled = picture(&still.placed(2_f64.powi(exponent), DVec3::ZERO));
            assert!(scaled.pixels == before.pixels, "2^{exponent}");
            assert!(scaled.objects == before.objects, "2^{exponent}");
            assert_eq!(scaled.progress.rays, before.progress.rays);
        }
    }
}

/// SPEC: moving a scene by 1e6 changes at most 0.1 % of the pixels by more than 1 level, all of
/// them at edges.
#[test]
fn moving_a_scene_far_away_nearly_keeps_the_picture() {
    let mut random = Random(13);
    for _ in 0..30 {
        let still = Still::random(&mut random);
        let before = picture(&still.placed(1.0, DVec3::ZERO));
        let moved = picture(&still.placed(1.0, 1e6 * random.point(1.0).normalize()));
        let far = |a: [u8; 3], b: [u8; 3]| (0..3).any(|k| 1 < a[k].abs_diff(b[k]));
        let Size { width, height } = before.size;
        let pixel = |x: u32, y: u32| before.pixels[(y * width + x) as usize];
        let mut differing = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let ours = pixel(x, y);
            if !far(ours, moved.pixels[(y * width + x) as usize]) {
                continue;
            }
            differing += 1;
            let near = |at: u32, end: u32| at.saturating_sub(1)..end.min(at + 2);
            let is_edge = near(y, height)
                .any(|row| near(x, width).any(|column| far(pixel(column, row), ours)));
            assert!(is_edge, "({x}, {y}) is at no edge");
        }
        assert!(
            1000 * differing <= width * height,
            "{differing} pixels differ"
        );
    }
}
