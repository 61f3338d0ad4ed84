//! The plain lines of a mesh, read side by side: vertices, and faces whose corners are counted from
//! the first. A part of the text that holds anything else is left to the reader in order.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::mesh::note;
use crate::geometry::ABSENT;
use crate::text::parse_number;

/// Bytes of text that are read at once.
pub(super) const PART: usize = 1 << 18;

/// What plain lines say.
#[derive(Debug, Default)]
pub(super) struct Plain {
    pub(super) positions: Vec<DVec3>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) uv_corners: Vec<[u32; 3]>,
    pub(super) normal_corners: Vec<[u32; 3]>,
    /// The greatest index of each kind and 1, and the line and the column where it first stands.
    pub(super) greatest: [(u32, usize, usize); 3],
}

/// A part of a mesh's text.
pub(super) struct Part {
    /// Where it stands.
    pub(super) range: Range<usize>,
    /// How many lines it has.
    pub(super) lines: usize,
    /// How many end before the last that is not blank, if there is one.
    pub(super) last: Option<usize>,
    /// What it says, if all of it is plain.
    pub(super) plain: Option<Plain>,
}

/// Reads the plain parts of a text, which is cut into parts of about so many bytes.
pub(super) fn parts(bytes: &[u8], size: usize) -> Vec<Part> {
    let part = |range: Range<usize>| {
        let bytes = &bytes[range.clone()];
        let text = bytes.trim_ascii_end();
        let last = lines(text);
        Part {
            range,
            lines: last + lines(&bytes[text.len()..]),
            last: (!text.is_empty()).then_some(last),
            plain: std::str::from_utf8(bytes).ok().and_then(read),
        }
    };
    match &cut(bytes, size)[..] {
        [all] => vec![part(all.clone())],
        several => several.par_iter().cloned().map(part).collect(),
    }
}

/// How many lines end in a text. Sums of bytes are counted sixteen and more at once, those of larger
/// numbers take a fifth of the time that reading takes.
fn lines(bytes: &[u8]) -> usize {
    let of_few = |few: &[u8]| {
        let ends = few.iter().map(|&byte| u8::from(byte == b'\n'));
        usize::from(ends.sum::<u8>())
    };
    bytes.chunks(u8::MAX.into()).map(of_few).sum()
}

/// Cuts a text behind lines that do not go on in the next one.
fn cut(bytes: &[u8], part: usize) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = 0;
    while start < bytes.len() || parts.is_empty() {
        let mut end = bytes.len().min(start + part);
        while end < bytes.len() {
            let line = bytes[end..].iter().position(|&byte| byte == b'\n');
            let line_end = line.map_or(bytes.len(), |line| end + line);
            let goes_on = bytes[start..line_end].trim_ascii_end().ends_with(b"\\");
            end = bytes.len().min(line_end + 1);
            if !goes_on {
                break;
            }
        }
        parts.push(start..end);
        start = end;
    }
    parts
}

/// Reads a text if all of it is plain.
fn read(text: &str) -> Option<Plain> {
    let mut plain = Plain::default();
    let mut corners = Vec::new();
    for (number, line) in text.split('\n').enumerate() {
        let line = line.trim_ascii_end();
        if line.ends_with('\\') {
            return None;
        }
        let mut words = Words { line, at: 0 };
        match words.next().map(str::as_bytes) {
            // Groups and smoothing say nothing about triangles.
            None | Some(b"g" | b"o" | b"s") => {}
            Some(b"v") => {
                let place = words.numbers()?;
                plain.positions.push(DVec3::from_array(place));
                // A weight or a colour may follow.
                if 4 < words.count() {
                    return None;
                }
            }
            Some(b"vt") => {
                let [u] = words.numbers()?;
                let v = words.next().map_or(Some(0.0), |v| parse_number(v).ok())?;
                plain.uvs.push(DVec2::new(u, v));
                if 1 < words.count() {
                    return None;
                }
            }
            Some(b"vn") => {
                let normal = words.numbers()?;
                plain.normals.push(DVec3::from_array(normal));
                if words.next().is_some() {
                    return None;
                }
            }
            Some(b"f") => {
                corners.clear();
                while let Some(word) = words.next() {
                    let corner = corner(word)?;
                    let column = 1 + words.at - word.len();
                    for (greatest, index) in plain.greatest.iter_mut().zip(corner) {
                        if index != ABSENT && greatest.0 <= index {
                            *greatest = (index + 1, number, column);
                        }
                    }
                    corners.push(corner);
                }
                plain.face(&corners)?;
            }
            Some(_) => return None,
        }
    }
    Some(plain)
}

