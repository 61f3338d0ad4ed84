//! The links of open documents to the interfaces that show them: what happens to a document is told, and
//! what the interface asks for is passed on to the editor.

use std::collections::BTreeMap;
use std::mem;
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use link::{Abilities, Follow, Opening, Sender, ToEditor, ToInterface};
use serde_json::Value;
use text::Edit;

use crate::Event;
use crate::document::Document;

/// How long after a connection failed another is tried.
const AGAIN: Duration = Duration::from_millis(500);

/// How long after an interface did not read.
const LATER: Duration = Duration::from_secs(10);

/// The maximum length of a text that is passed on, in bytes.
const LONGEST: usize = 1 << 28;

/// The links of all documents.
pub(crate) struct Links {
    inbox: mpsc::Sender<Event>,
    /// What the interfaces are told of the editor.
    pub(crate) editor: String,
    pub(crate) can: Abilities,
    pub(crate) follow: Follow,
    /// By the URIs of the documents.
    by_uri: BTreeMap<String, Link>,
    /// The number of connections so far.
    connections: u64,
}

/// The link of a document that may be shown.
struct Link {
    /// The number of changes since the document was opened.
    version: u64,
    state: State,
    /// Whether the user was told that the interface follows another editor.
    is_told: bool,
}

enum State {
    /// There is a connection, of this number.
    Connected(u64, Sender),
    /// Another connection is tried at this time.
    Apart(Instant),
    /// The interface shows the buffer of another editor. Another connection is tried when this one is
    /// saved.
    Busy,
}

impl Links {
    pub(crate) fn new(inbox: mpsc::Sender<Event>) -> Self {
        Self {
            inbox,
            editor: "the editor".to_owned(),
            can: Abilities::default(),
            follow: Follow::default(),
            by_uri: BTreeMap::new(),
            connections: 0,
        }
    }

    /// When another connection is tried.
    pub(crate) fn next_due(&self) -> Option<Instant> {
        let due = |link: &Link| match link.state {
            State::Apart(at) => Some(at),
            State::Connected(..) | State::Busy => None,
        };
        self.by_uri.values().filter_map(due).min()
    }

    /// The documents for which a connection is due.
    pub(crate) fn due(&self, now: Instant) -> Vec<String> {
        let is_due = |link: &Link| matches!(link.state, State::Apart(at) if at <= now);
        let due = self.by_uri.iter().filter(|(_, link)| is_due(link));
        due.map(|(uri, _)| uri.clone()).collect()
    }

    /// Begins to look for an interface that shows a document.
    pub(crate) fn open(&mut self, document: &Document) {
        let apart = State::Apart(Instant::now());
        let link = Link {
            version: 0,
            state: apart,
            is_told: false,
        };
        self.by_uri.insert(document.uri.clone(), link);
        self.connect(document);
    }

    /// Connects to the interface that shows a document, if there is one, and tells it the text.
    pub(crate) fn connect(&mut self, document: &Document) {
        let Some(link) = self.by_uri.get_mut(&document.uri) else {
            return;
        };
        link.state = State::Apart(Instant::now() + AGAIN);
        let text = document.text();
        if !document.is_scene || LONGEST < text.len() || has_lone_cr(text) {
            return;
        }
        let Ok((sender, mut receiver)) = link::connect(document.path()) else {
            return;
        };
        self.connections += 1;
        let number = self.connections;
        let (inbox, uri) = (self.inbox.clone(), document.uri.clone());
        // It ends with the connection.
        thread::spawn(move || {
            loop {
                let message = receiver.receive().ok().flatten();
                let message = message.as_ref().and_then(ToEditor::of_json);
                let is_last = message.is_none();
                let event = Event::Interface(uri.clone(), number, message);
                if inbox.send(event).is_err() || is_last {
                    return;
                }
            }
        });
        link.state = State::Connected(number, sender);
        self.tell_whole(document);
    }

    /// Tells the interface the whole text.
    pub(crate) fn tell_whole(&mut self, document: &Document) {
        let version = self
            .by_uri
            .get(&document.uri)
            .map_or(0, |link| link.version);
        let opening = Opening {
            editor: self.editor.clone(),
            version,
            text: document.text().to_owned(),
            can: self.can,
            follow: self.follow,
        };
        self.tell(&document.uri, &ToInterface::Open(opening));
    }

