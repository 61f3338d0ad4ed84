use std::io::Cursor;

use ratatui::buffer::{Cell, CellWidth};
use ratatui::style::Color;
use unicode_width::UnicodeWidthChar;

use super::placeholders::DIACRITICS;
use super::*;
use crate::layout::tests::size;
use crate::terminal::base64;

/// Where pictures are put: nine columns and four rows.
const PLACE: Rect = Rect::new(3, 2, 9, 4);

fn decoded(png: &[u8]) -> Pixmap {
    let picture = image_file::decode(&mut Cursor::new(png), 1 << 20).expect("a PNG");
    Pixmap {
        size: picture.size(),
        pixels: picture.pixels().to_vec(),
    }
}

/// Two columns from the left and one row from the top.
const TMUX: Wrapping = Wrapping::Tmux { left: 2, top: 1 };

/// Removes what tmux removes: the wrapping, and one of two escapes. Each sequence begins by moving
/// the cursor to the cell, if that is where the picture is put.
fn unwrapped(bytes: &[u8], moving: &[u8]) -> Vec<u8> {
    let mut rest = bytes;
    let mut inner = Vec::new();
    while let Some(body) = rest.strip_prefix([b"\x1bPtmux;", moving].concat().as_slice()) {
        let mut at = 0;
        while body[at..at + 2] != *b"\x1b\\" {
            at += usize::from(body[at] == 0x1b);
            inner.push(body[at]);
            at += 1;
        }
        rest = &body[at + 2..];
    }
    assert_eq!(rest, b"", "nothing but wrapped sequences");
    inner
}

/// Follows the commands for kitty; returns the control data of the first one and the picture.
fn commands(bytes: &[u8]) -> (String, Pixmap) {
    let text = str::from_utf8(bytes).expect("ASCII");
    let commands = text.split("\x1b\\").filter(|command| !command.is_empty());
    let (mut first, mut data, mut is_last) = (None, String::new(), false);
    for command in commands {
        assert!(!is_last, "a chunk after the last one");
        let body = command.strip_prefix("\x1b_G").expect("a graphics command");
        let (control, chunk) = body.split_once(';').expect("data");
        assert!(chunk.len() <= 4096);
        is_last = control.ends_with("m=0");
        assert!(is_last || control.ends_with("m=1") && chunk.len() % 4 == 0);
        assert!(control.contains("q=2"), "an answer would be taken for keys");
        data.push_str(chunk);
        first.get_or_insert_with(|| control.to_owned());
    }
    assert!(is_last);
    let png = base64::decode(&data);
    (first.expect("a command"), decoded(&png))
}

/// Follows iTerm2's command; returns its arguments and the picture.
fn file(bytes: &[u8]) -> (String, Pixmap) {
    let text = str::from_utf8(bytes).expect("ASCII");
    let body = text.strip_prefix("\x1b]1337;File=").expect("a file");
    let (arguments, data) = body.split_once(':').expect("data");
    let data = data.strip_suffix('\x07').expect("the end");
    let png = base64::decode(data);
    assert!(arguments.contains(&format!("size={};", png.len())));
    (arguments.to_owned(), decoded(&png))
}

/// Draws a sixel sequence, as described in DEC STD 070. Panics where pixels are left out.
fn sixels(bytes: &[u8]) -> Pixmap {
    let text = str::from_utf8(bytes).expect("ASCII");
    let body = text.strip_prefix("\x1bP0;1;0q\"").expect("sixels");
    let mut rest = body.strip_suffix("\x1b\\").expect("the end");
    let number = |rest: &mut &str| -> usize {
        let end = rest.find(|c: char| !c.is_ascii_digit());
        let (digits, after) = rest.split_at(end.unwrap_or(rest.len()));
        *rest = after;
        digits.parse().expect("a number")
    };
    let numbers = |rest: &mut &str| {
        let mut numbers = vec![number(rest)];
        while let Some(after) = rest.strip_prefix(';') {
            *rest = after;
            numbers.push(number(rest));
        }
        numbers
    };
    let [_, _, width, height] = numbers(&mut rest)[..] else {
        panic!("no size");
    };
    let mut pixels = vec![None; width * height];
    let (mut palette, mut colour) = (vec![[0; 3]; 256], [0; 3]);
    let (mut x, mut top) = (0, 0);
    while let Some(command) = rest.chars().next() {
        rest = &rest[1..];
        let mut count = 1;
        let mut bits = command;
        match command {
            '#' => {
                let parameters = numbers(&mut rest);
                if let [index, 2, parts @ ..] = &parameters[..] {
                    for (channel, part) in palette[*index].iter_mut().zip(parts) {
                        *channel = ((part * 255 + 50) / 100) as u8;
                    }
                }
                colour = palette[parameters[0]];
                continue;
            }
            '$' | '-' => {
                x = 0;
                top += if command == '-' { 6 } else { 0 };
                continue;
            }
            '!' => {
                count = number(&mut rest);
                bits = rest.chars().next().expect("pixels");
                rest = &rest[1..];
            }
            _ => {}
        }
        let bits = bits as u32 - u32::from('?');
        assert!(bits < 64, "no pixels: {command}");
        for _ in 0..count {
            for y in (0..6).filter(|y| bits >> y & 1 == 1) {
                let pixel: &mut Option<[u8; 3]> = &mut pixels[(top + y) * width + x];
                assert!(pixel.replace(colour).is_none(), "drawn twice");
            }
            x += 1;
        }
    }
    let pixels = pixels.into_iter();
    Pixmap {
        size: size(width as u32, height as u32),
        pixels: pixels
            .map(|pixel| pixel.expect("none is left out"))
            .collect(),
    }
}

