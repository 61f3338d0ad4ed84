//! The kitty graphics protocol: pictures placed below text, identified by numbers
//! (<https://sw.kovidgoyal.net/kitty/graphics-protocol/>).

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::Wrapping;

/// The number of the picture. The terminal's numbers are shared by all programs in a window; small
/// ones are the likeliest to be used by others.
const ID: u32 = 18_508;

/// Below text, and below cells with a background of their own.
const BELOW: i32 = i32::MIN / 2 - 1;

/// Maximum length of the data in a sequence, a multiple of four characters.
const CHUNK: usize = 4096;

/// Asks whether the terminal knows the protocol, with a picture of one pixel that is not stored.
pub(in crate::ui::terminal) const QUERY: &[u8] = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\";

/// Removes the picture and forgets it. Preceded by the end of any incomplete sequence.
pub(in crate::ui::terminal) const REMOVE: &str = "\x1b\\\x1b_Ga=d,d=I,i=18508,q=2\x1b\\";

/// Appends a PNG, to be shown over `cells` (columns, rows) from the cursor on in place of the picture
/// before. The cursor stays where it is, and the terminal does not answer.
pub(super) fn encode(png: &[u8], cells: (u16, u16), wrapping: Wrapping, out: &mut Vec<u8>) {
    let data = STANDARD.encode(png);
    let (columns, rows) = cells;
    let mut control = format!("a=T,f=100,i={ID},p=1,c={columns},r={rows},z={BELOW},C=1,q=2,");
    let mut chunks = data.as_bytes().chunks(CHUNK).peekable();
    while let Some(chunk) = chunks.next() {
        let more = u8::from(chunks.peek().is_some());
        wrapping.append(out, |out| {
            out.extend_from_slice(format!("\x1b_G{control}m={more};").as_bytes());
            out.extend_from_slice(chunk);
            out.extend_from_slice(b"\x1b\\");
        });
        control.clear();
        // Continued chunks ask for silence again, because some terminals answer to the last.
        control.push_str("q=2,");
    }
}
