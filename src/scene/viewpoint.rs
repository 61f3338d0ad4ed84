//! Parts of cameras as text, such as `eye 0 1 5 fov 45`, the same for every scene language.

use std::fmt;

use glam::DVec3;

use super::{Camera, Lens};

/// Parts of a camera that replace those of a scene's own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Viewpoint(Vec<(Part, DVec3)>);

/// A part of a camera: a point, a direction, or a number as the first of three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Eye,
    Target,
    Up,
    Fov,
    Height,
    Aspect,
    Near,
    Far,
    Focus,
    Lens,
}

impl Viewpoint {
    /// The words that [`Viewpoint::parse`] knows, with what follows them.
    pub const WORDS: &str = "eye X Y Z, target X Y Z, up X Y Z, fov DEGREES, height H, aspect A, \
                             near D, far D, focus D, lens R";

    /// What differs between a scene's own camera and another of the same size.
    pub fn between(own: &Camera, other: &Camera) -> Self {
        let differs = |part: &Part| part.of(own) != part.of(other);
        let differing = Part::ALL.into_iter().filter(differs);
        Self(
            differing
                .filter_map(|part| Some((part, part.of(other)?)))
                .collect(),
        )
    }

    /// Whether nothing is replaced.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Parses a text as [`Viewpoint`]'s `Display` writes it, with the words in any order.
    ///
    /// # Errors
    ///
    /// Fails, with what is expected, at an unknown or repeated word, and at a value that no camera
    /// has.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut words = text.split_whitespace();
        let mut parts: Vec<(Part, DVec3)> = Vec::new();
        while let Some(word) = words.next() {
            let named = Part::ALL.into_iter().find(|part| part.name() == word);
            let part = named.ok_or_else(|| format!("`{word}`: expected {}", Self::WORDS))?;
            if parts.iter().any(|&(before, _)| before == part) {
                return Err(format!("`{word}` is given twice"));
            }
            let mut value = DVec3::ZERO;
            for axis in 0..part.numbers() {
                let number = words.next().and_then(|number| number.parse().ok());
                value[axis] = number.ok_or_else(|| match part.numbers() {
                    1 => format!("`{word}` takes 1 number"),
                    numbers => format!("`{word}` takes {numbers} numbers"),
                })?;
            }
            if !part.allows(value) {
                return Err(format!("`{word}` must be {}", part.allowed()));
            }
            parts.push((part, value));
        }
        Ok(Self(parts))
    }

    /// These parts, and before them those of another that are not among them.
    #[must_use]
    pub fn over(&self, other: &Self) -> Self {
        let is_named = |part: Part| self.0.iter().any(|&(own, _)| own == part);
        let others = other.0.iter().filter(|(part, _)| !is_named(*part));
        Self(others.chain(&self.0).copied().collect())
    }

    /// The camera with these parts replaced.
    ///
    /// # Errors
    ///
    /// Fails with the reason if it would not be a camera.
    pub fn of(&self, own: &Camera) -> Result<Camera, &'static str> {
        let mut camera = *own;
        for &(part, value) in &self.0 {
            part.set(&mut camera, value);
        }
        let [near, far] = camera.depths;
        if camera.eye == camera.target {
            Err("target must differ from eye")
        } else if far <= near {
            Err("far must be beyond near")
        } else {
            Ok(camera)
        }
    }
}

impl fmt::Display for Viewpoint {
    /// Numbers are the shortest that read back as the same bits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, (part, value)) in self.0.iter().enumerate() {
            let space = if at == 0 { "" } else { " " };
            write!(f, "{space}{}", part.name())?;
            let numbers = value.to_array().into_iter().take(part.numbers());
            for number in numbers {
                write!(f, " {number}")?;
            }
        }
        Ok(())
    }
}

