//! The interface on a terminal, from the first key to the restored screen.
#![cfg(unix)]

mod harness;

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

use portable_pty::CommandBuilder;
use rustix::process::{Pid, Signal, kill_process};
use tempfile::TempDir;
use vt100::{Color, MouseProtocolMode, Screen};

use harness::{Pixels, Session, last, picture};

/// Two balls that shine by ambient light alone, so that their pixels are of their own colours.
const BALLS: &str = "\
1 1 1
1 0 9 0 0 0 0
2
sphere -1 0 0 .80  1 0 0  0 0 0  0 0 0  1 0 0 1  // the red one
sphere  1 0 0 0.8  0 1 0  0 0 0  0 0 0  1 0 0 1  // the green one
// view: eye 0 0 8 target 0 0 0 up 0 1 0 fov 40 size 80 60
";

const RED: Color = Color::Rgb(255, 0, 0);
const GREEN: Color = Color::Rgb(0, 255, 0);
const BLUE: Color = Color::Rgb(0, 0, 255);

/// The keys that make the first ball's radius 2, from the start.
const RADIUS_TO_2: &str = "\rj2\r";

const DEFAULT: &str = include_str!("../scenes/default.ray");

const ENTER: &str = "\r";
const ESC: &str = "\x1b";
const CTRL_C: &str = "\x03";
const CTRL_Z: &str = "\x1a";

/// Begins what is on the screen only while the program has it.
const ENTER_SCREEN: &[u8] = b"\x1b[?1049h";

/// A directory with a scene in `balls.ray`.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let place = Self { directory };
        place.write("balls.ray", BALLS);
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: &str) {
        fs::write(self.at(name), content).expect("written");
    }

    /// Replaces a file at once, as most editors do.
    fn replace(&self, name: &str, content: &str) {
        self.write("new~", content);
        fs::rename(self.at("new~"), self.at(name)).expect("renamed");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).expect("a text")
    }

    fn start(&self, arguments: &[&str], size: (u16, u16)) -> Session {
        let arguments = [&["--color", "24"], arguments].concat();
        Session::start(self.directory.path(), &arguments, size, &[])
    }

    /// Opens `balls.ray` and waits for its finished picture.
    fn open(&self) -> Session {
        let mut session = self.start(&["balls.ray"], WIDE);
        wait_for_rest(&mut session);
        session
    }

    /// Opens `balls.ray` and changes a number.
    fn open_edited(&self) -> Session {
        let mut session = self.open();
        session.send(RADIUS_TO_2);
        session.wait_for("balls.ray [+]");
        session
    }

    /// The edits that were kept for the next run.
    fn recovery_files(&self) -> Vec<PathBuf> {
        let folder = self.at(".local/state/halflight/recovery");
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries
            .map(|entry| entry.expect("an entry").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "ray"))
            .collect()
    }
}

/// What is said at the end where unsaved edits are kept.
const KEPT: &str = "unsaved edits are kept; halflight balls.ray offers them";

/// Wide enough for long messages beside the file's name.
const WIDE: (u16, u16) = (150, 40);

/// The scene after [`RADIUS_TO_2`].
fn edited() -> String {
    BALLS.replacen(".80", "2", 1)
}

fn is_at_rest(screen: &Screen) -> bool {
    !picture(screen).is_empty()
        && screen.contents().contains("64 spp")
        && !screen.contents().contains("pass ")
}

/// Waits until the picture is finished.
fn wait_for_rest(session: &mut Session) {
    session.wait("waiting for the finished picture", is_at_rest);
}

/// Waits until a finished picture holds a colour; returns a cell that does.
fn wait_for_colour(session: &mut Session, colour: Color) -> Pixels {
    let find = |screen: &Screen| picture(screen).into_iter().find(|p| p.upper == colour);
    session.wait(&format!("waiting for {colour:?}"), |screen| {
        is_at_rest(screen) && find(screen).is_some()
    });
    find(session.screen()).expect("it was just there")
}

/// Waits until a finished picture differs from another one.
fn wait_for_change(session: &mut Session, from: &[Pixels]) {
    session.wait("waiting for another picture", |screen| {
        is_at_rest(screen) && picture(screen) != from
    });
}

