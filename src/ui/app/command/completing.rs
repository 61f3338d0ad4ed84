//! The palette over the command line: completes commands, their file names, and the actions of
//! keys by their descriptions; recalls command lines.

use std::path::{Path, PathBuf};

use crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use super::help::nothing_for;
use super::row::CommandRow;
use super::rows::ROWS;
use super::running;
use crate::app::shared::line;
use crate::app::{App, Completion, Palette, PromptKind, Shared};
use crate::keymap::{Mode, NamedAction, RowId};
use crate::matching::{self, Likeness, Searched};
use crate::msg::Effect;
use image_file::ImageFormat;
use language::Language;

/// What is completed.
enum Wanted<'a> {
    /// A command or an action that begins like this or contains this.
    Command(&'a str),
    /// A file name, of which this is typed, of a command; the whole line comes first.
    File(&'a str, &'static CommandRow, &'a str),
}

impl App {
    /// Runs the command line: the action chosen or uniquely described, otherwise a command.
    pub(crate) fn run_line(&mut self, line: &str) -> Vec<Effect> {
        // A colon typed once more is no part of the command, as in vi.
        let line = line.trim_start().trim_start_matches(':');
        let found = completions(&self.shared);
        let chosen = self.shared.palette.chosen;
        let is_typed = chosen.is_none() && !line.trim().is_empty();
        let is_begun = running::begins_command(line);
        let is_found = found
            .first()
            .is_some_and(|first| !first.likeness.is_guess());
        if is_typed && is_found && 1 < found.len() && !is_begun && best(&found).is_none() {
            self.shared.warn("several match: Tab chooses");
            return Vec::new();
        }
        self.shared.palette.reset();
        self.shared.overlays.prompt = None;
        self.shared.palette.remember(line);
        let described = match (chosen, found.as_slice()) {
            (Some(at), found) => found.get(at),
            (None, _) if is_begun || running::is_command(line) => None,
            // What is only a guess is to be chosen.
            (None, [only]) => Some(only).filter(|only| !only.likeness.is_guess()),
            (None, found) => best(found),
        };
        match described.and_then(|completion| completion.act) {
            Some((_, mode)) if self.shared.mode == Mode::Move && mode != Mode::Move => {
                self.shared.warn_of_transform();
                Vec::new()
            }
            Some((row, mode @ Mode::Sequence)) => self.act_in(row, mode),
            Some((row, mode)) => self.outside(|app| app.act_in(row, mode)),
            None => self.command(line),
        }
    }

    /// Does what a key does, after going to the mode that has it.
    fn act_in(&mut self, row: RowId, mode: Mode) -> Vec<Effect> {
        let mut effects = Vec::new();
        if mode != self.shared.mode {
            effects = self.go(mode);
            if self.shared.mode != mode {
                return effects;
            }
        }
        effects.extend(self.act(row));
        effects
    }
}

/// Handles a key in the command line other than those that end it.
pub(crate) fn palette_key(shared: &mut Shared, key: KeyEvent) -> Vec<Effect> {
    match key.code {
        KeyCode::Up if recall(shared, Palette::older) => {}
        KeyCode::Down if recall(shared, Palette::newer) => {}
        KeyCode::BackTab | KeyCode::Up => choose_completion(shared, -1),
        KeyCode::Tab | KeyCode::Down => choose_completion(shared, 1),
        _ => {
            if let Some(prompt) = &mut shared.overlays.prompt
                && line::edit_over(&mut prompt.input, &mut prompt.is_selected, key)
            {
                shared.palette.reset();
            }
        }
    }
    list_folder(shared)
}

/// Takes the names in a folder.
pub(crate) fn folder_listed(shared: &mut Shared, folder: PathBuf, names: Vec<String>) {
    shared.palette.folder = Some((folder, names));
}

/// The command whose arguments are being typed.
pub(crate) fn command_typed(shared: &Shared) -> Option<Completion> {
    let row = match wanted(shared)? {
        Wanted::File(_, row, _) => row,
        Wanted::Command(typed) => running::begun_in(typed)?,
    };
    Some(as_completion(row, &shared.keymap.actions(shared.mode)))
}

/// The ways to complete the command line, the best first.
pub(crate) fn completions(shared: &Shared) -> Vec<Completion> {
    match wanted(shared) {
        None => Vec::new(),
        Some(Wanted::Command(typed)) => commands_like(shared, typed.trim_start()),
        Some(Wanted::File(line, row, typed)) => {
            // The line may begin something else: `export cancel`.
            let mut found = commands_like(shared, line);
            let begins =
                |other: &Completion| other.line.starts_with(line) || other.words.starts_with(line);
            found.retain(|other| other.line != row.name() && begins(other));
            found.extend(files_like(shared, row.name(), typed));
            found
        }
    }
}

fn wanted(shared: &Shared) -> Option<Wanted<'_>> {
    let prompt = shared.overlays.prompt.as_ref()?;
    if prompt.kind != PromptKind::Command {
        return None;
    }
    let typed = match shared.palette.chosen {
        Some(_) => &shared.palette.typed,
        None => prompt.input.value(),
    };
    let typed = typed.trim_start();
    let file = typed.split_once(' ').and_then(|(name, rest)| {
        let row = running::named(name).filter(|row| row.takes_file())?;
        // `export cancel` is a command of its own.
        let is_other = running::named(typed).is_some();
        (!is_other).then_some(Wanted::File(typed, row, rest.trim_start()))
    });
    Some(file.unwrap_or(Wanted::Command(typed)))
}