impl Part {
    const ALL: [Self; 10] = [
        Self::Eye,
        Self::Target,
        Self::Up,
        Self::Fov,
        Self::Height,
        Self::Aspect,
        Self::Near,
        Self::Far,
        Self::Focus,
        Self::Lens,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Eye => "eye",
            Self::Target => "target",
            Self::Up => "up",
            Self::Fov => "fov",
            Self::Height => "height",
            Self::Aspect => "aspect",
            Self::Near => "near",
            Self::Far => "far",
            Self::Focus => "focus",
            Self::Lens => "lens",
        }
    }

    fn numbers(self) -> usize {
        match self {
            Self::Eye | Self::Target | Self::Up => 3,
            _ => 1,
        }
    }

    /// The part of a camera, which has either a field of view or a height.
    fn of(self, camera: &Camera) -> Option<DVec3> {
        let number = |number| DVec3::new(number, 0.0, 0.0);
        Some(match (self, camera.lens) {
            (Self::Eye, _) => camera.eye,
            (Self::Target, _) => camera.target,
            (Self::Up, _) => camera.up,
            (Self::Fov, Lens::Perspective(degrees)) => number(degrees),
            (Self::Height, Lens::Orthographic(height)) => number(height),
            (Self::Fov | Self::Height, _) => return None,
            (Self::Aspect, _) => number(camera.pixel_aspect),
            (Self::Near, _) => number(camera.depths[0]),
            (Self::Far, _) => number(camera.depths[1]),
            (Self::Focus, _) => number(camera.focus.distance),
            (Self::Lens, _) => number(camera.focus.lens_radius),
        })
    }

    fn set(self, camera: &mut Camera, value: DVec3) {
        match self {
            Self::Eye => camera.eye = value,
            Self::Target => camera.target = value,
            Self::Up => camera.up = value,
            Self::Fov => camera.lens = Lens::Perspective(value.x),
            Self::Height => camera.lens = Lens::Orthographic(value.x),
            Self::Aspect => camera.pixel_aspect = value.x,
            Self::Near => camera.depths[0] = value.x,
            Self::Far => camera.depths[1] = value.x,
            Self::Focus => camera.focus.distance = value.x,
            Self::Lens => camera.focus.lens_radius = value.x,
        }
    }

    fn allows(self, value: DVec3) -> bool {
        let number = value.x;
        match self {
            Self::Eye | Self::Target => value.is_finite(),
            Self::Up => value.is_finite() && value != DVec3::ZERO,
            Self::Fov => 0.0 < number && number < 180.0,
            Self::Height | Self::Aspect | Self::Focus => 0.0 < number && number.is_finite(),
            Self::Near | Self::Lens => 0.0 <= number && number.is_finite(),
            Self::Far => 0.0 < number,
        }
    }

    fn allowed(self) -> &'static str {
        match self {
            Self::Eye | Self::Target => "finite",
            Self::Up => "finite and not zero",
            Self::Fov => "above 0 and below 180",
            Self::Height | Self::Aspect | Self::Focus | Self::Far => "above 0",
            Self::Near | Self::Lens => "0 or more",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Focus, Size};

    const OWN: Camera = Camera {
        eye: DVec3::new(0.0, 0.0, 5.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        lens: Lens::Perspective(45.0),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus::PINHOLE,
        size: Size {
            width: 4,
            height: 3,
        },
    };

    #[test]
    fn what_differs_reads_back_to_the_same_camera() {
        let turned = Camera {
            eye: DVec3::new(5.0, 0.1, -1e-300),
            ..OWN
        };
        let other = Camera {
            target: DVec3::new(1.0, 2.0, 3.0),
            up: DVec3::NEG_Z,
            lens: Lens::Orthographic(0.3),
            pixel_aspect: 2.0,
            depths: [1.0, 9.0],
            focus: Focus {
                distance: 3.0,
                lens_radius: 0.25,
            },
            ..turned
        };
        for (camera, words) in [
            (OWN, ""),
            (turned, "eye 5 0.1 -0.000"),
            (
                other,
                "target 1 2 3 up 0 0 -1 height 0.3 aspect 2 near 1 far 9 focus 3 lens 0.25",
            ),
        ] {
            let written = Viewpoint::between(&OWN, &camera).to_string();
            assert!(written.contains(words), "{written}");
            let read = Viewpoint::parse(&written).expect("it was written");
            assert_eq!(read.of(&OWN), Ok(camera));
        }
    }

    #[test]
    fn only_words_of_a_camera_are_read() {
        for (text, expected) in [
            ("eye 1 2", "`eye` takes 3 numbers"),
            ("fov", "`fov` takes 1 number"),
            ("fov 180", "`fov` must be above 0 and below 180"),
            ("fov nan", "`fov` must be above 0 and below 180"),
            ("up 0 0 0", "`up` must be finite and not zero"),
            ("eye 1 2 3 eye 1 2 3", "`eye` is given twice"),
            ("eyes 1 2 3", "`eyes`: expected eye X Y Z, target X Y Z"),
        ] {
            let error = Viewpoint::parse(text).expect_err("it is wrong");
            let rest = error.strip_prefix(expected);
            assert!(rest.is_some_and(|rest| !rest.starts_with('s')), "{error}");
        }
        for (text, expected) in [
            ("eye 0 0 0", "target must differ from eye"),
            ("near 2 far 1", "far must be beyond near"),
        ] {
            let view = Viewpoint::parse(text).expect("each part is right");
            assert_eq!(view.of(&OWN), Err(expected));
        }
    }
}
