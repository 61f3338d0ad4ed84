//! Frames to picture files. Knows nothing of scenes but the size of a picture.

use std::io::{self, Write};
use std::path::Path;

use image::codecs::{bmp::BmpEncoder, png::PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};

use crate::file;
use crate::render::Frame;
use crate::scene::Size;

/// The picture formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// 24-bit uncompressed, bottom-up.
    Bmp,
    /// Binary PPM, `P6`.
    Ppm,
    /// PNG, 8 bits a channel.
    Png,
}

/// Each format's name, which is the extension of its files too.
pub const FORMATS: [(&str, ImageFormat); 3] = [
    ("bmp", ImageFormat::Bmp),
    ("ppm", ImageFormat::Ppm),
    ("png", ImageFormat::Png),
];

/// The most pixels a picture may have, of any format. Tracing keeps about forty bytes a pixel:
/// ten gigabytes at this limit.
pub const MAX_PIXELS: u64 = 1 << 28;

/// The longest side of a BMP. The format has 32 bits for it, but readers, the `image` crate's
/// among them, stop at 16.
const MAX_BMP_SIDE: u32 = 65_535;

/// The longest side of a PNG, from its specification.
const MAX_PNG_SIDE: u32 = (1 << 31) - 1;

// A BMP's file size is a 32-bit number. Rows are padded by up to three bytes each.
const _: () = assert!(54 + 3 * MAX_PIXELS + 3 * (MAX_BMP_SIDE as u64) < 1 << 32);

impl ImageFormat {
    /// The format a file name's extension says, in any case.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        FORMATS
            .into_iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(extension))
            .map(|(_, format)| format)
    }

    /// Why a picture of this size can't be written in this format, if so: asked before tracing.
    pub fn refuses(self, size: Size) -> Option<String> {
        let Size { width, height } = size;
        let max_side = match self {
            Self::Bmp => MAX_BMP_SIDE,
            Self::Png => MAX_PNG_SIDE,
            Self::Ppm => u32::MAX,
        };
        if width == 0 || height == 0 {
            Some(format!(
                "{width}x{height}: a picture has at least one pixel each way"
            ))
        } else if max_side < width.max(height) {
            Some(format!(
                "{width}x{height}: a {} is at most {max_side} pixels wide and high",
                self.name().to_uppercase()
            ))
        } else if MAX_PIXELS < u64::from(width) * u64::from(height) {
            Some(format!(
                "{width}x{height}: a picture has at most {MAX_PIXELS} pixels (16384x16384)"
            ))
        } else {
            None
        }
    }

    /// Encodes a frame. The same frame gives the same bytes.
    pub fn write(self, frame: &Frame, mut out: &mut dyn Write) -> io::Result<()> {
        let Size { width, height } = frame.size;
        let pixels = frame.pixels.as_flattened();
        let colour = ExtendedColorType::Rgb8;
        match self {
            Self::Bmp => {
                let encoder = BmpEncoder::new(&mut out);
                encoder.write_image(pixels, width, height, colour)
            }
            Self::Png => PngEncoder::new(out).write_image(pixels, width, height, colour),
            // The `image` crate writes another header, which readers of three lines refuse.
            Self::Ppm => write!(out, "P6\n{width} {height}\n255\n")
                .and_then(|()| out.write_all(pixels))
                .map_err(ImageError::IoError),
        }
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::Bmp => "bmp",
            Self::Ppm => "ppm",
            Self::Png => "png",
        }
    }
}

/// Writes a frame to a file, whole or not at all, in the format its extension says.
pub fn save(frame: &Frame, path: &Path) -> io::Result<()> {
    let format = ImageFormat::of_path(path).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            format!("{}: pictures end in {}", path.display(), known_extensions()),
        )
    })?;
    file::replace(path, |out| format.write(frame, out))
}

