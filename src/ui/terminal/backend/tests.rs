//! Frames drawn as by the interface and replayed into a model of a terminal, whose screen must then
//! look like the buffer.

use std::num::NonZeroU16;

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use ratatui::terminal::Terminal;

use super::*;
use crate::terminal::graphics::{Turn, name};

const SIZE: Size = Size::new(12, 5);

/// Our encoder connected to a model of a terminal.
struct Rig {
    terminal: Terminal<AnsiBackend>,
    model: vt100::Parser,
}

impl Rig {
    fn new(depth: ColourDepth, size: Size) -> Self {
        let Ok(mut terminal) = Terminal::new(AnsiBackend::new(depth, size));
        // A new interface begins with a clear screen, like that of the guard.
        let Ok(()) = terminal.resize(Rect::from((Position::ORIGIN, size)));
        let cells = |count| NonZeroU16::new(count).expect("the size is not zero");
        let model = vt100::Parser::new(cells(size.height), cells(size.width), 0);
        Self { terminal, model }
    }

    /// Draws a frame that shows the buffer and returns its bytes.
    fn draw(&mut self, buffer: &Buffer) -> Vec<u8> {
        let Ok(_) = self
            .terminal
            .draw(|frame| frame.buffer_mut().clone_from(buffer));
        self.take()
    }

    fn take(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let Ok(_) = self.terminal.backend_mut().finish(|frame| {
            bytes.extend_from_slice(frame);
            Ok::<(), Infallible>(())
        });
        self.model.process(&bytes);
        bytes
    }
}

/// The visible contents of a cell: styled text, or two halves.
#[derive(Debug, PartialEq, Eq)]
enum Seen {
    Halves(vt100::Color, vt100::Color),
    Text(String, vt100::Color, vt100::Color, Modifier),
}

/// The override that displays text in reverse order.
const BIDI: char = '\u{202e}';

/// Represents the terminal's own foreground, which must differ from its own background.
const OWN_FOREGROUND: vt100::Color = vt100::Color::Rgb(1, 2, 3);

fn seen(text: &str, fg: vt100::Color, bg: vt100::Color, modifier: Modifier) -> Seen {
    let fg = match fg {
        vt100::Color::Default => OWN_FOREGROUND,
        fg => fg,
    };
    let is_styled = match text {
        " " => modifier.intersects(VISIBLE_ON_BLANK),
        _ => !modifier.is_empty(),
    };
    match text {
        _ if is_styled => Seen::Text(text.to_owned(), fg, bg, modifier),
        " " => Seen::Halves(bg, bg),
        "▀" => Seen::Halves(fg, bg),
        "▄" => Seen::Halves(bg, fg),
        "█" => Seen::Halves(fg, fg),
        _ => Seen::Text(text.to_owned(), fg, bg, modifier),
    }
}

fn seen_in_model(model: &vt100::Parser, x: u16, y: u16) -> Seen {
    let cell = model.screen().cell(y, x).expect("it is on the screen");
    let mut modifier = Modifier::empty();
    modifier.set(Modifier::BOLD, cell.bold());
    modifier.set(Modifier::DIM, cell.dim());
    modifier.set(Modifier::ITALIC, cell.italic());
    modifier.set(Modifier::UNDERLINED, cell.underline());
    modifier.set(Modifier::REVERSED, cell.inverse());
    let text = Some(cell.contents()).filter(|text| !text.is_empty());
    let text = text.unwrap_or(" ");
    seen(text, cell.fgcolor(), cell.bgcolor(), modifier)
}

fn seen_in_buffer(cell: &Cell, depth: ColourDepth) -> Seen {
    let colour = |colour| match depth.ink(colour) {
        Ink::Default => vt100::Color::Default,
        Ink::Index(index) => vt100::Color::Idx(index),
        Ink::Rgb(red, green, blue) => vt100::Color::Rgb(red, green, blue),
    };
    let (fg, bg) = (colour(cell.fg), colour(cell.bg));
    seen(cell.symbol(), fg, bg, cell.modifier)
}

