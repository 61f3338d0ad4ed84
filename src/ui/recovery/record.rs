//! The format of journals.
//!
//! ```text
//! halflight journal 2
//! scene /home/me/balls.ray
//! language ray
//! base 203 85944171f73967e8
//! (203 bytes: the text last loaded or saved)
//! edit 0 203 201 af63dc4c8601ec8c
//! (201 bytes, in place of the 203 bytes of the base from byte 0 on)
//! ```
//!
//! Edits are appended, and the last one that is complete counts: each of them leads from the base to
//! a whole text. Of short texts an edit replaces everything, so that `tail` shows the text. The last
//! number of a line is the checksum of what stands before it and of the bytes below it, for the base
//! beginning with the first line. A path is written in ASCII with Rust's escapes; `-` is the scene
//! without a file.
//!
//! A file that begins otherwise is a bare text, as version 0.1 kept it.

use super::identity::Identity;
use crate::text::{Edit, Span, smallest_edit};

/// The words that every version's journals begin with.
const FAMILY: &[u8] = b"halflight journal ";
const MAGIC: &str = "halflight journal 2\n";

/// Up to this many bytes a text is kept whole.
const SHORT: usize = 1 << 16;

/// What a file in the place of a journal holds.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Nothing: its run has ended before it had written anything.
    Empty,
    /// Edits of this scene.
    Edits {
        /// The text that the edits started from, unless the file is a bare text.
        base: Option<String>,
        /// The text under edit.
        text: String,
    },
    /// Edits of another scene, or in another version's format.
    Foreign,
    /// It is not whole.
    Damaged,
}

/// A journal without edits.
pub(super) fn head(scene: &Identity, base: &str) -> Vec<u8> {
    let head = head_lines(scene);
    let line = format!("base {}", base.len());
    let sum = checksum(&[head.as_bytes(), line.as_bytes(), base.as_bytes()]);
    let mut bytes = Vec::with_capacity(head.len() + base.len() + 64);
    for part in [&head, &line, &format!(" {sum:016x}\n"), base, "\n"] {
        bytes.extend_from_slice(part.as_bytes());
    }
    bytes
}

/// The edit that leads from the base to another text.
pub(super) fn edit(base: &str, text: &str) -> Vec<u8> {
    let whole = || Edit {
        span: Span::new(0, base.len()),
        text: text.to_owned(),
    };
    let edit = Some(text).filter(|text| SHORT < text.len());
    let edit = edit.and_then(|text| smallest_edit(base, text));
    let Edit { span, text } = edit.unwrap_or_else(whole);
    let line = format!("edit {} {} {}", span.start(), span.len(), text.len());
    let sum = checksum(&[line.as_bytes(), text.as_bytes()]);
    format!("{line} {sum:016x}\n{text}\n").into_bytes()
}

/// What the bytes of a journal hold of a scene.
pub(super) fn read(bytes: Vec<u8>, scene: &Identity) -> Content {
    if bytes.is_empty() {
        return Content::Empty;
    }
    if FAMILY.starts_with(&bytes) {
        return Content::Damaged;
    }
    if !bytes.starts_with(FAMILY) {
        // What a crash of the system leaves of a file is often all zeros.
        let text = String::from_utf8(bytes).ok();
        let text = text.filter(|text| !text.contains('\0'));
        return text.map_or(Content::Damaged, |text| Content::Edits { base: None, text });
    }
    let head = head_lines(scene);
    match bytes.strip_prefix(head.as_bytes()) {
        Some(rest) => read_blocks(rest, head.as_bytes()).unwrap_or(Content::Damaged),
        None if head.as_bytes().starts_with(&bytes) => Content::Damaged,
        None => Content::Foreign,
    }
}

fn head_lines(scene: &Identity) -> String {
    let Identity {
        label, extension, ..
    } = scene;
    format!("{MAGIC}scene {label}\nlanguage {extension}\n")
}

fn read_blocks(mut rest: &[u8], head: &[u8]) -> Option<Content> {
    let ([length], base) = block(&mut rest, "base", head)?;
    debug_assert_eq!(length, base.len());
    let mut last = None;
    while let Some(([start, removed, _], text)) = block(&mut rest, "edit", &[]) {
        last = Some((start, removed, text));
    }
    let (start, removed, text) = last?;
    let end = start.checked_add(removed)?;
    let (before, after) = (base.get(..start)?, base.get(end..)?);
    Some(Content::Edits {
        text: [before, text, after].concat(),
        base: Some(base.to_owned()),
    })
}