fn wait_until_gone(session: &mut Session, text: &str) {
    session.wait(&format!("waiting for {text:?} to go"), |screen| {
        !screen.contents().contains(text)
    });
}

fn kill(process: u32, signal: Signal) {
    let process = Pid::from_raw(process.cast_signed()).expect("a process");
    kill_process(process, signal).expect("it can be sent signals");
}

/// Quits and expects a terminal as before.
fn quit(mut session: Session) {
    session.send("q");
    assert_end(session, 0);
}

fn assert_end(session: Session, code: u32) {
    assert_end_with(session, code, "");
}

/// Expects the end, and only these words on the screen.
fn assert_end_with(mut session: Session, code: u32, words: &str) {
    let status = session.end();
    session.assert_restored();
    assert_eq!(session.text().trim_end(), words);
    assert_eq!((status.exit_code(), status.signal()), (code, None));
}

#[test]
fn a_scene_is_edited_seen_reloaded_and_exported() {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
    let mut session = place.start(&["default.ray"], WIDE);
    wait_for_rest(&mut session);
    assert!(!session.has_settings_from_before(), "keys come unbuffered");
    let opened = picture(session.screen());

    session.send(["ggj", ENTER, "2", ENTER].concat());
    session.wait_for("default.ray [+]");
    wait_for_change(&mut session, &opened);
    assert_eq!(place.read("default.ray"), DEFAULT);

    session.send("w");
    session.wait_for("wrote default.ray");
    wait_until_gone(&mut session, "[+]");
    let saved = DEFAULT.replacen("0.5 0.55 0.75 ", "2 0.55 0.75 ", 1);
    assert_eq!(place.read("default.ray"), saved);

    let bright = picture(session.screen());
    let darker = saved.replacen("2 0.55 0.75 ", "0 0 0 ", 1);
    place.replace("default.ray", &darker);
    wait_for_change(&mut session, &bright);
    let dark = picture(session.screen());

    let broken = darker.replacen("\n26\n", "\n -26\n", 1);
    let line = 1 + broken[..broken.find(" -26").expect("the error")]
        .matches('\n')
        .count();
    place.replace("default.ray", &broken);
    session.wait_for("STALE");
    session.wait_for(&format!("default.ray:{line}:2 "));
    let kept = picture(session.screen());
    assert!(!kept.is_empty() && kept.iter().all(|cell| dark.contains(cell)));

    place.replace("default.ray", &darker);
    wait_until_gone(&mut session, "STALE");
    wait_for_rest(&mut session);
    assert!(picture(session.screen()) == dark);

    session.send(":export out.bmp 64x48 1\r");
    session.wait_for("wrote out.bmp");
    let arguments = "render default.ray -o again.bmp --size 64x48 --spp 1";
    let rendered = Command::new(env!("CARGO_BIN_EXE_halflight"))
        .args(arguments.split(' '))
        .current_dir(place.directory.path())
        .stderr(Stdio::null())
        .status();
    assert!(rendered.expect("it starts").success());
    let [exported, again] = ["out.bmp", "again.bmp"].map(|name| fs::read(place.at(name)));
    assert!(exported.expect("a picture") == again.expect("a picture"));
    quit(session);
}

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
        session.wait_for("balls.ray has edits that are not saved");
        session.send(answer);
        let words = if kept == 0 { "" } else { KEPT };
        assert_end_with(session, 0, words);
        assert_eq!(place.read("balls.ray"), left, "after {answer:?}");
        assert_eq!(place.recovery_files().len(), kept, "after {answer:?}");
    }
}

#[test]
fn signals_end_it_with_their_codes() {
    for (signal, code) in [(Signal::INT, 130), (Signal::TERM, 143), (Signal::HUP, 129)] {
        let place = Place::new();
        let session = place.open();
        kill(session.process_id(), signal);
        assert_end(session, code);
        assert!(place.recovery_files().is_empty(), "{signal:?}");
    }
}

