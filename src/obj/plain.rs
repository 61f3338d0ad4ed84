//! Reads plain lines of a mesh in parallel, vertices and faces with positive indices, and appends them to
//! the mesh. A part of the text that contains any other statement is left to the sequential reader.

use std::mem;
use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::lines::{MOST, line_ends};
use super::polygons::Polygons;
use geometry::{ABSENT, MeshParts};
use text::{leading_number, parse_number};

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
    pub(super) polygons: Polygons,
    /// The greatest index of each kind plus 1.
    pub(super) greatest: [u32; 3],
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
        let (last, has_return) = lines(text);
        let (more, has_more) = lines(&bytes[text.len()..]);
        Chunk {
            range,
            lines: last + more,
            last: (!text.is_empty()).then_some(last),
            plain: std::str::from_utf8(bytes)
                .ok()
                .filter(|_| !has_return && !has_more)
                .and_then(|text| read(text, last)),
        }
    };
    match &cut(bytes, size)[..] {
        [all] => vec![part(all.clone())],
        several => several.par_iter().cloned().map(part).collect(),
    }
}

/// The number of line ends in a text, and whether one of them is a carriage return without a line
/// feed. Sums bytes, 16 or more per instruction: with wider integers counting would take a fifth as
/// long as reading.
fn lines(bytes: &[u8]) -> (usize, bool) {
    const FEW: usize = u8::MAX as usize;
    let mut feeds = usize::from(bytes.last() == Some(&b'\n'));
    let mut has_return = 0;
    let following = bytes.get(1..).unwrap_or_default();
    for (few, following) in bytes.chunks(FEW).zip(following.chunks(FEW)) {
        let mut ends = 0_u8;
        for (&byte, &next) in few.iter().zip(following) {
            ends += u8::from(byte == b'\n');
            // The last of several counts.
            has_return |= u8::from(byte == b'\r') & u8::from(next != b'\r' && next != b'\n');
        }
        feeds += usize::from(ends);
    }
    match has_return {
        0 => (feeds, false),
        _ => (line_ends(bytes), true),
    }
}

