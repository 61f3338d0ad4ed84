//! Why a picture file cannot be used, and the limits of those that can.

use std::hint;

use scene::Size;

/// The maximum number of pixels of a texture: 8192 × 8192, 192 MiB.
pub const MAX_TEXTURE_PIXELS: u64 = 1 << 26;

/// The memory limit of a decoder in bytes, including its result. No format has more than 16 bytes
/// per pixel, and few pictures have that many.
pub(super) const MAX_MEMORY: u64 = 512 << 20;

/// Why a picture file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// Not a picture, or one of an unknown format.
    #[error("is not in a supported picture format")]
    Unknown,
    /// Uses an unsupported feature of a format.
    #[error("is an unsupported kind of {format}{}", parenthesis(feature))]
    Unsupported {
        /// The name of the format.
        format: &'static str,
        /// The feature; empty if it is not known.
        feature: String,
    },
    /// Truncated or inconsistent, with a description.
    #[error("is not a valid picture: {0}")]
    Broken(String),
    /// Has more than [`MAX_TEXTURE_PIXELS`] pixels.
    #[error("is {width}x{height}: an image has at most {MAX_TEXTURE_PIXELS} pixels (8192x8192)")]
    TooLarge {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Has more pixels than were left for the scene's textures.
    #[error("the scene's textures have too many pixels in total")]
    NoRoom,
    /// Out of memory, or its decoder needs more than [`MAX_MEMORY`].
    #[error("needs more memory than an image may use (512 MiB), or than is available")]
    NoMemory,
}

/// Text in parentheses after a word; nothing if it is empty.
fn parenthesis(text: &str) -> String {
    match text {
        "" => String::new(),
        text => format!(" ({text})"),
    }
}

/// Refuses a picture with more than [`MAX_TEXTURE_PIXELS`], or than `room`.
pub(super) fn check_size(size: Size, room: u64) -> Result<(), Unreadable> {
    let Size { width, height } = size;
    let count = u64::from(width) * u64::from(height);
    if MAX_TEXTURE_PIXELS < count {
        return Err(Unreadable::TooLarge { width, height });
    }
    if room < count {
        return Err(Unreadable::NoRoom);
    }
    Ok(())
}

/// Refuses a picture whose decoder needs so many bytes beside those of two copies in eight bits, if there
/// is no such room. An allocation that fails in a decoder would end the process.
pub(super) fn check_room(size: Size, decoder: u64) -> Result<(), Unreadable> {
    let copies = 2 * size_of::<[u8; 3]>() * size.pixels();
    let bytes = usize::try_from(decoder)
        .ok()
        .and_then(|bytes| bytes.checked_add(copies));
    let mut trial = Vec::<u8>::new();
    let room = bytes.and_then(|bytes| trial.try_reserve_exact(bytes).ok());
    // An allocation that nothing uses may be left out.
    hint::black_box(&trial);
    room.ok_or(Unreadable::NoMemory)
}

/// The error that a feature of a format is not supported; it is empty if it is not known.
pub(super) fn unsupported(format: &'static str, feature: &str) -> Unreadable {
    Unreadable::Unsupported {
        format,
        feature: feature.to_owned(),
    }
}
