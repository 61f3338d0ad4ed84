//! What is known of the pixel under the cross: in place of the fields, over the picture where there
//! are no panels, or in a line.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::labelled::Value;
use super::row::Focus;
use super::{labelled, row};
use crate::app::{Pixel, Shared, inspect};
use crate::framing::clear;
use crate::layout::{Side, contents};
use explain::{number, numbers, wording};
use render::{Aov, FirstHit};

/// The width of the values over the picture.
const WIDTH: u16 = 36;
/// Stands for what is not known yet.
const UNKNOWN: &str = "…";

/// Draws the values in a panel.
pub(super) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    if let Some(pixel) = inspect::pixel(shared) {
        panel(&pixel, &values(shared, &pixel), area, buffer);
    }
}

fn panel(pixel: &Pixel, values: &[Value], area: Rect, buffer: &mut Buffer) {
    let [x, y] = pixel.at;
    let output = match pixel.output {
        Some(([x, y], _)) => format!("output {x} {y}"),
        None => format!("of {}×{}", pixel.size.width, pixel.size.height),
    };
    let title = format!("pixel {x} {y}");
    row::title(&title, &output, Focus::Here, area, buffer);
    labelled::render(values, contents(area), buffer);
}

/// Draws the values over the picture on the side away from the cross, if there is room.
pub(super) fn render_over(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let Some(pixel) = inspect::pixel(shared) else {
        return;
    };
    let values = values(shared, &pixel);
    let height = 1 + values.len() as u16;
    if area.width < 2 * WIDTH || area.height < height + 3 {
        return;
    }
    let x = match inspect::free_side(shared) {
        Side::Right => area.right() - WIDTH,
        Side::Left => area.x,
    };
    let over = Rect::new(x, area.bottom() - height, WIDTH, height).intersection(buffer.area);
    clear(over, buffer);
    panel(&pixel, &values, over, buffer);
}

/// The most important values in a few words, for a line over the picture.
pub(super) fn in_short(shared: &Shared) -> String {
    let Some(pixel) = inspect::pixel(shared) else {
        return String::new();
    };
    let [x, y] = pixel.at;
    let value = pixel.value.map_or_else(String::new, |value| {
        format!("  {}", value_of(pixel.aov, value))
    });
    format!("{}  {x} {y}{value}", name(shared, &pixel))
}

fn values(shared: &Shared, pixel: &Pixel) -> Vec<Value> {
    let first = pixel.first.as_ref();
    let surface = first.and_then(|first| first.surface);
    let mut values = vec![Value::new("object", name(shared, pixel))];
    if let Some(material) = pixel.material {
        values.push(Value::new("material", shared.source().name(material)));
    }
    if let Some(at) = pixel.line {
        values.push(Value::new("source", source(shared, at)));
    }
    values.extend(surface.map(|at| Value::new("side", wording::side_of(&at).short)));
    let label = pixel.aov.map_or("linear", Aov::name);
    let value = pixel.value.map(|value| value_of(pixel.aov, value));
    let value = value.unwrap_or_else(|| UNKNOWN.to_owned());
    values.push(Value::new(label, value));
    values.extend(pixel.colour.map(|colour| Value::of_colour("8-bit", colour)));
    let noise = pixel.error.map_or_else(String::new, |error| {
        format!(", noise {} %", number(100.0 * f64::from(error)))
    });
    values.push(Value::new("samples", format!("{}{noise}", pixel.samples)));
    values.extend(surface_values(first));
    values
}

/// A line of the text, with the name of its file.
pub(super) fn source(shared: &Shared, line: usize) -> String {
    match shared.disk.path {
        Some(_) => format!("{}:{line}", shared.disk.name()),
        None => format!("line {line}"),
    }
}

/// What is known of the first surface.
fn surface_values(first: Option<&FirstHit>) -> Vec<Value> {
    let Some(first) = first else {
        return vec![Value::new("depth", UNKNOWN)];
    };
    let Some(surface) = first.surface else {
        return Vec::new();
    };
    vec![
        Value::new("depth", number(first.depth)),
        Value::new("point", numbers(&surface.point.to_array())),
        Value::new("normal", numbers(&surface.normal.to_array())),
        Value::new("uv", numbers(&surface.uv.to_array())),
    ]
}

/// The name of what is under the cross, or why it is not known.
fn name(shared: &Shared, pixel: &Pixel) -> String {
    match pixel.node {
        Ok(Some(node)) => shared.source().name(node),
        Ok(None) => "nothing".to_owned(),
        Err(_) if shared.picture().is_outdated() => UNKNOWN.to_owned(),
        Err(reason) => reason.to_owned(),
    }
}

/// The linear radiance or the value of an AOV.
fn value_of(aov: Option<Aov>, value: [f32; 3]) -> String {
    let channels = aov.map_or(3, Aov::channels);
    numbers(&value.map(f64::from)[..channels])
}
