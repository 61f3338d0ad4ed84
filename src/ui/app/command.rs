//! The line after `:`.

use std::path::{Path, PathBuf};

use super::{App, Disk, Help, PromptKind};
use crate::image_file::ImageFormat;
use crate::language::Language;
use crate::render::MAX_SPP;
use crate::scene::{Camera, Size};
use crate::text::slips;
use crate::ui::msg::{Effect, Existing, Guard};

/// What a command line means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// Save, here or in another file.
    Write(Option<PathBuf>, Force),
    /// Quit.
    Quit(Force),
    /// Save and quit.
    WriteQuit,
    /// Read the file again.
    Reread,
    /// Write a picture.
    Export {
        path: Option<PathBuf>,
        size: Option<Size>,
        spp: Option<u32>,
        force: Force,
    },
    /// Cancel the export.
    ExportCancel,
    /// Trace at full size.
    Render,
    /// Write the working view into the text.
    ViewSave,
    /// Go back to the text's view.
    ViewReset,
    /// Set the size of the output picture.
    Size(Size),
    /// Show the keys.
    Help,
}

/// Whether a command ends in `!`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Force {
    No,
    Yes,
}

/// Every command as it is written, for the message about an unknown one.
const NAMES: [&str; 13] = [
    "w",
    "w!",
    "q",
    "q!",
    "wq",
    "e",
    "export",
    "export!",
    "render",
    "view save",
    "view reset",
    "size",
    "help",
];

/// Parses a command line; the error names what is expected.
pub(super) fn parse(line: &str) -> Result<Command, String> {
    let line = line.trim();
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let file = (!rest.is_empty()).then(|| PathBuf::from(rest));
    let alone = |command| match rest {
        "" => Ok(command),
        _ => Err(format!("{name} takes nothing after it")),
    };
    match name {
        "w" | "write" => Ok(Command::Write(file, Force::No)),
        "w!" | "write!" => Ok(Command::Write(file, Force::Yes)),
        "q" | "quit" => alone(Command::Quit(Force::No)),
        "q!" | "quit!" => alone(Command::Quit(Force::Yes)),
        "wq" | "x" => alone(Command::WriteQuit),
        "e" | "reread" => alone(Command::Reread),
        "render" => alone(Command::Render),
        "help" => alone(Command::Help),
        "export" if rest == "cancel" => Ok(Command::ExportCancel),
        "export" => export(rest, Force::No),
        "export!" => export(rest, Force::Yes),
        "size" => Size::parse(rest)
            .map(Command::Size)
            .ok_or_else(|| "size takes two whole numbers: size 800x600".to_owned()),
        "view" => match rest {
            "save" => Ok(Command::ViewSave),
            "reset" => Ok(Command::ViewReset),
            _ => Err("view save, or view reset?".to_owned()),
        },
        _ => Err(unknown(name)),
    }
}

/// `FILE [WxH] [spp]`; the file's name may hold blanks.
fn export(rest: &str, force: Force) -> Result<Command, String> {
    let mut words: Vec<_> = rest.split_whitespace().collect();
    let mut spp = None;
    if let Some(count) = words.last().and_then(|word| word.parse().ok()) {
        if !(1..=MAX_SPP).contains(&count) {
            return Err(format!("{count}: samples a pixel are 1 to {MAX_SPP}"));
        }
        spp = Some(count);
        words.pop();
    }
    let size = words.last().and_then(|word| Size::parse(word));
    if size.is_some() {
        words.pop();
    }
    if let Some(wrong) = wrong_word(&words) {
        return Err(wrong);
    }
    let path = (!words.is_empty()).then(|| PathBuf::from(words.join(" ")));
    Ok(Command::Export {
        path,
        size,
        spp,
        force,
    })
}

/// What is wrong with the word behind a picture's name, if one is left there.
fn wrong_word(words: &[&str]) -> Option<String> {
    let is_picture = |word: &&str| ImageFormat::of_path(Path::new(word)).is_some();
    let word = match words.iter().rposition(is_picture) {
        Some(name) => words.get(name + 1)?,
        None => words.last()?,
    };
    let numbers = |extra: &str| {
        let known = |c: char| c.is_ascii_digit() || extra.contains(c);
        word.starts_with(|c: char| c.is_ascii_digit()) && word.chars().all(known)
    };
    if numbers("") {
        Some(format!("{word}: samples a pixel are 1 to {MAX_SPP}"))
    } else if numbers("xX×*") {
        Some(format!("`{word}` is not a size such as 800x600"))
    } else if words.last().is_some_and(is_picture) || !words.iter().any(is_picture) {
        None
    } else {
        Some(format!("`{word}` is neither a size nor samples a pixel"))
    }
}

