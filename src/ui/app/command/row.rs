//! A command: its spelling, when it runs, and what it does with its arguments.

use std::path::PathBuf;

use crate::app::{App, Shared};
use crate::matching::Searched;
use crate::msg::Effect;

/// A command: one row.
pub(crate) struct CommandRow {
    /// One or two words, and alternative spellings.
    pub(crate) names: &'static [&'static str],
    pub(crate) arguments: Arguments,
    /// Description for the help.
    pub(crate) words: &'static str,
    /// Everyday words that find it too.
    pub(crate) synonyms: &'static str,
    /// The name of the keys that do the same.
    pub(crate) key: Option<&'static str>,
    pub(crate) runs: Runs,
}

/// The arguments of a command, and what it does with them.
pub(crate) enum Arguments {
    Nothing(fn() -> Run),
    File(fn(Option<PathBuf>) -> Run),
    Name(fn(Option<String>) -> Run),
    /// How they are spelled, and what reads them; the error says what is expected.
    Said(&'static str, fn(&str) -> Result<Run, String>),
    /// The same, of a command whose arguments begin with a file name.
    FileAnd(&'static str, fn(&str) -> Result<Run, String>),
}

/// When a command runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Runs {
    /// Not while something is transformed or a scene is being opened, and outside of SEQUENCE.
    OnText,
    /// In SEQUENCE as well.
    OnTrack,
    /// While a scene is being opened as well.
    WhileOpening,
    /// Always.
    Always,
}

/// What a command line does.
pub(crate) struct Run(pub(crate) Box<Step>);

type Step = dyn FnOnce(&mut App) -> Vec<Effect>;

impl Run {
    pub(crate) fn does(step: impl FnOnce(&mut Shared) + 'static) -> Self {
        Self::requests(|shared| {
            step(shared);
            Vec::new()
        })
    }

    pub(crate) fn requests(step: impl FnOnce(&mut Shared) -> Vec<Effect> + 'static) -> Self {
        Self::within(|app| step(&mut app.shared))
    }

    /// A step that needs a mode's own state.
    pub(crate) fn within(step: impl FnOnce(&mut App) -> Vec<Effect> + 'static) -> Self {
        Self(Box::new(step))
    }
}

impl CommandRow {
    pub(crate) const fn new(
        names: &'static [&'static str],
        arguments: Arguments,
        words: &'static str,
    ) -> Self {
        Self {
            names,
            arguments,
            words,
            synonyms: "",
            key: None,
            runs: Runs::OnText,
        }
    }

    /// Lets these everyday words find it too.
    pub(crate) const fn also(mut self, synonyms: &'static str) -> Self {
        self.synonyms = synonyms;
        self
    }

    /// Keys with this name do the same.
    pub(crate) const fn key(mut self, name: &'static str) -> Self {
        self.key = Some(name);
        self
    }

    pub(crate) const fn runs(mut self, runs: Runs) -> Self {
        self.runs = runs;
        self
    }

    /// The first of its names, by which it is listed.
    pub(crate) fn name(&self) -> &'static str {
        self.names[0]
    }

    /// What it says of itself to those who search.
    pub(crate) const fn searched(&self) -> Searched<'static> {
        Searched {
            // As keys are called by what they do.
            name: self.words,
            others: self.names,
            words: "",
            synonyms: self.synonyms,
            topic: "",
        }
    }

    /// Whether its arguments begin with a file name.
    pub(crate) fn takes_file(&self) -> bool {
        matches!(self.arguments, Arguments::File(_) | Arguments::FileAnd(..))
    }

    /// The spelling with arguments: `:size WxH`.
    pub(crate) fn usage(&self) -> String {
        let name = self.name();
        let arguments = match self.arguments {
            Arguments::Nothing(_) => "",
            Arguments::File(_) => " [FILE]",
            Arguments::Name(_) => " [NAME]",
            Arguments::Said(usage, _) | Arguments::FileAnd(usage, _) => usage,
        };
        format!(":{name}{arguments}")
    }

    /// Parses the arguments; the error says what is expected.
    pub(crate) fn parse(&self, rest: &str) -> Result<Run, String> {
        let name = self.name();
        match self.arguments {
            Arguments::Nothing(run) if rest.is_empty() => Ok(run()),
            Arguments::Nothing(_) => Err(format!("{name} takes no arguments")),
            Arguments::File(run) => Ok(run((!rest.is_empty()).then(|| PathBuf::from(rest)))),
            Arguments::Name(run) => Ok(run((!rest.is_empty()).then(|| rest.to_owned()))),
            Arguments::Said(_, parse) | Arguments::FileAnd(_, parse) => parse(rest),
        }
    }
}
