//! Render settings as text, with the names and values of the command line's options.

use std::ops::RangeInclusive;

use super::frame::{Aov, Settings};
use super::region::Region;
use crate::scene::{FalloffRule, Filter, GlossRule, Integrator, MAX_PIXELS, Size, Transfer};

impl Settings {
    /// The name and value of each setting but the number of samples, in a fixed order, the noise and the
    /// clamp only if they are given. Numbers are the shortest that read back as the same bits.
    pub fn written(&self) -> Vec<(&'static str, String)> {
        let Self {
            size: Size { width, height },
            region,
            spp: _,
            depth,
            seed,
            aov,
            integrator,
            filter,
            transfer,
            exposure,
            falloff,
            gloss,
            noise,
            clamp,
        } = *self;
        let none = || "none".to_owned();
        let noise = noise.map(|noise| ("noise", noise.to_string()));
        let clamp = clamp.map(|most| ("clamp", most.to_string()));
        let always = [
            ("size", format!("{width}x{height}")),
            (
                "region",
                region.map_or_else(none, |region| region.to_string()),
            ),
            ("depth", depth.to_string()),
            ("seed", seed.to_string()),
            ("aov", aov.map_or_else(none, aov_name)),
            ("integrator", integrator.name().to_owned()),
            ("filter", filter.name().to_owned()),
            ("transfer", transfer.name().to_owned()),
            ("exposure", exposure.to_string()),
            ("falloff", falloff.name().to_owned()),
        ];
        let last = ("gloss", gloss.name().to_owned());
        always
            .into_iter()
            .chain(noise)
            .chain(clamp)
            .chain([last])
            .collect()
    }

    /// Reads settings as [`Settings::written`], in this order, for `spp` samples. `None` if they are
    /// no such settings, or of a picture of more than [`MAX_PIXELS`].
    pub fn read<'t>(pairs: impl IntoIterator<Item = (&'t str, &'t str)>, spp: u32) -> Option<Self> {
        let mut pairs = pairs.into_iter().peekable();
        let mut next = |name: &str| {
            let (written, value) = pairs.next()?;
            (written == name).then_some(value)
        };
        let size = Size::parse(next("size")?)?;
        let region = match next("region")? {
            "none" => None,
            region => Some(Region::parse(region)?.within(size).ok()?),
        };
        let mut settings = Self {
            size,
            region,
            spp,
            depth: next("depth")?.parse().ok()?,
            seed: next("seed")?.parse().ok()?,
            aov: match next("aov")? {
                "none" => None,
                aov => Some(aov_of(aov)?),
            },
            integrator: one_of(&Integrator::ALL, Integrator::name, next("integrator")?)?,
            filter: one_of(&Filter::ALL, Filter::name, next("filter")?)?,
            transfer: one_of(&Transfer::ALL, Transfer::name, next("transfer")?)?,
            exposure: next("exposure")?.parse().ok()?,
            falloff: one_of(&FalloffRule::ALL, FalloffRule::name, next("falloff")?)?,
            gloss: GlossRule::None,
            noise: None,
            clamp: None,
        };
        if let Some((_, noise)) = pairs.next_if(|(name, _)| *name == "noise") {
            let noise = noise.parse().ok();
            settings.noise = Some(noise.filter(|noise| 0.0 < *noise && *noise < 1.0)?);
        }
        if let Some((_, most)) = pairs.next_if(|(name, _)| *name == "clamp") {
            let most: Option<f64> = most.parse().ok();
            settings.clamp = Some(most.filter(|most| 0.0 < *most && most.is_finite())?);
        }
        let gloss = pairs.next().filter(|(name, _)| *name == "gloss")?.1;
        settings.gloss = one_of(&GlossRule::ALL, GlossRule::name, gloss)?;
        let is_possible = settings.traced().size().pixels() as u64 <= MAX_PIXELS;
        (is_possible && settings.exposure.is_finite()).then_some(settings)
    }
}

/// The AOVs that are named without a number.
pub(super) const AOVS: &[Aov] = &[
    Aov::Depth,
    Aov::Normal,
    Aov::Object,
    Aov::Albedo,
    Aov::Uv,
    Aov::Side,
    Aov::Cost,
    Aov::Samples,
    Aov::Noise,
    Aov::Emission,
    Aov::Indirect,
];

pub(super) fn one_of<T: Copy>(
    all: &[T],
    name: impl Fn(T) -> &'static str,
    written: &str,
) -> Option<T> {
    all.iter().copied().find(|&one| name(one) == written)
}

pub(super) fn whole_within(range: RangeInclusive<u32>, written: &str) -> Option<u32> {
    let number = written.parse().ok();
    number.filter(|number| range.contains(number))
}

pub(super) fn number_within(range: RangeInclusive<f64>, written: &str) -> Option<f64> {
    let number = written.parse().ok();
    number.filter(|number| range.contains(number))
}

pub(super) fn aov_name(aov: Aov) -> String {
    match aov {
        Aov::Direct(light) => format!("direct {light}"),
        _ => aov.name().to_owned(),
    }
}

pub(super) fn aov_of(written: &str) -> Option<Aov> {
    match written.strip_prefix("direct ") {
        Some(light) => light.parse().ok().map(Aov::Direct),
        None => one_of(AOVS, Aov::name, written),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size {
        width: 64,
        height: 48,
    };

    #[test]
    fn settings_read_back_as_they_were() {
        let plain = Settings {
            size: SIZE,
            region: None,
            spp: 4,
            depth: 8,
            seed: 0,
            aov: None,
            integrator: Integrator::Whitted,
            filter: Filter::Box,
            transfer: Transfer::Linear,
            exposure: 0.0,
            falloff: FalloffRule::None,
            gloss: GlossRule::None,
            noise: None,
            clamp: None,
        };
        let region = Region {
            x: 1,
            y: 2,
            width: 3,
            height: 4,
        };
        let other = Settings {
            region: Some(region),
            depth: 4096,
            seed: u32::MAX,
            integrator: Integrator::Path,
            filter: Filter::BlackmanHarris,
            transfer: Transfer::Srgb,
            exposure: -0.1,
            noise: Some(0.02),
            clamp: Some(8.5),
            ..plain
        };
        let with = |&aov: &Aov| Settings {
            aov: Some(aov),
            ..other
        };
        let aovs = AOVS.iter().chain(&[Aov::Direct(3)]).map(with);
        for settings in [plain, other].into_iter().chain(aovs) {
            let written = settings.written();
            let pairs = written.iter().map(|(name, value)| (*name, value.as_str()));
            assert_eq!(Settings::read(pairs, 4), Some(settings));
            // Each name and value is needed.
            for wrong in 0..written.len() {
                let pairs = written.iter().enumerate().map(|(at, (name, value))| {
                    (*name, if at == wrong { "?" } else { value.as_str() })
                });
                assert_eq!(Settings::read(pairs, 4), None);
            }
        }
    }
}
