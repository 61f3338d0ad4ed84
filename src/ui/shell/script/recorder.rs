//! Recordings of the screen as animations, beside an editor's pane if the script has opened one.

use std::io;
use std::path::{Path, PathBuf};

use ratatui::buffer::Buffer;

use super::editor_pane::EditorPane;
use crate::shell::snapshot;
use crate::theme::Theme;
use render::Frame;

/// How long a screen of a recording is shown, in hundredths of a second.
const SHOWN: u32 = 25;

/// What a script does to the editor's pane.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum PaneStep {
    /// Opens a file.
    Open(PathBuf),
    /// Selects the next place of a text.
    Find(String),
    /// Replaces what is selected.
    Type(String),
    /// Saves the file.
    Save,
}

/// The recordings of a script, by their files, and the editor's pane.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    pane: Option<EditorPane>,
    /// Each picture with how long it is shown.
    recordings: Vec<(PathBuf, Vec<(Frame, u32)>)>,
}

impl Recorder {
    /// Performs a step in the editor's pane.
    pub(crate) fn edit(&mut self, step: &PaneStep) -> io::Result<()> {
        if let PaneStep::Open(path) = step {
            self.pane = Some(EditorPane::open(path)?);
            return Ok(());
        }
        let pane = self.pane.as_mut();
        let pane = pane.ok_or_else(|| io::Error::other("editor-open FILE comes first"))?;
        match step {
            PaneStep::Open(_) => Ok(()),
            PaneStep::Find(text) => pane.find(text),
            PaneStep::Type(text) => {
                pane.type_text(text);
                Ok(())
            }
            PaneStep::Save => pane.save(),
        }
    }

    /// Adds the screen to the recording of this name.
    pub(crate) fn add(&mut self, path: &Path, screen: &Buffer, theme: Theme) {
        let frame = match &mut self.pane {
            Some(pane) => snapshot::drawn(&pane.beside(screen), theme),
            None => snapshot::drawn(screen, theme),
        };
        let at = self.recordings.iter().position(|(name, _)| name == path);
        let at = at.unwrap_or_else(|| {
            self.recordings.push((path.to_owned(), Vec::new()));
            self.recordings.len() - 1
        });
        let frames = &mut self.recordings[at].1;
        match frames.last_mut() {
            Some((last, shown)) if last.pixels == frame.pixels => *shown += SHOWN,
            _ => frames.push((frame, SHOWN)),
        }
    }

    /// Writes the recordings; fails with the file that could not be written.
    pub(crate) fn finish(self) -> Result<(), (PathBuf, io::Error)> {
        for (path, frames) in self.recordings {
            let frames = || frames.iter().map(|(frame, shown)| (frame, *shown));
            let written = file::deliver(
                &path,
                &mut |out| image_file::write_animation(frames(), out),
                &|| Ok::<(), io::Error>(()),
            );
            written.map_err(|error| (path.clone(), error))?;
        }
        Ok(())
    }
}
