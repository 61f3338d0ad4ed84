//! Pictures in place of text (kitty's Unicode placeholders,
//! <https://sw.kovidgoyal.net/kitty/graphics-protocol/#unicode-placeholders>): a cell names a picture by
//! its colour, and the row and column of its part by combining characters. tmux moves, clips and covers
//! such cells as it does any text.
//!
//! kitty forgets a picture as soon as another begins to arrive under its number, and tmux passes on a
//! picture before the text around it. So pictures alternate between two numbers: cells name the one
//! that is there until the other is complete.

use std::borrow::Cow;

use ratatui::buffer::Cell;
use ratatui::layout::Rect;
use ratatui::style::Color;

use super::kitty;
use super::pixmap::Pixmap;
use super::wrapping::wrap;
use scene::Size;

/// The character of all cells, whose width is one.
pub(in crate::terminal) const PLACEHOLDER: char = '\u{10eeee}';

/// The number of combining characters in a cell.
pub(in crate::terminal) const MARKS: usize = 3;

/// The most rows and columns of a picture.
pub(crate) const MOST: u16 = DIACRITICS.len() as u16;

/// The highest of the four bytes of a number, so that it is not one of the small ones that others use.
const TOP: u16 = 72;

/// Which of a pane's two pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::terminal) enum Turn {
    #[default]
    First,
    Second,
}

impl Turn {
    /// The other one.
    pub(in crate::terminal) const fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }
}

/// The colour that names a picture: of the 256, because tmux may replace 24-bit colours, and not of the
/// first sixteen. All panes share the terminal's numbers, so each of 120 has its own two.
fn colour(pane: u32, turn: Turn) -> u8 {
    16 + (2 * (pane % 120) + turn as u32) as u8
}

fn number(pane: u32, turn: Turn) -> u32 {
    u32::from(TOP) << 24 | u32::from(colour(pane, turn))
}

/// Appends a PNG, to be shown in cells that name it.
pub(super) fn encode(png: &[u8], (pane, turn): (u32, Turn), place: Rect, out: &mut Vec<u8>) {
    let (columns, rows, number) = (place.width, place.height, number(pane, turn));
    let control = format!("a=T,U=1,f=100,i={number},p=1,c={columns},r={rows},q=2,");
    kitty::send(png, control, |command| wrap(command, out));
}

/// Removes the pictures of a pane and forgets them. Preceded by the end of any incomplete sequence.
pub(super) fn removal(pane: u32) -> String {
    let mut commands = b"\x1b\\".to_vec();
    for turn in [Turn::First, Turn::Second] {
        let number = number(pane, turn);
        commands.extend_from_slice(format!("\x1b_Ga=d,d=I,i={number},q=2\x1b\\").as_bytes());
    }
    let mut out = b"\x1b\\".to_vec();
    wrap(&commands, &mut out);
    String::from_utf8_lossy(&out).into_owned()
}

/// Makes a cell name its part of a picture, by row and column.
pub(in crate::terminal) fn name(
    cell: &mut Cell,
    (pane, turn): (u32, Turn),
    (row, column): (u16, u16),
) {
    let mut symbol = String::from(PLACEHOLDER);
    for index in [row, column, TOP] {
        let mark = DIACRITICS.get(usize::from(index)).copied();
        symbol.extend(mark.and_then(char::from_u32));
    }
    cell.set_symbol(&symbol);
    cell.set_fg(Color::Indexed(colour(pane, turn)));
}

/// Repeats columns or rows of a picture until it has the shape of its cells, in which the terminal keeps
/// the shape of a picture and would leave two edges empty.
pub(super) fn fitted(pixmap: &Pixmap, place: Rect, cell: (u16, u16)) -> Cow<'_, Pixmap> {
    let across = u64::from(place.width) * u64::from(cell.0);
    let down = u64::from(place.height) * u64::from(cell.1);
    let (width, height) = (pixmap.size.width, pixmap.size.height);
    let scaled = |length: u32, to: u64, from: u64| {
        let scaled = (u64::from(length) * to + from / 2).checked_div(from);
        scaled.map_or(0, |scaled| scaled as u32)
    };
    let size = Size {
        width: width.max(scaled(height, across, down)),
        height: height.max(scaled(width, down, across)),
    };
    if size == pixmap.size {
        return Cow::Borrowed(pixmap);
    }
    let source = |at: u32, whole: u32, of: u32| u64::from(at) * u64::from(of) / u64::from(whole);
    let pixels = (0..size.height).flat_map(|y| {
        let row = source(y, size.height, height) * u64::from(width);
        (0..size.width).map(move |x| (row + source(x, size.width, width)) as usize)
    });
    Cow::Owned(Pixmap {
        size,
        pixels: pixels.map(|at| pixmap.pixels[at]).collect(),
    })
}

