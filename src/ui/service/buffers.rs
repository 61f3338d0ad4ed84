//! The buffer that an editor has of the scene: the outside text while it is open, instead of the file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use link::{Follow, Heard, Listening, Opening, Sender, Shown, ToEditor, ToInterface};

use crate::msg::{BufferNews, Msg};

/// The maximum number of editors that are connected at a time.
const EDITORS: usize = 8;

/// The maximum length of an editor's name on screen, in characters.
const LONGEST_NAME: usize = 16;

/// The connections of editors that have the scene open.
#[derive(Debug)]
pub(crate) struct Buffers {
    follow: Follow,
    /// The path of the scene.
    scene: PathBuf,
    /// The number of scenes so far.
    pub(super) scenes: u64,
    /// The socket; dropping it ends it.
    listening: Option<Listening>,
    senders: BTreeMap<u64, Sender>,
    owner: Option<Owner>,
}

/// The editor whose buffer is the outside text: the first one that opened it.
#[derive(Debug)]
struct Owner {
    /// The number of its connection; `None` once that ended without the buffer having been closed.
    connection: Option<u64>,
    /// The buffer as it is now.
    buffer: Opening,
    /// What the file held when the buffer was opened or saved.
    in_file: Arc<String>,
    /// Whether the whole text was asked for, because a change does not fit.
    awaits_whole: bool,
}

/// The outside text.
#[derive(Clone, Debug)]
pub(crate) struct Outside {
    pub(crate) text: String,
    pub(crate) version: u64,
    /// If the editor is gone, what the file held when the buffer was opened or saved.
    pub(crate) in_file: Option<Arc<String>>,
}

impl Buffers {
    /// No buffers yet.
    pub(crate) fn new(follow: Follow) -> Self {
        Self {
            follow,
            scene: PathBuf::new(),
            scenes: 0,
            listening: None,
            senders: BTreeMap::new(),
            owner: None,
        }
    }

    /// Listens for editors of this scene from now on, instead of those of another one; returns what that
    /// changes, and why it is impossible, if so.
    pub(super) fn listen(
        &mut self,
        scene: &Path,
        hear: impl Fn(Heard) + Clone + Send + 'static,
    ) -> Vec<Msg> {
        scene.clone_into(&mut self.scene);
        self.scenes += 1;
        self.senders.clear();
        let former = self.owner.take();
        let mut news: Vec<_> = former
            .map(|_| Msg::Buffer(BufferNews::Closed))
            .into_iter()
            .collect();
        // The socket of the same scene has to be free.
        self.listening = None;
        match link::listen(scene, hear) {
            Ok(listening) => self.listening = listening,
            Err(error) => {
                let reason = format!("cannot listen for editors: {error}");
                news.push(Msg::Failed(reason));
            }
        }
        news
    }

    /// Listens if nobody does: another interface that showed the scene may have ended.
    pub(super) fn listen_again(&mut self, hear: impl Fn(Heard) + Clone + Send + 'static) {
        if self.listening.is_none() && !self.scene.as_os_str().is_empty() {
            // Why it is impossible was said when the scene was opened.
            self.listening = link::listen(&self.scene, hear).ok().flatten();
        }
    }

    /// The outside text, if an editor's buffer is followed.
    pub(crate) fn outside(&self) -> Option<Outside> {
        let owner = self.owner.as_ref().filter(|owner| self.follows(owner))?;
        let text = &owner.buffer.text;
        let is_left = owner.connection.is_none();
        Some(Outside {
            text: if is_left {
                as_in_file(text, &owner.in_file)
            } else {
                text.clone()
            },
            version: owner.buffer.version,
            in_file: is_left.then(|| Arc::clone(&owner.in_file)),
        })
    }

    /// Follows buffers at another time from now on; returns what that changes.
    pub(super) fn follow(&mut self, follow: Follow) -> Vec<Msg> {
        self.follow = follow;
        let owner = self.owner.as_ref();
        owner.map_or_else(Vec::new, |owner| self.opened(owner))
    }

