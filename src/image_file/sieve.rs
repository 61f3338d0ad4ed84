//! Filters out of picture files what their pixels do not need: profiles, comments, thumbnails and
//! the like can have any size, and decoders would keep them in memory.

use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};

/// The number of bytes passed on at once.
const PIECE: u64 = 1 << 16;

/// The maximum number of bytes per pixel of a JPEG. Noise at the best quality, without subsampling,
/// takes fewer than five.
const JPEG_BYTES: u64 = 8;

/// The bytes that a JPEG may have in addition, for tables and for the overhead of small pictures.
const JPEG_TABLES: u64 = 1 << 20;

/// The first line of a Radiance HDR, as the decoder expects it.
const HDR: &[u8] = b"#?RADIANCE\n";

/// The longest first line of a Radiance HDR, in bytes.
const HDR_LONGEST: u64 = 256;

/// The chunks of a PNG that define its pixels.
const PNG_CHUNKS: [&[u8; 4]; 5] = [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"];

/// The length in bytes of the longest of them apart from the pixels: a palette.
const PNG_LONGEST: u32 = 3 * 256;

/// A reader of a file without what its pixels do not need. Cannot seek.
pub(super) struct Sieve<R> {
    source: BufReader<R>,
    format: Format,
    /// The bytes to pass on next, from `at` on.
    piece: Vec<u8>,
    at: usize,
}

enum Format {
    Png {
        /// Whether the signature has been passed on.
        is_begun: bool,
        /// The bytes of the current chunk that remain to be passed on.
        left: u64,
    },
    Jpeg(Jpeg),
    Hdr {
        /// Whether the first line has been passed on.
        is_begun: bool,
    },
}

#[derive(Default)]
struct Jpeg {
    /// The number of bytes passed on.
    passed: u64,
    /// The number of pixels, 0 until known.
    pixels: u64,
    /// Whether a JFIF and an Adobe segment have been passed on; the latter has the colour encoding.
    applications: [bool; 2],
    is_over: bool,
}

impl<R: Read + Seek> Sieve<R> {
    pub(super) fn png(source: R) -> Self {
        Self::new(
            source,
            Format::Png {
                is_begun: false,
                left: 0,
            },
        )
    }

    pub(super) fn jpeg(source: R) -> Self {
        Self::new(source, Format::Jpeg(Jpeg::default()))
    }

    /// A Radiance HDR, whichever program is named in its first line.
    pub(super) fn hdr(source: R) -> Self {
        Self::new(source, Format::Hdr { is_begun: false })
    }

    fn new(source: R, format: Format) -> Self {
        Self {
            source: BufReader::new(source),
            format,
            piece: Vec::new(),
            at: 0,
        }
    }
}

impl<R: Read + Seek> Read for Sieve<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.at == self.piece.len() {
            self.piece.clear();
            self.at = 0;
            match &mut self.format {
                Format::Png { is_begun, left } => {
                    png(&mut self.source, is_begun, left, &mut self.piece)?;
                }
                Format::Jpeg(jpeg) => jpeg.next(&mut self.source, &mut self.piece)?,
                Format::Hdr { is_begun } => hdr(&mut self.source, is_begun, &mut self.piece)?,
            }
        }
        let mut rest = &self.piece[self.at..];
        let read = rest.read(out)?;
        self.at += read;
        Ok(read)
    }
}