fn unknown(name: &str) -> String {
    let nearest = NAMES
        .iter()
        .min_by_key(|known| slips(name, known))
        .filter(|known| slips(name, known) <= 2);
    match nearest {
        Some(nearest) => format!("{name} is not a command; did you mean {nearest}?"),
        None => format!(
            "{name} is not a command; the commands are {}",
            NAMES.join(", ")
        ),
    }
}

impl App {
    /// Runs a command line.
    pub(super) fn command(&mut self, line: &str) -> Vec<Effect> {
        if line.trim().is_empty() {
            return Vec::new();
        }
        match parse(line) {
            Ok(command) => self.run(command),
            Err(reason) => {
                self.fail(reason);
                Vec::new()
            }
        }
    }

    fn run(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Quit(_) | Command::Help => {}
            _ if self.is_opening() => {
                self.warn_of_opening();
                return Vec::new();
            }
            _ => {}
        }
        match command {
            Command::Write(file, force) => return self.write(file, force),
            Command::Quit(Force::No) => return self.quit(),
            Command::Quit(Force::Yes) => return self.quit_anyway(),
            Command::WriteQuit => {
                self.pending.quit = self.path.is_some();
                if self.pending.quit && !self.document.is_dirty() && self.disk == Disk::Known {
                    return self.quit_when_done();
                }
                return self.save();
            }
            Command::Reread => return self.reread(),
            Command::Export {
                path,
                size,
                spp,
                force,
            } => {
                let path = path.unwrap_or_else(|| self.export_path());
                let existing = match force {
                    Force::No => Existing::Kept,
                    Force::Yes => Existing::Overwritten,
                };
                return self.start_export(&path, size, spp, existing);
            }
            Command::ExportCancel => return self.cancel_export(),
            Command::Render => return self.start_trace(),
            Command::ViewSave => self.save_view(),
            Command::ViewReset => self.reset_view(),
            Command::Size(size) => self.set_size(size),
            Command::Help => self.help = Some(Help::default()),
        }
        Vec::new()
    }

    fn write(&mut self, file: Option<PathBuf>, force: Force) -> Vec<Effect> {
        let own = self.document.language();
        if let Some(path) = &file
            && Language::of_path(path) != Ok(own)
        {
            let extension = own.extension();
            let name = path.with_extension(extension);
            self.open_prompt(PromptKind::Command, &format!("w {}", name.display()));
            let shown = path.display();
            self.fail(format!("{shown}: the name must end in .{extension}"));
            // What stands there may be no file at all.
            return vec![Effect::CheckPlace(path.clone())];
        }
        match (file.or_else(|| self.path.clone()), force) {
            (Some(path), Force::Yes) => self.save_to(path, Guard::Anything),
            (Some(path), Force::No) if !self.is_own_path(&path) => {
                if self.refuses_errors(&path) {
                    return Vec::new();
                }
                self.save_to(path, Guard::Absent)
            }
            (_, Force::No | Force::Yes) => self.save(),
        }
    }

    fn set_size(&mut self, size: Size) {
        let Some(scene) = self.scene.clone().filter(|_| self.error_count() == 0) else {
            self.fail("the size can't be written while the scene has errors");
            return;
        };
        let camera = Camera {
            size,
            ..scene.camera
        };
        self.document.end_step();
        if let Err(refused) = self.write_camera(&camera, &scene.camera) {
            self.fail(refused.message);
        }
        self.document.end_step();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::app::Mode;
    use crate::ui::keymap::{HelpLine, help};

    #[test]
    fn every_command_is_in_the_help() {
        let lines = help("", Mode::Select);
        let listed: Vec<_> = lines
            .iter()
            .filter_map(|line| match line {
                HelpLine::Entry { keys, .. } => Some(keys.split("  ")),
                HelpLine::Heading(_) => None,
            })
            .flatten()
            .filter_map(|form| form.strip_prefix(':'))
            .collect();
        for name in NAMES {
            let matches = |form: &&str| *form == name || form.starts_with(&format!("{name} "));
            assert!(listed.iter().any(matches), "{name} is not in {listed:?}");
        }
    }
}
