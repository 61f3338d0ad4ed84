//! The journal format.
//!
//! ```text
//! halflight journal 3
//! scene /home/me/balls.ray
//! language ray
//! base 203 85944171f73967e8 2bc54c1ddd1a8a4d
//! (203 bytes: the text last loaded or saved)
//! edit 0 203 201 af63dc4c8601ec8c cbf29ce484222325
//! (201 bytes, in place of the 203 bytes of the base from byte 0 on)
//! ```
//!
//! Edits are appended, and the last intact one wins: each leads from the base to a complete text.
//! For short texts an edit replaces everything, so that `tail` shows the text. A path is written in
//! ASCII with Rust's escapes; `-` is the scene without a file.
//!
//! A block's line ends with two checksums: of the bytes below it, and of the line itself, seeded
//! with the lines above the base's line or, for edits, with its checksum. So the next edit is found
//! after a damaged one, and no line of a scene is mistaken for one of the journal.

use super::identity::{Identity, fnv1a};
use text::{Edit, Span, smallest_edit};

/// The prefix of journals of every version.
const FAMILY: &[u8] = b"halflight journal ";
const MAGIC: &str = "halflight journal 3\n";

/// The first word of an edit's line.
const EDIT: &str = "edit";

/// Texts of up to this many bytes are stored in full.
const SHORT: usize = 1 << 16;

/// The maximum length of a block's line, in bytes.
const LONGEST: usize = 128;

/// The content of a file with a journal's name.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Nothing: its run ended before it wrote anything.
    Empty,
    /// Edits of this scene.
    Edits {
        /// The text that the edits are based on.
        base: String,
        /// The edited text.
        text: String,
        /// Whether another part of the journal, possibly with later edits, is damaged.
        is_damaged: bool,
    },
    /// A journal of another scene.
    OfAnotherScene,
    /// A journal in the format of another version.
    OfAnotherVersion,
    /// No intact edits.
    Damaged,
}

/// Returns a journal without edits, and the checksum that seals its edits.
pub(super) fn head(scene: &Identity, base: &str) -> (Vec<u8>, u64) {
    let lines = head_lines(scene);
    let mut bytes = Vec::with_capacity(lines.len() + base.len() + LONGEST);
    bytes.extend_from_slice(lines.as_bytes());
    let line = format!("base {}", base.len());
    let seal = put_block(&mut bytes, &line, lines.as_bytes(), base);
    (bytes, seal)
}

/// The edit to keep that leads from the base to another text.
pub(super) fn difference(base: &str, text: &str) -> Edit {
    let edit = Some(text).filter(|text| SHORT < text.len());
    let edit = edit.and_then(|text| smallest_edit(base, text));
    edit.unwrap_or_else(|| Edit {
        span: Span::new(0, base.len()),
        text: text.to_owned(),
    })
}

/// Encodes an edit of the base.
pub(super) fn edit(seal: u64, Edit { span, text }: &Edit) -> Vec<u8> {
    let line = format!("{EDIT} {} {} {}", span.start(), span.len(), text.len());
    let mut bytes = Vec::with_capacity(text.len() + LONGEST);
    put_block(&mut bytes, &line, &seal.to_be_bytes(), text);
    bytes
}

/// Appends a block and returns the checksum of its line.
fn put_block(bytes: &mut Vec<u8>, line: &str, seal: &[u8], text: &str) -> u64 {
    let line = format!("{line} {:016x}", checksum(&[text.as_bytes()]));
    let sum = checksum(&[seal, line.as_bytes()]);
    for part in [&line, &format!(" {sum:016x}\n"), text, "\n"] {
        bytes.extend_from_slice(part.as_bytes());
    }
    sum
}

/// Reads a journal of a scene. If the base is damaged, the scene's current text replaces it,
/// provided that its checksum matches.
pub(super) fn read(bytes: &[u8], scene: &Identity, text: &str) -> Content {
    if bytes.is_empty() {
        return Content::Empty;
    }
    let lines = head_lines(scene);
    let (head, rest) = bytes.split_at(lines.len().min(bytes.len()));
    // The checksum covers the expected lines above, and so reveals whether they are damaged.
    let Some((line, below)) = BlockHeader::take(rest, "base", lines.as_bytes()) else {
        return without_edits(bytes);
    };
    let [length] = line.numbers;
    if below.len() <= length {
        return Content::Damaged;
    }
    let (base, rest) = below.split_at(length);
    let is_whole = line.is_of(base);
    let base = match str::from_utf8(base) {
        Ok(base) if is_whole => base,
        _ if line.is_of(text.as_bytes()) => text,
        _ => return Content::Damaged,
    };
    let edits = Edits::read(&rest[1..], line.sum);
    let edited = edits.last.and_then(|last| last.applied_to(base));
    edited.map_or(Content::Damaged, |text| Content::Edits {
        base: base.to_owned(),
        text,
        is_damaged: edits.is_damaged || !is_whole || head != lines.as_bytes() || rest[0] != b'\n',
    })
}

