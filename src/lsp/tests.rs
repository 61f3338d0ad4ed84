//! Sessions of a scripted client.

mod actions;
mod colours;
mod completion;
mod outline;

use std::io::{Cursor, Write};
use std::sync::{Arc, Mutex};

use serde_json::{Value, json};

use crate::{Error, serve, wire};

/// A stream that a test can read afterwards.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().expect("nothing panics").extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// What the server says to these messages, and how the session ends.
fn session(messages: &[Value]) -> (Vec<Value>, Result<(), Error>) {
    let mut input = Vec::new();
    for message in messages {
        wire::write(&mut input, message).expect("memory is there");
    }
    session_of(input)
}

fn session_of(input: Vec<u8>) -> (Vec<Value>, Result<(), Error>) {
    let output = Shared::default();
    let ending = serve(Cursor::new(input), output.clone());
    let output = output.0.lock().expect("nothing panics").clone();
    let mut stream = &*output;
    let mut said = Vec::new();
    while let Some(message) = wire::read(&mut stream).expect("only messages") {
        said.push(message);
    }
    (said, ending)
}

const URI: &str = "file:///none/a.test";

const TEXT: &str =
    "camera 0 0 9 0 0 0 0 1 0 45\npoint 0 0 5 1 1 1\n# a ball\ndiffuse .5 1 0\nsphere 0 0 0 1\n";

fn request(id: u32, method: &str, parameters: Value) -> Value {
    let mut message = note(method, parameters);
    message["id"] = id.into();
    message
}

fn note(method: &str, parameters: Value) -> Value {
    let mut message = json!({ "jsonrpc": "2.0", "method": method });
    message["params"] = parameters;
    message
}

fn begin(encodings: Value) -> Value {
    let mut parameters = json!({ "capabilities": { "general": {} } });
    parameters["capabilities"]["general"]["positionEncodings"] = encodings;
    request(0, "initialize", parameters)
}

fn open(uri: &str, id: &str, text: &str) -> Value {
    let document = json!({ "uri": uri, "languageId": id, "version": 1, "text": text });
    note("textDocument/didOpen", json!({ "textDocument": document }))
}

fn change(uri: &str, version: u32, changes: Value) -> Value {
    let mut parameters = json!({ "textDocument": { "uri": uri, "version": version } });
    parameters["contentChanges"] = changes;
    note("textDocument/didChange", parameters)
}

fn end() -> [Value; 2] {
    [
        request(99, "shutdown", Value::Null),
        note("exit", Value::Null),
    ]
}

/// What is said in a session in which these messages come after the beginning.
fn said(messages: Vec<Value>) -> Vec<Value> {
    let mut all = vec![begin(json!(["utf-16"])), note("initialized", json!({}))];
    all.extend(messages);
    all.extend(end());
    let (said, ending) = session(&all);
    assert!(ending.is_ok());
    said[1..said.len() - 1].to_vec()
}

/// The answer to a question about a text at a place.
fn asked((uri, text): (&str, &str), method: &str, more: Value) -> Value {
    let mut parameters = json!({ "textDocument": { "uri": uri } });
    if let Value::Object(more) = more {
        for (key, value) in more {
            parameters[key] = value;
        }
    }
    let all = said(vec![open(uri, "", text), request(7, method, parameters)]);
    let mut answers = all.into_iter().filter(|message| message["id"] == 7);
    answers.next().expect("an answer")
}

fn at(line: u32, character: u32) -> Value {
    json!({ "line": line, "character": character })
}

fn places(answer: &Value) -> Vec<String> {
    let answers = answer["result"].as_array().into_iter().flatten();
    let place = |found: &Value| {
        let start = &found["range"]["start"];
        format!("{}:{}", start["line"], start["character"])
    };
    answers.map(place).collect()
}

#[test]
fn sessions_end_as_the_protocol_says() {
    let [shutdown, exit] = end();
    let begin = begin(json!(["utf-16"]));
    for (messages, is_sound) in [
        (vec![begin.clone(), shutdown.clone(), exit.clone()], true),
        (vec![begin.clone(), exit.clone()], false),
        (vec![begin.clone(), shutdown.clone()], false),
        (vec![exit.clone()], false),
        (vec![], false),
    ] {
        let (_, ending) = session(&messages);
        assert_eq!(ending.is_ok(), is_sound, "{messages:?}");
    }
}

