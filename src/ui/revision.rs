//! A scene as a git repository holds it, read by running git.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::file;

/// The text of a scene file in a revision of the repository that its folder belongs to.
///
/// # Errors
///
/// Says why there is none: git is missing, the folder is in no repository, there is no such
/// revision, the file is not in it, or it is not UTF-8.
pub(super) fn text_in(revision: &str, scene: &Path) -> Result<String, String> {
    let name = scene.file_name().unwrap_or_default();
    let shown = name.to_string_lossy();
    let mut object = OsString::from(format!("{revision}:./"));
    object.push(name);
    let ran = Command::new("git")
        .arg("-C")
        .arg(file::directory_of(scene))
        // Plumbing: no pager, no filters that the repository configures.
        .args(["cat-file", "blob"])
        .arg(object)
        // The messages are read below, and nothing may wait for an answer.
        .env("LC_ALL", "C")
        .env("GIT_TERMINAL_PROMPT", "0")
        .stdin(Stdio::null())
        .output();
    let output = ran.map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => "cannot run git: it is not installed".to_owned(),
        _ => format!("cannot run git: {error}"),
    })?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(reason(&said, revision, &shown));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("{shown} in {revision} is not UTF-8 text"))
}

/// What git's complaint about a file in a revision means.
fn reason(said: &str, revision: &str, name: &str) -> String {
    let line = said.lines().next().unwrap_or_default();
    let line = line.strip_prefix("fatal: ").unwrap_or(line);
    let says = |words: &[&str]| words.iter().any(|words| line.contains(words));
    if says(&["not a git repository"]) {
        format!("{name} is not in a git repository")
    } else if says(&["exists on disk, but not in", "does not exist in"]) {
        format!("{name} is not in {revision}: git does not track it there")
    } else if says(&["invalid object name", "Not a valid object name"]) {
        match revision {
            "HEAD" => "the git repository has no commits yet".to_owned(),
            _ => format!("git knows no revision {revision}"),
        }
    } else if line.is_empty() {
        "git failed without a reason".to_owned()
    } else {
        format!("git: {line}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn complaints_of_git_are_explained() {
        for (said, revision, reason) in [
            (
                "fatal: not a git repository (or any of the parent directories): .git\n",
                "HEAD",
                "a.ray is not in a git repository",
            ),
            (
                "fatal: path 'a.ray' exists on disk, but not in 'HEAD'\n",
                "HEAD",
                "a.ray is not in HEAD: git does not track it there",
            ),
            (
                "fatal: path 'a.ray' does not exist in 'HEAD~3'\n",
                "HEAD~3",
                "a.ray is not in HEAD~3: git does not track it there",
            ),
            (
                "fatal: invalid object name 'HEAD'.\n",
                "HEAD",
                "the git repository has no commits yet",
            ),
            (
                "fatal: invalid object name 'nope'.\n",
                "nope",
                "git knows no revision nope",
            ),
            (
                "fatal: detected dubious ownership in repository at '/x'\nTo add\n",
                "HEAD",
                "git: detected dubious ownership in repository at '/x'",
            ),
            ("", "HEAD", "git failed without a reason"),
        ] {
            assert_eq!(super::reason(said, revision, "a.ray"), reason);
        }
    }

    /// Runs git in a folder; `None` if it is not installed.
    fn git(folder: &Path, arguments: &[&str]) -> Option<()> {
        let mut git = Command::new("git");
        git.arg("-C").arg(folder).args(arguments);
        for name in ["GIT_CONFIG_GLOBAL", "GIT_CONFIG_SYSTEM"] {
            git.env(name, "/dev/null");
        }
        let output = git.output().ok()?;
        assert!(output.status.success(), "{arguments:?}: {output:?}");
        Some(())
    }

    #[test]
    fn a_scene_is_read_as_it_was_committed() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("a b.ray");
        std::fs::write(&scene, "one").expect("writable");
        let found = |revision| text_in(revision, &scene);
        let Some(()) = git(folder.path(), &["init", "-q"]) else {
            return;
        };
        assert_eq!(
            found("HEAD"),
            Err("the git repository has no commits yet".to_owned())
        );
        let commit = |text: &str| {
            std::fs::write(&scene, text).expect("writable");
            git(folder.path(), &["add", "a b.ray"]);
            let author = ["-c", "user.name=a", "-c", "user.email=a@example.org"];
            git(
                folder.path(),
                &[&author[..], &["commit", "-qm", text]].concat(),
            );
        };
        commit("one");
        commit("two");
        std::fs::write(&scene, "three").expect("writable");
        assert_eq!(found("HEAD"), Ok("two".to_owned()));
        assert_eq!(found("HEAD~1"), Ok("one".to_owned()));
        assert_eq!(found("nope"), Err("git knows no revision nope".to_owned()));
        let other = folder.path().join("other.ray");
        assert_eq!(
            text_in("HEAD", &other),
            Err("other.ray is not in HEAD: git does not track it there".to_owned())
        );
    }
}
