//! The picture: two pixels per cell, drawn as `▀` with the upper pixel as foreground and the lower
//! one as background; more as mosaics; by shape where there are few colours or none. Cells that the
//! terminal fills with its own picture are left to it.

use std::borrow::Cow;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use unicode_width::UnicodeWidthStr;

use super::graphics_gap::leave;
use super::inks::{Drawing, Inks};
use super::row::{Row, put_at};
use super::{comparison, pixel, sketch, symbols, tiles, values, whereabouts, wireframe};
use crate::app::{App, CellImage, FirstReading, Grid, Shared, display, inspect};
use crate::framing::clear;
use crate::keymap::{Context, Mode};
use crate::layout::raster;
use crate::terminal::ColourDepth;
use crate::{layout, theme};
use render::{pixel_width, project_line, project_point};
use scene::Size;

/// Draws the current picture, letterboxed, with its symbols. Returns its cells if they are left to
/// the terminal's own picture.
pub(crate) fn render(app: &App, inks: &mut Inks, area: Rect, buffer: &mut Buffer) -> Option<Rect> {
    let shared = &app.shared;
    let (cells, size) = raster(area, shared.framed())?;
    let wireframe = shared.wireframe();
    if let Some(wireframe) = wireframe.and_then(|wireframe| wireframe.lines(size)) {
        wireframe::paint(wireframe, &display::outlined_objects(shared), cells, buffer);
        overlays(app, inks.depth, area, (cells, size), buffer);
        return None;
    }
    let shown = &shared.picture().shown;
    if shown.size.pixels() == 0 || shown.pixels.len() != shown.size.pixels() {
        if shared.is_empty() {
            invitation(shared, area, buffer);
        } else {
            notice(shared, area, buffer);
        }
        return None;
    }
    let resampled = |pixels: Size| {
        if shown.size == pixels {
            Cow::Borrowed(shown)
        } else {
            Cow::Owned(shown.resampled(pixels))
        }
    };
    match inks.drawing {
        Drawing::HalfBlocks => paint(&resampled(size), inks, cells, buffer),
        Drawing::Sketch => {
            sketch::paint(&resampled(sketch::GRID.size(size)), inks, cells, buffer);
        }
        Drawing::Mosaic(mosaic) => {
            let (across, down) = mosaic.grid();
            let grid = Grid { across, down };
            tiles::paint(&resampled(grid.size(size)), mosaic, inks, cells, buffer);
        }
        Drawing::Picture => leave(cells, buffer),
    }
    if let (Some(frame), Some(frame_window)) =
        (&shared.picture().latest, display::frame_window(shared))
    {
        values::render(frame, &frame_window, cells, buffer);
    }
    overlays(app, inks.depth, area, (cells, size), buffer);
    (inks.drawing == Drawing::Picture).then_some(cells)
}

/// Draws what lies over the picture.
fn overlays(
    app: &App,
    depth: ColourDepth,
    area: Rect,
    (cells, size): (Rect, Size),
    buffer: &mut Buffer,
) {
    let shared = &app.shared;
    if shared.mode == Mode::Move {
        axis(app, depth, (cells, size), buffer);
    }
    symbols::render(shared, depth, cells, buffer);
    if shared.mode == Mode::Inspect {
        path(shared, depth, cells, buffer);
        cross(shared, cells, buffer);
    }
    whereabouts::mark(app, cells, buffer);
    if shared.mode == Mode::Compare {
        comparison::mark(app, cells, buffer);
    }
    if shared.is_empty() {
        invitation(shared, area, buffer);
    }
    if 0 < shared.error_count() {
        let chip = " STALE ";
        let left = area.width.saturating_sub(chip.len() as u16);
        let mut row = Row::new(buffer, area, 0);
        row.skip(left).put(chip, theme::chip(theme::WARNING));
    }
}

