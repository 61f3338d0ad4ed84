//! What the pixels of pictures are drawn with.

/// The user's choice of what pixels are drawn with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pixels {
    /// In real pixels if the terminal says that it shows them, otherwise as [`Pixels::Half`].
    #[default]
    Auto,
    /// Two in each cell.
    Half,
    /// Four in each cell.
    Quadrant,
    /// Six in each cell.
    Sextant,
    /// Eight in each cell.
    Octant,
    /// Real pixels, in kitty's protocol.
    Kitty,
    /// Real pixels in 256 colours.
    Sixel,
    /// Real pixels, in iTerm2's protocol.
    Iterm,
}

impl Pixels {
    /// All choices.
    pub const ALL: [Self; 8] = [
        Self::Auto,
        Self::Half,
        Self::Quadrant,
        Self::Sextant,
        Self::Octant,
        Self::Kitty,
        Self::Sixel,
        Self::Iterm,
    ];

    /// The name of the choice.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Half => "half",
            Self::Quadrant => "quadrant",
            Self::Sextant => "sextant",
            Self::Octant => "octant",
            Self::Kitty => "kitty",
            Self::Sixel => "sixel",
            Self::Iterm => "iterm",
        }
    }

    /// The choice with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name)
    }

    /// All names, for messages: `auto, half, … or iterm`.
    pub fn names() -> String {
        text::alternatives(Self::ALL.map(Self::name))
    }
}
