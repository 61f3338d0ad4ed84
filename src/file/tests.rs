mod faults;
mod kills;
mod limits;
mod turns;

use rustix::fs::{CWD, FileType as NodeType, Mode, mknodat};
use std::fs;
use std::fs::Permissions;
use std::io::Write;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

use tempfile::TempDir;

use super::*;

fn directory() -> TempDir {
    tempfile::tempdir().expect("a directory for a test")
}

/// The sorted names in a directory.
fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .expect("a directory")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("UTF-8")
        })
        .collect();
    names.sort();
    names
}

fn replace_with(path: &Path, content: &str) -> io::Result<()> {
    replace_as(path, &mut |out| out.write_all(content.as_bytes()))
}

fn replace_as(path: &Path, write: &mut Content<'_>) -> io::Result<()> {
    replace(path, write, &|| Ok(()))
}

fn content(path: &Path) -> String {
    fs::read_to_string(path).expect("a text file")
}

/// The error message for a file `s` with these bytes, without its directory.
fn refusal(bytes: &[u8]) -> String {
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, bytes).expect("written");
    let message = read_text(&path).expect_err("not UTF-8").to_string();
    message.replace(&format!("{}", directory.path().join("").display()), "")
}

#[test]
fn long_files_are_read_byte_for_byte() {
    let directory = directory();
    let path = directory.path().join("long");
    // Files are read in parts, each a power of two long; no two parts are alike.
    for length in [(16 << 20) - 1, 16 << 20, (16 << 20) + 1, (17 << 20) + 77] {
        let bytes: Vec<u8> = (0..length)
            .map(|at: u32| (at ^ at >> 8 ^ at >> 16) as u8)
            .collect();
        fs::write(&path, &bytes).expect("written");
        let read = read_bytes(&path, MAX_BYTES).expect("read");
        assert!(read == bytes, "{length}");
        assert!(
            read_bytes(&path, u64::from(length) - 1).is_err(),
            "{length}"
        );
    }
}

#[test]
fn text_is_read_byte_for_byte() {
    let directory = directory();
    let path = directory.path().join("s");
    for text in ["", "\u{feff}a\r\r\nb\u{a0}\0c", "no newline"] {
        fs::write(&path, text).expect("written");
        assert_eq!(read_text(&path).expect("text"), text);
    }
}

#[test]
fn the_first_byte_that_is_not_utf8_is_named() {
    assert_eq!(
        refusal(b"ab\n\xC3\xA9 \xE9t\xE9"),
        "s:2:3: the byte 0xE9 is not UTF-8 text; convert the file, for example with: \
         iconv -f WINDOWS-1252 -t UTF-8"
    );
    assert_eq!(
        refusal(b"\xFF\xFEa\0"),
        "s:1:1: the byte 0xFF is not UTF-8 text; convert the file, for example with: \
         iconv -f UTF-16 -t UTF-8"
    );
}

#[test]
fn missing_files_and_directories_have_different_errors() {
    let directory = directory();
    let missing = read_text(&directory.path().join("none"));
    assert!(matches!(missing, Err(ReadError::NotFound { .. })));
    let error = read_text(directory.path()).expect_err("a directory");
    assert!(error.to_string().ends_with(": is a folder, not a file"));
}

#[test]
fn a_file_is_created_and_replaced_without_leftovers() {
    let directory = directory();
    let path = directory.path().join("s");
    for text in ["first", "the second, longer", "3"] {
        replace_with(&path, text).expect("replaced");
        assert_eq!(content(&path), text);
        assert_eq!(names(directory.path()), ["s"]);
    }
}

#[test]
fn a_failed_write_leaves_the_old_content() {
    let directory = directory();
    let path = directory.path().join("s");
    let fail_midway = || {
        replace_as(&path, &mut |out| {
            out.write_all(&vec![b'x'; 100_000])?;
            Err(io::ErrorKind::StorageFull.into())
        })
    };
    assert!(fail_midway().is_err());
    assert_eq!(names(directory.path()), [""; 0]);
    replace_with(&path, "old").expect("replaced");
    assert!(fail_midway().is_err());
    assert_eq!(content(&path), "old");
    assert_eq!(names(directory.path()), ["s"]);
}

