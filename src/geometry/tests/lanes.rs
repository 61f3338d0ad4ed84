//! Packets of eight rays give the same bits as single rays, at every SIMD level.

use std::sync::Arc;

use glam::DVec3;

use super::csg::{csg, tree};
use super::random::Random;
use super::{Frame, KINDS, unit};
use crate::lanes::{Eight, Level, SimdBase, WIDTH, dispatch};
use crate::{
    ABSENT, Affine, Attribute, Hit, Hits, Instance, Mesh, MeshParts, Plane, Ray, Rays, Shape,
    Surface, ulp,
};

/// The SIMD levels that this machine supports.
fn levels() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![Level::baseline(), best];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_avx2().map(Level::Avx2));
    }
    levels
}

/// The hit of each ray, traced as a packet.
fn together(level: Level, shape: &Shape, rays: &[Ray; WIDTH], limit: f64) -> Vec<Option<Hit>> {
    let hits = dispatch!(level, simd => {
        let packet = Rays::gather(simd, rays);
        shape.hits(&packet, Eight::splat(simd, limit), 0xFF)
    });
    let of = |lane| Some(hits?).filter(|hits| hits.lanes >> lane & 1 == 1);
    (0..WIDTH)
        .map(|lane| of(lane).map(|hits| hits.hit(lane)))
        .collect()
}

/// The surfaces at the hits of a packet.
fn surfaces(level: Level, shape: &Shape, rays: &[Ray; WIDTH], hits: &Hits) -> Vec<Surface> {
    dispatch!(level, simd => {
        let packet = Rays::gather(simd, rays);
        let found = shape.surfaces(&packet, hits);
        let found = found.map(|found| (found.surface.store(), found.shading.store()));
        found.into_iter().flat_map(|(found, shading)| (0..WIDTH).map(move |lane| Surface {
            point: found.point.get(lane),
            normal: found.normal.get(lane),
            shading: shading.get(lane),
            scale: found.scale.0[lane],
        })).collect()
    })
}

/// Asserts that they are those of single rays.
fn same_surfaces(level: Level, shape: &Shape, rays: &[Ray; WIDTH], hits: &Hits) {
    let together = surfaces(level, shape, rays, hits);
    for lane in (0..WIDTH).filter(|lane| hits.lanes >> lane & 1 == 1) {
        let alone = shape.surface(&rays[lane], hits.hit(lane));
        assert_eq!(
            together[lane], alone,
            "{level:?} {shape:?} {:?}",
            rays[lane]
        );
    }
}

/// A ray from inside, near or far, toward a point in the solid or past it, often along an axis.
fn ray_at(random: &mut Random, frame: &Frame) -> Ray {
    let target = frame.world(1.1 * random.in_cube());
    let direction = match random.bits() % 4 {
        0 => unit(frame.directions[random.bits() as usize % 3]),
        1 => DVec3::AXES[random.bits() as usize % 3],
        _ => random.direction(),
    };
    let back = [0.0, 1.0, 30.0, 1e4, -2.0][random.bits() as usize % 5];
    Ray {
        origin: target - back * direction,
        direction,
    }
}

#[test]
fn packets_and_single_rays_have_the_same_hits() {
    let mut random = Random(31);
    let mut count = 0;
    for round in 0..400 {
        let mut frame = random.frame();
        if round % 4 == 0 {
            // Ill-conditioned.
            frame.lengths[round % 3] *= random.magnitude(-20.0, -5.0);
        }
        for kind in KINDS {
            let frame = frame.of(kind);
            let shape = frame.shape(kind);
            let rays = [(); WIDTH].map(|()| ray_at(&mut random, &frame));
            let limit = [f64::INFINITY, 3.0][round % 2];
            let alone: Vec<_> = rays.iter().map(|ray| shape.hit(ray, limit)).collect();
            count += alone.iter().flatten().count();
            for level in levels() {
                let hits = together(level, &shape, &rays, limit);
                assert_eq!(hits, alone, "{kind:?} {level:?} {rays:?}");
            }
        }
    }
    assert!(4000 < count, "{count} hits");
}

#[test]
fn packets_and_single_rays_have_the_same_surfaces() {
    let mut random = Random(32);
    for _ in 0..200 {
        let frame = random.frame();
        for kind in KINDS {
            let frame = frame.of(kind);
            let shape = frame.shape(kind);
            let rays = [(); WIDTH].map(|()| ray_at(&mut random, &frame));
            let hits = Hits::new(|lane| shape.hit(&rays[lane], f64::INFINITY));
            for level in levels() {
                same_surfaces(level, &shape, &rays, &hits);
            }
        }
    }
}

