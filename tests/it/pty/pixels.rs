//! Pictures in real pixels: asked for, sent, replaced and removed.

use super::*;

/// Asks for kitty's protocol, the name of the terminal and the size of its cells.
const QUESTION: &[u8] = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[>q\x1b[16t";

/// Answers of a terminal with cells of 4×8 pixels, so that little is traced: nothing known, then
/// sixel.
const CELLS: &str = "\x1b[6;8;4t\x1b[?62c";
const CELLS_AND_SIXEL: &str = "\x1b[6;8;4t\x1b[?62;4c";

/// Removes kitty's picture.
const REMOVE: &[u8] = b"\x1b_Ga=d,d=I,i=18508,q=2\x1b\\";

/// Leaves the alternate screen.
const LEAVE_SCREEN: &[u8] = b"\x1b[?1049l";

/// Starts with a terminal that answers.
fn start_with(place: &Place, arguments: &[&str], answers: &str) -> Session {
    let mut session = place.start(arguments, (80, 24));
    wait_for_bytes(&mut session, QUESTION, 0);
    session.send(answers);
    session
}

/// Reads until the program has written these bytes after the first `from` bytes; returns where.
fn wait_for_bytes(session: &mut Session, bytes: &[u8], from: usize) -> usize {
    let deadline = Instant::now() + Duration::from_secs(30);
    loop {
        if let Some(at) = last(bytes, &session.written[from..]) {
            return from + at;
        }
        assert!(Instant::now() < deadline, "no {}", bytes.escape_ascii());
        session.drain(Duration::from_millis(1));
    }
}

/// Waits until the picture is finished, at the 16 samples of one in real pixels.
fn wait_for_picture(session: &mut Session) {
    session.wait("waiting for the finished picture", |screen| {
        let text = screen.contents();
        text.contains("16 spp") && !text.contains("pass ")
    });
}

/// The control data of the last picture for kitty, and its PNG.
fn kitty(written: &[u8]) -> (String, Vec<u8>) {
    let start = last(b"\x1b_Ga=T", written).expect("a picture");
    let rest = &written[start..];
    let mut control = None;
    let mut data = String::new();
    for command in rest.split(|&byte| byte == 0x1b) {
        let Some(command) = command.strip_prefix(b"_G") else {
            continue;
        };
        let command = str::from_utf8(command).expect("ASCII");
        let (keys, chunk) = command.split_once(';').expect("data");
        data.push_str(chunk);
        control.get_or_insert_with(|| keys.to_owned());
        if keys.ends_with("m=0") {
            break;
        }
    }
    let png = from_base64(data.as_bytes());
    (control.expect("a command"), png)
}

/// The bytes that base64 stands for.
fn from_base64(text: &[u8]) -> Vec<u8> {
    let value = |&digit: &u8| match digit {
        b'A'..=b'Z' => digit - b'A',
        b'a'..=b'z' => digit - b'a' + 26,
        b'0'..=b'9' => digit - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => panic!("{digit:?} is not base64"),
    };
    let end = text.iter().position(|&byte| byte == b'=');
    let digits = &text[..end.unwrap_or(text.len())];
    let groups = digits.chunks(4).flat_map(|group| {
        let bits = group
            .iter()
            .fold(0, |bits, digit| bits << 6 | u32::from(value(digit)));
        let bits = bits << (6 * (4 - group.len()));
        let [_, bytes @ ..] = bits.to_be_bytes();
        bytes.into_iter().take(group.len() - 1)
    });
    groups.collect()
}

fn pixels_of(png: &[u8]) -> image::RgbImage {
    let picture = image::load_from_memory_with_format(png, image::ImageFormat::Png);
    picture.expect("a PNG").to_rgb8()
}

/// The value of a key of kitty's control data.
fn value(control: &str, key: &str) -> u32 {
    let mut pairs = control.split(',').filter_map(|pair| pair.split_once('='));
    let (_, value) = pairs.find(|(name, _)| *name == key).expect("the key");
    value.parse().expect("a number")
}

#[test]
fn kitty_gets_pictures_until_the_end() {
    let place = Place::new();
    let mut session = start_with(
        &place,
        &["balls.ray"],
        &["\x1b_Gi=31;OK\x1b\\", CELLS].concat(),
    );
    wait_for_bytes(&mut session, b"\x1b_Ga=T", 0);
    wait_for_picture(&mut session);
    assert!(picture(session.screen()).is_empty(), "cells are left to it");
    let (control, png) = kitty(&session.written);
    let pixels = pixels_of(&png);
    let size = (pixels.width(), pixels.height());
    assert_eq!(size.0, 4 * value(&control, "c"), "{control}");
    assert!(size.1.abs_diff(8 * value(&control, "r")) < 8, "{control}");
    for colour in [[255, 0, 0], [0, 255, 0]] {
        let count = pixels.pixels().filter(|pixel| pixel.0 == colour).count();
        assert!(500 < count, "{count} of {colour:?}");
    }

    // What lies over it is not covered by it, and gives its place back.
    let sent = session.written.len();
    session.send(":");
    session.wait_for(":export");
    wait_for_bytes(&mut session, REMOVE, sent);
    assert!(!picture(session.screen()).is_empty(), "half blocks again");
    let sent = session.written.len();
    session.send(ESC);
    wait_for_bytes(&mut session, b"\x1b_Ga=T", sent);

    let sent = session.written.len();
    session.resize(100, 30);
    wait_for_bytes(&mut session, b"\x1b_Ga=T", sent);
    wait_for_picture(&mut session);
    let (larger, _) = kitty(&session.written);
    assert!(value(&control, "c") < value(&larger, "c"), "{larger}");

    session.send(":pixels half\r");
    wait_for_rest(&mut session);
    let sent = session.written.len();
    session.send(":pixels auto\r");
    wait_for_bytes(&mut session, b"\x1b_Ga=T", sent);
    wait_for_picture(&mut session);
    let sent = session.written.len();
    session.send("q");
    let removed = wait_for_bytes(&mut session, REMOVE, sent);
    let left = wait_for_bytes(&mut session, LEAVE_SCREEN, sent);
    assert!(removed < left);
    assert_end(session, 0);
}

#[test]
fn the_editor_gets_a_screen_without_the_picture() {
    let place = Place::new();
    let environment = [("VISUAL", "true")];
    let arguments = ["--color", "24", "--pixels", "kitty", "balls.ray"];
    let mut session = Session::start(place.directory.path(), &arguments, (100, 30), &environment);
    wait_for_bytes(&mut session, b"\x1b_Ga=T", 0);
    let sent = session.written.len();
    session.send("E");
    let left = wait_for_bytes(&mut session, LEAVE_SCREEN, sent);
    let removed = wait_for_bytes(&mut session, REMOVE, sent);
    assert!(removed < left);
    let back = wait_for_bytes(&mut session, ENTER_SCREEN, left);
    wait_for_bytes(&mut session, b"\x1b_Ga=T", back);
    quit(session);
}

/// The cells that name a part of a picture: where they are, in which colour, and their marks.
fn named(screen: &Screen) -> Vec<((u16, u16), Color, String)> {
    let (rows, columns) = screen.size();
    let (rows, columns) = (rows.get(), columns.get());
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let named = places.filter_map(|at| {
        let cell = screen.cell(at.0, at.1)?;
        let marks = cell.contents().strip_prefix('\u{10eeee}')?;
        Some((at, cell.fgcolor(), marks.to_owned()))
    });
    named.collect()
}

/// Waits until every cell of a picture names its part of the finished one, from the first row and
/// column; returns the number of the picture and its cells.
fn wait_for_named(session: &mut Session) -> (u32, usize) {
    wait_for_picture(session);
    session.wait("waiting for the picture", |screen| {
        !named(screen).is_empty()
    });
    let cells = named(session.screen());
    let ((top, left), colour, first) = cells.first().cloned().expect("cells");
    assert!(first.starts_with("\u{305}\u{305}"), "{first:?}");
    // The first rows and columns of kitty's list.
    let marks: Vec<_> = "\u{305}\u{30d}\u{30e}\u{310}\u{312}".chars().collect();
    for ((row, column), _, text) in &cells {
        let [row, column] = [row - top, column - left].map(usize::from);
        let (row, column) = (marks.get(row), marks.get(column));
        let mut text = text.chars();
        let (said_row, said_column) = (text.next(), text.next());
        assert!(row.is_none() || row.copied() == said_row);
        assert!(column.is_none() || column.copied() == said_column);
    }
    assert!(cells.iter().all(|(_, other, _)| *other == colour));
    let Color::Idx(low) = colour else {
        panic!("{colour:?}");
    };
    (72 << 24 | u32::from(low), cells.len())
}

#[test]
fn in_tmux_cells_name_their_part_of_the_picture() {
    let place = Place::new();
    place.write(
        "tmux",
        "#!/bin/sh\nprintf 'RGB\\non\\n40\\n0\\non\\nbottom\\n%%2\\n1\\nkitty(0.40.0)\\n'\n",
    );
    let runs = fs::Permissions::from_mode(0o700);
    fs::set_permissions(place.at("tmux"), runs).expect("it is there");
    let folder = place.directory.path();
    let environment = [
        ("TMUX", "/tmp/tmux,1,0"),
        ("PATH", folder.to_str().expect("a text")),
    ];
    let mut session = Session::start(folder, &["balls.ray"], (80, 24), &environment);
    wait_for_bytes(&mut session, b"\x1b[>q\x1b[16t", 0);
    session.send(CELLS);
    let (number, count) = wait_for_named(&mut session);
    // What tmux removes: the wrapping, and one of two escapes.
    let whole = String::from_utf8_lossy(&session.written).into_owned();
    let passed = whole.replace("\x1bPtmux;", "").replace("\x1b\x1b", "\x1b");
    let (control, png) = kitty(passed.as_bytes());
    assert!(
        control.contains(&format!("U=1,f=100,i={number},p=1,")),
        "{control}"
    );
    let (columns, rows) = (value(&control, "c"), value(&control, "r"));
    assert_eq!(columns as usize * rows as usize, count, "{control}");
    let pixels = pixels_of(&png);
    assert_eq!((pixels.width(), pixels.height()), (4 * columns, 8 * rows));

    // A page covers it, and gives its place back.
    session.send("?");
    session.wait_for(" Keys ");
    session.wait("half blocks", |screen| named(screen).is_empty());
    session.send(ESC);
    let (again, same) = wait_for_named(&mut session);
    assert_eq!(same, count);
    assert_ne!(again, number, "numbers alternate");

    let sent = session.written.len();
    session.send("q");
    let removal = format!(
        "\x1bPtmux;\x1b\x1b\\\x1b\x1b_Ga=d,d=I,i={},q=2\x1b\x1b\\\x1b\x1b_Ga=d,d=I,i={},q=2\x1b\x1b\\\x1b\\",
        number.min(again),
        number.max(again),
    );
    let removed = wait_for_bytes(&mut session, removal.as_bytes(), sent);
    let left = wait_for_bytes(&mut session, LEAVE_SCREEN, sent);
    assert!(removed < left);
    assert_end(session, 0);
}

#[test]
fn sixels_fill_their_cells_and_are_erased_by_cells() {
    let place = Place::new();
    let mut session = start_with(&place, &["balls.ray"], CELLS_AND_SIXEL);
    let at = wait_for_bytes(&mut session, b"\x1bP0;1;0q\"1;1;", 0);
    wait_for_picture(&mut session);
    let header = String::from_utf8_lossy(&session.written[at + 13..at + 24]).into_owned();
    let mut numbers = header.split(|c: char| !c.is_ascii_digit());
    let mut number = || numbers.next().and_then(|text| text.parse::<u32>().ok());
    let (width, height) = (number().expect("a width"), number().expect("a height"));
    assert_eq!((width % 4, height % 8), (0, 0), "{header}");
    assert!(width <= 320 && height < 192, "{header}");
    assert!(picture(session.screen()).is_empty());
    // What a page covers is drawn in full: the screen is erased first.
    let sent = session.written.len();
    session.send(":");
    session.wait_for(":export");
    wait_for_bytes(&mut session, b"\x1b[2J", sent);
    assert!(!picture(session.screen()).is_empty());
    session.send(ESC);
    wait_until_gone(&mut session, ":export");
    quit(session);
}

#[test]
fn iterm_is_known_by_its_name() {
    let place = Place::new();
    let answers = ["\x1bP>|iTerm2 3.5.4\x1b\\", CELLS].concat();
    let mut session = start_with(&place, &["balls.ray"], &answers);
    let at = wait_for_bytes(&mut session, b"\x1b]1337;File=inline=1;", 0);
    wait_for_picture(&mut session);
    let rest = &session.written[at..];
    let start = rest.iter().position(|&byte| byte == b':').expect("data") + 1;
    let end = rest.iter().position(|&byte| byte == 0x07).expect("an end");
    let png = from_base64(&rest[start..end]);
    assert!(0 < pixels_of(&png).width());
    quit(session);
}

#[test]
fn a_terminal_that_is_silent_or_shows_no_pictures_gets_half_blocks() {
    let place = Place::new();
    for answers in ["", CELLS] {
        let mut session = start_with(&place, &["balls.ray"], answers);
        wait_for_rest(&mut session);
        for picture in [&b"\x1b_Ga=T"[..], b"\x1bP0;1;0q", b"\x1b]1337"] {
            assert_eq!(last(picture, &session.written), None);
        }
        quit(session);
    }
}

#[test]
fn blocks_of_more_pixels_are_drawn_on_request() {
    let place = Place::new();
    let mut session = place.start(&["--pixels", "half", "balls.ray"], (100, 30));
    wait_for_rest(&mut session);
    assert_eq!(last(b"\x1b_G", &session.written), None, "nothing is asked");
    for (name, first, end) in [
        ("sextant", '\u{1fb00}', '\u{1fb3b}'),
        ("octant", '\u{1cd00}', '\u{1cde5}'),
        ("quadrant", '▖', '▟'),
    ] {
        session.send(format!(":pixels {name}\r"));
        session.wait(name, |screen| {
            screen.contents().contains(|c| (first..=end).contains(&c))
        });
    }
    quit(session);
}
