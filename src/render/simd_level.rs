//! The vector instructions that tracing uses.

use std::env;

use geometry::lanes::Level;

/// The environment variable that caps the level, to measure and to compare levels on one machine. No
/// pixel depends on it.
pub const CPU_LEVEL_VARIABLE: &str = "HALFLIGHT_CPU";

/// The values of [`CPU_LEVEL_VARIABLE`], from the lowest level to the highest.
pub const CPU_LEVELS: [&str; 3] = ["sse2", "avx2", "avx512"];

/// The best level of this machine that [`CPU_LEVEL_VARIABLE`] permits. A value that is not one of
/// [`CPU_LEVELS`] has no effect; the command line refuses it unless it is empty.
pub(crate) fn level() -> Level {
    let best = Level::new();
    match env::var(CPU_LEVEL_VARIABLE) {
        Ok(cap) => capped(best, &cap),
        Err(_) => best,
    }
}

#[cfg(target_arch = "x86_64")]
fn capped(best: Level, cap: &str) -> Level {
    match cap {
        "sse2" => Level::baseline(),
        "avx2" => best.as_avx2().map_or(Level::baseline(), Level::Avx2),
        _ => best,
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn capped(best: Level, _: &str) -> Level {
    best
}

/// The name of the level.
pub fn simd_level_name() -> &'static str {
    let level = level();
    #[cfg(target_arch = "x86_64")]
    return match level {
        _ if level.as_avx512().is_some() => "AVX-512",
        _ if level.as_avx2().is_some() => "AVX2",
        _ => "SSE2",
    };
    #[cfg(not(target_arch = "x86_64"))]
    match level.is_fallback() {
        true => "no vectors",
        false => "native vectors",
    }
}
