//! A part of a picture.

use std::fmt;

use scene::Size;

/// A rectangle of pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Region {
    /// Its left column, from 0.
    pub x: u32,
    /// Its top row, from 0.
    pub y: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Region {
    /// All of a picture.
    pub fn whole(size: Size) -> Self {
        let Size { width, height } = size;
        Self {
            x: 0,
            y: 0,
            width,
            height,
        }
    }

    /// Its pixels, in rows.
    pub(crate) fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        let rows = self.y..self.y + self.height;
        rows.flat_map(move |y| (self.x..self.x + self.width).map(move |x| [x, y]))
    }

    /// Parses `X,Y,W,H`, such as `100,50,64,48`; spaces may stand around the numbers.
    pub fn parse(said: &str) -> Option<Self> {
        let number = |digits: &str| {
            let digits = digits.trim();
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
            digits.parse().ok().filter(|_: &u32| plain)
        };
        let mut numbers = said.split(',').map(number);
        let mut next = || numbers.next().flatten();
        let region = Self {
            x: next()?,
            y: next()?,
            width: next()?,
            height: next()?,
        };
        numbers.next().is_none().then_some(region)
    }

    /// The region, if it is a part of a picture of this size and not empty; otherwise what is wrong
    /// with it.
    pub fn within(self, size: Size) -> Result<Self, NoRegion> {
        let fits = |from: u32, length: u32, limit: u32| {
            from.checked_add(length).is_some_and(|end| end <= limit)
        };
        if self.width == 0 || self.height == 0 {
            Err(NoRegion::Empty(self))
        } else if fits(self.x, self.width, size.width) && fits(self.y, self.height, size.height) {
            Ok(self)
        } else {
            Err(NoRegion::Outside { region: self, size })
        }
    }

    /// Its width and height.
    pub fn size(self) -> Size {
        Size {
            width: self.width,
            height: self.height,
        }
    }

    /// Its top left pixel.
    pub fn corner(self) -> [u32; 2] {
        [self.x, self.y]
    }
}

/// As [`Region::parse`] reads it.
impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            x,
            y,
            width,
            height,
        } = self;
        write!(f, "{x},{y},{width},{height}")
    }
}

/// Why a region is no part of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoRegion {
    /// It has no pixels.
    #[error("region {0} is empty: its width and height must be at least 1")]
    Empty(Region),
    /// Some of it is not in the picture.
    #[error(
        "region {region} reaches outside the picture, which is {}x{}: x + width must be at most {}, \
         y + height at most {}",
        size.width, size.height, size.width, size.height
    )]
    Outside {
        /// The region.
        region: Region,
        /// Size of the picture.
        size: Size,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size {
        width: 40,
        height: 30,
    };

    #[test]
    fn regions_are_read_as_they_are_written() {
        for (said, written) in [
            ("1,2,3,4", Some("1,2,3,4")),
            (" 0, 0 ,40,30 ", Some("0,0,40,30")),
            ("1,2,3", None),
            ("1,2,3,4,5", None),
            ("1,2,3,-4", None),
            ("1,2,+3,4", None),
            ("1,2,3.5,4", None),
            ("1 2 3 4", None),
            ("", None),
            ("0,0,4294967296,1", None),
        ] {
            let region = Region::parse(said).map(|region| region.to_string());
            assert_eq!(region.as_deref(), written, "{said:?}");
        }
    }

    #[test]
    fn regions_have_pixels_and_lie_within_the_picture() {
        let outside = "reaches outside the picture, which is 40x30: x + width must be at most 40, y \
                       + height at most 30";
        for (said, problem) in [
            ("0,0,40,30", None),
            ("39,29,1,1", None),
            (
                "3,4,0,5",
                Some("is empty: its width and height must be at least 1"),
            ),
            ("0,0,41,30", Some(outside)),
            ("0,1,40,30", Some(outside)),
            ("4294967295,0,1,1", Some(outside)),
        ] {
            let region = Region::parse(said).expect("a region");
            let found = region.within(SIZE).err().map(|reason| reason.to_string());
            let expected = problem.map(|problem| format!("region {said} {problem}"));
            assert_eq!(found, expected);
        }
    }
}
