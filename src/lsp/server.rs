//! The session with one editor.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use language::Language;
use serde_json::{Value, json};
use text::Span;

use crate::answers::{colours, completion, diagnostics, hints, hover, names, outline, tokens};
use crate::document::Document;
use crate::positions::Encoding;
use crate::{uri, wire};

/// How long a text must be unchanged before new errors are shown: most are unfinished words.
pub(crate) const PATIENCE: Duration = Duration::from_millis(200);

/// Codes of JSON-RPC 2.0 and of the protocol.
const INVALID_REQUEST: i32 = -32600;
const UNKNOWN_METHOD: i32 = -32601;
const INVALID_PARAMETERS: i32 = -32602;
const NOT_INITIALISED: i32 = -32002;
const REQUEST_FAILED: i32 = -32803;

/// Why a request has no answer.
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
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Begun,
    Running,
    ShutDown,
}

impl<W: Write> Server<W> {
    pub(crate) fn new(output: W) -> Self {
        Self {
            output,
            state: State::Begun,
            encoding: Encoding::default(),
            documents: BTreeMap::new(),
            due: BTreeMap::new(),
        }
    }

    /// When something is due without a message.
    pub(crate) fn next_due(&self) -> Option<Instant> {
        self.due.values().min().copied()
    }

    /// Does what is due.
    pub(crate) fn do_due(&mut self, now: Instant) -> io::Result<()> {
        let is_due = |(uri, at): (&String, &Instant)| (*at <= now).then(|| uri.clone());
        let due: Vec<_> = self.due.iter().filter_map(is_due).collect();
        due.iter().try_for_each(|uri| self.publish(uri))
    }

