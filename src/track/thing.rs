//! Things of a scene by their names.

use super::Named;
use language::{Node, Source};
use text::{Diagnostic, Span, alternatives, nearest_word};

/// How many names a message lists.
const MOST_LISTED: usize = 6;

/// The most characters of a comment that serves as a name.
const LONGEST_COMMENT: usize = 30;

/// The things that names may mean, best first.
#[derive(Clone, Debug, Default)]
struct Meanings {
    /// Those with the name, with or without the kind behind it: `object 3 (box)`.
    named: Vec<Node>,
    /// The one that has the number, where the text gives it another name.
    numbered: Vec<Node>,
    /// Those that the list shows with this comment.
    commented: Vec<Node>,
}

/// Finds the things with these names, in one pass over the scene.
pub(super) fn find(source: &Source, names: &[&Named]) -> Vec<Result<Node, Diagnostic>> {
    let mut found = vec![Meanings::default(); names.len()];
    if names.is_empty() {
        return Vec::new();
    }
    for node in source.nodes().iter() {
        let full = source.name(node);
        let short = without_kind(&full);
        let number = node.to_string();
        for (wanted, found) in names.iter().zip(&mut found) {
            let wanted = wanted.name.as_str();
            if wanted == full || wanted == short {
                found.named.push(node);
            } else if wanted == number && !is_numbered(node, short) {
                found.numbered.push(node);
            } else if source.comment(node) == Some(wanted) {
                found.commented.push(node);
            }
        }
    }
    let found = names.iter().zip(&found);
    found
        .map(|(wanted, found)| only(source, wanted, found))
        .collect()
}

/// A name by which [`find`] finds a thing: a short comment, which does not change when things are added,
/// or the shortest other one.
pub(super) fn name_of(source: &Source, node: Node) -> String {
    let full = source.name(node);
    let comment = source.comment(node).unwrap_or_default();
    let is_short = !comment.is_empty() && comment.chars().count() <= LONGEST_COMMENT;
    let names = [
        if is_short { comment } else { &full }.to_owned(),
        without_kind(&full).to_owned(),
        full.clone(),
        node.to_string(),
    ];
    let named = names.clone().map(|name| Named {
        name,
        span: Span::default(),
    });
    let found = find(source, &named.each_ref());
    let first = found.iter().position(|found| *found == Ok(node));
    first.map_or(full, |first| names[first].clone())
}

/// The only thing that a name means.
fn only(source: &Source, wanted: &Named, found: &Meanings) -> Result<Node, Diagnostic> {
    let ranks = [&found.named, &found.numbered, &found.commented];
    let best = ranks.into_iter().find(|nodes| !nodes.is_empty());
    match best.map_or(&[][..], |nodes| nodes) {
        [node] => Ok(*node),
        [] => Err(unknown(source, wanted)),
        several => {
            let message = format!("{} things are called `{}`", several.len(), wanted.name);
            let names = several.iter().take(MOST_LISTED).map(Node::to_string);
            let names = alternatives(names);
            Err(Diagnostic::error(wanted.span, message, names))
        }
    }
}

fn unknown(source: &Source, wanted: &Named) -> Diagnostic {
    let message = format!("nothing in the scene is called `{}`", wanted.name);
    let names: Vec<_> = source
        .nodes()
        .iter()
        .map(|node| source.name(node))
        .collect();
    let shorts = || names.iter().map(|name| without_kind(name));
    let expected = match names.len() {
        0..=MOST_LISTED => alternatives(shorts()),
        _ => "a name as in the list of the interface, such as light 1 or object 2".to_owned(),
    };
    let error = Diagnostic::error(wanted.span, message, expected);
    match nearest_word(&wanted.name, shorts()) {
        Some(nearest) => error.with_hint(format!("did you mean {nearest}?")),
        None => error,
    }
}

/// A name without the kind in parentheses behind it.
fn without_kind(name: &str) -> &str {
    let plain = name
        .strip_suffix(')')
        .and_then(|rest| rest.rsplit_once(" ("));
    plain.map_or(name, |(plain, _)| plain)
}

/// Whether a thing is named by its category and a number, perhaps an ID.
fn is_numbered(node: Node, name: &str) -> bool {
    let number = node.to_string();
    let word = number.split(' ').next().unwrap_or_default();
    name.strip_prefix(word)
        .is_some_and(|rest| rest.trim_start().parse::<i64>().is_ok())
}
