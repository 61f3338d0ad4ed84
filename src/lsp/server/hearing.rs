//! What the interfaces that show the documents ask for, passed on to the editor.

use std::io::{self, Write};

use link::{ToEditor, ToInterface};
use serde_json::{Value, json};
use text::Span;

use super::Server;
use crate::wire;

/// The command that shows a place in the interface.
pub(super) const SHOW: &str = "halflight.show";

impl<W: Write> Server<W> {
    /// Takes the editor's answer to a request.
    pub(super) fn answered(&mut self, id: &Value, message: &Value) {
        let asked = id.as_u64().and_then(|id| self.asked.remove(&id));
        if let Some((uri, base)) = asked {
            let is_made = message["result"]["applied"] == true;
            self.links.tell(&uri, &ToInterface::Answer(base, is_made));
        }
    }

    /// Handles a message from the interface that shows a document; `None` if it is gone.
    pub(crate) fn hear(
        &mut self,
        uri: &str,
        connection: u64,
        message: Option<ToEditor>,
    ) -> io::Result<()> {
        let document = self.documents.get(uri);
        let (true, Some(document)) = (self.links.is_present(uri, connection), document) else {
            return Ok(());
        };
        let is_span = |span: Span| document.text().get(span.range()).is_some();
        match message {
            None => self.links.left(uri),
            Some(ToEditor::Whole) => self.links.tell_whole(document),
            Some(ToEditor::Busy(editor)) => {
                if !self.links.is_busy(uri) {
                    return Ok(());
                }
                let name = document.path().file_name().unwrap_or_default();
                let name = name.to_string_lossy().into_owned();
                let words = format!("the interface follows {editor}, which has {name} open too");
                return self.show(3, &words);
            }
            Some(ToEditor::Show { span, takes_focus }) if is_span(span) => {
                let selection = document.range(span);
                let place = json!({ "uri": uri, "takeFocus": takes_focus, "selection": selection });
                self.ask("window/showDocument", &place)?;
            }
            Some(ToEditor::Edit(base, edits)) => {
                let is_valid = edits.iter().all(|edit| is_span(edit.span));
                // The editor may still be asking its user about the ones before.
                let is_asked = self.asked.values().any(|(asked, _)| asked == uri);
                if !is_valid || is_asked || self.links.version(uri) != Some(base) {
                    self.links.tell(uri, &ToInterface::Answer(base, false));
                    return Ok(());
                }
                let edit = if self.has_versioned_edits {
                    document.versioned_edit(&edits)
                } else {
                    document.workspace_edit(&edits)
                };
                let parameters = json!({ "label": "Halflight", "edit": edit });
                let request = self.ask("workspace/applyEdit", &parameters)?;
                self.asked.insert(request, (uri.to_owned(), base));
            }
            // A place in another text, and an answer to nothing asked.
            Some(ToEditor::Show { .. } | ToEditor::Shown(_)) => {}
        }
        Ok(())
    }

    /// Asks the editor for something; returns the number of the request.
    fn ask(&mut self, method: &str, parameters: &Value) -> io::Result<u64> {
        self.requests += 1;
        let id = self.requests;
        let message = json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": parameters });
        wire::write(&mut self.output, &message)?;
        Ok(id)
    }

    /// The action that shows a place in the interface, if one shows the document and actions of its kind are
    /// asked for.
    pub(super) fn action_to_show(&self, parameters: &Value) -> Option<Value> {
        let uri = parameters["textDocument"]["uri"].as_str()?;
        let only = parameters["context"]["only"].as_array();
        let is_asked = |kinds: &Vec<Value>| kinds.iter().any(|kind| kind == "");
        if !only.is_none_or(is_asked) || !self.links.is_connected(uri) {
            return None;
        }
        let title = "Show in Halflight";
        let arguments = json!([uri, parameters["range"]["start"]]);
        let command = json!({ "title": title, "command": SHOW, "arguments": arguments });
        Some(json!({ "title": title, "kind": "", "command": command }))
    }

    /// Carries out a command of an action; whether there is one of this name, with a place.
    pub(super) fn execute(&mut self, parameters: &Value) -> bool {
        let [uri, position] = [0, 1].map(|at| &parameters["arguments"][at]);
        let uri = uri.as_str().unwrap_or("");
        let document = self.documents.get(uri);
        let at = document.and_then(|document| document.offset(position));
        match at {
            Some(at) if parameters["command"] == SHOW => {
                self.links.tell(uri, &ToInterface::Cursor(at));
                true
            }
            _ => false,
        }
    }

    /// Tells the interface where the cursor is: highlights are asked for where it rests.
    pub(super) fn note_cursor(&mut self, method: &str, parameters: &Value) {
        let uri = parameters["textDocument"]["uri"].as_str().unwrap_or("");
        if method == "textDocument/documentHighlight"
            && let Some(document) = self.documents.get(uri)
            && let Some(at) = document.offset(&parameters["position"])
        {
            self.links.tell(uri, &ToInterface::Cursor(at));
        }
    }
}
