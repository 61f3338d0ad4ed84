//! The user's editor: which program it is, and the arguments that open a file at a line.
//!
//! A scene's name is untrusted: it came with the scene. Whatever it begins with, an editor must
//! take it for a file: vi runs what follows `+`, ed what follows `!`, emacs calls other hosts for
//! `/ssh:`. So a name goes out as an absolute path, behind `--` where the editor knows that, in the
//! form listed for the editor, and no shell reads it. Where a form can't carry a name unharmed, the
//! line is left out.

use std::env::{self, VarError};
use std::ffi::OsString;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, ExitStatus};

/// What is run where neither variable is set.
const DEFAULT: &str = "vi";

/// How editors are asked for a line, by the first letters of their programs' names: `vim` is also
/// `vim.basic`, `emacs` also `emacs-nox`.
const FORMS: &[(&[&str], Form)] = &[
    (
        &[
            "vi", "vim", "nvim", "nvi", "view", "vimdiff", "rvim", "rview", "gvim", "gview",
            "mvim", "ex", "kak",
        ],
        &[Line, Text("--"), File],
    ),
    // micro takes a `--` after any other argument for a file.
    (&["nano", "rnano", "micro"], &[Text("--"), Line, File]),
    (&["emacs"], &[Line, Text("--"), LocalFile]),
    (&["emacsclient"], &[Text("--"), Line, LocalFile]),
    // Not every version knows `+LINE`.
    (&["ed", "red"], &[File]),
    (&["hx", "helix"], &[Text("--"), FileLine]),
    (&["subl", "sublime", "zed", "zeditor"], &[FileLine]),
    (
        &["code", "codium", "vscodium", "cursor"],
        &[Text("--goto"), FileLine],
    ),
];

/// What most editors understand.
const OTHERS: Form = &[Line, File];

/// Arguments in their order.
type Form = &'static [Part];

use Part::{File, FileLine, Line, LocalFile, Text};

/// One argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// The same for every file.
    Text(&'static str),
    /// `+LINE`.
    Line,
    /// The file.
    File,
    /// The file, quoted for emacs where the path is of the kind that names another host.
    LocalFile,
    /// `FILE:LINE`. With a colon of its own a path may be cut elsewhere, and another file's name
    /// may be the whole: then it is the file alone, without what stands before.
    FileLine,
}

/// Runs the user's editor on a file at a line, counted from 1, and waits for its end.
pub(super) fn run(path: &Path, line: usize) -> Result<(), String> {
    let (program, status) = open(path, line).map_err(|reason| {
        format!("can't start the editor: {reason}; $VISUAL or $EDITOR names another one")
    })?;
    ending(&program, status)
}

/// Starts the editor and waits; its program, and how it ended.
fn open(path: &Path, line: usize) -> Result<(String, ExitStatus), String> {
    let command = said("VISUAL")?.or(said("EDITOR")?);
    let words = words(command.as_deref().unwrap_or(DEFAULT))?;
    let (program, own) = words.split_first().ok_or("it has no name")?;
    let path = place(path).map_err(|error| error.to_string())?;
    let status = Command::new(program)
        .args(own)
        .args(arguments(program, &path, line))
        .status()
        .map_err(|error| format!("{program}: {error}"))?;
    Ok((program.clone(), status))
}

/// What is wrong with how a program ended.
fn ending(program: &str, status: ExitStatus) -> Result<(), String> {
    if status.success() {
        return Ok(());
    }
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return Err(format!(
            "the editor {program} was killed by signal {signal}"
        ));
    }
    Err(match status.code() {
        Some(code) => format!("the editor {program} failed with exit status {code}"),
        None => format!("the editor {program} failed: {status}"),
    })
}

/// The value of a variable, if it has one.
fn said(name: &str) -> Result<Option<String>, String> {
    match env::var(name) {
        Ok(said) => Ok(Some(said).filter(|said| !said.trim().is_empty())),
        Err(VarError::NotPresent) => Ok(None),
        Err(VarError::NotUnicode(_)) => Err(format!("${name} is not UTF-8 text")),
    }
}

/// A program and its arguments, with a shell's quotes and backslashes. A whole path of a program
/// may have blanks without them; not a relative one, which could come with a scene.
fn words(said: &str) -> Result<Vec<String>, String> {
    if Path::new(said).is_absolute() && Path::new(said).is_file() {
        return Ok(vec![said.to_owned()]);
    }
    shlex::split(said).ok_or_else(|| format!("`{said}` has a quote without its pair"))
}

/// An absolute path of a file, with single slashes.
fn place(path: &Path) -> io::Result<PathBuf> {
    let absolute = match std::path::absolute(path) {
        // A folder that is gone has no path, but may still be the current one.
        Err(error) if error.kind() == io::ErrorKind::NotFound => Path::new(".").join(path),
        absolute => absolute?,
    };
    let parts: PathBuf = absolute.components().collect();
    Ok(parts)
}

/// What an editor's program gets besides the user's own arguments.
fn arguments(program: &str, path: &Path, line: usize) -> Vec<OsString> {
    let name = Path::new(program).file_name().unwrap_or_default();
    let name = name.to_str().unwrap_or_default();
    let known = |name: &str| FORMS.iter().find(|(names, _)| names.contains(&name));
    let stem = name.split(|c: char| !c.is_alphabetic()).next();
    let form = known(stem.unwrap_or(name)).map_or(OTHERS, |(_, form)| *form);

    let file = || path.as_os_str().to_owned();
    let mut file_line = file();
    file_line.push(format!(":{line}"));
    let is_clear = !file().as_encoded_bytes().contains(&b':') && !Path::new(&file_line).exists();
    if form.contains(&FileLine) && !is_clear {
        return vec![file()];
    }
    let argument = |part: &Part| match part {
        Text(text) => OsString::from(text),
        Line => OsString::from(format!("+{line}")),
        LocalFile if names_a_host(path) => {
            let mut quoted = OsString::from("/:");
            quoted.push(path);
            quoted
        }
        File | LocalFile => file(),
        FileLine => file_line.clone(),
    };
    form.iter().map(argument).collect()
}

/// Whether emacs takes the first folder of a path for a method and a host: `/ssh:host:...`.
fn names_a_host(path: &Path) -> bool {
    let mut parts = path.components();
    parts.next() == Some(Component::RootDir)
        && parts
            .next()
            .is_some_and(|first| first.as_os_str().as_encoded_bytes().contains(&b':'))
}

#[cfg(test)]
mod tests;
