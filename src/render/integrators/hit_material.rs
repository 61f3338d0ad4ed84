//! The material at the hit of a ray that is traced together with others.

use scene::Material;

/// The material at the hit of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) enum HitMaterial<'w> {
    /// The ray missed.
    Nothing,
    /// A material of the scene without maps.
    Plain(&'w Material),
    /// A material with its maps applied, by its index among those of the wave.
    Mapped(usize),
}

impl<'w> HitMaterial<'w> {
    /// Returns the material, given those with maps applied.
    #[inline]
    pub(crate) fn get<'m>(self, mapped: &'m [Material]) -> Option<&'m Material>
    where
        'w: 'm,
    {
        match self {
            Self::Nothing => None,
            Self::Plain(material) => Some(material),
            Self::Mapped(place) => mapped.get(place),
        }
    }
}