/// The combining characters that stand for numbers from zero: kitty's `rowcolumn-diacritics.txt`.
pub(super) const DIACRITICS: [u32; 297] = [
    0x305, 0x30d, 0x30e, 0x310, 0x312, 0x33d, 0x33e, 0x33f, 0x346, 0x34a, 0x34b, 0x34c, 0x350,
    0x351, 0x352, 0x357, 0x35b, 0x363, 0x364, 0x365, 0x366, 0x367, 0x368, 0x369, 0x36a, 0x36b,
    0x36c, 0x36d, 0x36e, 0x36f, 0x483, 0x484, 0x485, 0x486, 0x487, 0x592, 0x593, 0x594, 0x595,
    0x597, 0x598, 0x599, 0x59c, 0x59d, 0x59e, 0x59f, 0x5a0, 0x5a1, 0x5a8, 0x5a9, 0x5ab, 0x5ac,
    0x5af, 0x5c4, 0x610, 0x611, 0x612, 0x613, 0x614, 0x615, 0x616, 0x617, 0x657, 0x658, 0x659,
    0x65a, 0x65b, 0x65d, 0x65e, 0x6d6, 0x6d7, 0x6d8, 0x6d9, 0x6da, 0x6db, 0x6dc, 0x6df, 0x6e0,
    0x6e1, 0x6e2, 0x6e4, 0x6e7, 0x6e8, 0x6eb, 0x6ec, 0x730, 0x732, 0x733, 0x735, 0x736, 0x73a,
    0x73d, 0x73f, 0x740, 0x741, 0x743, 0x745, 0x747, 0x749, 0x74a, 0x7eb, 0x7ec, 0x7ed, 0x7ee,
    0x7ef, 0x7f0, 0x7f1, 0x7f3, 0x816, 0x817, 0x818, 0x819, 0x81b, 0x81c, 0x81d, 0x81e, 0x81f,
    0x820, 0x821, 0x822, 0x823, 0x825, 0x826, 0x827, 0x829, 0x82a, 0x82b, 0x82c, 0x82d, 0x951,
    0x953, 0x954, 0xf82, 0xf83, 0xf86, 0xf87, 0x135d, 0x135e, 0x135f, 0x17dd, 0x193a, 0x1a17,
    0x1a75, 0x1a76, 0x1a77, 0x1a78, 0x1a79, 0x1a7a, 0x1a7b, 0x1a7c, 0x1b6b, 0x1b6d, 0x1b6e, 0x1b6f,
    0x1b70, 0x1b71, 0x1b72, 0x1b73, 0x1cd0, 0x1cd1, 0x1cd2, 0x1cda, 0x1cdb, 0x1ce0, 0x1dc0, 0x1dc1,
    0x1dc3, 0x1dc4, 0x1dc5, 0x1dc6, 0x1dc7, 0x1dc8, 0x1dc9, 0x1dcb, 0x1dcc, 0x1dd1, 0x1dd2, 0x1dd3,
    0x1dd4, 0x1dd5, 0x1dd6, 0x1dd7, 0x1dd8, 0x1dd9, 0x1dda, 0x1ddb, 0x1ddc, 0x1ddd, 0x1dde, 0x1ddf,
    0x1de0, 0x1de1, 0x1de2, 0x1de3, 0x1de4, 0x1de5, 0x1de6, 0x1dfe, 0x20d0, 0x20d1, 0x20d4, 0x20d5,
    0x20d6, 0x20d7, 0x20db, 0x20dc, 0x20e1, 0x20e7, 0x20e9, 0x20f0, 0x2cef, 0x2cf0, 0x2cf1, 0x2de0,
    0x2de1, 0x2de2, 0x2de3, 0x2de4, 0x2de5, 0x2de6, 0x2de7, 0x2de8, 0x2de9, 0x2dea, 0x2deb, 0x2dec,
    0x2ded, 0x2dee, 0x2def, 0x2df0, 0x2df1, 0x2df2, 0x2df3, 0x2df4, 0x2df5, 0x2df6, 0x2df7, 0x2df8,
    0x2df9, 0x2dfa, 0x2dfb, 0x2dfc, 0x2dfd, 0x2dfe, 0x2dff, 0xa66f, 0xa67c, 0xa67d, 0xa6f0, 0xa6f1,
    0xa8e0, 0xa8e1, 0xa8e2, 0xa8e3, 0xa8e4, 0xa8e5, 0xa8e6, 0xa8e7, 0xa8e8, 0xa8e9, 0xa8ea, 0xa8eb,
    0xa8ec, 0xa8ed, 0xa8ee, 0xa8ef, 0xa8f0, 0xa8f1, 0xaab0, 0xaab2, 0xaab3, 0xaab7, 0xaab8, 0xaabe,
    0xaabf, 0xaac1, 0xfe20, 0xfe21, 0xfe22, 0xfe23, 0xfe24, 0xfe25, 0xfe26, 0x10a0f, 0x10a38,
    0x1d185, 0x1d186, 0x1d187, 0x1d188, 0x1d189, 0x1d1aa, 0x1d1ab, 0x1d1ac, 0x1d1ad, 0x1d242,
    0x1d243, 0x1d244,
];