    /// Forgets a buffer whose editor is gone; the file, which may have changed since, is read then.
    pub(crate) fn forget(&mut self) -> Option<Msg> {
        let forgotten = self.owner.take_if(|owner| owner.connection.is_none());
        forgotten.map(|_| Msg::FileChanged)
    }

    /// Sends a message to the editor.
    pub(super) fn tell(&mut self, message: &ToEditor) {
        let connection = self.owner.as_ref().and_then(|owner| owner.connection);
        if let Some(connection) = connection {
            self.send(connection, message);
        }
    }

    /// Takes what was heard; returns what it changes.
    pub(super) fn heard(&mut self, heard: Heard) -> Vec<Msg> {
        match heard {
            Heard::Came(connection, sender) => {
                if EDITORS <= self.senders.len() {
                    let owner = self.owner.as_ref().and_then(|owner| owner.connection);
                    let silent = self.senders.keys().find(|known| Some(**known) != owner);
                    let silent = silent.copied();
                    silent.and_then(|silent| self.senders.remove(&silent));
                }
                self.senders.insert(connection, sender);
                Vec::new()
            }
            Heard::Said(connection, message, _) => {
                let scene = self.scene.clone();
                let in_file = || file::read_text(&scene).unwrap_or_default();
                self.said(connection, message, in_file)
            }
            Heard::Left(connection) => {
                self.senders.remove(&connection);
                self.left(connection)
            }
        }
    }

    /// Takes a message of an editor; `in_file` reads the file.
    pub(crate) fn said(
        &mut self,
        connection: u64,
        message: ToInterface,
        in_file: impl FnOnce() -> String,
    ) -> Vec<Msg> {
        let other = self.owner.as_ref().filter(|_| message != ToInterface::Who);
        let other = other.filter(|owner| owner.connection.is_some_and(|owner| owner != connection));
        if let Some(owner) = other {
            let busy = ToEditor::Busy(owner.buffer.editor.clone());
            self.send(connection, &busy);
            self.senders.remove(&connection);
            return Vec::new();
        }
        match message {
            ToInterface::Who => {
                let shown = ToEditor::Shown(self.shown());
                self.send(connection, &shown);
                Vec::new()
            }
            ToInterface::Open(mut buffer) => {
                if self
                    .owner
                    .as_ref()
                    .is_some_and(|owner| owner.connection.is_none())
                {
                    // The text of an editor that is gone is not taken yet; this one tries again.
                    self.senders.remove(&connection);
                    return Vec::new();
                }
                buffer.editor = name_of(&buffer.editor);
                let was_open = self.owner.as_ref().is_some_and(|owner| owner.awaits_whole);
                let owner = Owner {
                    connection: Some(connection),
                    buffer,
                    in_file: match self.owner.take() {
                        Some(owner) => owner.in_file,
                        None => Arc::new(in_file()),
                    },
                    awaits_whole: false,
                };
                let news = if was_open {
                    vec![Msg::FileChanged]
                } else {
                    self.opened(&owner)
                };
                self.owner = Some(owner);
                news
            }
            // Of nobody's buffer, or of one that is kept for an editor that is gone.
            _ if !self.is_owner(connection) => Vec::new(),
            ToInterface::Change(version, edits) => {
                let Some(owner) = &mut self.owner else {
                    return Vec::new();
                };
                if owner.awaits_whole {
                    return Vec::new();
                }
                let buffer = &mut owner.buffer;
                let has = |edit: &text::Edit| buffer.text.get(edit.span.range()).is_some();
                if Some(version) != buffer.version.checked_add(1) || !edits.iter().all(has) {
                    owner.awaits_whole = true;
                    self.send(connection, &ToEditor::Whole);
                    return Vec::new();
                }
                text::apply(&mut buffer.text, &edits);
                buffer.version = version;
                vec![Msg::FileChanged]
            }
            ToInterface::Saved => {
                if let Some(owner) = &mut self.owner {
                    owner.in_file = Arc::new(in_file());
                }
                vec![Msg::Buffer(BufferNews::Saved)]
            }
            ToInterface::Close => {
                self.owner = None;
                vec![Msg::Buffer(BufferNews::Closed), Msg::FileChanged]
            }
            ToInterface::Cursor(at) => {
                let version = self.owner.as_ref().map(|owner| owner.buffer.version);
                let cursor = |version| Msg::Buffer(BufferNews::Cursor { at, version });
                version.map(cursor).into_iter().collect()
            }
            ToInterface::Answer(base, is_made) => {
                let version = self
                    .owner
                    .as_ref()
                    .map_or(base, |owner| owner.buffer.version);
                vec![Msg::Buffer(BufferNews::Answered {
                    base,
                    is_made,
                    version,
                })]
            }
        }
    }