#[test]
fn permission_to_replace_is_asked_after_the_content_is_written() {
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, "old").expect("written");
    let refused = replace(
        &path,
        &mut |out| {
            out.write_all(b"ours")?;
            // Another program writes meanwhile.
            fs::write(&path, "theirs")
        },
        &|| match content(&path).as_str() {
            "old" => Ok(()),
            _ => Err(io::Error::other("changed")),
        },
    );
    assert_eq!(refused.expect_err("it changed").to_string(), "changed");
    assert_eq!(content(&path), "theirs");
    assert_eq!(names(directory.path()), ["s"]);
}

#[test]
fn a_target_that_cannot_be_written_is_detected_beforehand() {
    let directory = directory();
    let path = directory.path().join("s");
    assert!(check_target(&path).is_ok());
    assert!(check_target(&directory.path().join("none").join("s")).is_err());
    assert!(check_target(directory.path()).is_err());
    replace_with(&path, "old").expect("replaced");
    assert!(check_target(&path).is_ok());
    assert!(check_target(&path.join("s")).is_err());
    assert!(replace_with(directory.path(), "").is_err());
    assert_eq!(names(directory.path()), ["s"]);
}

#[test]
fn a_pipe_or_a_device_is_refused_at_once() {
    let directory = directory();
    let pipe = directory.path().join("pipe");
    mknodat(CWD, &pipe, NodeType::Fifo, Mode::RWXU, 0).expect("a pipe");
    for (path, kind) in [
        (pipe.as_path(), "a pipe"),
        (Path::new("/dev/zero"), "a device"),
    ] {
        let message = read_text(path).expect_err("not a file").to_string();
        assert!(
            message.ends_with(&format!(": is {kind}, not a file")),
            "{message}"
        );
    }
}

#[test]
fn a_file_that_is_too_long_is_refused_unread() {
    let directory = directory();
    let path = directory.path().join("s");
    let file = File::create(&path).expect("created");
    // A hole, which takes no space.
    file.set_len(MAX_BYTES + 1)
        .expect("a file system with holes");
    assert!(matches!(read_text(&path), Err(ReadError::TooLong { .. })));
}

#[test]
fn links_are_followed_and_stay_links() {
    let directory = directory();
    let at = |name: &str| directory.path().join(name);
    fs::create_dir(at("real")).expect("created");
    symlink("../middle", at("real/link")).expect("linked");
    symlink("real/end", at("middle")).expect("linked");
    for text in ["made at the end of dangling links", "replaced there"] {
        replace_with(&at("real/link"), text).expect("replaced");
        assert_eq!(content(&at("real/end")), text);
        assert_eq!(names(&at("real")), ["end", "link"]);
        assert!(at("real/link").is_symlink() && at("middle").is_symlink());
    }
    symlink("loop", at("loop")).expect("linked");
    assert!(replace_with(&at("loop"), "x").is_err());
    assert!(at("loop").is_symlink());
}

#[test]
fn the_mode_is_kept() {
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, "old").expect("written");
    for mode in [0o600, 0o644, 0o751, 0o666] {
        fs::set_permissions(&path, Permissions::from_mode(mode)).expect("changed");
        replace_with(&path, "new").expect("replaced");
        let kept = fs::metadata(&path).expect("there").permissions().mode();
        assert_eq!(kept & 0o7777, mode, "{mode:o}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn extended_attributes_are_kept() {
    use rustix::fs::{XattrFlags, getxattr, setxattr};
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, "old").expect("written");
    if setxattr(&path, "user.note", b"mine", XattrFlags::empty()).is_err() {
        // A file system without attributes has none to lose.
        return;
    }
    replace_with(&path, "new").expect("replaced");
    let mut value = [0; 4];
    let length = getxattr(&path, "user.note", &mut value).expect("kept");
    assert_eq!(&value[..length], b"mine");
}

