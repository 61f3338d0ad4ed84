//! Messages of editors and of interfaces.

use std::io::{Cursor, Write};
use std::sync::{Arc, Mutex};

use halflight::link::{ToEditor, ToInterface};
use halflight::lsp;
use serde_json::Value;

/// What the server writes.
#[derive(Clone, Default)]
struct Written(Arc<Mutex<Vec<u8>>>);

impl Write for Written {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().expect("nothing panics").extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Serves an editor that sends each line as a message, and then what follows a zero byte as it is. Nothing
/// but messages is written.
pub fn lsp(input: &[u8]) {
    let [lines, rest] = super::parts(input);
    let mut stream = Vec::new();
    for line in lines.split(|&byte| byte == b'\n') {
        stream.extend(format!("Content-Length: {}\r\n\r\n", line.len()).bytes());
        stream.extend(line);
    }
    stream.extend(rest);
    let written = Written::default();
    let _ = lsp::serve(Cursor::new(stream), written.clone());
    let written = written.0.lock().expect("nothing panics");
    let mut left = &**written;
    while !left.is_empty() {
        let end = left.windows(4).position(|bytes| bytes == b"\r\n\r\n");
        let (header, body) = left.split_at(end.expect("a header") + 4);
        let header = std::str::from_utf8(header).expect("UTF-8").trim();
        let length = header.strip_prefix("Content-Length: ").expect("a length");
        let (message, behind) = body.split_at(length.parse().expect("a number"));
        let message: Value = serde_json::from_slice(message).expect("JSON");
        assert_eq!(message["jsonrpc"], "2.0");
        left = behind;
    }
}

/// Reads a message of either side, which is written as it was meant.
pub fn link(input: &[u8]) {
    let Ok(value) = serde_json::from_slice::<Value>(input) else {
        return;
    };
    if let Some(message) = ToInterface::of_json(&value) {
        assert_eq!(ToInterface::of_json(&message.to_json()), Some(message));
    }
    if let Some(message) = ToEditor::of_json(&value) {
        assert_eq!(ToEditor::of_json(&message.to_json()), Some(message));
    }
}
