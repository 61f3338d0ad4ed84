//! The words for what a record says of a ray. They are chosen here alone; scripts, the interface and
//! texts differ in how many of them they have room for.

use super::names::{exact_percent, percent, side};
use render::{RayKind, Side, Stop, SurfaceHit, UnlitReason};

/// Words for one thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Wording {
    /// The name in JSON, which scripts rely on.
    pub name: &'static str,
    /// Words for a line of the interface.
    pub short: String,
    /// Words for a line of text.
    pub long: String,
}

impl Wording {
    fn new(name: &'static str, short: impl Into<String>, long: impl Into<String>) -> Self {
        Self {
            name,
            short: short.into(),
            long: long.into(),
        }
    }

    /// The same words everywhere.
    fn same(words: &'static str) -> Self {
        Self::new(words, words, words)
    }
}

/// The words for what a ray is.
pub fn kind(kind: RayKind) -> Wording {
    let named = |name, long| Wording::new(name, name, long);
    match kind {
        RayKind::Camera => named("camera", "camera ray"),
        RayKind::Mirror => named("mirror", "mirrored ray"),
        RayKind::Boundary => {
            Wording::new("boundary", "reflection", "ray reflected at the boundary")
        }
        RayKind::Refraction => named("refraction", "refracted ray"),
        RayKind::TotalReflection => named("total reflection", "totally reflected ray"),
        RayKind::Diffuse => named("diffuse", "diffusely scattered ray"),
        RayKind::Glossy => named("glossy", "glossily scattered ray"),
    }
}

/// The words for why a light adds nothing.
pub fn unlit(reason: UnlitReason) -> Wording {
    let named = |name, long| Wording::new(name, name, long);
    match reason {
        UnlitReason::SwitchedOff => Wording::same("switched off"),
        UnlitReason::UnlitSide => named("unlit side", "not shown on this side"),
        UnlitReason::FacesAway => Wording::same("faces away"),
        UnlitReason::AtThePoint => Wording::same("at the point"),
        UnlitReason::OutsideCone => named("outside cone", "outside its cone"),
        UnlitReason::Attenuated => named("attenuated", "attenuated to nothing"),
        UnlitReason::NotReflected => Wording::same("not reflected"),
        UnlitReason::Blocked => Wording::new("blocked", "in shadow", "in shadow"),
        UnlitReason::Hidden => named("hidden", "hidden by another light"),
    }
}

/// The words for why no rays go on from a surface, given the maximum number of bounces.
pub fn stop(stop: Stop, depth: u32) -> Wording {
    match stop {
        Stop::Depth => Wording::new(
            "depth",
            format!("cut: depth {depth} is reached"),
            format!("cut by the depth of {depth}"),
        ),
        Stop::Budget => Wording::new(
            "budget",
            "cut: too many rays",
            "the path ends: the budget is spent",
        ),
        Stop::Nowhere => Wording::new(
            "nowhere",
            "ends: no way on",
            "the path ends: its direction leads nowhere",
        ),
        Stop::Overflow => Wording::new(
            "overflow",
            "ends: weight overflowed",
            "the path ends: its weight overflowed",
        ),
        Stop::Roulette { survival } => {
            let [short, long] = [exact_percent(survival), percent(survival)];
            Wording::new(
                "roulette",
                format!("ends by roulette, survival {short}"),
                format!("the path ends by Russian roulette, which it had survived with {long}"),
            )
        }
    }
}

/// The words for the side of a surface that a ray hit.
pub fn side_of(hit: &SurfaceHit) -> Wording {
    let name = side(hit.side);
    let short = match hit.side {
        Side::Back if hit.solid => "inside",
        _ => name,
    };
    Wording::new(name, short, name)
}
