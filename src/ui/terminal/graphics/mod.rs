//! Pictures in real pixels, for terminals that show them.
//!
//! The encoders are our own, about a hundred lines each: crates for this purpose prepare a picture
//! once and show it many times, ask the terminal themselves on its keyboard, or draw past the frame.
//! Here a picture is new in nearly every frame, and belongs to the frame's other bytes.

mod iterm;
mod kitty;
mod sixel;

#[cfg(test)]
mod tests;

use std::io;

use crate::image_file;
use crate::scene::Size;

pub(super) use kitty::{QUERY, REMOVE};

/// How pictures are sent to the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// That of kitty, Ghostty, Konsole and others: pictures below the text.
    Kitty,
    /// That of iTerm2, `WezTerm`, mintty and others: pictures as contents of cells.
    Iterm,
    /// That of DEC terminals, xterm, foot and others: 256 colours, as contents of cells.
    Sixel,
}

/// Whether a multiplexer stands between this process and the terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// None: sequences are sent as they are.
    #[default]
    Plain,
    /// tmux, which passes on what is wrapped for it.
    Tmux,
}

/// A picture to send.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    /// Size in pixels.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: &'a [[u8; 3]],
    /// Columns and rows that it fills.
    pub cells: (u16, u16),
}

impl Protocol {
    /// Whether text replaces pictures, so that erasing cells erases them; otherwise they are below
    /// the text, and are removed by a command.
    pub(super) const fn is_content(self) -> bool {
        match self {
            Self::Kitty => false,
            Self::Iterm | Self::Sixel => true,
        }
    }

    /// Appends the bytes that show a picture from the cursor on, in cells of `cell` pixels (width,
    /// height). Fails if there are not as many
    /// pixels as the size says.
    pub(super) fn encode(
        self,
        image: &Image<'_>,
        cell: (u16, u16),
        wrapping: Wrapping,
        out: &mut Vec<u8>,
    ) -> io::Result<()> {
        let png = || image_file::encode_quickly(image.size, image.pixels);
        match self {
            Self::Kitty => kitty::encode(&png()?, image.cells, wrapping, out),
            Self::Iterm => iterm::encode(&png()?, image.cells, wrapping, out),
            Self::Sixel => {
                let length = |cells: u16, pixels: u16| usize::from(cells) * usize::from(pixels);
                let size = (length(image.cells.0, cell.0), length(image.cells.1, cell.1));
                sixel::encode(image, size, out);
            }
        }
        Ok(())
    }
}

impl Wrapping {
    /// Appends a sequence, wrapped if necessary.
    fn append(self, out: &mut Vec<u8>, sequence: impl FnOnce(&mut Vec<u8>)) {
        let start = out.len();
        sequence(out);
        if self == Self::Tmux {
            let inner = out.split_off(start);
            out.extend_from_slice(b"\x1bPtmux;");
            for byte in inner {
                if byte == 0x1b {
                    out.push(byte);
                }
                out.push(byte);
            }
            out.extend_from_slice(b"\x1b\\");
        }
    }
}