fn colours() -> impl Strategy<Value = Color> {
    prop_oneof![
        Just(Color::Reset),
        Just(Color::Red),
        Just(Color::White),
        Just(Color::Indexed(200)),
        (0..3_u8, 0..3_u8).prop_map(|(a, b)| Color::Rgb(a * 100, b * 7, 40)),
    ]
}

fn cells() -> impl Strategy<Value = Cell> {
    let symbols = prop_oneof![
        4 => Just("▀"), 2 => Just("▄"), 1 => Just("█"), 4 => Just(" "),
        2 => Just("x"), 1 => Just("é"), 1 => Just("e\u{301}"), 1 => Just("│"),
    ];
    let modifiers = prop_oneof![
        4 => Just(Modifier::empty()),
        1 => Just(Modifier::BOLD),
        1 => Just(Modifier::DIM | Modifier::ITALIC),
        1 => Just(Modifier::UNDERLINED),
        1 => Just(Modifier::REVERSED | Modifier::BOLD),
    ];
    (symbols, colours(), colours(), modifiers).prop_map(|(symbol, fg, bg, modifier)| {
        let mut cell = Cell::new(symbol);
        cell.set_fg(fg).set_bg(bg);
        cell.modifier = modifier;
        cell
    })
}

fn blank(size: Size) -> Buffer {
    Buffer::empty(Rect::from((Position::ORIGIN, size)))
}

fn buffers() -> impl Strategy<Value = Buffer> {
    let area = usize::from(SIZE.width * SIZE.height);
    proptest::collection::vec(cells(), area).prop_map(|content| Buffer {
        content,
        ..blank(SIZE)
    })
}

fn depths() -> impl Strategy<Value = ColourDepth> {
    use ColourDepth::{Mono, Palette16, Palette256, TrueColour};
    proptest::sample::select(vec![Mono, Palette16, Palette256, TrueColour])
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn the_screen_looks_like_the_buffer(
        depth in depths(),
        frames in proptest::collection::vec((buffers(), 0..4_u8), 1..4),
    ) {
        let mut rig = Rig::new(depth, SIZE);
        let mut last = blank(SIZE);
        for (mut buffer, change) in frames {
            if change == 0 {
                // Most frames change only a few cells.
                let kept = buffer.content[..40].to_vec();
                buffer = last.clone();
                buffer.content[7..47].clone_from_slice(&kept);
            }
            rig.draw(&buffer);
            for position in buffer.area.positions() {
                let seen = seen_in_model(&rig.model, position.x, position.y);
                let expected = seen_in_buffer(&buffer[position], depth);
                prop_assert_eq!(seen, expected, "at {}", position);
            }
            prop_assert_eq!(rig.draw(&buffer), b"", "nothing has changed");
            last = buffer;
        }
    }

    #[test]
    fn no_symbol_can_command_the_terminal(symbol in "[\\x00-\\x1f\\x7f-\\x9f\u{202e}a\u{301}界]{0,4}") {
        let mut backend = AnsiBackend::new(ColourDepth::TrueColour, SIZE);
        let mut cell = Cell::EMPTY;
        cell.set_symbol(&symbol);
        backend.put(Position::ORIGIN, &cell);
        let text = String::from_utf8(backend.out).expect("symbols are text");
        // The bracket, the move to the cell, and the reset of an unknown pen.
        let expected = "\u{1b}[?2026h\u{1b}[1;1H\u{1b}[m";
        let shown = text.strip_prefix(expected).expect("the frame begins as any other");
        prop_assert!(!shown.chars().any(char::is_control), "{:?}", shown);
        prop_assert!(!shown.contains(BIDI), "{:?}", shown);
    }
}

#[test]
fn a_frame_is_bracketed_once_and_an_unchanged_one_is_empty() {
    let mut rig = Rig::new(ColourDepth::TrueColour, SIZE);
    let mut buffer = blank(SIZE);
    buffer[(3, 2)].set_symbol("x").set_fg(Color::Red);
    let first = String::from_utf8(rig.draw(&buffer)).expect("frames are text");
    assert!(first.starts_with("\x1b[?2026h"), "{first:?}");
    assert!(first.ends_with("\x1b[?2026l"), "{first:?}");
    assert_eq!(first.matches("2026").count(), 2);
    assert_eq!(rig.draw(&buffer), b"");
    buffer[(4, 2)].set_symbol("y").set_fg(Color::Red);
    let second = String::from_utf8(rig.draw(&buffer)).expect("frames are text");
    assert_eq!(second, "\x1b[?2026hy\x1b[?2026l");
}

