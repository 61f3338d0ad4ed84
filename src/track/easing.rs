//! How values pass from one key to the next.

/// How values pass from a key to the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Easing {
    /// At constant speed.
    #[default]
    Linear,
    /// Starting and ending at rest: 3t² − 2t³.
    Smooth,
    /// All at once, at the next key.
    Hold,
}

impl Easing {
    /// All easings.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Smooth, Self::Hold];

    /// The name in a track file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Smooth => "smooth",
            Self::Hold => "hold",
        }
    }

    /// The easing with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|easing| easing.name() == name)
    }

    /// The fraction of the way that is covered after a fraction of the time, from 0 to below 1.
    pub fn at(self, time: f64) -> f64 {
        match self {
            Self::Linear => time,
            Self::Smooth => time * time * (3.0 - 2.0 * time),
            Self::Hold => 0.0,
        }
    }
}