/// Between 2⁻¹⁰²² and 2⁻¹⁰²⁰ it may be twice the gap.
#[test]
fn an_ulp_is_the_gap_to_the_next_number() {
    let mut random = Random(33);
    let powers = (-1074..1024).map(|exponent| match exponent {
        ..-1022 => f64::from_bits(1 << (exponent + 1074)),
        _ => 2.0_f64.powi(exponent),
    });
    let numbers = powers.flat_map(|power| {
        let between = random.between(power, 2.0 * power);
        [power, power.next_down(), between.min(f64::MAX.next_down())]
    });
    for x in numbers.chain([0.0, f64::MIN_POSITIVE, f64::MAX.next_down()]) {
        let gap = x.next_up() - x;
        let is_rare = (f64::MIN_POSITIVE..=4.0 * f64::MIN_POSITIVE).contains(&x);
        assert!(ulp(-x) == gap || is_rare && ulp(x) == 2.0 * gap, "{x:e}");
    }
}

/// Trees of up to 32 leaves, with coincident faces, shared leaves, and more boundaries than are
/// kept.
#[test]
fn packets_and_single_rays_have_the_same_hits_with_csg() {
    let mut random = Random(32);
    let around = Frame::upright(DVec3::ZERO, DVec3::splat(2.5));
    let mut count = 0;
    for round in 0..2000 {
        let shape = csg(&tree(&mut random));
        let Shape::Csg(tree) = &shape else { continue };
        let rays = [(); WIDTH].map(|()| ray_at(&mut random, &around));
        let limit = [f64::INFINITY, 3.0][round % 2];
        let exact = rays.each_ref().map(|ray| tree.exact_hit(ray, limit));
        count += exact.iter().flatten().count();
        let alone = rays.each_ref().map(|ray| shape.hit(ray, limit));
        assert_eq!(alone, exact, "{rays:?}");
        let hits = Hits::new(|lane| exact[lane]);
        for level in levels() {
            let found = together(level, &shape, &rays, limit);
            assert_eq!(found, exact, "{level:?} {rays:?}");
            same_surfaces(level, &shape, &rays, &hits);
        }
    }
    assert!(1500 < count, "{count} hits");
}

/// Triangles of any form, some without an area, some with normals at all vertices.
#[test]
fn packets_and_single_rays_have_the_same_surfaces_with_meshes() {
    const TRIANGLES: u32 = 20;
    let mut random = Random(34);
    let mut count = 0;
    for round in 0..200 {
        let mut positions: Vec<_> = [(); 3 * TRIANGLES as usize]
            .map(|()| random.in_cube())
            .into();
        positions[1] = 0.5 * (positions[0] + positions[2]);
        positions[4] = positions[3];
        let triangles: Vec<_> = (0..TRIANGLES)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect();
        let mut normals = Attribute::default();
        if round % 4 != 0 {
            normals.values = [(); 5].map(|()| random.direction()).into();
            let mut corner = || match random.bits() % 20 {
                0 => ABSENT,
                bits => bits as u32 % 5,
            };
            normals.corners = triangles
                .iter()
                .map(|_| [(); 3].map(|()| corner()))
                .collect();
        }
        let parts = MeshParts {
            positions,
            triangles,
            normals,
            ..MeshParts::default()
        };
        let mesh = Arc::new(Mesh::new(parts).expect("the mesh is valid"));
        let frame = random.frame();
        let affine = frame.affine().expect("the frame spans a volume");
        let shape = Shape::Mesh(Box::new(Instance::new(mesh, &affine, Vec::new())));
        let rays = [(); WIDTH].map(|()| ray_at(&mut random, &frame));
        // A hit on the first two triangles is a rounding error, but must not be worse than that.
        let hits = Hits::new(|lane| match lane {
            0 | 1 => Some(Hit {
                t: 1.0,
                part: lane as u32,
            }),
            _ => shape.hit(&rays[lane], f64::INFINITY),
        });
        count += hits.lanes.count_ones();
        for level in levels() {
            same_surfaces(level, &shape, &rays, &hits);
        }
    }
    assert!(700 < count, "{count} hits");
}

#[test]
fn packets_and_single_rays_have_the_same_hits_and_surfaces_with_planes() {
    let mut random = Random(6);
    let mut count = 0;
    for _ in 0..200 {
        let directions = random.skewed(0.01);
        let lengths = DVec3::new(
            random.magnitude(-3.0, 3.0),
            random.magnitude(-3.0, 3.0),
            1.0,
        );
        let origin = random.magnitude(-3.0, 3.0) * random.in_cube();
        let frame = Affine::new(origin, directions, lengths).expect("it is not flat");
        let shape = Shape::Plane(Box::new(Plane(frame)));
        let rays = [(); WIDTH].map(|()| {
            let place = 1.1 * random.in_cube();
            let aim = origin
                + place.x * lengths.x * unit(directions[0])
                + place.y * lengths.y * unit(directions[1]);
            let direction = random.direction();
            Ray {
                origin: aim - random.magnitude(-3.0, 6.0) * direction,
                direction,
            }
        });
        let alone: Vec<_> = rays
            .iter()
            .map(|ray| shape.hit(ray, f64::INFINITY))
            .collect();
        for level in levels() {
            assert_eq!(together(level, &shape, &rays, f64::INFINITY), alone);
            let hits = Hits::new(|lane| alone[lane]);
            same_surfaces(level, &shape, &rays, &hits);
            count += hits.lanes.count_ones();
        }
    }
    assert!(1000 < count, "{count} hits");
}