#[test]
fn the_cursor_moves_by_the_shortest_sequence() {
    for (x, y, bytes) in [
        (3, 1, ""),
        (4, 1, "\x1b[C"),
        (9, 1, "\x1b[6C"),
        (0, 1, "\r"),
        (1, 1, "\x1b[2G"),
        (0, 2, "\r\n"),
        (2, 2, "\r\n\x1b[2C"),
        (2, 4, "\x1b[5;3H"),
        (2, 0, "\x1b[1;3H"),
    ] {
        let mut backend = AnsiBackend::new(ColourDepth::Mono, SIZE);
        backend.move_to(Position { x: 3, y: 1 });
        let start = backend.out.len();
        backend.move_to(Position { x, y });
        let moved = str::from_utf8(&backend.out[start..]);
        assert_eq!(moved, Ok(bytes), "from 3, 1 to {x}, {y}");
    }
}

#[test]
fn a_visible_cursor_stays_in_place() {
    let mut rig = Rig::new(ColourDepth::TrueColour, SIZE);
    let mut draw = |text: &'static str| {
        let Ok(_) = rig.terminal.draw(|frame| {
            frame.buffer_mut()[(0, 0)].set_symbol(text);
            frame.set_cursor_position((5, 3));
        });
        let bytes = rig.take();
        assert_eq!(rig.model.screen().cursor_position(), (3, 5));
        assert!(!rig.model.screen().hide_cursor());
        bytes
    };
    draw("x");
    assert_eq!(draw("x"), b"");
    draw("y");
}

#[test]
fn a_smaller_window_is_redrawn() {
    let mut rig = Rig::new(ColourDepth::Mono, SIZE);
    let text = |frame: &mut ratatui::terminal::Frame| {
        let last = frame.area().height - 1;
        frame
            .buffer_mut()
            .set_string(0, last, "below", Color::Reset);
    };
    let Ok(_) = rig.terminal.draw(text);
    rig.take();
    rig.terminal.backend_mut().fit(Size::new(10, 3));
    let Ok(_) = rig.terminal.draw(text);
    rig.take();
    assert_eq!(rig.model.screen().contents().trim_end(), "\n\nbelow");
}

#[test]
fn wide_characters_and_their_replacements_stay_in_their_columns() {
    let mut rig = Rig::new(ColourDepth::TrueColour, SIZE);
    for text in [
        "a界b界c",
        "界界界x",
        "aabbcc",
        "👩\u{200d}🚀.❤\u{fe0f}.",
        "e\u{301}e\u{301}x",
        "🇩🇪!",
    ] {
        let mut buffer = blank(SIZE);
        buffer.set_string(0, 1, text, Color::Reset);
        buffer.set_string(0, 2, "|", Color::Reset);
        rig.draw(&buffer);
        let shown = |x, y| rig.model.screen().cell(y, x).map(vt100::Cell::contents);
        for x in 0..SIZE.width {
            let symbol = buffer[(x, 1)].symbol();
            // Only plain characters are compared: others may be simplified.
            if symbol != " " && symbol.len() <= 3 {
                assert_eq!(shown(x, 1), Some(symbol), "column {x} of {text}");
            }
        }
        assert_eq!(shown(0, 2), Some("|"));
    }
}

