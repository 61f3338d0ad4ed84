//! Fields of a thing by their names, and the values that they may have.

use std::collections::BTreeMap;

use super::{Key, Keys, Named, Value};
use language::schema::{Field, Kind, Range};
use language::{FieldSpans, Node, Source};
use text::{Diagnostic, Findings, alternatives, counted, nearest_word};

/// A field of a thing, or one component of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    /// The index of the field among those of the thing.
    pub(super) field: usize,
    /// The component, if only that is meant.
    pub(super) component: Option<usize>,
}

impl Place {
    /// Whether two places of one thing overlap.
    pub(super) fn overlaps(self, other: Self) -> bool {
        let apart = self
            .component
            .zip(other.component)
            .is_some_and(|(a, b)| a != b);
        self.field == other.field && !apart
    }
}

/// Finds a field of a thing: `position`, `position y`, or `rotate 2` of several with one name.
pub(super) fn find(
    thing: &str,
    fields: &[FieldSpans],
    wanted: &Named,
) -> Result<Place, Diagnostic> {
    let counts = counts(fields);
    let names = names(fields);
    let found = names.iter().find(|(name, ..)| *name == wanted.name);
    if let Some(&(_, field, component)) = found {
        return Ok(Place { field, component });
    }
    let several = counts.get(wanted.name.as_str()).filter(|&&count| 1 < count);
    let message = match several {
        Some(count) => format!("{thing} has {count} fields called `{}`", wanted.name),
        None => format!("{thing} has no field called `{}`", wanted.name),
    };
    let whole = || {
        let whole = names.iter().filter(|(.., component)| component.is_none());
        let whole = whole.map(|(name, ..)| name.as_str());
        whole.filter(|name| several.is_none() || name.starts_with(&wanted.name))
    };
    let error = Diagnostic::error(wanted.span, message, alternatives(whole()));
    let nearest = nearest_word(&wanted.name, names.iter().map(|(name, ..)| name.as_str()));
    Err(match nearest {
        Some(nearest) if several.is_none() => error.with_hint(format!("did you mean {nearest}?")),
        _ => error,
    })
}

/// The number of fields with each name.
fn counts(fields: &[FieldSpans]) -> BTreeMap<&str, usize> {
    let mut counts = BTreeMap::new();
    for placed in fields {
        *counts.entry(placed.field.key).or_default() += 1;
    }
    counts
}

/// The names of all fields and components, with their places.
fn names(fields: &[FieldSpans]) -> Vec<(String, usize, Option<usize>)> {
    let counts = counts(fields);
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    let mut names = Vec::new();
    for (at, placed) in fields.iter().enumerate() {
        let key = placed.field.key;
        let number = numbers.entry(key).or_default();
        *number += 1;
        let name = match counts.get(key) {
            Some(1) | None => key.to_owned(),
            Some(_) => format!("{key} {number}"),
        };
        let components = placed.field.kind.component_names().iter().enumerate();
        for (component, word) in components.filter(|(_, word)| !word.is_empty()) {
            names.push((format!("{name} {word}"), at, Some(component)));
        }
        names.push((name, at, None));
    }
    names
}

/// The name of a field, or of one of its components.
pub(super) fn name_of(fields: &[FieldSpans], field: usize, component: Option<usize>) -> String {
    let mut names = names(fields).into_iter();
    let named = names.find(|(_, at, own)| (*at, *own) == (field, component));
    named.map_or_else(String::new, |(name, ..)| name)
}

/// Checks the values that keys give to a field.
pub(super) fn check(
    source: &Source,
    node: Node,
    (placed, component): (&FieldSpans, Option<usize>),
    keys: &Keys,
    findings: &mut Findings,
) {
    let field = placed.field;
    let what = format!("{} {}", source.name(node), field.key);
    let first = keys.iter().next();
    let first = first.map(|key| key.value.count()).unwrap_or_default();
    for key in keys.iter() {
        let checked = match &key.value {
            Value::Numbers(numbers) if field.kind.is_numeric() => {
                check_numbers(field, component, numbers)
            }
            Value::Numbers(numbers) => check_id(source, (node, field), numbers),
            Value::Word(word) => check_word(source, (node, field), word),
        };
        let own = key.value.count();
        let checked = checked.and_then(|()| {
            let wrong = || (format!("has {}", numbers(own)), numbers(first));
            (own == first).then_some(()).ok_or_else(wrong)
        });
        if let Err((is, expected)) = checked {
            let message = format!("{what}: {is}");
            findings.error(|| wrong(source, (node, field), key, (message, expected)));
        }
    }
}

