//! The rays behind a pixel as a tree, and the numbers of the line under the cursor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::labelled::{self, Value};
use super::row::{Focus, Row, title};
use crate::app::{Shared, inspect};
use crate::framing::clear;
use crate::layout::contents;
use crate::theme;
use explain::{RayLine, RayPart, numbers};
use render::Explanation;
use scene::Rgb;

/// The width from which all three channels of a line are shown.
const WIDE: u16 = 50;

/// Draws the tree and the numbers of its current line.
pub(super) fn render(shared: &Shared, buffer: &mut Buffer) {
    let Some(panels) = inspect::ray_panels(shared) else {
        return;
    };
    if panels.is_over_picture {
        clear(panels.tree, buffer);
        clear(panels.values, buffer);
    }
    tree(shared, panels.tree, panels.verdict, panels.lines, buffer);
    let line = inspect::explanation(shared).zip(inspect::ray_line(shared));
    let Some((explanation, line)) = line else {
        title("", "", Focus::Elsewhere, panels.values, buffer);
        return;
    };
    let words = words(shared, explanation, &line);
    title(&words, "", Focus::Elsewhere, panels.values, buffer);
    let values = values_of(shared, explanation, &line);
    labelled::render(&values, contents(panels.values), buffer);
}

fn tree(shared: &Shared, area: Rect, verdict: Rect, lines: Rect, buffer: &mut Buffer) {
    let Some(explained) = &shared.inspection.explained else {
        return;
    };
    let sample = explained.sample;
    let place = format!("sample {sample} of {}", inspect::sample_count(shared));
    let pixel = inspect::cross(shared).map_or_else(String::new, |cross| {
        let [x, y] = cross.pixel;
        format!("why {x} {y}")
    });
    title(&pixel, &place, Focus::Here, area, buffer);
    let Some(explanation) = inspect::explanation(shared) else {
        Row::new(buffer, lines, 0).skip(1).put("…", theme::DIM);
        return;
    };
    for (index, words) in (0..).zip(inspect::verdict_lines(shared, verdict.width)) {
        let mut row = Row::new(buffer, verdict, index);
        row.skip(1).put(&words, theme::WARNING.patch(theme::BOLD));
    }
    let shown = inspect::ray_lines(shared).into_iter().enumerate();
    let shown = shown.skip(explained.top);
    for (index, (at, line)) in (0..lines.height).zip(shown) {
        let style = if at == explained.at {
            theme::CURSOR.add_modifier(Modifier::BOLD)
        } else if line.adds(explanation) == Rgb::ZERO {
            theme::DIM
        } else {
            Style::new()
        };
        let mut row = Row::new(buffer, lines, index);
        let adds = adds(line.adds(explanation), area.width);
        let sign = match line.part {
            RayPart::Whole if explained.folded.contains(&line.ray) => "▸ ",
            RayPart::Whole => "▾ ",
            _ => "",
        };
        // Deep rays keep most of the line for their words.
        let deepest = usize::from(lines.width) / 6;
        let indent = " ".repeat(2 * line.depth.min(deepest));
        let words = format!("{indent}{sign}{}", words(shared, explanation, &line));
        let room = row.room().saturating_sub(adds.len() + 1);
        row.put_in(&format!("{words:room$}"), room, style);
        row.put(&format!(" {adds}"), style);
    }
}

/// What a line adds, in a few columns: all channels if there is room, otherwise their mean.
fn adds(radiance: Rgb, width: u16) -> String {
    let column = |channel: f64| match channel {
        0.0 => "     0".to_owned(),
        _ => format!("{channel:>6.3}"),
    };
    if WIDE <= width {
        radiance.to_array().map(column).join(" ")
    } else {
        column(radiance.element_sum() / 3.0)
    }
}

/// The words of a line.
fn words(shared: &Shared, explanation: &Explanation, line: &RayLine) -> String {
    let node = inspect::ray_node(shared, *line);
    let name = node.map_or_else(|| "…".to_owned(), |node| shared.source().name(node));
    explain::label(explanation, line, name)
}

/// The numbers of a line.
fn values_of(shared: &Shared, explanation: &Explanation, line: &RayLine) -> Vec<Value> {
    let name = match line.part {
        RayPart::Whole => "total",
        _ => "adds",
    };
    let adds = numbers(&line.adds(explanation).to_array());
    let mut values = vec![Value::new(name, adds)];
    if let Some(node) = inspect::ray_node(shared, *line) {
        let source = super::pixel::source(shared, inspect::line_of(shared, node));
        values.push(Value::new("source", source));
    }
    let name = |object| {
        let node = inspect::object_named(shared, object);
        node.map(|node| shared.source().name(node))
    };
    let known = explain::values(explanation, line, name);
    values.extend(
        known
            .into_iter()
            .map(|(label, text)| Value::new(label, text)),
    );
    values
}