#[test]
fn unsaved_edits_outlive_the_process() {
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
        assert_eq!(fs::read_to_string(&kept[0]).expect("a text"), edited());
        let mode = fs::metadata(&kept[0]).expect("a file").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);

        let mut session = place.start(&["balls.ray"], WIDE);
        session.wait_for("Edits of an earlier run of balls.ray were never saved");
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
fn edits_outlive_a_crash_and_a_run_that_leaves_them_undecided() {
    let place = Place::new();
    let mut session = place.open_edited();
    let is_kept = || {
        let mut kept = place.recovery_files().into_iter();
        kept.any(|file| fs::read_to_string(file).is_ok_and(|text| text == edited()))
    };
    while !is_kept() {
        session.drain(Duration::from_millis(1));
    }
    kill(session.process_id(), Signal::KILL);
    session.end();

    let question = "Edits of an earlier run of balls.ray were never saved";
    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(question);
    session.send(ESC);
    wait_until_gone(&mut session, question);
    session.send("G\rj2\rw");
    session.wait_for("wrote balls.ray");
    quit(session);
    assert!(is_kept());

    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(question);
    session.send("d");
    wait_until_gone(&mut session, question);
    quit(session);
    assert!(!is_kept());
}

#[test]
fn a_terminal_that_is_gone_ends_it() {
    let place = Place::new();
    let mut session = place.open();
    session.hang_up();
    // Whichever comes first: a write that fails, or the news that the terminal is gone.
    assert_eq!(session.end().exit_code(), 129);
}

