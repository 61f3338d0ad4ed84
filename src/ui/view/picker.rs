//! The colour picker: bars of hue, saturation and value, the old and the new colour, and the colours
//! of the scene.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Style};

use super::Inks;
use super::row::{Focus, Row, put_at, title};
use crate::app::{ColourPicker, PickerRow, Shared};
use crate::framing::clear;
use crate::layout::{PickerLines, marker_at, picker_lines, share_at, swatch_cells};
use crate::terminal::ColourDepth;
use crate::theme;
use scene::Rgb;
use text::rounded;

/// Draws the open colour picker over the list, or over everything if there is no list.
pub(crate) fn render(
    shared: &Shared,
    inks: &mut Inks,
    list: Rect,
    body: Rect,
    buffer: &mut Buffer,
) {
    let Some(picker) = &shared.overlays.picker else {
        return;
    };
    let area = if list.is_empty() { body } else { list };
    let area = area.intersection(buffer.area);
    clear(area, buffer);
    title("colour", picker.key, Focus::Here, area, buffer);
    let lines = picker_lines(area);
    for (row, line) in PickerRow::BARS.into_iter().zip(lines.bars) {
        bar_line(picker, row, line, inks, buffer);
    }
    comparison(picker, &lines, inks, buffer);
    swatches(picker, &lines, inks, buffer);
}

/// Draws a row's name, its bar and its number.
fn bar_line(
    picker: &ColourPicker,
    row: PickerRow,
    [line, bar]: [Rect; 2],
    inks: &mut Inks,
    buffer: &mut Buffer,
) {
    let colour = picker.colour;
    let (name, number) = match row {
        PickerRow::Hue => ("hue", format!("{}°", short(colour.hue, 1))),
        PickerRow::Saturation => ("saturation", short(colour.saturation, 3)),
        PickerRow::Value | PickerRow::Swatches => ("value", short(colour.value, 3)),
    };
    let is_here = picker.row == row;
    let style = if is_here { theme::BOLD } else { Style::new() };
    Row::new(buffer, line, 0)
        .put(if is_here { "▸" } else { " " }, style)
        .put(name, style)
        .skip_to(bar.right() + 1)
        .put(&number, style);
    let marker = marker_at(bar, picker.share(row));
    for x in bar.left()..bar.right() {
        let mut shown = picker.at_share(row, share_at(bar, x));
        if row == PickerRow::Hue {
            // A hue shows even of a grey.
            (shown.saturation, shown.value) = (1.0, 1.0);
        }
        let colour = shown.rgb();
        let at = Position::new(x, bar.y);
        if inks.have_colours() {
            paint(colour, at, inks, buffer);
        } else {
            put_at(at, "─", theme::DIM, buffer);
        }
        if x == marker {
            let (sign, style) = marker_over(colour, inks);
            put_at(at, sign, style, buffer);
        }
    }
}

/// Draws the colour before, the one chosen, and its numbers.
fn comparison(picker: &ColourPicker, lines: &PickerLines, inks: &mut Inks, buffer: &mut Buffer) {
    const WIDTH: u16 = 4;
    let line = lines.comparison;
    let now = picker.colour.rgb();
    let places = [(1, picker.before, "was"), (11, now, "now")];
    for (left, colour, word) in places {
        for x in (line.x + left..line.right()).take(usize::from(WIDTH)) {
            paint(colour, Position::new(x, line.y), inks, buffer);
        }
        let mut row = Row::new(buffer, line, 0);
        row.skip(left + WIDTH + 1).put(word, theme::DIM);
    }
    let channels = now.to_array().map(|channel| short(channel, 3)).join(" ");
    let [red, green, blue] = bytes(now);
    let hexadecimal = format!("#{red:02x}{green:02x}{blue:02x}");
    let mut row = Row::new(buffer, lines.numbers, 0);
    // The fields show the numbers as well.
    if channels.len() + 2 + hexadecimal.len() <= row.room() {
        row.put(&channels, Style::new()).skip(2);
    }
    row.put(&hexadecimal, theme::DIM);
}

