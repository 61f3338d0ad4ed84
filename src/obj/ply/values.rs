//! The values behind the header of a `.ply` file, as text or as numbers.

use super::super::lines::{Fault, Lines, Place, Spot, Word};
use super::elements::{Column, Element, Scalar};
use text::leading_number;

/// Why a row cannot be read.
pub(super) enum Stop {
    /// What is wrong with it; the next one can be read.
    Row(Fault),
    /// What is wrong with the whole file.
    File(Fault),
    /// The file ends in it.
    End,
}

/// Rows of values in order.
pub(super) trait Values<'t> {
    /// Goes to the next row.
    fn begin(&mut self) -> Result<(), Stop>;

    /// The next value of the row.
    fn next(&mut self, scalar: Scalar) -> Result<f64, Stop>;

    /// Skips so many values of the row.
    fn skip(&mut self, scalar: Scalar, count: u64) -> Result<(), Stop>;

    /// Fails if the row has more values than have been read.
    fn end(&self) -> Result<(), Stop>;

    /// The value read last, or the place where one is missing.
    fn last(&self) -> Word<'t>;

    /// The number of bytes that are left.
    fn rest(&self) -> usize;

    /// The place behind the last value.
    fn end_of_file(&self) -> Word<'t>;

    /// Skips the next row.
    fn skip_row(&mut self, element: &Element) -> Result<(), Stop> {
        self.begin()?;
        for column in &element.columns {
            match *column {
                Column::One(scalar, _) => self.skip(scalar, 1)?,
                Column::List { count, item, .. } => {
                    let count = self.next(count)?;
                    self.skip(item, count as u64)?;
                }
            }
        }
        Ok(())
    }
}

fn empty<'t>(place: Place) -> Word<'t> {
    Word {
        text: b"",
        place: Spot::from(place),
    }
}

/// Rows that are lines.
pub(super) struct Text<'t> {
    lines: Lines<'t>,
    /// What follows in the line.
    rest: &'t [u8],
    /// Where that is.
    at: Place,
    last: Word<'t>,
}

impl<'t> Text<'t> {
    pub(super) fn new(bytes: &'t [u8], start: Place) -> Self {
        let last = empty(start);
        Self {
            lines: Lines::new(bytes, start),
            rest: b"",
            at: start,
            last,
        }
    }

    /// Goes on by so many bytes.
    #[inline(always)]
    fn advance(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes..];
        self.at.at += bytes;
    }

    #[inline(always)]
    fn skip_blanks(&mut self) {
        let blanks = self
            .rest
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace());
        let blanks = blanks.count();
        self.advance(blanks);
    }

    /// Takes the next so many bytes of the line as the last value.
    #[inline(always)]
    fn take(&mut self, length: usize) {
        self.last = Word {
            text: &self.rest[..length],
            place: Spot::from(self.at),
        };
        self.advance(length);
    }

    /// Takes the next word.
    fn word(&mut self) -> Result<Word<'t>, Stop> {
        let is_blank = |byte: &u8| byte.is_ascii_whitespace();
        let length = self.rest.iter().position(is_blank);
        self.take(length.unwrap_or(self.rest.len()));
        if self.last.text.is_empty() {
            let message = "a value is missing";
            return Err(Stop::Row(Fault::new(self.last, message, "a number")));
        }
        Ok(self.last)
    }
}

impl<'t> Values<'t> for Text<'t> {
    fn begin(&mut self) -> Result<(), Stop> {
        loop {
            let (start, text) = self.lines.next().ok_or(Stop::End)?;
            (self.at, self.rest) = (start, text);
            self.skip_blanks();
            if !self.rest.is_empty() {
                return Ok(());
            }
        }
    }

    #[inline]
    fn next(&mut self, _: Scalar) -> Result<f64, Stop> {
        self.skip_blanks();
        if let Some((value, length)) = leading_number(self.rest)
            && self.rest.get(length).is_none_or(u8::is_ascii_whitespace)
        {
            self.take(length);
            return Ok(value);
        }
        self.word()?.number().map_err(Stop::Row)
    }

    fn skip(&mut self, _: Scalar, count: u64) -> Result<(), Stop> {
        for _ in 0..count {
            self.skip_blanks();
            self.word()?;
        }
        Ok(())
    }

    fn end(&self) -> Result<(), Stop> {
        let rest = self.rest.trim_ascii_start();
        if rest.is_empty() {
            return Ok(());
        }
        let word = Word {
            text: rest,
            place: Spot::from(Place {
                at: self.at.at + self.rest.len() - rest.len(),
                ..self.at
            }),
        };
        let message = "there are more values than properties";
        let fault = Fault::new(word, message, "the end of the line");
        Err(Stop::Row(fault.costing("the rest is ignored")))
    }

    fn last(&self) -> Word<'t> {
        self.last
    }

    fn rest(&self) -> usize {
        self.lines.rest()
    }

    fn end_of_file(&self) -> Word<'t> {
        empty(self.at)
    }

    fn skip_row(&mut self, _: &Element) -> Result<(), Stop> {
        self.begin()?;
        let length = self.rest.len();
        self.advance(length);
        Ok(())
    }
}

/// Rows of numbers without gaps.
pub(super) struct Numbers<'t, const IS_BIG_ENDIAN: bool> {
    rest: &'t [u8],
    /// Where that is.
    at: Place,
    last: Word<'t>,
}

impl<'t, const IS_BIG_ENDIAN: bool> Numbers<'t, IS_BIG_ENDIAN> {
    pub(super) fn new(bytes: &'t [u8], start: Place) -> Self {
        let rest = bytes.get(start.at..).unwrap_or_default();
        Self {
            rest,
            at: start,
            last: empty(start),
        }
    }

    #[inline(always)]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Stop> {
        let (bytes, rest) = self.rest.split_first_chunk::<N>().ok_or(Stop::End)?;
        self.last = Word {
            text: bytes,
            place: Spot::from(self.at),
        };
        self.rest = rest;
        self.at.at += N;
        let mut bytes = *bytes;
        if IS_BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<'t, const IS_BIG_ENDIAN: bool> Values<'t> for Numbers<'t, IS_BIG_ENDIAN> {
    #[inline(always)]
    fn begin(&mut self) -> Result<(), Stop> {
        Ok(())
    }

    #[inline(always)]
    fn next(&mut self, scalar: Scalar) -> Result<f64, Stop> {
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn skip(&mut self, scalar: Scalar, count: u64) -> Result<(), Stop> {
        let bytes = count.saturating_mul(scalar.size() as u64);
        let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
        self.rest = self.rest.get(bytes..).ok_or(Stop::End)?;
        self.at.at += bytes;
        Ok(())
    }

    #[inline(always)]
    fn end(&self) -> Result<(), Stop> {
        Ok(())
    }

    fn last(&self) -> Word<'t> {
        self.last
    }

    fn rest(&self) -> usize {
        self.rest.len()
    }

    fn end_of_file(&self) -> Word<'t> {
        empty(self.at)
    }
}
