//! How long files may be.

use super::*;

#[test]
fn a_file_may_have_all_the_bytes_permitted_and_no_more() {
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, "four").expect("written");
    for limit in [4, 5] {
        assert_eq!(read_bytes(&path, limit).expect("read"), b"four");
    }
    for limit in [0, 3] {
        let refused = read_bytes(&path, limit);
        assert!(matches!(refused, Err(ReadError::TooLong { .. })), "{limit}");
    }
}

#[test]
fn small_texts_have_a_small_limit() {
    let directory = directory();
    let path = directory.path().join("a.toml");
    let most = MAX_SMALL_BYTES as usize;
    for (length, is_read) in [(0, true), (most, true), (most + 1, false)] {
        fs::write(&path, "\n".repeat(length)).expect("written");
        match read_small_text(&path) {
            Ok(text) => assert!(is_read && text.len() == length, "{length}"),
            Err(error) => {
                let expected = format!(
                    "{}: is longer than 1 MiB, the limit for tracks, configurations and key scripts",
                    path.display()
                );
                assert!(
                    !is_read && error.to_string() == expected,
                    "{length}: {error}"
                );
            }
        }
        assert_eq!(read_text(&path).expect("read").len(), length);
    }
}

/// The kernel's files claim to be empty; a file that grows while it is read claims too little, too.
#[test]
#[cfg(target_os = "linux")]
fn a_file_longer_than_it_claims_is_read_up_to_the_limit() {
    let path = Path::new("/proc/version");
    let all = read_bytes(path, MAX_BYTES).expect("read");
    let length = all.len() as u64;
    assert!(fs::metadata(path).expect("there").len() < length);
    assert_eq!(read_bytes(path, length).expect("read"), all);
    let refused = read_bytes(path, length - 1);
    assert!(matches!(refused, Err(ReadError::TooLong { .. })));
}
