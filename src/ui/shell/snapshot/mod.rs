//! Writes a screen to a file: as text, as text with escape codes, or as a picture.

mod font;
mod picture;

pub(super) use picture::drawn;

use std::io;
use std::path::Path;

use ratatui::buffer::Buffer;
use unicode_width::UnicodeWidthStr;

use crate::terminal::{self, ColourDepth};
use crate::theme::Theme;

/// The format of a written screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `.txt`: the characters, without spaces at the ends of lines.
    Text,
    /// `.ansi`: the characters with escape codes for colours, to print in a terminal.
    Ansi,
    /// `.png`: a picture of the screen.
    Picture,
}

impl Format {
    /// The format for a file name's extension.
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "txt" => Some(Self::Text),
            "ansi" => Some(Self::Ansi),
            "png" => Some(Self::Picture),
            _ => None,
        }
    }
}

/// Writes a screen of a terminal with these colours. Replaces an existing file.
pub(super) fn write(
    mut cells: Buffer,
    path: &Path,
    format: Format,
    (theme, depth): (Theme, ColourDepth),
) -> io::Result<()> {
    let confirm = || Ok::<(), io::Error>(());
    for cell in &mut cells.content {
        [cell.fg, cell.bg] = [cell.fg, cell.bg].map(|colour| depth.shown(colour));
    }
    let cells = &cells;
    let bytes = match format {
        Format::Text => text(cells).into_bytes(),
        Format::Ansi => terminal::printed(cells),
        Format::Picture => {
            let drawn = drawn(cells, theme);
            return image_file::save(image_file::Picture::of(&drawn), path, &confirm).map(drop);
        }
    };
    file::deliver(path, &mut |out| out.write_all(&bytes), &confirm).map(drop)
}

/// The characters of a screen, one line for each row.
fn text(cells: &Buffer) -> String {
    let mut text = String::new();
    for y in 0..cells.area.height {
        let start = text.len();
        let mut x = 0;
        while x < cells.area.width {
            let symbol = cells[(x, y)].symbol();
            text.push_str(symbol);
            // The cells below the rest of a wide character are not shown.
            x += (symbol.width() as u16).max(1);
        }
        text.truncate(start + text[start..].trim_end().len());
        text.push('\n');
    }
    text
}
