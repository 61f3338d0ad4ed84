//! The interface's end: one socket for the scene that it shows.

use std::fs::File;
use std::io;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use file::Lock;
use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::Errno;

use super::messages::ToInterface;
use super::place::Place;
use super::stream::{self, Receiver, Sender};

/// The maximum number of messages of one connection that are not handled yet.
const UNHANDLED: usize = 256;

/// How long after a connection that could not be accepted another is tried.
const PAUSE: Duration = Duration::from_millis(100);

/// What is heard on a socket.
#[derive(Debug)]
pub enum Heard {
    /// An editor's server has connected, as the connection of this number.
    Came(u64, Sender),
    /// It sent a message, which counts as unhandled until the value is dropped.
    Said(u64, ToInterface, Unhandled),
    /// It is gone: it closed the connection, or what it sent is no message.
    Left(u64),
}

/// A message that is not handled yet; of these there are only so many.
#[derive(Debug)]
pub struct Unhandled(mpsc::Sender<()>);

impl Drop for Unhandled {
    fn drop(&mut self) {
        // The reader may have ended.
        let _ = self.0.send(());
    }
}

/// A socket that is listened on until this is dropped.
#[derive(Debug)]
pub struct Listening {
    place: Place,
    lock: File,
    /// Wakes the thread that accepts, by being closed.
    _end: UnixStream,
}

/// Listens for editors of a scene. `hear` is called on threads of its own. `None` if another interface
/// already does.
///
/// # Errors
///
/// Fails if there can be no socket.
pub fn listen(
    scene: &Path,
    hear: impl Fn(Heard) + Clone + Send + 'static,
) -> io::Result<Option<Listening>> {
    listen_at(Place::of(scene)?, hear)
}

pub(crate) fn listen_at(
    place: Place,
    hear: impl Fn(Heard) + Clone + Send + 'static,
) -> io::Result<Option<Listening>> {
    let Some(lock) = lock(&place)? else {
        return Ok(None);
    };
    // What is left behind by an interface that was killed is replaced, by a socket that can already be
    // connected to.
    let new = format!("{}.new", place.name);
    place.folder.remove(&new)?;
    let listener = UnixListener::bind(place.folder.short_place(&new))?;
    place.folder.rename(&new, &place.name)?;
    let (end, woken) = UnixStream::pair()?;
    let listening = Listening {
        place,
        lock,
        _end: end,
    };
    spawn("listening", move || accept(&listener, &woken, &hear))?;
    Ok(Some(listening))
}

impl Drop for Listening {
    /// Removes the socket, unless somebody has replaced its lock.
    fn drop(&mut self) {
        let lock = lock_name(&self.place);
        if self.place.folder.has(&lock, &self.lock).unwrap_or(false) {
            let _ = self.place.folder.remove(&self.place.name);
            let _ = self.place.folder.remove(&lock);
        }
    }
}

fn lock_name(place: &Place) -> String {
    format!("{}.lock", place.name)
}

/// Takes the lock of a socket; `None` if somebody listens there.
fn lock(place: &Place) -> io::Result<Option<File>> {
    let name = lock_name(place);
    loop {
        let file = match place.folder.create(&name) {
            Ok(file) => file,
            Err(error) => match place.folder.open(&name)? {
                Some(file) => file,
                None if error.kind() == io::ErrorKind::AlreadyExists => continue,
                None => return Err(error),
            },
        };
        match file::lock(&file) {
            Lock::Busy => return Ok(None),
            Lock::Unknown if stream::is_alive(place) => return Ok(None),
            Lock::Taken | Lock::Unknown => {}
        }
        // Its last owner may have removed it just before.
        if place.folder.has(&name, &file).unwrap_or(false) {
            return Ok(Some(file));
        }
    }
}

/// Accepts connections until the other end of `woken` is closed.
fn accept(
    listener: &UnixListener,
    woken: &UnixStream,
    hear: &(impl Fn(Heard) + Clone + Send + 'static),
) {
    for number in 0.. {
        let mut ready = [
            PollFd::new(listener, PollFlags::IN),
            PollFd::new(woken, PollFlags::IN),
        ];
        match poll(&mut ready, None) {
            Err(Errno::INTR) => continue,
            Ok(_) if ready[1].revents().is_empty() => {}
            _ => return,
        }
        let Ok((stream, _)) = listener.accept() else {
            // Out of files, for example.
            thread::sleep(PAUSE);
            continue;
        };
        let Ok((sender, receiver)) = stream::ends(stream) else {
            continue;
        };
        hear(Heard::Came(number, sender));
        let hear_it = hear.clone();
        let reading = spawn("hearing", move || read(number, receiver, &hear_it));
        if reading.is_err() {
            hear(Heard::Left(number));
        }
    }
}

/// Reads the messages of a connection.
fn read(number: u64, mut receiver: Receiver, hear: &impl Fn(Heard)) {
    let (sender, permits) = mpsc::channel();
    for _ in 0..UNHANDLED {
        let _ = sender.send(());
    }
    while permits.recv().is_ok() {
        let message = receiver.receive().ok().flatten();
        let Some(message) = message.as_ref().and_then(ToInterface::of_json) else {
            break;
        };
        hear(Heard::Said(number, message, Unhandled(sender.clone())));
    }
    hear(Heard::Left(number));
}

fn spawn(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    let thread = thread::Builder::new().name(name.to_owned());
    thread.spawn(work).map(drop)
}
