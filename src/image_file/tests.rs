mod features;

use std::io::{self, Cursor, Write};

use super::*;
use render::Frame;
use scene::Image;

/// A finished frame with the given pixels.
fn frame(width: u32, height: u32, pixels: &[[u8; 3]]) -> Frame {
    Frame {
        values: pixels.iter().map(|pixel| pixel.map(share)).collect(),
        ..Frame::drawn(Size { width, height }, pixels.to_vec())
    }
}

fn share(level: u8) -> f32 {
    f32::from(level) / 255.0
}

const RED: [u8; 3] = [255, 1, 2];
const GREEN: [u8; 3] = [3, 254, 4];
const BLUE: [u8; 3] = [5, 6, 253];

fn encoded(format: ImageFormat, frame: &Frame) -> Vec<u8> {
    let mut bytes = Vec::new();
    format
        .write(Picture::of(frame), &mut bytes)
        .expect("memory takes all");
    bytes
}

fn decode(bytes: &[u8]) -> Result<Image, Unreadable> {
    super::decode(&mut Cursor::new(bytes), u64::MAX)
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

/// A picture of smooth colours, no two pixels alike except in a black quarter.
fn gradient() -> Frame {
    let (width, height) = (48, 32);
    let pixels: Vec<_> = (0..height)
        .flat_map(|y| {
            (0..width).map(move |x| match (x < 24, y < 16) {
                (true, true) => [0; 3],
                _ => [5 * x as u8, 7 * y as u8, (3 * x + 2 * y) as u8],
            })
        })
        .collect();
    frame(width, height, &pixels)
}

fn decoded(format: ImageFormat, frame: &Frame) -> Image {
    let bytes = encoded(format, frame);
    assert_eq!(bytes, encoded(format, frame), "{format:?}: the same bytes");
    decode(&bytes).unwrap_or_else(|error| panic!("{format:?}: {error}"))
}

#[test]
fn lossless_formats_round_trip() {
    use ImageFormat::{Exr, Gif, Hdr, Jpeg};
    let exact = FORMATS.map(|(format, _)| format).into_iter();
    let exact = exact.filter(|format| !matches!(format, Jpeg | Exr | Hdr));
    let few = frame(3, 2, &[RED, GREEN, BLUE, RED, RED, GREEN]);
    for format in exact.clone() {
        let expected = Image::new(few.size, few.pixels.clone());
        assert_eq!(Some(decoded(format, &few)), expected, "{format:?}");
    }
    let many = gradient();
    for format in exact.filter(|format| *format != Gif) {
        let expected = Image::new(many.size, many.pixels.clone());
        assert_eq!(Some(decoded(format, &many)), expected, "{format:?}");
    }
}

/// A frame with values that no 8-bit picture can hold.
fn bright() -> Frame {
    Frame {
        values: vec![
            [0.0, 0.5, 1e-4],
            [3.25, 1e6, 17.0],
            [-1.0, f32::INFINITY, 0.25],
        ],
        ..frame(3, 1, &[[0; 3]; 3])
    }
}

#[test]
fn floating_point_formats_store_the_values_and_not_the_pixels() {
    let exr = encoded(ImageFormat::Exr, &bright());
    assert_eq!(values_of_exr(&exr), bright().values);
    let hdr = encoded(ImageFormat::Hdr, &bright());
    let hdr = image::load_from_memory(&hdr).expect("it is a picture");
    let stored = [[0.0, 0.5, 1e-4], [3.25, 1e6, 17.0], [0.0, 1e38, 0.25]];
    for (pixel, expected) in hdr.into_rgb32f().into_raw().chunks(3).zip(stored) {
        // Eight bits per channel, with the exponent of the greatest.
        let greatest = expected.into_iter().fold(0.0, f32::max);
        for (found, wanted) in pixel.iter().zip(expected) {
            assert!(
                (found - wanted).abs() <= greatest / 128.0,
                "{pixel:?}, {expected:?}"
            );
        }
    }
}

/// The values of an EXR of one line.
fn values_of_exr(bytes: &[u8]) -> Vec<[f32; 3]> {
    use ::exr::prelude::*;
    let read = read().no_deep_data().largest_resolution_level();
    let read = read.rgb_channels(
        |size, _| vec![[0.0; 3]; size.width()],
        |line: &mut Vec<[f32; 3]>, at, (r, g, b): (f32, f32, f32)| line[at.x()] = [r, g, b],
    );
    let read = read.first_valid_layer().all_attributes();
    let image = read.from_buffered(Cursor::new(bytes)).expect("an EXR");
    image.layer_data.channel_data.pixels
}

#[test]
fn a_frame_without_values_is_refused() {
    let frame = Frame {
        values: Vec::new(),
        ..gradient()
    };
    for format in [ImageFormat::Exr, ImageFormat::Hdr] {
        assert!(format.write(Picture::of(&frame), &mut Vec::new()).is_err());
    }
}

/// The difference between two pictures: the mean and the maximum over all channels.
fn difference(one: &Image, other: &Frame) -> (f64, u8) {
    let pixels = one.pixels().as_flattened().iter();
    let differences: Vec<_> = pixels
        .zip(other.pixels.as_flattened())
        .map(|(one, other)| one.abs_diff(*other))
        .collect();
    let sum: f64 = differences.iter().copied().map(f64::from).sum();
    let most = differences.iter().copied().max().unwrap_or_default();
    (sum / differences.len() as f64, most)
}

#[test]
fn lossy_formats_round_trip_approximately() {
    let frame = gradient();
    for (format, mean, most) in [(ImageFormat::Jpeg, 2.0, 24), (ImageFormat::Gif, 8.0, 48)] {
        let read = decoded(format, &frame);
        assert_eq!(read.size(), frame.size);
        let (found, worst) = difference(&read, &frame);
        assert!(
            found <= mean && worst <= most,
            "{format:?}: {found}, {worst}"
        );
    }
}

#[test]
fn every_format_reports_a_full_disk() {
    struct Full(usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let taken = bytes.len().min(self.0);
            self.0 -= taken;
            match taken {
                0 => Err(io::ErrorKind::StorageFull.into()),
                _ => Ok(taken),
            }
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    let frame = gradient();
    for (format, _) in FORMATS {
        for room in [0, 10, 300] {
            let error = format
                .write(Picture::of(&frame), &mut Full(room))
                .expect_err("full");
            assert_eq!(
                error.kind(),
                io::ErrorKind::StorageFull,
                "{format:?} {room}"
            );
        }
    }
}

#[test]
fn truncated_pictures_are_refused() {
    for (format, _) in FORMATS {
        let bytes = encoded(format, &gradient());
        for length in [0, 1, 10, bytes.len() / 2] {
            assert!(decode(&bytes[..length]).is_err(), "{format:?} {length}");
        }
    }
}

#[test]
fn corrupt_pictures_do_no_harm() {
    for (format, _) in FORMATS {
        let bytes = encoded(format, &gradient());
        for at in 0..bytes.len().min(700) {
            for value in [0, 1, 0x7F, 0xFF] {
                let mut corrupt = bytes.clone();
                corrupt[at] = value;
                // Whatever the result: no panic, no endless loop.
                let _ = decode(&corrupt);
            }
        }
    }
    for bytes in [
        &b""[..],
        b"halflight",
        b"P6\n1 1\n",
        b"\x89PNG\r\n\x1a\n",
        b"GIF89a",
    ] {
        assert!(decode(bytes).is_err(), "{bytes:?}");
    }
}

#[test]
fn headers_that_claim_too_much_are_refused_before_memory_is_allocated() {
    let bmp = |width: u32, height: u32| {
        let mut bytes = encoded(ImageFormat::Bmp, &frame(1, 1, &[RED]));
        bytes[18..22].copy_from_slice(&width.to_le_bytes());
        bytes[22..26].copy_from_slice(&height.to_le_bytes());
        bytes
    };
    for bytes in [
        bmp(65_535, 65_535),
        bmp(8193, 8192),
        b"P6\n8193 8192\n255\n".to_vec(),
        b"P6\n100000 100000\n65535\n".to_vec(),
    ] {
        let refused = decode(&bytes).expect_err("too large");
        assert!(matches!(refused, Unreadable::TooLarge { .. }), "{refused}");
        assert!(refused.to_string().contains("8192x8192"));
    }
}

#[test]
fn a_picture_with_more_pixels_than_are_left_is_refused() {
    let bytes = encoded(ImageFormat::Png, &gradient());
    let refused = super::decode(&mut Cursor::new(&bytes), 48 * 32 - 1).expect_err("one too many");
    assert!(matches!(refused, Unreadable::NoRoom), "{refused}");
    assert!(super::decode(&mut Cursor::new(&bytes), 48 * 32).is_ok());
}

#[test]
fn pixels_are_converted_to_8_bit_rgb() {
    for (file, pixel) in [
        (&b"P5\n1 1\n255\n\x07"[..], [7, 7, 7]),
        (b"P6\n1 1\n65535\n\xFF\xFF\x80\x80\x00\x00", [255, 128, 0]),
        (
            b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n\x01\x02\x03\x00",
            [1, 2, 3],
        ),
    ] {
        let image = decode(file).expect("a picture");
        assert_eq!(image.pixels(), [pixel]);
    }
}

#[test]
fn impossible_sizes_are_refused_with_the_limit() {
    use ImageFormat::{Bmp, Gif, Jpeg, Png, Ppm, Tiff};
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
        (Tiff, 65_536, 4096, None),
        (Tiff, 65_537, 4096, Some("268435456")),
        (Gif, 65_535, 1, None),
        (Gif, 65_536, 1, Some("a GIF is at most 65535")),
        (Jpeg, 1, 65_536, Some("a JPEG is at most 65535")),
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
fn the_extension_determines_the_format_in_any_case() {
    let of = |name: &str| ImageFormat::of_path(Path::new(name));
    assert_eq!(of("a.bmp"), Some(ImageFormat::Bmp));
    assert_eq!(of("b/a.x.PpM"), Some(ImageFormat::Ppm));
    assert_eq!(of("a.PNG"), Some(ImageFormat::Png));
    assert_eq!(of("a.tif"), of("a.tiff"));
    assert_eq!(of("a.JPG"), of("a.jpeg"));
    assert_eq!([of("bmp"), of("a.jp2"), of(".bmp"), of("")], [None; 4]);
}

#[test]
fn an_unknown_extension_is_refused_with_the_known_ones() {
    let directory = tempfile::tempdir().expect("a directory for a test");
    let path = directory.path().join("a.webp");
    let saved: io::Result<_> = save(Picture::of(&frame(1, 1, &[RED])), &path, &|| Ok(()));
    let error = saved.expect_err("unknown").to_string();
    assert!(error.starts_with("picture files end in .bmp, .ppm, .png, .tiff"));
    assert!(!path.exists());
}

#[test]
fn a_picture_is_whole_whichever_call_fails() {
    use file::faults::{Fault, during};
    use rustix::io::Errno;
    let directory = tempfile::tempdir().expect("a directory for a test");
    let path = directory.path().join("a.png");
    let (old, new) = (frame(1, 1, &[RED]), frame(2, 1, &[RED, RED]));
    let write =
        |frame: &Frame| -> io::Result<()> { save(Picture::of(frame), &path, &|| Ok(())).map(drop) };
    let bytes = |frame: &Frame| {
        write(frame).expect("no errors or warnings");
        std::fs::read(&path).expect("a file")
    };
    let (whole, before) = (bytes(&new), bytes(&old));
    for fault in [Errno::NOSPC, Errno::INTR].map(Fault::Once) {
        let last = (0..100).find(|&at| {
            bytes(&old);
            let (outcome, calls) = during(fault, at, || write(&new));
            let expected = if outcome.is_ok() { &whole } else { &before };
            assert!(
                &std::fs::read(&path).expect("a file") == expected,
                "{calls:?}"
            );
            assert!(outcome.is_ok() || !fault.is_harmless(), "{calls:?}");
            assert_eq!(directory.path().read_dir().expect("a folder").count(), 1);
            calls.hit.is_none()
        });
        assert!(last.is_some_and(|last| 0 < last), "each was hit");
    }
}

/// A file that counts the bytes read from it.
struct Counted<'a> {
    file: Cursor<&'a [u8]>,
    read: usize,
}

impl io::Read for Counted<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(out)?;
        self.read += read;
        Ok(read)
    }
}

