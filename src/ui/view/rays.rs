//! The rays behind a pixel as a tree, and the numbers of the line under the cursor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::labelled::{self, Value, numbers};
use super::row::{Focus, Row, title};
use crate::app::{RayLine, RayPart, Shared, inspect};
use crate::framing::clear;
use crate::layout::contents;
use crate::theme;
use explain::number;
use language::Node;
use render::{
    Densities, EmitterTerm, Explanation, LightTerm, RayEnd, RayKind, Shading, Stop, UnlitReason,
};
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
        row.skip(1).put(&words, theme::WARNING);
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

/// The name of a line.
fn words(shared: &Shared, explanation: &Explanation, line: &RayLine) -> String {
    let node = inspect::ray_node(shared, *line);
    let name = || node.map_or_else(|| "…".to_owned(), |node| shared.source().name(node));
    let ray = line.ray(explanation);
    match line.part {
        RayPart::Whole => {
            let end = match &ray.end {
                RayEnd::Surface(_) | RayEnd::Light(_) => name(),
                RayEnd::Missed { .. } => "nothing".to_owned(),
                RayEnd::OverBudget => "not traced: over budget".to_owned(),
            };
            format!("{} → {end}", kind(ray.kind))
        }
        RayPart::Emission => "emission".to_owned(),
        RayPart::Ambient => "ambient light".to_owned(),
        RayPart::Caustics => "photons".to_owned(),
        RayPart::Light(_) => {
            let dark = line.light(explanation).and_then(|light| light.dark);
            with_reason(name(), dark)
        }
        RayPart::Emitter(_) => line.emitter(explanation).map_or(String::new(), |emitter| {
            let of = match emitter.object {
                Some(_) => format!("emission of {}", name()),
                None => "environment".to_owned(),
            };
            with_reason(of, emitter.dark)
        }),
        RayPart::Unlisted => {
            let count = ray.shading().map_or(0, |shading| shading.unlisted.lights);
            format!("{count} more lights")
        }
        RayPart::Stop => match ray.shading().and_then(|shading| shading.stop) {
            Some(stop) => stop_words(stop, explanation.depth),
            None => String::new(),
        },
    }
}

fn stop_words(stop: Stop, depth: u32) -> String {
    match stop {
        Stop::Depth => format!("cut: depth {depth} is reached"),
        Stop::Budget => "cut: too many rays".to_owned(),
        Stop::Nowhere => "ends: no way on".to_owned(),
        Stop::Overflow => "ends: weight overflowed".to_owned(),
        Stop::Roulette { survival } => {
            let chance = number(100.0 * survival);
            format!("ends by roulette, survival {chance} %")
        }
    }
}

fn kind(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Camera => "camera",
        RayKind::Mirror => "mirror",
        RayKind::Boundary => "reflection",
        RayKind::Refraction => "refraction",
        RayKind::TotalReflection => "total reflection",
        RayKind::Diffuse => "diffuse",
        RayKind::Glossy => "glossy",
    }
}

/// The name of a light, and why it adds nothing, if so.
fn with_reason(name: String, dark: Option<UnlitReason>) -> String {
    let reason = match dark {
        None => return name,
        Some(UnlitReason::SwitchedOff) => "switched off",
        Some(UnlitReason::UnlitSide) => "unlit side",
        Some(UnlitReason::FacesAway) => "faces away",
        Some(UnlitReason::AtThePoint) => "at the point",
        Some(UnlitReason::OutsideCone) => "outside cone",
        Some(UnlitReason::Attenuated) => "too far away",
        Some(UnlitReason::NotReflected) => "not reflected",
        Some(UnlitReason::Hidden) => "hidden",
        Some(UnlitReason::Blocked) => "in shadow",
    };
    format!("{name}: {reason}")
}

/// The object that blocks a light.
fn blocker(shared: &Shared, light: &LightTerm) -> Option<Node> {
    let mut crossed = light.crossed.iter();
    let blocking = crossed.find(|crossing| crossing.transmittance == 0.0)?;
    inspect::object_named(shared, blocking.object)
}

