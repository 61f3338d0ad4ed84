//! A language server for scenes, by the Language Server Protocol 3.17, linked to the interface that shows
//! the same scene, if there is one.
//!
//! One inbox, one thread that answers, in the order of the messages; another thread reads, and one for each
//! link.

mod answers;
mod document;
mod inbox;
mod positions;
mod server;
mod setup;
#[cfg(test)]
mod tests;
mod uri;
mod wire;

use std::io::{self, BufReader, Read, Write};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Instant;

use link::ToEditor;
use serde_json::Value;

use inbox::Inbox;
use server::{Next, Server};
use wire::Broken;

pub use setup::Editor;

/// Why a session ended otherwise than by the client's wish.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The stream of messages is broken.
    #[error("{0}")]
    Broken(String),
    /// An answer cannot be written.
    #[error("cannot write a response: {0}")]
    Unanswered(#[from] io::Error),
    /// The client ended the session without `shutdown`.
    #[error("the editor disconnected without a `shutdown` request")]
    Quit,
}

/// An arrival in the inbox.
#[derive(Debug)]
enum Event {
    /// A message from the editor; `None` at the end of the stream.
    Editor(Option<Result<Value, Broken>>),
    /// A message from the interface that shows the document of this URI, by the connection of this number;
    /// `None` at its end.
    Interface(String, u64, Option<ToEditor>),
}

/// Serves one editor until it ends the session.
///
/// # Errors
///
/// Fails if the session does not end as the protocol says.
pub fn serve(input: impl Read + Send + 'static, output: impl Write) -> Result<(), Error> {
    let (sender, inbox) = mpsc::channel();
    let to_inbox = sender.clone();
    // It ends with the stream, or with the process.
    thread::spawn(move || {
        let mut input = BufReader::new(input);
        loop {
            let message = wire::read(&mut input).transpose();
            let is_last = !matches!(message, Some(Ok(_)));
            if to_inbox.send(Event::Editor(message)).is_err() || is_last {
                return;
            }
        }
    });
    let mut server = Server::new(output, sender);
    let mut inbox = Inbox::new(inbox);
    loop {
        let Some(event) = inbox.next() else {
            server.settle()?;
            match inbox.wait(server.next_due()) {
                Ok(()) => {}
                Err(RecvTimeoutError::Timeout) => server.do_due(Instant::now())?,
                Err(RecvTimeoutError::Disconnected) => return Err(Error::Quit),
            }
            continue;
        };
        let message = match event {
            Event::Editor(message) => message.ok_or(Error::Quit)?,
            Event::Interface(uri, connection, message) => {
                server.hear(&uri, connection, message)?;
                continue;
            }
        };
        let message = message.map_err(|broken| Error::Broken(broken.to_string()))?;
        if let Some(id) = inbox.cancelled(&message) {
            server.cancel(id)?;
            continue;
        }
        match server.take(&message)? {
            Next::Message => {}
            Next::End => return Ok(()),
            Next::Quit => return Err(Error::Quit),
        }
    }
}