impl io::Seek for Counted<'_> {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// A picture with bytes inserted after its first `head` bytes.
fn inserted(format: ImageFormat, head: usize, more: &[u8]) -> Vec<u8> {
    let bytes = encoded(format, &gradient());
    [&bytes[..head], more, &bytes[head..]].concat()
}

/// A chunk of a PNG without a valid checksum.
fn chunk(kind: [u8; 4], length: usize) -> Vec<u8> {
    let mut chunk = (length as u32).to_be_bytes().to_vec();
    chunk.extend(kind);
    chunk.resize(chunk.len() + length + 4, 0);
    chunk
}

#[test]
fn data_that_the_pixels_do_not_need_is_not_read() {
    const LENGTH: usize = 1 << 20;
    // Signature and first chunk of a PNG; the first marker of a JPEG.
    let (png, jpeg) = (8 + 25, 2);
    let comments = |marker: u8| {
        let comment = [&[0xFF, marker, 0xFF, 0xFF], &vec![b'c'; 0xFFFD][..]].concat();
        comment.repeat(LENGTH / comment.len())
    };
    for (format, head, more) in [
        (ImageFormat::Png, png, chunk(*b"iCCP", LENGTH)),
        (ImageFormat::Png, png, chunk(*b"tEXt", LENGTH)),
        (ImageFormat::Png, png, chunk(*b"eXIf", LENGTH)),
        (ImageFormat::Jpeg, jpeg, comments(0xFE)),
        (ImageFormat::Jpeg, jpeg, comments(0xE1)),
        (ImageFormat::Jpeg, jpeg, comments(0xE2)),
    ] {
        let bytes = inserted(format, head, &more);
        let file = Cursor::new(&bytes[..]);
        let mut counted = Counted { file, read: 0 };
        let image = super::decode(&mut counted, u64::MAX).expect("a picture");
        assert_eq!(image, decoded(format, &gradient()), "{format:?}");
        let start = &more[..8];
        assert!(counted.read < LENGTH / 4, "{start:?}: {}", counted.read);
    }
}