/// Draws the colours of the scene.
fn swatches(picker: &ColourPicker, lines: &PickerLines, inks: &mut Inks, buffer: &mut Buffer) {
    let is_here = picker.row == PickerRow::Swatches;
    let style = if is_here { theme::BOLD } else { theme::DIM };
    Row::new(buffer, lines.heading, 0)
        .put(if is_here { "▸" } else { " " }, style)
        .put("colours of the scene", style);
    for (index, colour) in picker.swatches.iter().enumerate() {
        let Some(cells) = swatch_cells(lines.swatches, index) else {
            return;
        };
        if is_here && picker.swatch.unwrap_or(0) == index {
            put_at(cells.as_position(), "▸", theme::BOLD, buffer);
        }
        for x in cells.left() + 1..cells.right() {
            paint(*colour, Position::new(x, cells.y), inks, buffer);
        }
        if !inks.have_colours() {
            let mut row = Row::new(buffer, cells, 0);
            row.skip(1).put(&(index + 1).to_string(), Style::new());
        }
    }
}

/// Paints a cell in a colour; leaves it alone without colours.
fn paint(colour: Rgb, at: Position, inks: &mut Inks, buffer: &mut Buffer) {
    if !inks.have_colours() {
        return;
    }
    let (symbol, style) = inks.flat(bytes(colour));
    put_at(at, symbol, style, buffer);
}

/// The marker of a bar over a colour: black or white, by the luminance.
fn marker_over(colour: Rgb, inks: &Inks) -> (&'static str, Style) {
    let [red, green, blue] = bytes(colour).map(f64::from);
    let luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    match inks.depth {
        ColourDepth::Mono => ("●", theme::BOLD),
        _ if luminance < 110.0 => ("│", Style::new().fg(Color::White)),
        _ => ("│", Style::new().fg(Color::Black)),
    }
}

fn bytes(colour: Rgb) -> [u8; 3] {
    let byte = |channel: f64| (255.0 * channel.clamp(0.0, 1.0)).round() as u8;
    colour.to_array().map(byte)
}

/// A number with at most so many decimals.
fn short(number: f64, decimals: usize) -> String {
    rounded(number, decimals).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::keymap::Mode;
    use crate::view::tests::{app, drawn, press, select};
    use language::Node;

    fn picking(keys: &str) -> App {
        let mut app = app();
        select(&mut app, Node::Object(0));
        app.shared.mode = Mode::Edit;
        press(&mut app, keys);
        app
    }

    fn shown(app: &App, depth: ColourDepth) -> Vec<String> {
        let panel = |shared: &Shared, area: Rect, buffer: &mut Buffer| {
            render(shared, &mut Inks::for_depth(depth), area, area, buffer);
        };
        drawn(&app.shared, panel, 34, 14)
    }

    #[test]
    fn bars_show_the_colour_and_its_numbers() {
        // kd is 0.5 0 0.
        let app = picking("jjjc");
        let lines = shown(&app, ColourDepth::TrueColour);
        assert!(lines[0].starts_with("colour ─") && lines[0].ends_with(" kd"));
        assert_eq!(lines[1], "▸hue        │              0°");
        assert_eq!(lines[2], " saturation              │ 1");
        assert!(lines[3].ends_with(" 0.5"), "{}", lines[3]);
        assert_eq!(lines[5], "      was       now");
        assert_eq!(lines[6], " 0.5 0 0  #800000");
        assert_eq!(lines[8], " colours of the scene");
    }

    #[test]
    fn without_colours_the_marker_and_the_numbers_remain() {
        let lines = shown(&picking("jjjcjjjll"), ColourDepth::Mono);
        assert!(lines[1].contains("●──────"), "{lines:#?}");
        assert!(lines[2].contains("──●"), "{lines:#?}");
        assert_eq!(lines[8], "▸colours of the scene");
        assert!(lines[9].contains(" 1 ▸2  3"), "{lines:#?}");
    }
}