/// Draws the reason why there is no picture.
fn notice(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let text = match (&shared.disk.first, &shared.scene, shared.picture().wanted) {
        (FirstReading::Pending(bytes), ..) => opening(&shared.disk.name(), *bytes),
        (_, Some(_), Some(_)) => "tracing…".to_owned(),
        (_, Some(_), None) => "no picture".to_owned(),
        (_, None, _) => "no picture: the scene has errors".to_owned(),
    };
    let line = Rect::new(0, 0, text.width().min(usize::from(area.width)) as u16, 1);
    Row::new(buffer, layout::centred(area, line), 0).put(&text, theme::DIM);
}

/// Says what to press in an empty scene.
fn invitation(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let title = "The scene is empty.";
    let entries = [
        (shared.key_for("add"), "adds an object"),
        (":e FILE".to_owned(), "opens another scene"),
        (shared.key_for("help"), "lists all keys"),
    ];
    let keys = entries.iter().map(|(key, _)| key.width());
    let indent = 2 + keys.max().unwrap_or(0);
    let words = entries.iter().map(|(_, words)| words.width());
    let width = title.width().max(indent + words.max().unwrap_or(0));
    let lines = Rect::new(0, 0, width as u16, 2 + entries.len() as u16);
    let frame = Rect::new(0, 0, lines.width + 4, lines.height + 2);
    clear(layout::centred(area, frame), buffer);
    let area = layout::centred(area, lines).intersection(buffer.area);
    Row::new(buffer, area, 0).put(title, theme::BOLD);
    for (line, (key, words)) in (2..).zip(&entries) {
        let mut row = Row::new(buffer, area, line);
        row.put(key, theme::ACCENT);
        row.skip_to(area.x + indent as u16).put(words, theme::DIM);
    }
}

/// The notice that a file is being read, with its size if that explains the wait.
fn opening(name: &str, bytes: u64) -> String {
    match bytes as f64 / 1e6 {
        ..1.0 => format!("opening {name}…"),
        megabytes @ ..1e3 => format!("opening {name}, {megabytes:.0} MB…"),
        megabytes => format!("opening {name}, {:.1} GB…", megabytes / 1e3),
    }
}

/// Marks the cell of the inspected pixel and says what is there.
fn cross(shared: &Shared, cells: Rect, buffer: &mut Buffer) {
    let Some((column, row)) = inspect::cross_cell(shared) else {
        return;
    };
    let place = (cells.x.saturating_add(column), cells.y.saturating_add(row));
    if cells.contains(place.into()) {
        put_at(place, "┼", theme::CROSS, buffer);
    }
    if shared.context() == Context::Rays {
        return;
    }
    let words = match display::symbol_at(shared, (column, row)) {
        Some(node) => shared.source().name(node),
        None => pixel::in_short(shared),
    };
    Row::new(buffer, cells, 0).put(&format!(" {words} "), theme::chip(theme::ACCENT));
}

/// Draws the axis that a transformation is locked to, through what is being transformed.
fn axis(app: &App, depth: ColourDepth, (cells, size): (Rect, Size), buffer: &mut Buffer) {
    let shared = &app.shared;
    let (Some(transform), Some(camera)) = (&app.moving, shared.camera()) else {
        return;
    };
    let (Some(axis), Some(frame_window)) = (transform.axis(), display::frame_window(shared)) else {
        return;
    };
    let unit = pixel_width(transform.pivot(), &camera, size) / frame_window.magnification(size);
    let reach = i64::from(2 * size.width.max(size.height));
    let colour = theme::axis(axis);
    for at in -reach..=reach {
        let point = transform.pivot() + unit * at as f64 * axis;
        let Some(place) = project_point(point, &camera, size) else {
            continue;
        };
        let [x, y] = frame_window.on_screen(place, size);
        if y < f64::from(size.height) {
            plot([x, 0.5 * y], (depth, colour), cells, buffer);
        }
    }
}

