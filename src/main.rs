//! Halflight: edit a scene, see it, make a picture of it.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use halflight::cli::{self, Command, Stop};
use halflight::{batch, ui};

fn main() -> ExitCode {
    ExitCode::from(match cli::parse(std::env::args_os()) {
        Ok(Command::Interface(options)) => interface(&options),
        Ok(Command::Render(work)) => cli::exit_code(&batch::render(&work)),
        Ok(Command::Check(scenes)) => cli::exit_code(&batch::check(&scenes)),
        Err(stop) => print(&stop),
    })
}

fn interface(options: &ui::Options) -> u8 {
    if !io::stdout().is_terminal() {
        complain(
            "the interface needs a terminal; to make a picture: halflight render SCENE -o FILE",
        );
        return cli::USAGE;
    }
    let outcome = ui::run(options);
    if let Err(error) = &outcome {
        complain(&error.to_string());
    }
    cli::interface_exit_code(&outcome)
}

/// Prints a text that was asked for to the output stream, any other to the error stream.
fn print(stop: &Stop) -> u8 {
    // Nobody is left to be told if the stream is closed.
    let _ = match stop.code {
        cli::DONE => io::stdout().write_all(stop.text.as_bytes()),
        _ => io::stderr().write_all(stop.text.as_bytes()),
    };
    stop.code
}

fn complain(message: &str) {
    let _ = writeln!(io::stderr(), "error: {}", halflight::text::visible(message));
}
