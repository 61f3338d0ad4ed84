//! Decodes picture files into textures. Files are untrusted: sizes are checked before memory is
//! allocated, and data that the pixels do not need is not read.

use std::io::{BufReader, ErrorKind, Read};
use std::panic::{self, AssertUnwindSafe};

use image::error::UnsupportedErrorKind;
use image::{
    ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits, Rgba,
};

use super::exr_colours::read_colours;
use super::input::Input;
use super::sieve::Sieve;
use super::unreadable::{MAX_MEMORY, Unreadable, check_room, check_size, unsupported};
use scene::{Image, Size};

/// The memory limit, in bytes, for everything before the pixels.
const MAX_HEADER: u64 = 16 << 20;

/// Decodes a picture file from its current position; its first bytes determine the format. Of
/// several pictures the first is read, reduced to 8-bit red, green and blue. Fails if it has more
/// pixels than `room`, or if a JPEG has more than eight bytes per pixel plus 1 MiB, not counting
/// segments that the pixels do not need. Memory is taken for the pixels and for what the decoder
/// keeps of the file, which is all of a JPEG.
pub fn decode(file: &mut dyn Input, room: u64) -> Result<Image, Unreadable> {
    // Third-party decoders run on untrusted bytes: if one panics, only the picture is lost.
    let decoded = panic::catch_unwind(AssertUnwindSafe(|| by_format(file, room)));
    decoded.unwrap_or_else(|_| Err(Unreadable::Broken("its decoder failed".to_owned())))
}

/// Whether a picture file holds floating-point values.
pub(super) fn holds_light(file: &mut dyn Input) -> Result<bool, Unreadable> {
    let format = format(file)?;
    Ok(matches!(format, ImageFormat::OpenExr | ImageFormat::Hdr))
}

/// The format, by the first bytes; the file stays where it is.
fn format(file: &mut dyn Input) -> Result<ImageFormat, Unreadable> {
    /// The length of the longest magic number of any format.
    const MAGIC: u64 = 16;
    let unreadable = |error: std::io::Error| Unreadable::Broken(error.to_string());
    let mut magic = Vec::new();
    let length = Read::take(&mut *file, MAGIC).read_to_end(&mut magic);
    let back = -(length.map_err(unreadable)? as i64);
    file.seek_relative(back).map_err(unreadable)?;
    // Whatever program is named after `#?` wrote the same format.
    if magic.starts_with(b"#?") {
        return Ok(ImageFormat::Hdr);
    }
    image::guess_format(&magic).map_err(|_| Unreadable::Unknown)
}

fn by_format(file: &mut dyn Input, room: u64) -> Result<Image, Unreadable> {
    let format = format(file)?;
    match format {
        ImageFormat::Hdr => pixels(&mut Sieve::hdr(file), format, room),
        ImageFormat::OpenExr => read_colours(file, room),
        ImageFormat::Png => pixels(&mut Sieve::png(file), format, room),
        ImageFormat::Jpeg => pixels(&mut Sieve::jpeg(file), format, room),
        _ => pixels(file, format, room),
    }
}

fn pixels(file: &mut dyn Input, format: ImageFormat, room: u64) -> Result<Image, Unreadable> {
    let broken = |error| unreadable(error, format);
    let mut reader = ImageReader::with_format(BufReader::new(file), format);
    let limits = |bytes| {
        let mut limits = Limits::default();
        limits.max_alloc = Some(bytes);
        limits
    };
    reader.limits(limits(MAX_HEADER));
    let mut decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let size = Size { width, height };
    check_size(size, room)?;
    if MAX_MEMORY < decoder.total_bytes() {
        return Err(Unreadable::NoMemory);
    }
    decoder.set_limits(limits(MAX_MEMORY)).map_err(broken)?;
    // The decoder's own pixels, and those it returns.
    check_room(size, 2 * decoder.total_bytes())?;
    let mut pixels = Vec::<[u8; 3]>::with_capacity(size.pixels());
    if decoder.color_type() == ColorType::Rgb8 {
        pixels.resize(size.pixels(), [0; 3]);
        let read = decoder.read_image(pixels.as_flattened_mut());
        read.map_err(broken)?;
    } else {
        match DynamicImage::from_decoder(decoder).map_err(broken)? {
            // The most frequent case, without another copy.
            DynamicImage::ImageRgba8(image) => {
                pixels.extend(image.pixels().map(|&Rgba([r, g, b, _])| [r, g, b]));
            }
            image => pixels.extend(image.into_rgb8().pixels().map(|pixel| pixel.0)),
        }
    }
    Image::new(size, pixels).ok_or_else(|| Unreadable::Broken("it has no pixels".to_owned()))
}

/// Translates a decoder's error, whose own message is meant for programmers.
fn unreadable(error: ImageError, format: ImageFormat) -> Unreadable {
    let name = match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Gif => "GIF",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Bmp => "BMP",
        ImageFormat::Hdr => "Radiance HDR",
        ImageFormat::Pnm => "PNM",
        _ => "picture",
    };
    match error {
        ImageError::Limits(_) => Unreadable::NoMemory,
        ImageError::Unsupported(error) => match error.kind() {
            UnsupportedErrorKind::Format(_) => Unreadable::Unknown,
            UnsupportedErrorKind::GenericFeature(what) => unsupported(name, &compression(&what)),
            _ => unsupported(name, ""),
        },
        ImageError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
            Unreadable::Broken("it is truncated".to_owned())
        }
        ImageError::IoError(error) => Unreadable::Broken(error.to_string()),
        _ => Unreadable::Broken(format!("its {name} data is damaged")),
    }
}

/// The compression that a decoder's message says it does not support, as in
/// `UnsupportedCompressionMethod(LZMA)`; empty if it says something else.
fn compression(what: &str) -> String {
    let (_, named) = what.split_once("CompressionMethod(").unwrap_or_default();
    match named.split_once(')') {
        Some((name, _)) => format!("{name} compression"),
        None => String::new(),
    }
}
