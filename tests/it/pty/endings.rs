//! Ways to end, to stop and to lend the terminal, and the state of the terminal afterwards.

use super::*;

#[test]
fn ctrl_c_asks_before_edits_are_lost() {
    for (answer, left, kept) in [
        ("y", BALLS.to_owned(), 0),
        ("w", edited(), 0),
        (CTRL_C, BALLS.to_owned(), 1),
    ] {
        let place = Place::new();
        let mut session = place.open_edited();
        session.send(CTRL_C);
        session.wait_for("balls.ray has unsaved edits");
        session.send(answer);
        let words = if kept == 0 { "" } else { KEPT };
        assert_end_with(session, 0, words);
        assert_eq!(place.read("balls.ray"), left, "after {answer:?}");
        assert_eq!(place.recovery_files().len(), kept, "after {answer:?}");
    }
}

#[test]
fn signals_end_the_program_with_their_exit_codes() {
    for signal in [
        Signal::INT,
        Signal::TERM,
        Signal::HUP,
        Signal::QUIT,
        Signal::ALARM,
        Signal::PROF,
        Signal::USR1,
        Signal::USR2,
        Signal::VTALARM,
        Signal::XCPU,
    ] {
        let place = Place::new();
        let session = place.open();
        kill(session.process_id(), signal);
        assert_end(session, 128 + signal.as_raw());
        assert!(place.recovery_files().is_empty(), "{signal:?}");
    }
}

#[test]
fn a_signal_at_the_first_byte_restores_the_terminal() {
    for signal in [Signal::TERM, Signal::HUP, Signal::QUIT] {
        for _ in 0..5 {
            let place = Place::new();
            let mut session = place.start(&["balls.ray"], WIDE);
            session
                .read(Duration::from_secs(10))
                .expect("the program takes the terminal");
            kill(session.process_id(), signal);
            assert_end(session, 128 + signal.as_raw());
        }
    }
}

#[test]
fn an_abort_restores_the_terminal() {
    for (signal, words) in [
        (Signal::ABORT, "halflight aborted"),
        (Signal::FPE, "halflight was ended by SIGFPE"),
        (Signal::ILL, "halflight was ended by SIGILL"),
        (Signal::SYS, "halflight was ended by SIGSYS"),
        (Signal::TRAP, "halflight was ended by SIGTRAP"),
    ] {
        let place = Place::new();
        let session = place.open();
        kill(session.process_id(), signal);
        assert_aborted(session, words);
    }
}

#[test]
fn an_abort_mentions_stored_edits() {
    let place = Place::new();
    // Without an earlier problem, the screen does not show when edits are stored.
    place.write(".local", "in the way");
    let mut session = place.open_edited();
    session.wait_for("[no backup]");
    fs::remove_file(place.at(".local")).expect("it is there");
    wait_until_gone(&mut session, "[no backup]");
    kill(session.process_id(), Signal::ABORT);
    assert_aborted(
        session,
        "halflight aborted; unsaved edits are kept, the next run of the scene offers them",
    );
}

#[cfg(target_os = "linux")]
#[test]
fn running_out_of_memory_restores_the_terminal() {
    use rustix::process::{Resource, Rlimit, prlimit};
    let place = Place::new();
    // Addresses that glibc has reserved stay usable: 64 MB for each arena but the main one.
    let environment = [("MALLOC_ARENA_MAX", "1")];
    let mut session = Session::start(place.directory.path(), &["balls.ray"], WIDE, &environment);
    wait_for_rest(&mut session);
    let nothing = Rlimit {
        current: Some(0),
        maximum: None,
    };
    let process = Pid::from_raw(session.process_id().cast_signed());
    prlimit(process, Resource::As, nothing).expect("a limit can be lowered");
    // Its cells need more memory than is left.
    session.resize(2000, 250);
    assert_aborted(session, "halflight aborted");
}

/// Asserts the death by a signal, and that a line of the restored screen consists of these words.
fn assert_aborted(mut session: Session, words: &str) {
    let status = session.end();
    session.assert_restored();
    let screen = session.screen().contents();
    assert!(
        screen.lines().any(|line| line.trim_end() == words),
        "{screen}"
    );
    assert!(status.signal().is_some(), "{status:?}");
}