#[test]
fn requests_out_of_turn_are_refused_and_notes_ignored() {
    let hover = request(5, "textDocument/hover", json!({}));
    let [shutdown, exit] = end();
    let messages = [
        hover.clone(),
        open(URI, "", TEXT),
        begin(json!(["utf-8"])),
        begin(json!(["utf-8"])),
        hover.clone(),
        request(6, "workspace/nothing", json!({})),
        json!([1, { "id": 3 }]),
        json!({ "id": 4 }),
        note("$/cancelRequest", json!({ "id": 77 })),
        note(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": "file:///b" } }),
        ),
        shutdown,
        hover,
        exit,
    ];
    let (said, ending) = session(&messages);
    assert!(ending.is_ok());
    let codes: Vec<_> = said
        .iter()
        .map(|message| message["error"]["code"].clone())
        .collect();
    let expected = [
        json!(-32002),
        json!(null),
        json!(-32600),
        json!(-32602),
        json!(-32601),
    ];
    assert_eq!(codes[..5], expected);
    assert_eq!(
        said[1]["result"]["capabilities"]["positionEncoding"],
        "utf-8"
    );
    assert_eq!(codes[5..], [json!(null), json!(-32600)]);
}

#[test]
fn what_is_wrong_is_published() {
    for (uri, id, text, expected) in [
        (URI, "", TEXT, Some(vec![])),
        (
            URI,
            "",
            "camera 0 0 9 0 0 0 0 1 0 45\npoint 0 0 5 1 1 1\nsphere 0 0 é\u{1F600}x 1\n",
            Some(vec!["1 2:11"]),
        ),
        (
            URI,
            "",
            "pushTransform\nsphere 0 0 0 1\n",
            Some(vec!["3 0:0", "2 0:0"]),
        ),
        (
            "untitled:Untitled-1",
            "ray",
            "0 0 0\n0\n1 sphere",
            Some(vec!["1 1:0", "1 2:0"]),
        ),
        // No scenes, by content or name.
        ("file:///none/a.dat", "", "1 2 3\n4 5 6\n", Some(vec![])),
        (
            "file:///none/a.test",
            "",
            "package main\n\nfunc main() {\n\tpoint(1, 2)\n}\n",
            Some(vec![]),
        ),
        // Vim takes it for a configuration, as it begins with `#`.
        ("file:///none/a.test", "conf", TEXT, Some(vec![])),
        // A scene that is not whole yet.
        (
            "file:///none/a.xml",
            "xml",
            "<xml><scene><objct/></scene><camera></xml>",
            Some(vec!["1 0:36"]),
        ),
        (
            "file:///none/a.xml",
            "xml",
            "<project><modelVersion/></project>",
            Some(vec![]),
        ),
        ("file:///none/a.txt", "text", "sphere", None),
    ] {
        let published = said(vec![open(uri, id, text)]);
        let found = published.last().map(|message| {
            assert_eq!(message["method"], "textDocument/publishDiagnostics");
            assert_eq!(message["params"]["version"], 1);
            let found = message["params"]["diagnostics"].as_array().expect("a list");
            let found = found.iter().map(|found| {
                let start = &found["range"]["start"];
                format!(
                    "{} {}:{}",
                    found["severity"], start["line"], start["character"]
                )
            });
            found.collect::<Vec<_>>()
        });
        let expected = expected.map(|all| all.into_iter().map(str::to_owned).collect::<Vec<_>>());
        assert_eq!(found, expected, "{uri}: {text}");
    }
}

#[test]
fn changes_are_taken_in_order() {
    let replace = |start: Value, end: Value, text: &str| json!({ "range": { "start": start, "end": end }, "text": text });
    // The radius becomes 0, then 2; the error in between is never seen.
    let changes = json!([
        replace(at(4, 13), at(4, 14), "0"),
        replace(at(4, 13), at(4, 14), "2"),
        replace(at(0, 0), at(0, 0), "# \u{1F600}\n"),
    ]);
    let ask = json!({ "textDocument": { "uri": URI }, "position": at(5, 13) });
    let all = said(vec![
        open(URI, "", TEXT),
        change(URI, 2, changes),
        request(7, "textDocument/hover", ask.clone()),
        change(URI, 3, json!([{ "text": "sphere 0 0 0 1\n" }])),
        request(
            8,
            "textDocument/hover",
            json!({ "textDocument": { "uri": URI }, "position": at(0, 99) }),
        ),
        // One that makes no sense: the texts may differ from here on.
        change(
            URI,
            4,
            json!([{ "text": "x" }, { "range": "x", "text": "" }]),
        ),
        request(9, "textDocument/hover", ask),
    ]);
    let versions = all
        .iter()
        .filter(|message| message["method"] == "textDocument/publishDiagnostics");
    let versions: Vec<_> = versions
        .map(|message| message["params"]["version"].clone())
        .collect();
    assert_eq!(versions, [json!(1), json!(2), Value::Null]);
    let answer = |id: u32| {
        let found = all.iter().find(|message| message["id"] == id);
        found.expect("an answer")["result"]["contents"]["value"].to_string()
    };
    assert!(answer(7).contains("radius"), "{}", answer(7));
    assert!(answer(8).contains("radius"), "{}", answer(8));
    assert_eq!(answer(9), "null");
    assert!(
        all.iter()
            .any(|message| message["method"] == "window/showMessage")
    );
}