/// A picture with smooth and sharp parts and more than 256 colours, too large for a single chunk.
fn picture() -> Pixmap {
    let pixel = |x: u32, y: u32| {
        let is_ball = (x as i32 - 40).pow(2) + (y as i32 - 30).pow(2) < 500;
        let grain = (x * 7919 + y * 104_729) % 13;
        let channels = if is_ball {
            [200 - y, 3 * x / 2, grain]
        } else {
            [x + grain, 2 * y + grain, 255 - y]
        };
        channels.map(|channel| channel as u8)
    };
    let pixels = (0..64).flat_map(|y| (0..90).map(move |x| pixel(x, y)));
    Pixmap {
        pixels: pixels.collect(),
        size: size(90, 64),
    }
}

/// The bytes of a picture, without what tmux removes.
fn sent(picture: &Pixmap, protocol: Protocol, cell: (u16, u16), wrapping: Wrapping) -> Vec<u8> {
    let means = Means {
        protocol,
        wrapping,
        cell,
    };
    let mut out = Vec::new();
    let encoded = means.encode(picture, Turn::First, PLACE, &mut out);
    encoded.expect("there are pixels");
    match (protocol, wrapping) {
        (Protocol::Placeholders { .. }, _) => unwrapped(&out, b""),
        (_, Wrapping::Plain) => out,
        (_, Wrapping::Tmux { .. }) => unwrapped(&out, b"\x1b\x1b[4;6H"),
    }
}

/// A picture as it is shown on a terminal with sixels.
fn in_sixels(picture: &Pixmap, cell: (u16, u16)) -> Pixmap {
    sixels(&sent(picture, Protocol::Sixel, cell, Wrapping::Plain))
}

/// The error of a picture, as the mean of the squares over all channels, and the greatest one.
fn errors(shown: &Pixmap, wanted: &Pixmap) -> (f64, u8) {
    let channels = shown.pixels.as_flattened().iter();
    let pairs = channels.zip(wanted.pixels.as_flattened());
    let offs: Vec<u8> = pairs.map(|(one, other)| one.abs_diff(*other)).collect();
    let squares: f64 = offs.iter().map(|&off| f64::from(off).powi(2)).sum();
    let greatest = offs.iter().max().copied();
    (squares / offs.len() as f64, greatest.unwrap_or(0))
}

#[test]
fn kitty_and_iterm_get_the_picture_exactly() {
    type Follow = fn(&[u8]) -> (String, Pixmap);
    let picture = picture();
    let for_kitty = "a=T, f=100, c=9, r=4, C=1, p=1,";
    let for_iterm = "inline=1; width=9; height=4; preserveAspectRatio=0";
    for (protocol, follow, parts) in [
        (Protocol::Kitty, commands as Follow, for_kitty),
        (NAMED, commands, "a=T, f=100, U=1, c=9, r=4, p=1,"),
        (Protocol::Iterm, file, for_iterm),
    ] {
        for wrapping in [Wrapping::Plain, TMUX] {
            let (said, shown) = follow(&sent(&picture, protocol, (10, 16), wrapping));
            assert!(shown == picture, "another picture");
            for part in parts.split(' ') {
                assert!(said.contains(part), "{part} in {said}");
            }
        }
    }
}

#[test]
fn a_picture_of_kitty_can_be_removed() {
    for wrapping in [Wrapping::Plain, TMUX] {
        let bytes = sent(&picture(), Protocol::Kitty, (10, 16), wrapping);
        let (control, _) = commands(&bytes);
        let id = control.split(',').find(|part| part.starts_with("i="));
        for removal in [REMOVE, REMOVE_THROUGH_TMUX] {
            assert!(removal.contains(id.expect("a number")), "{removal:?}");
        }
    }
}

/// Pictures in place of text, in a pane of tmux.
const NAMED: Protocol = Protocol::Placeholders { pane: 3 };

/// What a cell says of a picture, as kitty reads it: its number, and the row and column in it.
fn named(cell: &Cell) -> (u32, [Option<u16>; 2]) {
    let mut marks = cell.symbol().chars();
    assert_eq!(marks.next(), Some(PLACEHOLDER));
    let mut index = || {
        let mark = u32::from(marks.next()?);
        let index = DIACRITICS.iter().position(|&known| known == mark);
        index.map(|index| index as u16)
    };
    let (row, column, top) = (index(), index(), index());
    let Color::Indexed(colour) = cell.fg else {
        panic!("{:?}", cell.fg);
    };
    let top = u32::from(top.expect("a third mark"));
    (top << 24 | u32::from(colour), [row, column])
}

