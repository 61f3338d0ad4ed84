//! Messages on a stream: JSON-RPC 2.0 behind headers, as the Language Server Protocol 3.17 frames them.

use std::io::{self, BufRead, Read, Write};

use serde_json::Value;

/// The maximum length of a line of the header, in bytes.
const LONGEST_LINE: u64 = 1 << 12;

/// The maximum length of a message, in bytes: a text of the maximum size, each byte escaped.
const LONGEST: u64 = 6 << 30;

/// Why no further message can be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Broken {
    /// The stream fails, or ends within a message.
    #[error("cannot read a message: {0}")]
    Io(#[from] io::Error),
    /// A header is not one.
    #[error("expected a header such as `Content-Length: N`, not `{0}`")]
    Header(String),
    /// A message is longer than any text.
    #[error("a message of {0} bytes is too long")]
    Long(u64),
}

/// Reads the next message; `None` at the end of the stream. A message that is not JSON is null.
pub(crate) fn read(stream: &mut impl BufRead) -> Result<Option<Value>, Broken> {
    let mut length = None;
    let mut is_first = true;
    loop {
        let mut line = Vec::new();
        stream.take(LONGEST_LINE).read_until(b'\n', &mut line)?;
        if line.is_empty() && is_first {
            return Ok(None);
        }
        is_first = false;
        let shown = String::from_utf8_lossy(&line);
        let field = shown.trim_end();
        if field.is_empty() && line.ends_with(b"\n") {
            break;
        }
        let Some((name, value)) = field.split_once(':').filter(|_| line.ends_with(b"\n")) else {
            let start = field.chars().take(40).collect();
            return Err(Broken::Header(start));
        };
        if name.eq_ignore_ascii_case("Content-Length") {
            length = value.trim().parse::<u64>().ok();
        }
    }
    let length = length.ok_or_else(|| Broken::Header(String::new()))?;
    if LONGEST < length {
        return Err(Broken::Long(length));
    }
    // Grows with what arrives, whatever the header declares.
    let mut body = Vec::new();
    stream.take(length).read_to_end(&mut body)?;
    if (body.len() as u64) < length {
        return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
    }
    Ok(Some(serde_json::from_slice(&body).unwrap_or_default()))
}

/// Writes a message.
pub(crate) fn write(stream: &mut impl Write, message: &Value) -> io::Result<()> {
    let body = message.to_string();
    write!(stream, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn messages_are_read_as_they_were_written() {
        let messages = [json!({"a": "é\u{1F600}"}), json!([1, 2]), Value::Null];
        let mut stream = Vec::new();
        for message in &messages {
            write(&mut stream, message).expect("memory is there");
        }
        let mut stream = &*stream;
        for message in messages {
            assert_eq!(read(&mut stream).expect("whole"), Some(message));
        }
        assert_eq!(read(&mut stream).expect("the end"), None);
    }

    #[test]
    fn broken_streams_are_told_apart() {
        for (stream, said) in [
            ("Content-Length: 5\r\n\r\n{}", "cannot read a message"),
            ("Content-Length: 5", "not `Content-Length: 5`"),
            ("GET / HTTP/1.1\r\n\r\n", "not `GET / HTTP/1.1`"),
            ("\r\n{}", "not ``"),
            ("Content-Length: -1\r\n\r\n", "not ``"),
            (
                "Content-Length: 99999999999999\r\n\r\n",
                "of 99999999999999 bytes is too long",
            ),
            (
                "Content-Length: 6000000000\r\n\r\n{}",
                "cannot read a message",
            ),
        ] {
            let error = read(&mut stream.as_bytes()).expect_err(stream).to_string();
            assert!(error.contains(said), "{stream}: {error}");
        }
        let endless = vec![b'a'; 1 << 20];
        assert!(matches!(read(&mut &*endless), Err(Broken::Header(_))));
        let odd = "content-type: x\r\ncontent-length: 3\r\n\r\n{x}";
        assert_eq!(
            read(&mut odd.as_bytes()).expect("framed"),
            Some(Value::Null)
        );
    }
}