/// Draws the path of light that is explained.
fn path(shared: &Shared, depth: ColourDepth, cells: Rect, buffer: &mut Buffer) {
    let frame = shared.picture().latest.as_ref();
    let Some((frame, query)) = frame.and_then(|frame| Some((frame, frame.query.as_ref()?))) else {
        return;
    };
    let whole = frame.whole();
    for segment in inspect::ray_path(shared) {
        let colour = if segment.is_dark {
            theme::BLOCKED
        } else {
            theme::PATH
        };
        let Some(ends) = project_line(segment.ends, &query.camera, whole) else {
            continue;
        };
        let places = ends.map(|end| inspect::place_on_screen(shared, end, whole));
        let [Some(from), Some(to)] = places else {
            continue;
        };
        let [across, down] = [0, 1].map(|axis| to[axis] - from[axis]);
        let steps = across.abs().max(2.0 * down.abs()).ceil().max(1.0);
        for step in 0..=steps as u32 {
            let share = f64::from(step) / steps;
            let place = [from[0] + share * across, from[1] + share * down];
            plot(place, (depth, colour.into()), cells, buffer);
        }
    }
}

/// Colours the half of a cell at a place, which is in cells from the picture's corner.
fn plot(
    [column, row]: [f64; 2],
    (depth, colour): (ColourDepth, Color),
    cells: Rect,
    buffer: &mut Buffer,
) {
    let is_inside = 0.0 <= column
        && 0.0 <= row
        && column < f64::from(cells.width)
        && row < f64::from(cells.height);
    if !is_inside {
        return;
    }
    let half = (2.0 * row) as u16;
    let Some(cell) = buffer.cell_mut((cells.x + column as u16, cells.y + half / 2)) else {
        return;
    };
    match (cell.symbol(), half % 2) {
        ("▀", 0) => cell.set_fg(colour),
        ("▀", _) => cell.set_bg(colour),
        // A dot in that colour, over the picture of the terminal or a mosaic.
        _ if depth != ColourDepth::Mono => cell.set_symbol("·").set_fg(colour),
        _ => cell.set_symbol("·"),
    };
}

/// Draws the pixels of a picture over its cells.
pub(super) fn paint(shown: &CellImage, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    if !inks.have_colours() {
        return sketch::paint(&sketch::finer(shown), inks, area, buffer);
    }
    let width = shown.size.width;
    let pixel = |x: u32, y: u32| -> Option<Pixel> {
        let at = y as usize * width as usize + x as usize;
        let colour = (x < width).then(|| shown.pixels.get(at)).flatten()?;
        Some(Pixel {
            colour: *colour,
            outlined: shown.is_outlined(at),
        })
    };
    for row in 0..area.height {
        for column in 0..area.width {
            let (x, y) = (u32::from(column), 2 * u32::from(row));
            let cell = buffer.cell_mut((area.x + column, area.y + row));
            if let (Some(cell), Some(upper)) = (cell, pixel(x, y)) {
                let lower = pixel(x, y + 1);
                let (symbol, style) = half_block(upper, lower, inks);
                cell.set_symbol(symbol).set_style(style);
            }
        }
    }
}

/// One pixel to draw.
#[derive(Clone, Copy, Debug)]
struct Pixel {
    colour: [u8; 3],
    /// Whether the pixel belongs to the outline.
    outlined: bool,
}

/// The greatest difference of two pixels' channels that few colours do not show.
const ALIKE: u8 = 8;

fn half_block(upper: Pixel, lower: Option<Pixel>, inks: &mut Inks) -> (&'static str, Style) {
    if let Some(lower) = lower.filter(|lower| inks.has_few() && are_alike(upper, *lower)) {
        let mean = |at: usize| upper.colour[at].midpoint(lower.colour[at]);
        return inks.flat([0, 1, 2].map(mean));
    }
    let mut colour = |pixel: Pixel| {
        if pixel.outlined {
            theme::OUTLINE.into()
        } else {
            inks.colour(pixel.colour)
        }
    };
    let style = Style::reset().fg(colour(upper));
    ("▀", style.bg(lower.map_or(Color::Reset, colour)))
}

/// Whether two pixels are of nearly one colour, and neither of them of the outline.
fn are_alike(one: Pixel, other: Pixel) -> bool {
    let pairs = one.colour.into_iter().zip(other.colour);
    let is_alike = |(one, other): (u8, u8)| one.abs_diff(other) <= ALIKE;
    !one.outlined && !other.outlined && pairs.into_iter().all(is_alike)
}

