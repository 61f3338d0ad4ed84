//! The names of the pictures of a sequence.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A path whose file name has `%d`, or `%05d` for at least five digits, where the number of the frame
/// is to stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    folder: PathBuf,
    /// What stands before the number and after it.
    before: String,
    after: String,
    /// The least number of digits.
    digits: usize,
}

/// The most digits that a number is filled up to.
const MOST_DIGITS: usize = 9;

/// Why a path is no pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoPattern {
    /// It has no placeholder.
    #[error(
        "has no placeholder for the frame number: use a name such as out.%05d.png, or .y4m or .gif"
    )]
    Missing,
    /// The placeholder is in the name of a folder.
    #[error("has %d in the name of a folder: only the file name can have it, such as out.%05d.png")]
    InFolder,
    /// The file name has more than one percent sign.
    #[error("has more than one %: only one number can stand in the name, such as out.%05d.png")]
    Several,
    /// What follows the percent sign is no placeholder.
    #[error("has a % that does not begin %d or, with a least number of digits, %01d to %09d")]
    Malformed,
}

impl Pattern {
    /// Reads a pattern, whose file name has exactly one place for the number.
    pub fn of(path: &Path) -> Result<Self, NoPattern> {
        let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
        let Some((before, rest)) = name.split_once('%') else {
            let folder = path.parent().and_then(Path::file_name);
            let is_there = folder.is_some_and(|folder| Self::of(Path::new(folder)).is_ok());
            return Err(if is_there {
                NoPattern::InFolder
            } else {
                NoPattern::Missing
            });
        };
        if rest.contains('%') {
            return Err(NoPattern::Several);
        }
        let (digits, after) = rest.split_once('d').ok_or(NoPattern::Malformed)?;
        let least = match digits {
            "" => Some(0),
            _ => digits
                .strip_prefix('0')
                .and_then(|least| least.parse().ok()),
        };
        Ok(Self {
            folder: path.parent().map(Path::to_owned).unwrap_or_default(),
            before: before.to_owned(),
            after: after.to_owned(),
            digits: least
                .filter(|&digits| digits <= MOST_DIGITS)
                .ok_or(NoPattern::Malformed)?,
        })
    }

    /// The path of a frame.
    pub fn path(&self, number: u32) -> PathBuf {
        let Self {
            folder,
            before,
            after,
            digits,
        } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The path of a file of this name beside the pictures.
    pub fn beside(&self, name: String) -> PathBuf {
        self.folder.join(name)
    }

    /// What the names of files beside the pictures begin with: `turn` of `turn.%05d.png`.
    pub fn stem(&self) -> &str {
        match self.before.trim_end_matches(['.', '-', '_']) {
            "" => "frames",
            stem => stem,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_the_pattern_says() {
        for (pattern, frame, stem) in [
            ("a/turn.%05d.png", "a/turn.00042.png", "turn"),
            ("turn%d.png", "turn42.png", "turn"),
            ("%03d.bmp", "042.bmp", "frames"),
            ("%01d_x", "42_x", "frames"),
        ] {
            let pattern = Pattern::of(Path::new(pattern)).expect("a pattern");
            assert_eq!(pattern.path(42), Path::new(frame));
            assert_eq!(pattern.stem(), stem);
        }
        for (wrong, reason) in [
            ("a.png", NoPattern::Missing),
            ("-", NoPattern::Missing),
            ("%d%d.png", NoPattern::Several),
            ("%5d.png", NoPattern::Malformed),
            ("%0d.png", NoPattern::Malformed),
            ("%010d.png", NoPattern::Malformed),
            ("%s.png", NoPattern::Malformed),
            ("%d/a.png", NoPattern::InFolder),
        ] {
            assert_eq!(Pattern::of(Path::new(wrong)), Err(reason), "{wrong}");
        }
    }
}