#[test]
fn a_new_file_has_the_usual_mode() {
    let directory = directory();
    let mode = |name: &str| {
        let metadata = fs::metadata(directory.path().join(name)).expect("there");
        metadata.permissions().mode()
    };
    fs::write(directory.path().join("theirs"), "").expect("written");
    replace_with(&directory.path().join("ours"), "").expect("replaced");
    assert_eq!(mode("ours"), mode("theirs"));
}

/// Something another program does to a file after it was written.
type Change = fn(&Path);

#[test]
fn changes_by_others_change_the_version_of_a_file() {
    let rewrite = |path: &Path, content: &str| {
        let modified = fs::metadata(path).and_then(|found| found.modified());
        fs::write(path, content).expect("written");
        let file = File::options().write(true).open(path);
        let dated = file.and_then(|file| file.set_modified(modified.expect("a time")));
        dated.expect("ours");
    };
    let cases: &[(&str, Change, bool)] = &[
        ("nothing", |_| {}, true),
        ("reading", |path| drop(content(path)), true),
        (
            "writing",
            |path| fs::write(path, "xyz").expect("written"),
            false,
        ),
        (
            "removing",
            |path| fs::remove_file(path).expect("there"),
            false,
        ),
        (
            "replacing",
            |path| {
                let other = path.with_extension("new");
                fs::write(&other, "new").expect("written");
                fs::rename(&other, path).expect("renamed");
            },
            false,
        ),
    ];
    for linked in [false, true] {
        for (name, change, is_same) in cases {
            let directory = directory();
            let path = directory.path().join("s");
            if linked {
                fs::write(&path, "old").expect("written");
                fs::hard_link(&path, directory.path().join("t")).expect("linked");
            }
            let written = deliver(&path, &mut |out| out.write_all(b"new"), &|| {
                io::Result::Ok(())
            });
            let version = written.expect("written").expect("a file");
            change(&path);
            let found = Version::of(&path).ok();
            assert_eq!(found == Some(version), *is_same, "{name}, {linked}");
        }
    }
    // Setting the modification time back does not hide a change.
    let directory = directory();
    let path = directory.path().join("s");
    fs::write(&path, "one").expect("written");
    let version = Version::of(&path).expect("there");
    while Version::of(&path).is_ok_and(|found| found == version) {
        rewrite(&path, "two");
    }
}

#[test]
fn hard_links_stay_together() {
    let directory = directory();
    let (one, two) = (directory.path().join("one"), directory.path().join("two"));
    fs::write(&one, "old content, longer than the new").expect("written");
    fs::hard_link(&one, &two).expect("linked");
    let inode = fs::metadata(&one).expect("there").ino();
    for text in ["new", "new, longer again", ""] {
        replace_with(&two, text).expect("replaced");
        assert_eq!(content(&one), text);
        assert_eq!(fs::metadata(&two).expect("there").ino(), inode);
        assert_eq!(names(directory.path()), ["one", "two"]);
    }
    let failed = replace_as(&one, &mut |out| {
        out.write_all(b"half")?;
        Err(io::ErrorKind::StorageFull.into())
    });
    assert!(failed.is_err());
    assert_eq!(
        (content(&one), content(&two)),
        (String::new(), String::new())
    );
}

fn pipe_in(directory: &TempDir) -> PathBuf {
    let pipe = directory.path().join("pipe");
    mknodat(CWD, &pipe, NodeType::Fifo, Mode::RWXU, 0).expect("a pipe");
    pipe
}

fn deliver_to(path: &Path, content: &str) -> io::Result<()> {
    deliver(path, &mut |out| out.write_all(content.as_bytes()), &|| {
        Ok(())
    })
    .map(drop)
}

#[test]
fn a_pipe_is_written_to_and_not_replaced() {
    let directory = directory();
    let pipe = pipe_in(&directory);
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read_to_string(pipe)
    });
    // More than a pipe buffers, so the writer waits for the reader.
    let content = "through".repeat(100_000);
    deliver_to(&pipe, &content).expect("written");
    let read = reader.join().expect("no panic").expect("read");
    assert!(read == content);
    assert_eq!(names(directory.path()), ["pipe"]);
    deliver_to(Path::new("/dev/null"), &content).expect("written");
}

