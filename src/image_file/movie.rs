//! Files of several pictures: Y4M for other programs, GIF for viewers.

use std::io::{self, Write};
use std::path::Path;

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame as GifFrame, RgbaImage};

use render::Frame;
use scene::Size;

/// The formats of several pictures in one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovieFormat {
    /// YUV4MPEG2, uncompressed, which video encoders read from pipes.
    Y4m,
    /// GIF, with a palette for each picture, that begins again at its end.
    Gif,
}

/// The speed of the search for palettes, 1 to 30. At 10 it takes about as long as a quick picture.
const GIF_SPEED: i32 = 10;

/// The most pictures per second of a GIF: players slow down delays of less than 2 of its hundredths
/// of a second.
const MOST_OF_GIF: u32 = 50;

/// Pictures per second unless another rate is asked for.
pub const DEFAULT_RATE: u32 = 24;

impl MovieFormat {
    /// The format for a file name's extension, case-insensitively.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let is = |name: &str| extension.eq_ignore_ascii_case(name);
        let y4m = is("y4m").then_some(Self::Y4m);
        y4m.or_else(|| is("gif").then_some(Self::Gif))
    }

    /// Why the format cannot have a rate of pictures per second, if so.
    pub fn refuses(self, rate: u32) -> Option<String> {
        let is_too_fast = self == Self::Gif && MOST_OF_GIF < rate;
        is_too_fast.then(|| {
            format!("a .gif has at most {MOST_OF_GIF} frames per second, not {rate}: ask for fewer, or use .y4m")
        })
    }
}

/// Writes pictures of the same size one after the other.
pub struct MovieWriter<'w> {
    size: Size,
    /// Pictures per second.
    rate: u32,
    /// The number of pictures added.
    added: u32,
    out: Encoder<'w>,
}

