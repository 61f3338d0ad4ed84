//! The facets of a `.stl` file, one after another.

use glam::DVec3;

use super::{EXPECTED, FACET, HEAD, place};
use crate::building::Building;
use crate::lines::{Fault, Lines, Place, Spot, Word};
use crate::{Finding, Model};
use text::counted;

/// The length in bytes of a coordinate.
const COORDINATE: usize = 4;

/// Facets being read.
pub(super) struct Facets<'t> {
    building: Building<'t>,
    /// The number of facets so far.
    count: usize,
    /// The first corners of the current facet.
    corners: [DVec3; 3],
    /// How many corners it has.
    found: usize,
    /// Whether one of them cannot be used, which has been said.
    is_wrong: bool,
    /// Facets without exactly three corners.
    odd: LeftOut<'t>,
    /// Facets with two equal corners.
    flat: LeftOut<'t>,
    /// The last place that was read.
    last: Word<'t>,
}

/// Facets that are left out for one reason.
#[derive(Default)]
struct LeftOut<'t> {
    count: usize,
    first: Option<Word<'t>>,
}

impl<'t> LeftOut<'t> {
    fn add(&mut self, place: Word<'t>) {
        self.count += 1;
        self.first.get_or_insert(place);
    }
}

impl<'t> Facets<'t> {
    pub(super) fn new(building: Building<'t>) -> Self {
        Self {
            building,
            count: 0,
            corners: [DVec3::ZERO; 3],
            found: 0,
            is_wrong: false,
            odd: LeftOut::default(),
            flat: LeftOut::default(),
            last: place(Place { line: 1, at: 0 }),
        }
    }

    /// Reads so many facets of numbers, which end at `whole`.
    pub(super) fn read_numbers(
        &mut self,
        bytes: &'t [u8],
        count: usize,
        whole: usize,
    ) -> Result<(), Fault> {
        self.building.file.numbers = Some(HEAD);
        let word = |at: usize, text| Word {
            text,
            place: Spot::from(Place { line: 1, at }),
        };
        self.building.check_room(count, word(HEAD - 4, b""))?;
        let parts = &mut self.building.parts;
        parts.triangles.reserve(count);
        parts.positions.reserve(3 * count);
        let facets = bytes[HEAD..whole].chunks_exact(FACET);
        for (number, facet) in facets.enumerate() {
            let start = HEAD + number * FACET;
            // A normal precedes the corners.
            let (corners, _) = facet[3 * COORDINATE..].as_chunks::<{ 3 * COORDINATE }>();
            for (corner, bytes) in corners.iter().enumerate() {
                let at = start + (1 + corner) * 3 * COORDINATE;
                let (values, _) = bytes.as_chunks::<COORDINATE>();
                let position = DVec3::from_array(std::array::from_fn(|axis| {
                    f64::from(f32::from_le_bytes(values[axis]))
                }));
                if !position.is_finite() {
                    let axis = usize::from(position.x.is_finite());
                    let axis = axis + usize::from(axis == 1 && position.y.is_finite());
                    let word = word(at + axis * COORDINATE, &values[axis]);
                    let value = position[axis];
                    let message = format!("{} is {value}", ["x", "y", "z"][axis]);
                    self.wrong(Fault::new(word, message, "a finite number"));
                }
                self.add(position);
            }
            self.end(word(start, &facet[..3 * COORDINATE]))?;
        }
        if whole < bytes.len() {
            let rest = counted(bytes.len() - whole, "byte");
            let message = format!("{rest} follow the last of {count} facets");
            let fault = Fault::new(word(whole, b""), message, "the end of the file");
            self.building.warn(fault.costing("they are ignored"));
        }
        Ok(())
    }

