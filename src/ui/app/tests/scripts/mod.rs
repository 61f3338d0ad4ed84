//! Scripts, which know the interface from outside: what is pressed or happens, and what is seen
//! then.
//!
//! Each line is a step, and after bars what holds then; a bar and `>` begin a further step:
//!
//! ```text
//! jjjel            | text 0 0 0 => 0.1 0 0 | dirty
//! @file 1.5 => 1.7 | says merged… | not asks | > u | text 0 0 0 => 0.1 0 0
//! ```
//!
//! A step is keys, `[object 1]` before them to select that first, an event (see [`steps`]), or
//! nothing. A check is the name of what is seen (see [`seen`] and [`values`]) and how it reads,
//! where `…` stands for anything; without that, that there is any; after `not`, the opposite.
//! `undoes` says that the changes are one step without errors, and `becomes` what text it leads
//! to, in SELECT. Texts are replacements (and additions, `before +> added`) in the text as it was
//! opened, or in one of another name before them: `mine`, which is edited, `file`, which was read
//! last, and those of the stage, which also stand for their names in braces. `\n` and `\s` are a
//! new line and a space.

mod assets;
mod buffers;
mod effects;
mod files;
mod screen;
mod seen;
mod steps;
mod traced;
mod values;

use std::collections::BTreeMap;
use std::sync::Arc;

pub(super) use steps::half_way;

use super::*;