/// What is wrong with a value, and what was expected.
type Wrong = (String, String);

fn numbers(count: usize) -> String {
    counted(count, "number")
}

fn check_numbers(field: &Field, component: Option<usize>, values: &[f64]) -> Result<(), Wrong> {
    let names = field.kind.component_names();
    let expected = match component {
        Some(_) => vec![1],
        None if takes_three(field.kind) => vec![3, names.len()],
        None => vec![names.len()],
    };
    if !expected.contains(&values.len()) {
        let list = match expected[..] {
            [count] => numbers(count),
            _ => format!("{} numbers", alternatives(&expected)),
        };
        let named = match component {
            None if 1 < names.len() => format!(": {}", names.join(", ")),
            _ => String::new(),
        };
        return Err((
            format!("has {}", numbers(values.len())),
            format!("{list}{named}"),
        ));
    }
    let mut values = values.iter();
    match values.find(|&&value| !field.allowed.contains(value)) {
        None => Ok(()),
        Some(&value) => {
            let limits = format!("must be {}", field.allowed.limits_against(value));
            Err((limits, field.allowed.words_against(value)))
        }
    }
}

/// Whether the factor or the angle may be left out, and stays.
fn takes_three(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::ScaledVector | Kind::ScaledColour | Kind::Rotation
    )
}

/// Checks a number as the ID of another thing.
fn check_id(source: &Source, (node, field): (Node, &Field), values: &[f64]) -> Result<(), Wrong> {
    match (field.kind, values) {
        (Kind::Reference(_), [id]) if Range::Identity.contains(*id) => {
            check_word(source, (node, field), &id.to_string())
        }
        (Kind::Reference(_), _) => Err(("is no ID".to_owned(), field.expected())),
        _ => Err(("is a number".to_owned(), field.expected())),
    }
}

fn check_word(source: &Source, (node, field): (Node, &Field), word: &str) -> Result<(), Wrong> {
    let unknown = || (format!("`{word}` is unknown"), field.expected());
    match field.kind {
        Kind::Choice(_) if field.chosen(word).is_some() => Ok(()),
        Kind::Reference(category) | Kind::Name(category) => {
            let known = source.references(node, category);
            let is_known = known.iter().any(|(name, _)| name == word);
            is_known.then_some(()).ok_or_else(unknown)
        }
        Kind::Choice(_) => Err(unknown()),
        Kind::Word if word.trim().is_empty() || word.contains(char::is_control) => {
            Err(("is no word".to_owned(), field.expected()))
        }
        Kind::Word => Ok(()),
        _ => Err(("is a word".to_owned(), field.expected())),
    }
}

/// The error for a value, which advises the nearest of the words that it may be.
fn wrong(
    source: &Source,
    (node, field): (Node, &Field),
    key: &Key,
    (message, expected): Wrong,
) -> Diagnostic {
    let error = Diagnostic::error(key.span, message, expected);
    let Value::Word(word) = &key.value else {
        return error;
    };
    let known: Vec<_> = match field.kind {
        Kind::Choice(words) => words.iter().map(|&word| word.to_owned()).collect(),
        Kind::Reference(category) | Kind::Name(category) => {
            let known = source.references(node, category).into_iter();
            known.map(|(name, _)| name).collect()
        }
        _ => Vec::new(),
    };
    match nearest_word(word, known.iter().map(String::as_str)) {
        Some(nearest) => error.with_hint(format!("did you mean {nearest}?")),
        None => error,
    }
}