/// The completion whose name is or begins with what was typed, if no other is as good.
fn best(found: &[Completion]) -> Option<&Completion> {
    let first = found.first()?;
    let is_alone = found
        .get(1)
        .is_none_or(|next| first.likeness < next.likeness);
    (is_alone && first.likeness <= Likeness::Begins).then_some(first)
}

/// The commands and the actions of keys that answer what was typed, the best first. An action is left out
/// where a command that does the same is offered.
fn commands_like(shared: &Shared, typed: &str) -> Vec<Completion> {
    let mut keys = Vec::new();
    let found = matching::ranked(offered(shared), typed).into_iter();
    let mut found: Vec<_> = found
        .map(|(likeness, (row, completion))| {
            keys.extend(row.and_then(|row| row.key));
            let is_command = row.is_some();
            (
                is_command,
                Completion {
                    likeness,
                    ..completion
                },
            )
        })
        .collect();
    let name = |completion: &Completion| {
        let (row, _) = completion.act?;
        Some(shared.keymap.name_of(row))
    };
    // What follows a command is its argument.
    if running::begins_command(typed) {
        found.retain(|(_, completion)| !completion.likeness.is_guess());
    }
    found.retain(|(is_command, completion)| {
        *is_command || name(completion).is_none_or(|name| !keys.contains(&name))
    });
    found
        .into_iter()
        .map(|(_, completion)| completion)
        .collect()
}

/// What to say where nothing answers the line: what is nearest to it.
pub(crate) fn nothing_found(shared: &Shared) -> Option<String> {
    let Wanted::Command(typed) = wanted(shared)? else {
        return None;
    };
    let typed = typed.trim();
    if typed.is_empty() || running::begins_command(typed) {
        return None;
    }
    let near = matching::nearest(offered(shared), typed, 3).into_iter();
    let near = near.map(|(_, completion)| completion.shown);
    Some(nothing_for(typed, near))
}

/// Every command and every action of a key, with the row of a command.
fn offered(
    shared: &Shared,
) -> impl Iterator<Item = (Searched<'static>, (Option<&'static CommandRow>, Completion))> {
    let actions = shared.keymap.actions(shared.mode);
    let commands = ROWS.iter().map(|row| {
        let completion = as_completion(row, &actions);
        (row.searched(), (Some(row), completion))
    });
    let commands: Vec<_> = commands.collect();
    let is_open = !shared.disk.is_opening();
    let actions = actions.into_iter().filter(move |_| is_open).map(|named| {
        let searched = Searched {
            name: named.words,
            synonyms: named.synonyms,
            ..Searched::default()
        };
        let keys = if named.mode == shared.mode || named.keys.is_empty() {
            named.keys
        } else {
            format!("{} {}", named.mode.name(), named.keys)
        };
        let completion = Completion {
            line: named.words.to_owned(),
            shown: named.words.to_owned(),
            words: "",
            keys,
            act: Some((named.row, named.mode)),
            likeness: Likeness::Exact,
        };
        (searched, (None, completion))
    });
    commands.into_iter().chain(actions)
}