#[test]
fn cells_that_name_a_picture_are_written_whole_and_the_last_column_wraps() {
    let mut rig = Rig::new(ColourDepth::TrueColour, SIZE);
    let mut buffer = blank(SIZE);
    for column in 0..SIZE.width {
        name(&mut buffer[(column, 2)], (0, Turn::First), (0, column));
    }
    let bytes = rig.draw(&buffer);
    let text = str::from_utf8(&bytes).expect("cells are text");
    for column in 0..SIZE.width {
        let cell = rig.model.screen().cell(2, column).expect("a cell");
        assert_eq!(cell.contents(), buffer[(column, 2)].symbol());
        assert_eq!(cell.fgcolor(), vt100::Color::Idx(16));
    }
    let symbols = (0..SIZE.width).map(|column| buffer[(column, 2)].symbol());
    let mut symbols: Vec<_> = symbols.collect();
    let last = symbols.pop().expect("a last column");
    let row = format!("{}\x1b[?7h{last}\x1b[?7l", symbols.concat());
    assert!(text.contains(&row), "one after the other: {text:?}");
    let mut backend = AnsiBackend::new(ColourDepth::TrueColour, SIZE);
    backend.put(Position::ORIGIN, &buffer[(0, 2)]);
    backend.precede(b"picture");
    assert!(backend.out.starts_with(b"\x1b[?2026hpicture\x1b[1;1H"));
}

/// The colour of the pixel of a picture in a column and a row.
type Pixel<'p> = &'p dyn Fn(u16, u16) -> [u8; 3];

/// Bytes per cell of a whole frame of half blocks.
fn bytes_a_cell(depth: ColourDepth, size: Size, pixel: Pixel) -> f64 {
    let mut buffer = blank(size);
    let colour = |x, y| {
        let [red, green, blue] = pixel(x, y);
        Color::Rgb(red, green, blue)
    };
    for Position { x, y } in buffer.area.positions() {
        let cell = buffer[(x, y)].set_symbol("▀");
        cell.set_fg(colour(x, 2 * y)).set_bg(colour(x, 2 * y + 1));
    }
    let mut rig = Rig::new(depth, size);
    rig.draw(&buffer).len() as f64 / f64::from(size.area())
}

/// A lit ball on a chequered floor under an even sky, quantized to `step`.
fn ball(size: Size, step: u8) -> impl Fn(u16, u16) -> [u8; 3] {
    move |x, y| {
        let radius = f64::from(size.height) * 0.7;
        let u = (f64::from(x) - f64::from(size.width) / 2.0) / radius;
        let v = (f64::from(y) - f64::from(size.height)) / radius;
        let inside = 1.0 - u * u - v * v;
        let colour = if 0.0 < inside {
            let light = (inside.sqrt() * 0.8 - u * 0.4 - v * 0.4).max(0.05);
            [230.0 * light, 120.0 * light, 60.0 * light]
        } else if y < size.height {
            [90.0, 130.0, 200.0]
        } else if (x / 9 + y / 7) % 2 == 0 {
            [200.0, 200.0, 190.0]
        } else {
            [60.0, 50.0, 50.0]
        };
        colour.map(|channel| (channel as u8 / step) * step)
    }
}

#[test]
fn pictures_take_few_bytes() {
    use ColourDepth::{Mono, Palette16, Palette256, TrueColour};
    let size = Size::new(200, 50);
    let flat = |_, _| [10_u8, 200, 30];
    // Neighbours of one colour, pictures of flat and shaded parts, and the worst case: two colours
    // of nine digits, four bytes that frame them and three of the block.
    let noise = |x: u16, y: u16| {
        let mix = (u32::from(x) * 7919 + u32::from(y) * 104_729).wrapping_mul(2_654_435_761);
        [25, 17, 9].map(|shift| 100 + (mix >> shift & 127) as u8)
    };
    let (coarse, fine) = (ball(size, 4), ball(size, 1));
    for (depth, pixel, limit) in [
        (TrueColour, &flat as Pixel, 1.1),
        (TrueColour, &coarse, 24.0),
        (TrueColour, &fine, 24.0),
        (TrueColour, &noise, 39.5),
        (Palette256, &fine, 5.0),
        (Palette256, &noise, 27.5),
        (Palette16, &fine, 3.0),
        (Mono, &noise, 3.1),
    ] {
        let bytes = bytes_a_cell(depth, size, pixel);
        assert!(bytes < limit, "{bytes}, not {limit} a cell at {depth:?}");
    }
}