impl Plain {
    fn face(&mut self, corners: &[[u32; 3]]) -> Option<()> {
        let (first, rest) = corners.split_first()?;
        if rest.len() < 2 {
            return None;
        }
        for pair in rest.windows(2) {
            let fan = [*first, pair[0], pair[1]];
            self.triangles.push(fan.map(|corner| corner[0]));
            let number = self.triangles.len();
            note(&mut self.uv_corners, number, fan.map(|corner| corner[1]));
            note(
                &mut self.normal_corners,
                number,
                fan.map(|corner| corner[2]),
            );
        }
        Some(())
    }
}

/// The words of a line, up to a comment.
struct Words<'t> {
    line: &'t str,
    /// Where the last one ends.
    at: usize,
}

impl<'t> Words<'t> {
    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = parse_number(self.next()?).ok()?;
        }
        Some(numbers)
    }

    fn next(&mut self) -> Option<&'t str> {
        let bytes = self.line.as_bytes();
        let blanks = bytes[self.at..]
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace());
        let start = self.at + blanks.count();
        let word = bytes[start..]
            .iter()
            .take_while(|byte| !byte.is_ascii_whitespace());
        let end = start + word.count();
        if start == end || bytes[start] == b'#' {
            return None;
        }
        self.at = end;
        Some(&self.line[start..end])
    }

    /// How many are left.
    fn count(mut self) -> usize {
        std::iter::from_fn(|| self.next()).count()
    }
}

/// The indices that a corner names, from 0.
fn corner(word: &str) -> Option<[u32; 3]> {
    let mut corner = [ABSENT; 3];
    let mut rest = word.as_bytes();
    for (place, index) in corner.iter_mut().enumerate() {
        let (named, after) = number(rest);
        *index = match named {
            // Nothing between two strokes names nothing.
            None if 0 < place => ABSENT,
            named => named?,
        };
        rest = match after {
            [] => return Some(corner),
            [b'/', rest @ ..] => rest,
            _ => return None,
        };
    }
    None
}

/// The index that digits give, from 0, and what follows them: no stroke if they give none.
fn number(bytes: &[u8]) -> (Option<u32>, &[u8]) {
    /// All numbers of so many digits are indices.
    const DIGITS: usize = 9;
    let digits = bytes
        .iter()
        .take_while(|byte| byte.is_ascii_digit())
        .count();
    let (digits, rest) = bytes.split_at(digits);
    let value = |digits: &[u8]| {
        let add = |sum: u32, digit: &u8| 10 * sum + u32::from(digit - b'0');
        digits.iter().fold(0, add)
    };
    match digits.len() {
        0 => (None, rest),
        1..=DIGITS => match value(digits).checked_sub(1) {
            Some(index) => (Some(index), rest),
            None => (None, b"?"),
        },
        _ => (None, b"?"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_behind_statements() {
        let text = b"v 1\nv 2 \\ \n3\nv 4\nv 5";
        let cuts = |part| {
            cut(text, part)
                .iter()
                .map(|part| part.end)
                .collect::<Vec<_>>()
        };
        assert_eq!(cuts(100), [text.len()]);
        assert_eq!(cuts(2), [4, 13, 17, text.len()]);
        assert_eq!(cuts(5), [13, text.len()]);
        assert_eq!(cut(b"", 5).len(), 1);
    }
}