/// The numbers of a line.
fn values_of(shared: &Shared, explanation: &Explanation, line: &RayLine) -> Vec<Value> {
    let ray = line.ray(explanation);
    let name = match line.part {
        RayPart::Whole => "total",
        _ => "adds",
    };
    let mut values = vec![Value::new(name, colour(line.adds(explanation)))];
    if let Some(node) = inspect::ray_node(shared, *line) {
        let source = super::pixel::source(shared, inspect::line_of(shared, node));
        values.push(Value::new("source", source));
    }
    match (line.part, &ray.end) {
        (RayPart::Light(_), _) => {
            if let Some(light) = line.light(explanation) {
                values.extend(light_values(shared, light));
            }
        }
        (RayPart::Emitter(_), _) => {
            let emitter = line.emitter(explanation).into_iter();
            values.extend(emitter.flat_map(emitter_values));
        }
        (RayPart::Emission, RayEnd::Surface(shading)) => {
            values.extend(shading.densities.map(weight));
        }
        (RayPart::Whole, end) => {
            values.push(Value::new("weight", colour(ray.weight)));
            if let Some(chosen) = ray.chosen {
                let chance = percent(chosen.chance * chosen.survival);
                values.push(Value::new("chance", chance));
                values.extend(chosen.density.map(|of| Value::new("density", number(of))));
            }
            match end {
                RayEnd::Surface(shading) => values.extend(surface_values(shading)),
                RayEnd::Light(hit) => {
                    values.push(Value::new("t", number(hit.t)));
                    values.push(Value::new("radiance", colour(hit.radiance)));
                    values.extend(hit.densities.map(weight));
                }
                RayEnd::Missed { densities, .. } => values.extend(densities.map(weight)),
                RayEnd::OverBudget => {}
            }
        }
        _ => {}
    }
    values
}

fn surface_values(shading: &Shading) -> Vec<Value> {
    let hit = &shading.hit;
    let mut values = Vec::new();
    if let Some(boundary) = shading.boundary {
        let share = percent(boundary.reflectance);
        let indices = boundary.indices.map(number).join(" to ");
        values.push(Value::new("reflects", format!("{share}, n {indices}")));
    }
    values.extend([
        Value::new("side", super::pixel::side(hit)),
        Value::new("t", number(hit.t)),
        Value::new("point", numbers(&hit.point.to_array())),
        Value::new("normal", numbers(&hit.normal.to_array())),
    ]);
    values
}

fn light_values(shared: &Shared, light: &LightTerm) -> Vec<Value> {
    let visible = match (light.transmittance, blocker(shared, light)) {
        (_, Some(node)) => format!("no: {}", shared.source().name(node)),
        (Some(share), None) => percent(share),
        (None, None) => "not traced".to_owned(),
    };
    let mut values = vec![
        Value::new("visible", visible),
        Value::new("N·L", number(light.cosine)),
        Value::new("reflects", colour(light.reflected)),
        Value::new("distance", number(light.distance)),
        Value::new("falloff", number(light.radial)),
    ];
    if light.chance != 1.0 {
        values.push(Value::new("chosen with", percent(light.chance)));
    }
    if light.spot != 1.0 {
        values.push(Value::new("cone", number(light.spot)));
    }
    values.extend(light.densities.map(weight));
    values
}

fn emitter_values(emitter: &EmitterTerm) -> Vec<Value> {
    let mut values = vec![
        Value::new("N·L", number(emitter.cosine)),
        Value::new("reflects", colour(emitter.reflected)),
        Value::new("distance", number(emitter.distance)),
    ];
    values.extend(emitter.emitted.map(|of| Value::new("radiance", colour(of))));
    values.push(weight(emitter.densities));
    values
}

/// The weight of a technique in multiple importance sampling, with the densities of both.
fn weight(densities: Densities) -> Value {
    let [share, by_light, by_path] =
        [densities.weight, densities.by_light, densities.by_path].map(number);
    Value::new("MIS", format!("{share}, light {by_light}, path {by_path}"))
}

fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

fn colour(of: Rgb) -> String {
    numbers(&of.to_array())
}
