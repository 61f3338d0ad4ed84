//! Pictures in real pixels, for terminals that show them.
//!
//! The encoders are our own, about a hundred lines each: crates for this purpose prepare a picture
//! once and show it many times, ask the terminal themselves on its keyboard, or write past the frame.
//! Here a picture is new in nearly every frame, and belongs to the frame's other bytes. What is hard
//! about it, compression, is that of the `image` crate's PNG.

mod iterm;
mod kitty;
mod sixel;

#[cfg(test)]
mod tests;

use std::io;

use ratatui::layout::Rect;

use crate::image_file;
use crate::scene::Size;

pub(super) use kitty::{REMOVE, REMOVE_THROUGH_TMUX, answers};

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

/// What stands between this process and the terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// Nothing: sequences are sent as they are.
    #[default]
    Plain,
    /// tmux, which passes on what is wrapped for it, but does not put the cursor where the pane has
    /// it: the pane is so many columns from the left of the terminal and rows from its top.
    Tmux {
        /// Columns to the left of the pane.
        left: u16,
        /// Rows above the pane.
        top: u16,
    },
}

/// How and in which cells pictures are sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Means {
    /// The protocol.
    pub protocol: Protocol,
    /// What is on the way.
    pub wrapping: Wrapping,
    /// Width and height of a cell in pixels.
    pub cell: (u16, u16),
}

/// A picture to send.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixmap {
    /// Size in pixels.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
}

/// Ends an incomplete sequence.
pub(super) const END: &str = "\x1b\\";

impl Means {
    /// Whether text replaces pictures, so that erasing cells erases them; otherwise they are below
    /// the text, and are removed by [`Means::ending`].
    pub(super) const fn is_content(self) -> bool {
        match self.protocol {
            Protocol::Kitty => false,
            Protocol::Iterm | Protocol::Sixel => true,
        }
    }

    /// What ends an incomplete picture, and removes one that erasing cells does not erase.
    pub(super) const fn ending(self) -> &'static str {
        match (self.protocol, self.wrapping) {
            (Protocol::Kitty, Wrapping::Plain) => REMOVE,
            (Protocol::Kitty, Wrapping::Tmux { .. }) => REMOVE_THROUGH_TMUX,
            (Protocol::Iterm | Protocol::Sixel, _) => END,
        }
    }

    /// Appends the bytes that fill these cells with a picture. The cursor is at the first of them,
    /// and anywhere afterwards. Fails if there are not as many pixels as the size says.
    pub(super) fn encode(self, pixmap: &Pixmap, place: Rect, out: &mut Vec<u8>) -> io::Result<()> {
        let png = || image_file::encode_quickly(pixmap.size, &pixmap.pixels);
        match self.protocol {
            Protocol::Kitty => kitty::encode(&png()?, place, self.wrapping, out),
            Protocol::Iterm => iterm::encode(&png()?, place, self.wrapping, out),
            Protocol::Sixel => {
                let length = |cells: u16, pixels: u16| usize::from(cells) * usize::from(pixels);
                let (width, height) = self.cell;
                let size = (length(place.width, width), length(place.height, height));
                sixel::encode(pixmap, size, out);
            }
        }
        Ok(())
    }
}

impl Wrapping {
    /// Appends a sequence that begins at a cell, wrapped if necessary.
    fn append(self, place: Rect, out: &mut Vec<u8>, sequence: impl FnOnce(&mut Vec<u8>)) {
        let Self::Tmux { left, top } = self else {
            sequence(out);
            return;
        };
        let (row, column) = (top + place.y + 1, left + place.x + 1);
        let mut inner = format!("\x1b[{row};{column}H").into_bytes();
        sequence(&mut inner);
        out.extend_from_slice(b"\x1bPtmux;");
        for byte in inner {
            if byte == 0x1b {
                out.push(byte);
            }
            out.push(byte);
        }
        out.extend_from_slice(END.as_bytes());
    }
}
