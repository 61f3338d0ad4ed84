//! Pictures in real pixels, for terminals that show them.
//!
//! The encoders are our own, about a hundred lines each: crates for this purpose prepare a picture
//! once and show it many times, ask the terminal themselves on its keyboard, or write past the frame.
//! Here a picture is new in nearly every frame, and belongs to the frame's other bytes. What is hard
//! about it, compression, is that of the `image` crate's PNG.

mod iterm;
mod kitty;
mod pixmap;
mod placeholders;
mod sixel;
mod wrapping;

#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::io;

use ratatui::layout::Rect;

pub(super) use kitty::{REMOVE, REMOVE_THROUGH_TMUX, answers};
pub use pixmap::Pixmap;
pub(crate) use placeholders::MOST as MOST_PLACEHOLDERS;
pub(super) use placeholders::{MARKS, PLACEHOLDER, Turn, name};
pub(super) use wrapping::END;
pub use wrapping::Wrapping;

/// How pictures are sent to the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// The protocol of kitty, Ghostty, Konsole and others: pictures below the text.
    Kitty,
    /// The protocol of kitty and Ghostty through tmux: cells of text that name their part of a picture.
    Placeholders {
        /// The number of the pane, by which pictures of several panes are told apart.
        pane: u32,
    },
    /// The protocol of iTerm2, `WezTerm`, mintty and others: pictures as contents of cells.
    Iterm,
    /// The protocol of DEC terminals, xterm, foot and others: 256 colours, as contents of cells.
    Sixel,
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

impl Means {
    /// Whether text replaces pictures, so that erasing cells erases them; otherwise they are apart from
    /// the text, and are removed by [`Means::ending`].
    pub(super) const fn is_content(self) -> bool {
        match self.protocol {
            Protocol::Kitty | Protocol::Placeholders { .. } => false,
            Protocol::Iterm | Protocol::Sixel => true,
        }
    }

    /// Whether text names pictures, which are sent before it.
    pub(super) const fn is_named(self) -> bool {
        matches!(self.protocol, Protocol::Placeholders { .. })
    }

    /// What ends an incomplete picture, and removes one that erasing cells does not erase.
    pub(super) fn ending(self) -> Cow<'static, str> {
        match (self.protocol, self.wrapping) {
            (Protocol::Kitty, Wrapping::Plain) => REMOVE.into(),
            (Protocol::Kitty, Wrapping::Tmux { .. }) => REMOVE_THROUGH_TMUX.into(),
            (Protocol::Placeholders { pane }, _) => placeholders::removal(pane).into(),
            (Protocol::Iterm | Protocol::Sixel, _) => END.into(),
        }
    }

    /// Appends the bytes that fill these cells with a picture. The cursor is at the first of them,
    /// and anywhere afterwards. There must be as many pixels as the size says.
    pub(super) fn encode(
        self,
        pixmap: &Pixmap,
        turn: Turn,
        place: Rect,
        out: &mut Vec<u8>,
    ) -> io::Result<()> {
        let png = |pixmap: &Pixmap| image_file::encode_quickly(pixmap.size, &pixmap.pixels);
        match self.protocol {
            Protocol::Kitty => kitty::encode(&png(pixmap)?, place, self.wrapping, out),
            Protocol::Placeholders { pane } => {
                let fitted = placeholders::fitted(pixmap, place, self.cell);
                placeholders::encode(&png(&fitted)?, (pane, turn), place, out);
            }
            Protocol::Iterm => iterm::encode(&png(pixmap)?, place, self.wrapping, out),
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
