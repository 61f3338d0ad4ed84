//! What arrives where keys are typed: answers of the terminal, keys that it keeps apart from those,
//! and floods.

use super::*;

/// The question about kitty's keyboard protocol, and the end of the questions.
const QUESTIONS: [&[u8]; 2] = [b"\x1b[?u", b"\x1b[c"];

/// The terminal knows the protocol.
const KNOWN: &str = "\x1b[?0u\x1b[?62c";

/// Keep keys apart, and no longer.
const APART: &[u8] = b"\x1b[>5u";
const AS_BEFORE: &[u8] = b"\x1b[<u";

const LEAVE_SCREEN: &[u8] = b"\x1b[?1049l";

#[test]
fn late_answers_type_nothing() {
    let place = Place::new();
    let mut session = place.open();
    for (head, tail) in [
        ("\x1b]11;rgb:1e1e/1e1e/2e2e\x07", ""),
        ("\x1b]11;rgb:1e", "1e/1e1e/2e2e\x1b\\"),
        ("\x1b]lquit\x1b\\", ""),
        ("\x1b]l:w! stolen.ray\r", "\x1b\\"),
        ("\x1bP!|7E565445\x1b\\", ""),
        ("\x1bXdqd", "\x1b\\"),
        (
            "\x1b[?1;2;3;4;5;6;7;8;9;10;11;12;13;14;15;16;17;18;19;20;21;22;23;24;25;26;27",
            "q",
        ),
    ] {
        session.send(head);
        session.drain(Duration::from_millis(60));
        session.send(tail);
        session.send("?");
        session.wait_for(" Keys ");
        session.send(ESC);
        wait_until_gone(&mut session, " Keys ");
    }
    assert!(!session.text().contains("[+]"));
    let written = ["balls.bmp", "stolen.ray"].map(|name| place.at(name).exists());
    assert_eq!(written, [false, false]);
    quit(session);
}

/// A session on a terminal that knows kitty's keyboard protocol.
fn start_apart(place: &Place, environment: &[(&str, &str)]) -> Session {
    let arguments = ["--color", "24", "balls.ray"];
    let mut session = Session::start(place.directory.path(), &arguments, WIDE, environment);
    answer(&mut session);
    wait_for_rest(&mut session);
    session
}

/// Answers the questions of a session, which then keeps keys apart.
fn answer(session: &mut Session) {
    for question in QUESTIONS {
        await_bytes(session, question);
    }
    session.send(KNOWN);
    await_bytes(session, APART);
}

fn await_bytes(session: &mut Session, bytes: &[u8]) {
    while last(bytes, &session.written).is_none() {
        let arrived = session.read(Duration::from_secs(10));
        arrived.expect("the program writes");
    }
}

/// Asserts that each alternate screen was left without a setting of keys.
fn assert_as_before(session: &Session) {
    let mut settings = 0;
    let (mut taken, mut given_back) = (0, 0);
    for at in 0..session.written.len() {
        let rest = &session.written[at..];
        if rest.starts_with(ENTER_SCREEN) {
            assert_eq!(settings, 0, "set before the screen is entered");
        } else if rest.starts_with(APART) {
            settings += 1;
            taken += 1;
        } else if rest.starts_with(AS_BEFORE) {
            settings -= 1;
        } else if rest.starts_with(LEAVE_SCREEN) {
            assert_eq!(settings, 0, "left behind");
            given_back += 1;
        }
    }
    assert_eq!(taken, given_back);
}

#[test]
fn keys_are_reported_as_before_after_every_ending() {
    type End = dyn Fn(&mut Session);
    let signal = |signal| move |session: &mut Session| kill(session.process_id(), signal);
    let endings: [(&str, &End); 7] = [
        ("q", &|session| session.send("q")),
        ("Ctrl-C", &|session| session.send("\x1b[99;5u")),
        ("SIGTERM", &signal(Signal::TERM)),
        ("SIGINT", &signal(Signal::INT)),
        ("SIGQUIT", &signal(Signal::QUIT)),
        ("SIGABRT", &signal(Signal::ABORT)),
        ("SIGILL", &signal(Signal::ILL)),
    ];
    for (ending, end) in endings {
        let place = Place::new();
        let mut session = start_apart(&place, &[]);
        // Taken back while it is its own: nothing is set twice.
        kill(session.process_id(), Signal::CONT);
        session.send(CTRL_L);
        let count = |session: &Session| {
            session
                .written
                .windows(APART.len())
                .filter(|w| *w == APART)
                .count()
        };
        while count(&session) < 2 {
            session.drain(Duration::from_millis(1));
        }
        end(&mut session);
        session.end();
        let left = last(AS_BEFORE, &session.written);
        assert!(last(APART, &session.written) < left, "after {ending}");
        assert!(
            left < last(LEAVE_SCREEN, &session.written),
            "after {ending}"
        );
    }
}

