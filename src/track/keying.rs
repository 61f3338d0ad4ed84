//! Keys written into the text of a track file, in the style of their neighbours.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::camera::Parameter;
use super::table::{integer, span_of};
use super::{Bound, CameraTrack, Easing, MAX_FRAMES, Movement, Track, field, thing};
use crate::language::{Node, Placed, Source};
use crate::scene::Camera;
use crate::text::{Edit, Span, line_end, line_start, parse_number};

/// What a track that is begun says of its length: two seconds.
pub const BEGUN: &str = "frames = 48\nfps = 24\n";

/// Significant digits of the numbers of a camera, which is moved by hand.
const DIGITS: usize = 6;

/// Why a value cannot be keyed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unkeyed {
    /// The scene does not state the field.
    #[error("the scene does not state its {0}: set it first")]
    Unstated(&'static str),
    /// The keys are not written as an array of inline tables.
    #[error("these keys are not written as keys = [{{ frame = 0, … }}]: add one in an editor")]
    NoArray,
}

/// A key for the text of a track file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keyed {
    /// The edits that write it, sorted and disjoint.
    pub edits: Vec<Edit>,
    /// The name of what is keyed, such as `light 1 position`.
    pub what: String,
}

/// Keys the value that a field has in the text of the scene, at a frame: in the track that sets it,
/// which may be that of this component alone, or in a new one. The track must be without errors.
pub fn key_field(
    text: &str,
    (track, bound): (&Track, &Bound),
    source: &Source,
    (node, field, component): (Node, usize, usize),
    frame: u32,
) -> Result<Keyed, Unkeyed> {
    let fields = source.fields(node);
    let placed = &fields[field];
    if placed.spans.is_empty() {
        return Err(Unkeyed::Unstated(placed.field.key));
    }
    let others: Vec<_> = bound.tracks_of(node, field).collect();
    let known = others
        .iter()
        .find(|(_, own)| own.is_none_or(|own| own == component));
    let Some(&(index, own)) = known else {
        let component = (!others.is_empty()).then_some(component);
        let value = value_of(source, placed, component, None);
        let names = [
            thing::name_of(source, node),
            field::name_of(&fields, field, component),
        ];
        let [thing, field] = names.each_ref().map(|name| quoted(name));
        let keys = format!("keys = [{{ frame = {frame}, value = {value} }}]");
        return Ok(Keyed {
            edits: vec![appended(
                text,
                &[
                    "[[track]]",
                    &format!("thing = {thing}"),
                    &format!("field = {field}"),
                    &keys,
                ],
            )],
            what: names.join(" "),
        });
    };
    let own_track = &track.fields[index];
    let first = own_track.keys.iter().next();
    let value = value_of(source, placed, own, first.map(|key| key.value.count()));
    let what = format!("{} {}", own_track.thing.name, own_track.field.name);
    let root = DeTable::parse(text).map_err(|_| Unkeyed::NoArray)?;
    let tables = root.get_ref().get("track").map(Spanned::get_ref);
    let table = match tables {
        Some(DeValue::Array(tables)) => tables.get(index),
        _ => None,
    };
    let keys = Written::of(text, table.ok_or(Unkeyed::NoArray)?)?;
    let values = [("value".to_owned(), value)];
    let easing = own_track.keys.easing_for(frame);
    Ok(Keyed {
        edits: keys.edits(frame, &values, easing),
        what,
    })
}

/// Keys a camera at a frame, as one that looks at its target, or one that orbits it if the track
/// does that. `base` is the camera of the scene. The track must be without errors.
pub fn key_camera(
    text: &str,
    track: &Track,
    [base, now]: [&Camera; 2],
    frame: u32,
) -> Result<Keyed, Unkeyed> {
    let movement = track
        .camera
        .as_ref()
        .map_or(Movement::LookAt, |own| own.movement);
    let name = match movement {
        Movement::LookAt => "camera",
        Movement::Orbit => "orbit",
    };
    let values = camera_values(track.camera.as_ref(), movement, [base, now], frame);
    let written = values.into_iter().map(|(parameter, numbers)| {
        let numbers = numbers.into_iter().map(tidy).map(number).collect();
        (parameter.name().to_owned(), list(numbers))
    });
    let values: Vec<_> = written.collect();
    let what = "the camera".to_owned();
    let Some(own) = &track.camera else {
        let keys = format!("keys = [{}]", entry(frame, &values, Easing::default()));
        let edits = vec![appended(text, &[&format!("[{name}]"), &keys])];
        return Ok(Keyed { edits, what });
    };
    let root = DeTable::parse(text).map_err(|_| Unkeyed::NoArray)?;
    let table = root.get_ref().get(name).ok_or(Unkeyed::NoArray)?;
    let keys = Written::of(text, table)?;
    let easing = own
        .parameters
        .first()
        .map(|(_, keys)| keys.easing_for(frame));
    Ok(Keyed {
        edits: keys.edits(frame, &values, easing.unwrap_or_default()),
        what,
    })
}

