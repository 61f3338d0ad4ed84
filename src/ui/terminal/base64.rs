//! Bytes as text, for sequences that carry pictures or the clipboard: RFC 4648, section 4.

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Encodes bytes in base64, padded.
pub(super) fn encode(bytes: &[u8]) -> String {
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

/// Decodes what [`encode`] returns.
#[cfg(test)]
pub(super) fn decode(text: &str) -> Vec<u8> {
    assert_eq!(text.len() % 4, 0, "{text} is padded");
    let digits: Vec<_> = text.trim_end_matches('=').bytes().collect();
    let value = |digit: &u8| ALPHABET.iter().position(|known| known == digit);
    let groups = digits.chunks(4).flat_map(|group| {
        let bits = group.iter().fold(0, |bits, digit| {
            bits << 6 | value(digit).expect("a digit of base64")
        });
        let bits = bits << (6 * (4 - group.len()));
        let [_, bytes @ ..] = (bits as u32).to_be_bytes();
        bytes.into_iter().take(group.len() - 1)
    });
    groups.collect()
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
            assert_eq!(encode(bytes.as_bytes()), text);
            assert_eq!(decode(text), bytes.as_bytes());
        }
        let every: Vec<u8> = (0..64_u8)
            .step_by(4)
            .flat_map(|at| {
                let [a, b, c, d] = [at, at + 1, at + 2, at + 3];
                [a << 2 | b >> 4, b << 4 | c >> 2, c << 6 | d]
            })
            .collect();
        assert_eq!(encode(&every).as_bytes(), ALPHABET);
        assert_eq!(encode(&[0xff; 4]), "/////w==");
    }
}
