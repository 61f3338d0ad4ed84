//! Keys as they are written in the text of a track file, and new ones in the style of their neighbours.

use toml::Spanned;
use toml::de::DeValue;

use super::table::{integer, span_of};
use super::{Easing, MAX_FRAMES};
use text::{Edit, Span, line_end, line_start};

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

/// The inline table of a key.
pub(super) fn entry(frame: u32, values: &[(String, String)], easing: Easing) -> String {
    let mut entry = format!("{{ frame = {frame}");
    for (name, value) in values {
        entry.extend([", ", name, " = ", value]);
    }
    if easing != Easing::default() {
        entry.extend([", easing = \"", easing.name(), "\""]);
    }
    entry.push_str(" }");
    entry
}

/// Appends a table, after a blank line.
pub(super) fn appended(text: &str, lines: &[&str]) -> Edit {
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
pub(super) struct Written<'t> {
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
    pub(super) fn of(text: &'t str, table: &Spanned<DeValue<'_>>) -> Result<Self, Unkeyed> {
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
    pub(super) fn edits(
        &self,
        frame: u32,
        values: &[(String, String)],
        easing: Easing,
    ) -> Vec<Edit> {
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
                None => more.extend([", ", name, " = ", value]),
            }
        }
        if !more.is_empty() {
            let end = self.entries.iter().map(|(_, span)| span.end()).max();
            edits.extend(end.map(|end| insertion(end, more)));
        }
        Edit::sort(&mut edits);
        edits
    }
}

fn insertion(at: usize, text: String) -> Edit {
    Edit {
        span: Span::at(at),
        text,
    }
}