    /// Reads facets of a text.
    pub(super) fn read_text(&mut self, bytes: &'t [u8]) -> Result<(), Fault> {
        for (start, line) in Lines::new(bytes, Place { line: 1, at: 0 }) {
            let mut words = line.split(u8::is_ascii_whitespace);
            let mut words = words.by_ref().filter(|word| !word.is_empty()).map(|text| {
                let offset = text.as_ptr() as usize - line.as_ptr() as usize;
                Word {
                    text,
                    place: Spot::from(Place {
                        at: start.at + offset,
                        ..start
                    }),
                }
            });
            let Some(keyword) = words.next() else {
                continue;
            };
            self.last = keyword;
            let is = |word: &str| keyword.text.eq_ignore_ascii_case(word.as_bytes());
            if is("vertex") {
                let end = Word {
                    text: b"",
                    place: Spot::from(Place {
                        at: start.at + line.len(),
                        ..start
                    }),
                };
                self.add_line(words, end);
            } else if is("endfacet") {
                self.end(keyword)?;
            } else if is("facet") {
                self.end_open()?;
            } else if !["outer", "endloop", "solid", "endsolid"]
                .into_iter()
                .any(is)
            {
                let message = format!("`{}` is ignored", keyword.shown());
                let expected = "facet, outer loop, vertex, endloop, endfacet or endsolid";
                self.building.warn(Fault::new(keyword, message, expected));
            }
        }
        self.end_open()
    }

    /// Adds the corner that a line gives, `end` behind its words.
    fn add_line(&mut self, words: impl Iterator<Item = Word<'t>>, end: Word<'t>) {
        let mut position = DVec3::ZERO;
        let mut found = 0;
        for word in words {
            if found == 3 {
                let fault = Fault::new(word, "expected 3 coordinates", "the end of the line");
                self.building.warn(fault.costing("the rest is ignored"));
                break;
            }
            match word.coordinate() {
                Ok(value) => position[found] = value,
                Err(fault) => return self.wrong(fault),
            }
            found += 1;
        }
        if found < 3 {
            let message = format!("expected 3 coordinates, found {found}");
            self.wrong(Fault::new(end, message, "3 coordinates"));
        }
        self.add(position);
    }

    /// Says what is wrong with the next corner.
    fn wrong(&mut self, fault: Fault) {
        let (facet, corner) = (self.count + 1, self.found + 1);
        let message = format!("facet {facet}, vertex {corner}: {}", fault.message);
        if !std::mem::replace(&mut self.is_wrong, true) {
            let fault = Fault { message, ..fault };
            self.building.warn(fault.costing("the facet is left out"));
        }
    }

    fn add(&mut self, corner: DVec3) {
        if let Some(place) = self.corners.get_mut(self.found) {
            *place = corner;
        }
        self.found += 1;
    }

    /// Ends a facet that has begun, but not ended.
    fn end_open(&mut self) -> Result<(), Fault> {
        if 0 < self.found || self.is_wrong {
            return self.end(self.last);
        }
        Ok(())
    }

    /// Ends a facet at a place. Fails if there are too many.
    fn end(&mut self, place: Word<'t>) -> Result<(), Fault> {
        let [a, b, c] = self.corners;
        self.count += 1;
        let (found, is_wrong) = (self.found, self.is_wrong);
        (self.found, self.is_wrong) = (0, false);
        if is_wrong {
            return Ok(());
        }
        if found != 3 {
            self.odd.add(place);
        } else if a == b || b == c || c == a {
            self.flat.add(place);
        } else {
            let parts = &mut self.building.parts;
            let first = parts.positions.len() as u32;
            parts.positions.extend(self.corners);
            parts.triangles.push([first, first + 1, first + 2]);
            let triangles = parts.triangles.len();
            self.building.check_room(triangles, place)?;
        }
        Ok(())
    }

    /// The mesh, unless reading it failed.
    pub(super) fn finish(mut self, read: Result<(), Fault>) -> Result<Model, Vec<Finding>> {
        for (left_out, reason) in [
            (&self.odd, "not three corners"),
            (&self.flat, "two equal corners"),
        ] {
            let Some(first) = left_out.first else {
                continue;
            };
            let facets = counted(left_out.count, "facet");
            let have = if left_out.count == 1 { "has" } else { "have" };
            let message = format!("{facets} {have} {reason}, the first of them here");
            let fault = Fault::new(first, message, EXPECTED).costing("they are left out");
            self.building.warn(fault);
        }
        let nothing = "the file has no facets that can be used";
        let nothing = Fault::new(self.last, nothing, EXPECTED);
        self.building.finish(read, nothing)
    }
}
