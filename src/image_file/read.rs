//! Picture files to the pixels of textures. The bytes may be anybody's: sizes are looked at before
//! memory is asked for.

use std::io::Cursor;
use std::panic;

use image::{ColorType, DynamicImage, ImageDecoder, ImageError, ImageReader, Limits, Rgba};

use crate::scene::{Image, Size};

/// The most pixels of a texture: 8192 × 8192, 192 MiB.
pub const MAX_TEXTURE_PIXELS: u64 = 1 << 26;

/// The most memory that a decoder may ask for, its result included: sixteen bytes a pixel is the
/// most that any format has, and those are rare.
const MAX_MEMORY: u64 = 512 << 20;

/// The most that what comes before a picture's pixels may take, such as a colour profile. Larger ones
/// are passed over, or refused with the picture.
const MAX_PREFACE: u64 = 16 << 20;

/// Why bytes are not a picture that can be used.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// They are no picture of a known format.
    #[error("is no picture of a known format")]
    Unknown,
    /// They break off or contradict themselves; what the decoder says.
    #[error("is no whole picture: {0}")]
    Broken(String),
    /// The picture has more than [`MAX_TEXTURE_PIXELS`].
    #[error("is {width}x{height}: a texture has at most {MAX_TEXTURE_PIXELS} pixels (8192x8192)")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// It has more pixels than there was room for.
    #[error("the scene's textures have too many pixels together")]
    NoRoom,
    /// There is no memory for it, or its decoder wants more than [`MAX_MEMORY`].
    #[error("takes more memory than there is for a texture (512 MiB)")]
    NoMemory,
}

/// Decodes a picture in whatever format its first bytes say. Of several in a file the first; what
/// is more than red, green and blue of 8 bits is left away. More pixels than `room` are refused.
pub fn decode(bytes: &[u8], room: u64) -> Result<Image, Unreadable> {
    // Decoders are others' work on anybody's bytes: if one panics, that costs the picture only.
    let decoded = panic::catch_unwind(|| decode_trusting(bytes, room));
    decoded.unwrap_or_else(|_| Err(Unreadable::Broken("its decoder failed".to_owned())))
}

fn decode_trusting(bytes: &[u8], room: u64) -> Result<Image, Unreadable> {
    let broken = |error: ImageError| match error {
        ImageError::Limits(_) => Unreadable::NoMemory,
        ImageError::Unsupported(_) => Unreadable::Unknown,
        other => Unreadable::Broken(other.to_string()),
    };
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| Unreadable::Broken(error.to_string()))?;
    let limits = |bytes| {
        let mut limits = Limits::default();
        limits.max_alloc = Some(bytes);
        limits
    };
    reader.limits(limits(MAX_PREFACE));
    let mut decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let count = u64::from(width) * u64::from(height);
    if MAX_TEXTURE_PIXELS < count {
        return Err(Unreadable::TooLarge { width, height });
    }
    if room < count {
        return Err(Unreadable::NoRoom);
    }
    if MAX_MEMORY < decoder.total_bytes() {
        return Err(Unreadable::NoMemory);
    }
    decoder.set_limits(limits(MAX_MEMORY)).map_err(broken)?;
    let size = Size { width, height };
    let mut pixels = Vec::<[u8; 3]>::new();
    let reserved = pixels.try_reserve_exact(size.pixels());
    reserved.map_err(|_| Unreadable::NoMemory)?;
    if decoder.color_type() == ColorType::Rgb8 {
        pixels.resize(size.pixels(), [0; 3]);
        let read = decoder.read_image(pixels.as_flattened_mut());
        read.map_err(broken)?;
    } else {
        // The decoder's own memory is asked for in a way that ends the process where there is none.
        let asked = Vec::<u8>::new().try_reserve_exact(decoder.total_bytes() as usize);
        asked.map_err(|_| Unreadable::NoMemory)?;
        match DynamicImage::from_decoder(decoder).map_err(broken)? {
            // Most of them, without another copy.
            DynamicImage::ImageRgba8(image) => {
                pixels.extend(image.pixels().map(|&Rgba([r, g, b, _])| [r, g, b]));
            }
            image => pixels.extend(image.into_rgb8().pixels().map(|pixel| pixel.0)),
        }
    }
    Image::new(size, pixels).ok_or_else(|| Unreadable::Broken("it has no pixels".to_owned()))
}
