//! Messages on standard error: lines for people, or an object of JSON each for other programs. A
//! failure to write them cannot be reported anywhere.

use std::io::{self, Write};
use std::path::Path;

use serde_json::json;

use super::progress::ProgressStyle;
use super::{Error, report};
use file::ReadError;
use text::{Diagnostic, Findings, counted, visible, without_codes};

/// How messages are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Messages {
    /// Lines, findings with an excerpt of their text.
    Text,
    /// An object a line, with the event `note`, `warning` or `error`.
    Json,
    /// Not at all: what is found is told elsewhere.
    Off,
}

impl Messages {
    /// Those beside progress of this style: objects where that is of objects.
    pub(super) fn beside(progress: ProgressStyle) -> Self {
        match progress {
            ProgressStyle::Json => Self::Json,
            ProgressStyle::Line | ProgressStyle::Off => Self::Text,
        }
    }

    /// Prints the findings that were kept, and the number of further ones.
    pub(super) fn all_findings(self, path: &Path, text: &str, findings: &Findings) {
        self.findings(path, text, findings);
        let more = findings.count() - findings.len();
        if 0 < more {
            self.note(&format!("{} not shown", counted(more, "more finding")));
        }
    }

    /// Prints findings in a text.
    pub(super) fn findings(self, path: &Path, text: &str, findings: &[Diagnostic]) {
        let name = path.to_string_lossy();
        match self {
            Self::Text => {
                let style = report::Style::of_error_stream();
                print(&report::render(&name, text, findings, style));
            }
            Self::Json => {
                for finding in findings {
                    print(&report::object(&name, text, finding).to_string());
                }
            }
            Self::Off => {}
        }
    }

    /// Prints an error; for a file that is not UTF-8, with the offending line.
    pub(super) fn error(self, error: &Error) {
        let Error::Read(ReadError::NotUtf8 {
            path,
            text,
            span,
            byte,
            encoding,
            ..
        }) = error
        else {
            self.message("error", &error.to_string());
            return;
        };
        let message = format!("the byte 0x{byte:02X} is not UTF-8 text");
        let diagnostic = Diagnostic::error(*span, message, "UTF-8 text").with_hint(format!(
            "convert the file, for example with: iconv -f {encoding} -t UTF-8"
        ));
        self.findings(path, text, &[diagnostic]);
    }

    /// Prints a note that belongs to no place in a text.
    pub(super) fn note(self, note: &str) {
        self.message("note", note);
    }

    fn message(self, kind: &str, message: &str) {
        let message = visible(&without_codes(message)).into_owned();
        match self {
            Self::Text => print(&format!("{kind}: {message}")),
            Self::Json => print(&json!({ "event": kind, "message": message }).to_string()),
            Self::Off => {}
        }
    }
}

/// Prints lines.
pub(super) fn print(lines: &str) {
    if !lines.is_empty() {
        let _ = writeln!(io::stderr().lock(), "{lines}");
    }
}
