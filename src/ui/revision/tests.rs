//! Scenes in repositories, some of which want to run programs.

mod planted;

use std::fs;
use std::io::{Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::*;

/// Runs git in a folder and returns its output; `None` if it is not installed.
fn git(folder: &Path, arguments: &[&str]) -> Option<String> {
    let mut git = Command::new("git");
    git.arg("-C").arg(folder).args(arguments);
    for name in ["GIT_CONFIG_GLOBAL", "GIT_CONFIG_SYSTEM"] {
        git.env(name, "/dev/null");
    }
    let output = git.output().ok()?;
    assert!(output.status.success(), "{arguments:?}: {output:?}");
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn commit(folder: &Path) {
    git(folder, &["add", "."]);
    let author = ["-c", "user.name=a", "-c", "user.email=a@example.org"];
    git(folder, &[&author[..], &["commit", "-qm", "x"]].concat());
}

/// A folder with a repository; `None` without git.
fn repository() -> Option<TempDir> {
    let folder = tempfile::tempdir().expect("a folder");
    git(folder.path(), &["init", "-q"])?;
    Some(folder)
}

fn found(revision: &str, scene: &Path) -> Result<String, String> {
    text_in(revision, scene, |_| Ok(()))
}

#[test]
fn complaints_of_git_are_explained() {
    let missing = "a.ray in HEAD is missing from the repository: it is not fetched";
    for (said, revision, reason) in table! {
        "fatal: not a git repository (or any of the parent directories): .git\n", "HEAD" =>
            "a.ray is not in a git repository";
        "fatal: Not a valid object name HEAD\n", "HEAD" => "the git repository has no commits yet";
        "fatal: Not a valid object name nope\n", "nope" => "git knows no revision nope";
        "fatal: transport 'file' not allowed\nfatal: not a tree object\n", "HEAD" =>
            "HEAD is not a commit, or is missing from the repository: it is not fetched";
        "fatal: transport 'ext' not allowed\n", "HEAD" => missing;
        "error: Could not read 786e4612a214aa879ee310c3acbc14ea4146c1dc\n", "HEAD" => missing;
        "fatal: detected dubious ownership in repository at '/x'\nTo add\n", "HEAD" =>
            "git: detected dubious ownership in repository at '/x'";
        "warning: odd\nfatal: broken\n", "HEAD" => "git: broken";
        "", "HEAD" => "git failed without a reason";
    } {
        assert_eq!(super::reason(said, revision, "a.ray"), reason);
    }
}

#[test]
fn a_scene_is_read_as_it_was_committed() {
    let Some(folder) = repository() else {
        return;
    };
    let scene = folder.path().join("a *b.ray");
    let found = |revision| found(revision, &scene);
    let no_commits = "the git repository has no commits yet";
    assert_eq!(found("HEAD"), Err(no_commits.to_owned()));
    for text in ["one", "two"] {
        fs::write(&scene, text).expect("writable");
        commit(folder.path());
    }
    fs::write(&scene, "three").expect("writable");
    assert_eq!(found("HEAD"), Ok("two".to_owned()));
    assert_eq!(found("HEAD~1"), Ok("one".to_owned()));
    assert_eq!(found("nope"), Err("git knows no revision nope".to_owned()));
}

#[test]
fn what_is_no_file_of_the_revision_is_said() {
    let Some(folder) = repository() else {
        return;
    };
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("folder.ray")).expect("the folder is new");
    for name in ["folder.ray/a.ray", "bytes.ray"] {
        fs::write(at(name), [0xFF]).expect("the folder is new");
    }
    std::os::unix::fs::symlink("bytes.ray", at("link.ray")).expect("the folder is new");
    commit(folder.path());
    fs::write(at("new.ray"), "").expect("the folder is new");
    for (name, reason) in [
        ("new.ray", "is not in HEAD"),
        ("folder.ray", "in HEAD is not a file"),
        ("link.ray", "in HEAD is not a file"),
        ("bytes.ray", "in HEAD is not UTF-8 text"),
    ] {
        let said = format!("{name} {reason}");
        assert_eq!(found("HEAD", &at(name)), Err(said));
    }
}

/// Commits a file of zeros, which takes a thousandth of its length.
fn unfolding(bytes: u64) -> Option<TempDir> {
    let folder = repository()?;
    let mut file = fs::File::create(folder.path().join("a.ray")).expect("the folder is new");
    file.seek(SeekFrom::Start(bytes - 1))
        .expect("a sparse file");
    file.write_all(&[0]).expect("a sparse file");
    commit(folder.path());
    Some(folder)
}

#[test]
fn the_beginning_of_a_long_scene_decides_whether_the_rest_is_read() {
    let Some(folder) = unfolding(file::LONG + 1) else {
        return;
    };
    let scene = folder.path().join("a.ray");
    let refuse = |beginning: &str| Err(format!("{} bytes", beginning.len()));
    let refused = text_in("HEAD", &scene, refuse);
    assert_eq!(refused, Err(format!("{} bytes", file::BEGINNING)));
    let whole = found("HEAD", &scene).map(|text| text.len() as u64);
    assert_eq!(whole, Ok(file::LONG + 1));
}

#[test]
fn a_scene_that_is_too_long_is_not_read() {
    for (bytes, is_read) in [(MOST, true), (MOST + 1, false), (u64::MAX, false)] {
        let entry = format!("100644 blob 1234 {bytes}\ta.ray\0");
        let blob = Blob::listed(&entry, "a.ray", "HEAD").expect("a file");
        assert_eq!(blob.bytes, bytes);
        let checked = check_size(bytes, "a.ray in HEAD");
        let is_too_long = |reason: &String| reason.starts_with("a.ray in HEAD is ");
        assert_eq!(checked.is_err_and(|reason| is_too_long(&reason)), !is_read);
    }
}

/// More than a pipe holds.
#[test]
fn a_git_that_complains_much_is_read() {
    let Some(folder) = repository() else {
        return;
    };
    let scene = folder.path().join("a.ray");
    fs::write(&scene, "a text").expect("writable");
    commit(folder.path());
    let missing = "/none/at/this/long/place/with/objects\n".repeat(2000);
    let alternates = folder.path().join(".git/objects/info/alternates");
    fs::write(alternates, missing).expect("writable");
    assert_eq!(found("HEAD", &scene), Ok("a text".to_owned()));
}

#[test]
fn a_git_that_takes_too_long_is_stopped() {
    let Some(folder) = repository() else {
        return;
    };
    let pipe = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    if !made.is_ok_and(|made| made.success()) {
        return;
    }
    // Git waits for a writer.
    let include = format!("[include]\n path = {}\n", pipe.display());
    fs::write(folder.path().join(".git/config"), include).expect("writable");
    let scene = folder.path().join("a.ray");
    let git = Git::of_folder(folder.path()).until(Instant::now() + Duration::from_millis(50));
    let read = text_by(&git, "HEAD", &scene, |_| Ok(()));
    let reason = "git took longer than 5 s and was stopped";
    assert_eq!(read, Err(reason.to_owned()));
}