#[test]
fn a_pipe_without_a_reader_is_an_error() {
    let directory = directory();
    let error = deliver_to(&pipe_in(&directory), "x").expect_err("nobody reads it");
    assert_eq!(error.to_string(), "no process is reading this pipe");
}

#[test]
fn only_files_are_replaced() {
    let directory = directory();
    let pipe = pipe_in(&directory);
    let socket = directory.path().join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).expect("a socket");
    for (path, kind) in [
        (pipe.as_path(), "a pipe"),
        (socket.as_path(), "a socket"),
        (Path::new("/dev/null"), "a device"),
    ] {
        let error = replace_with(path, "x").expect_err("not a file");
        assert_eq!(error.to_string(), format!("is {kind}, not a file"));
    }
    assert_eq!(names(directory.path()), ["pipe", "socket"]);
}

#[test]
fn a_file_created_meanwhile_is_only_replaced_with_permission() {
    let directory = directory();
    let path = directory.path().join("s");
    let calls = std::cell::Cell::new(0);
    let replace_after = |allowed: usize| {
        replace(&path, &mut |out| out.write_all(b"ours"), &|| {
            // Another program writes just before the name is taken.
            fs::write(&path, "theirs")?;
            calls.set(calls.get() + 1);
            if calls.get() <= allowed {
                Ok(())
            } else {
                Err(io::Error::other("exists"))
            }
        })
    };
    let refused = replace_after(1).expect_err("it exists by then");
    assert_eq!(refused.to_string(), "exists");
    assert_eq!(content(&path), "theirs");
    fs::remove_file(&path).expect("removed");
    calls.set(0);
    replace_after(2).expect("allowed");
    assert_eq!((calls.get(), content(&path).as_str()), (2, "ours"));
    assert_eq!(names(directory.path()), ["s"]);
}

#[test]
fn only_the_beginning_of_a_long_file_is_read() {
    let directory = directory();
    let path = directory.path().join("s");
    let write = |head: &[u8], len: u64| {
        fs::write(&path, head).expect("written");
        let mut file = OpenOptions::new().append(true).open(&path).expect("opened");
        let rest = vec![b' '; (len - head.len() as u64) as usize];
        file.write_all(&rest).expect("written");
    };
    write(b"a", LONG);
    assert_eq!(read_beginning(&path).expect("read"), None);
    write(b"a", LONG + 1);
    let beginning = read_beginning(&path).expect("read").expect("it is long");
    assert_eq!(beginning.len(), BEGINNING);
    // A cut character is dropped, an invalid one is an error.
    let cut = ["a".repeat(BEGINNING - 1), "é".to_owned()].concat();
    write(cut.as_bytes(), LONG + 1);
    let beginning = read_beginning(&path).expect("read").expect("it is long");
    assert_eq!(beginning.len(), BEGINNING - 1);
    write(b"a\n \xE9 \n", LONG + 1);
    let wrong = read_beginning(&path).expect_err("it is not UTF-8");
    assert!(wrong.to_string().contains(":2:2: the byte 0xE9"), "{wrong}");
    write(&[[b'a'; 5000], [0; 5000]].concat(), LONG + 1);
    let wrong = read_beginning(&path).expect_err("it is binary");
    assert!(
        matches!(wrong, ReadError::Binary { line: 1, .. }),
        "{wrong}"
    );
}

#[test]
fn only_the_start_of_a_long_invalid_line_is_kept() {
    let bytes = [&b"a\n "[..], &vec![0xFF; 1 << 20]].concat();
    let wrong = decode(Path::new("s"), bytes).expect_err("it is not UTF-8");
    let ReadError::NotUtf8 { text, position, .. } = wrong else {
        panic!("{wrong}");
    };
    assert_eq!((position.line, position.column), (2, 2));
    assert!(text.len() < 4 * WRONG_LINE, "{}", text.len());
}
