//! Reads track files.

use toml::de::{DeTable, DeValue};

use super::camera::{Movement, Parameter};
use super::table::{FieldSpans, Table, elements, integer, number, span_of, string, wrong};
use super::{CameraTrack, Easing, FieldTrack, Key, Keys, Track, Value};
use text::{Diagnostic, Findings, Span, alternatives, counted, nearest_word};

/// The largest number of frames.
pub const MAX_FRAMES: u32 = 1_000_000;

/// The least and the largest number of frames per second, as movies hold them.
pub const RATES: [u32; 2] = [1, 100];

const FRAMES: &str = "how many frames there are, such as frames = 120";
const KEYS: &str = "keys such as [{ frame = 0, value = 1 }, { frame = 24, value = 2 }]";
const CAMERA_KEYS: &str = "keys such as [{ frame = 0, eye = [0, 1, 5], target = [0, 0, 0] }]";
const ORBIT_KEYS: &str = "keys such as [{ frame = 0, azimuth = 0 }, { frame = 99, azimuth = 90 }]";

/// Reads a track file, and reports all of its errors and warnings, in the order of the text. If there
/// are errors, the track is what was understood.
pub fn read(text: &str) -> (Track, Findings) {
    let mut findings = Findings::default();
    let (root, faults) = DeTable::parse_recoverable(text);
    for fault in &faults {
        findings.error(|| {
            let span = fault.span().unwrap_or_default();
            let expected = "an entry such as frames = 120, or a table such as [[track]]";
            Diagnostic::error(Span::new(span.start, span.end), fault.message(), expected)
        });
    }
    // What could not be read would only cause more errors.
    if !faults.is_empty() {
        return (Track::default(), findings.sorted());
    }
    let mut top = Table::new(root.get_ref(), Span::at(0));
    let frames = top
        .require("frames", FRAMES)
        .and_then(|value| integer(value, [1, MAX_FRAMES]));
    let frames = noted(frames, &mut findings);
    let rate = top.take("fps").map(|value| integer(value, RATES));
    let rate = rate.and_then(|rate| noted(rate, &mut findings));
    let mut reader = Reader {
        last: frames.map_or(u32::MAX, |frames| frames - 1),
        findings,
    };
    let fields = top.take("track").map(|value| reader.fields(value));
    let camera = [
        ("camera", CAMERA_KEYS, Movement::LookAt),
        ("orbit", ORBIT_KEYS, Movement::Orbit),
    ];
    let camera = camera.map(|(name, expected, movement)| {
        let value = top.take(name)?;
        Some((value, reader.camera(value, expected, movement)))
    });
    let mut findings = reader.findings;
    if let [Some((first, _)), Some((second, _))] = &camera {
        let later = span_of(first).max(span_of(second));
        findings.error(|| {
            let message = "the camera is already moved by another table";
            Diagnostic::error(later, message, "either [camera] or [orbit]")
        });
    }
    top.finish(&mut findings);
    let fields = fields.unwrap_or_default();
    let camera = camera.into_iter().flatten().next();
    if fields.is_empty() && camera.is_none() && findings.errors() == 0 {
        findings.warning(|| {
            let message = "nothing changes between the frames";
            Diagnostic::warning(Span::at(0), message, "[[track]], [camera] or [orbit]")
        });
    }
    let track = Track {
        frames: frames.unwrap_or_default(),
        rate,
        fields,
        camera: camera.and_then(|(_, camera)| camera),
    };
    (track, findings.sorted())
}

/// Notes an error.
fn noted<T>(outcome: Result<T, Diagnostic>, findings: &mut Findings) -> Option<T> {
    outcome
        .map_err(|diagnostic| findings.error(|| diagnostic))
        .ok()
}

struct Reader {
    /// The number of the last frame.
    last: u32,
    findings: Findings,
}

impl Reader {
    fn noted<T>(&mut self, outcome: Result<T, Diagnostic>) -> Option<T> {
        noted(outcome, &mut self.findings)
    }