enum Encoder<'w> {
    Y4m(&'w mut dyn Write),
    Gif(Box<GifEncoder<&'w mut dyn Write>>),
}

impl<'w> MovieWriter<'w> {
    /// Begins a file of pictures of this size, shown at this rate per second, which the format must
    /// not [refuse](MovieFormat::refuses).
    pub fn new(
        format: MovieFormat,
        size: Size,
        rate: u32,
        out: &'w mut dyn Write,
    ) -> io::Result<Self> {
        let out = match format {
            MovieFormat::Y4m => {
                let Size { width, height } = size;
                // 4:4:4, because other programs reduce colours better than they invent them.
                writeln!(
                    out,
                    "YUV4MPEG2 W{width} H{height} F{rate}:1 Ip A1:1 C444 XCOLORRANGE=LIMITED"
                )?;
                Encoder::Y4m(out)
            }
            MovieFormat::Gif => {
                let mut encoder = GifEncoder::new_with_speed(out, GIF_SPEED);
                let begun = encoder.set_repeat(Repeat::Infinite);
                begun.map_err(io::Error::other)?;
                Encoder::Gif(Box::new(encoder))
            }
        };
        Ok(Self {
            size,
            rate,
            added: 0,
            out,
        })
    }

    /// Adds a picture. Fails if it has another size.
    pub fn add(&mut self, frame: &Frame) -> io::Result<()> {
        if frame.size != self.size {
            let [now, before] =
                [frame.size, self.size].map(|Size { width, height }| format!("{width}x{height}"));
            let reason = format!("the picture is {now}, those before are {before}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        let delay = delay(self.added, self.rate);
        self.added += 1;
        match &mut self.out {
            Encoder::Y4m(out) => write_y4m(&frame.pixels, out),
            Encoder::Gif(encoder) => {
                let Size { width, height } = self.size;
                let opaque = |&[red, green, blue]: &[u8; 3]| [red, green, blue, 255];
                let pixels = frame.pixels.iter().flat_map(opaque).collect();
                let picture = RgbaImage::from_raw(width, height, pixels)
                    .ok_or_else(|| io::Error::other("there are not as many pixels"))?;
                let delay = Delay::from_numer_denom_ms(10 * delay, 1);
                let frame = GifFrame::from_parts(picture, 0, 0, delay);
                encoder.encode_frame(frame).map_err(io::Error::other)
            }
        }
    }

    /// Passes on what is buffered.
    pub fn finish(self) -> io::Result<()> {
        match self.out {
            Encoder::Y4m(out) => out.flush(),
            // It writes the end of the file when it is dropped.
            Encoder::Gif(_) => Ok(()),
        }
    }
}

/// How long a picture of a GIF is shown, in hundredths of a second: what rounding adds to one picture is
/// taken from another, so that all keep the rate.
fn delay(number: u32, rate: u32) -> u32 {
    let end_of = |before: u32| (200 * u64::from(before) + u64::from(rate)) / (2 * u64::from(rate));
    (end_of(number + 1) - end_of(number)) as u32
}

/// Writes a picture of Y4M: its planes of luma, blue and red difference.
fn write_y4m(pixels: &[[u8; 3]], out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"FRAME\n")?;
    let colours: Vec<_> = pixels.iter().map(|&pixel| luma_and_chroma(pixel)).collect();
    for channel in 0..3 {
        let plane: Vec<u8> = colours.iter().map(|colour| colour[channel]).collect();
        out.write_all(&plane)?;
    }
    Ok(())
}

/// Y′CbCr by ITU-R BT.601 in its limited range, which programs assume of a Y4M: black is 16 and white
/// 235, chroma is 16 to 240. The coefficients are those of full range, 0.299, 0.587, 0.114 and halves
/// over 0.886 and 0.701, scaled to that range.
fn luma_and_chroma(pixel: [u8; 3]) -> [u8; 3] {
    let [red, green, blue] = pixel.map(|byte| f64::from(byte) / 255.0);
    let luma = 0.299 * red + 0.587 * green + 0.114 * blue;
    let chroma = |channel: f64, most: f64| 128.0 + 112.0 * (channel - luma) / most;
    [16.0 + 219.0 * luma, chroma(blue, 0.886), chroma(red, 0.701)].map(|value| (value + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;

    use super::*;

    const SIZE: Size = Size {
        width: 2,
        height: 1,
    };

    /// From the tables of colour bars in BT.601.
    #[test]
    fn colours_are_those_of_the_standard() {
        for (rgb, expected) in [
            ([0, 0, 0], [16, 128, 128]),
            ([255, 255, 255], [235, 128, 128]),
            ([255, 0, 0], [81, 90, 240]),
            ([0, 255, 0], [145, 54, 34]),
            ([0, 0, 255], [41, 240, 110]),
            ([255, 255, 0], [210, 16, 146]),
        ] {
            assert_eq!(luma_and_chroma(rgb), expected, "{rgb:?}");
        }
    }

    #[test]
    fn a_y4m_has_a_header_and_the_planes_of_each_picture() {
        let mut bytes = Vec::new();
        let mut movie =
            MovieWriter::new(MovieFormat::Y4m, SIZE, 25, &mut bytes).expect("it is written");
        for pixels in [[[0; 3], [255; 3]], [[255, 0, 0], [0, 0, 255]]] {
            let frame = Frame::drawn(SIZE, pixels.to_vec());
            movie.add(&frame).expect("it is written");
        }
        let wide = Size {
            width: 3,
            height: 1,
        };
        let refused = movie.add(&Frame::drawn(wide, vec![[0; 3]; 3]));
        let reason = refused.expect_err("it has another size").to_string();
        assert_eq!(reason, "the picture is 3x1, those before are 2x1");
        movie.finish().expect("it is written");
        let expected = [
            &b"YUV4MPEG2 W2 H1 F25:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n"[..],
            b"FRAME\n\x10\xeb\x80\x80\x80\x80FRAME\n\x51\x29\x5a\xf0\xf0\x6e",
        ];
        assert_eq!(bytes, expected.concat());
    }

    #[test]
    fn pictures_of_a_gif_keep_the_rate() {
        for rate in 1..=MOST_OF_GIF {
            let delays: Vec<_> = (0..10 * rate).map(|number| delay(number, rate)).collect();
            assert_eq!(delays.iter().sum::<u32>(), 1000, "{rate}");
            assert!(delays.iter().all(|delay| 2 <= *delay), "{rate}");
            let ends = [delays.iter().min(), delays.iter().max()].map(|end| *end.expect("some"));
            assert!(ends[1] - ends[0] <= 1, "{rate}: {ends:?}");
        }
        assert_eq!([0, 1, 2].map(|number| delay(number, 12)), [8, 9, 8]);
        assert_eq!(MovieFormat::Y4m.refuses(100), None);
        assert_eq!(MovieFormat::Gif.refuses(50), None);
        let reason = MovieFormat::Gif.refuses(60).expect("it is too fast");
        assert_eq!(
            reason,
            "a .gif has at most 50 frames per second, not 60: ask for fewer, or use .y4m"
        );
    }

    /// At 30 per second, every third picture is shown longer.
    #[test]
    fn delays_are_written() {
        let mut bytes = Vec::new();
        let mut movie =
            MovieWriter::new(MovieFormat::Gif, SIZE, 30, &mut bytes).expect("it is written");
        for _ in 0..3 {
            let frame = Frame::drawn(SIZE, vec![[0; 3]; 2]);
            movie.add(&frame).expect("it is written");
        }
        movie.finish().expect("it is written");
        let decoder = GifDecoder::new(io::Cursor::new(&bytes)).expect("it is a GIF");
        let frames = decoder.into_frames().collect_frames().expect("they decode");
        let delays = frames.iter().map(|frame| frame.delay().numer_denom_ms().0);
        assert_eq!(delays.collect::<Vec<_>>(), [30, 40, 30]);
    }

    #[test]
    fn a_gif_shows_all_pictures_again_and_again() {
        let mut bytes = Vec::new();
        let mut movie =
            MovieWriter::new(MovieFormat::Gif, SIZE, 20, &mut bytes).expect("it is written");
        let pictures = [[[0; 3], [255; 3]], [[255, 0, 0], [0, 0, 255]]];
        for pixels in pictures {
            let frame = Frame::drawn(SIZE, pixels.to_vec());
            movie.add(&frame).expect("it is written");
        }
        movie.finish().expect("it is written");
        let decoder = GifDecoder::new(io::Cursor::new(&bytes)).expect("it is a GIF");
        let frames = decoder.into_frames().collect_frames().expect("they decode");
        for (frame, pixels) in frames.iter().zip(pictures) {
            assert_eq!(frame.delay().numer_denom_ms(), (50, 1));
            let decoded = frame
                .buffer()
                .pixels()
                .map(|pixel| [pixel[0], pixel[1], pixel[2]]);
            assert_eq!(decoded.collect::<Vec<_>>(), pixels);
        }
        assert_eq!(frames.len(), 2);
        assert!(bytes.windows(11).any(|words| words == b"NETSCAPE2.0"));
    }
}