    /// Takes the end of a connection. A buffer that was not closed remains until it is forgotten.
    pub(crate) fn left(&mut self, connection: u64) -> Vec<Msg> {
        let is_owner = |owner: &mut Owner| owner.connection == Some(connection);
        let Some(mut owner) = self.owner.take_if(is_owner) else {
            return Vec::new();
        };
        if !self.follows(&owner) {
            return vec![Msg::Buffer(BufferNews::Closed)];
        }
        owner.connection = None;
        self.owner = Some(owner);
        vec![Msg::Buffer(BufferNews::Left)]
    }

    /// What a buffer that is open from now on, or followed at another time, changes.
    fn opened(&self, owner: &Owner) -> Vec<Msg> {
        let opened = BufferNews::Opened {
            editor: owner.buffer.editor.clone(),
            can: owner.buffer.can,
            is_followed: self.follows(owner),
            is_changed: as_in_file(&owner.buffer.text, &owner.in_file) != *owner.in_file,
        };
        vec![Msg::Buffer(opened), Msg::FileChanged]
    }

    fn is_owner(&self, connection: u64) -> bool {
        let owner = self.owner.as_ref();
        owner.is_some_and(|owner| owner.connection == Some(connection))
    }

    fn follows(&self, owner: &Owner) -> bool {
        [self.follow, owner.buffer.follow] == [Follow::Typing; 2]
    }

    /// What is shown, and whose buffer.
    fn shown(&self) -> Shown {
        let scene = file::absolute(&self.scene);
        let owner = self.owner.as_ref();
        let owner = owner.filter(|owner| owner.connection.is_some());
        Shown {
            scene: scene.to_string_lossy().into_owned(),
            editor: owner.map(|owner| owner.buffer.editor.clone()),
        }
    }

    fn send(&mut self, connection: u64, message: &ToEditor) {
        let sender = self.senders.get_mut(&connection);
        if sender.is_some_and(|sender| sender.send(&message.to_json()).is_err()) {
            // Its end is heard too.
            self.senders.remove(&connection);
        }
    }
}

/// A text with the line ends and the byte order mark of the file, which editors may keep to themselves.
fn as_in_file(text: &str, in_file: &str) -> String {
    const MARK: char = '\u{FEFF}';
    let ends_lines = |end| in_file.matches(end).count();
    let has_crlf = 0 < ends_lines("\r\n") && ends_lines("\r\n") == ends_lines("\n");
    let mut text = if has_crlf && !text.contains('\r') {
        text.replace('\n', "\r\n")
    } else {
        text.to_owned()
    };
    if in_file.starts_with(MARK) && !text.starts_with(MARK) {
        text.insert(0, MARK);
    }
    text
}

