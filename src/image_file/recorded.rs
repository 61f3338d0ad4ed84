//! Picture files to compare with: their pixels, and how they were made.

use image::{DynamicImage, Rgb32FImage};

use super::input::Input;
use super::metadata::record;
use super::read::{decode, holds_light};
use super::unreadable::Unreadable;
use render::{Frame, PictureMetadata};
use scene::Image;

/// A picture with what its file says of how it was made.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// Its pixels.
    pub image: Image,
    /// How it was made; `None` if the file does not say.
    pub record: Option<PictureMetadata>,
    /// Whether the file holds floating-point values, to which no transfer curve was applied: a frame
    /// corresponds to its pixels [in 8 bits](in_8_bits).
    pub holds_light: bool,
}

impl Recorded {
    /// Reads a picture file from its beginning.
    ///
    /// # Errors
    ///
    /// Fails as [`decode`] does.
    pub fn read(file: &mut dyn Input) -> Result<Self, Unreadable> {
        let rewind = |error: std::io::Error| Unreadable::Broken(error.to_string());
        let holds_light = holds_light(file)?;
        file.rewind().map_err(rewind)?;
        let image = decode(file, u64::MAX)?;
        file.rewind().map_err(rewind)?;
        // A picture is compared whatever is wrong with what stands beside it.
        let record = record(file).ok().flatten();
        Ok(Self {
            image,
            record: record.filter(|record| !record.is_empty()),
            holds_light,
        })
    }
}

/// The floating-point values of a frame as [`decode`] reads them from a file: clamped, without a
/// transfer curve. `None` if it has none.
pub fn in_8_bits(frame: &Frame) -> Option<Vec<[u8; 3]>> {
    let (width, height) = (frame.size.width, frame.size.height);
    let values = frame.values.as_flattened().to_vec();
    let image = Rgb32FImage::from_raw(width, height, values)?;
    let bytes = DynamicImage::ImageRgb32F(image).into_rgb8();
    Some(bytes.pixels().map(|pixel| pixel.0).collect())
}
