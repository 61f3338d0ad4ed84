//! What follows once the scene is left.

use std::path::PathBuf;

use crate::text_width::file_name;
use language::Language;

/// A scene that the program carries, to be opened as one without a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CarriedScene {
    /// What it is called in questions.
    pub name: &'static str,
    /// The language of its text.
    pub language: Language,
    /// Its text.
    pub text: &'static str,
}

/// What follows once the scene is left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AfterLeaving {
    /// The program ends.
    Quit,
    /// The scene of this file is opened, or a new one if the file does not exist.
    Open(PathBuf),
    /// A new scene without a file is started.
    New(Language),
    /// A copy of a scene that the program carries is opened.
    Carried(CarriedScene),
    /// The editor is opened on the saved scene, which is left for it alone.
    Editor,
}

impl AfterLeaving {
    /// The announcement that it will follow, up to the reason for the delay.
    pub(crate) fn announcement(&self) -> String {
        match self {
            Self::Quit => "will quit".to_owned(),
            Self::Open(path) => format!("will open {}", file_name(path)),
            Self::New(_) => "will start a new scene".to_owned(),
            Self::Carried(carried) => format!("will open {}", carried.name),
            Self::Editor => "will open the editor".to_owned(),
        }
    }
}
