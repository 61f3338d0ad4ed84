//! The command line after `:`: each command is one row, from which the parser, the help and the palette
//! come, and which says what the command does.

mod completing;
mod help;
mod row;
mod rows;
mod running;
mod table;

pub(crate) use completing::{
    command_typed, completions, folder_listed, list_folder, nothing_found, palette_key,
};
pub(crate) use help::{help_lines, scroll_help};
pub(crate) use table::PartKind;

#[cfg(test)]
pub(crate) use help::found as found_in_help;
pub use running::commands;

#[cfg(test)]
pub(crate) use rows::ROWS;
