//! A scene that an editor has open while the interface shows it.

use serde_json::{Value, json};

use super::*;
use crate::editor::{Editor, uri};

/// An editor beside the interface, with `balls.ray` open.
struct Typist {
    editor: Editor,
    uri: String,
    text: String,
    version: u32,
}

impl Typist {
    fn open(place: &Place) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_halflight"));
        command.arg("lsp").current_dir(place.directory.path());
        command.env_clear().env("HOME", place.directory.path());
        let mut editor = Editor::start(command);
        let capabilities = json!({
            "workspace": { "applyEdit": true, "workspaceEdit": { "documentChanges": true } },
            "window": { "showDocument": { "support": true } },
        });
        let client = json!({ "name": "Neovim" });
        let parameters = json!({ "clientInfo": client, "capabilities": capabilities });
        editor.ask("initialize", &parameters);
        let uri = uri(&place.at("balls.ray"));
        let text = place.read("balls.ray");
        let document = json!({ "uri": uri, "languageId": "halflight", "version": 0, "text": text });
        editor.notify("textDocument/didOpen", &json!({ "textDocument": document }));
        Self {
            editor,
            uri,
            text,
            version: 0,
        }
    }

    /// Replaces the whole text.
    fn set(&mut self, text: String) {
        self.version += 1;
        let document = json!({ "uri": self.uri, "version": self.version });
        let changes = json!([{ "text": text }]);
        let parameters = json!({ "textDocument": document, "contentChanges": changes });
        self.editor.notify("textDocument/didChange", &parameters);
        self.text = text;
    }

    fn replace(&mut self, old: &str, new: &str) {
        assert!(self.text.contains(old), "{old}");
        self.set(self.text.replacen(old, new, 1));
    }

    fn notify(&mut self, method: &str) {
        let document = json!({ "uri": self.uri });
        self.editor
            .notify(method, &json!({ "textDocument": document }));
    }

    /// Waits for edits of the interface and makes them; none spans several lines.
    fn obey(&mut self) {
        let asked = self.editor.wait_for("workspace/applyEdit");
        let change = &asked["params"]["edit"]["documentChanges"][0];
        assert_eq!(change["textDocument"]["version"], self.version);
        let mut lines: Vec<_> = self.text.split('\n').map(str::to_owned).collect();
        let edits = change["edits"].as_array().expect("edits");
        for edit in edits.iter().rev() {
            let number = |end: &str, key: &str| {
                let number = edit["range"][end][key].as_u64().expect("a number");
                usize::try_from(number).expect("a small one")
            };
            let line = &mut lines[number("start", "line")];
            assert_eq!(edit["range"]["start"]["line"], edit["range"]["end"]["line"]);
            let columns = number("start", "character")..number("end", "character");
            line.replace_range(columns, edit["newText"].as_str().expect("a text"));
        }
        let answer = json!({ "applied": true });
        let id = &asked["id"];
        self.editor
            .send(&json!({ "jsonrpc": "2.0", "id": id, "result": answer }));
        self.set(lines.join("\n"));
    }
}

#[test]
fn the_picture_follows_a_buffer_and_edits_return_to_it() {
    let place = Place::new();
    let mut session = place.open();
    let mut editor = Typist::open(&place);
    session.wait_for("balls.ray ⇄ nvim");
    // Nothing is saved.
    editor.replace("0 1 0  0 0 0", "0 0 1  0 0 0");
    wait_for_colour(&mut session, BLUE);
    assert_eq!(place.read("balls.ray"), BALLS);

    // Errors are shown once the text rests, over the last picture.
    editor.replace("0 0 1  0 0 0", "0 x 1  0 0 0");
    session.wait_for("STALE");
    editor.replace("0 x 1  0 0 0", "0 0 1  0 0 0");
    wait_until_gone(&mut session, "STALE");

    session.send(RADIUS_TO_2);
    session.wait_for("[+]");
    editor.obey();
    wait_until_gone(&mut session, "[+]");
    assert!(editor.text.contains("sphere -1 0 0 2  "), "{}", editor.text);
    session.send("w");
    session.wait_for("save in nvim");
    session.send("u");
    session.wait_for("[+]");
    editor.obey();
    assert_eq!(
        editor.text,
        BALLS.replacen("0 1 0  0 0 0", "0 0 1  0 0 0", 1)
    );

    wait_until_gone(&mut session, "[+]");
    // The editor's cursor selects, and a key of the interface moves it.
    let position = json!({ "line": 4, "character": 3 });
    let place_of = json!({ "textDocument": { "uri": editor.uri }, "position": position });
    let highlights = editor
        .editor
        .ask("textDocument/documentHighlight", &place_of);
    assert_eq!(highlights, Value::Null);
    session.wait_for("▸ ● the green one");
    let start = json!({ "line": 3, "character": 0 });
    let range = json!({ "start": start, "end": start });
    let document = json!({ "uri": editor.uri });
    let asked =
        json!({ "textDocument": document, "range": range, "context": { "diagnostics": [] } });
    let actions = editor.editor.ask("textDocument/codeAction", &asked);
    assert_eq!(actions[0]["title"], "Show in Halflight", "{actions}");
    let command = &actions[0]["command"];
    editor.editor.ask("workspace/executeCommand", command);
    session.wait_for("▸ ● the red one");
    session.send("E");
    let shown = editor.editor.wait_for("window/showDocument");
    assert_eq!(shown["params"]["selection"]["start"]["line"], 3);

    // What is closed without being saved is discarded.
    editor.notify("textDocument/didClose");
    wait_for_colour(&mut session, GREEN);
    quit(session);
}

#[test]
fn a_killed_editor_leaves_its_text_as_unsaved_edits() {
    let place = Place::new();
    let mut editor = Typist::open(&place);
    // It finds an interface that is started later.
    let mut session = place.open();
    session.wait_for("⇄ nvim");
    editor.replace("0 1 0  0 0 0", "0 0 1  0 0 0");
    wait_for_colour(&mut session, BLUE);
    editor.editor.kill();
    session.wait_for("nvim ended without closing the scene");
    session.wait_for("balls.ray [+]");
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert!(place.read("balls.ray").contains("0 0 1  0 0 0"));
    quit(session);
    let sockets = place.at(".local/state/halflight").read_dir();
    let names = sockets.expect("a folder").flatten();
    let is_socket = |name: &std::ffi::OsString| name.to_string_lossy().contains(".socket");
    assert!(
        !names
            .map(|entry| entry.file_name())
            .any(|name| is_socket(&name))
    );
}

#[test]
fn a_second_editor_is_told_who_has_the_scene() {
    let place = Place::new();
    let mut session = place.open();
    let _first = Typist::open(&place);
    session.wait_for("⇄ nvim");
    let second = Typist::open(&place);
    let said = second.editor.wait_for("window/showMessage");
    let said = said["params"]["message"].as_str().expect("a message");
    assert!(said.contains("nvim"), "{said}");
    let mut doctor = Command::new(env!("CARGO_BIN_EXE_halflight"));
    let doctor = doctor.arg("doctor").stdin(Stdio::null()).env_clear();
    let found = doctor.env("HOME", place.directory.path()).output();
    let found = String::from_utf8(found.expect("it runs").stdout).expect("UTF-8");
    assert!(found.contains("balls.ray: open in nvim"), "{found}");
    session.send("q");
    session.end();
}
