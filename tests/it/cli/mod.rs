//! Tests of the program as run from a shell: arguments, streams, files and exit codes.

mod advice;
mod arguments;
mod bench;
mod class;
mod comparing;
mod config;
mod converting;
mod explaining;
mod frames;
mod grading;
mod keys;
mod limits;
mod lsp;
mod meshes;
mod metadata;
mod parts;
mod pictures;
mod recipes;
mod reels;
mod scenes;
mod settings;
mod streams;
mod textures;
mod tracks;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const BINARY: &str = env!("CARGO_BIN_EXE_halflight");

/// A white ball in the middle of the picture, lit only by ambient light.
const BALL: &str = "\
1 1 1
1 0 9 0 0 0 0
1 sphere 0 0 0 1  1 1 1 0 0 0 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6
";

/// A temporary directory that contains [`BALL`] as `ball.ray`.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let place = Self { directory };
        place.write("ball.ray", BALL);
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.at(name), content).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).expect("a file")
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.directory.path()).expect("a directory");
        let mut names: Vec<_> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(BINARY);
        command
            .args(line.split_ascii_whitespace())
            .current_dir(self.directory.path())
            // Renders may continue what the interface keeps there.
            .env("XDG_STATE_HOME", self.at("state"))
            .env_remove("XDG_RUNTIME_DIR")
            .stdin(Stdio::null());
        command
    }

    /// Runs the program with the words of `line` as arguments and captures its output.
    fn run(&self, line: &str) -> Output {
        self.command(line).output().expect("it starts")
    }

    /// Runs the program, asserts its exit code, and returns its standard error.
    fn stderr(&self, line: &str, code: i32) -> String {
        let output = self.run(line);
        let stderr = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(code), "{line}: {stderr}");
        stderr
    }
}

/// Runs the program from a shell after the commands in `before`.
fn in_shell(place: &Place, before: &str, line: &str) -> Output {
    let script = format!("{before}; exec {BINARY} {line}");
    let mut shell = Command::new("bash");
    let shell = shell
        .args(["-c", &script])
        .current_dir(place.directory.path());
    shell.output().expect("it starts")
}

/// A ball textured with the picture file `skin.ppm`.
const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 3 image 1 1 skin.ppm
use colour ID 3 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

const SKIN: &str = "P3\n1 1\n255\n91 120 150\n";
