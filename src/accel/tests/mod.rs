mod build;
mod overlap;
mod walk;

use glam::DVec3;

use super::Bvh;
use geometry::Aabb;

/// `SplitMix64` (Steele, Lea and Flood, 2014): reproducible numbers without a dependency.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// A number in −1..1.
    fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-52) - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.bits() as usize % from.len()]
    }
}

fn build(boxes: &[Aabb]) -> Bvh {
    Bvh::build(boxes, &|| false).expect("never cancelled")
}

fn cube(centre: DVec3, half: DVec3) -> Aabb {
    Aabb {
        min: centre - half,
        max: centre + half,
    }
}

/// Boxes of many sizes, every fourth of them flat.
fn random_boxes(random: &mut Random, count: usize, scale: f64, around: DVec3) -> Vec<Aabb> {
    let boxes = (0..count).map(|i| {
        let mut half = random.point().abs() * 0.2 * random.signed().abs();
        if i % 4 == 0 {
            half[i / 4 % 3] = 0.0;
        }
        cube(around + scale * random.point(), scale * half)
    });
    boxes.collect()
}

/// The heap memory of a tree, in bytes.
fn memory(bvh: &Bvh) -> usize {
    size_of_val(bvh.nodes.as_slice()) + size_of_val(bvh.order.as_slice())
}
