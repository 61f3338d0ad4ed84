//! Errors, warnings and notes.

use serde_json::{Value, json};
use text::{Diagnostic, Severity, Shown, Span};

use crate::document::Document;
use crate::uri;

/// The parameters of `textDocument/publishDiagnostics`.
pub(crate) fn published(document: &Document) -> Value {
    let findings = document.findings.iter().filter(|_| document.is_scene);
    let findings: Vec<_> = findings.map(|found| one(document, found)).collect();
    let mut said = json!({ "uri": document.uri, "diagnostics": findings });
    if !document.version.is_null() {
        said["version"] = document.version.clone();
    }
    said
}

/// A finding as the protocol has it.
pub(super) fn one(document: &Document, found: &Diagnostic) -> Value {
    let severity = match found.severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Note => 3,
    };
    let hint = found.hint.as_deref();
    let message = [
        found.message_with_file(),
        format!("expected: {}", found.expected),
        hint.map_or_else(String::new, |hint| format!("help: {hint}")),
    ];
    let message = message.join("\n");
    let mut said = json!({
        "range": document.range(shown(document, found.span)),
        "severity": severity,
        "source": "halflight",
        "message": message.trim_end(),
    });
    let Shown { file, position, .. } = found.shown(document.text());
    if let Some(uri) = file.and_then(|file| uri::beside(&document.uri, file)) {
        let [line, column] = [position.line, position.column].map(|from_one| from_one - 1);
        let start = json!({ "line": line, "character": column });
        said["relatedInformation"] = json!([{
            "location": { "uri": uri, "range": { "start": start, "end": start } },
            "message": found.message,
        }]);
    }
    said
}

/// At least one character, where there is one: editors hide empty ranges.
pub(super) fn shown(document: &Document, span: Span) -> Span {
    if !span.is_empty() {
        return span;
    }
    let behind = document.text()[span.start()..].chars().next();
    let end = behind.filter(|c| !c.is_control()).map_or(0, char::len_utf8);
    Span::new(span.start(), span.start() + end)
}
