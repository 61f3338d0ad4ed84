//! The pictures of materials, with the options of their statements.

use std::iter::Peekable;

use super::lines::{Fault, Statement, Word};

/// A picture on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The path as written.
    pub path: String,
    /// Multiplies the texture coordinates, before the offset is added; 1, 1 by default.
    pub scale: [f64; 2],
    /// 0, 0 by default.
    pub offset: [f64; 2],
    /// What is seen beyond the picture.
    pub edges: Edges,
}

/// What is seen of a picture where a texture coordinate is below 0 or above 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// The picture again.
    #[default]
    Repeat,
    /// Its edge.
    Clamp,
}

/// Something to warn of, which does not keep a map from being used.
pub(super) enum Problem<'s> {
    /// An option that cannot be used.
    Wrong(Fault),
    /// An option that would change the picture, by its name and where it is written.
    Ignored(&'static str, Word<'s>),
}

/// The options of the format.
const OPTIONS: [&str; 13] = [
    "-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-imfchan", "-mm", "-o", "-s", "-t",
    "-texres", "-type",
];

/// Reads a map. Its options may stand before and after its path, which may contain blanks. Fails if
/// there is no path.
pub(super) fn read<'s>(
    statement: &'s Statement<'_>,
    mut report: impl FnMut(Problem<'s>),
) -> Result<Map, Fault> {
    let mut map = Map {
        path: String::new(),
        scale: [1.0; 2],
        offset: [0.0; 2],
        edges: Edges::Repeat,
    };
    let mut path: Option<(Word<'s>, Word<'s>)> = None;
    let mut is_path_over = false;
    let mut words = statement.words().skip(1).peekable();
    while let Some(word) = words.next() {
        // A path may begin with `//`.
        if path.is_some() && word.begins_foreign_comment() {
            report(Problem::Wrong(Fault::foreign_comment(word)));
            break;
        }
        let Some(option) = option(word) else {
            match &mut path {
                Some((_, last)) if !is_path_over => *last = word,
                Some(_) => {
                    let message = format!("`{}` is not an option", word.shown());
                    let fault = Fault::new(word, message, "an option or the end of the line");
                    report(Problem::Wrong(fault.costing("it is ignored")));
                }
                None => path = Some((word, word)),
            }
            continue;
        };
        is_path_over = path.is_some();
        if let Some(problem) = map.apply(option, word, &mut words) {
            report(problem);
        }
    }
    let Some((first, last)) = path else {
        return Err(Fault::new(
            statement.end(),
            "the path is missing",
            "a picture file",
        ));
    };
    map.path = statement.between(first, last).name();
    Ok(map)
}

/// The option that a word is, in any case.
fn option(word: Word<'_>) -> Option<&'static str> {
    let is_word = |name: &&str| name.as_bytes().eq_ignore_ascii_case(word.text);
    OPTIONS.into_iter().find(is_word)
}

impl Map {
    /// Applies an option with the words that follow it. Returns what to warn of.
    fn apply<'s>(
        &mut self,
        option: &'static str,
        word: Word<'s>,
        words: &mut Peekable<impl Iterator<Item = Word<'s>>>,
    ) -> Option<Problem<'s>> {
        let ignored = Problem::Ignored(option, word);
        match option {
            "-s" | "-o" => {
                let usual = if option == "-s" { 1.0 } else { 0.0 };
                let ([u, v, _], count) = numbers(words, [usual; 3]);
                if count == 0 {
                    return Some(unusable(option, word, "one to three numbers"));
                }
                *if option == "-s" {
                    &mut self.scale
                } else {
                    &mut self.offset
                } = [u, v];
                None
            }
            "-clamp" => {
                self.edges = match switch(words) {
                    Some(true) => Edges::Clamp,
                    Some(false) => Edges::Repeat,
                    None => return Some(unusable(option, word, "on or off")),
                };
                None
            }
            "-bm" => (numbers(words, [1.0]).0 != [1.0]).then_some(ignored),
            "-mm" => (numbers(words, [0.0, 1.0]).0 != [0.0, 1.0]).then_some(ignored),
            "-t" => (numbers(words, [0.0; 3]).0 != [0.0; 3]).then_some(ignored),
            "-imfchan" => {
                value(words, &["r", "g", "b", "m", "l", "z"]);
                Some(ignored)
            }
            "-blendu" | "-blendv" | "-cc" => {
                switch(words);
                None
            }
            "-boost" => {
                numbers(words, [0.0]);
                None
            }
            _ => {
                words.next();
                None
            }
        }
    }
}

fn unusable<'s>(option: &str, word: Word<'s>, expected: &str) -> Problem<'s> {
    let message = format!("{option}: expected {expected}");
    Problem::Wrong(Fault::new(word, message, expected).costing("the option is ignored"))
}

/// The value of a switch, if the next word is one: otherwise it may be the path.
fn switch<'s>(words: &mut Peekable<impl Iterator<Item = Word<'s>>>) -> Option<bool> {
    value(words, &["off", "on"]).map(|value| value == 1)
}

/// The number of the value that is the next word, in any case.
fn value<'s>(
    words: &mut Peekable<impl Iterator<Item = Word<'s>>>,
    values: &[&str],
) -> Option<usize> {
    let is_next = |value: &&str| {
        let is_value = |word: &Word<'_>| value.as_bytes().eq_ignore_ascii_case(word.text);
        words.next_if(is_value).is_some()
    };
    values.iter().position(is_next)
}

/// Replaces numbers by those that follow, and counts these.
fn numbers<'s, const N: usize>(
    words: &mut Peekable<impl Iterator<Item = Word<'s>>>,
    mut numbers: [f64; N],
) -> ([f64; N], usize) {
    let mut count = 0;
    while count < N
        && let Some(number) = words.peek().and_then(|word| word.number().ok())
    {
        words.next();
        numbers[count] = number;
        count += 1;
    }
    (numbers, count)
}
