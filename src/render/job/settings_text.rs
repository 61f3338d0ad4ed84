//! Settings as text, with the names and values of the command line's options.

use super::aov::{AOVS, Aov};
use super::settings::Settings;
use scene::{RenderKey, Rendering, Size};

/// The entries of the first version but for the last. Those added since follow them,
/// and only where they are not their defaults.
const FIRST: [&str; 10] = [
    "size",
    "region",
    "depth",
    "seed",
    "aov",
    "integrator",
    "filter",
    "transfer",
    "exposure",
    "falloff",
];

/// The last entry.
const LAST: &str = "gloss";

/// The number of samples, which is written apart from the others.
pub(crate) const SAMPLES: &str = "spp";

/// The names of the entries, in order.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    let added = RenderKey::all().filter(|key| is_added(*key));
    let added = added.map(RenderKey::name);
    FIRST.into_iter().chain(added).chain([LAST])
}

/// Whether a setting was added since the first version.
pub(crate) fn is_added(key: RenderKey) -> bool {
    let name = key.name();
    !FIRST.contains(&name) && ![LAST, SAMPLES].contains(&name)
}

impl Settings {
    /// The name and value of each setting but the number of samples, in a fixed order, what was added
    /// since the first version only where it is not the default. Numbers are the shortest that read back
    /// as the same.
    pub fn written(&self) -> Vec<(&'static str, String)> {
        let asked = self.asked();
        names()
            .filter_map(|name| Some((name, self.entry(name, &asked)?)))
            .collect()
    }

    /// The value of an entry; `None` to leave it out.
    fn entry(&self, name: &str, asked: &Rendering) -> Option<String> {
        let Size { width, height } = self.size;
        let none = || "none".to_owned();
        Some(match name {
            "size" => format!("{width}x{height}"),
            "region" => self.region.map_or_else(none, |region| region.to_string()),
            "seed" => self.seed.to_string(),
            "aov" => self.aov.map_or_else(none, aov_name),
            _ => {
                let key = RenderKey::named(name)?;
                let value = key.value(asked);
                let is_left_out = is_added(key) && value == key.value(&Rendering::default());
                return (!is_left_out).then_some(value);
            }
        })
    }
}

pub(crate) fn aov_name(aov: Aov) -> String {
    match aov {
        Aov::Direct(light) => format!("direct {light}"),
        _ => aov.name().to_owned(),
    }
}

pub(crate) fn aov_of(written: &str) -> Option<Aov> {
    match written.strip_prefix("direct ") {
        Some(light) => light.parse().ok().map(Aov::Direct),
        None => AOVS.iter().copied().find(|aov| aov.name() == written),
    }
}
