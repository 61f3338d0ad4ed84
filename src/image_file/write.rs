//! Encodes frames as picture files.

use std::io::{self, Cursor, Write};
use std::path::Path;

use image::codecs::bmp::BmpEncoder;
use image::codecs::gif::GifEncoder;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError, Rgb};

use super::picture::Picture;
use super::{ImageFormat, exr, known_extensions, metadata};
use file::Version;
use render::Frames;
use scene::Size;

/// From 1 to 100. At 95 errors are invisible, and files are a third as long as a PNG.
const JPEG_QUALITY: u8 = 95;

/// About how many pixels determine the palette of a GIF with more than 256 colours. Larger pictures
/// are sampled at every n-th pixel, at most every tenth.
const GIF_SAMPLES: usize = 1 << 17;

/// The greatest value written to an HDR file, near the greatest that the format can represent.
const MAX_HDR: f32 = 1e38;

/// The length of the header of a BMP, in bytes.
const BMP_HEADER: usize = 54;

/// An upper bound, in bytes, for the rest of a TIFF beside its pixels and its table of strips.
const TIFF_HEADER: usize = 4096;

impl ImageFormat {
    /// Encodes a picture whose frame is of the kind that [`ImageFormat::frames`] requires.
    /// Deterministic: the same picture gives the same bytes.
    pub fn write(self, picture: Picture<'_>, out: &mut dyn Write) -> io::Result<()> {
        let frame = picture.frame;
        if self.frames() == Frames::LastWithValues && frame.values.len() != frame.pixels.len() {
            let reason = "the picture was traced without floating-point values";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        let mut out = Remembering { out, error: None };
        let encoded = self.encode(picture, &mut out);
        match (encoded, out.error) {
            (Ok(()), _) => Ok(()),
            (Err(_), Some(error)) | (Err(ImageError::IoError(error)), None) => Err(error),
            (Err(other), None) => Err(io::Error::other(other)),
        }
    }

    fn encode(self, picture: Picture<'_>, out: &mut Remembering<'_>) -> Result<(), ImageError> {
        let frame = picture.frame;
        let Size { width, height } = frame.size;
        let pixels = frame.pixels.as_flattened();
        let colour = ExtendedColorType::Rgb8;
        match self {
            Self::Bmp => {
                // The encoder writes pixel by pixel: via a buffer it takes half the time.
                let mut bytes = room(pixels.len() + 4 * height as usize + BMP_HEADER)?;
                BmpEncoder::new(&mut bytes).write_image(pixels, width, height, colour)?;
                out.write_all(&bytes).map_err(ImageError::IoError)
            }
            Self::Png => write_png(picture, out).map_err(|error| ImageError::IoError(error.into())),
            // The `image` crate writes a header that readers which expect three lines refuse.
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
            Self::Exr => {
                let written = exr::write(picture, out);
                written.map_err(|error| ImageError::IoError(io::Error::other(error)))
            }
            Self::Hdr => {
                // The format has neither negative nor infinite values.
                let clamped = |value: &[f32; 3]| Rgb(value.map(|x| x.clamp(0.0, MAX_HDR)));
                let values: Vec<_> = frame.values.iter().map(clamped).collect();
                HdrEncoder::new(out).encode(&values, width as usize, height as usize)
            }
        }
    }
}

/// Encodes pixels as a PNG that is read once, for a screen: a few milliseconds for a million. Fails
/// if there are no pixels, or not as many as the size says.
pub fn encode_quickly(size: Size, pixels: &[[u8; 3]]) -> io::Result<Vec<u8>> {
    let mut png = Vec::new();
    // Compressing the pixels as they are takes as long and gives half as many bytes more.
    let encoder =
        PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Adaptive);
    let colour = ExtendedColorType::Rgb8;
    let encoded = encoder.write_image(pixels.as_flattened(), size.width, size.height, colour);
    encoded.map(|()| png).map_err(io::Error::other)
}

/// A writer that keeps its last error: some encoders replace it by a message of their own.
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

/// An empty buffer with the given capacity in bytes. Fails if there is not enough memory.
fn room(length: usize) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    let reserved = bytes.try_reserve_exact(length);
    reserved.map_err(|error| ImageError::IoError(error.into()))?;
    Ok(bytes)
}

/// Encodes a TIFF in memory: its header contains offsets, and `out` cannot seek.
fn write_tiff(pixels: &[u8], size: Size, out: &mut impl Write) -> Result<(), ImageError> {
    let Size { width, height } = size;
    let mut bytes = Cursor::new(room(pixels.len() + 8 * height as usize + TIFF_HEADER)?);
    TiffEncoder::new(&mut bytes).write_image(pixels, width, height, ExtendedColorType::Rgb8)?;
    out.write_all(bytes.get_ref()).map_err(ImageError::IoError)
}

/// Encodes a PNG. The encoder of the `image` crate has the same defaults, but writes no texts.
fn write_png(picture: Picture<'_>, out: &mut impl Write) -> Result<(), png::EncodingError> {
    let Size { width, height } = picture.frame.size;
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Adaptive);
    if let Some(provenance) = picture.provenance {
        let software = format!("Halflight {}", provenance.version);
        encoder.add_text_chunk("Software".to_owned(), software)?;
        encoder.add_text_chunk(metadata::KEYWORD.to_owned(), metadata::text(provenance))?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.frame.pixels.as_flattened())?;
    writer.finish()
}

/// Writes a picture in the format of the path's extension, atomically to a file, or to a pipe or
/// device. `confirm` is called just before the finished picture takes its name. Returns the version
/// of the file, `None` for pipes and devices.
pub fn save<E: From<io::Error>>(
    picture: Picture<'_>,
    path: &Path,
    confirm: &dyn Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    let format = ImageFormat::of_path(path).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            format!("picture files end in {}", known_extensions()),
        )
    })?;
    file::deliver(path, &mut |out| format.write(picture, out), confirm)
}
