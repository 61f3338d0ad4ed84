//! Runs git on a repository whose settings came with the scene, so that the repository decides
//! nothing but what the objects hold.
//!
//! Many settings of a repository name programs. Git runs them to fetch objects that it lacks, or for
//! work that is not done here: hooks, filters, pagers, editors and the like. So only objects are
//! read, and nothing is fetched. An object of kilobytes may unfold to gigabytes, and a setting may
//! name a pipe that nobody writes: memory and time are limited.

use std::env;
use std::ffi::{OsStr, OsString};
use std::io::{self, Read};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread;
use std::time::{Duration, Instant};

use crate::queue::spawn;

/// What keeps git from fetching objects, for which it would run programs that the repository names.
/// Each suffices; git knows the first since version 2.45.
pub(super) const GUARDS: [(&str, &str); 2] =
    [("GIT_NO_LAZY_FETCH", "1"), ("GIT_ALLOW_PROTOCOL", "none")];

/// Time for all that git is asked about a scene.
const PATIENCE: Duration = Duration::from_secs(5);

/// Interval between questions whether git has ended.
const POLL: Duration = Duration::from_millis(2);

/// What git would unpack before it asks whether it may fetch, and the programs that it would run for
/// each reference of that.
const UNBUNDLED: [&str; 2] = ["fetch.bundleURI=", "core.hooksPath=/dev/null"];

/// Files of more bytes are not held in memory by git, whatever the repository says.
const STREAMED: &str = "core.bigFileThreshold=16m";

/// Bytes that git may allocate at once besides those of the file asked for: commits and folders
/// take less.
const ROOM: u64 = 256 << 20;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// The most bytes of a complaint.
const COMPLAINT: u64 = 1 << 12;

/// Git in a folder.
#[derive(Clone, Debug)]
pub(super) struct Git<'a> {
    program: OsString,
    folder: &'a Path,
    guards: &'a [(&'static str, &'static str)],
    deadline: Instant,
}

/// A git that has ended, and what it has written.
#[derive(Debug)]
pub(super) struct Ran {
    pub(super) has_succeeded: bool,
    pub(super) output: Vec<u8>,
    pub(super) complaint: String,
}

impl<'a> Git<'a> {
    /// The user's git, to be asked from now on.
    pub(super) fn of_folder(folder: &'a Path) -> Self {
        Self {
            program: "git".into(),
            folder,
            guards: &GUARDS,
            deadline: Instant::now() + PATIENCE,
        }
    }

    /// Another git, with some of the [`GUARDS`] only.
    #[cfg(test)]
    pub(super) fn with(self, program: &Path, guards: &'a [(&'static str, &'static str)]) -> Self {
        Self {
            program: program.into(),
            guards,
            ..self
        }
    }

    /// Git with another deadline.
    #[cfg(test)]
    pub(super) fn until(self, deadline: Instant) -> Self {
        Self { deadline, ..self }
    }

    /// Runs git to read objects. `look` is called with the output so far, whenever there is more.
    /// Stops git, and fails, if `look` does, if there are more than `most` bytes, or if the time is
    /// over.
    pub(super) fn run(
        &self,
        arguments: &[&OsStr],
        most: u64,
        mut look: impl FnMut(&[u8]) -> Result<(), String>,
    ) -> Result<Ran, String> {
        let names = env::vars_os().map(|(name, _)| name);
        let mut command = self.command(names, most);
        command.args(arguments);
        let mut running = Running::start(&mut command)?;
        let pieces = running.listen()?;
        let mut output = Vec::new();
        loop {
            let left = self.deadline.saturating_duration_since(Instant::now());
            match pieces.recv_timeout(left) {
                Ok(Piece::Output(bytes)) => {
                    output.extend(bytes);
                    if most < output.len() as u64 {
                        return Err("git: the output is too long".to_owned());
                    }
                    look(&output)?;
                }
                Ok(Piece::Complaint(complaint)) => {
                    let status = running.wait(self.deadline)?;
                    return Ok(Ran {
                        has_succeeded: status.success(),
                        output,
                        complaint,
                    });
                }
                Err(RecvTimeoutError::Timeout) => return Err(too_late()),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err("git: its output cannot be read".to_owned());
                }
            }
        }
    }

    /// Git as it is run if the environment has variables of these names, for `most` bytes of output.
    fn command(&self, names: impl Iterator<Item = OsString>, most: u64) -> Command {
        let mut command = Command::new(&self.program);
        // A variable may name another repository, a program, or a file to write to.
        for name in names.filter(|name| name.as_encoded_bytes().starts_with(b"GIT_")) {
            command.env_remove(name);
        }
        // Of a file stored as a difference, the other file is held too.
        let room = ROOM.saturating_add(most.saturating_mul(2));
        command
            .arg("-C")
            .arg(self.folder)
            .args(["-c", STREAMED])
            .args(UNBUNDLED.iter().flat_map(|setting| ["-c", setting]))
            .envs(self.guards.iter().copied())
            .env("GIT_ALLOC_LIMIT", room.to_string())
            .env("GIT_LITERAL_PATHSPECS", "1")
            // The messages are read, and nothing may wait for an answer.
            .env("LC_ALL", "C")
            .env("GIT_TERMINAL_PROMPT", "0")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }
}