/// However often the text changes in the meantime.
#[test]
fn new_errors_wait_until_the_text_rests() {
    let word = |from: u32, text: &str| {
        let range = json!({ "start": at(4, 0), "end": at(4, from) });
        json!([{ "range": range, "text": text }])
    };
    let ask = json!({ "textDocument": { "uri": URI }, "position": at(3, 9) });
    let all = said(vec![
        open(URI, "", TEXT),
        change(URI, 2, word(6, "sphre")),
        request(7, "textDocument/hover", ask.clone()),
        change(
            URI,
            3,
            json!([{ "range": { "start": at(4, 13), "end": at(4, 13) }, "text": " " }]),
        ),
        request(8, "textDocument/hover", ask.clone()),
        change(URI, 4, word(5, "sphere")),
        request(9, "textDocument/hover", ask),
    ]);
    let published = all
        .iter()
        .filter(|message| message["method"] == "textDocument/publishDiagnostics");
    let versions: Vec<_> = published
        .map(|message| message["params"]["version"].clone())
        .collect();
    assert_eq!(versions, [json!(1), json!(4)]);
}

/// The text of a lost message is unknown, so that nothing is said of any text until it is opened again.
#[test]
fn a_message_that_is_not_json_ends_what_is_known() {
    let mut input = Vec::new();
    for message in [begin(json!(["utf-16"])), open(URI, "", TEXT)] {
        wire::write(&mut input, &message).expect("memory is there");
    }
    let lone = r#"{"method":"textDocument/didChange","params":{"text":"\ud83d"}}"#;
    input.extend(format!("Content-Length: {}\r\n\r\n{lone}", lone.len()).bytes());
    let ask = json!({ "textDocument": { "uri": URI }, "position": at(4, 13) });
    let [shutdown, exit] = end();
    for message in [request(7, "textDocument/hover", ask), shutdown, exit] {
        wire::write(&mut input, &message).expect("memory is there");
    }
    let (said, ending) = session_of(input);
    assert!(ending.is_ok());
    assert_eq!(said[2]["error"]["code"], -32700);
    assert_eq!(said[3]["params"], json!({ "uri": URI, "diagnostics": [] }));
    assert_eq!(said[4]["method"], "window/showMessage");
    assert_eq!(said[5]["result"], Value::Null);
}

#[test]
fn meanings_are_told() {
    let dat = "mat ID 7  1 0 0  0.2 0.8 0 1  0 0 1\nobj sphere ID 3 mat ID 7  0 0 0 1\n";
    let dat = ("file:///none/a.dat", dat);
    for (text, line, character, parts) in [
        (
            (URI, TEXT),
            4,
            13,
            &["object 1 (sphere)", "`radius`", "greater than 0"][..],
        ),
        (
            (URI, TEXT),
            3,
            9,
            &["material 1", "`diffuse red`", "`#80ff00`"],
        ),
        ((URI, TEXT), 0, 26, &["`fov`", "degrees"]),
        (
            (URI, TEXT),
            4,
            2,
            &["object 1 (sphere)", "`centre` The sphere's centre."],
        ),
        (dat, 1, 23, &["the ID of a material", "material 7"]),
    ] {
        let answer = asked(
            text,
            "textDocument/hover",
            json!({ "position": at(line, character) }),
        );
        let said = answer["result"]["contents"]["value"].to_string();
        for part in parts {
            assert!(said.contains(part), "{line}:{character} {part}: {said}");
        }
    }
    let empty = asked(
        (URI, "\n\nsphere 0 0 0 1"),
        "textDocument/hover",
        json!({ "position": at(0, 0) }),
    );
    assert_eq!(empty["result"], Value::Null);
}

