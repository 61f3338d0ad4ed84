//! Reads a configuration.

use toml::de::{DeInteger, DeTable, DeValue};

use super::keys;
use super::settings::{Kind, Setting, folder, settings};
use super::value::{MOST_ERRORS, Name, Value, advised, in_order, kind_of, span_of};
use scene::Values;
use text::{Diagnostic, Span, alternatives};
use ui::Options;

/// The table of keys.
const KEYS: &str = "keys";

/// Reads a configuration; what it does not set is left to its default. Fails with all errors, at most a
/// hundred, in the order of the text.
pub fn read(text: &str) -> Result<Options, Vec<Diagnostic>> {
    let (root, faults) = DeTable::parse_recoverable(text);
    let faults = faults.iter().take(MOST_ERRORS).map(|fault| {
        let span = fault.span().unwrap_or_default();
        let expected = "a setting such as spp = 16, or a table such as [keys.select]";
        Diagnostic::error(Span::new(span.start, span.end), fault.message(), expected)
    });
    let mut errors: Vec<_> = faults.collect();
    let mut options = Options::default();
    // What could not be read would only cause more errors.
    if errors.is_empty() {
        for (name, value) in in_order(root.get_ref()) {
            if MOST_ERRORS <= errors.len() {
                break;
            }
            if name.get_ref() == KEYS {
                keys::read(value, &mut options.keymap, &mut errors);
            } else if let Err(error) = set(name, value, &mut options) {
                errors.push(error);
            }
        }
    }
    if errors.is_empty() {
        return Ok(options);
    }
    errors.sort_by_key(|error| error.span);
    errors.truncate(MOST_ERRORS);
    Err(errors)
}

fn set(name: &Name<'_>, value: &Value<'_>, options: &mut Options) -> Result<(), Diagnostic> {
    let named = settings().find(|setting| setting.name == name.get_ref());
    let Some(setting) = named else {
        let names = || settings().map(|setting| setting.name).chain([KEYS]);
        let message = format!("unknown setting `{}`", name.get_ref());
        let error = Diagnostic::error(span_of(name), message, alternatives(names()));
        return Err(advised(error, name.get_ref(), names()));
    };
    let wrong = |is: &str| {
        let message = format!("`{}`: {is}", setting.name);
        Diagnostic::error(span_of(value), message, setting.expected())
    };
    match (&setting.kind, value.get_ref()) {
        (Kind::Render(key), value) => {
            let number = number_for(key.setting().values, value, &wrong)?;
            options.rendering = key.with(number, &options.rendering);
        }
        (Kind::Integer { range, set, .. }, DeValue::Integer(number)) => {
            let number = integer(number).filter(|number| range.contains(number));
            set(options, number.ok_or_else(|| wrong("out of range"))?);
        }
        (Kind::Word { words, set, .. }, DeValue::String(word)) => {
            if !words().contains(&&**word) {
                return Err(unknown(word, &words(), &wrong));
            }
            set(options, word);
        }
        (Kind::Switch { set, .. }, DeValue::Boolean(is_on)) => set(options, *is_on),
        (Kind::Text { .. }, DeValue::String(text)) if text.trim().is_empty() => {
            return Err(wrong("the string is empty"));
        }
        (Kind::Text { set, .. }, DeValue::String(text)) => set(options, text),
        (Kind::Folders { set, .. }, DeValue::Array(list)) => {
            let folders = list.iter().map(|entry| match entry.get_ref() {
                DeValue::String(text) => folder(text).ok_or((entry, "a relative path")),
                other => Err((entry, kind_of(other))),
            });
            let folders: Result<Vec<_>, _> = folders.collect();
            set(
                options,
                folders.map_err(|(entry, is)| Diagnostic {
                    span: span_of(entry),
                    ..wrong(&format!("this is {is}"))
                })?,
            );
        }
        (_, other) => return Err(wrong(&format!("this is {}", kind_of(other)))),
    }
    Ok(())
}

/// The number that stands for a value of a render setting.
fn number_for(
    values: Values,
    value: &DeValue<'_>,
    wrong: &impl Fn(&str) -> Diagnostic,
) -> Result<f64, Diagnostic> {
    let number = match (values, value) {
        (Values::Words { names, .. }, DeValue::String(word)) => {
            let place = values.read(word);
            return place.ok_or_else(|| unknown(word, names, wrong));
        }
        (Values::Words { .. }, _) => None,
        (_, DeValue::Integer(number)) => {
            Some(integer(number).and_then(|number| values.read(&number.to_string())))
        }
        (Values::Whole(..), _) => None,
        (_, DeValue::Float(number)) => Some(values.read(number.as_str())),
        _ => None,
    };
    let number = number.ok_or_else(|| wrong(&format!("this is {}", kind_of(value))))?;
    number.ok_or_else(|| wrong("out of range"))
}

fn integer(number: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

fn unknown(word: &str, words: &[&str], wrong: &impl Fn(&str) -> Diagnostic) -> Diagnostic {
    let error = wrong(&format!("unknown word `{word}`"));
    advised(error, word, words.iter().copied())
}

impl Setting {
    /// The values that it may have.
    fn expected(&self) -> String {
        let whole = |least: i64, most: i64| format!("an integer from {least} to {most}");
        let one_of = |words: &[&str]| alternatives(words.iter().map(|word| format!("\"{word}\"")));
        match &self.kind {
            Kind::Render(key) => match key.setting().values {
                Values::Words { names, .. } => one_of(names),
                Values::Whole(least, most) => whole(least.into(), most.into()),
                values => values.expected(),
            },
            Kind::Integer { range, .. } => whole(*range.start(), *range.end()),
            Kind::Word { words, .. } => one_of(&words()),
            Kind::Switch { .. } => "true or false".to_owned(),
            Kind::Text { .. } => "a string".to_owned(),
            Kind::Folders { .. } => "an array of absolute paths".to_owned(),
        }
    }
}
