//! `.stl`: triangles with their own corners, as numbers or as text.
//!
//! Corners are kept as they are written: they have no values that equal ones would share. Normals are not
//! used, since those of the corners' order are the same.
//!
//! `stl_io` 0.11.0 takes anything that begins with `solid` for a text, gives no places, and is slower: 0.21 s
//! instead of 0.07 s for a million facets as numbers, 1.5 s instead of 0.6 s as text.

mod facets;

use super::building::Building;
use super::findings::File;
use super::lines::{Fault, Place, Spot, Word};
use super::{Finding, Model};
use facets::Facets;
use text::counted;

/// The length in bytes of what precedes the facets: any text, and their number.
const HEAD: usize = 84;

/// The length in bytes of a facet: a normal, three corners, and two bytes for anything.
const FACET: usize = 50;

/// What a file without a single facet lacks.
const EXPECTED: &str = "a facet with three corners";

/// Reads a mesh; see [`super::read`]. `most` is the maximum number of triangles.
pub(super) fn read(bytes: &[u8], most: usize) -> Result<Model, Vec<Finding>> {
    let file = File::text(bytes);
    let announced = announced(bytes);
    let whole = announced.and_then(|count| count.checked_mul(FACET)?.checked_add(HEAD));
    let is_text = bytes.trim_ascii_start().starts_with(b"solid");
    let mut facets = Facets::new(Building::new(file, most));
    let read = match (announced, whole) {
        (Some(count), Some(whole)) if whole == bytes.len() || !is_text && whole <= bytes.len() => {
            facets.read_numbers(bytes, count, whole)
        }
        _ if is_text => facets.read_text(bytes),
        (Some(count), _) => {
            let length = counted(bytes.len(), "byte");
            let message =
                format!("the file is cut short: it has {length} and announces {count} facets");
            let expected = format!("{HEAD} bytes and {FACET} for each facet, or a text with solid");
            Err(Fault::new(
                place(Place { line: 1, at: 0 }),
                message,
                expected,
            ))
        }
        (None, _) => {
            let message = "this is no .stl file";
            let expected = format!("a text with solid, or at least {HEAD} bytes");
            Err(Fault::new(
                place(Place { line: 1, at: 0 }),
                message,
                expected,
            ))
        }
    };
    facets.finish(read)
}

/// The number of facets that a file announces, unless it is too short for that.
fn announced(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEAD - 4..HEAD)?.first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

fn place<'t>(place: Place) -> Word<'t> {
    Word {
        text: b"",
        place: Spot::from(place),
    }
}
