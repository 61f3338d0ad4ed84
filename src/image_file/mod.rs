//! Picture files: frames written to them, textures read from them. Knows nothing of scenes but
//! pictures and their sizes.

mod read;
mod sieve;
mod write;

use std::path::Path;

use crate::render::Frames;
use crate::scene::Size;

pub use read::{MAX_TEXTURE_PIXELS, Unreadable, decode};
pub use write::save;

/// The picture formats that are written; they are read too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// 24-bit uncompressed, bottom-up.
    Bmp,
    /// Binary PPM, `P6`.
    Ppm,
    /// PNG, 8 bits a channel.
    Png,
    /// TIFF, 8 bits a channel, uncompressed.
    Tiff,
    /// GIF with a palette of its own: exact up to 256 colours.
    Gif,
    /// JPEG of quality 95, every pixel with its own colour.
    Jpeg,
    /// `OpenEXR`, 32-bit floating-point values.
    Exr,
    /// Radiance HDR, values of 8 bits with a common exponent: none below 0.
    Hdr,
}

/// Each format and the extensions of its files: the first is its name, too.
pub const FORMATS: [(ImageFormat, &[&str]); 8] = [
    (ImageFormat::Bmp, &["bmp"]),
    (ImageFormat::Ppm, &["ppm"]),
    (ImageFormat::Png, &["png"]),
    (ImageFormat::Tiff, &["tiff", "tif"]),
    (ImageFormat::Gif, &["gif"]),
    (ImageFormat::Jpeg, &["jpeg", "jpg"]),
    (ImageFormat::Exr, &["exr"]),
    (ImageFormat::Hdr, &["hdr"]),
];

/// The most pixels a picture may have, of any format. Tracing keeps about forty bytes a pixel:
/// ten gigabytes at this limit.
pub const MAX_PIXELS: u64 = 1 << 28;

/// The longest side of a BMP. The format has 32 bits for it, but readers, the `image` crate's
/// among them, stop at 16.
const MAX_BMP_SIDE: u32 = 65_535;

/// The longest side of formats that have 16 bits for it.
const MAX_SHORT_SIDE: u32 = 65_535;

/// The longest side of a PNG, from its specification.
const MAX_PNG_SIDE: u32 = (1 << 31) - 1;

// A BMP's file size is a 32-bit number. Rows are padded by up to three bytes each.
const _: () = assert!(54 + 3 * MAX_PIXELS + 3 * (MAX_BMP_SIDE as u64) < 1 << 32);

// So are a TIFF's offsets. Its strips are a row at least, each listed in eight bytes.
const _: () = assert!(1024 + 3 * MAX_PIXELS + 8 * MAX_PIXELS / 3 < 1 << 32);

impl ImageFormat {
    /// The format a file name's extension says, in any case.
    pub fn of_path(path: &Path) -> Option<Self> {
        let said = path.extension()?.to_str()?;
        let says = |known: &&str| known.eq_ignore_ascii_case(said);
        let mut formats = FORMATS.into_iter();
        let (format, _) = formats.find(|(_, extensions)| extensions.iter().any(says))?;
        Some(format)
    }

    /// Why a picture of this size can't be written in this format, if so: asked before tracing.
    pub fn refuses(self, size: Size) -> Option<String> {
        let Size { width, height } = size;
        let max_side = match self {
            Self::Bmp => MAX_BMP_SIDE,
            Self::Gif | Self::Jpeg | Self::Hdr => MAX_SHORT_SIDE,
            Self::Png => MAX_PNG_SIDE,
            Self::Ppm | Self::Tiff | Self::Exr => u32::MAX,
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

    /// Which frames a job needs whose picture is written in this format.
    pub fn frames(self) -> Frames {
        match self {
            Self::Exr | Self::Hdr => Frames::LastWithValues,
            Self::Bmp | Self::Ppm | Self::Png | Self::Tiff | Self::Gif | Self::Jpeg => Frames::Last,
        }
    }

    /// Its name: `bmp`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bmp => "bmp",
            Self::Ppm => "ppm",
            Self::Png => "png",
            Self::Tiff => "tiff",
            Self::Gif => "gif",
            Self::Jpeg => "jpeg",
            Self::Exr => "exr",
            Self::Hdr => "hdr",
        }
    }
}

/// The extensions of picture files as words: `.bmp, .ppm or .png`.
pub fn known_extensions() -> String {
    let extensions = FORMATS.iter().flat_map(|(_, extensions)| *extensions);
    let names: Vec<_> = extensions.map(|name| format!(".{name}")).collect();
    match names.split_last() {
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests;