/// The name of an editor as it can be shown.
fn name_of(editor: &str) -> String {
    let plain = editor.chars().filter(|c| !c.is_control());
    let name: String = plain.take(LONGEST_NAME).collect();
    match name.trim() {
        "" => "the editor".to_owned(),
        name => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_keep_the_line_ends_and_the_mark_of_the_file() {
        for (text, in_file, kept) in table! {
            "a\nb\n", "x\r\ny\r\n" => "a\r\nb\r\n";
            "a\r\nb", "x\r\n" => "a\r\nb";
            "a\nb", "x\r\ny\n" => "a\nb";
            "a\nb", "\u{FEFF}x\n" => "\u{FEFF}a\nb";
            "\u{FEFF}a", "\u{FEFF}x" => "\u{FEFF}a";
            "a\n", "" => "a\n";
        } {
            assert_eq!(as_in_file(text, in_file), kept);
        }
    }

    /// Messages of connections 1 and 2, in order, and the text that is read then.
    fn read_after(messages: &[(u64, Option<ToInterface>)]) -> Option<(String, bool)> {
        let mut buffers = Buffers::new(Follow::Typing);
        for (connection, message) in messages {
            match message {
                Some(message) => drop(buffers.said(*connection, message.clone(), String::new)),
                None => drop(buffers.left(*connection)),
            }
        }
        let outside = buffers.outside()?;
        Some((outside.text, outside.in_file.is_some()))
    }

    fn open(text: &str) -> ToInterface {
        ToInterface::Open(Opening {
            editor: "nvim".to_owned(),
            version: 7,
            text: text.to_owned(),
            can: link::Abilities::default(),
            follow: Follow::Typing,
        })
    }

    fn change(version: u64, span: text::Span, text: &str) -> ToInterface {
        let text = text.to_owned();
        ToInterface::Change(version, vec![text::Edit { span, text }])
    }

    #[test]
    fn a_text_is_that_of_the_first_editor_until_it_is_closed() {
        use ToInterface::{Close, Saved};
        let end = text::Span::at(1);
        let typed = || change(8, end, "b");
        for (messages, expected) in [
            (
                vec![(1, Some(open("a"))), (1, Some(typed()))],
                Some(("ab", false)),
            ),
            (
                vec![
                    (1, Some(open("a"))),
                    (2, Some(open("x"))),
                    (2, Some(typed())),
                ],
                Some(("a", false)),
            ),
            (vec![(2, Some(typed())), (2, Some(Saved))], None),
            (
                vec![(1, Some(open("a"))), (1, Some(Close)), (2, Some(open("x")))],
                Some(("x", false)),
            ),
            // Of an editor that is gone, nobody changes or replaces the text.
            (
                vec![(1, Some(open("a"))), (1, None), (2, Some(typed()))],
                Some(("a", true)),
            ),
            (
                vec![(1, Some(open("a"))), (1, None), (2, Some(Close))],
                Some(("a", true)),
            ),
            (
                vec![(1, Some(open("a"))), (1, None), (2, Some(open("x")))],
                Some(("a", true)),
            ),
            // What does not fit is not taken, nor what follows, until the whole text arrives.
            (
                vec![(1, Some(open("a"))), (1, Some(change(9, end, "b")))],
                Some(("a", false)),
            ),
            (
                vec![
                    (1, Some(open("a"))),
                    (1, Some(change(8, text::Span::at(2), ""))),
                ],
                Some(("a", false)),
            ),
            (
                vec![(1, Some(open("é"))), (1, Some(change(8, end, "b")))],
                Some(("é", false)),
            ),
            (
                vec![
                    (1, Some(open("a"))),
                    (1, Some(change(9, end, "b"))),
                    (1, Some(typed())),
                ],
                Some(("a", false)),
            ),
            (
                vec![
                    (1, Some(open("a"))),
                    (1, Some(change(9, end, "b"))),
                    (1, Some(open("c"))),
                ],
                Some(("c", false)),
            ),
        ] {
            let expected = expected.map(|(text, is_left)| (text.to_owned(), is_left));
            assert_eq!(read_after(&messages), expected, "{messages:?}");
        }
    }

    #[test]
    fn names_are_short_and_plain() {
        for (name, shown) in table! {
            "nvim" => "nvim";
            "\u{1b}[31m\n" => "[31m";
            "   " => "the editor";
            "a very long name of an editor" => "a very long name";
        } {
            assert_eq!(name_of(name), shown);
        }
    }
}
