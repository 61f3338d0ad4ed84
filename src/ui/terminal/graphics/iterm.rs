//! iTerm2's inline images (<https://iterm2.com/documentation-images.html>), which become the contents
//! of cells: text replaces them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::Wrapping;

/// Appends a PNG, to be shown over `cells` (columns, rows) from the cursor on. The cursor moves.
pub(super) fn encode(png: &[u8], cells: (u16, u16), wrapping: Wrapping, out: &mut Vec<u8>) {
    let (columns, rows) = cells;
    let length = png.len();
    let data = STANDARD.encode(png);
    wrapping.append(out, |out| {
        out.extend_from_slice(
            format!(
                "\x1b]1337;File=inline=1;size={length};width={columns};height={rows};\
                 preserveAspectRatio=0;doNotMoveCursor=1:"
            )
            .as_bytes(),
        );
        out.extend_from_slice(data.as_bytes());
        out.push(b'\x07');
    });
}