#[test]
fn cells_name_their_parts_of_the_picture_that_is_sent_and_removed() {
    for (pane, at) in [(0, (0, 0)), (3, (1, 2)), (119, (296, 0)), (1234, (0, 296))] {
        let protocol = Protocol::Placeholders { pane };
        let numbers = [Turn::First, Turn::Second].map(|turn| {
            let mut cell = Cell::EMPTY;
            name(&mut cell, (pane, turn), at);
            assert_eq!(cell.cell_width(), 1);
            let (number, place) = named(&cell);
            let (row, column) = at;
            assert_eq!(place, [Some(row), Some(column)]);
            number
        });
        assert_ne!(numbers[0], numbers[1]);
        let (control, _) = commands(&sent(&picture(), protocol, (10, 16), TMUX));
        assert!(control.contains(&format!(",i={},", numbers[0])));
        let means = Means {
            protocol,
            wrapping: TMUX,
            cell: (10, 16),
        };
        let removal = unwrapped(&means.ending().as_bytes()[2..], b"\x1b\x1b\\");
        let removal = String::from_utf8(removal).expect("ASCII");
        let wanted = numbers.map(|number| format!("\x1b_Ga=d,d=I,i={number},q=2\x1b\\"));
        assert_eq!(removal, wanted.concat());
    }
}

/// kitty's list has 297 characters from U+0305 to U+1D244, in the order of their code points.
#[test]
fn the_marks_are_those_of_the_protocol() {
    assert_eq!(DIACRITICS[..6], [0x305, 0x30d, 0x30e, 0x310, 0x312, 0x33d]);
    assert_eq!(DIACRITICS[294..], [0x1d242, 0x1d243, 0x1d244]);
    assert!(DIACRITICS.is_sorted_by(|one, next| one < next));
    let marks = DIACRITICS.map(|mark| char::from_u32(mark).expect("a character"));
    assert!(marks.iter().all(|mark| mark.width() == Some(0)));
}

#[test]
fn a_picture_in_place_of_text_gets_the_shape_of_its_cells() {
    // 90×64 pixels in nine columns and four rows.
    for (cell, expected) in [
        ((10, 16), (90, 64)),
        ((5, 8), (90, 64)),
        ((9, 19), (90, 84)),
    ] {
        let (_, shown) = commands(&sent(&picture(), NAMED, cell, TMUX));
        assert_eq!((shown.size.width, shown.size.height), expected, "{cell:?}");
        let source = |x: u32, y: u32| (y * 64 / expected.1 * 90 + x) as usize;
        for (x, y) in [(0, 0), (89, expected.1 - 1), (17, 40)] {
            let at = (y * expected.0 + x) as usize;
            assert_eq!(shown.pixels[at], picture().pixels[source(x, y)]);
        }
    }
}

#[test]
fn sixels_are_close_to_the_picture() {
    let picture = picture();
    let shown = in_sixels(&picture, (10, 16));
    assert_eq!(shown.size, picture.size);
    let (mean, greatest) = errors(&shown, &picture);
    assert!(mean < 12.0 && greatest < 24, "{mean} and {greatest}");
}

#[test]
fn few_colours_are_shown_in_sixels_up_to_their_rounding_to_percents() {
    let mut picture = picture();
    for (at, pixel) in picture.pixels.iter_mut().enumerate() {
        let colour = 8 * (at % 90 / 20 + at / 90 / 12 * 5) as u8;
        *pixel = [colour, 255 - colour, colour / 2];
    }
    let shown = in_sixels(&picture, (10, 16));
    let (_, greatest) = errors(&shown, &picture);
    assert!(greatest <= 2, "{greatest}");
}

/// A cell has more pixels than are traced: each is repeated, also in an incomplete last band.
#[test]
fn sixels_fill_their_cells() {
    let grey = |at| if at % 5 == 0 { 255 } else { 0 };
    let picture = Pixmap {
        size: size(18, 8),
        pixels: (0..18 * 8).map(|at| [grey(at); 3]).collect(),
    };
    let shown = in_sixels(&picture, (7, 13));
    assert_eq!(shown.size, size(63, 52));
    for y in 0..52 {
        for x in 0..63 {
            let wanted = picture.pixels[y * 8 / 52 * 18 + x * 18 / 63];
            assert_eq!(shown.pixels[y * 63 + x], wanted, "{x}, {y}");
        }
    }
}

#[test]
fn equal_pictures_give_equal_bytes() {
    let picture = picture();
    for protocol in [Protocol::Kitty, NAMED, Protocol::Iterm, Protocol::Sixel] {
        let send = || sent(&picture, protocol, (10, 16), Wrapping::Plain);
        assert_eq!(send(), send(), "{protocol:?}");
    }
}

#[test]
fn only_success_answers_the_query() {
    for (command, expected) in [
        (&b"Gi=31;OK"[..], true),
        (b"Gi=31,p=1;OK", true),
        (b"Gi=3;OK", false),
        (b"Gi=31;ENOTSUPPORTED:x", false),
        (b"i=31;OK", false),
        (b"", false),
    ] {
        assert_eq!(answers(command), expected);
    }
}
