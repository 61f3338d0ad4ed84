//! Animations whose pictures are shown for different times, such as recorded screens.

use std::io::{self, Write};

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame as GifFrame, RgbaImage};

use render::Frame;
use scene::Size;

/// The speed of the search for palettes, 1 to 30: slow, because each palette is looked at for long.
const SPEED: i32 = 3;

/// Writes pictures of one size, each with the hundredths of a second for which it is shown, as a GIF
/// that begins again at its end.
pub fn write_animation<'f>(
    frames: impl Iterator<Item = (&'f Frame, u32)>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut encoder = GifEncoder::new_with_speed(out, SPEED);
    let begun = encoder.set_repeat(Repeat::Infinite);
    begun.map_err(io::Error::other)?;
    let mut size = None;
    for (frame, hundredths) in frames {
        if *size.get_or_insert(frame.size) != frame.size {
            let reason = "the pictures of an animation are of one size";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        let Size { width, height } = frame.size;
        let opaque = |&[red, green, blue]: &[u8; 3]| [red, green, blue, 255];
        let pixels = frame.pixels.iter().flat_map(opaque).collect();
        let picture = RgbaImage::from_raw(width, height, pixels)
            .ok_or_else(|| io::Error::other("there are not as many pixels"))?;
        let delay = Delay::from_numer_denom_ms(10 * hundredths, 1);
        let frame = GifFrame::from_parts(picture, 0, 0, delay);
        encoder.encode_frame(frame).map_err(io::Error::other)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;

    use super::*;

    /// A picture of one row of greys.
    fn row(greys: &[u8]) -> Frame {
        let size = Size {
            width: greys.len() as u32,
            height: 1,
        };
        Frame::drawn(size, greys.iter().map(|&grey| [grey; 3]).collect())
    }

    #[test]
    fn every_picture_is_shown_for_its_time() {
        let (first, second) = (row(&[0, 50, 100]), row(&[0, 200, 100]));
        let frames = [(&first, 25), (&second, 30)];
        let mut bytes = Vec::new();
        write_animation(frames.into_iter(), &mut bytes).expect("a GIF");
        let decoder = GifDecoder::new(io::Cursor::new(bytes)).expect("a GIF");
        let shown: Vec<_> = decoder
            .into_frames()
            .map(|frame| {
                let frame = frame.expect("a picture");
                let (delay, _) = frame.delay().numer_denom_ms();
                let greys = frame.buffer().pixels().map(|pixel| pixel[0]);
                (greys.collect::<Vec<_>>(), delay)
            })
            .collect();
        let expected = [(vec![0, 50, 100], 250), (vec![0, 200, 100], 300)];
        assert_eq!(shown, expected);
    }

    #[test]
    fn pictures_of_two_sizes_are_refused() {
        let (small, large) = (row(&[1]), row(&[1, 2]));
        let frames = [(&small, 1), (&large, 1)];
        let failed = write_animation(frames.into_iter(), &mut Vec::new());
        assert!(failed.is_err());
    }
}
