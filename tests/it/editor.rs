//! A scripted editor, which runs the program as its language server.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

/// No answer takes this long.
const WATCHDOG: Duration = Duration::from_secs(30);

/// An editor's end of a session.
pub(crate) struct Editor {
    server: Child,
    messages: Receiver<Value>,
    requests: u64,
}

impl Editor {
    pub(crate) fn start(mut command: Command) -> Self {
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut server = command.stderr(Stdio::piped()).spawn().expect("it starts");
        let output = server.stdout.take().expect("a pipe");
        let (sender, messages) = mpsc::channel();
        // It ends with the output, or with a message that is none.
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = read(&mut output) {
                let _ = sender.send(message);
            }
        });
        Self {
            server,
            messages,
            requests: 0,
        }
    }

    pub(crate) fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        let input = self.server.stdin.as_mut().expect("a pipe");
        input.write_all(bytes).expect("it listens");
    }

    pub(crate) fn notify(&mut self, method: &str, parameters: &Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": parameters }));
    }

    /// Sends a request and waits for its result.
    pub(crate) fn ask(&mut self, method: &str, parameters: &Value) -> Value {
        self.requests += 1;
        let id = format!("request {}", self.requests);
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": parameters }));
        loop {
            let answer = self.receive();
            if answer["id"] == *id {
                return answer["result"].clone();
            }
        }
    }

    pub(crate) fn receive(&self) -> Value {
        let message = self.messages.recv_timeout(WATCHDOG);
        message.expect("a message in time")
    }

    /// Waits for a message of the server's own.
    pub(crate) fn wait_for(&self, method: &str) -> Value {
        loop {
            let message = self.receive();
            if message["method"] == method {
                return message;
            }
        }
    }

    /// Ends the input; returns the exit code and what the server wrote to standard error.
    pub(crate) fn end(mut self) -> (Option<i32>, String) {
        drop(self.server.stdin.take());
        let rest: Vec<_> = self.messages.iter().collect();
        assert!(rest.is_empty(), "{rest:?}");
        let ended = self.server.wait_with_output().expect("it ends");
        let said = String::from_utf8(ended.stderr).expect("UTF-8");
        (ended.status.code(), said)
    }

    /// Kills the server, as an editor that is killed does.
    pub(crate) fn kill(mut self) {
        self.server.kill().expect("it can be killed");
        self.server.wait().expect("it ends");
    }
}

/// Reads a message; `None` at the end. Nothing else may be written.
fn read(output: &mut impl BufRead) -> Option<Value> {
    let mut header = String::new();
    if output.read_line(&mut header).expect("UTF-8") == 0 {
        return None;
    }
    let length = header.trim().strip_prefix("Content-Length: ");
    let length: usize = length.expect("only messages").parse().expect("a length");
    let mut body = vec![0; length + 2];
    output.read_exact(&mut body).expect("a message");
    Some(serde_json::from_slice(&body).expect("JSON"))
}

/// The URI of a file whose path needs no escapes.
pub(crate) fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}
