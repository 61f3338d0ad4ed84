//! The manual page: the interface with its keys and commands, followed by the commands of the shell.

use clap::Command;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};

use ui::app::commands;
use ui::keymap::Keymap;

/// The page about this command line, in the language of `man`.
pub(super) fn page(mut cli: Command) -> Vec<u8> {
    // Without this, the commands lack the program's name.
    cli.build();
    let mut page = Vec::new();
    write_command(&cli, &mut page);
    let keys = config::print_keys(&Keymap::default());
    let commands = commands().map(|(usage, words)| format!("{usage:<34} {words}"));
    // Writing to memory cannot fail.
    let _ = table("KEYS", keys.lines()).to_writer(&mut page);
    let commands: Vec<_> = commands.collect();
    let _ = table("COMMANDS", commands.iter().map(String::as_str)).to_writer(&mut page);
    let others = cli.get_subcommands();
    for command in others.filter(|command| command.get_name() != "help") {
        write_command(command, &mut page);
    }
    page
}

/// Writes what a command of the shell does, with its options and notes.
fn write_command(command: &Command, page: &mut Vec<u8>) {
    let notes = command
        .get_after_long_help()
        .or_else(|| command.get_after_help());
    let notes = notes.map(ToString::to_string).unwrap_or_default();
    let plain = command.clone().after_help("").after_long_help("");
    let _ = Man::new(plain).render(page);
    let _ = notes_section(&notes).to_writer(page);
}

/// A section of lines that stay as they are.
fn table<'l>(title: &str, lines: impl Iterator<Item = &'l str>) -> Roff {
    let mut section = Roff::default();
    section.control("SH", [title]).control("nf", []);
    for line in lines {
        section.text([roman(line)]);
    }
    section.control("fi", []);
    section
}

/// What follows the options in the help, as a section in which indented lines stay as they are.
fn notes_section(notes: &str) -> Roff {
    let mut section = Roff::default();
    let mut is_kept = false;
    if !notes.is_empty() {
        section.control("SH", ["NOTES"]);
    }
    for line in notes.lines() {
        let keeps = line.starts_with("  ");
        if keeps != is_kept {
            section.control(if keeps { "nf" } else { "fi" }, []);
            is_kept = keeps;
        }
        if line.is_empty() {
            section.control("PP", []);
        } else {
            section.text([roman(line)]);
        }
    }
    if is_kept {
        section.control("fi", []);
    }
    section
}
