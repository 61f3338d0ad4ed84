//! Folders on the path to the file appear, disappear and are replaced.

use super::*;

#[test]
fn a_directory_that_is_removed_and_recreated_is_watched_again() {
    let before = [Directory("d"), Save("d/s.ray", "old")];
    let mut watched = Watched::new("d/s.ray", Method::Native, &before);
    watched.expect(
        &[RemoveDirectory("d"), Directory("d"), Save("d/s.ray", "new")],
        "new",
    );
    watched.expect(
        &[Rename("d", "e"), Directory("d"), Save("d/s.ray", "newer")],
        "newer",
    );
    watched.expect(&[RemoveDirectory("d"), Rename("e", "d")], "new");
    watched.expect(&[Save("d/s.ray", "newest")], "newest");
}

/// A file two existing folders down.
const DEEP: [Step; 3] = [
    Directory("m"),
    Directory("m/deep"),
    Save("m/deep/s.ray", "old"),
];

#[test]
fn missing_folders_are_watched_once_they_appear() {
    let mut watched = Watched::new("m/deep/s.ray", Method::Native, &[]);
    watched.expect(
        &[
            Directory("m"),
            Directory("m/deep"),
            Save("m/deep/s.ray", "new"),
        ],
        "new",
    );
    watched.expect(&[Save("m/deep/s.ray", "newer")], "newer");
}

/// Created faster than they can be watched one by one.
#[test]
fn folders_that_appear_all_at_once_are_watched() {
    for _ in 0..50 {
        let mut watched = Watched::new("m/deep/er/s.ray", Method::Native, &[]);
        for step in [
            Directory("m"),
            Directory("m/deep"),
            Directory("m/deep/er"),
            Save("m/deep/er/s.ray", "new"),
        ] {
            watched.take(step);
        }
        watched.expect(&[], "new");
        watched.expect(&[Save("m/deep/er/s.ray", "newer")], "newer");
    }
}

#[test]
fn folders_that_are_removed_and_created_again_are_watched_again() {
    let mut watched = Watched::new("m/deep/s.ray", Method::Native, &DEEP);
    for content in ["new", "newer"] {
        watched.expect(
            &[
                RemoveDirectory("m"),
                Directory("m"),
                Directory("m/deep"),
                Save("m/deep/s.ray", content),
            ],
            content,
        );
    }
    watched.expect(&[Save("m/deep/s.ray", "newest")], "newest");
}

#[test]
fn folders_may_be_moved_away_and_back() {
    let mut watched = Watched::new("m/deep/s.ray", Method::Native, &DEEP);
    watched.take(Rename("m", "x"));
    watched.expect_none();
    watched.take(Save("x/deep/s.ray", "away"));
    watched.expect(&[Rename("x", "m")], "away");
    watched.expect(&[Save("m/deep/s.ray", "back")], "back");
    watched.expect(
        &[
            Rename("m", "x"),
            Directory("m"),
            Rename("x/deep", "m/deep"),
            Save("m/deep/s.ray", "another"),
        ],
        "another",
    );
}

/// Notices are filtered by the last component of their paths.
#[test]
fn a_folder_is_watched_again_even_if_a_file_has_the_same_name() {
    let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
    let at = directory.path();
    for step in [Directory("a"), Directory("b"), Directory("b/s")] {
        take(at, &mut None, step);
    }
    let (_watcher, notices) = watch(at, &["a/s", "b/s/x"], Method::Native);
    for step in [RemoveDirectory("b/s"), Directory("b/s"), Save("b/s/x", "1")] {
        take(at, &mut None, step);
        notices.recv_timeout(PATIENCE).expect("a notice");
        while notices.recv_timeout(QUIET).is_ok() {}
    }
}