#[test]
fn names_lead_to_their_definitions_and_uses() {
    let text = "mat ID 7  1 0 0  0.2 0.8 0 1  0 0 1\nobj sphere ID 3 mat ID 7  0 0 0 1\nobj sphere ID 4 mat ID 7  2 0 0 1\n";
    let dat = ("file:///none/a.dat", text);
    let here = json!({ "position": at(1, 23), "context": { "includeDeclaration": true } });
    let definition = asked(dat, "textDocument/definition", here.clone());
    assert_eq!(definition["result"]["range"]["start"], at(0, 7));
    assert_eq!(
        places(&asked(dat, "textDocument/references", here.clone())),
        ["0:7", "1:23", "2:23"]
    );
    assert_eq!(
        places(&asked(dat, "textDocument/documentHighlight", here)),
        ["0:7", "1:23", "2:23"]
    );
    // Numbers that happen to be equal are no IDs.
    for other in [at(0, 10), at(1, 26)] {
        let other = json!({ "position": other, "newName": "12" });
        assert_eq!(
            asked(dat, "textDocument/prepareRename", other.clone())["result"],
            Value::Null
        );
        assert!(asked(dat, "textDocument/rename", other)["error"].is_object());
    }
    let named =
        "<xml><scene><material name='a&amp;b c'/><object material='a&amp;b c'/></scene></xml>";
    let xml = ("file:///none/a.xml", named);
    for character in [28, 62] {
        let here = json!({ "position": at(0, character) });
        let found = asked(xml, "textDocument/documentHighlight", here);
        assert_eq!(places(&found), ["0:28", "0:58"]);
    }
    let there = json!({ "position": at(0, 7), "newName": "12" });
    let renamed = asked(dat, "textDocument/rename", there);
    let edits = renamed["result"]["changes"][dat.0]
        .as_array()
        .expect("edits");
    assert_eq!(edits.len(), 3);
    let taken = json!({ "position": at(1, 14), "newName": "4" });
    let refused = asked(dat, "textDocument/rename", taken);
    assert!(
        refused["error"]["message"]
            .to_string()
            .contains("already exists"),
        "{refused}"
    );
    let known = asked(
        dat,
        "textDocument/completion",
        json!({ "position": at(1, 24) }),
    );
    assert_eq!(known["result"][0]["label"], "7");
}

#[test]
fn editors_get_symbols_folds_hints_colours_and_tokens() {
    let ask = |method: &str, more: Value| asked((URI, TEXT), method, more)["result"].clone();
    let symbols = ask("textDocument/documentSymbol", json!({}));
    let names = symbols.as_array().expect("a list").iter();
    let names: Vec<_> = names
        .map(|symbol| symbol["name"].as_str().unwrap_or_default())
        .collect();
    assert_eq!(
        names,
        ["view", "light 1", "material 1", "object 1 (sphere)"]
    );
    let all = json!({ "start": at(0, 0), "end": at(9, 0) });
    let hints = ask("textDocument/inlayHint", json!({ "range": all }));
    let hints = hints.as_array().expect("a list").iter();
    let labels: Vec<_> = hints
        .map(|hint| hint["label"].as_str().unwrap_or_default())
        .collect();
    let view = ["from:", "at:", "up:", "fov:"];
    assert_eq!(labels[..4], view);
    assert!(labels.ends_with(&["centre:", "radius:"]), "{labels:?}");
    let colours = asked((URI, TEXT), "textDocument/documentColor", json!({}));
    assert_eq!(places(&colours), ["1:12", "3:8"]);
    let bright = TEXT.replace("1 1 1\n", "1 9 1\n");
    let colours = asked((URI, &bright), "textDocument/documentColor", json!({}));
    assert_eq!(places(&colours), ["3:8"]);
    let colour = json!({ "red": 0.25, "green": 0.1239, "blue": 1.0, "alpha": 1 });
    let range = json!({ "start": at(3, 8), "end": at(3, 14) });
    let spelled = ask(
        "textDocument/colorPresentation",
        json!({ "range": range, "color": colour }),
    );
    assert_eq!(spelled[0]["textEdit"]["newText"], ".25 0.124 1");
    let tokens = ask("textDocument/semanticTokens/full", json!({}));
    let data = tokens["data"].as_array().expect("a list");
    assert_eq!(
        data[..10],
        [0, 0, 6, 2, 0, 0, 7, 1, 1, 0].map(|number| json!(number))
    );
    assert_eq!(data.len() % 5, 0);
    let folds = asked(
        (
            "file:///none/a.ray",
            "0 0 0\n0\n1\nsphere 0 0 0\n1 0 0 0\n.5 .5 .5 0 0 0 1 0 0 1\n",
        ),
        "textDocument/foldingRange",
        json!({}),
    );
    assert_eq!(folds["result"][0]["startLine"], 3);
}
