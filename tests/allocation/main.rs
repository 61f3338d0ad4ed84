//! When an allocation fails, the program ends with a message and an exit code, or aborts, and
//! always restores the terminal. Also limits how much is allocated for hostile files.
//!
//! The program under test is this one, started again with an allocator that fails at the k-th
//! allocation, or from there on. This needs its own `main`.

mod failing;
#[allow(dead_code, reason = "not all of the harness is needed here")]
#[path = "../harness/mod.rs"]
mod harness;
mod hostile;

use std::env;
use std::ffi::OsString;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, ExitCode, Output};
use std::time::{Duration, Instant};

use halflight::{batch, cli, ui};

use harness::Session;

/// Marks this process as the program under test.
const CHILD: &str = "--child";

/// Command lines in the folder of scenes, and the number of failures to try for each.
const WORK: [(&str, u64); 2] = [
    ("check default.ray still-life.dat carousel.xml", 12),
    (
        "render default.ray -o - --size 8x6 --spp 1 --threads 2 --format png",
        12,
    ),
];

/// The number of failures to try for the interface.
const INTERFACE: u64 = 4;

/// Nothing takes this long.
const WATCHDOG: Duration = Duration::from_secs(60);

const SIGABRT: i32 = 6;

fn main() -> ExitCode {
    let mut arguments = env::args_os();
    if arguments.nth(1).is_some_and(|first| first == CHILD) {
        return child(arguments);
    }
    for (arguments, samples) in WORK {
        headless(arguments, samples);
    }
    interface();
    hostile::check();
    println!("allocations that fail: passed");
    ExitCode::SUCCESS
}

/// Runs `FIRST LAST ARGUMENTS…`: a command line with the range of allocations that fail.
fn child(mut arguments: impl Iterator<Item = OsString>) -> ExitCode {
    let mut number = || arguments.next()?.to_str()?.parse().ok();
    let (first, last) = number().zip(number()).expect("two numbers");
    let command = cli::parse([OsString::from("halflight")].into_iter().chain(arguments));
    failing::fail(first, last);
    let code = match command {
        Ok(cli::Command::Render(work)) => cli::exit_code(&batch::render(work)),
        Ok(cli::Command::Explain(work)) => cli::exit_code(&batch::explain(&work)),
        Ok(cli::Command::Convert(work)) => cli::exit_code(&batch::convert(&work)),
        Ok(cli::Command::Check(work)) => cli::exit_code(&batch::check(&work)),
        Ok(cli::Command::Interface(options, ..)) => cli::interface_exit_code(&ui::run(&options)),
        Ok(
            command @ (cli::Command::Bench(_)
            | cli::Command::Merge(_)
            | cli::Command::Show(_)
            | cli::Command::Compare(_)
            | cli::Command::Samples(_)
            | cli::Command::Lsp
            | cli::Command::Doctor(_)),
        ) => {
            panic!("{command:?} is not tested here")
        }
        Err(stop) => panic!("{}", stop.text),
    };
    let count = failing::count();
    failing::fail(u64::MAX, u64::MAX);
    if first == u64::MAX {
        eprintln!("{count} allocations, {} bytes", failing::most_bytes());
    }
    ExitCode::from(code)
}

fn scenes() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes"))
}

/// Runs a command line in a folder, with allocations `first` to `last` failing.
fn run_in(folder: &Path, arguments: &str, first: u64, last: u64) -> Output {
    let mut command = Command::new(env::current_exe().expect("this program"));
    command.args([CHILD, &first.to_string(), &last.to_string()]);
    command.args(arguments.split(' ')).current_dir(folder);
    command.env_remove("RUST_BACKTRACE");
    command.output().expect("it starts")
}

fn run(arguments: &str, first: u64, last: u64) -> Output {
    run_in(scenes(), arguments, first, last)
}

/// The allocations to fail out of `count`: most of them early, when little is set up yet, and
/// some among all others.
fn samples(count: u64, samples: u64) -> impl Iterator<Item = u64> {
    (1..=samples).map(move |sample| (count * sample * sample).div_ceil(samples * samples))
}

/// Every failure ends in an exit code and a message, or in an abort that states its reason.
fn headless(arguments: &str, failures: u64) {
    let whole = run(arguments, u64::MAX, u64::MAX);
    let stderr = String::from_utf8_lossy(&whole.stderr).into_owned();
    assert!(whole.status.success(), "{arguments}: {stderr}");
    let count = stderr
        .lines()
        .last()
        .and_then(|line| line.split(' ').next());
    let count: u64 = count.and_then(|count| count.parse().ok()).expect("a count");
    for first in samples(count, failures) {
        for last in [first, u64::MAX] {
            let ended = run(arguments, first, last);
            let stderr = String::from_utf8_lossy(&ended.stderr);
            let what = format!(
                "{arguments}: allocations {first} to {last}: {:?}: {stderr}",
                ended.status
            );
            match (ended.status.code(), ended.status.signal()) {
                (Some(0), _) => {}
                (Some(1 | 65 | 66 | 73), _) => assert!(stderr.contains("error: "), "{what}"),
                (_, Some(SIGABRT)) => {
                    assert!(stderr.contains("memory allocation of "), "{what}");
                }
                _ => panic!("{what}"),
            }
        }
    }
}

/// The terminal is restored after any failure.
fn interface() {
    let start = |first: u64| {
        let mut command = Command::new(env::current_exe().expect("this program"));
        let (first, last) = (first.to_string(), first.to_string());
        command.args([CHILD, &first, &last, "default.ray", "--spp", "1"]);
        let home = tempfile::tempdir().expect("a folder");
        let state = home.path().to_string_lossy().into_owned();
        let session = Session::run(command, scenes(), (100, 30), &[("HOME", &state)]);
        (session, home)
    };
    let end = |mut session: Session| {
        let deadline = Instant::now() + WATCHDOG;
        let mut has_quit = false;
        while session.ended().is_none() {
            assert!(Instant::now() < deadline, "timeout:\n{}", session.text());
            session.read(Duration::from_millis(5));
            if !has_quit && session.text().contains(" spp") {
                has_quit = true;
                session.send("q");
            }
        }
        let status = session.end();
        session.assert_restored();
        // An abort prints its reason while the interface still owns the screen.
        let written = String::from_utf8_lossy(&session.written);
        match (status.code(), status.signal()) {
            (Some(0), None) => {}
            (Some(1), None) => assert!(written.contains("error: "), "{written}"),
            (_, Some(SIGABRT)) => {
                assert!(written.contains("memory allocation of "), "{written}");
            }
            _ => panic!("{status:?}: {written}"),
        }
        session.text()
    };
    let text = end(start(u64::MAX).0);
    let count = text
        .split_whitespace()
        .next()
        .and_then(|count| count.parse().ok());
    for first in samples(count.expect("a count"), INTERFACE) {
        let (session, _home) = start(first);
        end(session);
    }
}
