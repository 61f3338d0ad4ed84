//! iTerm2's inline images (<https://iterm2.com/documentation-images.html>), which become the contents
//! of cells: text replaces them.

use ratatui::layout::Rect;

use super::wrapping::Wrapping;
use crate::terminal::base64;

/// Appends a PNG, to be shown over these cells, at the cursor, which moves.
pub(super) fn encode(png: &[u8], place: Rect, wrapping: Wrapping, out: &mut Vec<u8>) {
    let (columns, rows) = (place.width, place.height);
    let length = png.len();
    let control = format!(
        "\x1b]1337;File=inline=1;size={length};width={columns};height={rows};\
         preserveAspectRatio=0;doNotMoveCursor=1:"
    );
    wrapping.append(place, out, |out| {
        out.extend_from_slice(control.as_bytes());
        out.extend_from_slice(base64::encode(png).as_bytes());
        out.push(b'\x07');
    });
}
