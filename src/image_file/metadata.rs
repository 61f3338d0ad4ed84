//! What a picture is made from, stored in PNG and EXR files as lines of names and values.

use std::io::{BufReader, Read};
use std::panic::{self, AssertUnwindSafe};

use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;

use super::input::Input;
use super::{MAX_PIXELS, Unreadable};
use render::{PictureMetadata, Provenance};

/// The keyword of the text in a PNG, and the name of the attribute in an EXR.
pub(super) const KEYWORD: &str = "halflight";

/// The first bytes of a PNG.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// The first bytes of an EXR.
const EXR: &[u8] = b"\x76\x2f\x31\x01";

/// The memory limit, in bytes, for what comes before the pixels of a PNG.
const MOST: usize = 16 << 20;

/// A picture's origin as text.
pub(super) fn text(provenance: &Provenance) -> String {
    format!("{}spp {}\n", provenance.lines(), provenance.settings.spp)
}

/// Reads what a file says of how its picture was made; `None` if it says nothing.
///
/// # Errors
///
/// Fails if it is neither a PNG nor an EXR, or damaged before its pixels.
pub fn record(file: &mut dyn Input) -> Result<Option<PictureMetadata>, Unreadable> {
    // As for pixels, decoders run on untrusted bytes.
    let read = panic::catch_unwind(AssertUnwindSafe(|| stored_text(file)));
    let text = read.unwrap_or_else(|_| Err(Unreadable::Broken("its decoder failed".to_owned())))?;
    let read = |text: String| {
        let mut record = PictureMetadata::read(&text);
        record.limit(MAX_PIXELS);
        record
    };
    let says_something = |record: &PictureMetadata| !record.is_empty() || record.unused().is_some();
    Ok(text.map(read).filter(says_something))
}

fn stored_text(file: &mut dyn Input) -> Result<Option<String>, Unreadable> {
    let mut magic = Vec::new();
    let read = Read::take(&mut *file, PNG.len() as u64).read_to_end(&mut magic);
    read.and_then(|_| file.rewind()).map_err(broken)?;
    let file = BufReader::new(file);
    if magic == PNG {
        let mut decoder = png::Decoder::new(file);
        decoder.set_limits(png::Limits { bytes: MOST });
        let mut reader = decoder.read_info().map_err(broken)?;
        if let Some(text) = text_of(reader.info()) {
            return Ok(Some(text));
        }
        // Programs that rewrite a PNG may put texts after its pixels.
        reader.finish().map_err(broken)?;
        Ok(text_of(reader.info()))
    } else if magic.starts_with(EXR) {
        let meta = MetaData::read_from_buffered(file, false).map_err(broken)?;
        let first = meta.headers.first();
        let others = first.map(|header| header.own_attributes.other.iter());
        let found = others.into_iter().flatten().find_map(|(name, value)| {
            let AttributeValue::Text(text) = value else {
                return None;
            };
            (*name == *KEYWORD).then(|| text.to_string())
        });
        Ok(found)
    } else {
        Err(Unreadable::Unknown)
    }
}

/// The text with our keyword, as far as a PNG was read.
fn text_of(png: &png::Info<'_>) -> Option<String> {
    let mut texts = png.uncompressed_latin1_text.iter();
    let found = texts.find(|text| text.keyword == KEYWORD)?;
    Some(found.text.clone())
}

fn broken(error: impl std::fmt::Display) -> Unreadable {
    Unreadable::Broken(error.to_string())
}
