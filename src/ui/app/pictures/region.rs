//! A region of the full-size trace as it is drawn or typed.

use render::Region;

/// What is to become of the region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RegionOrder {
    /// Say what it is.
    Tell,
    /// Trace all of the picture again.
    Off,
    /// Trace this part only.
    Trace(Region),
}

/// A region that is being drawn, by two opposite pixels of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Drawing {
    pub(crate) fixed: [u32; 2],
    /// The corner that keys and the pointer move.
    pub(crate) moving: [u32; 2],
    /// What is drawing it.
    pub(crate) held: Held,
}

/// What draws a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Held {
    /// Keys.
    ByKeys,
    /// The pointer, while its button is pressed.
    ByPointer,
}

impl RegionOrder {
    /// Parses nothing, `off`, or a region; the error says what is expected.
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        match (said.trim(), Region::parse(said)) {
            ("", _) => Ok(Self::Tell),
            ("off", _) => Ok(Self::Off),
            (_, Some(region)) => Ok(Self::Trace(region)),
            (_, None) => {
                Err("region takes X,Y,W,H in pixels, such as 100,50,64,48, or off".to_owned())
            }
        }
    }
}

impl Drawing {
    /// The pixels between the corners, which belong to it.
    pub(crate) fn region(self) -> Region {
        let ([a, b], [c, d]) = (self.fixed, self.moving);
        Region {
            x: a.min(c),
            y: b.min(d),
            width: a.abs_diff(c) + 1,
            height: b.abs_diff(d) + 1,
        }
    }
}
