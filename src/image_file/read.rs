//! Picture files to the pixels of textures. The files may be anybody's: sizes are looked at before
//! memory is asked for, and what pixels do not need is not read.

use std::io::{BufRead, BufReader, ErrorKind, Read, Seek};
use std::panic::{self, AssertUnwindSafe};

use image::error::UnsupportedErrorKind;
use image::{ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};
use image::{Limits, Rgba};

use super::sieve::Sieve;
use crate::scene::{Image, Size};

/// The most pixels of a texture: 8192 × 8192, 192 MiB.
pub const MAX_TEXTURE_PIXELS: u64 = 1 << 26;

/// The most memory that a decoder may ask for, its result included: sixteen bytes a pixel is the
/// most that any format has, and those are rare.
const MAX_MEMORY: u64 = 512 << 20;

/// The most that what comes before a picture's pixels may take.
const MAX_PREFACE: u64 = 16 << 20;

/// Why a file is not a picture that can be used.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// It is not a picture of a known format.
    #[error("is not a picture of a known format")]
    Unknown,
    /// It uses a part of its format, which is named, that is not supported.
    #[error("is a {0} of an unsupported kind")]
    Unsupported(&'static str),
    /// It breaks off or contradicts itself: how.
    #[error("is not a whole picture: {0}")]
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

/// Decodes a picture file in whatever format its first bytes say, from the place where it stands. Of
/// several pictures in it the first; what is more than red, green and blue of 8 bits is left away. More
/// pixels than `room` are refused, and a JPEG of more than eight bytes a pixel and a MiB, segments that
/// its pixels don't need not counted. Memory is taken for the pixels and for what the decoder keeps of
/// the file, which is all of a JPEG.
pub fn decode(file: impl Read + Seek, room: u64) -> Result<Image, Unreadable> {
    // Decoders are others' work on anybody's bytes: if one panics, that costs the picture only.
    let decoded = panic::catch_unwind(AssertUnwindSafe(|| by_format(file, room)));
    decoded.unwrap_or_else(|_| Err(Unreadable::Broken("its decoder failed".to_owned())))
}

fn by_format(mut file: impl Read + Seek, room: u64) -> Result<Image, Unreadable> {
    /// As many as any format is known by.
    const MARK: u64 = 16;
    let unreadable = |error: std::io::Error| Unreadable::Broken(error.to_string());
    let mut mark = Vec::new();
    let length = (&mut file).take(MARK).read_to_end(&mut mark);
    let back = -(length.map_err(unreadable)? as i64);
    file.seek_relative(back).map_err(unreadable)?;
    let format = image::guess_format(&mark).map_err(|_| Unreadable::Unknown)?;
    match format {
        ImageFormat::Png => pixels(BufReader::new(Sieve::png(file)), format, room),
        ImageFormat::Jpeg => pixels(BufReader::new(Sieve::jpeg(file)), format, room),
        _ => pixels(BufReader::new(file), format, room),
    }
}

fn pixels(file: impl BufRead + Seek, format: ImageFormat, room: u64) -> Result<Image, Unreadable> {
    let broken = |error| unreadable(error, format);
    let mut reader = ImageReader::with_format(file, format);
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

/// What a decoder's error means. Its own words are no more than hints for programmers.
fn unreadable(error: ImageError, format: ImageFormat) -> Unreadable {
    let name = match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Gif => "GIF",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Bmp => "BMP",
        ImageFormat::Hdr => "Radiance HDR",
        ImageFormat::OpenExr => "OpenEXR",
        ImageFormat::Pnm => "PNM",
        _ => "picture",
    };
    match error {
        ImageError::Limits(_) => Unreadable::NoMemory,
        ImageError::Unsupported(error) => match error.kind() {
            UnsupportedErrorKind::Format(_) => Unreadable::Unknown,
            _ => Unreadable::Unsupported(name),
        },
        ImageError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
            Unreadable::Broken("it ends too early".to_owned())
        }
        ImageError::IoError(error) => Unreadable::Broken(error.to_string()),
        _ => Unreadable::Broken(format!("its {name} data is damaged")),
    }
}