    fn fields(&mut self, value: FieldSpans<'_, '_>) -> Vec<FieldTrack> {
        let tables = elements(value, "[[track]], a table for each field");
        let tables = self.noted(tables).unwrap_or_default();
        let fields = tables.into_iter().map(|table| self.field(table));
        fields.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    fn field(&mut self, value: FieldSpans<'_, '_>) -> Option<FieldTrack> {
        const THING: &str = "a name as in the list of the interface, such as thing = \"light 1\"";
        const FIELD: &str = "the name of a field, such as field = \"position\"";
        let table = Table::of(value, "[[track]], a table for each field");
        let mut table = self.noted(table)?;
        let thing = table.require("thing", THING);
        let thing = self.noted(thing.and_then(|value| string(value, THING)));
        let field = table.require("field", FIELD);
        let field = self.noted(field.and_then(|value| string(value, FIELD)));
        let keys = self.keys(&mut table, KEYS, |reader, entries| {
            let value = entries.require("value", "a value for this frame");
            let value = reader.noted(value)?;
            let read = reader.noted(any(value))?;
            Some(vec![(0, read, span_of(value))])
        });
        table.finish(&mut self.findings);
        let keys = keys.map(|keys| keys.into_iter().map(|(_, key)| key).collect());
        Some(FieldTrack {
            thing: thing?,
            field: field?,
            // Names are checked even so.
            keys: keys.and_then(Keys::new).unwrap_or_default(),
        })
    }

    fn camera(
        &mut self,
        value: FieldSpans<'_, '_>,
        expected: &str,
        movement: Movement,
    ) -> Option<CameraTrack> {
        let parameters = movement.parameters();
        let table = Table::of(value, expected);
        let mut table = self.noted(table)?;
        let span = table.span();
        let keys = self.keys(&mut table, expected, |reader, entries| {
            let mut values = Vec::new();
            for (at, parameter) in parameters.iter().enumerate() {
                let Some(value) = entries.take(parameter.name()) else {
                    continue;
                };
                if let Some(numbers) = reader.noted(parameter_value(*parameter, value)) {
                    values.push((at, Value::Numbers(numbers), span_of(value)));
                }
            }
            Some(values)
        });
        table.finish(&mut self.findings);
        let keys = keys?;
        let of_parameter = |at: usize| {
            let own = keys.iter().filter(|(parameter, _)| *parameter == at);
            Keys::new(own.map(|(_, key)| key.clone()).collect())
        };
        let set = parameters.iter().enumerate();
        let set = set.filter_map(|(at, &parameter)| Some((parameter, of_parameter(at)?)));
        Some(CameraTrack {
            movement,
            parameters: set.collect(),
            span,
        })
    }

    /// Reads keys in ascending order. `values` takes their values, each for one of several channels.
    fn keys(
        &mut self,
        table: &mut Table<'_, '_>,
        expected: &str,
        values: impl Fn(&mut Self, &mut Table<'_, '_>) -> Option<Vec<(usize, Value, Span)>>,
    ) -> Option<Vec<(usize, Key)>> {
        let value = table.require("keys", expected);
        let value = self.noted(value)?;
        let entries = self.noted(elements(value, expected))?;
        if entries.is_empty() {
            self.findings
                .error(|| Diagnostic::error(span_of(value), "there are no keys", expected));
        }
        let errors = self.findings.errors();
        let mut keys = Vec::new();
        let mut before = None;
        for entry in entries {
            let Some(mut entry) = self.noted(Table::of(entry, expected)) else {
                continue;
            };
            let frame = self.frame(&mut entry, &mut before);
            let easing = self.easing(&mut entry);
            let values = values(self, &mut entry);
            entry.finish(&mut self.findings);
            if let (Some(frame), Some(easing), Some(values)) = (frame, easing, values) {
                keys.extend(values.into_iter().map(|(channel, value, span)| {
                    let key = Key {
                        frame,
                        value,
                        easing,
                        span,
                    };
                    (channel, key)
                }));
            }
        }
        (self.findings.errors() == errors).then_some(keys)
    }

    /// Reads the frame of a key, which must come after the one before.
    fn frame(&mut self, entry: &mut Table<'_, '_>, before: &mut Option<u32>) -> Option<u32> {
        let value = entry.require("frame", "the number of a frame, such as frame = 0");
        let value = self.noted(value)?;
        let frame = self.noted(integer(value, [0, MAX_FRAMES]))?;
        let last = self.last;
        match before.replace(frame) {
            Some(same) if same == frame => self.findings.error(|| {
                let message = format!("frame {frame} has two keys");
                Diagnostic::error(span_of(value), message, "one key for each frame")
            }),
            Some(later) if frame < later => self.findings.error(|| {
                let message = format!("frame {frame} comes after frame {later}");
                Diagnostic::error(span_of(value), message, "frames in ascending order")
            }),
            _ if last.saturating_add(1) < frame => self.findings.warning(|| {
                let frames = counted(last as usize + 1, "frame");
                let next = last.saturating_add(1);
                let expected = format!("a frame from 0 to {last}, or {next} to close a loop");
                let message = format!("frame {frame} is beyond the end: there are {frames}");
                Diagnostic::warning(span_of(value), message, expected)
            }),
            _ => {}
        }
        Some(frame)
    }

    fn easing(&mut self, entry: &mut Table<'_, '_>) -> Option<Easing> {
        let Some(value) = entry.take("easing") else {
            return Some(Easing::default());
        };
        let names = || Easing::ALL.map(Easing::name);
        let expected = alternatives(names().map(|name| format!("\"{name}\"")));
        let name = self.noted(string(value, &expected))?.name;
        let easing = Easing::named(&name).ok_or_else(|| {
            let message = format!("unknown easing `{name}`");
            let error = Diagnostic::error(span_of(value), message, expected);
            match nearest_word(&name, names()) {
                Some(nearest) => error.with_hint(format!("did you mean {nearest}?")),
                None => error,
            }
        });
        self.noted(easing)
    }
}

/// A number, several, or a word.
fn any(value: FieldSpans<'_, '_>) -> Result<Value, Diagnostic> {
    const EXPECTED: &str = "a number, an array of numbers, or a string";
    match value.get_ref() {
        DeValue::String(word) => Ok(Value::Word(word.clone().into_owned())),
        DeValue::Array(_) => numbers(value, EXPECTED).map(Value::Numbers),
        _ => match number(value) {
            Some(number) => Ok(Value::Numbers(vec![number])),
            None => Err(no_number(value, EXPECTED)),
        },
    }
}

/// The error for what is not a finite number.
fn no_number(value: FieldSpans<'_, '_>, expected: &str) -> Diagnostic {
    let is_infinite = matches!(value.get_ref(), DeValue::Float(_) | DeValue::Integer(_));
    let number = if is_infinite {
        "a finite number"
    } else {
        "a number"
    };
    wrong(value, number, expected)
}

fn numbers(value: FieldSpans<'_, '_>, expected: &str) -> Result<Vec<f64>, Diagnostic> {
    let elements = elements(value, expected)?;
    let number = |value| number(value).ok_or_else(|| no_number(value, expected));
    elements.into_iter().map(number).collect()
}

/// The numbers of a parameter of the camera.
fn parameter_value(
    parameter: Parameter,
    value: FieldSpans<'_, '_>,
) -> Result<Vec<f64>, Diagnostic> {
    let expected = parameter.expected();
    let numbers = match parameter.components() {
        1 => number(value).map(|number| vec![number]),
        components => {
            let numbers = numbers(value, &expected)?;
            (numbers.len() == components).then_some(numbers)
        }
    };
    let allowed = numbers.filter(|numbers| parameter.allows(numbers));
    allowed.ok_or_else(|| {
        let message = format!("{}: must be {expected}", parameter.name());
        Diagnostic::error(span_of(value), message, expected)
    })
}