/// The parameters that give a camera at a frame: those that the track sets already, and those in
/// which it differs from the scene's.
fn camera_values(
    track: Option<&CameraTrack>,
    movement: Movement,
    [base, now]: [&Camera; 2],
    frame: u32,
) -> Vec<(Parameter, Vec<f64>)> {
    let keys_of = |wanted: Parameter| {
        let own = track.and_then(|track| {
            let mut own = track.parameters.iter();
            own.find(|(parameter, _)| *parameter == wanted)
        });
        own.map(|(_, keys)| keys)
    };
    let parameters = movement.parameters().iter().copied();
    let values = parameters.filter_map(|parameter| {
        let mut value = parameter.of(now, base)?;
        let keys = keys_of(parameter);
        if let (Parameter::Azimuth, Some(keys), [angle]) = (parameter, keys, &mut value[..]) {
            // The way to the neighbouring keys must not go round.
            let turns = (keys.numbers_at(frame)[0] - *angle) / 360.0;
            *angle += 360.0 * turns.round();
        }
        let is_always =
            movement == Movement::LookAt && matches!(parameter, Parameter::Eye | Parameter::Target);
        let differs = || {
            let own = parameter.of(base, base).unwrap_or_default();
            let tidied = |numbers: &[f64]| numbers.iter().copied().map(tidy).collect::<Vec<_>>();
            tidied(&own) != tidied(&value)
        };
        (is_always || keys.is_some() || differs()).then_some((parameter, value))
    });
    values.collect()
}

/// The value of a field, or of one component of it, as TOML; of the first `count` numbers if given.
fn value_of(
    source: &Source,
    placed: &Placed,
    component: Option<usize>,
    count: Option<usize>,
) -> String {
    let literal = |at: usize| match (placed.default_of(at), placed.spans.get(at)) {
        (Some(default), _) => default.to_owned(),
        (None, Some(span)) => source.leaf_text(*span).trim().to_owned(),
        (None, None) => String::new(),
    };
    if !placed.field.kind.is_numeric() {
        return quoted(&literal(component.unwrap_or_default()));
    }
    let as_number = |at: usize| parse_number(&literal(at)).map_or_else(|_| literal(at), number);
    match component {
        Some(component) => as_number(component),
        None => {
            let most = count.unwrap_or(placed.spans.len()).min(placed.spans.len());
            list((0..most).map(as_number).collect())
        }
    }
}

/// A number as TOML, which parses to the same value.
fn number(number: f64) -> String {
    let size = number.abs();
    if number == 0.0 || (1e-6..1e15).contains(&size) {
        format!("{number}")
    } else {
        format!("{number:e}")
    }
}

/// A number of few digits.
fn tidy(number: f64) -> f64 {
    let written = format!("{number:.*e}", DIGITS - 1);
    // Adding 0 turns −0 into 0.
    written.parse().unwrap_or(number) + 0.0
}

/// Numbers as TOML: one alone, several in an array.
fn list(numbers: Vec<String>) -> String {
    match &numbers[..] {
        [one] => one.clone(),
        several => format!("[{}]", several.join(", ")),
    }
}

/// A basic string of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// The inline table of a key.
fn entry(frame: u32, values: &[(String, String)], easing: Easing) -> String {
    let mut entry = format!("{{ frame = {frame}");
    for (name, value) in values {
        entry.push_str(&format!(", {name} = {value}"));
    }
    if easing != Easing::default() {
        entry.push_str(&format!(", easing = \"{}\"", easing.name()));
    }
    entry.push_str(" }");
    entry
}

/// Appends a table, after a blank line.
fn appended(text: &str, lines: &[&str]) -> Edit {
    let end = line_break(text);
    let is_ended = text.is_empty() || text.ends_with('\n');
    let mut table = if is_ended {
        String::new()
    } else {
        end.to_owned()
    };
    for line in [""].iter().chain(lines) {
        table.push_str(line);
        table.push_str(end);
    }
    Edit {
        span: Span::at(text.len()),
        text: table,
    }
}

fn line_break(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

/// An array of keys as it is written.
struct Written<'t> {
    text: &'t str,
    array: Span,
    keys: Vec<WrittenKey>,
}

/// A key as it is written.
struct WrittenKey {
    frame: u32,
    span: Span,
    /// The names of its entries and the places of their values.
    entries: Vec<(String, Span)>,
}

