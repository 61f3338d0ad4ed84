//! The user's editor: the program, and the arguments that open a file at a line.
//!
//! The name of a scene is untrusted, because it came with the scene. Editors must take it for a
//! file whatever its first characters: vi runs what follows `+`, ed what follows `!`, and emacs
//! calls other hosts for `/ssh:`. So the name is passed as an absolute path, after `--` if the
//! editor supports it, in the form listed for the editor, and never through a shell. If a form
//! cannot carry a name safely, the line is omitted.

use std::env::{self, VarError};
use std::ffi::OsString;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, ExitStatus};

use text::shell_words;

/// The editor if neither variable is set.
const DEFAULT: &str = "vi";

/// Argument forms by prefix of the program's name: `vim` also matches `vim.basic`, `emacs` also
/// `emacs-nox`.
const FORMS: &[(&[&str], Template)] = &[
    (
        &[
            "vi", "vim", "nvim", "nvi", "view", "vimdiff", "rvim", "rview", "gvim", "gview",
            "mvim", "ex", "kak",
        ],
        &[Line, Text("--"), File],
    ),
    // micro takes `--` after any other argument for a file.
    (&["nano", "rnano", "micro"], &[Text("--"), Line, File]),
    (&["emacs"], &[Line, Text("--"), LocalFile]),
    (&["emacsclient"], &[Text("--"), Line, LocalFile]),
    // Not every version supports `+LINE`.
    (&["ed", "red"], &[File]),
    (&["hx", "helix"], &[Text("--"), FileLine]),
    (&["subl", "sublime", "zed", "zeditor"], &[FileLine]),
    (
        &["code", "codium", "vscodium", "cursor"],
        &[Text("--goto"), FileLine],
    ),
];

/// The form that most editors support.
const OTHERS: Template = &[Line, File];

/// The arguments that tell an editor the file and line, in order.
type Template = &'static [Argument];

use Argument::{File, FileLine, Line, LocalFile, Text};

/// One argument of an editor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Argument {
    /// An option, passed unchanged.
    Text(&'static str),
    /// `+LINE`, which most editors understand.
    Line,
    /// The path of the file.
    File,
    /// The path of the file, quoted for emacs if it would name another host.
    LocalFile,
    /// `FILE:LINE`. A path that contains a colon may be split at another place, or the whole may be
    /// the name of another file: then only the file is passed, without the argument before it.
    FileLine,
}

/// Opens the user's editor on a file at a line, from 1, and waits for it to end. A command line that
/// is configured takes precedence over the environment's.
pub(super) fn run(configured: Option<&str>, path: &Path, line: usize) -> Result<(), String> {
    let (program, status) = open(configured, path, line).map_err(|reason| {
        let place = match configured {
            Some(_) => "`editor` in the configuration",
            None => "$VISUAL or $EDITOR",
        };
        format!("cannot start the editor: {reason}; set {place} to another one")
    })?;
    ending(&program, status)
}

/// Starts the editor and waits; returns its program and exit status.
fn open(
    configured: Option<&str>,
    path: &Path,
    line: usize,
) -> Result<(String, ExitStatus), String> {
    let command = match configured {
        Some(command) => Some(command.to_owned()),
        None => variable("VISUAL")?.or(variable("EDITOR")?),
    };
    let words = words(command.as_deref().unwrap_or(DEFAULT))?;
    let (program, own) = words.split_first().ok_or("the command is empty")?;
    let path = place(path).map_err(|error| error.to_string())?;
    let status = Command::new(program)
        .args(own)
        .args(arguments(program, &path, line))
        .status()
        .map_err(|error| format!("{program}: {error}"))?;
    Ok((program.clone(), status))
}

/// Describes how a program failed.
fn ending(program: &str, status: ExitStatus) -> Result<(), String> {
    if status.success() {
        return Ok(());
    }
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        let reason = format!("the editor {program} was killed by signal {signal}");
        return Err(reason);
    }
    Err(match status.code() {
        Some(code) => format!("the editor {program} failed with exit status {code}"),
        None => format!("the editor {program} failed: {status}"),
    })
}

/// The value of an environment variable, if set.
fn variable(name: &str) -> Result<Option<String>, String> {
    match env::var(name) {
        Ok(value) => Ok(Some(value).filter(|value| !value.trim().is_empty())),
        Err(VarError::NotPresent) => Ok(None),
        Err(VarError::NotUnicode(_)) => Err(format!("${name} is not UTF-8 text")),
    }
}

/// Splits a command into its program and arguments, with a shell's quotes and backslashes. An
/// absolute path of a program may contain spaces without them; a relative one may not, as it could
/// come with a scene.
fn words(command: &str) -> Result<Vec<String>, String> {
    if Path::new(command).is_absolute() && Path::new(command).is_file() {
        return Ok(vec![command.to_owned()]);
    }
    shell_words(command)
        .ok_or_else(|| format!("`{command}` ends within a quote or after a backslash"))
}

/// The absolute path of a file, with single slashes.
fn place(path: &Path) -> io::Result<PathBuf> {
    let absolute = match std::path::absolute(path) {
        // A deleted folder has no path but may still be the current one.
        Err(error) if error.kind() == io::ErrorKind::NotFound => Path::new(".").join(path),
        absolute => absolute?,
    };
    let parts: PathBuf = absolute.components().collect();
    Ok(parts)
}

/// The arguments passed to an editor besides the user's own.
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
    let argument = |part: &Argument| match part {
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
    let has_colon = |part: Component| part.as_os_str().as_encoded_bytes().contains(&b':');
    let mut parts = path.components();
    parts.next() == Some(Component::RootDir) && parts.next().is_some_and(has_colon)
}

#[cfg(test)]
mod tests;
