//! A scene as a git repository holds it, read by running git.

mod git;

use std::ffi::{OsStr, OsString};
use std::path::Path;

use git::{Git, Ran};
use memory::{Need, megabytes};

/// The longest scene in bytes: a repository of a few megabytes may hold one of gigabytes.
const MOST: u64 = 512 << 20;

/// The most bytes that git lists about one file.
const LISTED: u64 = 1 << 16;

/// The text of a scene file in a revision of the repository that its folder belongs to. `sound` is
/// called with the beginning of a long text, before the rest is read.
///
/// # Errors
///
/// Says why there is none: git is missing or takes too long, the folder is in no repository, there
/// is no such revision, the file is not in it or not a scene that can be read, or `sound` fails.
pub(super) fn text_in(
    revision: &str,
    scene: &Path,
    sound: impl Fn(&str) -> Result<(), String>,
) -> Result<String, String> {
    let git = Git::of_folder(file::directory_of(scene));
    text_by(&git, revision, scene, sound)
}

fn text_by(
    git: &Git,
    revision: &str,
    scene: &Path,
    sound: impl Fn(&str) -> Result<(), String>,
) -> Result<String, String> {
    let name = scene.file_name().unwrap_or_default();
    let shown = format!("{} in {revision}", name.to_string_lossy());
    let failed = |ran: &Ran| reason(&ran.complaint, revision, &name.to_string_lossy());
    let mut path = OsString::from("./");
    path.push(name);
    let listing = ["ls-tree", "-z", "--long", revision, "--"].map(OsStr::new);
    let listed = git.run(&[&listing[..], &[&path]].concat(), LISTED, |_| Ok(()))?;
    if !listed.has_succeeded {
        return Err(failed(&listed));
    }
    let entry = String::from_utf8_lossy(&listed.output).into_owned();
    let Blob { id, bytes } = Blob::listed(&entry, &name.to_string_lossy(), revision)?;
    check_size(bytes, &shown)?;
    let mut is_checked = bytes <= file::LONG;
    let look = |text: &[u8]| {
        if is_checked || text.len() < file::BEGINNING {
            return Ok(());
        }
        is_checked = true;
        // The cut may be inside a character.
        let whole = text[..file::BEGINNING].utf8_chunks().next();
        sound(whole.map_or("", |chunk| chunk.valid()))
    };
    let read = git.run(&["cat-file", "blob", id].map(OsStr::new), bytes, look)?;
    if !read.has_succeeded {
        return Err(failed(&read));
    }
    String::from_utf8(read.output).map_err(|_| format!("{shown} is not UTF-8 text"))
}

/// A file in a repository.
struct Blob<'a> {
    /// The name of its content.
    id: &'a str,
    /// The length of its content.
    bytes: u64,
}

impl<'a> Blob<'a> {
    /// The file in a line of `git ls-tree --long`: mode, kind, name and length of the content, and,
    /// after a tab, the path. The line is empty if there is none.
    fn listed(entry: &'a str, name: &str, revision: &str) -> Result<Self, String> {
        let fields = entry.split('\t').next().unwrap_or_default();
        let fields: Vec<_> = fields.split_ascii_whitespace().collect();
        match fields[..] {
            [] => Err(format!("{name} is not in {revision}")),
            // Links have other modes.
            [mode, "blob", id, length] if mode.starts_with("100") => match length.parse() {
                Ok(bytes) => Ok(Self { id, bytes }),
                Err(_) => Err(format!(
                    "{name} in {revision} is missing from the repository: it is not fetched \
                     (object {id})"
                )),
            },
            _ => Err(format!("{name} in {revision} is not a file")),
        }
    }
}

/// Fails if a text is longer than [`MOST`], or than fits into memory.
fn check_size(bytes: u64, shown: &str) -> Result<(), String> {
    if MOST < bytes {
        let [bytes, most] = [bytes, MOST].map(megabytes);
        return Err(format!(
            "{shown} is {bytes}, over the limit of {most} for git; check it out and compare with \
             the file"
        ));
    }
    let need = || Need {
        what: "the file's contents".to_owned(),
        bytes,
    };
    memory::check(bytes, need).map_err(|reason| format!("{shown}: {reason}"))
}

/// What git says of an object that it lacks, or would fetch.
const MISSING: &[&str] = &[
    "Could not read",
    "bad file",
    "' not allowed",
    "lazy fetching disabled",
];

/// What git's complaint about a file in a revision means.
fn reason(said: &str, revision: &str, name: &str) -> String {
    let says = |words: &[&str]| words.iter().any(|words| said.contains(words));
    if says(&["not a git repository"]) {
        format!("{name} is not in a git repository")
    } else if says(&["Not a valid object name"]) {
        match revision {
            "HEAD" => "the git repository has no commits yet".to_owned(),
            _ => format!("git knows no revision {revision}"),
        }
    } else if says(&["not a tree object"]) {
        format!("{revision} is not a commit, or is missing from the repository: it is not fetched")
    } else if says(MISSING) {
        format!("{name} in {revision} is missing from the repository: it is not fetched")
    } else {
        match said.lines().find(|line| !line.starts_with("warning: ")) {
            None | Some("") => "git failed without a reason".to_owned(),
            Some(line) => format!("git: {}", line.strip_prefix("fatal: ").unwrap_or(line)),
        }
    }
}

#[cfg(test)]
mod tests;
