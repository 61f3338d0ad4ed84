//! The commands by their names, and running them.

use super::help::nothing_for;
use super::row::{CommandRow, Run, Runs};
use super::rows::ROWS;
use crate::app::App;
use crate::keymap::Mode;
use crate::matching;
use crate::msg::Effect;
use text::nearest_word;

/// All commands with their arguments, such as `:size WxH`, and descriptions.
pub fn commands() -> impl Iterator<Item = (String, &'static str)> {
    ROWS.iter().map(|row| (row.usage(), row.words))
}

/// The command with exactly this name.
pub(super) fn named(name: &str) -> Option<&'static CommandRow> {
    ROWS.iter().find(|row| row.names.contains(&name))
}

/// The command whose name a line begins with, followed by a blank.
pub(super) fn begun_in(line: &str) -> Option<&'static CommandRow> {
    let begins = |name: &&str| {
        let rest = line.strip_prefix(*name);
        rest.is_some_and(|rest| rest.starts_with(' '))
    };
    let rows = ROWS.iter().filter(|row| row.names.iter().any(begins));
    rows.max_by_key(|row| row.name().len())
}

/// Whether a line can be run.
pub(super) fn is_command(line: &str) -> bool {
    parse(line).is_ok()
}

/// Whether the first word of a line is that of a command, whatever follows.
pub(super) fn begins_command(line: &str) -> bool {
    let first = |words: &str| words.split_whitespace().next().map(str::to_owned);
    let wanted = first(line);
    let mut names = ROWS.iter().flat_map(|row| row.names);
    names.any(|name| first(name) == wanted)
}

/// Parses a command line: its row, and what it does. The error says what is expected.
fn parse(line: &str) -> Result<(&'static CommandRow, Run), String> {
    let line = line.trim();
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let (second, others) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    if let Some(row) = named(&format!("{name} {second}")) {
        return Ok((row, row.parse(others.trim())?));
    }
    if let Some(row) = named(name) {
        return Ok((row, row.parse(rest)?));
    }
    let names = ROWS.iter().map(CommandRow::name);
    let longer = names.filter(|longer| longer.split(' ').next() == Some(name));
    match longer.collect::<Vec<_>>().as_slice() {
        [] => Err(unknown(name)),
        longer => Err(format!("{}?", longer.join(", or "))),
    }
}

fn unknown(name: &str) -> String {
    let names = ROWS.iter().map(CommandRow::name);
    if let Some(nearest) = nearest_word(name, names) {
        return format!("unknown command `{name}`: did you mean {nearest}?");
    }
    let rows = ROWS.iter().map(|row| (row.searched(), row.name()));
    nothing_for(name, matching::nearest(rows, name, 3))
}

impl App {
    /// Runs a command line.
    pub(crate) fn command(&mut self, line: &str) -> Vec<Effect> {
        if line.trim().is_empty() {
            return Vec::new();
        }
        match parse(line) {
            Ok((row, run)) => self.run(row.runs, run),
            Err(reason) => {
                self.shared.fail(reason);
                Vec::new()
            }
        }
    }

    fn run(&mut self, runs: Runs, Run(step): Run) -> Vec<Effect> {
        if runs != Runs::Always && self.shared.mode == Mode::Move {
            self.shared.warn_of_transform();
            return Vec::new();
        }
        if matches!(runs, Runs::OnText | Runs::OnTrack) && self.shared.disk.is_opening() {
            self.shared.warn_of_opening();
            return Vec::new();
        }
        match runs {
            Runs::OnText => self.outside(step),
            Runs::OnTrack | Runs::WhileOpening | Runs::Always => step(self),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::command::row::Arguments;

    #[test]
    fn commands_are_found_by_every_name() {
        for (index, row) in ROWS.iter().enumerate() {
            for name in row.names {
                let argument = match row.arguments {
                    Arguments::Said(" WxH", _) => " 8x6",
                    Arguments::Said(" STOPS", _) => " -1.5",
                    Arguments::Said(" KEY [VALUE|default]", _) => " depth",
                    Arguments::Said(" MODE", _) => " half",
                    Arguments::Said(" typing|saving", _) => " saving",
                    _ => "",
                };
                assert!(parse(&format!(" {name}{argument} ")).is_ok(), "{name}");
                let mut others = ROWS[..index].iter().flat_map(|other| other.names);
                assert!(others.all(|other| other != name), "{name}");
            }
        }
    }
}
