//! The configuration of property tests, which the tests of all rooms share.

use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

/// The configuration of property tests, which have the same cases in every run unless
/// `PROPTEST_RNG_SEED` is set: fuzzing looks for new ones. Those that once failed are kept beside the
/// tests, in files whose names end in `.regressions`.
pub fn config() -> Config {
    let default = Config::default();
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(0),
        fixed @ RngSeed::Fixed(_) => fixed,
    };
    let beside = FileFailurePersistence::WithSource("regressions");
    Config {
        failure_persistence: Some(Box::new(beside)),
        rng_seed,
        ..default
    }
}