/// The extensions of picture files as words: `.bmp, .ppm or .png`.
pub fn known_extensions() -> String {
    let names = FORMATS.map(|(name, _)| format!(".{name}"));
    match names.split_last() {
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::render::{NO_OBJECT, Progress};

    /// A finished frame of these pixels.
    fn frame(width: u32, height: u32, pixels: &[[u8; 3]]) -> Frame {
        Frame {
            generation: 1,
            size: Size { width, height },
            pixels: pixels.to_vec(),
            objects: vec![NO_OBJECT; pixels.len()],
            progress: Progress {
                pass: 1,
                passes: 1,
                spp: 1,
                done: 1.0,
                elapsed: Duration::ZERO,
                rays: 0,
                over_budget: 0,
                complete: true,
            },
        }
    }

    const RED: [u8; 3] = [255, 1, 2];
    const GREEN: [u8; 3] = [3, 254, 4];
    const BLUE: [u8; 3] = [5, 6, 253];

    fn encoded(format: ImageFormat, frame: &Frame) -> Vec<u8> {
        let mut bytes = Vec::new();
        format.write(frame, &mut bytes).expect("memory takes all");
        bytes
    }

    #[test]
    fn a_ppm_has_three_header_lines_and_rows_from_the_top() {
        let frame = frame(3, 1, &[RED, GREEN, BLUE]);
        let expected = b"P6\n3 1\n255\n\xFF\x01\x02\x03\xFE\x04\x05\x06\xFD";
        assert_eq!(encoded(ImageFormat::Ppm, &frame), expected);
    }

    #[test]
    fn a_bmp_is_24_bit_uncompressed_and_bottom_up() {
        let bytes = encoded(ImageFormat::Bmp, &frame(1, 2, &[RED, GREEN]));
        // File header, then BITMAPINFOHEADER; rows of blue, green, red, padded to four bytes.
        let mut expected = Vec::new();
        expected.extend(b"BM");
        expected.extend(62_u32.to_le_bytes());
        expected.extend([0; 4]);
        expected.extend(54_u32.to_le_bytes());
        expected.extend(40_u32.to_le_bytes());
        expected.extend(1_u32.to_le_bytes());
        expected.extend(2_i32.to_le_bytes());
        expected.extend(1_u16.to_le_bytes());
        expected.extend(24_u16.to_le_bytes());
        expected.extend(0_u32.to_le_bytes());
        assert_eq!(bytes[..34], expected);
        assert_eq!(bytes[54..], [4, 254, 3, 0, 2, 1, 255, 0]);
    }

    #[test]
    fn a_png_reads_back() {
        let frame = frame(2, 2, &[RED, GREEN, BLUE, RED]);
        let bytes = encoded(ImageFormat::Png, &frame);
        let read = image::load_from_memory(&bytes).expect("a PNG").to_rgb8();
        assert_eq!(read.dimensions(), (2, 2));
        assert_eq!(read.as_raw(), frame.pixels.as_flattened());
    }

    #[test]
    fn impossible_sizes_are_refused_and_the_limit_named() {
        use ImageFormat::{Bmp, Png, Ppm};
        let cases = [
            (Bmp, 1, 1, None),
            (Bmp, 65_535, 4096, None),
            (Bmp, 65_536, 1, Some("65535")),
            (Bmp, 1, u32::MAX, Some("65535")),
            (Bmp, 65_535, 65_535, Some("268435456")),
            (Ppm, 16_384, 16_384, None),
            (Ppm, 65_536, 1, None),
            (Ppm, 16_384, 16_385, Some("268435456")),
            (Ppm, u32::MAX, u32::MAX, Some("268435456")),
            (Png, 65_536, 1, None),
            (Png, 1 << 31, 1, Some("2147483647")),
            (Png, 0, 1, Some("at least one")),
            (Bmp, 1, 0, Some("at least one")),
        ];
        for (format, width, height, limit) in cases {
            let refusal = format.refuses(Size { width, height });
            assert_eq!(refusal.is_some(), limit.is_some(), "{width}x{height}");
            if let (Some(refusal), Some(limit)) = (refusal, limit) {
                assert!(refusal.contains(limit), "{refusal}");
            }
        }
    }

    #[test]
    fn the_extension_says_the_format_in_any_case() {
        let of = |name: &str| ImageFormat::of_path(Path::new(name));
        assert_eq!(of("a.bmp"), Some(ImageFormat::Bmp));
        assert_eq!(of("b/a.x.PpM"), Some(ImageFormat::Ppm));
        assert_eq!(of("a.PNG"), Some(ImageFormat::Png));
        assert_eq!([of("bmp"), of("a.jpg"), of(".bmp"), of("")], [None; 4]);
    }

    #[test]
    fn an_unknown_extension_is_refused_with_the_known_ones() {
        let directory = tempfile::tempdir().expect("a directory for a test");
        let path = directory.path().join("a.gif");
        let error = save(&frame(1, 1, &[RED]), &path).expect_err("unknown");
        assert!(
            error
                .to_string()
                .ends_with("a.gif: pictures end in .bmp, .ppm or .png")
        );
        assert!(!path.exists());
    }
}
