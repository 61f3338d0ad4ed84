//! What follows once the scene is left.

use std::path::PathBuf;

use crate::text_width::file_name;
use language::Language;

/// What follows once the scene is left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AfterLeaving {
    /// The program ends.
    Quit,
    /// The scene of this file is opened, or a new one if the file does not exist.
    Open(PathBuf),
    /// A new scene without a file is started.
    New(Language),
}

impl AfterLeaving {
    /// The announcement that it will follow, up to the reason for the delay.
    pub(crate) fn announcement(&self) -> String {
        match self {
            Self::Quit => "will quit".to_owned(),
            Self::Open(path) => format!("will open {}", file_name(path)),
            Self::New(_) => "will start a new scene".to_owned(),
        }
    }
}