#[test]
fn a_jpeg_far_too_long_for_its_pixels_is_refused() {
    let bytes = encoded(ImageFormat::Jpeg, &gradient());
    let end = bytes.len() - 2;
    let tables = [0xFF, 0xDB, 0xFF, 0xFF].into_iter().chain(vec![1; 0xFFFD]);
    let tables: Vec<u8> = tables.collect();
    for (head, more) in [(end, vec![1; 2 << 20]), (2, tables.repeat(40))] {
        let refused = decode(&inserted(ImageFormat::Jpeg, head, &more)).expect_err("too long");
        let message = refused.to_string();
        let expected = "is not a valid picture: it has more than 10";
        assert!(message.starts_with(expected), "{message}");
    }
}

#[test]
fn damage_is_reported_without_the_decoders_messages() {
    for (format, name) in [
        (ImageFormat::Png, "PNG"),
        (ImageFormat::Jpeg, "JPEG"),
        (ImageFormat::Bmp, "BMP"),
    ] {
        let bytes = encoded(format, &gradient());
        let damaged = format!("is not a valid picture: its {name} data is damaged");
        let unsupported = format!("is an unsupported kind of {name}");
        let mut found = 0;
        for at in 2..bytes.len().min(300) {
            let mut corrupt = bytes.clone();
            corrupt[at] ^= 0x55;
            let Err(error) = decode(&corrupt) else {
                continue;
            };
            let message = error.to_string();
            found += usize::from(message == damaged);
            let is_known = message == damaged
                || message == unsupported
                || message.ends_with("it is truncated")
                || !matches!(
                    error,
                    Unreadable::Broken(_) | Unreadable::Unsupported { .. }
                );
            assert!(is_known, "{format:?} at {at}: {message}");
        }
        assert!(0 < found, "{format:?}");
    }
}