#[test]
fn unsaved_edits_survive_the_process() {
    for signal in [Some(Signal::TERM), Some(Signal::HUP), None] {
        let place = Place::new();
        let mut session = place.open_edited();
        match signal {
            Some(signal) => kill(session.process_id(), signal),
            None => session.hang_up(),
        }
        session.end();
        assert_eq!(place.read("balls.ray"), BALLS);
        let kept = place.recovery_files();
        assert_eq!(kept.len(), 1, "after {signal:?}");
        assert_eq!(place.kept_texts(), [edited()]);
        let mode = fs::metadata(&kept[0]).expect("a file").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);

        let mut session = place.start(&["balls.ray"], WIDE);
        session.wait_for("balls.ray has unsaved edits from an earlier run");
        session.send("r");
        session.wait_for("balls.ray [+]");
        session.send("w");
        session.wait_for("wrote balls.ray");
        assert_eq!(place.read("balls.ray"), edited());
        quit(session);
        assert_eq!(place.recovery_files(), [] as [PathBuf; 0]);
    }
}

#[test]
fn the_program_ends_when_the_terminal_is_gone() {
    let place = Place::new();
    let mut session = place.open();
    session.hang_up();
    // Whichever comes first: a failed write or the hang-up.
    assert_eq!(session.end().code(), Some(129));
}

/// A way to end the program.
type End = dyn Fn(&mut Session);

#[test]
fn a_terminal_that_is_not_read_delays_no_ending() {
    let signal = |signal| move |session: &mut Session| kill(session.process_id(), signal);
    let endings: [(&str, i32, &End); 4] = [
        ("SIGTERM", 143, &signal(Signal::TERM)),
        ("SIGHUP", 129, &signal(Signal::HUP)),
        ("Ctrl-C twice", 0, &|session| {
            session.send([CTRL_C; 2].concat());
        }),
        ("no terminal", 129, &|session| session.hang_up_at_once()),
    ];
    for (ending, code, end) in endings {
        let place = Place::new();
        let mut session = place.open_edited();
        session.hang();
        end(&mut session);
        assert_eq!(session.end().code(), Some(code), "after {ending}");
        assert_eq!(place.kept_texts(), [edited()], "after {ending}");
        if session.has_terminal() {
            session.read_the_rest();
            session.assert_restored();
        }
    }
}

#[test]
fn an_abort_restores_a_terminal_that_is_not_read() {
    let place = Place::new();
    let mut session = place.open_edited();
    session.hang();
    kill(session.process_id(), Signal::ABORT);
    session.end();
    session.read_the_rest();
    session.assert_restored();
}

#[test]
fn quitting_takes_at_most_a_second_if_the_terminal_is_not_read() {
    let place = Place::new();
    let mut session = place.open();
    session.hang();
    let begun = Instant::now();
    session.send("q");
    assert_eq!(session.end().code(), Some(0));
    // Half a second more for a busy machine.
    let taken = begun.elapsed();
    assert!(taken < Duration::from_millis(1500), "{taken:?}");
    assert!(session.has_settings_from_before());
}

#[test]
fn a_terminal_that_is_read_again_shows_everything() {
    let place = Place::new();
    let mut session = place.open();
    session.hang();
    session.send(RADIUS_TO_2);
    session.read_again();
    session.send(CTRL_L);
    session.wait("the edit and its picture", |screen| {
        is_at_rest(screen) && screen.contents().contains("balls.ray [+]")
    });
    session.send("w");
    session.wait_for("wrote balls.ray");
    quit(session);
}

