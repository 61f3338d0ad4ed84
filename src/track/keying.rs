//! Keying present values: of fields, as the text of the scene states them, and of the camera.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::camera::Parameter;
use super::written::{Unkeyed, Written, appended, entry};
use super::{Bound, CameraTrack, Easing, Movement, Track, field, thing};
use language::{FieldSpans, Node, Source};
use scene::Camera;
use text::{Edit, parse_number};

/// What a track that is begun says of its length: two seconds.
pub const BEGUN: &str = "frames = 48\nfps = 24\n";

/// Significant digits of the numbers of a camera, which is moved by hand.
const DIGITS: usize = 6;

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
        let numbers: Vec<_> = numbers.into_iter().map(tidy).map(number).collect();
        (parameter.name().to_owned(), list(&numbers))
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
    placed: &FieldSpans,
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
    if let Some(component) = component {
        return as_number(component);
    }
    let most = count.unwrap_or(placed.spans.len()).min(placed.spans.len());
    let numbers: Vec<_> = (0..most).map(as_number).collect();
    list(&numbers)
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
fn list(numbers: &[String]) -> String {
    match numbers {
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
            c if c.is_control() => quoted.extend(format!("\\u{:04X}", u32::from(c)).chars()),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
