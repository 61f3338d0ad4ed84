//! CRC-32, as of gzip and PNG (ISO-HDLC: polynomial 04C11DB7, bits reflected).

/// The checksum of bytes that follow others, given the checksum of those; 0 if there are none.
pub(super) fn crc32(before: u32, bytes: &[u8]) -> u32 {
    let (words, rest) = bytes.as_chunks::<8>();
    let by_words = words.iter().fold(!before, |crc, word| {
        let word = u64::from_le_bytes(*word) ^ u64::from(crc);
        let bytes = word.to_le_bytes().into_iter();
        // The first byte is followed by seven others.
        bytes
            .zip(TABLES.iter().rev())
            .fold(0, |crc, (byte, table)| crc ^ table[usize::from(byte)])
    });
    !rest.iter().fold(by_words, |crc, &byte| {
        (crc >> 8) ^ TABLES[0][usize::from(crc as u8 ^ byte)]
    })
}

/// What each byte contributes to the checksum if as many zero bytes follow as the table's index says
/// (slicing by eight: Kounavis and Berry, "Novel Table Lookup-Based Algorithms for High-Performance
/// CRC Generation", IEEE Transactions on Computers 57(11), 2008).
static TABLES: [[u32; 256]; 8] = {
    let mut tables = [[0; 256]; 8];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut table = 0;
        while table < 8 {
            let mut bit = 0;
            while bit < 8 {
                crc = (crc >> 1) ^ ((crc & 1) * 0xedb8_8320);
                bit += 1;
            }
            tables[table][byte] = crc;
            table += 1;
        }
        byte += 1;
    }
    tables
};

#[cfg(test)]
mod tests {
    use super::crc32;

    /// The check value in the catalogue of parametrised CRC algorithms; of the other texts, as by `gzip`.
    #[test]
    fn checksums_are_those_of_gzip() {
        for (text, crc) in [
            ("", 0),
            ("123456789", 0xcbf4_3926),
            ("The quick brown fox jumps over the lazy dog", 0x414f_a339),
        ] {
            for split in 0..=text.len() {
                let (start, end) = text.as_bytes().split_at(split);
                assert_eq!(
                    crc32(crc32(0, start), end),
                    crc,
                    "{text} after {split} bytes"
                );
            }
        }
    }
}
