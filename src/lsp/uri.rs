//! `file:` URIs (RFC 8089).

use std::ffi::OsString;
use std::fmt::Write;
use std::os::unix::ffi::OsStringExt;
use std::path::PathBuf;

/// The path of a `file:` URI; `None` for others.
pub(crate) fn path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let encoded = &rest[rest.find('/')?..];
    let mut bytes = Vec::with_capacity(encoded.len());
    let mut left = encoded.as_bytes();
    while let [first, rest @ ..] = left {
        let code = rest.get(..2).filter(|_| *first == b'%');
        let code = code.and_then(|digits| std::str::from_utf8(digits).ok());
        let byte = code.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(byte.unwrap_or(*first));
        left = if byte.is_some() { &rest[2..] } else { rest };
    }
    Some(PathBuf::from(OsString::from_vec(bytes)))
}

/// The URI of a file named by a text, relative to that.
pub(crate) fn beside(uri: &str, file: &str) -> Option<String> {
    let folder = if file.starts_with('/') {
        "file://"
    } else {
        &uri[..=uri.rfind('/')?]
    };
    let mut found = folder.to_owned();
    for byte in file.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            found.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(found, "%{byte:02X}");
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_decoded_and_encoded() {
        for (uri, expected) in [
            ("file:///a/b%20c%C3%A9.ray", Some("/a/b cé.ray")),
            ("file://localhost/a%", Some("/a%")),
            ("file:///%zz%4", Some("/%zz%4")),
            ("untitled:a.ray", None),
            ("file:a", None),
            ("", None),
        ] {
            assert_eq!(path(uri), expected.map(PathBuf::from), "{uri}");
        }
        let uri = beside("file:///a/b.xml", "c d/é.obj");
        assert_eq!(uri.as_deref(), Some("file:///a/c%20d/%C3%A9.obj"));
        assert_eq!(
            beside("file:///a/b.xml", "/c").as_deref(),
            Some("file:///c")
        );
    }
}
