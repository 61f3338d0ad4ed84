//! The two ends of a socket, and peers that are none.

use std::fs::{self, Permissions};
use std::io::Write;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::mpsc;

use tempfile::TempDir;
use text::{Edit, Span};

use super::listening::listen_at;
use super::stream::{connect_to, ends};
use super::*;

/// A scene and a folder for its socket.
struct Desk {
    folder: TempDir,
    scene: PathBuf,
}

impl Desk {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("a.ray");
        fs::write(&scene, "").expect("it is written");
        Self { folder, scene }
    }

    fn place(&self) -> Place {
        Place::within(self.folder.path(), &self.scene).expect("a place")
    }

    /// Listens; what is heard comes from the receiver.
    fn listen(&self) -> Option<(Listening, mpsc::Receiver<Heard>)> {
        let (sender, heard) = mpsc::channel();
        let hear = move |said| drop(sender.send(said));
        let listening = listen_at(self.place(), hear).expect("it can be listened to");
        Some((listening?, heard))
    }
}

fn edit(span: Span, text: &str) -> Edit {
    let text = text.to_owned();
    Edit { span, text }
}

/// Messages of each kind to the interface.
fn to_interface() -> Vec<ToInterface> {
    let opening = Opening {
        editor: "nvim".to_owned(),
        version: 3,
        text: "\u{FEFF}1\t\r\r\n\u{1F600}\u{2028}\"".to_owned(),
        can: Abilities {
            edits: true,
            shows: false,
        },
        follow: Follow::Saving,
    };
    let edits = vec![edit(Span::at(0), "a\n"), edit(Span::new(2, 7), "")];
    vec![
        ToInterface::Open(opening),
        ToInterface::Change(u64::MAX, edits),
        ToInterface::Saved,
        ToInterface::Close,
        ToInterface::Cursor(u32::MAX as usize),
        ToInterface::Answer(4, false),
        ToInterface::Who,
    ]
}

#[test]
fn messages_arrive_as_they_were_sent() {
    let desk = Desk::new();
    let (_listening, heard) = desk.listen().expect("nobody else listens");
    let (mut sender, mut receiver) = connect_to(&desk.place()).expect("it listens");
    let Ok(Heard::Came(1 | 0, mut back)) = heard.recv() else {
        panic!("it has come");
    };
    for message in to_interface() {
        sender.send(&message.to_json()).expect("it listens");
        let Ok(Heard::Said(_, said, _)) = heard.recv() else {
            panic!("{message:?}");
        };
        assert_eq!(said, message);
    }
    let edits = vec![edit(Span::new(1, 1), "é")];
    let span = Span::new(3, 9);
    let takes_focus = true;
    for message in [
        ToEditor::Edit(0, edits),
        ToEditor::Show { span, takes_focus },
        ToEditor::Whole,
        ToEditor::Busy("hx".to_owned()),
        ToEditor::Shown(Shown {
            scene: "/a.ray".to_owned(),
            editor: None,
        }),
    ] {
        back.send(&message.to_json()).expect("it is connected");
        let received = receiver.receive().expect("it is connected");
        let received = received.as_ref().and_then(ToEditor::of_json);
        assert_eq!(received, Some(message));
    }
    drop(back);
    assert_eq!(receiver.receive().expect("an orderly end"), None);
    assert!(matches!(heard.recv(), Ok(Heard::Left(_))));
}

#[test]
fn what_is_no_message_ends_the_connection() {
    let long = format!("{}\n", "[".repeat(1 << 20));
    for line in [
        "\n",
        "{}\n",
        "[1]\n",
        "{\"open\":{}}\n",
        "{\"saved\":{},\"close\":{}}\n",
        "{\"change\":{\"version\":1,\"edits\":[[2,1,\"\"]]}}\n",
        "{\"change\":{\"version\":1,\"edits\":[[3,4,\"\"],[0,1,\"\"]]}}\n",
        "{\"change\":{\"version\":-1,\"edits\":[]}}\n",
        "{\"cursor\":{\"at\":4294967296}}\n",
        "\u{7f}\u{0}\n",
        &long,
        // The peer ends within a line.
        "{\"saved\":{}",
    ] {
        let desk = Desk::new();
        let (_listening, heard) = desk.listen().expect("nobody else listens");
        let mut peer = UnixStream::connect(desk.place().path()).expect("it listens");
        peer.write_all(line.as_bytes()).expect("it listens");
        drop(peer);
        let shown: String = line.chars().take(60).collect();
        assert!(matches!(heard.recv(), Ok(Heard::Came(..))), "{shown}");
        assert!(matches!(heard.recv(), Ok(Heard::Left(_))), "{shown}");
    }
}

#[test]
fn a_flood_waits_until_it_is_handled() {
    let desk = Desk::new();
    let (_listening, heard) = desk.listen().expect("nobody else listens");
    let (mut sender, _receiver) = connect_to(&desk.place()).expect("it listens");
    let saved = ToInterface::Saved.to_json();
    // Nothing is handled: the socket fills up, and the sender gives up rather than wait.
    let sent = (0..100_000).take_while(|_| sender.send(&saved).is_ok());
    assert!(sent.count() < 100_000);
    let unhandled: Vec<_> = heard.try_iter().collect();
    assert!(unhandled.len() <= 1 + 256, "{}", unhandled.len());
}

#[test]
fn a_live_socket_is_kept_and_a_dead_one_replaced() {
    let desk = Desk::new();
    let first = desk.listen().expect("nobody else listens");
    assert!(desk.listen().is_none());
    let link = desk.folder.path().join("b.ray");
    symlink(&desk.scene, &link).expect("a link");
    let same = Place::within(desk.folder.path(), &link).expect("a place");
    assert_eq!(same.path(), desk.place().path());
    drop(first);
    assert!(!desk.place().path().exists());
    // One that was left behind, as by a program that was killed.
    drop(UnixListener::bind(desk.place().path()).expect("a socket"));
    assert!(desk.place().path().exists());
    let _second = desk.listen().expect("nobody listens there");
    connect_to(&desk.place()).expect("it listens");
}

#[test]
fn folders_that_others_can_write_to_are_refused() {
    let desk = Desk::new();
    let own = desk.folder.path().join("halflight");
    let refused = |words: &str| {
        let place = Place::within(desk.folder.path(), &desk.scene);
        let error = place.map(|_| ()).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    };
    fs::create_dir(&own).expect("a folder");
    fs::set_permissions(&own, Permissions::from_mode(0o777)).expect("it is ours");
    refused("is writable by its group or others");
    fs::remove_dir(&own).expect("it is empty");
    symlink(desk.folder.path(), &own).expect("a link");
    refused("link");
    fs::remove_file(&own).expect("it is ours");
    fs::write(&own, "").expect("it is written");
    refused("halflight");
}

/// Linux has a short path of a folder that is open.
#[test]
#[cfg(target_os = "linux")]
fn a_folder_may_have_a_long_path() {
    let desk = Desk::new();
    let deep = desk.folder.path().join("x".repeat(120));
    let place = || Place::within(&deep, &desk.scene).expect("a place");
    let _listening = listen_at(place(), drop).expect("a short path");
    connect_to(&place()).expect("it listens");
}

#[test]
fn both_ends_may_be_one_process() {
    let (one, other) = UnixStream::pair().expect("sockets");
    assert!(ends(one).is_ok() && ends(other).is_ok());
}
