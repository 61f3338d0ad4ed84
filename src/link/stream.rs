//! A connection, as two ends of lines.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

use serde_json::Value;

use super::messages::{Shown, ToEditor, ToInterface};
use super::place::Place;

/// The maximum length of a line, in bytes.
const LONGEST: u64 = 1 << 29;

/// How long a write may wait for a peer that does not read, and an answer for one that does not write.
const PATIENCE: Duration = Duration::from_millis(200);

/// The end that messages are sent to.
#[derive(Debug)]
pub struct Sender(UnixStream);

/// The end that messages come from.
#[derive(Debug)]
pub struct Receiver(BufReader<UnixStream>);

/// Connects to the interface that shows a scene.
///
/// # Errors
///
/// Fails if there is none, or if it is not the user's own.
pub fn connect(scene: &Path) -> io::Result<(Sender, Receiver)> {
    match Place::find(scene)? {
        Some(place) => connect_to(&place),
        None => Err(io::Error::from(io::ErrorKind::NotFound)),
    }
}

pub(crate) fn connect_to(place: &Place) -> io::Result<(Sender, Receiver)> {
    ends(UnixStream::connect(place.folder.short_place(&place.name))?)
}

/// What the interface shows that listens on a socket; `None` if none answers.
pub fn shown(place: &Place) -> Option<Shown> {
    let stream = UnixStream::connect(place.folder.short_place(&place.name)).ok()?;
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    let (mut sender, mut receiver) = ends(stream).ok()?;
    sender.send(&ToInterface::Who.to_json()).ok()?;
    let answer = receiver.receive().ok().flatten()?;
    match ToEditor::of_json(&answer)? {
        ToEditor::Shown(shown) => Some(shown),
        _ => None,
    }
}

/// Whether something listens on a socket.
pub(crate) fn is_alive(place: &Place) -> bool {
    UnixStream::connect(place.folder.short_place(&place.name)).is_ok()
}

/// The ends of a connection.
///
/// # Errors
///
/// Fails if the peer belongs to another user.
pub(crate) fn ends(stream: UnixStream) -> io::Result<(Sender, Receiver)> {
    check_peer(&stream)?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let input = stream.try_clone()?;
    Ok((Sender(stream), Receiver(BufReader::new(input))))
}

/// Refuses peers of other users. Elsewhere the folder, which is closed to them, has to do.
#[cfg(target_os = "linux")]
fn check_peer(stream: &UnixStream) -> io::Result<()> {
    let peer = rustix::net::sockopt::socket_peercred(stream)?;
    if peer.uid == rustix::process::geteuid() {
        Ok(())
    } else {
        Err(io::Error::from(io::ErrorKind::PermissionDenied))
    }
}

#[cfg(not(target_os = "linux"))]
fn check_peer(_stream: &UnixStream) -> io::Result<()> {
    Ok(())
}

impl Sender {
    /// Sends a message.
    ///
    /// # Errors
    ///
    /// Fails if the peer is gone or does not read; the connection is closed then.
    pub fn send(&mut self, message: &Value) -> io::Result<()> {
        let mut line = message.to_string();
        line.push('\n');
        let sent = self.0.write_all(line.as_bytes());
        if sent.is_err() {
            // Half a line may have been sent.
            let _ = self.0.shutdown(Shutdown::Both);
        }
        sent
    }
}

impl Drop for Sender {
    /// Ends the receiver of the same connection too.
    fn drop(&mut self) {
        let _ = self.0.shutdown(Shutdown::Both);
    }
}

impl Receiver {
    /// Waits for the next message; `None` at the end of the connection. What is not JSON is null.
    ///
    /// # Errors
    ///
    /// Fails if the connection fails, or if a line is too long.
    pub fn receive(&mut self) -> io::Result<Option<Value>> {
        let mut line = Vec::new();
        (&mut self.0).take(LONGEST).read_until(b'\n', &mut line)?;
        if line.last() != Some(&b'\n') {
            return match line.len() as u64 {
                LONGEST => Err(io::Error::from(io::ErrorKind::FileTooLarge)),
                // The peer ended within a line.
                _ => Ok(None),
            };
        }
        Ok(Some(serde_json::from_slice(&line).unwrap_or_default()))
    }
}