    /// Tells the interface a change of the text, which the document already has.
    pub(crate) fn change(&mut self, document: &Document, edit: Edit) {
        let Some(link) = self.by_uri.get_mut(&document.uri) else {
            return;
        };
        link.version += 1;
        let version = link.version;
        let placed = edit.placed();
        let text = document.text().as_bytes();
        let around = placed.start().saturating_sub(1)..text.len().min(placed.end() + 2);
        if text[around].contains(&b'\r') && has_lone_cr(document.text()) {
            // The texts would drift apart.
            self.close(&document.uri);
            return;
        }
        self.tell(&document.uri, &ToInterface::Change(version, vec![edit]));
    }

    /// Tells the interface that the file was saved.
    pub(crate) fn saved(&mut self, document: &Document) {
        let link = self.by_uri.get(&document.uri);
        if link.is_some_and(|link| matches!(link.state, State::Busy)) {
            self.connect(document);
        }
        self.tell(&document.uri, &ToInterface::Saved);
    }

    /// Ends the link of a document that was closed.
    pub(crate) fn close(&mut self, uri: &str) {
        self.tell(uri, &ToInterface::Close);
        self.by_uri.remove(uri);
    }

    /// Ends the links of all documents.
    pub(crate) fn close_all(&mut self) {
        let uris: Vec<_> = self.by_uri.keys().cloned().collect();
        for uri in &uris {
            self.close(uri);
        }
    }

    /// Tells the interface something, if there is one.
    pub(crate) fn tell(&mut self, uri: &str, message: &ToInterface) {
        if let Some(link) = self.by_uri.get_mut(uri)
            && let State::Connected(_, sender) = &mut link.state
            && sender.send(&message.to_json()).is_err()
        {
            link.state = State::Apart(Instant::now() + LATER);
        }
    }

    /// Whether a connection is that of a document, which it may have been before.
    pub(crate) fn is_present(&self, uri: &str, connection: u64) -> bool {
        let link = self.by_uri.get(uri);
        link.is_some_and(
            |link| matches!(link.state, State::Connected(number, _) if number == connection),
        )
    }

    /// Whether an interface shows a document.
    pub(crate) fn is_connected(&self, uri: &str) -> bool {
        let link = self.by_uri.get(uri);
        link.is_some_and(|link| matches!(link.state, State::Connected(..)))
    }

    /// The version of a document's text.
    pub(crate) fn version(&self, uri: &str) -> Option<u64> {
        self.by_uri.get(uri).map(|link| link.version)
    }

    /// Takes the end of a connection.
    pub(crate) fn left(&mut self, uri: &str) {
        if let Some(link) = self.by_uri.get_mut(uri) {
            link.state = State::Apart(Instant::now() + AGAIN);
        }
    }

    /// Leaves an interface that shows the buffer of another editor; returns whether the user is to be told.
    pub(crate) fn is_busy(&mut self, uri: &str) -> bool {
        let link = self.by_uri.get_mut(uri);
        link.is_some_and(|link| {
            link.state = State::Busy;
            !mem::replace(&mut link.is_told, true)
        })
    }
}

/// Whether a text has a CR that does not belong to CR LF. By the protocol it ends a line, but editors count
/// it as a character, so that edits would be made in other lines than they were meant for.
pub(super) fn has_lone_cr(text: &str) -> bool {
    let bytes = text.as_bytes();
    let is_lone = |at: usize| bytes.get(at + 1) != Some(&b'\n');
    text.match_indices('\r').any(|(at, _)| is_lone(at))
}

/// What the parameters of `initialize` say of the editor, its abilities and the user's wish.
pub(crate) fn of_client(parameters: &Value) -> (String, Abilities, Follow) {
    let name = parameters["clientInfo"]["name"].as_str();
    let capabilities = &parameters["capabilities"];
    let can = Abilities {
        edits: capabilities["workspace"]["applyEdit"] == true,
        shows: capabilities["window"]["showDocument"]["support"] == true,
    };
    let follow = parameters["initializationOptions"]["follow"].as_str();
    let follow = follow.and_then(Follow::named).unwrap_or_default();
    (short(name.unwrap_or("the editor")), can, follow)
}

/// The name of an editor's program rather than of the editor.
fn short(name: &str) -> String {
    let lower = name.to_lowercase();
    let known = [
        ("neovim", "nvim"),
        ("visual studio code", "code"),
        ("eglot", "emacs"),
        ("emacs", "emacs"),
        ("kak", "kak"),
    ];
    let known = known.iter().find(|(begin, _)| lower.starts_with(begin));
    let short = known.map_or(&*lower, |(_, short)| short);
    let plain = short.chars().filter(|c| !c.is_control());
    plain.take(16).collect()
}
