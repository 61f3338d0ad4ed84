//! Contents of the screen, and the bytes sent for it.

use super::*;

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
fn every_size_works() {
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
fn a_finished_picture_is_not_redrawn() {
    let place = Place::new();
    let mut session = place.open();
    let sent = session.written.len();
    session.send("?");
    session.wait_for(" Keys ");
    session.send(ESC);
    wait_until_gone(&mut session, " Keys ");
    let frames = session.written[sent..].windows(BEGIN_FRAME.len());
    let frames = frames.filter(|part| *part == BEGIN_FRAME).count();
    assert_eq!(frames, 2, "one for each key");
    quit(session);
}

#[test]
fn a_selection_that_changes_no_pixel_sends_no_picture() {
    let place = Place::new();
    for (colours, size) in [
        ("24", (120, 40)),
        ("256", (120, 40)),
        ("24", (200, 50)),
        ("256", (200, 50)),
    ] {
        let arguments = ["--color", colours, "balls.ray"];
        let mut session = Session::start(place.directory.path(), &arguments, size, &[]);
        wait_for_rest(&mut session);
        // Nothing is outlined at first: the outline is switched on, and then off for good.
        for _ in 0..2 {
            let before = picture(session.screen());
            session.send("o");
            wait_for_change(&mut session, &before);
        }
        session.drain(Duration::from_millis(100));
        let (before, sent) = (session.text(), session.written.len());
        session.send("j");
        session.wait("another one is selected", |screen| {
            screen.contents() != before
        });
        let bytes = session.written.len() - sent;
        assert!(
            (1..=2048).contains(&bytes),
            "{colours} at {size:?}: {bytes} bytes"
        );
        quit(session);
    }
}

#[test]
fn a_failure_to_open_leaves_the_terminal_unchanged() {
    let place = Place::new();
    for (name, code) in [("none/a.ray", 66), ("none.txt", 2), (".", 66)] {
        let mut session = place.start(&[name], (80, 24));
        let status = session.end();
        assert_eq!(status.code(), Some(code), "{name}");
        assert!(session.text().starts_with("error: "), "{}", session.text());
        assert!(!session.written.contains(&0x1b));
    }
}

#[test]
fn a_dumb_terminal_is_refused() {
    let place = Place::new();
    let environment = [("TERM", "dumb")];
    let arguments = ["balls.ray"];
    let mut session = Session::start(place.directory.path(), &arguments, WIDE, &environment);
    assert_eq!(session.end().code(), Some(2));
    let text = session.text();
    assert!(text.starts_with("error: TERM=dumb"), "{text}");
    assert!(text.contains("halflight render"), "{text}");
    assert!(!session.written.contains(&0x1b));
}

#[test]
fn messages_on_a_dumb_terminal_have_no_control_sequences() {
    let place = Place::new();
    place.write("bad.ray", "1 1\n");
    let many = ["render", "balls.ray", "-o", "a.png", "--time", "600ms"];
    for (arguments, code) in [(&["check", "bad.ray"][..], 65), (&many, 0)] {
        let environment = [("TERM", "dumb")];
        let mut session = Session::start(place.directory.path(), arguments, WIDE, &environment);
        assert_eq!(session.end().code(), Some(code), "{}", session.text());
        assert!(!session.written.contains(&0x1b), "{}", session.text());
    }
}

#[test]
fn a_home_that_can_hold_no_files_is_no_obstacle() {
    let place = Place::new();
    let file = place.at("balls.ray/x").display().to_string();
    for home in ["/dev/null", &file] {
        let environment = [("HOME", home)];
        let arguments = ["--color", "24", "balls.ray"];
        let mut session = Session::start(place.directory.path(), &arguments, WIDE, &environment);
        // Its path may leave no room for how far the picture is.
        session.wait_for("recent scenes ");
        session.send(ESC);
        wait_until_gone(&mut session, "recent scenes ");
        wait_for_rest(&mut session);
        quit(session);
    }
}

#[test]
fn colours_are_limited_to_those_of_the_terminal() {
    let place = Place::new();
    let start = |arguments: &[&str], environment| {
        Session::start(place.directory.path(), arguments, (80, 24), environment)
    };

    let mut session = start(&["balls.ray", "--color", "256"], &[]);
    wait_for_rest(&mut session);
    assert!(!colours(session.screen()).into_iter().any(is_rgb));
    assert!(
        last(QUESTION, &session.written).is_none(),
        "the user decided"
    );
    quit(session);

    let mut session = start(&["balls.ray"], &[("NO_COLOR", "1")]);
    session.wait("a picture of characters", |screen| {
        let text = screen.contents();
        text.contains("16 spp") && ["/", "█"].iter().all(|ink| text.contains(ink))
    });
    assert!(
        colours(session.screen())
            .iter()
            .all(|&c| c == Color::Default)
    );
    quit(session);
}

/// Queries the colour of the pen.
const QUESTION: &[u8] = b"\x1bP$qm\x1b\\";

/// Reports the colour that was set.
const ANSWER: &str = "\x1bP1$r0;38:2::49:73:87m\x1b\\";

/// The hint if nothing answers.
const CURE: &str = "256 colours; if the terminal has 24-bit colour, use --color 24";

/// A session as in a login over SSH: the environment promises 256 colours.
fn start_far(place: &Place) -> Session {
    let environment = [("COLORTERM", "")];
    Session::start(place.directory.path(), &["balls.ray"], WIDE, &environment)
}

fn colours(screen: &Screen) -> Vec<Color> {
    let (rows, columns) = screen.size();
    let cells = (0..rows.get()).flat_map(|y| (0..columns.get()).map(move |x| (y, x)));
    let cells = cells.filter_map(|(y, x)| screen.cell(y, x));
    cells
        .flat_map(|cell| [cell.fgcolor(), cell.bgcolor()])
        .collect()
}

fn is_rgb(colour: Color) -> bool {
    matches!(colour, Color::Rgb(..))
}

#[test]
fn a_terminal_that_answers_gets_all_colours() {
    let place = Place::new();
    let mut session = start_far(&place);
    while last(QUESTION, &session.written).is_none() {
        session.drain(Duration::from_millis(1));
    }
    session.send([ANSWER, "j"].concat());
    session.wait("all colours", |screen| {
        is_at_rest(screen) && colours(screen).contains(&RED)
    });
    assert!(session.text().contains("24-bit") && !session.text().contains("--color"));
    quit(session);
}

#[test]
fn a_silent_terminal_gets_the_hint_once() {
    let place = Place::new();
    let mut session = start_far(&place);
    session.wait_for(CURE);
    wait_for_rest(&mut session);
    assert!(!colours(session.screen()).into_iter().any(is_rgb));
    session.send("j");
    wait_until_gone(&mut session, CURE);
    session.send("?");
    session.wait_for(" Keys ");
    session.send("/--color");
    session.wait_for("use 24-bit colour even");
    session.send([ESC, ESC].concat());
    wait_until_gone(&mut session, " Keys ");
    quit(session);
}

#[test]
fn a_late_answer_is_neither_used_nor_typed() {
    let place = Place::new();
    let mut session = start_far(&place);
    session.wait_for(CURE);
    wait_for_rest(&mut session);
    for part in ANSWER.split_inclusive('r') {
        session.send(part);
        session.drain(Duration::from_millis(60));
    }
    session.send("\x1bP1+r5463\x1b\\\x1bP0$r\x1b\\?");
    session.wait_for(" Keys ");
    session.send(ESC);
    wait_until_gone(&mut session, " Keys ");
    assert!(!colours(session.screen()).into_iter().any(is_rgb));
    quit(session);
}

#[test]
fn file_contents_never_reach_the_terminal_raw() {
    let place = Place::new();
    let evil = "\x1b]52;c;ZXZpbA==\x07\u{9b}31m\u{9d}0;evil\u{9c}\x1b[7;9r\x1bc\x0e";
    let name = format!("a{}.ray", evil.replace('/', ""));
    let scene = BALLS
        .replacen(".80", &format!("x{evil}"), 1)
        .replacen("the green one", evil, 1);
    place.write(&name, &scene);
    let environment = [("VISUAL", "/none")];
    // Without queries, which are not control sequences.
    let arguments = ["--color", "24", "--pixels", "half", &name];
    let mut session = Session::start(place.directory.path(), &arguments, WIDE, &environment);
    session.wait_for("1 error");
    session.wait_for("␛]52;c;ZXZpbA==");
    // Keys typed while the editor has the terminal are echoed.
    let refused = "cannot start the editor";
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

#[test]
fn the_doctor_reports_the_answers_of_the_terminal() {
    let place = Place::new();
    let environment = [("COLORTERM", "")];
    let mut session = Session::start(place.directory.path(), &["doctor"], WIDE, &environment);
    while last(b"\x1b[c", &session.written).is_none() {
        session.drain(Duration::from_millis(1));
    }
    let pictures = "\x1b_Gi=31;OK\x1b\\\x1b[6;20;10t";
    session.send([ANSWER, pictures, "\x1b[?2026;2$y\x1b[?62;4c"].concat());
    let status = session.end();
    assert!(status.success());
    let text = session.text();
    for words in [
        "256 colours from TERM alone",
        "the terminal reports 24-bit colour",
        "supported by the terminal",
        "real pixels by kitty; the terminal reports kitty, sixel",
        "cells of 10x20 pixels",
    ] {
        assert!(text.contains(words), "{text}");
    }
    session.assert_restored();
}
