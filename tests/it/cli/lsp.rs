//! The program as a language server.

use serde_json::{Value, json};

use super::Place;
use crate::editor::{Editor, uri};

/// Meshes are looked for beside the scene, as `check` does.
#[test]
fn an_editor_is_told_what_check_says() {
    let place = Place::new();
    place.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let mut editor = Editor::start(place.command("lsp"));
    let uri = uri(&place.at("a.xml"));
    let object =
        |name: &str| format!("<xml><scene><object type=\"obj\" name=\"{name}\"/></scene></xml>\n");
    editor.send(&json!({ "id": 1, "method": "initialize", "params": {} }));
    assert_eq!(
        editor.receive()["result"]["serverInfo"]["name"],
        "halflight"
    );
    for (name, warnings) in [("a.obj", 0), ("none.obj", 1)] {
        let document =
            json!({ "uri": uri, "languageId": "xml", "version": 1, "text": object(name) });
        let parameters = json!({ "textDocument": document });
        editor.send(&json!({ "method": "textDocument/didOpen", "params": parameters }));
        let said = editor.receive();
        let found = said["params"]["diagnostics"].as_array().expect("a list");
        let about_it = |found: &&Value| found["message"].to_string().contains("obj");
        assert_eq!(found.iter().filter(about_it).count(), warnings, "{said}");
    }
    editor.send(&json!({ "id": 2, "method": "shutdown" }));
    assert_eq!(editor.receive()["result"], Value::Null);
    editor.send(&json!({ "method": "exit" }));
    assert_eq!(editor.end(), (Some(0), String::new()));
}

#[test]
fn a_session_that_breaks_off_is_an_error() {
    let place = Place::new();
    let mut editor = Editor::start(place.command("lsp"));
    editor.send(&json!({ "id": 1, "method": "initialize", "params": {} }));
    editor.receive();
    let said = "halflight lsp: the editor disconnected without a `shutdown` request\n".to_owned();
    assert_eq!(editor.end(), (Some(1), said));
    let mut editor = Editor::start(place.command("lsp"));
    editor.send_bytes(b"GET / HTTP/1.1\r\n\r\n");
    let (code, said) = editor.end();
    assert_eq!(code, Some(1));
    assert!(said.contains("not `GET / HTTP/1.1`"), "{said}");
}

#[test]
fn editors_are_configured_by_lines_to_paste() {
    let place = Place::new();
    for editor in ["helix", "neovim", "vim", "emacs", "kakoune"] {
        let printed = place.run(&format!("lsp --print-config {editor}"));
        let lines = String::from_utf8(printed.stdout).expect("UTF-8");
        assert_eq!(printed.status.code(), Some(0));
        assert!(
            lines.contains("halflight") && lines.contains("lsp"),
            "{lines}"
        );
    }
    let refused = place.stderr("lsp --print-config ed", 2);
    assert!(
        refused.contains("helix, neovim, vim, emacs, kakoune"),
        "{refused}"
    );
}