/// Classifies a file that holds no edits of the scene.
fn without_edits(bytes: &[u8]) -> Content {
    let Some(version) = bytes.strip_prefix(FAMILY) else {
        return Content::Damaged;
    };
    if !bytes.starts_with(MAGIC.as_bytes()) {
        let digits = version.iter().take_while(|byte| byte.is_ascii_digit());
        let is_version = 0 < digits.clone().count() && version.get(digits.count()) == Some(&b'\n');
        return if is_version {
            Content::OfAnotherVersion
        } else {
            Content::Damaged
        };
    }
    let lines = bytes.split_inclusive(|&byte| byte == b'\n');
    let length = lines.take(3).map(<[u8]>::len).sum();
    let (head, rest) = bytes.split_at(length);
    match BlockHeader::<1>::take(rest, "base", head) {
        Some(_) => Content::OfAnotherScene,
        None => Content::Damaged,
    }
}

fn head_lines(scene: &Identity) -> String {
    let Identity {
        label, extension, ..
    } = scene;
    format!("{MAGIC}scene {label}\nlanguage {extension}\n")
}

/// The edits after a journal's base.
#[derive(Default)]
struct Edits<'b> {
    /// The last intact one.
    last: Option<Last<'b>>,
    is_damaged: bool,
}

struct Last<'b> {
    start: usize,
    removed: usize,
    text: &'b str,
}

impl<'b> Edits<'b> {
    fn read(mut rest: &'b [u8], seal: u64) -> Self {
        let mut edits = Self::default();
        loop {
            if let Some((line, below)) = BlockHeader::take(rest, EDIT, &seal.to_be_bytes()) {
                let [start, removed, length] = line.numbers;
                if below.len() <= length {
                    // The append was cut off, for instance because the process was killed.
                    return edits;
                }
                let (text, end) = below.split_at(length);
                let whole = str::from_utf8(text).ok().filter(|_| line.is_of(text));
                edits.is_damaged |= whole.is_none() || end[0] != b'\n';
                let last = whole.map(|text| Last {
                    start,
                    removed,
                    text,
                });
                edits.last = last.or(edits.last);
                rest = &end[1..];
            } else {
                let next = rest.windows(EDIT.len()).skip(1);
                let next = next.enumerate().find(|(_, name)| *name == EDIT.as_bytes());
                // An append that was cut off may leave part of its line.
                edits.is_damaged |= next.is_some() || rest.contains(&b'\n');
                match next {
                    Some((at, _)) => rest = &rest[at + 1..],
                    None => return edits,
                }
            }
        }
    }
}

impl Last<'_> {
    fn applied_to(&self, base: &str) -> Option<String> {
        let end = self.start.checked_add(self.removed)?;
        let (before, after) = (base.get(..self.start)?, base.get(end..)?);
        Some([before, self.text, after].concat())
    }
}

/// The line of a block.
struct BlockHeader<'b, const N: usize> {
    /// The last number is the length of the data below.
    numbers: [usize; N],
    /// The checksum of the data below, in hexadecimal.
    below: &'b str,
    /// The checksum of the line itself.
    sum: u64,
}

impl<'b, const N: usize> BlockHeader<'b, N> {
    /// Takes an intact line off the start of the bytes; returns it with the rest.
    fn take(bytes: &'b [u8], name: &str, seal: &[u8]) -> Option<(Self, &'b [u8])> {
        let start = &bytes[..LONGEST.min(bytes.len())];
        let end = start.iter().position(|&byte| byte == b'\n')?;
        let line = str::from_utf8(&bytes[..end]).ok()?;
        let (said, sum) = line.rsplit_once(' ')?;
        let mut words = said.split(' ');
        if words.next() != Some(name) {
            return None;
        }
        let found = checksum(&[seal, said.as_bytes()]);
        if format!("{found:016x}") != sum {
            return None;
        }
        let mut numbers = [0; N];
        for number in &mut numbers {
            *number = words.next()?.parse().ok()?;
        }
        let line = Self {
            numbers,
            below: words.next()?,
            sum: found,
        };
        Some((line, &bytes[end + 1..]))
    }

    /// Whether these bytes are the data that belongs below the line.
    fn is_of(&self, bytes: &[u8]) -> bool {
        self.numbers.last() == Some(&bytes.len())
            && format!("{:016x}", checksum(&[bytes])) == self.below
    }
}

