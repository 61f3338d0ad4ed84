//! The session with one editor.

mod hearing;
mod links;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use language::Language;
use links::Links;
use serde_json::{Value, json};
use text::{Findings, Span};

use crate::answers::{
    actions, colours, completion, diagnostics, hints, hover, names, outline, tokens,
};
use crate::document::{Document, LONGEST};
use crate::positions::Encoding;
use crate::{Event, uri, wire};

/// How long a text must be unchanged before new errors are shown: most are unfinished words.
pub(crate) const PATIENCE: Duration = Duration::from_millis(200);

/// The same of a text whose lowering takes about a second, in which the interface would have to wait for the
/// next change.
const LONG_PATIENCE: Duration = Duration::from_secs(2);

/// Said of a text that no interface follows.
const LONE_CR: &str = "a CR that is not part of CR LF ends a line for some editors only: the picture follows this text \
                       when it is saved";

/// Codes of JSON-RPC 2.0 and of the protocol.
const PARSE_ERROR: i32 = -32700;
const INVALID_REQUEST: i32 = -32600;
const UNKNOWN_METHOD: i32 = -32601;
const INVALID_PARAMETERS: i32 = -32602;
const NOT_INITIALISED: i32 = -32002;
const REQUEST_FAILED: i32 = -32803;
const CANCELLED: i32 = -32800;

/// Why a request failed: a code and a message.
struct Refusal(i32, String);

/// Whether the session goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Next {
    /// It does.
    Message,
    /// The client ended it, after it asked to.
    End,
    /// The client ended it without asking.
    Quit,
}

/// A server with its open documents.
pub(crate) struct Server<W> {
    output: W,
    state: State,
    encoding: Encoding,
    /// By their URIs.
    documents: BTreeMap<String, Document>,
    /// The documents whose errors are not shown yet, and when they are.
    due: BTreeMap<String, Instant>,
    /// The documents that have changed since they were read.
    changed: BTreeSet<String>,
    links: Links,
    /// Whether the editor applies edits of versions of documents.
    has_versioned_edits: bool,
    /// The number of requests to the editor so far.
    requests: u64,
    /// The edits that the editor was asked for, by the numbers of the requests: the document and the
    /// version of its text.
    asked: BTreeMap<u64, (String, u64)>,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Begun,
    Running,
    ShutDown,
}

impl<W: Write> Server<W> {
    /// A server before the first message; links put what they hear into `inbox`.
    pub(crate) fn new(output: W, inbox: mpsc::Sender<Event>) -> Self {
        Self {
            output,
            state: State::Begun,
            encoding: Encoding::default(),
            documents: BTreeMap::new(),
            due: BTreeMap::new(),
            changed: BTreeSet::new(),
            links: Links::new(inbox),
            has_versioned_edits: false,
            requests: 0,
            asked: BTreeMap::new(),
        }
    }

    /// When the next document is due.
    pub(crate) fn next_due(&self) -> Option<Instant> {
        let due = self.due.values().min().copied();
        due.into_iter().chain(self.links.next_due()).min()
    }

    /// Publishes the documents that are due, and looks for the interfaces that are.
    pub(crate) fn do_due(&mut self, now: Instant) -> io::Result<()> {
        for uri in self.links.due(now) {
            if let Some(document) = self.documents.get(&uri) {
                self.links.connect(document);
            }
        }
        let is_due = |(uri, at): (&String, &Instant)| (*at <= now).then(|| uri.clone());
        let due: Vec<_> = self.due.iter().filter_map(is_due).collect();
        due.iter().try_for_each(|uri| self.publish(uri))
    }

    /// Handles a message from the client.
    pub(crate) fn take(&mut self, message: &Value) -> io::Result<Next> {
        if message.is_null() {
            self.lose()?;
        }
        let method = message.get("method").and_then(Value::as_str);
        let parameters = message.get("params").unwrap_or(&Value::Null);
        match (method, message.get("id")) {
            (Some(method), Some(id)) => {
                self.settle()?;
                self.note_cursor(method, parameters);
                let answer = self.answer(method, parameters);
                self.respond(id, answer)?;
            }
            (Some("exit"), None) if self.state == State::ShutDown => return Ok(Next::End),
            (Some("exit"), None) => return Ok(Next::Quit),
            (Some(method), None) if self.state == State::Running => {
                self.notification(method, parameters)?;
            }
            (None, Some(id)) => self.answered(id, message),
            // Notifications before `initialize`, and anything else.
            _ => {}
        }
        Ok(Next::Message)
    }