#[cfg(test)]
mod tests {
    use ratatui::style::Modifier;

    use super::*;
    use crate::keymap::bound;
    use crate::layout::tests::size;
    use crate::view::tests::{app_of, cell_image, check_shown, drawn, inked};
    use language::Language;

    fn painted(shown: &CellImage, depth: ColourDepth) -> Buffer {
        let (columns, rows) = (shown.size.width, shown.size.height.div_ceil(2));
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns as u16, rows as u16));
        paint(shown, &mut Inks::for_depth(depth), buffer.area, &mut buffer);
        buffer
    }

    #[test]
    fn a_comparison_has_the_aspect_ratio_of_what_is_compared() {
        let mut app = app_of(Language::Ray, Language::Ray.template());
        app.shared.mode = Mode::Compare;
        app.shared.pictures.compared_size = Some(size(3, 4));
        app.shared.pictures.compared.shown = cell_image(3, 4, vec![[9; 3]; 12]);
        let lines = drawn(&app, inked(render), 40, 12);
        // Twelve rows of two pixels, and three quarters of that.
        assert_eq!(lines[0].matches('▀').count(), 18, "{lines:?}");
    }

    #[test]
    fn an_empty_scene_says_what_to_press() {
        let lines = |language, text: &str| drawn(&app_of(language, text), inked(render), 40, 12);
        for (language, empty) in [
            (Language::Ray, ""),
            (Language::Dat, "\n  \n"),
            (Language::Xml, " "),
            (Language::Dat, "viewport 8 6\n"),
            (Language::Xml, "<xml><scene/><camera/></xml>"),
        ] {
            let parts = ["The scene is empty.", "a        adds", ":e FILE", "? "];
            check_shown(&lines(language, empty), &parts);
        }
        let mut app = app_of(Language::Ray, "");
        app.shared.keymap = bound("select Q=add, anywhere F9=help");
        check_shown(
            &drawn(&app, inked(render), 40, 12),
            &["Q        adds", "F9 "],
        );
        for full in ["broken", Language::Ray.template()] {
            let text = lines(Language::Ray, full).concat();
            assert!(!text.contains("empty"), "{full}");
        }
    }

    #[test]
    fn a_cell_shows_two_pixels() {
        let [a, b, c, d] = [[1, 2, 3], [40, 50, 60], [255, 0, 0], [0, 0, 255]];
        let buffer = painted(&cell_image(2, 2, vec![a, b, c, d]), ColourDepth::TrueColour);
        let cells = [0, 1].map(|x| &buffer[(x, 0)]);
        let shown = cells.map(|cell| (cell.symbol(), cell.fg, cell.bg));
        assert_eq!(
            shown,
            [
                ("▀", Color::from(a), Color::from(c)),
                ("▀", Color::from(b), Color::from(d))
            ]
        );
    }

    #[test]
    fn the_half_below_an_odd_last_row_is_empty() {
        let buffer = painted(&cell_image(1, 1, vec![[9; 3]]), ColourDepth::TrueColour);
        assert_eq!(buffer[(0, 0)].bg, Color::Reset);
    }

    #[test]
    fn the_outline_is_drawn_over_the_picture() {
        let mut picture = cell_image(2, 1, vec![[9; 3]; 2]);
        picture.outline = vec![true, false];
        let buffer = painted(&picture, ColourDepth::TrueColour);
        let inks = [0, 1].map(|x| buffer[(x, 0)].fg);
        assert_eq!(inks, [theme::OUTLINE.into(), Color::Rgb(9, 9, 9)]);
    }

    #[test]
    fn without_colours_brightness_selects_a_character_and_outlines_are_reversed() {
        let mut picture = cell_image(2, 2, [[255; 3], [0; 3]].repeat(2));
        picture.outline = [true, false].repeat(2);
        let buffer = painted(&picture, ColourDepth::Mono);
        let cells = [0, 1].map(|x| (buffer[(x, 0)].symbol(), buffer[(x, 0)].modifier));
        assert_eq!(cells, [("█", Modifier::REVERSED), (" ", Modifier::empty())]);
    }
}