#[test]
fn keys_are_reported_as_before_to_the_editor_and_to_the_shell() {
    let place = Place::new();
    place.write("editor.sh", "echo EDITING; read -r line\n");
    let mut command = Command::new("/bin/sh");
    let line = "set -m; \"$0\" --color 24 balls.ray; echo ONE; read x; fg";
    command.args(["-c", line, env!("CARGO_BIN_EXE_halflight")]);
    let environment = [("VISUAL", "/bin/sh editor.sh")];
    let mut session = Session::run(command, place.directory.path(), WIDE, &environment);
    answer(&mut session);
    wait_for_rest(&mut session);
    let before = picture(session.screen());
    session.send("E");
    session.wait_for("EDITING");
    assert_as_before(&session);
    session.send(ENTER);
    session.wait("it is back", |screen| picture(screen) == before);
    // Ctrl-Z in kitty's way.
    session.send("\x1b[122;5u");
    session.wait_for("ONE");
    assert_as_before(&session);
    session.send(ENTER);
    session.wait("it is back again", |screen| picture(screen) == before);
    session.send("q");
    assert!(session.end().success());
    assert_as_before(&session);
    let taken = session.written.windows(APART.len()).filter(|w| *w == APART);
    assert_eq!(taken.count(), 3);
}

#[test]
fn the_esc_key_and_a_letter_in_one_packet_are_two_keys_if_the_terminal_keeps_them_apart() {
    let place = Place::new();
    let mut session = start_apart(&place, &[]);
    session.send(":w x");
    session.wait_for("w x");
    // Esc, then the help, then Esc again and the command line.
    session.send("\x1b[27u?");
    session.wait_for(" Keys ");
    session.send("\x1b[27u:zzz");
    session.wait_for("zzz");
    session.send("\x1b[27u");
    wait_until_gone(&mut session, "zzz");
    quit(session);
}

#[test]
fn a_terminal_that_does_not_answer_is_told_nothing() {
    let place = Place::new();
    let session = place.open();
    assert!(last(QUESTIONS[0], &session.written).is_some());
    assert!(last(APART, &session.written).is_none());
    quit(session);
}

/// The most memory that the program has had, in mebibytes.
#[cfg(target_os = "linux")]
fn most_memory(session: &Session) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", session.process_id()));
    let status = status.expect("it is running");
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let line = line.expect("Linux counts it");
    let kilobytes: u64 = line
        .trim()
        .trim_end_matches(" kB")
        .parse()
        .expect("a number");
    kilobytes >> 10
}

/// More than these mebibytes are never needed for what is typed.
#[cfg(target_os = "linux")]
const MORE: u64 = 16;

#[cfg(target_os = "linux")]
#[test]
fn a_signal_does_not_wait_for_a_flood() {
    const FULL: &str = "a line is limited to 4096 characters";
    for (opening, flood, sign) in [
        ("\rji", "1", FULL),
        (":", "l", FULL),
        ("/", "l", FULL),
        ("", "\x1b[<65;9;9M\x1b[<64;9;9M", "balls.ray"),
        ("", "\x1b[0n", "balls.ray"),
    ] {
        let flood = flood.repeat(1 << 14).leak().as_bytes();
        let place = Place::new();
        let mut session = place.open();
        session.send(opening);
        session.drain(Duration::from_millis(50));
        let before = most_memory(&session);
        session.flood(flood);
        session.wait_for(sign);
        let more = most_memory(&session) - before;
        assert!(more < MORE, "{more} MiB more after {opening:?}");
        let begun = Instant::now();
        kill(session.process_id(), Signal::TERM);
        assert_eq!(session.end().code(), Some(143));
        // Two seconds more for a busy machine.
        let taken = begun.elapsed();
        assert!(
            taken < Duration::from_secs(3),
            "{taken:?} after {opening:?}"
        );
        session.assert_restored();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn floods_of_answers_and_pastes_take_little_memory() {
    let [long, numbers] = [b'l', b'1'].map(|byte| vec![byte; 10 << 20]);
    for (flood, sign) in [
        ([b"\x1b]11;", &long[..], b"\x07?"].concat(), " Keys "),
        ([b"\x1bP", &long[..], b"\x1b\\?"].concat(), " Keys "),
        ([b"\x1b[", &numbers[..], b"q?"].concat(), " Keys "),
        (
            [b"\x1b[200~", &long[..], b"\x1b[201~"].concat(),
            "the pasted text is longer than 1 MiB",
        ),
        (
            [&b"\x1b[200~l\x1b[201~".repeat(1 << 14)[..], b"?"].concat(),
            " Keys ",
        ),
    ] {
        let place = Place::new();
        let mut session = place.open();
        let before = most_memory(&session);
        session.send(flood);
        session.wait_for(sign);
        let more = most_memory(&session) - before;
        assert!(more < MORE, "{more} MiB more until {sign}");
        kill(session.process_id(), Signal::TERM);
        assert_end(session, 143);
    }
}
