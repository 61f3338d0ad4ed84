//! Halflight: edit a scene, see it traced, render it.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::Arc;

use halflight::cli::{self, Command, Purpose, Stop};
use halflight::memory::{self, Allocator};
use halflight::text::{Diagnostic, visible, without_codes};
use halflight::{batch, config, lsp, ui};

#[global_allocator]
static ALLOCATOR: Allocator = Allocator;

fn main() -> ExitCode {
    memory::malloc::share();
    survive_file_size_limit();
    ExitCode::from(match cli::parse(std::env::args_os()) {
        Ok(Command::Interface(options, source, purpose)) => configured(options, &source, purpose),
        Ok(Command::Render(work)) => cli::exit_code(&batch::render(work)),
        Ok(Command::Check(work)) => cli::exit_code(&batch::check(&work)),
        Ok(Command::Bench(work)) => cli::exit_code(&batch::bench(&work)),
        Ok(Command::Merge(work)) => cli::exit_code(&batch::merge(&work)),
        Ok(Command::Show(work)) => cli::comparison_exit_code(&batch::show(&work)),
        Ok(Command::Compare(work)) => cli::comparison_exit_code(&batch::compare(&work)),
        Ok(Command::Explain(work)) => cli::exit_code(&batch::explain(&work)),
        Ok(Command::Convert(work)) => cli::exit_code(&batch::convert(&work)),
        Ok(Command::Samples(work)) => cli::exit_code(&batch::write_samples(&work)),
        Ok(Command::Lsp) => serve(),
        Ok(Command::Doctor(scene)) => print(&Stop {
            text: ui::doctor::examine(scene.as_deref()),
            code: cli::DONE,
        }),
        Err(stop) => print(&stop),
    })
}

/// Serves an editor. What ends the session too early goes to standard error, which editors log.
fn serve() -> u8 {
    match lsp::serve(io::stdin(), io::stdout().lock()) {
        Ok(()) => cli::DONE,
        Err(error) => {
            eprintln!("halflight lsp: {error}");
            cli::FAILED
        }
    }
}

/// Makes a write beyond the file size limit an ordinary error. By default it kills the process,
/// which would leave a temporary file behind.
fn survive_file_size_limit() {
    // If this fails, the default remains.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Opens the interface, or prints its configuration.
fn configured(options: ui::Options, source: &config::Source, purpose: Purpose) -> u8 {
    let options = match config::complete(options, source) {
        Ok(options) => options,
        Err(error) => {
            match &error {
                config::Error::Faulty { name, text, errors } => report_faults(name, text, errors),
                config::Error::Read(error) => report_error(&error.to_string()),
            }
            return cli::config_exit_code(&error);
        }
    };
    let text = match purpose {
        Purpose::Open => return interface(&options),
        Purpose::PrintConfig => config::print_config(&options),
        Purpose::PrintKeys => config::print_keys(&options.keymap),
    };
    let code = cli::DONE;
    print(&Stop { text, code })
}

/// Prints the errors of a text that the user wrote, with excerpts.
fn report_faults(name: &str, text: &str, errors: &[Diagnostic]) {
    // A failure cannot be reported anywhere.
    let _ = writeln!(io::stderr(), "{}", batch::annotated(name, text, errors));
}

fn interface(options: &ui::Options) -> u8 {
    let outcome = ui::run(options);
    if let Err(ui::Error::Faulty { name, text, errors }) = &outcome {
        report_faults(name, text, errors);
    } else if let Err(error) = &outcome {
        report_error(&error.to_string());
        if let Some(note) = ui::note(options, error) {
            report("note", &note);
        }
    }
    cli::interface_exit_code(&outcome)
}

/// Prints a requested text to standard output, any other to standard error.
fn print(stop: &Stop) -> u8 {
    let text = stop.text.as_bytes();
    if stop.code != cli::DONE {
        // A failure cannot be reported anywhere.
        let _ = io::stderr().write_all(text);
        return stop.code;
    }
    let mut stdout = io::stdout();
    match stdout.write_all(text).and_then(|()| stdout.flush()) {
        // A reader that closes the pipe early has what it wanted.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            report_error(&format!("standard output: {error}"));
            cli::FAILED
        }
        _ => cli::DONE,
    }
}

fn report_error(message: &str) {
    report("error", message);
}

fn report(kind: &str, message: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {}", visible(&without_codes(message)));
}