    /// Answers a request that is cancelled.
    pub(crate) fn cancel(&mut self, id: &Value) -> io::Result<()> {
        let reason = "cancelled by the editor".to_owned();
        self.respond(id, Err(Refusal(CANCELLED, reason)))
    }

    fn respond(&mut self, id: &Value, answer: Result<Value, Refusal>) -> io::Result<()> {
        let answer = match answer {
            Ok(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
            Err(Refusal(code, message)) => {
                let error = json!({ "code": code, "message": message });
                json!({ "jsonrpc": "2.0", "id": id, "error": error })
            }
        };
        wire::write(&mut self.output, &answer)
    }

    /// Handles a notification. An unknown or malformed one has no effect.
    fn notification(&mut self, method: &str, parameters: &Value) -> io::Result<()> {
        let document = &parameters["textDocument"];
        let Some(uri) = document["uri"].as_str() else {
            return Ok(());
        };
        match method {
            "textDocument/didOpen" => {
                let words = ["languageId", "text"].map(|key| document[key].as_str());
                let [Some(id), Some(text)] = words else {
                    return Ok(());
                };
                let file = file_of(uri, id).filter(|_| text.len() <= LONGEST);
                let Some(file) = file else {
                    return Ok(());
                };
                let text = text.to_owned();
                let mut opened = Document::new(uri.to_owned(), file, text, self.encoding);
                opened.version = document["version"].clone();
                self.links.open(&opened);
                let is_apart = opened.is_scene && links::has_lone_cr(opened.text());
                self.documents.insert(uri.to_owned(), opened);
                self.publish(uri)?;
                if is_apart {
                    return self.show(2, LONE_CR);
                }
                Ok(())
            }
            "textDocument/didChange" => self.change(uri, document, parameters),
            "textDocument/didSave" => {
                // Files that the text names may have changed.
                self.changed.remove(uri);
                if let Some(document) = self.documents.get_mut(uri) {
                    document.lower();
                    self.links.saved(document);
                }
                self.publish(uri)
            }
            "textDocument/didClose" => self.close(uri),
            _ => Ok(()),
        }
    }

    fn change(&mut self, uri: &str, named: &Value, parameters: &Value) -> io::Result<()> {
        let Some(document) = self.documents.get_mut(uri) else {
            return Ok(());
        };
        let changes = parameters["contentChanges"].as_array();
        let Some(Ok(edit)) = changes.map(|changes| document.change(changes)) else {
            self.close(uri)?;
            return self.complain(&format!("received an invalid change of {uri}; reopen it"));
        };
        document.version = named["version"].clone();
        if document.is_long() {
            // What is due waits until the text rests.
            self.due.remove(uri);
        }
        if let Some(edit) = edit {
            self.links.change(document, edit);
        }
        self.changed.insert(uri.to_owned());
        Ok(())
    }

    /// Lowers the texts that have changed. Findings are published at once if all of them are shown already;
    /// new ones may come from an unfinished word.
    pub(crate) fn settle(&mut self) -> io::Result<()> {
        for uri in mem::take(&mut self.changed) {
            let Some(document) = self.documents.get_mut(&uri) else {
                continue;
            };
            if document.is_long() {
                let due = Instant::now() + LONG_PATIENCE;
                self.due.entry(uri.clone()).or_insert(due);
                self.changed.insert(uri);
                continue;
            }
            document.lower();
            if messages(&document.findings).all(|message| document.shown.contains(&message)) {
                self.publish(&uri)?;
            } else {
                self.due.insert(uri, Instant::now() + PATIENCE);
            }
        }
        Ok(())
    }

    /// Forgets a document.
    fn close(&mut self, uri: &str) -> io::Result<()> {
        self.due.remove(uri);
        self.links.close(uri);
        match self.documents.remove(uri) {
            Some(_) => {
                let none = json!({ "uri": uri, "diagnostics": [] });
                self.say("textDocument/publishDiagnostics", &none)
            }
            None => Ok(()),
        }
    }

    /// Handles a message that cannot be parsed: from here on the texts may differ from the editor's.
    fn lose(&mut self) -> io::Result<()> {
        let error = json!({ "code": PARSE_ERROR, "message": "not JSON" });
        let answer = json!({ "jsonrpc": "2.0", "id": null, "error": error });
        wire::write(&mut self.output, &answer)?;
        for uri in self.documents.keys().cloned().collect::<Vec<_>>() {
            self.close(&uri)?;
        }
        self.complain("received a message that is not JSON; reopen the scenes")
    }

    fn complain(&mut self, message: &str) -> io::Result<()> {
        self.show(1, message)
    }

    /// Shows a message of this type: 1 is an error, 2 a warning, 3 information.
    fn show(&mut self, kind: u8, message: &str) -> io::Result<()> {
        let message = format!("halflight: {message}");
        self.say(
            "window/showMessage",
            &json!({ "type": kind, "message": message }),
        )
    }

    /// Shows what is wrong with a document.
    fn publish(&mut self, uri: &str) -> io::Result<()> {
        self.due.remove(uri);
        let has_changed = self.changed.remove(uri);
        match self.documents.get_mut(uri) {
            Some(document) => {
                if has_changed {
                    document.lower();
                }
                document.shown = messages(&document.findings).collect();
                let found = diagnostics::published(document);
                self.say("textDocument/publishDiagnostics", &found)
            }
            None => Ok(()),
        }
    }

    fn say(&mut self, method: &str, parameters: &Value) -> io::Result<()> {
        let message = json!({ "jsonrpc": "2.0", "method": method, "params": parameters });
        wire::write(&mut self.output, &message)
    }

    fn answer(&mut self, method: &str, parameters: &Value) -> Result<Value, Refusal> {
        match (method, self.state) {
            ("initialize", State::Begun) => {
                let known = &parameters["capabilities"]["general"]["positionEncodings"];
                self.encoding = Encoding::of_client(known);
                let changes = &parameters["capabilities"]["workspace"]["workspaceEdit"];
                self.has_versioned_edits = changes["documentChanges"] == true;
                let (editor, can, follow) = links::of_client(parameters);
                (self.links.editor, self.links.can, self.links.follow) = (editor, can, follow);
                self.state = State::Running;
                Ok(capabilities(self.encoding))
            }
            ("shutdown", State::Running) => {
                // Editors that quit do not close each document.
                self.links.close_all();
                self.state = State::ShutDown;
                Ok(Value::Null)
            }
            (_, State::Begun) => {
                let reason = "the first request must be initialize".to_owned();
                Err(Refusal(NOT_INITIALISED, reason))
            }
            ("initialize", _) | (_, State::ShutDown) => {
                let reason = format!("{method} is not allowed now");
                Err(Refusal(INVALID_REQUEST, reason))
            }
            ("workspace/executeCommand", State::Running) => {
                if self.execute(parameters) {
                    return Ok(Value::Null);
                }
                let reason = format!("{method}: the command or its place is unknown");
                Err(Refusal(INVALID_PARAMETERS, reason))
            }
            ("textDocument/codeAction", State::Running) => {
                let show = self.action_to_show(parameters);
                let mut actions = self.answer_about(method, parameters)?;
                if let (Some(actions), Some(show)) = (actions.as_array_mut(), show) {
                    actions.push(show);
                }
                Ok(actions)
            }
            (_, State::Running) => self.answer_about(method, parameters),
        }
    }

    /// Answers a question about a document: null about one that is no scene or too long.
    fn answer_about(&self, method: &str, parameters: &Value) -> Result<Value, Refusal> {
        let missing = |what: &str| {
            Refusal(
                INVALID_PARAMETERS,
                format!("{method}: {what} is missing or invalid"),
            )
        };
        let with = |answer: &dyn Fn(&Document) -> Result<Value, Refusal>| {
            let uri = parameters["textDocument"]["uri"].as_str();
            let uri = uri.ok_or_else(|| missing("textDocument.uri"))?;
            let document = self.documents.get(uri).filter(|known| known.is_served());
            document.map_or(Ok(Value::Null), answer)
        };
        let all = |answer: fn(&Document) -> Value| with(&|document| Ok(answer(document)));
        let at = |answer: &dyn Fn(&Document, usize) -> Result<Value, Refusal>| {
            with(&|document| {
                let at = document.offset(&parameters["position"]);
                answer(document, at.ok_or_else(|| missing("position"))?)
            })
        };
        let within = |answer: &dyn Fn(&Document, Span) -> Value| {
            with(&|document| {
                let range = document.span(&parameters["range"]);
                Ok(answer(document, range.ok_or_else(|| missing("range"))?))
            })
        };
        match method {
            "textDocument/hover" => at(&|document, at| Ok(hover::at(document, at))),
            "textDocument/definition" => at(&|document, at| Ok(names::definition(document, at))),
            "textDocument/references" => at(&|document, at| {
                let with_definition = &parameters["context"]["includeDeclaration"];
                Ok(names::references(document, at, *with_definition == true))
            }),
            "textDocument/documentHighlight" => {
                at(&|document, at| Ok(names::highlights(document, at)))
            }
            "textDocument/prepareRename" => at(&|document, at| Ok(names::renamed(document, at))),
            "textDocument/rename" => at(&|document, at| {
                let name = parameters["newName"].as_str();
                let renamed = names::rename(document, at, name.ok_or_else(|| missing("newName"))?);
                renamed.map_err(|reason| Refusal(REQUEST_FAILED, reason))
            }),
            "textDocument/completion" => at(&|document, at| Ok(completion::at(document, at))),
            "textDocument/codeAction" => {
                within(&|document, range| actions::within(document, range, &parameters["context"]))
            }
            "textDocument/documentSymbol" => all(outline::symbols),
            "textDocument/foldingRange" => all(outline::folds),
            "textDocument/documentColor" => all(colours::all),
            "textDocument/semanticTokens/full" => all(tokens::all),
            "textDocument/semanticTokens/range" => within(&tokens::within),
            "textDocument/inlayHint" => within(&hints::within),
            "textDocument/colorPresentation" => within(&|document, range| {
                colours::presentation(document, range, &parameters["color"])
            }),
            _ => {
                let reason = format!("{method} is not supported");
                Err(Refusal(UNKNOWN_METHOD, reason))
            }
        }
    }
}

/// What is wrong, in words.
fn messages(findings: &Findings) -> impl Iterator<Item = String> {
    findings.iter().map(|found| found.message.clone())
}

/// The file of a URI and its language, by its name or, if it has none yet, by the editor's word for the
/// language.
fn file_of(uri: &str, id: &str) -> Option<(PathBuf, Language)> {
    let path = uri::path(uri).unwrap_or_else(|| Path::new(uri).to_owned());
    let by_name = Language::of_path(&path).ok();
    let language = by_name.or_else(|| Language::of_extension(id))?;
    Some((path, language))
}

/// The answer to `initialize`.
fn capabilities(encoding: Encoding) -> Value {
    json!({
        "serverInfo": { "name": "halflight", "version": env!("CARGO_PKG_VERSION") },
        "capabilities": {
            "positionEncoding": encoding.name(),
            "textDocumentSync": { "openClose": true, "change": 2, "save": {} },
            "hoverProvider": true,
            "definitionProvider": true,
            "referencesProvider": true,
            "documentHighlightProvider": true,
            "renameProvider": { "prepareProvider": true },
            "completionProvider": { "triggerCharacters": [" ", "\"", "<", "/"] },
            "codeActionProvider": { "codeActionKinds": [actions::KIND, ""] },
            "executeCommandProvider": { "commands": [hearing::SHOW] },
            "documentSymbolProvider": true,
            "foldingRangeProvider": true,
            "inlayHintProvider": true,
            "colorProvider": true,
            "semanticTokensProvider": {
                "legend": { "tokenTypes": tokens::TYPES, "tokenModifiers": [] },
                "range": true,
                "full": true,
            },
        },
    })
}