impl<'t> Written<'t> {
    /// Finds the keys of a table.
    fn of(text: &'t str, table: &Spanned<DeValue<'_>>) -> Result<Self, Unkeyed> {
        let DeValue::Table(table) = table.get_ref() else {
            return Err(Unkeyed::NoArray);
        };
        let value = table.get("keys").ok_or(Unkeyed::NoArray)?;
        let DeValue::Array(array) = value.get_ref() else {
            return Err(Unkeyed::NoArray);
        };
        let keys = array.iter().map(|key| WrittenKey::of(text, key));
        let keys = keys.collect::<Option<Vec<_>>>().ok_or(Unkeyed::NoArray)?;
        let span = span_of(value);
        if !span.of(text).starts_with('[') || !span.of(text).ends_with(']') {
            return Err(Unkeyed::NoArray);
        }
        Ok(Self {
            text,
            array: span,
            keys,
        })
    }

    /// The edits that key values at a frame: in the key that is there, or in a new one between its
    /// neighbours.
    fn edits(&self, frame: u32, values: &[(String, String)], easing: Easing) -> Vec<Edit> {
        let at = self.keys.partition_point(|key| key.frame < frame);
        match self.keys.get(at) {
            Some(key) if key.frame == frame => key.edits(self.text, values),
            Some(next) => {
                let gap = self.indentation(next).unwrap_or_else(|| " ".to_owned());
                let text = format!("{},{gap}", entry(frame, values, easing));
                vec![insertion(next.span.start(), text)]
            }
            None => self.appended(&entry(frame, values, easing)),
        }
    }

    /// The edits that append a key.
    fn appended(&self, entry: &str) -> Vec<Edit> {
        let Some(last) = self.keys.last() else {
            return vec![insertion(self.array.start() + 1, entry.to_owned())];
        };
        let end = last.span.end();
        let rest = &self.text[end..self.array.end() - 1];
        let comma = rest.find(|c: char| !c.is_whitespace());
        let comma = comma
            .filter(|&at| rest[at..].starts_with(','))
            .map(|at| end + at + 1);
        let after = comma.unwrap_or(end);
        // A comment behind the last key stays with it.
        let line = line_end(self.text, after).min(self.array.end() - 1);
        let behind = self.text[after..line].trim();
        let is_own_line = behind.is_empty() || behind.starts_with('#');
        match self.indentation(last).filter(|_| is_own_line) {
            Some(gap) => {
                let line = after + self.text[after..line].trim_end().len();
                let closed = if comma.is_some() { "," } else { "" };
                let text = format!("{gap}{entry}{closed}");
                if comma.is_none() && line == end {
                    return vec![insertion(end, format!(",{text}"))];
                }
                let comma = comma.is_none().then(|| insertion(end, ",".to_owned()));
                comma.into_iter().chain([insertion(line, text)]).collect()
            }
            None if comma.is_some() => vec![insertion(after, format!(" {entry},"))],
            None => vec![insertion(end, format!(", {entry}"))],
        }
    }

    /// The line break and the indentation before a key that begins a line.
    fn indentation(&self, key: &WrittenKey) -> Option<String> {
        let start = line_start(self.text, key.span.start());
        let before = &self.text[start..key.span.start()];
        let begins = self.array.start() < start && before.trim().is_empty();
        begins.then(|| format!("{}{before}", line_break(self.text)))
    }
}

impl WrittenKey {
    /// `None` if it is no inline table.
    fn of(text: &str, key: &Spanned<DeValue<'_>>) -> Option<Self> {
        let DeValue::Table(table) = key.get_ref() else {
            return None;
        };
        let span = span_of(key);
        let frame = integer(table.get("frame")?, [0, MAX_FRAMES]).ok()?;
        let entries = table.iter();
        let entries = entries.map(|(name, value)| (name.get_ref().to_string(), span_of(value)));
        span.of(text).starts_with('{').then(|| Self {
            frame,
            span,
            entries: entries.collect(),
        })
    }

    /// The edits that give it values.
    fn edits(&self, text: &str, values: &[(String, String)]) -> Vec<Edit> {
        let mut edits = Vec::new();
        let mut more = String::new();
        for (name, value) in values {
            match self.entries.iter().find(|(own, _)| own == name) {
                Some(&(_, span)) if span.of(text) == value => {}
                Some(&(_, span)) => edits.push(Edit {
                    span,
                    text: value.clone(),
                }),
                None => more.push_str(&format!(", {name} = {value}")),
            }
        }
        if !more.is_empty() {
            let end = self.entries.iter().map(|(_, span)| span.end()).max();
            edits.extend(end.map(|end| insertion(end, more)));
        }
        edits.sort_by_key(|edit| edit.span);
        edits
    }
}

fn insertion(at: usize, text: String) -> Edit {
    Edit {
        span: Span::at(at),
        text,
    }
}
