//! Frames to picture files.

use std::io::{self, Cursor, Write};
use std::path::Path;

use image::codecs::bmp::BmpEncoder;
use image::codecs::gif::GifEncoder;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError, Rgb};

use super::{ImageFormat, known_extensions};
use crate::file::{self, Version};
use crate::render::{Frame, Frames};
use crate::scene::Size;

/// From 1 to 100: errors can't be seen at this quality, and a file is a third of a PNG's.
const JPEG_QUALITY: u8 = 95;

/// How many pixels are looked at to find a GIF's palette where it has more colours than fit: of a
/// larger picture one of several, of ten at the most.
const GIF_SAMPLES: usize = 1 << 17;

/// The greatest value that is written to an HDR file, near the greatest that it can hold.
const MAX_HDR: f32 = 1e38;

/// What a BMP has before its pixels.
const BMP_HEADER: usize = 54;

/// What a TIFF has besides its pixels and its list of strips, and more.
const TIFF_HEADER: usize = 4096;

impl ImageFormat {
    /// Encodes a frame, which is one of [`ImageFormat::frames`]. The same frame gives the same
    /// bytes.
    pub fn write(self, frame: &Frame, out: &mut dyn Write) -> io::Result<()> {
        if self.frames() == Frames::LastWithValues && frame.values.len() != frame.pixels.len() {
            let reason = "the picture was traced without its values";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        let mut out = Remembering { out, error: None };
        let encoded = self.encode(frame, &mut out);
        match (encoded, out.error) {
            (Ok(()), _) => Ok(()),
            (Err(_), Some(error)) | (Err(ImageError::IoError(error)), None) => Err(error),
            (Err(other), None) => Err(io::Error::other(other)),
        }
    }

    fn encode(self, frame: &Frame, out: &mut Remembering<'_>) -> Result<(), ImageError> {
        let Size { width, height } = frame.size;
        let pixels = frame.pixels.as_flattened();
        let colour = ExtendedColorType::Rgb8;
        match self {
            Self::Bmp => {
                // The encoder writes pixel by pixel: by way of memory in half the time.
                let mut bytes = room(pixels.len() + 4 * height as usize + BMP_HEADER)?;
                BmpEncoder::new(&mut bytes).write_image(pixels, width, height, colour)?;
                out.write_all(&bytes).map_err(ImageError::IoError)
            }
            Self::Png => PngEncoder::new(out).write_image(pixels, width, height, colour),
            // The `image` crate writes another header, which readers of three lines refuse.
            Self::Ppm => write!(out, "P6\n{width} {height}\n255\n")
                .and_then(|()| out.write_all(pixels))
                .map_err(ImageError::IoError),
            Self::Tiff => write_tiff(pixels, frame.size, out),
            Self::Gif => {
                let stride = (frame.size.pixels() / GIF_SAMPLES).clamp(1, 10) as i32;
                let mut encoder = GifEncoder::new_with_speed(out, stride);
                encoder.encode(pixels, width, height, colour)
            }
            Self::Jpeg => JpegEncoder::new_with_quality(out, JPEG_QUALITY)
                .write_image(pixels, width, height, colour),
            Self::Exr => write_exr(&frame.values, frame.size, out),
            Self::Hdr => {
                // The format has nothing below 0, and nothing infinite.
                let held = |value: &[f32; 3]| Rgb(value.map(|x| x.clamp(0.0, MAX_HDR)));
                let values: Vec<_> = frame.values.iter().map(held).collect();
                HdrEncoder::new(out).encode(&values, width as usize, height as usize)
            }
        }
    }
}

/// Keeps what went wrong in writing: some encoders tell it in words of their own only.
struct Remembering<'a> {
    out: &'a mut dyn Write,
    error: Option<io::Error>,
}

impl Remembering<'_> {
    fn note<T>(&mut self, outcome: io::Result<T>) -> io::Result<T> {
        outcome.map_err(|error| {
            let kind = error.kind();
            if kind != io::ErrorKind::Interrupted {
                self.error = Some(error);
            }
            kind.into()
        })
    }
}

impl Write for Remembering<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes);
        self.note(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.out.flush();
        self.note(flushed)
    }
}

/// Memory for a file of this length.
fn room(length: usize) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    let reserved = bytes.try_reserve_exact(length);
    reserved.map_err(|error| ImageError::IoError(error.into()))?;
    Ok(bytes)
}

/// Encodes a TIFF in memory: its beginning says where its end is, and a stream does not go back.
fn write_tiff(pixels: &[u8], size: Size, out: &mut impl Write) -> Result<(), ImageError> {
    let Size { width, height } = size;
    let mut bytes = Cursor::new(room(pixels.len() + 8 * height as usize + TIFF_HEADER)?);
    TiffEncoder::new(&mut bytes).write_image(pixels, width, height, ExtendedColorType::Rgb8)?;
    out.write_all(bytes.get_ref()).map_err(ImageError::IoError)
}

/// Encodes an `OpenEXR` in memory: it has tables of places, too.
fn write_exr(values: &[[f32; 3]], size: Size, out: &mut impl Write) -> Result<(), ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    // The encoder takes the bytes of numbers in the machine's order.
    let values: Vec<u8> = values
        .as_flattened()
        .iter()
        .flat_map(|value| value.to_ne_bytes())
        .collect();
    let colour = ExtendedColorType::Rgb32F;
    OpenExrEncoder::new(&mut bytes).write_image(&values, size.width, size.height, colour)?;
    out.write_all(bytes.get_ref()).map_err(ImageError::IoError)
}

/// Writes a frame to a file, whole or not at all, in the format its extension says; or to a pipe or
/// a device of such a name. `may` is asked when the picture only has to take its place. Returns the
/// version of the file, if it is one.
pub fn save<E: From<io::Error>>(
    frame: &Frame,
    path: &Path,
    may: impl Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    let format = ImageFormat::of_path(path).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            format!("pictures end in {}", known_extensions()),
        )
    })?;
    file::deliver(path, |out| format.write(frame, out), may)
}