#[test]
fn the_program_stops_and_continues_as_a_job_of_a_shell() {
    let place = Place::new();
    let mut command = Command::new("/bin/sh");
    let line = "set -m; \"$0\" --color 24 balls.ray; echo ONE; read x; fg; echo TWO; read x; fg";
    command.args(["-c", line, env!("CARGO_BIN_EXE_halflight")]);
    let mut session = Session::run(command, place.directory.path(), WIDE, &[]);
    wait_for_rest(&mut session);
    let before = picture(session.screen());
    kill(session.process_in_front(), Signal::TSTP);
    session.wait_for("ONE");
    session.assert_restored();
    session.send(ENTER);
    session.wait("it is back", |screen| picture(screen) == before);
    assert!(!session.has_settings_from_before());

    session.send(CTRL_Z);
    session.wait_for("TWO");
    session.assert_restored();
    session.send(ENTER);
    session.wait("it is back again", |screen| picture(screen) == before);
    session.send("q");
    assert!(session.end().success());
    session.assert_restored();
    let written = &session.written;
    let entered = written
        .windows(ENTER_SCREEN.len())
        .filter(|w| *w == ENTER_SCREEN);
    assert_eq!(entered.count(), 3, "at the start and after each stop");
}

/// Keys that arrive while the terminal is not raw are echoed or held back.
#[test]
fn the_terminal_stays_raw_while_it_is_taken_back() {
    let place = Place::new();
    let mut session = place.open();
    for _ in 0..200 {
        let seen = session.written.len();
        kill(session.process_id(), Signal::CONT);
        while last(ENTER_SCREEN, &session.written[seen..]).is_none() {
            assert!(!session.has_settings_from_before());
            session.read(Duration::ZERO);
        }
    }
    quit(session);
}

#[test]
fn the_editor_gets_the_first_key_and_gives_the_screen_back() {
    let place = Place::new();
    place.write(
        "editor.sh",
        "echo EDITING $1\nread -r line\nprintf %s \"$line\" > line\necho '// seen' >> \"$2\"\n",
    );
    let environment = [("VISUAL", "/bin/sh editor.sh")];
    let arguments = ["--color", "24", "balls.ray"];
    let mut session = Session::start(place.directory.path(), &arguments, WIDE, &environment);
    wait_for_rest(&mut session);
    let before = picture(session.screen());
    // Opens line 5, that of the second ball.
    session.send("GE");
    session.wait_for("EDITING +5");
    assert!(!session.screen().alternate_screen());
    assert!(session.has_settings_from_before());
    session.send(["qx", ENTER].concat());
    session.wait("it is back", |screen| picture(screen).len() == before.len());
    session.wait_for("reloaded");
    assert_eq!(place.read("line"), "qx");
    assert_eq!(place.read("balls.ray"), format!("{BALLS}// seen\n"));
    session.send("q");
    assert!(session.end().success());
    session.assert_restored();
}

/// A stop from within the editor stops both, as the shell waits for both; an interrupt only affects
/// the editor.
#[test]
fn keyboard_signals_go_to_the_editor_while_it_runs() {
    let place = Place::new();
    let editor = [
        "trap '' INT QUIT",
        "kill -INT 0",
        "kill -QUIT 0",
        "kill -TSTP 0",
        "echo BACK",
        "read -r line",
    ];
    place.write(
        "editor.sh",
        &editor.join(
            "
",
        ),
    );
    let mut command = Command::new("/bin/sh");
    let line = "set -m; \"$0\" --color 24 balls.ray; echo ONE; read x; fg";
    command.args(["-c", line, env!("CARGO_BIN_EXE_halflight")]);
    let environment = [("VISUAL", "/bin/sh editor.sh")];
    let mut session = Session::run(command, place.directory.path(), WIDE, &environment);
    wait_for_rest(&mut session);
    let before = picture(session.screen());
    session.send("E");
    session.wait_for("ONE");
    session.assert_restored();
    session.send(ENTER);
    session.wait_for("BACK");
    session.send(ENTER);
    session.wait("it is back", |screen| picture(screen) == before);
    session.send("q");
    assert!(session.end().success());
    session.assert_restored();
}