/// What git writes, in the order in which it is read.
enum Piece {
    Output(Vec<u8>),
    /// All it writes to standard error, up to [`COMPLAINT`]; nothing follows.
    Complaint(String),
}

/// Git while it runs. It is stopped when this is dropped, with the programs that it runs.
struct Running(Child);

impl Running {
    fn start(command: &mut Command) -> Result<Self, String> {
        std::os::unix::process::CommandExt::process_group(command, 0);
        let spawned = command.spawn().map(Self);
        spawned.map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => "cannot run git: it is not installed".to_owned(),
            _ => format!("cannot run git: {error}"),
        })
    }

    /// Reads what git writes, on a thread that ends with git.
    fn listen(&mut self) -> Result<Receiver<Piece>, String> {
        let (send, pieces) = mpsc::sync_channel(2);
        let streams = self.0.stdout.take().zip(self.0.stderr.take());
        let spawned = spawn("git", move || {
            if let Some((output, complaints)) = streams {
                read(output, complaints, &send);
            }
        });
        spawned.map_err(|error| format!("cannot run git: {error}"))?;
        Ok(pieces)
    }

    /// Waits for the end of git, which has closed its output.
    fn wait(&mut self, deadline: Instant) -> Result<ExitStatus, String> {
        loop {
            match self.0.try_wait() {
                Ok(Some(status)) => return Ok(status),
                Ok(None) if Instant::now() < deadline => thread::sleep(POLL),
                Ok(None) => return Err(too_late()),
                Err(error) => return Err(format!("cannot run git: {error}")),
            }
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        use rustix::process::{Pid, Signal, kill_process_group};
        if matches!(self.0.try_wait(), Ok(Some(_))) {
            return;
        }
        let _ = kill_process_group(Pid::from_child(&self.0), Signal::KILL);
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Reads two streams to their ends, or until nobody listens; both at once, since a writer that nobody
/// reads is stopped.
fn read(output: impl Read, complaints: impl Read + Send, send: &SyncSender<Piece>) {
    let said = thread::scope(|scope| {
        let thread = thread::Builder::new().name("git's complaints".to_owned());
        let listener = thread.spawn_scoped(scope, || beginning(complaints));
        read_output(output, send);
        let said = listener.ok().and_then(|listener| listener.join().ok());
        said.unwrap_or_default()
    });
    let _ = send.send(Piece::Complaint(said));
}

/// Reads a stream to its end and returns the first [`COMPLAINT`] bytes.
fn beginning(mut complaints: impl Read) -> String {
    let mut said = Vec::new();
    let _ = complaints.by_ref().take(COMPLAINT).read_to_end(&mut said);
    let _ = io::copy(&mut complaints, &mut io::sink());
    String::from_utf8_lossy(&said).into_owned()
}

fn read_output(mut output: impl Read, send: &SyncSender<Piece>) {
    let mut chunk = vec![0; CHUNK];
    loop {
        match output.read(&mut chunk) {
            Ok(length @ 1..) => {
                if send.send(Piece::Output(chunk[..length].to_vec())).is_err() {
                    return;
                }
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Ok(0) | Err(_) => break,
        }
    }
}

fn too_late() -> String {
    let seconds = PATIENCE.as_secs();
    format!("git took longer than {seconds} s and was stopped")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_variable_of_git_is_inherited() {
        let git = Git::of_folder(Path::new("."));
        let names = ["GIT_DIR", "PATH", "GIT_SSH_COMMAND", "GIT_NO_LAZY_FETCH"];
        let command = git.command(names.into_iter().map(OsString::from), 0);
        let set = |wanted: &str| {
            let mut all = command.get_envs();
            all.find_map(|(name, value)| (name == wanted).then_some(value))
        };
        for (name, value) in [
            ("GIT_DIR", Some(None)),
            ("PATH", None),
            ("GIT_SSH_COMMAND", Some(None)),
            ("GIT_NO_LAZY_FETCH", Some(Some(OsStr::new("1")))),
            ("GIT_ALLOW_PROTOCOL", Some(Some(OsStr::new("none")))),
        ] {
            assert_eq!(set(name), value, "{name}");
        }
    }
}