fn checksum(parts: &[&[u8]]) -> u64 {
    fnv1a(parts.iter().copied().flatten())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recovery::tests::{parts as journal, scene};

    fn edits(base: &str, text: &str, is_damaged: bool) -> Content {
        Content::Edits {
            base: base.to_owned(),
            text: text.to_owned(),
            is_damaged,
        }
    }

    #[test]
    fn written_journals_are_read_back() {
        let long = "é 1\n".repeat(SHORT);
        let changed = long.replacen("é 1\né", "é 1\nè", 1);
        let a = scene("/a.ray");
        for (base, texts) in [
            ("1 2", ["", "1 3", "edit 0 0 0 0 0\n"].as_slice()),
            ("", &["x\n"]),
            (&long, &[&changed, "1", &changed]),
        ] {
            let parts = journal(&a, base, texts);
            for (number, text) in texts.iter().enumerate() {
                let bytes = parts[..number + 2].concat();
                assert_eq!(read(&bytes, &a, ""), edits(base, text, false));
            }
        }
        let appended = journal(&a, &long, &[&changed])[1].len();
        assert!(appended < 120, "{appended} bytes for one letter");
    }

    /// Simulates a crash during a write.
    #[test]
    fn a_truncated_write_is_not_damage() {
        let a = scene("/a.ray");
        let parts = journal(&a, "base 1", &["mine 1", "mine\n2"]);
        let (all, first) = (parts.concat(), parts[..2].concat());
        for cut in 0..all.len() {
            let expected = match cut {
                0 => Content::Empty,
                _ if cut < first.len() => Content::Damaged,
                _ => edits("base 1", "mine 1", false),
            };
            assert_eq!(read(&all[..cut], &a, "base 1"), expected, "cut at {cut}");
        }
    }

    /// Simulates a failing disk.
    #[test]
    fn damage_loses_only_what_it_hits() {
        let a = scene("/a.ray");
        // The second text contains what would be an edit of another journal.
        let nested = journal(&a, "base 2", &["theirs"])[1].clone();
        let nested = String::from_utf8(nested).expect("a text");
        let parts = journal(&a, "base 1", &["mine 1", &nested, "mine\n3"]);
        let whole = parts.concat();
        let head = head_lines(&a).len();
        let base = parts[0].len() - "base 1\n".len();
        let head_end = parts[0].len() - 1;
        let last = whole.len() - parts[3].len();
        for (at, bit) in (0..whole.len()).flat_map(|at| (0..8).map(move |bit| (at, bit))) {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            let expected = |scene: &str| match at {
                _ if (head..base).contains(&at) => Content::Damaged,
                _ if (base..head_end).contains(&at) && scene != "base 1" => Content::Damaged,
                _ if (last..whole.len() - 1).contains(&at) => edits("base 1", &nested, true),
                _ => edits("base 1", "mine\n3", true),
            };
            for scene in ["base 1", "base 2"] {
                let found = read(&bytes, &a, scene);
                assert_eq!(found, expected(scene), "bit {bit} of byte {at}");
            }
        }
        for part in 1..3 {
            let mut parts = parts.clone();
            parts[part].fill(0);
            let expected = edits("base 1", "mine\n3", true);
            assert_eq!(read(&parts.concat(), &a, ""), expected, "zeros");
        }
    }

    #[test]
    fn files_that_are_not_journals_of_the_scene_are_classified() {
        let a = scene("/a.ray");
        let of = |scene: &Identity, base: &str| journal(scene, base, &["2"]).concat();
        let longer =
            "halflight journal 3\nscene /a.ray\nlanguage ray\nbase 9999999999999999999 0 0\n";
        let (b, longest) = (scene("/b.ray"), scene("/b/c/a.ray"));
        let alone = |base: &str| head(&a, base).0;
        let edit_of_another_base = journal(&a, "12", &["2"])[1].clone();
        for (bytes, expected) in table! {
            b"".to_vec() => Content::Empty;
            b"1 2 3".to_vec() => Content::Damaged;
            vec![0; 100] => Content::Damaged;
            vec![0xFF; 100] => Content::Damaged;
            of(&b, "1") => Content::OfAnotherScene;
            of(&longest, "1") => Content::OfAnotherScene;
            b"halflight journal 4\nscene ?".to_vec() => Content::OfAnotherVersion;
            b"halflight journal 12\n".to_vec() => Content::OfAnotherVersion;
            b"halflight journal \n".to_vec() => Content::Damaged;
            longer.into() => Content::Damaged;
            head_lines(&a).into_bytes() => Content::Damaged;
            alone("1") => Content::Damaged;
            [of(&a, "1"), b"rest".to_vec()].concat() => edits("1", "2", false);
            [of(&a, "1"), of(&a, "3")].concat() => edits("1", "2", true);
            [alone("1"), edit_of_another_base].concat() => Content::Damaged;
        } {
            let said = String::from_utf8_lossy(&bytes).into_owned();
            assert_eq!(read(&bytes, &a, "1"), expected, "{said}");
        }
    }
}