/// Names that vi would execute, or that contain options, quotes, positions or line numbers.
#[test]
fn the_editor_receives_any_name_as_a_file() {
    let names = [
        "+sil !touch canary.ray",
        "-c !touch canary.ray",
        "--cmd=!touch canary.ray",
        "!touch canary.ray",
        "~;$(touch canary)`touch canary`'\".ray",
        "a:12\n3.ray",
    ];
    for name in names {
        let place = Place::new();
        place.write(name, BALLS);
        place.write("vim", "#!/bin/sh\nprintf '%s\\0' \"$@\" > given\n");
        let mode = fs::Permissions::from_mode(0o700);
        fs::set_permissions(place.at("vim"), mode).expect("its owner");
        let environment = [("EDITOR", "./vim '-u' my\\ vimrc")];
        let arguments = ["--color", "24", "--", name];
        let mut session =
            Session::start(place.directory.path(), &arguments, (80, 24), &environment);
        session.wait("the picture", |screen| !picture(screen).is_empty());
        session.send("GE");
        session.wait("it is back", |screen| {
            place.at("given").exists() && !picture(screen).is_empty()
        });
        let folder = fs::canonicalize(place.directory.path()).expect("a place");
        let file = folder.join(name).display().to_string();
        let expected = ["-u", "my vimrc", "+5", "--", &file, ""];
        assert_eq!(place.read("given"), expected.join("\0"));
        quit(session);
    }
}

#[test]
fn a_pipe_is_refused_and_does_not_delay_saving() {
    use rustix::fs::{CWD, FileType, Mode, mknodat};
    let place = Place::new();
    let mut session = place.open_edited();
    mknodat(CWD, place.at("pipe.ray"), FileType::Fifo, Mode::RWXU, 0).expect("a pipe");
    mknodat(CWD, place.at("pipe"), FileType::Fifo, Mode::RWXU, 0).expect("a pipe");
    session.send(":w! pipe\r");
    session.wait_for("pipe: the name must end in .ray; pipe: is a pipe, not a file");
    session.send(ESC);
    wait_until_gone(&mut session, "w pipe.ray");
    session.send(":w! pipe.ray\r");
    session.wait_for("pipe.ray: is a pipe, not a file");
    session.send(":wq\r");
    assert_end(session, 0);
    assert_eq!(place.read("balls.ray"), edited());
}

#[test]
fn an_export_does_not_replace_a_picture_written_by_another_program() {
    let place = Place::new();
    let mut session = place.open();
    let export = ":export a.bmp 8x6 1\r";
    for _ in 0..2 {
        session.send(export);
        session.wait_for("wrote a.bmp");
        session.send("j");
        wait_until_gone(&mut session, "wrote a.bmp");
    }
    place.write("a.bmp", "theirs");
    session.send(export);
    session.wait_for("a.bmp has changed since it was exported: use :export! a.bmp to overwrite it");
    assert_eq!(place.read("a.bmp"), "theirs");
    quit(session);
}

/// Relative paths lead into the moved folder, regardless of what is at its old path.
#[test]
fn a_moved_folder_is_reported() {
    let place = Place::new();
    fs::create_dir(place.at("old")).expect("the folder is new");
    fs::rename(place.at("balls.ray"), place.at("old/balls.ray")).expect("it is there");
    let absolute = place.at("old/balls.ray").display().to_string();
    for (name, words) in [
        ("balls.ray", "the scene's folder was moved to"),
        (&absolute, "is now a different folder"),
    ] {
        let arguments = ["--color", "24", name];
        let mut session = Session::start(&place.at("old"), &arguments, (250, 40), &[]);
        wait_for_rest(&mut session);
        fs::rename(place.at("old"), place.at("new")).expect("it is there");
        if name == absolute {
            session.wait_for("[file missing]");
        }
        fs::create_dir(place.at("old")).expect("it is free");
        place.write("old/balls.ray", BALLS);
        session.wait_for(words);
        fs::remove_dir_all(place.at("new")).expect("it is there");
        session.send("q");
        session.end();
    }
}

#[test]
fn an_interrupted_save_is_reported() {
    let place = Place::new();
    place.write(".halflight-backup-0-00c0ffee-balls.ray", "old");
    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for("a save of balls.ray was interrupted");
    quit(session);
}
