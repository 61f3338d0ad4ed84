//! Bytes as text, for pictures within documents and terminal sequences: RFC 4648, section 4.

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Encodes bytes in base64, padded.
pub fn base64(bytes: &[u8]) -> String {
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let mut padded = [0; 3];
        padded[..group.len()].copy_from_slice(group);
        let [a, b, c] = padded;
        let digits = [a >> 2, a << 4 | b >> 4, b << 2 | c >> 6, c];
        text.extend_from_slice(&digits.map(|digit| ALPHABET[usize::from(digit % 64)]));
    }
    let missing = bytes.len().next_multiple_of(3) - bytes.len();
    let end = text.len() - missing;
    text[end..].fill(b'=');
    String::from_utf8(text).expect("the digits are ASCII")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of RFC 4648, section 10, and the digits that they lack.
    #[test]
    fn bytes_are_encoded_in_groups_of_three() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        let every: Vec<u8> = (0..64_u8)
            .step_by(4)
            .flat_map(|at| {
                let [a, b, c, d] = [at, at + 1, at + 2, at + 3];
                [a << 2 | b >> 4, b << 4 | c >> 2, c << 6 | d]
            })
            .collect();
        assert_eq!(base64(&every).as_bytes(), ALPHABET);
        assert_eq!(base64(&[0xff; 4]), "/////w==");
    }
}
