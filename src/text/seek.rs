//! The first byte of a kind.

/// The place of the first byte that is of a kind. Where none is near, blocks without any are passed
/// by with vector instructions.
#[inline]
pub fn first_byte(bytes: &[u8], is: impl Fn(u8) -> bool) -> Option<usize> {
    const NEAR: usize = 8;
    const BLOCK: usize = 16;
    let among = |part: &[u8]| part.iter().position(|&byte| is(byte));
    let near = &bytes[..bytes.len().min(NEAR)];
    if let Some(place) = among(near) {
        return Some(place);
    }
    let mut at = near.len();
    // Numbers, for a sum of truth values is not made a vector instruction.
    let of_kind = |any, &byte: &u8| any | u8::from(is(byte));
    let has_none = |block: &[u8; BLOCK]| block.iter().fold(0, of_kind) == 0;
    while bytes[at..].first_chunk().is_some_and(has_none) {
        at += BLOCK;
    }
    Some(at + among(&bytes[at..])?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_byte_is_found_wherever_it_is() {
        for place in (0..300).chain([999]) {
            let mut bytes = [b' '; 1000];
            bytes[place..].fill(b'a');
            assert_eq!(first_byte(&bytes, |byte| byte == b'a'), Some(place));
            assert_eq!(first_byte(&bytes[..place], |byte| byte == b'a'), None);
        }
    }
}
