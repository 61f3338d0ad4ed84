//! Prints a configuration, and the keys.

use std::fmt::Write;

use super::settings::{Kind, Setting, as_text, as_toml, settings};
use ui::Options;
use ui::keymap::{Bound, Keymap, Section};

/// The configuration that has the same effect as these options, as TOML: every setting and every
/// key, each with its description. Those with their defaults are commented out.
pub fn print_config(options: &Options) -> String {
    let mut text = String::from(
        "# Configuration of Halflight. What is commented out is the default. The command line\n\
         # takes precedence over this file, and this file over the environment.\n",
    );
    for setting in settings() {
        let line = match value(&setting, options) {
            Some(value) => format!("{} = {value}", setting.name),
            None => format!("# {} = {}", setting.name, setting.default),
        };
        // Writing to a string cannot fail.
        let _ = write!(text, "\n# {}\n{line}\n", setting.words);
    }
    text.push_str(
        "\n# Keys: a name such as \"j\", \"Ctrl-R\", \"Shift-Left\" or \"g g\", and its action; \"none\" takes\n\
         # it away. A mode's own keys take precedence over those bound anywhere.\n",
    );
    for section in Section::all() {
        let _ = write!(text, "\n[keys.{}]\n", section.name());
        for bound in options.keymap.bound_in(section) {
            let _ = writeln!(text, "{}", key_line(&bound));
        }
    }
    text
}

/// All keys, one a line in columns: section, keys, name and description of the action.
pub fn print_keys(keymap: &Keymap) -> String {
    let mut rows = vec![["mode", "key", "action", "description"].map(str::to_owned)];
    for section in Section::all() {
        let bound = keymap.bound_in(section).into_iter();
        rows.extend(bound.filter_map(|bound| {
            let action = bound.action?;
            let texts = [section.name(), action.name, action.words];
            let [section, name, words] = texts.map(str::to_owned);
            Some([section, bound.keys.spelling(), name, words])
        }));
    }
    let widths = [0, 1, 2].map(|column: usize| {
        let widths = rows.iter().map(|row| row[column].chars().count());
        widths.max().unwrap_or(0)
    });
    let mut text = String::new();
    for [section, keys, name, words] in &rows {
        let [first, second, third] = widths;
        let _ = writeln!(
            text,
            "{section:first$}  {keys:second$}  {name:third$}  {words}"
        );
    }
    text
}

fn key_line(bound: &Bound) -> String {
    let (name, words) = bound
        .action
        .map_or(("none", "nothing"), |action| (action.name, action.words));
    let comment = if bound.is_default { "# " } else { "" };
    let keys = quoted(&bound.keys.spelling());
    format!("{comment}{keys} = \"{name}\"  # {words}")
}

/// The value of a setting as TOML; `None` if it has its default.
fn value(setting: &Setting, options: &Options) -> Option<String> {
    match &setting.kind {
        Kind::Render(key) => {
            let asked = &options.rendering;
            key.get(asked).map(|_| as_toml(*key, key.value(asked)))
        }
        Kind::Integer { get, .. } => get(options).map(|number| number.to_string()),
        Kind::Word { get, .. } => get(options).map(quoted),
        Kind::Switch { get, .. } => get(options).map(|is_on| is_on.to_string()),
        Kind::Text { get, .. } => get(options).map(quoted),
        Kind::Folders { get, .. } => {
            let folders = get(options).iter();
            let folders: Vec<_> = folders
                .filter_map(|folder| as_text(folder))
                .map(quoted)
                .collect();
            (!folders.is_empty()).then(|| format!("[{}]", folders.join(", ")))
        }
    }
}

/// A text as TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            character if character.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(character));
            }
            character => quoted.push(character),
        }
    }
    quoted.push('"');
    quoted
}