/// Tests that are scripts: the name of each, and what runs it.
macro_rules! scripts {
    ($($(#[$doc:meta])* $name:ident: $run:expr;)*) => {
        $($(#[$doc])* #[test] fn $name() { $run; })*
    };
}
pub(super) use scripts;

/// What scripts begin with.
#[derive(Clone)]
pub(super) struct Stage<'s> {
    opening: Opening,
    /// Steps that every session begins with.
    begins: &'s str,
    texts: BTreeMap<&'s str, String>,
}

/// One use of the interface.
pub(super) struct Session {
    pub(super) app: App,
    /// The effects of the last step.
    pub(super) effects: Vec<Effect>,
    /// Texts by name.
    texts: BTreeMap<String, String>,
    /// What was begun and not answered yet.
    under_way: steps::UnderWay,
}

/// The stage of [`SCENE`] with the cursor on the first row of the list.
pub(super) fn ray<'s>() -> Stage<'s> {
    listed(SCENE)
}

/// The stage of a `.ray` text with the cursor on the first row of the list.
pub(super) fn listed<'s>(text: &str) -> Stage<'s> {
    scene("scene.ray", text).after("ggj")
}

/// The stage of a text with the cursor where it is at first.
pub(super) fn scene<'s>(name: &str, text: &str) -> Stage<'s> {
    Stage {
        opening: opening_as(name, text.to_owned()),
        begins: "",
        texts: BTreeMap::new(),
    }
}

impl<'s> Stage<'s> {
    /// The stage with another way of opening.
    pub(super) fn opened(mut self, change: impl FnOnce(&mut Opening)) -> Self {
        change(&mut self.opening);
        self
    }

    /// The stage with another text, by replacements in this one.
    #[track_caller]
    pub(super) fn but(self, words: &str) -> Self {
        let OpeningText::Known(text) = &self.opening.text else {
            panic!("the text is not known");
        };
        let text = replaced(text.clone(), words).expect("replacements");
        self.opened(|opening| opening.text = OpeningText::Known(text))
    }

    /// The stage whose sessions begin with a script.
    pub(super) fn after(mut self, script: &'s str) -> Self {
        self.begins = script;
        self
    }

    /// The stage with another text that steps and checks can name.
    pub(super) fn with(mut self, name: &'s str, text: impl Into<String>) -> Self {
        self.texts.insert(name, text.into());
        self
    }

    /// Runs a script of sessions that empty lines part.
    #[track_caller]
    pub(super) fn play(&self, script: &str) {
        for script in script.split("\n\n") {
            self.session().run(script);
        }
    }

    /// Runs a script in which each line is a session of its own; lines that begin with a bar continue
    /// the one before.
    #[track_caller]
    pub(super) fn each(&self, script: &str) {
        let mut session = None;
        for line in script.lines().map(str::trim) {
            if session.is_none()
                || !(line.is_empty() || line.starts_with('|') || line.starts_with("//"))
            {
                session = Some(self.session());
            }
            if let Some(session) = &mut session {
                session.run(line);
            }
        }
    }

    /// Runs a script for each row of a table, with its columns in place of `{1}`, `{2}` and so on.
    #[track_caller]
    pub(super) fn table(&self, script: &str, rows: &str) {
        let rows = rows.lines().map(str::trim);
        for row in rows.filter(|row| !row.is_empty() && !row.starts_with("//")) {
            let columns = row.split(" |").map(str::trim).enumerate();
            self.play(&columns.fold(script.to_owned(), |script, (at, column)| {
                script.replace(&format!("{{{}}}", at + 1), column)
            }));
        }
    }

    /// A session that has begun.
    #[track_caller]
    pub(super) fn session(&self) -> Session {
        let (app, effects) = App::open(self.opening.clone());
        let texts = self.texts.iter();
        let mut texts: BTreeMap<_, _> = texts
            .map(|(name, text)| ((*name).to_owned(), text.clone()))
            .collect();
        texts.insert("opened".to_owned(), app.shared.document.text().to_owned());
        let mut session = Session {
            app,
            effects,
            texts,
            under_way: steps::UnderWay::default(),
        };
        session.note();
        if !self.begins.is_empty() {
            session.run(self.begins);
        }
        session
    }
}

impl Session {
    /// Gives a text a name.
    pub(super) fn call(&mut self, name: &str, text: &str) {
        self.texts.insert(name.to_owned(), text.to_owned());
    }

    /// Runs the lines of a script.
    #[track_caller]
    pub(super) fn run(&mut self, script: &str) -> &mut Self {
        let lines = script.lines().map(str::trim);
        for line in lines.filter(|line| !line.is_empty() && !line.starts_with("//")) {
            if let Err(found) = self.line(line) {
                panic!("{line}\n{found}");
            }
        }
        self
    }

    /// Runs a line of a script; what is wrong.
    fn line(&mut self, line: &str) -> Result<(), String> {
        let line = format!(" {line}");
        let mut cells = line.split(" |").map(str::trim);
        if let Some(step) = cells.next().filter(|step| !step.is_empty()) {
            self.step(step)?;
        }
        for cell in cells {
            if let Some(step) = cell.strip_prefix('>') {
                self.step(step.trim())?;
                continue;
            }
            if cell == "undoes" {
                self.undoes()?;
                continue;
            }
            if let Some(text) = cell.strip_prefix("becomes ") {
                self.becomes(text)?;
                continue;
            }
            let (check, expected) = match cell.strip_prefix("not ") {
                Some(check) => (check, false),
                None => (cell, true),
            };
            let (holds, found) = self.holds(check)?;
            if holds != expected {
                return Err(format!("{cell}: {found}"));
            }
        }
        Ok(())
    }

    /// Whether there are no errors, one undo leads to the text as it was opened, and a redo back.
    fn undoes(&mut self) -> Result<(), String> {
        let (_, errors) = self.holds("errors")?;
        let changed = self.app.shared.document.shared_text();
        self.step("u")?;
        let is_undone = self.app.shared.document.text() == self.texts["opened"];
        self.step("<Ctrl-r>")?;
        let is_redone = self.app.shared.document.text() == changed.as_str();
        match (errors.as_str(), is_undone, is_redone) {
            ("", true, true) => Ok(()),
            found => Err(format!("undoes (errors, undone, redone): {found:?}")),
        }
    }

    /// Whether the text is as described after a single step, which leads to SELECT.
    fn becomes(&mut self, text: &str) -> Result<(), String> {
        for check in [format!("text {text}"), "mode SELECT".to_owned()] {
            let (holds, found) = self.holds(&check)?;
            if !holds {
                return Err(format!("{check}: {found}"));
            }
        }
        self.undoes()
    }

    /// The text that words of a script describe.
    fn text_of(&self, words: &str) -> Result<String, String> {
        let words = &self.named(words);
        let (first, rest) = words.split_once(" & ").unwrap_or((words, ""));
        if [" =>", " +>"].iter().any(|change| first.contains(change)) {
            return replaced(self.texts["opened"].clone(), words);
        }
        let text = self.text_called(first)?;
        match rest {
            "" => Ok(text),
            _ => replaced(text, rest),
        }
    }

    /// Words with texts in place of their names in braces.
    fn named(&self, words: &str) -> String {
        let texts = self.texts.iter();
        texts.fold(words.to_owned(), |words, (name, text)| {
            words.replace(&format!("{{{name}}}"), text)
        })
    }

    fn text_called(&self, name: &str) -> Result<String, String> {
        if name == "mine" {
            return Ok(self.app.shared.document.text().to_owned());
        }
        if let Some(literal) = name
            .strip_prefix('"')
            .and_then(|rest| rest.strip_suffix('"'))
        {
            return Ok(unescaped(literal));
        }
        let text = self.texts.get(name).cloned();
        text.ok_or_else(|| format!("no text is called {name}"))
    }
}

/// A text after changes such as `old => new & before +> added`.
fn replaced(text: String, words: &str) -> Result<String, String> {
    words.split(" & ").try_fold(text, |text, words| {
        let (old, new) = if let Some((before, added)) = words.split_once(" +> ") {
            (unescaped(before), unescaped(&format!("{before}{added}")))
        } else {
            let (old, new) = words.split_once(" =>").ok_or("no replacement")?;
            (
                unescaped(old),
                unescaped(new.strip_prefix(' ').unwrap_or(new)),
            )
        };
        if !text.contains(&old) {
            return Err(format!("{old:?} is not in\n{text}"));
        }
        Ok(text.replacen(&old, &new, 1))
    })
}

fn unescaped(words: &str) -> String {
    words.replace(r"\n", "\n").replace(r"\s", " ")
}

/// Whether a text reads like a pattern, in which `…` stands for anything.
fn is_like(text: &str, pattern: &str) -> bool {
    let pieces: Vec<_> = pattern.split('…').collect();
    let [first, between @ .., last] = &pieces[..] else {
        return text == pattern;
    };
    let Some(mut rest) = text.strip_prefix(first) else {
        return false;
    };
    for piece in between {
        let Some(at) = rest.find(piece) else {
            return false;
        };
        rest = &rest[at + piece.len()..];
    }
    rest.ends_with(last)
}
