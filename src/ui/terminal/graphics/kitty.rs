//! The kitty graphics protocol: pictures placed below text, identified by numbers
//! (<https://sw.kovidgoyal.net/kitty/graphics-protocol/>).

use ratatui::layout::Rect;

use super::wrapping::Wrapping;
use crate::terminal::base64;

/// The number of the picture. The terminal's numbers are shared by all programs in a window; small
/// ones are the likeliest to be used by others.
const ID: u32 = 18_508;

/// Below text, and below cells with a background of their own.
const BELOW: i32 = i32::MIN / 2 - 1;

/// Maximum length of the data in a sequence, a multiple of four characters.
const CHUNK: usize = 4096;

/// The number of the picture in the query: see [`query`](crate::terminal::query).
const QUERY_ID: &[u8] = b"i=31";

/// Removes the picture and forgets it. Preceded by the end of any incomplete sequence.
pub(in crate::terminal) const REMOVE: &str = "\x1b\\\x1b_Ga=d,d=I,i=18508,q=2\x1b\\";

/// The same through tmux.
pub(in crate::terminal) const REMOVE_THROUGH_TMUX: &str =
    "\x1b\\\x1bPtmux;\x1b\x1b\\\x1b\x1b_Ga=d,d=I,i=18508,q=2\x1b\x1b\\\x1b\\";

/// Whether an application program command, without its introducer, answers the query with success.
pub(in crate::terminal) fn answers(command: &[u8]) -> bool {
    let control = command.strip_suffix(b";OK");
    let control = control.and_then(|control| control.strip_prefix(b"G"));
    let mut parts = control.unwrap_or_default().split(|&byte| byte == b',');
    parts.any(|part| part == QUERY_ID)
}

/// Appends a PNG, to be shown over these cells, at the cursor, in place of the picture before. The
/// cursor stays where it is, and the terminal does not answer.
pub(super) fn encode(png: &[u8], place: Rect, wrapping: Wrapping, out: &mut Vec<u8>) {
    let (columns, rows) = (place.width, place.height);
    let control = format!("a=T,f=100,i={ID},p=1,c={columns},r={rows},z={BELOW},C=1,q=2,");
    send(png, control, |command| {
        wrapping.append(place, out, |out| out.extend_from_slice(command));
    });
}

/// Passes a PNG to `append` as commands, the first of which has this control data.
pub(super) fn send(png: &[u8], mut control: String, mut append: impl FnMut(&[u8])) {
    let data = base64::encode(png);
    let mut chunks = data.as_bytes().chunks(CHUNK).peekable();
    while let Some(chunk) = chunks.next() {
        let more = u8::from(chunks.peek().is_some());
        let mut command = format!("\x1b_G{control}m={more};").into_bytes();
        command.extend_from_slice(chunk);
        command.extend_from_slice(b"\x1b\\");
        append(&command);
        control.clear();
        // Continued chunks ask for silence again, because some terminals answer to the last.
        control.push_str("q=2,");
    }
}
