//! The manual page: the command line, what it does by topic, and the keys and commands of the interface.

use clap::Command;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};

use ui::app::commands;
use ui::keymap::Keymap;

/// What concerns more than one command: sections under headings in capitals, of paragraphs and of
/// indented lines, which stay as they are.
const TOPICS: &str = include_str!("topics.txt");

/// The page about this command line, in the language of `man`.
pub(super) fn page(mut cli: Command) -> Vec<u8> {
    // Without this, the commands lack the program's name.
    cli.build();
    let mut page = Page(Vec::new());
    // Writing to memory cannot fail, here and below.
    let _ = Man::new(cli.clone()).render_title(&mut page.0);
    page.section("NAME");
    page.write(|name| {
        name.text([roman(
            "halflight - a progressive ray tracer that lives in the terminal",
        )]);
    });
    page.section("SYNOPSIS");
    let all = cli.get_subcommands();
    let shown: Vec<_> = all.filter(|command| command.get_name() != "help").collect();
    page.table([&cli].into_iter().chain(shown.iter().copied()).map(usage));
    page.section("DESCRIPTION");
    page.notes(&described(&cli));
    page.options(&cli);
    page.notes(&notes(&cli));
    for command in shown {
        let name = command.get_name().to_uppercase();
        page.section(&format!("HALFLIGHT {name}"));
        page.notes(&described(command));
        page.options(command);
        page.notes(&notes(command));
    }
    page.notes(TOPICS);
    page.section("KEYS");
    page.notes("Each key can be bound to another action in the configuration, under its mode.");
    let keys = config::print_keys(&Keymap::default());
    page.table(keys.lines().map(str::to_owned));
    page.section("COMMANDS OF THE INTERFACE");
    page.table(commands().map(|(usage, words)| format!("{usage:<34} {words}")));
    page.0
}

/// How a command is called: each way on a line.
fn usage(command: &Command) -> String {
    let usage = command.clone().render_usage().to_string();
    let lines = usage.trim_start_matches("Usage:").lines().map(str::trim);
    lines.collect::<Vec<_>>().join("\n")
}

/// What a command does, as a sentence.
fn described(command: &Command) -> String {
    let about = command.get_long_about().or_else(|| command.get_about());
    let about = about.map(ToString::to_string).unwrap_or_default();
    format!("{}.", about.trim_end_matches('.'))
}

/// What follows the options in the help.
fn notes(command: &Command) -> String {
    let notes = command.get_after_long_help();
    let notes = notes.or_else(|| command.get_after_help());
    notes.map(ToString::to_string).unwrap_or_default()
}

/// A page in the language of `man`.
struct Page(Vec<u8>);

impl Page {
    fn section(&mut self, title: &str) {
        self.write(|section| {
            section.control("SH", [title]);
        });
    }

    /// Lines that stay as they are.
    fn table(&mut self, texts: impl Iterator<Item = String>) {
        self.write(|section| {
            section.control("nf", []);
            for text in texts {
                for line in text.lines() {
                    section.text([roman(line)]);
                }
            }
            section.control("fi", []);
        });
    }

    /// The options of a command, under a heading of their own.
    fn options(&mut self, command: &Command) {
        let mut options = Vec::new();
        let _ = Man::new(command.clone()).render_options_section(&mut options);
        let options = String::from_utf8_lossy(&options);
        let listed = options.lines().skip_while(|line| *line != ".SH OPTIONS");
        self.write(|section| {
            section.control("SS", ["Options"]);
        });
        for line in listed.skip(1) {
            self.0.extend_from_slice(line.as_bytes());
            self.0.push(b'\n');
        }
    }

    /// Paragraphs, lines that are indented and stay as they are, and headings in capitals.
    fn notes(&mut self, notes: &str) {
        self.write(|section| {
            let mut is_kept = false;
            section.control("PP", []);
            for line in notes.lines() {
                let keeps = line.starts_with("  ");
                if keeps != is_kept {
                    section.control(if keeps { "nf" } else { "fi" }, []);
                    is_kept = keeps;
                }
                let is_heading = line.len() > 4 && !line.contains(|c: char| c.is_lowercase());
                if line.is_empty() {
                    section.control("PP", []);
                } else if is_heading {
                    section.control("SH", [line]);
                } else {
                    section.text([roman(line)]);
                }
            }
            if is_kept {
                section.control("fi", []);
            }
        });
    }

    fn write(&mut self, of: impl FnOnce(&mut Roff)) {
        let mut section = Roff::default();
        of(&mut section);
        let written = section.render();
        // The title has defined the apostrophe.
        let preamble = Roff::default().render();
        let written = written.strip_prefix(&preamble).unwrap_or(&written);
        self.0.extend_from_slice(written.as_bytes());
    }
}
