//! What is known of the pixel under the cross: in place of the fields, over the picture where there
//! are no panels, or in a line.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};

use super::row::{self, Row};
use crate::render::{Aov, FirstHit, Side};
use crate::ui::app::{App, Pixel};
use crate::text::{concise, rounded};
use crate::ui::layout::contents;
use crate::ui::theme;

/// Columns of labels.
const LABEL: u16 = 10;
/// The size of the values over the picture.
const BOX: (u16, u16) = (36, 11);
/// Stands for what is not known yet.
const UNKNOWN: &str = "…";

/// Draws the values in a panel.
pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(pixel) = app.pixel() else { return };
    let [x, y] = pixel.at;
    let output = pixel.output.map_or_else(
        || format!("of {}×{}", pixel.size.width, pixel.size.height),
        |([x, y], _)| format!("output {x} {y}"),
    );
    let title = format!("pixel {x} {y}");
    row::title(&title, &output, Some(theme::ACCENT), area, buffer);
    let panel = contents(area);
    for (index, line) in (0..panel.height).zip(lines(app, &pixel)) {
        let mut row = Row::new(buffer, panel, index);
        row.skip(1).put(line.label, theme::DIM);
        row.skip_to(panel.x + LABEL);
        if let Some([red, green, blue]) = line.colour {
            let colour = ratatui::style::Color::Rgb(red, green, blue);
            row.put("██", Style::new().fg(colour)).skip(1);
        }
        row.put(&line.value, Style::new());
    }
}

/// Draws the values over the picture, beside the cross, or the most important ones in a line if there
/// is little room.
pub(super) fn render_over(app: &App, area: Rect, buffer: &mut Buffer) {
    let (width, height) = BOX;
    if area.width < 2 * width || area.height < height + 3 {
        return;
    }
    let width_of = app.raster().map_or(0, |(cells, _)| cells.width);
    let is_left = app.cross_cell().is_some_and(|cross| cross.0 < width_of / 2);
    let panel = Rect {
        x: if is_left { area.right() - width } else { area.x },
        y: area.bottom() - height,
        width,
        height,
    };
    let panel = panel.intersection(buffer.area);
    Clear.render(panel, buffer);
    render(app, panel, buffer);
}

/// The most important values in a few words, for a line over the picture.
pub(super) fn in_short(app: &App) -> String {
    let Some(pixel) = app.pixel() else {
        return String::new();
    };
    let [x, y] = pixel.at;
    let value = pixel.value.map_or_else(String::new, |value| {
        format!("  {}", value_of(pixel.aov, value))
    });
    format!("{}  {x} {y}{value}", name(app, &pixel))
}

/// A line of the values.
struct Line {
    label: &'static str,
    value: String,
    /// The colour that the value describes.
    colour: Option<[u8; 3]>,
}

fn lines(app: &App, pixel: &Pixel) -> Vec<Line> {
    let line = |label, value| Line {
        label,
        value,
        colour: None,
    };
    let first = pixel.first.as_ref();
    let surface = first.and_then(|first| first.surface);
    let side = match surface.map(|surface| (surface.side, surface.solid)) {
        Some((Side::Front, _)) => ", front",
        Some((Side::Back, true)) => ", inside",
        Some((Side::Back, false)) => ", back",
        None => "",
    };
    let mut lines = vec![line("object", format!("{}{side}", name(app, pixel)))];
    if let Some(material) = pixel.material {
        lines.push(line("material", app.source().name(material)));
    }
    if let Some(at) = pixel.line {
        lines.push(line("source", format!("{}:{at}", app.disk.name())));
    }
    let label = pixel.aov.map_or("linear", Aov::name);
    let value = pixel.value.map(|value| value_of(pixel.aov, value));
    lines.push(line(label, value.unwrap_or_else(|| UNKNOWN.to_owned())));
    let [red, green, blue] = pixel.colour.unwrap_or_default();
    lines.push(Line {
        label: "8-bit",
        value: format!("{red} {green} {blue}  #{red:02x}{green:02x}{blue:02x}"),
        colour: pixel.colour,
    });
    let noise = pixel.error.map_or_else(String::new, |error| {
        format!(", noise {} %", number(100.0 * f64::from(error), 2))
    });
    lines.push(line("samples", format!("{}{noise}", pixel.samples)));
    lines.extend(surface_lines(first).map(|(label, value)| line(label, value)));
    lines
}

/// What is known of the first surface.
fn surface_lines(first: Option<&FirstHit>) -> impl Iterator<Item = (&'static str, String)> {
    let Some(first) = first else {
        return vec![("depth", UNKNOWN.to_owned())].into_iter();
    };
    let Some(surface) = first.surface else {
        return Vec::new().into_iter();
    };
    let vector = |of: glam::DVec3| numbers(&of.to_array(), 3);
    vec![
        ("depth", number(first.depth, 4)),
        ("point", vector(surface.point)),
        ("normal", vector(surface.normal)),
        ("uv", numbers(&surface.uv.to_array(), 4)),
    ]
    .into_iter()
}

/// The name of what is under the cross, or why it is not known.
fn name(app: &App, pixel: &Pixel) -> String {
    match pixel.node {
        Ok(Some(node)) => app.source().name(node),
        Ok(None) => "nothing".to_owned(),
        Err(_) if app.picture().is_outdated() => UNKNOWN.to_owned(),
        Err(reason) => reason.to_owned(),
    }
}

/// The linear radiance or the value of an AOV.
fn value_of(aov: Option<Aov>, value: [f32; 3]) -> String {
    let channels = match aov {
        None | Some(Aov::Normal | Aov::Albedo) => 3,
        Some(Aov::Uv) => 2,
        Some(_) => 1,
    };
    numbers(&value.map(f64::from)[..channels], 4)
}

fn numbers(of: &[f64], decimals: usize) -> String {
    let numbers: Vec<_> = of.iter().map(|&of| number(of, decimals)).collect();
    numbers.join(" ")
}

/// A number with at most so many decimals; in scientific notation if they would all be zero.
pub(super) fn number(of: f64, decimals: usize) -> String {
    let rounded = rounded(of, decimals);
    if rounded == 0.0 && of != 0.0 && of.is_finite() {
        format!("{of:.1e}")
    } else {
        concise(rounded)
    }
}
