//! Picture files: writing frames, reading textures. Of scenes it knows only pictures and their
//! sizes.

mod animation;
mod exr;
mod exr_colours;
mod input;
mod metadata;
mod movie;
mod pattern;
mod picture;
mod read;
mod recorded;
mod sieve;
mod unreadable;
mod write;

use std::path::Path;

use render::Frames;
use scene::Size;

pub use animation::write_animation;
pub use exr::layer_bytes;
pub use input::Input;
pub use metadata::record;
pub use movie::{DEFAULT_RATE, MovieFormat, MovieWriter};
pub use pattern::{NoPattern, Pattern};
pub use picture::Picture;
pub use read::decode;
pub use recorded::{Recorded, in_8_bits};
pub use unreadable::{MAX_TEXTURE_PIXELS, Unreadable};
pub use write::{encode_quickly, save};

pub use scene::MAX_PIXELS;

/// The picture formats that can be written. All of them can also be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// 24-bit uncompressed, bottom-up.
    Bmp,
    /// Binary PPM, `P6`.
    Ppm,
    /// PNG, 8 bits per channel.
    Png,
    /// TIFF, 8 bits per channel, uncompressed.
    Tiff,
    /// GIF with an optimized palette; exact up to 256 colours.
    Gif,
    /// JPEG of quality 95, without chroma subsampling.
    Jpeg,
    /// `OpenEXR`, 32-bit floating-point values.
    Exr,
    /// Radiance HDR: 8 bits per channel with a shared exponent, no negative values.
    Hdr,
}

/// The formats in the order of their declaration, with their file extensions, of which the first is
/// also the format's name.
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

const _: () = {
    let mut at = 0;
    while at < FORMATS.len() {
        assert!(FORMATS[at].0 as usize == at, "the order of declaration");
        at += 1;
    }
};

/// The longest side of a BMP in pixels. The format stores 32 bits, but readers, including that of
/// the `image` crate, accept only 16.
const MAX_BMP_SIDE: u32 = 65_535;

/// The longest side in formats that store it in 16 bits, in pixels.
const MAX_SHORT_SIDE: u32 = 65_535;

/// The longest side of a PNG in pixels, from its specification.
const MAX_PNG_SIDE: u32 = (1 << 31) - 1;

// The file size of a BMP is a 32-bit number. Rows are padded by up to three bytes.
const _: () = assert!(54 + 3 * MAX_PIXELS + 3 * (MAX_BMP_SIDE as u64) < 1 << 32);

// The offsets of a TIFF are 32-bit numbers. Each of its strips has at least one row and takes eight
// bytes in a table.
const _: () = assert!(1024 + 3 * MAX_PIXELS + 8 * MAX_PIXELS / 3 < 1 << 32);

impl ImageFormat {
    /// The format for a file name's extension, case-insensitively.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        let is_it = |known: &&str| known.eq_ignore_ascii_case(extension);
        let mut formats = FORMATS.into_iter();
        let (format, _) = formats.find(|(_, extensions)| extensions.iter().any(is_it))?;
        Some(format)
    }

    /// Returns why a picture of this size cannot be written in this format, or `None` if it can.
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
                "{width}x{height}: width and height must be at least one pixel"
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

    /// The kind of frames that a render must produce for this format.
    pub fn frames(self) -> Frames {
        match self {
            Self::Exr | Self::Hdr => Frames::LastWithValues,
            Self::Bmp | Self::Ppm | Self::Png | Self::Tiff | Self::Gif | Self::Jpeg => Frames::Last,
        }
    }

    /// Whether its files say what a picture is made from.
    pub fn has_metadata(self) -> bool {
        matches!(self, Self::Png | Self::Exr)
    }

    /// The name in lower case, e.g. `bmp`.
    pub fn name(self) -> &'static str {
        FORMATS[self as usize].1[0]
    }
}

/// The extensions of picture files as a phrase: `.bmp, .ppm or .png`.
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
