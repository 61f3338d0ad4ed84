//! The output to a socket that is read, not read, or closed.

use std::io::{ErrorKind, Read};
use std::os::unix::net::UnixStream;
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use super::*;

/// More bytes than any socket buffers.
const MUCH: usize = 4 << 20;

const WATCHDOG: Duration = Duration::from_secs(30);

/// An output, its readable end, and a receiver of a notice each time that everything was written.
fn output() -> (Output, UnixStream, Receiver<()>) {
    let (ours, theirs) = UnixStream::pair().expect("sockets");
    ours.set_nonblocking(true).expect("it can be");
    let (cleared, notices) = mpsc::channel();
    let output = Output::start(TtyWriter::own(ours.into()), move || {
        let _ = cleared.send(());
    });
    (output.expect("a thread"), theirs, notices)
}

/// An output with pending bytes.
fn pending() -> (Output, UnixStream, Receiver<()>) {
    let (output, reader, notices) = output();
    output.send(&vec![b'a'; MUCH]).expect("it waits");
    (output, reader, notices)
}

#[test]
fn bytes_accepted_at_once_need_no_thread() {
    let (output, mut reader, notices) = output();
    output.send(b"abc").expect("it takes bytes");
    assert!(output.is_clear());
    let mut read = [0; 3];
    reader.read_exact(&mut read).expect("they came");
    assert_eq!(&read, b"abc");
    assert!(notices.try_recv().is_err());
}

#[test]
fn pending_bytes_follow_in_order() {
    let (output, mut reader, notices) = pending();
    assert!(!output.is_clear());
    output.send(&vec![b'b'; MUCH]).expect("it waits as well");
    let mut read = vec![0; 2 * MUCH];
    reader.read_exact(&mut read).expect("they came");
    assert_eq!(read, [vec![b'a'; MUCH], vec![b'b'; MUCH]].concat());
    notices.recv_timeout(WATCHDOG).expect("all is taken");
    assert!(output.is_clear());
}

#[test]
fn the_last_bytes_replace_those_that_are_pending() {
    let (output, mut reader, _) = pending();
    let read = thread::spawn(move || {
        let mut read = Vec::new();
        reader.read_to_end(&mut read).map(|_| read)
    });
    let last = output.send_last(b"end", Instant::now() + WATCHDOG);
    last.expect("somebody reads");
    drop(output);
    let read = read.join().expect("no panic").expect("it is readable");
    assert!(read.ends_with(b"aend"));
    assert!(read.len() <= MUCH + 3);
}

#[test]
fn the_last_bytes_wait_only_until_the_deadline() {
    let (output, _reader, _) = pending();
    let late = output.send_last(b"end", Instant::now());
    assert_eq!(late.map_err(|e| e.kind()), Err(ErrorKind::TimedOut));
}

#[test]
fn nothing_follows_the_last_bytes_of_a_signal_handler() {
    let (output, mut reader, _) = output();
    output.send(b"frame").expect("it takes bytes");
    output.fall_silent();
    output.send(b"another").expect("it waits for ever");
    assert!(!output.is_clear());
    drop(output);
    let mut read = [0; 16];
    let count = reader.read(&mut read).expect("it is readable");
    assert_eq!(&read[..count], b"frame");
    reader.set_nonblocking(true).expect("it can be");
    let rest = reader.read(&mut read).map_err(|error| error.kind());
    let is_end = matches!(rest, Ok(0) | Err(ErrorKind::WouldBlock));
    assert!(is_end, "{rest:?}");
}

#[test]
fn a_closed_end_is_an_error() {
    let (output, reader, notices) = pending();
    drop(reader);
    notices.recv_timeout(WATCHDOG).expect("it fails");
    assert!(output.is_clear());
    assert!(output.send(b"b").is_err());
    assert!(output.send_last(b"c", Instant::now() + WATCHDOG).is_err());
}
