//! Input from a terminal.

#[cfg(unix)]
use std::time::{Duration, Instant};

#[cfg(unix)]
use halflight::ui::terminal::{Decoder, Event};

/// Decodes the input after its first byte at once and in pieces whose length that byte gives: the
/// events must be equal. With pauses between the pieces they may differ.
#[cfg(unix)]
pub fn keys(input: &[u8]) {
    let Some((&seed, bytes)) = input.split_first() else {
        return;
    };
    let whole = decode([bytes], Duration::ZERO);
    let each = 1 + usize::from(seed % 16);
    assert_eq!(decode(bytes.chunks(each), Duration::ZERO), whole);
    decode(bytes.chunks(each), Duration::from_millis(u64::from(seed)));
}

/// Other systems have no decoder of bytes.
#[cfg(not(unix))]
pub fn keys(_: &[u8]) {}

/// Decodes pieces with a pause between them.
#[cfg(unix)]
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
