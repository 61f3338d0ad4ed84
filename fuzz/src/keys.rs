//! Input from a terminal.

use std::time::{Duration, Instant};

use halflight::ui::terminal::{Decoder, Event};

/// The bytes that end a control string or may begin what ends it.
const ENDS: [u8; 5] = [0x07, 0x18, 0x1a, 0x1b, 0x9c];

/// Decodes the input after its first byte at once and in pieces whose length that byte gives: the
/// events must be equal. With pauses between the pieces they may differ. As the content of a control
/// string, the input must give no event at all.
pub fn keys(input: &[u8]) {
    let Some((&seed, bytes)) = input.split_first() else {
        return;
    };
    let whole = decode([bytes], Duration::ZERO);
    let each = 1 + usize::from(seed % 16);
    assert_eq!(decode(bytes.chunks(each), Duration::ZERO), whole);
    decode(bytes.chunks(each), Duration::from_millis(u64::from(seed)));
    let introducer = b"]^X"[usize::from(seed) % 3];
    let content = bytes.iter().filter(|byte| !ENDS.contains(byte));
    let string = [
        &[0x1b, introducer],
        &content.copied().collect::<Vec<_>>()[..],
        b"\x1b\\x",
    ];
    let string = string.concat();
    let one_key = decode([&b"x"[..]], Duration::ZERO);
    assert_eq!(
        decode(string.chunks(each), Duration::from_millis(20)),
        one_key
    );
}

/// Decodes pieces with a pause between them.
fn decode<'b>(pieces: impl IntoIterator<Item = &'b [u8]>, pause: Duration) -> Vec<Event> {
    let mut decoder = Decoder::default();
    let mut events = Vec::new();
    let mut now = Instant::now();
    for piece in pieces {
        decoder.expire(now, |event| events.push(event));
        decoder.feed(piece, now, |event| events.push(event));
        now += pause;
    }
    decoder.expire(now + Duration::from_secs(60), |event| events.push(event));
    assert_eq!(
        decoder.deadline(),
        None,
        "all events are reported in the end"
    );
    events
}
