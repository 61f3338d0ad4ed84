//! Halflight: edit a scene, see it, make a picture of it.

use std::io::{self, Write};
use std::process::ExitCode;
#[cfg(unix)]
use std::sync::Arc;

use halflight::cli::{self, Command, Stop};
use halflight::text::{visible, without_codes};
use halflight::{batch, ui};

fn main() -> ExitCode {
    #[cfg(unix)]
    outlive_size_limits();
    ExitCode::from(match cli::parse(std::env::args_os()) {
        Ok(Command::Interface(options)) => interface(&options),
        Ok(Command::Render(work)) => cli::exit_code(&batch::render(&work)),
        Ok(Command::Check(work)) => cli::exit_code(&batch::check(&work)),
        Ok(Command::Doctor(scene)) => print(&Stop {
            text: ui::doctor::examine(scene.as_deref()),
            code: cli::DONE,
        }),
        Err(stop) => print(&stop),
    })
}

/// Makes a write beyond the limit on the sizes of files an error as others are. By default it ends
/// the process, which would leave a temporary file behind.
#[cfg(unix)]
fn outlive_size_limits() {
    // Without the handler the default is left.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

fn interface(options: &ui::Options) -> u8 {
    let outcome = ui::run(options);
    if let Err(error) = &outcome {
        complain(&error.to_string());
        if let Some(note) = ui::note(options, error) {
            tell("note", &note);
        }
    }
    cli::interface_exit_code(&outcome)
}

/// Prints a text that was asked for to the output stream, any other to the error stream.
fn print(stop: &Stop) -> u8 {
    let text = stop.text.as_bytes();
    if stop.code != cli::DONE {
        // Nobody is left to be told if the stream is closed.
        let _ = io::stderr().write_all(text);
        return stop.code;
    }
    let mut stdout = io::stdout();
    match stdout.write_all(text).and_then(|()| stdout.flush()) {
        // A reader that leaves early has what it wanted.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            complain(&format!("standard output: {error}"));
            cli::FAILED
        }
        _ => cli::DONE,
    }
}

fn complain(message: &str) {
    tell("error", message);
}

fn tell(kind: &str, message: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {}", visible(&without_codes(message)));
}
