//! Faces of meshes.

use super::lines::{Fault, Statement, Word};
use super::mesh::MeshBuilder;
use super::plain::push_corners;
use geometry::ABSENT;

/// The kinds of values that a corner of a face refers to, in this order.
const KINDS: [&str; 3] = ["v", "vt", "vn"];

/// What each kind costs if a corner refers to no such value.
const COSTS: [&str; 3] = [
    LEFT_OUT,
    "its texture coordinates read as 0 0",
    "the face is shaded flat at that corner",
];

const LEFT_OUT: &str = "the face is left out";

/// The form of a corner.
const CORNER: &str = "v, v/vt, v//vn or v/vt/vn";

/// An index that can be used.
const EXISTING: &str = "the index of an existing v, vt or vn";

/// Why an index cannot be used.
enum Wrong {
    /// What is wrong with it.
    Said(Fault),
    /// The line with its value is wrong, which has been said there.
    Known,
}

impl MeshBuilder<'_> {
    /// Adds the triangles of a face, and warns of the first thing that is wrong with it. Fails if
    /// there are too many triangles.
    pub(super) fn face(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        let (is_whole, fault) = self.corners(statement, &mut corners);
        if let Some(fault) = fault {
            self.findings.warn(self.file, fault.in_statement(statement));
        }
        let added = if is_whole {
            self.add_fan(statement, &corners)
        } else {
            Ok(())
        };
        self.corners = corners;
        added
    }

    /// Reads the corners of a face. Returns whether it can be used, and what to warn of.
    fn corners(
        &mut self,
        statement: &Statement<'_>,
        corners: &mut Vec<[u32; 3]>,
    ) -> (bool, Option<Fault>) {
        let mut doubt = None;
        for word in statement.words().skip(1) {
            if word.begins_foreign_comment() {
                doubt.get_or_insert_with(|| Fault::foreign_comment(word));
                break;
            }
            match self.corner(word, &mut doubt) {
                Ok(corner) => corners.push(corner),
                Err(Wrong::Known) => return (false, None),
                Err(Wrong::Said(fault)) => return (false, Some(fault)),
            }
        }
        if corners.len() < 3 {
            let count = corners.len();
            let message = format!("expected at least three corners, found {count}");
            let fault = Fault::new(statement.end(), message, "at least three corners");
            return (false, Some(fault.costing(LEFT_OUT)));
        }
        (true, doubt)
    }

    /// Parses the indices of a corner, converted to start at 0. Fails if it has no position. `doubt`
    /// is the first thing to warn of.
    fn corner(&mut self, word: Word<'_>, doubt: &mut Option<Fault>) -> Result<[u32; 3], Wrong> {
        let mut corner = [ABSENT; 3];
        for (kind, text) in word.text.split(|&byte| byte == b'/').enumerate() {
            if kind == KINDS.len() {
                let message = format!("`{}` has more than three indices", word.shown());
                let fault = Fault::new(word, message, CORNER).costing("the rest is ignored");
                doubt.get_or_insert(fault);
                break;
            }
            if text.is_empty() && 0 < kind {
                continue;
            }
            match self.index(kind, text, word) {
                Ok(index) => {
                    corner[kind] = index;
                    self.greatest[kind] = self.greatest[kind].max(index + 1);
                }
                Err(wrong) if kind == 0 => return Err(wrong),
                Err(Wrong::Said(fault)) => {
                    doubt.get_or_insert(fault);
                }
                Err(Wrong::Known) => {}
            }
        }
        Ok(corner)
    }

    /// Parses an index of a corner, converted to start at 0.
    fn index(&self, kind: usize, text: &[u8], corner: Word<'_>) -> Result<u32, Wrong> {
        let (name, count) = (KINDS[kind], self.counts()[kind]);
        let wrong = |message: String, expected: &str| {
            Wrong::Said(Fault::new(corner, message, expected).costing(COSTS[kind]))
        };
        let shown = || corner.shown();
        let number = std::str::from_utf8(text).ok();
        let number: Option<i64> = number.and_then(|text| text.parse().ok());
        let index = match number {
            None => {
                let message = format!("`{}` is not a corner: expected {CORNER}", shown());
                return Err(wrong(message, CORNER));
            }
            Some(0) => {
                let message = format!("`{}` is not an index: indices start at 1", shown());
                return Err(wrong(message, "an index of 1 or more, or below 0"));
            }
            Some(number) if 0 < number => number - 1,
            Some(number) => count as i64 + number,
        };
        let Some(index) = u32::try_from(index).ok().filter(|&index| index < ABSENT) else {
            let lines = match count {
                0 => format!("no {name} line precedes it"),
                1 => format!("only 1 {name} line precedes it"),
                count => format!("only {count} {name} lines precede it"),
            };
            let message = format!("`{}` is out of range: {lines}", shown());
            return Err(wrong(message, EXISTING));
        };
        match &self.known {
            Some(known) if known.counts[kind] <= index as usize => {
                let (number, count) = (index + 1, known.counts[kind]);
                let message = format!("refers to {name} {number}, but there are only {count}");
                Err(wrong(message, EXISTING))
            }
            Some(known) if !known.is_usable(kind, index) => Err(Wrong::Known),
            _ => Ok(index),
        }
    }

    /// Adds a face as a fan around its first corner.
    fn add_fan(&mut self, statement: &Statement<'_>, corners: &[[u32; 3]]) -> Result<(), Fault> {
        let parts = &mut self.parts;
        let first = parts.triangles.len();
        if self.most < first + corners.len() - 2 {
            let most = format!("{} triangles", self.most);
            let message = format!("f: more than {most}");
            return Err(Fault::new(
                statement.keyword(),
                message,
                format!("at most {most}"),
            ));
        }
        if 3 < corners.len() {
            self.polygons.push(first, corners.len());
        }
        for pair in corners[1..].windows(2) {
            let fan = [corners[0], pair[0], pair[1]];
            parts.triangles.push(fan.map(|corner| corner[0]));
            let number = parts.triangles.len();
            push_corners(&mut parts.uvs.corners, number, fan.map(|corner| corner[1]));
            push_corners(
                &mut parts.normals.corners,
                number,
                fan.map(|corner| corner[2]),
            );
        }
        Ok(())
    }
}
