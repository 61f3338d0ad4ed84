//! The vector instructions that tracing uses.

use std::env;

use crate::geometry::lanes::Level;

/// The environment variable that caps the level, to measure and to compare levels on one machine. No
/// pixel depends on it.
pub const CAP: &str = "HALFLIGHT_CPU";

/// The values of [`CAP`], from the lowest level to the highest.
pub const CAPS: [&str; 4] = ["sse2", "sse4.2", "avx2", "avx512"];

/// The best level of this machine that [`CAP`] permits; what is none of [`CAPS`], which the command
/// line refuses unless it is empty, caps nothing.
pub(crate) fn level() -> Level {
    let best = Level::new();
    match env::var(CAP) {
        Ok(cap) => capped(best, &cap),
        Err(_) => best,
    }
}

#[cfg(target_arch = "x86_64")]
fn capped(best: Level, cap: &str) -> Level {
    let avx2 = || best.as_avx2().map(Level::Avx2);
    let sse4_2 = || best.as_sse4_2().map(Level::Sse4_2);
    match cap {
        "sse2" => Level::baseline(),
        "sse4.2" => sse4_2().unwrap_or(Level::baseline()),
        "avx2" => avx2().or_else(sse4_2).unwrap_or(Level::baseline()),
        _ => best,
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn capped(best: Level, _: &str) -> Level {
    best
}

/// The name of the level.
pub fn vectors() -> &'static str {
    let level = level();
    #[cfg(target_arch = "x86_64")]
    return match level {
        _ if level.as_avx512().is_some() => "AVX-512",
        _ if level.as_avx2().is_some() => "AVX2",
        _ if level.as_sse4_2().is_some() => "SSE4.2",
        _ => "SSE2",
    };
    #[cfg(not(target_arch = "x86_64"))]
    match level.is_fallback() {
        true => "no vectors",
        false => "native vectors",
    }
}
