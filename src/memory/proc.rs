//! Tables in `/proc` and control groups: a key and a number per line.

use std::fs;

/// The text of a table; empty if it cannot be read.
pub(super) fn read(path: impl AsRef<std::path::Path>) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

/// The number in the line whose first word is `key`.
pub(super) fn number(table: &str, key: &str) -> Option<u64> {
    let of = |line: &str| {
        let mut words = line.split_ascii_whitespace();
        let value = (words.next() == Some(key)).then(|| words.next())?;
        value?.parse().ok()
    };
    table.lines().find_map(of)
}

/// The number of bytes in the line whose first word is `key`, which is given in kilobytes.
pub(super) fn kilobytes(table: &str, key: &str) -> Option<u64> {
    Some(number(table, key)?.saturating_mul(1024))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_by_their_keys() {
        let table = "Name:\tVmSize: 7\nVmSize:\t  8192 kB\nVmData: x\nfile 4096\n";
        assert_eq!(kilobytes(table, "VmSize:"), Some(8 << 20));
        assert_eq!(number(table, "file"), Some(4096));
        for key in ["VmData:", "Vm", "VmPeak:"] {
            assert_eq!(number(table, key), None, "{key}");
        }
        assert_eq!(kilobytes("a 18446744073709551615", "a"), Some(u64::MAX));
    }
}
