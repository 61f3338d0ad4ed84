//! The names of the pictures of a sequence.

use std::path::{Path, PathBuf};

use crate::part::Shard;

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

impl Pattern {
    /// Reads a pattern; `None` if the file name has not exactly one place for the number.
    pub fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let (before, rest) = name.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        let digits = match digits {
            "" => 0,
            _ => digits
                .strip_prefix('0')?
                .parse()
                .ok()
                .filter(|&digits| digits <= 9)?,
        };
        (!after.contains('%')).then(|| Self {
            folder: path.parent().map(Path::to_owned).unwrap_or_default(),
            before: before.to_owned(),
            after: after.to_owned(),
            digits,
        })
    }

    /// The path of a frame.
    pub(super) fn path(&self, number: u32) -> PathBuf {
        let Self {
            folder,
            before,
            after,
            digits,
        } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The path of the list of finished frames, such as `turn.frames` beside `turn.%05d.png`, one for
    /// each shard: processes on several machines do not append to the same file.
    pub(super) fn ledger(&self, shard: Shard) -> PathBuf {
        let stem = match self.before.trim_end_matches(['.', '-', '_']) {
            "" => "frames",
            stem => stem,
        };
        let Shard { index, count } = shard;
        self.folder.join(match count {
            1 => format!("{stem}.frames"),
            _ => format!("{stem}.{index}-{count}.frames"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_the_pattern_says() {
        let shard = Shard { index: 1, count: 4 };
        for (pattern, frame, ledger) in [
            ("a/turn.%05d.png", "a/turn.00042.png", "a/turn.frames"),
            ("turn%d.png", "turn42.png", "turn.frames"),
            ("%03d.bmp", "042.bmp", "frames.frames"),
            ("%01d_x", "42_x", "frames.frames"),
        ] {
            let pattern = Pattern::of(Path::new(pattern)).expect("a pattern");
            assert_eq!(pattern.path(42), Path::new(frame));
            assert_eq!(pattern.ledger(Shard::WHOLE), Path::new(ledger));
            let of_shard = ledger.replace(".frames", ".1-4.frames");
            assert_eq!(pattern.ledger(shard), Path::new(&of_shard));
        }
        for wrong in [
            "a.png",
            "%d%d.png",
            "%5d.png",
            "%0d.png",
            "%010d.png",
            "%s.png",
            "%d/a.png",
        ] {
            assert_eq!(Pattern::of(Path::new(wrong)), None, "{wrong}");
        }
    }
}