impl<R> Seek for Sieve<R> {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

/// Appends up to `bytes` bytes of the source to `piece`. Returns their number.
fn take(source: &mut impl Read, bytes: u64, piece: &mut Vec<u8>) -> io::Result<u64> {
    source
        .take(bytes)
        .read_to_end(piece)
        .map(|read| read as u64)
}

/// Skips `bytes` bytes of a file, which may have fewer.
fn skip(source: &mut BufReader<impl Read + Seek>, bytes: u64) -> io::Result<()> {
    source.seek_relative(bytes as i64)
}

/// Reads the next piece of a PNG. It is empty at the end.
fn png(
    source: &mut BufReader<impl Read + Seek>,
    is_begun: &mut bool,
    left: &mut u64,
    piece: &mut Vec<u8>,
) -> io::Result<()> {
    if !*is_begun {
        *is_begun = true;
        take(source, 8, piece)?;
        return Ok(());
    }
    while *left == 0 {
        let mut head = Vec::new();
        if take(source, 8, &mut head)? < 8 {
            return Ok(());
        }
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]);
        let kind = [head[4], head[5], head[6], head[7]];
        // A checksum follows the data.
        let whole = u64::from(length) + 4;
        let is_fit = kind == *b"IDAT" || length <= PNG_LONGEST;
        if PNG_CHUNKS.contains(&&kind) && is_fit {
            piece.append(&mut head);
            *left = whole;
        } else {
            skip(source, whole)?;
        }
    }
    *left -= take(source, PIECE.min(*left), piece)?;
    Ok(())
}

/// Reads the next piece of a Radiance HDR. It is empty at the end.
fn hdr(
    source: &mut BufReader<impl Read + Seek>,
    is_begun: &mut bool,
    piece: &mut Vec<u8>,
) -> io::Result<()> {
    if *is_begun {
        take(source, PIECE, piece)?;
        return Ok(());
    }
    *is_begun = true;
    source.take(HDR_LONGEST).read_until(b'\n', piece)?;
    piece.clear();
    piece.extend(HDR);
    Ok(())
}

impl Jpeg {
    /// Reads the next piece. It is empty at the end of the picture.
    fn next(
        &mut self,
        source: &mut BufReader<impl Read + Seek>,
        piece: &mut Vec<u8>,
    ) -> io::Result<()> {
        while piece.is_empty() && !self.is_over {
            self.is_over = source.fill_buf()?.is_empty();
            self.pass(source, piece)?;
        }
        self.passed += piece.len() as u64;
        let most = JPEG_TABLES + JPEG_BYTES * self.pixels;
        if most < self.passed {
            let message =
                format!("it has more than {most} bytes, {JPEG_BYTES} per pixel plus {JPEG_TABLES}");
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        Ok(())
    }

    /// Passes on the data before the next marker or a needed segment, or skips a segment.
    fn pass(
        &mut self,
        source: &mut BufReader<impl Read + Seek>,
        piece: &mut Vec<u8>,
    ) -> io::Result<()> {
        let buffered = source.fill_buf()?;
        let coded = buffered.iter().position(|&byte| byte == 0xFF);
        let coded = coded.unwrap_or(buffered.len());
        if 0 < coded {
            piece.extend_from_slice(&buffered[..coded]);
            source.consume(coded);
            return Ok(());
        }
        if take(source, 2, piece)? < 2 {
            return Ok(());
        }
        let marker = piece[1];
        match marker {
            // A fill byte: the marker may begin at the second one.
            0xFF => {
                piece.pop();
                return source.seek_relative(-1);
            }
            // An escaped byte of the pixels, or a marker without a segment.
            0x00 | 0x01 | 0xD0..=0xD8 => return Ok(()),
            0xD9 => {
                self.is_over = true;
                return Ok(());
            }
            _ => {}
        }
        if take(source, 2, piece)? < 2 {
            return Ok(());
        }
        let length = u64::from(u16::from_be_bytes([piece[2], piece[3]])).saturating_sub(2);
        let is_needed = match marker {
            0xE0 => !std::mem::replace(&mut self.applications[0], true),
            0xEE => !std::mem::replace(&mut self.applications[1], true),
            0xE1..=0xEF | 0xFE => false,
            _ => true,
        };
        if !is_needed {
            piece.clear();
            return skip(source, length);
        }
        take(source, length, piece)?;
        // A frame header: precision, height and width. Three markers in its range are not frames.
        if let (0xC0..=0xCF, [_, _, _, _, _, h1, h0, w1, w0, ..]) = (marker, &piece[..])
            && !matches!(marker, 0xC4 | 0xC8 | 0xCC)
        {
            let side = |bytes: [u8; 2]| u64::from(u16::from_be_bytes(bytes));
            self.pixels = side([*h1, *h0]) * side([*w1, *w0]);
        }
        Ok(())
    }
}
