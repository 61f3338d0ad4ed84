//! The command line after `:`: each command is one row, from which the parser, the help and the palette
//! come, and which says what the command does.

mod completing;
mod help;
mod row;
mod rows;
mod running;

pub(crate) use completing::{command_typed, completions, folder_listed, list_folder, palette_key};
pub(crate) use help::{help_columns, scroll_help};
pub use running::commands;

#[cfg(test)]
pub(crate) use rows::ROWS;
