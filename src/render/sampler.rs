//! Sample numbers, uniformly distributed; filters warp them later.

use sobol_burley::sample_4d;

/// The numbers of one sample, each a function of pixel, index, seed and purpose: points of Sobol'
/// sequences, each Owen-scrambled with its own seed (Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sampler {
    pixel: [u32; 2],
    index: u32,
    seed: u32,
}

/// The purpose of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// The point on the lens.
    Lens,
    /// The spread of a reflected ray.
    Reflection,
    /// The spread of a refracted ray.
    Refraction,
    /// The continuation of a path.
    Bounce,
    /// The spread of a path's continuation.
    Spread,
    /// The point on the light with this index.
    Light(u32),
    /// The object that emits light, and the point on it.
    Emitter,
    /// The direction to the environment.
    Sky,
    /// The light and direction of a photon.
    Emission,
}

impl Sampler {
    /// The node of camera rays.
    pub(crate) const ROOT: u32 = 0;

    /// Creates the sampler for sample `index`, below [`MAX_SPP`](crate::scene::MAX_SPP), of pixel (x, y).
    pub(crate) fn new(x: u32, y: u32, index: u32, seed: u32) -> Self {
        Self {
            pixel: [x, y],
            index,
            seed,
        }
    }

    /// The index of the sample.
    pub(crate) fn index(self) -> u32 {
        self.index
    }

    /// The place in the pixel, 0..1 from its top left corner; the centre for sample 0.
    #[inline]
    pub(crate) fn place_in_pixel(self) -> [f64; 2] {
        if self.index == 0 {
            return [0.5, 0.5];
        }
        let [x, y, ..] = sample_4d(self.index, 0, self.pixel_seed());
        [x.into(), y.into()]
    }

    /// The node of a ray's `number`th child. Rays with different nodes get different numbers.
    pub(crate) fn child(node: u32, number: u32) -> u32 {
        mix(node ^ 0x5851_F42D).wrapping_add(number + 1)
    }

    /// Two numbers in 0..1 for a purpose at a node; `None` for sample 0, which takes the centre of
    /// every distribution.
    pub(crate) fn pair(self, node: u32, purpose: Use) -> Option<[f64; 2]> {
        if self.index == 0 {
            return None;
        }
        let [u, v, ..] = self.four(node, purpose);
        Some([u, v])
    }

    /// Four numbers in 0..1 for a purpose at a node, at any index.
    pub(crate) fn four(self, node: u32, purpose: Use) -> [f64; 4] {
        let purpose = match purpose {
            Use::Lens => 0,
            Use::Reflection => 1,
            Use::Refraction => 2,
            Use::Bounce => 3,
            Use::Spread => 4,
            Use::Light(number) => 5 + number,
            // Far from the lights' numbers.
            Use::Emitter => u32::MAX,
            Use::Sky => u32::MAX - 1,
            Use::Emission => u32::MAX - 2,
        };
        let seed = mix(mix(self.pixel_seed() ^ node).wrapping_add(0x9E37_79B9) ^ purpose);
        sample_4d(self.index, 0, seed).map(f64::from)
    }

    /// Hashes pixel and seed so that adjacent pixels get unrelated patterns. Computed on demand: a
    /// picture with one sample per pixel does not need it.
    fn pixel_seed(self) -> u32 {
        let [x, y] = self.pixel;
        mix(mix(mix(self.seed ^ 0x9E37_79B9) ^ x).wrapping_add(0x9E37_79B9) ^ y)
    }
}

/// The finaliser of `MurmurHash3` (Appleby, public domain).
fn mix(mut hash: u32) -> u32 {
    hash ^= hash >> 16;
    hash = hash.wrapping_mul(0x85EB_CA6B);
    hash ^= hash >> 13;
    hash = hash.wrapping_mul(0xC2B2_AE35);
    hash ^ (hash >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every prefix of 2^k points has exactly one in each of 2^k equal strips, across and down: the
    /// one-dimensional stratification of a (0, 2)-sequence in base 2.
    #[test]
    fn power_of_two_prefixes_are_stratified_apart_from_the_centre() {
        for (x, y) in [(0, 0), (7, 3), (1919, 1079)] {
            for count in [4u32, 16, 64, 256] {
                for axis in 0..2 {
                    let mut strips = vec![0; count as usize];
                    // Points count..2·count form such a block without the centre sample.
                    for index in count..2 * count {
                        let place = Sampler::new(x, y, index, 0).place_in_pixel()[axis];
                        assert!((0.0..1.0).contains(&place));
                        strips[(place * f64::from(count)) as usize] += 1;
                    }
                    assert_eq!(
                        strips,
                        vec![1; count as usize],
                        "pixel ({x}, {y}), {count} points"
                    );
                }
            }
        }
    }

    #[test]
    fn sample_zero_is_the_centre_and_pixels_differ() {
        assert_eq!(Sampler::new(5, 9, 0, 3).place_in_pixel(), [0.5, 0.5]);
        assert_ne!(
            Sampler::new(5, 9, 1, 3).place_in_pixel(),
            Sampler::new(9, 5, 1, 3).place_in_pixel()
        );
        assert_ne!(
            Sampler::new(5, 9, 1, 3).place_in_pixel(),
            Sampler::new(5, 9, 1, 4).place_in_pixel()
        );
    }
}