/// Cuts a text after lines that are not continued.
fn cut(bytes: &[u8], part: usize) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = 0;
    while start < bytes.len() || parts.is_empty() {
        let mut end = bytes.len().min(start + part);
        let before = bytes[start..end].iter().rposition(|&byte| byte == b'\n');
        let mut line_start = before.map_or(start, |before| start + before + 1);
        while end < bytes.len() {
            let line = bytes[end..].iter().position(|&byte| byte == b'\n');
            let line_end = line.map_or(bytes.len(), |line| end + line);
            let line = &bytes[line_start..line_end];
            let continues = line.trim_ascii_end().ends_with(b"\\");
            end = bytes.len().min(line_end + 1);
            line_start = end;
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
    let mut words = Words {
        text,
        line: 0,
        at: 0,
    };
    loop {
        match words.next().map(str::as_bytes) {
            // Groups and smoothing do not affect triangles.
            None | Some(b"g" | b"o" | b"s") => {}
            Some(b"v") => {
                let position = words.numbers()?;
                reserve(&mut plain.positions, lines);
                plain.positions.push(DVec3::from_array(position));
                // A weight or a colour may follow, or a comment of other languages.
                if 4 < words.count()? {
                    return None;
                }
            }
            Some(b"vt") => {
                let [u] = words.numbers()?;
                reserve(&mut plain.uvs, lines);
                let v = if words.has_next() {
                    words.number()?
                } else {
                    0.0
                };
                plain.uvs.push(DVec2::new(u, v));
                if 1 < words.count()? {
                    return None;
                }
            }
            Some(b"vn") => {
                let normal = words.numbers()?;
                reserve(&mut plain.normals, lines);
                plain.normals.push(DVec3::from_array(normal));
                if words.has_next() {
                    return None;
                }
            }
            Some(b"f") => {
                corners.clear();
                while words.has_next() {
                    let corner = words.corner()?;
                    for (greatest, index) in plain.greatest.iter_mut().zip(corner) {
                        // One more than an absent index is 0.
                        *greatest = (*greatest).max(index.wrapping_add(1));
                    }
                    corners.push(corner);
                }
                reserve(&mut plain.triangles, lines);
                plain.face(&corners)?;
            }
            Some(_) => return None,
        }
        if words.end_line()? == End::Text {
            break;
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
        if 2 < rest.len() {
            self.polygons.push(self.triangles.len(), corners.len());
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

/// What ends at the end of a line.
#[derive(PartialEq, Eq)]
enum End {
    Line,
    Text,
}

/// The words of the lines of a text, up to comments. The digits of most numbers are read once.
struct Words<'t> {
    text: &'t str,
    /// Where the line starts.
    line: usize,
    /// The offset of the next byte.
    at: usize,
}

impl<'t> Words<'t> {
    /// The byte at the offset; past the end, a line end.
    #[inline(always)]
    fn byte(&self) -> u8 {
        self.text.as_bytes().get(self.at).copied().unwrap_or(b'\n')
    }

    /// Skips blanks; whether the line has another word.
    #[inline(always)]
    fn has_next(&mut self) -> bool {
        while self.byte().is_ascii_whitespace() && self.byte() != b'\n' {
            self.at += 1;
        }
        !matches!(self.byte(), b'\n' | b'#')
    }

    /// The next word of the line.
    #[inline(always)]
    fn next(&mut self) -> Option<&'t str> {
        if !self.has_next() {
            return None;
        }
        let start = self.at;
        while !self.byte().is_ascii_whitespace() {
            self.at += 1;
        }
        Some(&self.text[start..self.at])
    }

    /// Skips the remaining words of the line, and returns their number; `None` if one begins a comment
    /// as other languages write it.
    fn count(&mut self) -> Option<usize> {
        let words = std::iter::from_fn(|| self.next());
        words
            .map(|word| (!word.starts_with("//")).then_some(1))
            .sum()
    }

    /// The numbers that are the next words.
    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number()?;
        }
        Some(numbers)
    }

    /// The number that is the next word.
    #[inline(always)]
    fn number(&mut self) -> Option<f64> {
        if !self.has_next() {
            return None;
        }
        let start = self.at;
        if let Some((value, length)) = leading_number(&self.text.as_bytes()[start..]) {
            self.at += length;
            if self.byte().is_ascii_whitespace() {
                return Some(value);
            }
            self.at = start;
        }
        let number = parse_number(self.next()?).ok();
        number.filter(|number| number.abs() <= MOST)
    }

    /// The indices of the corner that is the next word, converted to start at 0.
    #[inline(always)]
    fn corner(&mut self) -> Option<[u32; 3]> {
        /// All numbers with this many digits fit.
        const DIGITS: usize = 9;
        let mut corner = [ABSENT; 3];
        for (place, index) in corner.iter_mut().enumerate() {
            *index = match self.digits() {
                // Nothing between two slashes: no index.
                (0, _) if 0 < place => ABSENT,
                (1..=DIGITS, number) => number.checked_sub(1)?,
                _ => return None,
            };
            match self.byte() {
                b'/' => self.at += 1,
                byte if byte.is_ascii_whitespace() => return Some(corner),
                _ => return None,
            }
        }
        None
    }

    /// Skips digits; returns how many they are, and their number modulo 2³².
    #[inline(always)]
    fn digits(&mut self) -> (usize, u32) {
        let (start, mut value) = (self.at, 0_u32);
        while self.byte().is_ascii_digit() {
            value = value
                .wrapping_mul(10)
                .wrapping_add(u32::from(self.byte() - b'0'));
            self.at += 1;
        }
        (self.at - start, value)
    }

    /// Goes on to the next line; `None` if it continues this one.
    #[inline(always)]
    fn end_line(&mut self) -> Option<End> {
        let bytes = self.text.as_bytes();
        while self.byte() != b'\n' {
            self.at += 1;
        }
        if bytes[self.line..self.at].trim_ascii_end().ends_with(b"\\") {
            return None;
        }
        let is_last = self.at == bytes.len();
        self.at += 1;
        self.line = self.at;
        Some(if is_last { End::Text } else { End::Line })
    }
}

/// Adds the indices of a triangle, which is the `number`th, to a list that stays empty until the first
/// triangle with an index.
pub(super) fn push_corners(corners: &mut Vec<[u32; 3]>, number: usize, triangle: [u32; 3]) {
    if !corners.is_empty() || triangle != [ABSENT; 3] {
        corners.resize(number - 1, [ABSENT; 3]);
        corners.push(triangle);
    }
}

/// Appends plain parts to a mesh and its polygons.
pub(super) fn append(mut parts: Vec<Plain>, mesh: &mut MeshParts, polygons: &mut Polygons) {
    let before = mesh.triangles.len();
    let mut first = before;
    for part in &parts {
        polygons.append(&part.polygons, first);
        first += part.triangles.len();
    }
    let counts: Vec<_> = parts.iter().map(|part| part.triangles.len()).collect();
    extend(
        &mut mesh.positions,
        taken(&mut parts, |part| &mut part.positions),
    );
    extend(
        &mut mesh.uvs.values,
        taken(&mut parts, |part| &mut part.uvs),
    );
    extend(
        &mut mesh.normals.values,
        taken(&mut parts, |part| &mut part.normals),
    );
    extend(
        &mut mesh.triangles,
        taken(&mut parts, |part| &mut part.triangles),
    );
    let extend_corners = |all: &mut Vec<_>, mut corners: Vec<Vec<_>>| {
        // Without any indices, there is no list of them.
        if all.is_empty() && corners.iter().all(Vec::is_empty) {
            return;
        }
        all.resize(before, [ABSENT; 3]);
        for (corners, &count) in corners.iter_mut().zip(&counts) {
            corners.resize(count, [ABSENT; 3]);
        }
        extend(all, corners);
    };
    extend_corners(
        &mut mesh.uvs.corners,
        taken(&mut parts, |part| &mut part.uv_corners),
    );
    extend_corners(
        &mut mesh.normals.corners,
        taken(&mut parts, |part| &mut part.normal_corners),
    );
}

/// Takes one list from each part.
fn taken<T>(parts: &mut [Plain], list: impl Fn(&mut Plain) -> &mut Vec<T>) -> Vec<Vec<T>> {
    parts.iter_mut().map(|part| mem::take(list(part))).collect()
}

/// Appends lists in parallel, since most of the time goes into page faults of the new memory. Each is
/// freed once it is copied.
fn extend<T: Copy + Default + Send + Sync>(list: &mut Vec<T>, parts: Vec<Vec<T>>) {
    let start = list.len();
    let count = parts.iter().map(Vec::len).sum();
    if count == 0 {
        return;
    }
    list.par_extend(repeat_n(T::default(), count));
    let mut rest = &mut list[start..];
    let places = parts.into_iter().map(|part| {
        let (own, after) = mem::take(&mut rest).split_at_mut(part.len());
        rest = after;
        (own, part)
    });
    let places: Vec<_> = places.collect();
    places
        .into_par_iter()
        .for_each(|(own, part)| own.copy_from_slice(&part));
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
        // A blank line ends a statement.
        let ends = cut(b"v 1 \\\n\n\nv 2", 2);
        assert_eq!(
            ends.iter().map(|part| part.end).collect::<Vec<_>>(),
            [7, 11]
        );
    }
}
