//! Reads the keys of a configuration: tables of keys with the names of their actions.

use toml::de::DeValue;

use super::value::{MOST_ERRORS, Name, Value, advised, in_order, kind_of, span_of};
use text::{Diagnostic, Span, alternatives};
use ui::keymap::{self, Keymap, Keys, Section, key_names};

/// An entry that has been read.
struct Entry {
    keys: Keys,
    /// The name of what they do; `None`: nothing.
    name: Option<&'static str>,
    span: Span,
}

impl Entry {
    /// Whether both cannot be in one section.
    fn excludes(&self, other: &Self) -> bool {
        let act = self.name.is_some() && other.name.is_some();
        self.keys == other.keys || act && self.keys.collides(other.keys)
    }
}

/// Reads the table of keys into a keymap, up to [`MOST_ERRORS`].
pub(super) fn read(value: &Value<'_>, keymap: &mut Keymap, errors: &mut Vec<Diagnostic>) {
    let DeValue::Table(sections) = value.get_ref() else {
        errors.push(no_table(value, "keys"));
        return;
    };
    let mut found = Vec::new();
    for (name, value) in in_order(sections) {
        if MOST_ERRORS <= errors.len() {
            return;
        }
        let Some(section) = Section::named(name.get_ref()) else {
            errors.push(unknown_section(name, value));
            continue;
        };
        let DeValue::Table(entries) = value.get_ref() else {
            errors.push(no_table(value, name.get_ref()));
            continue;
        };
        let mut read: Vec<Entry> = Vec::new();
        for (name, value) in in_order(entries) {
            if MOST_ERRORS <= errors.len() {
                return;
            }
            match entry(section, name, value) {
                Ok(entry) => {
                    let twin = read.iter().find(|other| entry.excludes(other));
                    errors.extend(twin.map(|twin| bound_twice(&entry, twin)));
                    read.push(entry);
                }
                Err(error) => errors.push(error),
            }
        }
        found.push((section, read));
    }
    // The sections of contexts change what is bound anywhere.
    found.sort_by_key(|(section, _)| *section != Section::Anywhere);
    for (section, entries) in &found {
        // The first of an action's keys is the one that hints show.
        for entry in entries.iter().rev() {
            keymap.bind(*section, entry.keys, entry.name);
        }
    }
    for (section, entries) in &found {
        errors.extend(out_of_reach(keymap, *section, entries));
    }
}

fn entry(section: Section, name: &Name<'_>, value: &Value<'_>) -> Result<Entry, Diagnostic> {
    let keys = Keys::parse(name.get_ref()).ok_or_else(|| unknown_key(name))?;
    let name_of_action = action(section, value)?;
    if let Some(reason) = keymap::refusal(section, keys, name_of_action) {
        return Err(Diagnostic::error(span_of(name), reason, "another key"));
    }
    Ok(Entry {
        keys,
        name: name_of_action,
        span: span_of(name),
    })
}

/// The name of the action that a value names; `None` if it is `"none"` or `false`.
fn action(section: Section, value: &Value<'_>) -> Result<Option<&'static str>, Diagnostic> {
    let expected = "the name of an action, or \"none\"";
    let wrong = |message: String| Diagnostic::error(span_of(value), message, expected);
    let name = match value.get_ref() {
        DeValue::Boolean(false) => return Ok(None),
        DeValue::String(name) if name == "none" => return Ok(None),
        DeValue::String(name) => name,
        other => return Err(wrong(format!("this is {}", kind_of(other)))),
    };
    let defaults = Keymap::default();
    let here = defaults.actions_in(section);
    if let Some(known) = here.iter().find(|known| known.name == name) {
        return Ok(Some(known.name));
    }
    let mut others = Section::all();
    let has = |other: &Section| {
        let actions = defaults.actions_in(*other);
        actions.iter().any(|action| action.name == name)
    };
    if let Some(other) = others.find(has) {
        let message = format!("`{name}` is not an action of [keys.{}]", section.name());
        return Err(wrong(message).with_hint(format!("bind it in [keys.{}]", other.name())));
    }
    let error = wrong(format!("unknown action `{name}`"));
    let named = advised(error, name, here.iter().map(|known| known.name));
    Err(match named.hint {
        Some(_) => named,
        None => named.with_hint("halflight --print-keys lists all actions"),
    })
}

fn no_table(value: &Value<'_>, name: &str) -> Diagnostic {
    let message = format!("`{name}`: this is {}", kind_of(value.get_ref()));
    let expected = "a table of keys, such as [keys.select]";
    Diagnostic::error(span_of(value), message, expected)
}

fn unknown_section(name: &Name<'_>, value: &Value<'_>) -> Diagnostic {
    let names = || Section::all().map(Section::name);
    let message = format!("unknown section of keys `{}`", name.get_ref());
    let error = Diagnostic::error(span_of(name), message, alternatives(names()));
    match value.get_ref() {
        DeValue::Table(_) => advised(error, name.get_ref(), names()),
        _ => error.with_hint("write keys below the name of a section, such as [keys.anywhere]"),
    }
}

fn unknown_key(name: &Name<'_>) -> Diagnostic {
    let written = name.get_ref();
    let message = format!("unknown key `{written}`");
    let expected = "a key such as j, Enter or Ctrl-R, or two such as g g";
    let error = Diagnostic::error(span_of(name), message, expected);
    match written.chars().collect::<Vec<_>>().as_slice() {
        [first, second] => error.with_hint(format!("did you mean \"{first} {second}\"?")),
        _ => advised(error, written, key_names()),
    }
}

fn bound_twice(entry: &Entry, twin: &Entry) -> Diagnostic {
    let (keys, other) = (entry.keys.spelling(), twin.keys.spelling());
    let message = if keys == other {
        format!("`{keys}` is bound twice")
    } else {
        format!("`{keys}` and `{other}` begin with the same key")
    };
    Diagnostic::error(entry.span, message, "one action for each key")
}

/// The error that an action is left with keys that terminals keep for themselves.
fn out_of_reach(keymap: &Keymap, section: Section, entries: &[Entry]) -> Option<Diagnostic> {
    let keys = keymap.unreachable_in(section)?;
    let entry = entries.iter().find(|entry| entry.keys == keys)?;
    let message = format!(
        "`{}` is the only key of this action, and many terminals keep it for themselves",
        keys.spelling()
    );
    Some(Diagnostic::error(
        entry.span,
        message,
        "another key as well",
    ))
}
