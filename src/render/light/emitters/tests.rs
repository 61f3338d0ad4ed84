//! The tree and the densities of emitters.

use std::array;
use std::f64::consts::PI;

use super::*;
use crate::tests::Random;
use cone::Cone;
use geometry::lanes::{Level, dispatch};
use geometry::{Affine, Ball, Flat};

/// The choices of [`Emitters::choose_together`] for one surface.
impl Emitters {
    /// Chooses one of the emitters for a surface at a point with a normal, by the third of its numbers
    /// in 0..1; `None` if none lights it.
    pub(crate) fn pick(
        &self,
        (from, normal): (DVec3, DVec3),
        [_, _, number, _]: [f64; 4],
    ) -> Option<Picked> {
        self.tree.choose(from, normal, number).map(Picked::from)
    }

    /// Chooses a direction from a point toward an emitter that was picked there, by two numbers in
    /// 0..1; `None` if there is none.
    pub(crate) fn choose(
        &self,
        scene: &Scene,
        from: DVec3,
        picked: Picked,
        place: [f64; 2],
    ) -> Option<Choice> {
        let aim = aim::aim(&self.patch(scene, picked.emitter)?, from, place)?;
        Some(self.choice(picked, aim))
    }
}

impl Random {
    fn direction(&mut self) -> DVec3 {
        loop {
            let point = self.point(1.0);
            if (0.01..1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }
}

/// Small emitters side by side that shine almost in one direction: from afar they look alike.
fn alike(count: usize, random: &mut Random) -> Vec<Reach> {
    let mut reaches = reaches(count, random);
    for reach in &mut reaches {
        reach.cone = Cone::around((DVec3::Z + 0.1 * random.direction()).normalize()).two_sided();
    }
    reaches
}

fn reaches(count: usize, random: &mut Random) -> Vec<Reach> {
    let mut reach = |_| {
        let corner = 5.0 * random.point(1.0);
        let bounds = Aabb {
            min: corner,
            max: corner + 0.3 * (random.point(1.0) + 1.0),
        };
        let cone = if random.next() < 0.2 {
            Cone::ALL
        } else {
            let cone = Cone::around(random.direction());
            if random.next() < 0.3 {
                cone.two_sided()
            } else {
                cone
            }
        };
        Reach {
            bounds,
            cone,
            strength: random.next(),
        }
    };
    (0..count).map(&mut reach).collect()
}

use geometry::Aabb;

/// The chances of all emitters sum to the part of 0..1 that leads to one, each is the length of the
/// interval that leads to it, and those that cannot light the point have none.
#[test]
fn chances_are_those_of_choices() {
    let mut random = Random(1);
    for count in [1, 2, 3, 17, 300] {
        let reaches = reaches(count, &mut random);
        let tree = Tree::build(&reaches, &|| false).expect("nothing cancels");
        for _ in 0..20 {
            let (from, normal) = (7.0 * random.point(1.0), random.direction());
            let chances: Vec<_> = (0..count as u32)
                .map(|emitter| tree.chance(emitter, from, normal))
                .collect();
            let mut found = vec![0.0; count];
            let fine = 20_000;
            for at in 0..fine {
                let number = (f64::from(at) + 0.5) / f64::from(fine);
                if let Some((emitter, chance)) = tree.choose(from, normal, number) {
                    let known = chances[emitter as usize];
                    assert!((chance - known).abs() <= 1e-12 * known);
                    found[emitter as usize] += 1.0 / f64::from(fine);
                }
            }
            for (chance, found) in chances.iter().zip(&found) {
                assert!(
                    (chance - found).abs() < 2.5 / f64::from(fine),
                    "{chance} {found}"
                );
            }
            let sum: f64 = chances.iter().sum();
            let lost = 1.0 - found.iter().sum::<f64>();
            assert!((sum + lost - 1.0).abs() < 1e-3, "{sum} {lost}");
        }
    }
}

#[test]
fn lanes_choose_the_same() {
    let mut random = Random(3);
    for (count, reaches) in [0, 1, 2, 17, 300]
        .into_iter()
        .flat_map(|count| [(count, reaches as fn(_, &mut _) -> _), (count, alike)])
    {
        let reaches: Vec<_> = reaches(count, &mut random);
        let tree = Tree::build(&reaches, &|| false).expect("nothing cancels");
        for (together, distance) in [(1, 7.0), (3, 70.0), (8, 7.0), (8, 20.0), (8, 70.0)] {
            let place = |_| (distance * random.point(1.0), random.direction());
            let surfaces: Vec<_> = (0..together).map(place).collect();
            let numbers: Vec<_> = surfaces.iter().map(|_| random.next()).collect();
            let alone = surfaces.iter().zip(&numbers);
            let alone = alone.map(|(&(from, normal), &number)| {
                tree.choose(from, normal, number).map(Picked::from)
            });
            let alone: Vec<_> = alone.collect();
            let mut at = [Vector::repeat(DVec3::ZERO); 2];
            let mut third = Row::all(0.0);
            for (lane, (&(from, normal), number)) in surfaces.iter().zip(&numbers).enumerate() {
                at[0].set(lane, from);
                at[1].set(lane, normal);
                third.0[lane] = *number;
            }
            let (from, normal) = (&at[0], &at[1]);
            for lanes in [(1 << together) - 1, 0b1010_0101] {
                let expected: [_; WIDTH] = array::from_fn(|lane| {
                    let alone = alone.get(lane).copied().flatten();
                    alone.filter(|_| lanes >> lane & 1 == 1)
                });
                for level in [Level::baseline(), Level::new()] {
                    let chosen = dispatch!(level, simd => {
                        tree.choose_together(simd, (from, normal), &third, lanes & ((1 << together) - 1))
                    });
                    assert_eq!(chosen, expected);
                }
            }
        }
    }
}

/// In an open scene, where all emitters can light the point, nothing is lost.
#[test]
fn chances_sum_to_one() {
    let mut random = Random(2);
    let mut reaches = reaches(500, &mut random);
    for reach in &mut reaches {
        reach.cone = Cone::ALL;
    }
    let tree = Tree::build(&reaches, &|| false).expect("nothing cancels");
    for _ in 0..50 {
        let from = 3.0 * random.point(1.0) - DVec3::new(0.0, 0.0, 30.0);
        let sum: f64 = (0..500)
            .map(|emitter| tree.chance(emitter, from, DVec3::Z))
            .sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
}

/// An emitter that can light a point, by any point of its box and any normal of its cone, is chosen
/// with a probability above 0.
#[test]
fn nothing_that_lights_a_point_is_left_out() {
    let mut random = Random(3);
    let reaches = reaches(60, &mut random);
    let tree = Tree::build(&reaches, &|| false).expect("nothing cancels");
    let mut lit = 0;
    for _ in 0..3000 {
        let (from, normal) = (6.0 * random.point(1.0), random.direction());
        let emitter = (random.next() * 60.0) as usize;
        let Reach { bounds, cone, .. } = reaches[emitter];
        let at = bounds.min + 0.5 * (random.point(1.0) + 1.0) * bounds.size();
        let toward = (at - from).normalize();
        let sent = -toward.dot(cone.axis);
        let sends = cone.cosine == -1.0 || 1e-9 < sent || cone.is_two_sided && sent < -1e-9;
        if sends && 1e-9 < toward.dot(normal) {
            lit += 1;
            assert!(0.0 < tree.chance(emitter as u32, from, normal));
        }
    }
    assert!(500 < lit, "{lit}");
}

/// Normals of both cones stay inside of their union.
#[test]
fn cones_contain_both() {
    let mut random = Random(4);
    let within = |random: &mut Random, cone: &Cone| loop {
        let direction = random.direction();
        if cone.cosine <= direction.dot(cone.axis) {
            return direction;
        }
    };
    for _ in 0..300 {
        let cones: [Cone; 2] = array::from_fn(|_| Cone {
            cosine: 1.6 * random.next() - 0.6,
            ..Cone::around(random.direction())
        });
        let union = cones[0].union(&cones[1]);
        for cone in cones {
            for _ in 0..10 {
                let direction = within(&mut random, &cone);
                let cosine = direction.dot(union.axis);
                assert!(union.cosine <= cosine + 1e-12, "{cones:?} {union:?}");
            }
        }
    }
    let up = Cone::around(DVec3::Z).two_sided();
    let down = Cone::around(DVec3::NEG_Z).two_sided();
    assert_eq!(up.union(&down).cosine, 1.0);
    let up = Cone::around(DVec3::Z);
    let all_around = up.union(&Cone::around(DVec3::NEG_Z)).cosine;
    assert!(all_around <= 0.0, "{all_around}");
}

/// 1 / density, averaged over chosen directions, is the solid angle: of a hemisphere's octant for a
/// triangle seen from its centre, and of ellipsoids by their silhouette.
#[test]
fn densities_are_those_of_aims() {
    let triangle = Patch::Triangle(Flat {
        corner: DVec3::X,
        sides: [DVec3::Y - DVec3::X, DVec3::Z - DVec3::X],
        normal: DVec3::ONE,
    });
    let square = Patch::Parallelogram(Flat {
        corner: DVec3::new(-1.0, -1.0, 1.0),
        sides: [2.0 * DVec3::X, 2.0 * DVec3::Y],
        normal: 4.0 * DVec3::Z,
    });
    let frame = Affine::new(
        DVec3::new(3.0, 1.0, 0.5),
        [
            DVec3::new(1.0, 0.5, 0.0),
            DVec3::Y,
            DVec3::new(0.2, 0.0, 1.0),
        ],
        DVec3::new(1.0, 2.0, 0.4),
    );
    let solid = geometry::Solid::Ellipsoid(Box::new(geometry::Ellipsoid(
        frame.expect("the axes span a volume"),
    )));
    let ellipsoid = Shape::Solid(solid);
    let patch = ellipsoid.patch(0).expect("an ellipsoid has a form");
    // The share of directions that hit it.
    let mut random = Random(5);
    let mut hits = 0;
    for _ in 0..100_000 {
        let ray = Ray {
            origin: DVec3::ZERO,
            direction: random.direction(),
        };
        hits += u32::from(ellipsoid.hit(&ray, f64::INFINITY).is_some());
    }
    let seen = 4.0 * PI * f64::from(hits) / 100_000.0;
    let ball = Patch::Ball(Ball {
        centre: DVec3::new(0.0, 0.0, 2.0),
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
        duals: [DVec3::X, DVec3::Y, DVec3::Z],
    });
    for (patch, expected, tolerance) in [
        // An octant, and a face of a cube from its centre.
        (triangle, PI / 2.0, 2e-3),
        (square, 4.0 * PI / 6.0, 1e-3),
        (ball, 2.0 * PI * (1.0 - 0.75f64.sqrt()), 1e-12),
        (patch, seen, 0.04 * seen),
    ] {
        let side = 100;
        let mut sum = 0.0;
        for i in 0..side * side {
            let place = [i / side, i % side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
            let aim = aim::aim(&patch, DVec3::ZERO, place).expect("it is seen");
            let at = hit_by(&patch, aim.toward);
            let density = aim::density(&patch, DVec3::ZERO, aim.toward, at);
            assert!((density / aim.density - 1.0).abs() < 1e-12, "{patch:?}");
            sum += 1.0 / density;
            assert!(at.length() <= aim.reach, "{patch:?}");
        }
        let angle = sum / f64::from(side * side);
        assert!((angle - expected).abs() <= tolerance, "{angle} {expected}");
    }
}

/// Where a ray from the origin hits a flat part; the origin for a ball.
fn hit_by(patch: &Patch, toward: DVec3) -> DVec3 {
    match patch {
        Patch::Triangle(flat) | Patch::Parallelogram(flat) => {
            flat.corner.dot(flat.normal) / toward.dot(flat.normal) * toward
        }
        Patch::Ball(_) => DVec3::ZERO,
    }
}