/// Takes a block: the numbers of its line, of which the last is its length, and its text. `None`
/// unless it is whole.
fn block<'b, const N: usize>(
    rest: &mut &'b [u8],
    name: &str,
    before: &[u8],
) -> Option<([usize; N], &'b str)> {
    let line_end = rest.iter().position(|&byte| byte == b'\n')?;
    let line = str::from_utf8(&rest[..line_end]).ok()?;
    let (said, sum) = line.rsplit_once(' ')?;
    let mut words = said.split(' ');
    if words.next() != Some(name) {
        return None;
    }
    let mut numbers = [0; N];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    let below = &rest[line_end + 1..];
    let length = *numbers.last()?;
    if below.get(length) != Some(&b'\n') {
        return None;
    }
    let text = &below[..length];
    let found = checksum(&[before, said.as_bytes(), text]);
    if words.next().is_some() || format!("{found:016x}") != sum {
        return None;
    }
    *rest = &below[length + 1..];
    Some((numbers, str::from_utf8(text).ok()?))
}

fn checksum(parts: &[&[u8]]) -> u64 {
    fnv1a(parts.iter().copied().flatten())
}

/// The hash of Fowler, Noll and Vo, variant 1a, 64 bits: the same in every build, which the
/// standard library's is not.
pub(super) fn fnv1a<'b>(bytes: impl IntoIterator<Item = &'b u8>) -> u64 {
    let bytes = bytes.into_iter();
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    use crate::language::Language;

    #[test]
    fn the_hash_is_the_published_one() {
        // From the authors' test vectors.
        for (text, hash) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(fnv1a(text.as_bytes()), hash, "{text}");
        }
    }

    fn scene(name: &str) -> Identity {
        Identity::of(Some(Path::new(name)), Language::Ray)
    }

    fn edits(base: &str, text: &str) -> Content {
        Content::Edits {
            base: Some(base.to_owned()),
            text: text.to_owned(),
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let long = "é 1\n".repeat(SHORT);
        let changed = long.replacen("é 1\né", "é 1\nè", 1);
        let a = scene("/a.ray");
        for (base, texts) in [
            ("1 2", ["", "1 3", "edit 0 0 0 0\n"].as_slice()),
            ("", &["x\n"]),
            (&long, &[&changed, "1", &changed]),
        ] {
            let mut bytes = head(&a, base);
            for text in texts {
                bytes.extend(edit(base, text));
                assert_eq!(read(bytes.clone(), &a), edits(base, text));
            }
        }
        let appended = edit(&long, &changed).len();
        assert!(appended < 100, "{appended} bytes for one letter");
    }

    /// What a crash amid a write leaves, and what a bad disk does.
    #[test]
    fn what_is_not_whole_is_never_taken_for_edits() {
        let a = scene("/a.ray");
        let start = head(&a, "base 1");
        let first = [start.clone(), edit("base 1", "mine 1")].concat();
        let all = [first.clone(), edit("base 1", "mine 2")].concat();
        for cut in 0..all.len() {
            let expected = match cut {
                0 => Content::Empty,
                _ if cut < first.len() => Content::Damaged,
                _ => edits("base 1", "mine 1"),
            };
            assert_eq!(read(all[..cut].to_vec(), &a), expected, "cut at {cut}");
        }
        for at in 0..first.len() {
            let mut flipped = first.clone();
            flipped[at] ^= 1;
            let found = read(flipped, &a);
            let bare = matches!(&found, Content::Edits { base: None, .. }) && at < FAMILY.len();
            let refused = matches!(found, Content::Damaged | Content::Foreign);
            assert!(refused || bare, "byte {at}: {found:?}");
        }
    }

    #[test]
    fn files_that_are_no_journals_of_the_scene_are_distinguished() {
        let a = scene("/a.ray");
        let bare = |text: &str| Content::Edits {
            base: None,
            text: text.to_owned(),
        };
        let journal = |base: &str| [head(&a, base), edit(base, "2")].concat();
        let of_b = [head(&scene("/b.ray"), "1"), edit("1", "2")].concat();
        let longer =
            "halflight journal 2\nscene /a.ray\nlanguage ray\nbase 9999999999999999999 0\n";
        let lines = head_lines(&a);
        for (bytes, expected) in [
            (b"".to_vec(), Content::Empty),
            (b"1 2 3".to_vec(), bare("1 2 3")),
            (vec![0; 100], Content::Damaged),
            (vec![0xFF; 100], Content::Damaged),
            (of_b, Content::Foreign),
            (b"halflight journal 3\nscene ?".to_vec(), Content::Foreign),
            (longer.into(), Content::Damaged),
            (lines.into_bytes(), Content::Damaged),
            (head(&a, "1"), Content::Damaged),
            ([journal("1"), b"rest".to_vec()].concat(), edits("1", "2")),
            ([journal("1"), journal("3")].concat(), edits("1", "2")),
            ([head(&a, "1"), edit("12", "2")].concat(), Content::Damaged),
        ] {
            let said = String::from_utf8_lossy(&bytes).into_owned();
            assert_eq!(read(bytes, &a), expected, "{said}");
        }
    }
}
