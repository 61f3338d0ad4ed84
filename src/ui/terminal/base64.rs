//! Bytes as text, for sequences that carry pictures or the clipboard.

pub(super) use text::base64 as encode;

/// Decodes what [`encode`] returns.
#[cfg(test)]
pub(super) fn decode(text: &str) -> Vec<u8> {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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

#[test]
fn what_is_encoded_is_decoded() {
    for length in 0..70_u8 {
        let bytes: Vec<u8> = (0..length).map(|at| at.wrapping_mul(37)).collect();
        assert_eq!(decode(&encode(&bytes)), bytes);
    }
}