#[test]
fn it_stops_and_goes_on_as_a_job_of_a_shell() {
    let place = Place::new();
    let mut command = CommandBuilder::new("/bin/sh");
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

/// Keys that come while the terminal is not raw are echoed or held back.
#[test]
fn the_terminal_stays_raw_while_it_is_taken_again() {
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
    // To the second ball, on the fifth line.
    session.send("GE");
    session.wait_for("EDITING +5");
    assert!(!session.screen().alternate_screen());
    assert!(session.has_settings_from_before());
    session.send(["qx", ENTER].concat());
    session.wait("it is back", |screen| picture(screen).len() == before.len());
    session.wait_for("read again");
    assert_eq!(place.read("line"), "qx");
    assert_eq!(place.read("balls.ray"), format!("{BALLS}// seen\n"));
    session.send("q");
    assert!(session.end().success());
    session.assert_restored();
}

/// A stop asked for in the editor stops both, as the shell waits for both; an interrupt is the
/// editor's alone.
#[test]
fn signals_of_the_keyboard_are_the_editor_s_while_it_runs() {
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
    let mut command = CommandBuilder::new("/bin/sh");
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

#[test]
fn unsaved_edits_and_the_files_changes_are_merged() {
    let place = Place::new();
    let mut session = place.open_edited();
    let theirs = |text: &str| text.replacen("0 1 0  0", "0 0 1  0", 1);
    place.replace("balls.ray", &theirs(BALLS));
    wait_for_colour(&mut session, BLUE);
    session.wait_for("balls.ray [+]");
    assert_eq!(place.read("balls.ray"), theirs(BALLS));
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert_eq!(place.read("balls.ray"), theirs(&edited()));
    quit(session);
}

#[test]
fn a_number_changed_on_both_sides_is_asked_for() {
    let theirs = BALLS.replacen(".80", "0.5", 1);
    let cases = [
        ("m", edited(), "wrote balls.ray"),
        ("t", theirs.clone(), "nothing to save"),
    ];
    for (key, chosen, told) in cases {
        let place = Place::new();
        let mut session = place.open_edited();
        place.replace("balls.ray", &theirs);
        session.wait_for("The file changed too");
        // Put off, it is asked again before anything is written.
        session.send(ESC);
        session.wait_for("[disk changed]");
        wait_until_gone(&mut session, "The file changed too");
        session.send("w");
        session.wait_for("The file changed too");
        assert_eq!(place.read("balls.ray"), theirs);
        session.send([key, ENTER].concat());
        wait_until_gone(&mut session, "[disk changed]");
        session.send(":w\r");
        session.wait_for(told);
        assert_eq!(place.read("balls.ray"), chosen, "after {key}");
        quit(session);
    }
}

#[test]
fn a_split_escape_sequence_does_no_harm() {
    let place = Place::new();
    let mut session = place.open();
    session.send("\rj");
    session.wait_for(" EDIT ");
    for pause in [0, 3, 60] {
        session.send(ESC);
        session.drain(Duration::from_millis(pause));
        session.send("[A");
    }
    session.send("?");
    session.wait_for(" Keys ");
    session.send(ESC);
    wait_until_gone(&mut session, " Keys ");
    assert!(!session.text().contains("[+]"));
    quit(session);
}

#[test]
fn any_size_is_survived() {
    let place = Place::new();
    let mut session = place.start(&["balls.ray"], (80, 24));
    wait_for_rest(&mut session);
    let before = picture(session.screen());
    for (columns, rows) in [
        (79, 24),
        (80, 23),
        (40, 16),
        (39, 16),
        (40, 15),
        (20, 6),
        (19, 6),
        (20, 5),
        (2, 2),
        (1, 1),
        (300, 1),
        (1, 100),
        (250, 70),
    ] {
        session.resize(columns, rows);
        session.drain(Duration::from_millis(5));
    }
    for columns in (1..80).rev().chain(1..=80) {
        session.resize(columns, 1 + columns * 23 / 80);
    }
    session.wait("the picture is back", |screen| {
        is_at_rest(screen) && picture(screen) == before
    });
    quit(session);
}

#[test]
fn a_finished_picture_is_left_alone() {
    let place = Place::new();
    let mut session = place.open();
    session.drain(Duration::from_millis(100));
    assert_eq!(session.drain(Duration::from_millis(300)), 0);
    quit(session);
}

#[test]
fn a_scene_with_errors_opens_with_their_list() {
    let place = Place::new();
    place.write("balls.ray", &BALLS.replacen(".80", "-.80", 1));
    let mut session = place.start(&["balls.ray"], (80, 24));
    session.wait_for("balls.ray:4:15");
    session.wait_for("1 error");
    place.replace("balls.ray", BALLS);
    wait_for_rest(&mut session);
    assert!(!session.text().contains("error"));
    quit(session);
}

#[test]
fn what_cannot_be_opened_leaves_the_terminal_alone() {
    let place = Place::new();
    for (name, code) in [("none.ray", 66), ("none.txt", 2), (".", 66)] {
        let mut session = place.start(&[name], (80, 24));
        let status = session.end();
        assert_eq!(status.exit_code(), code, "{name}");
        assert!(session.text().starts_with("error: "), "{}", session.text());
        assert!(!session.written.contains(&0x1b));
    }
}

#[test]
fn the_built_in_scene_is_saved_under_a_name() {
    let place = Place::new();
    let mut session = place.start(&[], WIDE);
    wait_for_rest(&mut session);
    session.send(["ggj", ENTER, "2", ENTER, "w"].concat());
    session.wait_for(":w ");
    session.send("mine.ray\r");
    session.wait_for("wrote mine.ray");
    let saved = DEFAULT.replacen("0.5 0.55 0.75 ", "2 0.55 0.75 ", 1);
    assert_eq!(place.read("mine.ray"), saved);
    quit(session);
}

#[test]
fn a_pasted_colour_is_one_step() {
    let place = Place::new();
    let mut session = place.open();
    session.send("\rjj");
    session.send("\x1b[200~#ff8000\x1b[201~");
    wait_for_colour(&mut session, Color::Rgb(255, 128, 0));
    session.send("w");
    session.wait_for("wrote balls.ray");
    let pasted = BALLS.replacen("1 0 0  0", "1 0.502 0  0", 1);
    assert_eq!(place.read("balls.ray"), pasted);
    session.send("u");
    wait_for_colour(&mut session, RED);
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert_eq!(place.read("balls.ray"), BALLS);
    quit(session);
}

#[test]
fn a_click_selects_what_is_under_it() {
    let place = Place::new();
    let mut session = place.open();
    let mode = session.screen().mouse_protocol_mode();
    assert_eq!(mode, MouseProtocolMode::ButtonMotion);
    for (colour, name) in [(GREEN, "▸ ● object 2"), (RED, "▸ ● object 1")] {
        let Pixels { row, column, .. } = wait_for_colour(&mut session, colour);
        let at = format!("0;{};{}", column + 1, row + 1);
        session.send(format!("\x1b[<{at}M\x1b[<{at}m"));
        session.wait_for(name);
    }
    quit(session);
}

#[test]
fn colours_are_those_the_terminal_has() {
    let colours = |session: &Session| -> Vec<Color> {
        let (rows, columns) = session.screen().size();
        let cells = (0..rows.get()).flat_map(|y| (0..columns.get()).map(move |x| (y, x)));
        let cells = cells.filter_map(|(y, x)| session.screen().cell(y, x));
        cells
            .flat_map(|cell| [cell.fgcolor(), cell.bgcolor()])
            .collect()
    };
    let place = Place::new();
    let start = |arguments: &[&str], environment| {
        Session::start(place.directory.path(), arguments, (80, 24), environment)
    };

    let mut session = start(&["balls.ray", "--color", "256"], &[]);
    wait_for_rest(&mut session);
    assert!(
        !colours(&session)
            .iter()
            .any(|c| matches!(c, Color::Rgb(..)))
    );
    quit(session);

    let mut session = start(&["balls.ray"], &[("NO_COLOR", "1")]);
    session.wait("a picture of characters", |screen| {
        let text = screen.contents();
        text.contains("64 spp") && ["*", "#"].iter().all(|ink| text.contains(ink))
    });
    assert!(colours(&session).iter().all(|&c| c == Color::Default));
    quit(session);
}

#[test]
fn nothing_from_files_reaches_the_terminal_raw() {
    let place = Place::new();
    let evil = "\x1b]52;c;ZXZpbA==\x07\u{9b}31m\u{9d}0;evil\u{9c}\x1b[7;9r\x1bc\x0e";
    let name = format!("a{}.ray", evil.replace('/', ""));
    let scene = BALLS
        .replacen(".80", &format!("x{evil}"), 1)
        .replacen("the green one", evil, 1);
    place.write(&name, &scene);
    let environment = [("VISUAL", "/none")];
    let arguments = ["--color", "24", &name];
    let mut session = Session::start(place.directory.path(), &arguments, WIDE, &environment);
    session.wait_for("1 error");
    session.wait_for("␛]52;c;ZXZpbA==");
    // What is typed while the editor has the terminal is echoed.
    let refused = "the editor can't be used";
    session.send("!E");
    session.wait_for(refused);
    session.send("!G");
    wait_until_gone(&mut session, refused);
    session.send("E");
    session.wait_for(refused);
    session.send(format!("\x1b[200~{evil}\x1b[201~:{ESC}"));
    session.send(["Gejj", ENTER].concat());
    session.send(format!("\x1b[200~{evil}\x1b[201~{ENTER}{ESC}"));
    session.drain(Duration::from_millis(100));
    session.send(":q!\r");
    let status = session.end();
    session.assert_restored();
    assert!(status.success());

    let written = String::from_utf8(session.written.clone()).expect("UTF-8");
    let is_c1 = |c: char| ('\u{80}'..='\u{9f}').contains(&c);
    assert!(!written.contains(is_c1));
    assert!(!written.contains(['\x07', '\x0e']));
    let mut after_escapes = written.split('\x1b').skip(1);
    assert!(after_escapes.all(|rest| rest.starts_with('[')));
    assert!(!written.contains("\x1b[7;9r"));
}

/// A ball that shines by ambient light alone, in the colours of a picture file.
const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 0 image 1 1 skin.ppm
use colour ID 0 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

#[test]
fn the_picture_follows_the_files_of_its_textures() {
    let skin = |colour: &str| format!("P3\n1 1\n255\n{colour}\n");
    let place = Place::new();
    place.write("ball.dat", TEXTURED);
    for arguments in [&["ball.dat"][..], &["--poll=20", "ball.dat"]] {
        place.write("skin.ppm", &skin("255 0 0"));
        let mut session = place.start(arguments, WIDE);
        wait_for_colour(&mut session, RED);
        place.replace("skin.ppm", &skin("0 0 255"));
        wait_for_colour(&mut session, BLUE);

        // Half a picture changes nothing, but is told.
        place.write("skin.ppm", "P3\n1 1\n255\n0");
        session.wait_for("1 texture can't be read: ! says why");
        session.send("!");
        session.wait_for("its last picture is kept");
        wait_for_colour(&mut session, BLUE);
        session.send(ESC);
        place.write("skin.ppm", &skin("0 255 0"));
        wait_for_colour(&mut session, GREEN);
        quit(session);
    }
}
