//! Reads plain lines of a mesh in parallel: vertices, and faces with positive indices. A part of
//! the text that contains any other statement is left to the sequential reader.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::geometry::ABSENT;
use crate::text::parse_number;

/// The length in bytes of the parts that are read in parallel.
pub(super) const PART: usize = 1 << 18;

/// The content of plain lines.
#[derive(Debug, Default)]
pub(super) struct Plain {
    pub(super) positions: Vec<DVec3>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) uv_corners: Vec<[u32; 3]>,
    pub(super) normal_corners: Vec<[u32; 3]>,
    /// The greatest index of each kind plus 1, with the line and column of its first use.
    pub(super) greatest: [(u32, usize, usize); 3],
}

/// A part of a mesh's text.
pub(super) struct Chunk {
    /// The range of its bytes.
    pub(super) range: Range<usize>,
    /// The number of its lines.
    pub(super) lines: usize,
    /// The number of lines before the last non-blank one; `None` if all are blank.
    pub(super) last: Option<usize>,
    /// The content, if all of it is plain.
    pub(super) plain: Option<Plain>,
}

/// Cuts a text into parts of about `size` bytes and reads those that are plain.
pub(super) fn parts(bytes: &[u8], size: usize) -> Vec<Chunk> {
    let part = |range: Range<usize>| {
        let bytes = &bytes[range.clone()];
        let text = bytes.trim_ascii_end();
        let last = lines(text);
        Chunk {
            range,
            lines: last + lines(&bytes[text.len()..]),
            last: (!text.is_empty()).then_some(last),
            plain: std::str::from_utf8(bytes)
                .ok()
                .and_then(|text| read(text, last)),
        }
    };
    match &cut(bytes, size)[..] {
        [all] => vec![part(all.clone())],
        several => several.par_iter().cloned().map(part).collect(),
    }
}

/// The number of line ends in a text. Sums bytes, 16 or more per instruction: with wider integers
/// counting takes a fifth of the time that reading takes.
fn lines(bytes: &[u8]) -> usize {
    let of_few = |few: &[u8]| {
        let ends = few.iter().map(|&byte| u8::from(byte == b'\n'));
        usize::from(ends.sum::<u8>())
    };
    bytes.chunks(u8::MAX.into()).map(of_few).sum()
}

/// Cuts a text after lines that are not continued.
fn cut(bytes: &[u8], part: usize) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = 0;
    while start < bytes.len() || parts.is_empty() {
        let mut end = bytes.len().min(start + part);
        while end < bytes.len() {
            let line = bytes[end..].iter().position(|&byte| byte == b'\n');
            let line_end = line.map_or(bytes.len(), |line| end + line);
            let continues = bytes[start..line_end].trim_ascii_end().ends_with(b"\\");
            end = bytes.len().min(line_end + 1);
            if !continues {
                break;
            }
        }
        parts.push(start..end);
        start = end;
    }
    parts
}

/// Reads a text of about `lines` lines. Returns `None` unless all of it is plain.
///
/// Most parts have lines of one kind, so room for all of them is reserved at the first: growing took a
/// twentieth of the time to a picture of a million triangles, most of it in page faults.
fn read(text: &str, lines: usize) -> Option<Plain> {
    let mut plain = Plain::default();
    let mut corners = Vec::new();
    // Statements of most kinds have eight bytes at least, such as `v 0 0 0`; blank lines have one.
    let lines = lines.min(text.len() / 8);
    for (number, line) in text.split('\n').enumerate() {
        let line = line.trim_ascii_end();
        if line.ends_with('\\') {
            return None;
        }
        let mut words = Words { line, at: 0 };
        match words.next().map(str::as_bytes) {
            // Groups and smoothing do not affect triangles.
            None | Some(b"g" | b"o" | b"s") => {}
            Some(b"v") => {
                let position = words.numbers()?;
                reserve(&mut plain.positions, lines);
                plain.positions.push(DVec3::from_array(position));
                // A weight or a colour may follow.
                if 4 < words.count() {
                    return None;
                }
            }
            Some(b"vt") => {
                let [u] = words.numbers()?;
                reserve(&mut plain.uvs, lines);
                let v = words.next().map_or(Some(0.0), |v| parse_number(v).ok())?;
                plain.uvs.push(DVec2::new(u, v));
                if 1 < words.count() {
                    return None;
                }
            }
            Some(b"vn") => {
                let normal = words.numbers()?;
                reserve(&mut plain.normals, lines);
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
                reserve(&mut plain.triangles, lines);
                plain.face(&corners)?;
            }
            Some(_) => return None,
        }
    }
    Some(plain)
}

/// Reserves room for the items of so many lines, before the first.
#[inline]
fn reserve<T>(items: &mut Vec<T>, lines: usize) {
    if items.is_empty() {
        items.reserve(1 + lines);
    }
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
            push_corners(&mut self.uv_corners, number, fan.map(|corner| corner[1]));
            push_corners(
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
    /// The offset after the last word returned.
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

    /// The number of remaining words.
    fn count(mut self) -> usize {
        std::iter::from_fn(|| self.next()).count()
    }
}

/// Parses the indices of a corner, converted to start at 0.
fn corner(word: &str) -> Option<[u32; 3]> {
    let mut corner = [ABSENT; 3];
    let mut rest = word.as_bytes();
    for (place, index) in corner.iter_mut().enumerate() {
        let (named, after) = number(rest);
        *index = match named {
            // Nothing between two slashes: no index.
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

/// Parses an index, converted to start at 0. Also returns the rest, which does not begin with a
/// slash if the digits are not a valid index.
fn number(bytes: &[u8]) -> (Option<u32>, &[u8]) {
    /// All numbers with this many digits fit.
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

/// Adds the indices of a triangle, which is the `number`th, unless none before and none of it has
/// any.
pub(super) fn push_corners(corners: &mut Vec<[u32; 3]>, number: usize, triangle: [u32; 3]) {
    if !corners.is_empty() || triangle != [ABSENT; 3] {
        corners.resize(number - 1, [ABSENT; 3]);
        corners.push(triangle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_between_statements() {
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