    /// Takes a message of the client's.
    pub(crate) fn take(&mut self, message: &Value) -> io::Result<Next> {
        let method = message.get("method").and_then(Value::as_str);
        let parameters = message.get("params").unwrap_or(&Value::Null);
        match (method, message.get("id")) {
            (Some(method), Some(id)) => {
                let answer = self.answer(method, parameters);
                let answer = match answer {
                    Ok(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
                    Err(Refusal(code, message)) => {
                        let error = json!({ "code": code, "message": message });
                        json!({ "jsonrpc": "2.0", "id": id, "error": error })
                    }
                };
                wire::write(&mut self.output, &answer)?;
            }
            (Some("exit"), None) if self.state == State::ShutDown => return Ok(Next::End),
            (Some("exit"), None) => return Ok(Next::Quit),
            (Some(method), None) if self.state == State::Running => {
                self.note(method, parameters)?
            }
            // Notes out of turn, answers to nothing, and what is no message.
            _ => {}
        }
        Ok(Next::Message)
    }

    /// Takes what needs no answer. What is unknown or makes no sense has no effect.
    fn note(&mut self, method: &str, parameters: &Value) -> io::Result<()> {
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
                let Some(file) = file_of(uri, id) else {
                    return Ok(());
                };
                let text = text.to_owned();
                let mut opened = Document::new(uri.to_owned(), file, text, self.encoding);
                opened.version = document["version"].clone();
                self.documents.insert(uri.to_owned(), opened);
                self.publish(uri)
            }
            "textDocument/didChange" => self.change(uri, document, parameters),
            "textDocument/didSave" => {
                // Files that the text names may have changed.
                self.documents.get_mut(uri).map(Document::lower);
                self.publish(uri)
            }
            "textDocument/didClose" => {
                self.due.remove(uri);
                let Some(closed) = self.documents.remove(uri) else {
                    return Ok(());
                };
                let none = json!({ "uri": closed.uri, "diagnostics": [] });
                self.say("textDocument/publishDiagnostics", &none)
            }
            _ => Ok(()),
        }
    }

    fn change(&mut self, uri: &str, named: &Value, parameters: &Value) -> io::Result<()> {
        let Some(document) = self.documents.get_mut(uri) else {
            return Ok(());
        };
        let changes = parameters["contentChanges"].as_array();
        let changes = changes.map_or(&[][..], Vec::as_slice);
        // A change that cannot be placed would let the texts differ from here on.
        let mut all = changes.iter();
        if !all.all(|change| document.change(change)) {
            let message = format!("halflight: a change of {uri} makes no sense; open it again");
            let parameters = json!({ "type": 1, "message": message });
            return self.say("window/showMessage", &parameters);
        }
        document.version = named["version"].clone();
        document.lower();
        if document.findings.errors() == 0 {
            return self.publish(uri);
        }
        self.due.insert(uri.to_owned(), Instant::now() + PATIENCE);
        Ok(())
    }

    /// Shows what is wrong with a document.
    fn publish(&mut self, uri: &str) -> io::Result<()> {
        self.due.remove(uri);
        match self.documents.get(uri) {
            Some(document) => {
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
                self.state = State::Running;
                Ok(capabilities(self.encoding))
            }
            ("shutdown", State::Running) => {
                self.state = State::ShutDown;
                Ok(Value::Null)
            }
            (_, State::Begun) => {
                let reason = "the first request is initialize".to_owned();
                Err(Refusal(NOT_INITIALISED, reason))
            }
            ("initialize", _) | (_, State::ShutDown) => {
                let reason = format!("{method} is out of turn");
                Err(Refusal(INVALID_REQUEST, reason))
            }
            (_, State::Running) => self.answer_about(method, parameters),
        }
    }

    /// Answers a question about a document.
    fn answer_about(&self, method: &str, parameters: &Value) -> Result<Value, Refusal> {
        if !QUESTIONS.contains(&method) {
            let reason = format!("{method} is not answered");
            return Err(Refusal(UNKNOWN_METHOD, reason));
        }
        let missing = |what: &str| Refusal(INVALID_PARAMETERS, format!("{method}: no {what}"));
        let uri = parameters["textDocument"]["uri"].as_str();
        let uri = uri.ok_or_else(|| missing("textDocument.uri"))?;
        let Some(document) = self.documents.get(uri).filter(|known| known.is_served()) else {
            return Ok(Value::Null);
        };
        let at = || {
            document
                .offset(&parameters["position"])
                .ok_or_else(|| missing("position"))
        };
        let range = || {
            document
                .span(&parameters["range"])
                .ok_or_else(|| missing("range"))
        };
        Ok(match method {
            "textDocument/hover" => hover::at(document, at()?),
            "textDocument/definition" => names::definition(document, at()?),
            "textDocument/references" => {
                let with_definition = &parameters["context"]["includeDeclaration"];
                names::references(document, at()?, *with_definition == true)
            }
            "textDocument/documentHighlight" => names::highlights(document, at()?),
            "textDocument/rename" => {
                let name = parameters["newName"]
                    .as_str()
                    .ok_or_else(|| missing("newName"))?;
                let renamed = names::rename(document, at()?, name);
                renamed.map_err(|reason| Refusal(REQUEST_FAILED, reason))?
            }
            "textDocument/completion" => completion::at(document, at()?),
            "textDocument/documentSymbol" => outline::symbols(document),
            "textDocument/foldingRange" => outline::folds(document),
            "textDocument/inlayHint" => hints::within(document, range()?),
            "textDocument/documentColor" => colours::all(document),
            "textDocument/colorPresentation" => {
                colours::presentation(document, range()?, &parameters["color"])
            }
            "textDocument/semanticTokens/range" => tokens::within(document, range()?),
            _ => tokens::within(document, Span::new(0, document.text().len())),
        })
    }
}

/// The questions that are answered about a document.
const QUESTIONS: [&str; 13] = [
    "textDocument/hover",
    "textDocument/definition",
    "textDocument/references",
    "textDocument/documentHighlight",
    "textDocument/rename",
    "textDocument/completion",
    "textDocument/documentSymbol",
    "textDocument/foldingRange",
    "textDocument/inlayHint",
    "textDocument/documentColor",
    "textDocument/colorPresentation",
    "textDocument/semanticTokens/range",
    "textDocument/semanticTokens/full",
];

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
            "renameProvider": true,
            "completionProvider": { "triggerCharacters": [" "] },
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