/// The names in the listed folder that a command may take and that begin as typed.
fn files_like(shared: &Shared, command: &str, typed: &str) -> Vec<Completion> {
    let (folder, _) = parted(typed);
    let names = match &shared.palette.folder {
        Some((listed, names)) if *listed == folder_of(folder) => &names[..],
        _ => &[],
    };
    let own = shared.document.language().extension();
    let is_wanted = |name: &&String| {
        let path = Path::new(name);
        name.ends_with('/')
            || if command.starts_with('w') {
                path.extension().is_some_and(|extension| extension == own)
            } else {
                let is_scene = command == "compare" && Language::of_path(path).is_ok();
                is_scene || ImageFormat::of_path(path).is_some()
            }
    };
    let others = match (command, folder) {
        ("compare", "") => &["saved", "git"][..],
        _ => &[],
    };
    let others = others.iter().map(|&word| word.to_owned());
    let files = names.iter().filter(is_wanted);
    others
        .chain(files.map(|name| format!("{folder}{name}")))
        .filter(|shown| shown.starts_with(typed))
        .map(|shown| Completion {
            line: format!("{command} {shown}"),
            shown,
            words: "",
            keys: String::new(),
            act: None,
            likeness: Likeness::Exact,
        })
        .collect()
}

/// A command, with the keys of the same name in the present mode, otherwise in any.
fn as_completion(command: &CommandRow, actions: &[NamedAction]) -> Completion {
    let mut named = actions.iter();
    let named = named.find(|named| Some(named.name) == command.key);
    Completion {
        line: command.name().to_owned(),
        keys: named.map_or_else(String::new, |named| named.keys.clone()),
        shown: command.usage(),
        words: command.words,
        act: None,
        likeness: Likeness::Exact,
    }
}

/// Puts another completion into the line, wrapping around through the line as typed.
fn choose_completion(shared: &mut Shared, step: isize) {
    let found = completions(shared);
    if shared.palette.chosen.is_none()
        && let Some(prompt) = &shared.overlays.prompt
    {
        prompt.input.value().clone_into(&mut shared.palette.typed);
    }
    let count = found.len() as isize + 1;
    let at = shared.palette.chosen.map_or(0, |at| at as isize + 1);
    let at = (at + step).rem_euclid(count);
    shared.palette.chosen = usize::try_from(at - 1).ok();
    let line = match shared.palette.chosen.and_then(|at| found.get(at)) {
        Some(completion) => &completion.line,
        None => &shared.palette.typed,
    };
    if let Some(prompt) = &mut shared.overlays.prompt {
        prompt.input = Input::from(line.as_str());
    }
}

/// Puts another line of the history into the line; returns whether there was one.
fn recall(shared: &mut Shared, line: fn(&mut Palette, &str) -> Option<String>) -> bool {
    let Some(prompt) = &mut shared.overlays.prompt else {
        return false;
    };
    let Some(line) = line(&mut shared.palette, prompt.input.value()) else {
        return false;
    };
    prompt.input = Input::from(line);
    true
}

/// Requests the names in the folder whose files are completed, unless they are known.
pub(crate) fn list_folder(shared: &mut Shared) -> Vec<Effect> {
    let Some(Wanted::File(.., typed)) = wanted(shared) else {
        return Vec::new();
    };
    let folder = folder_of(parted(typed).0);
    if shared.palette.folder.as_ref().map(|(listed, _)| listed) == Some(&folder) {
        return Vec::new();
    }
    // Nothing is offered until the names arrive, and nothing is requested twice.
    shared.palette.folder = Some((folder.clone(), Vec::new()));
    vec![Effect::ListFolder(folder)]
}

/// The folder and the start of the name in a typed path.
fn parted(typed: &str) -> (&str, &str) {
    typed.split_at(typed.rfind('/').map_or(0, |slash| slash + 1))
}

fn folder_of(typed: &str) -> PathBuf {
    PathBuf::from(if typed.is_empty() { "." } else { typed })
}
