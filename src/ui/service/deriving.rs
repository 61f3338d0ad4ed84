//! The thread that derives scenes from texts of the history.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::answering::Answering;
use crate::history_scene::{HistoryScene, HistoryText, NoPicture};
use crate::msg::Msg;
use assets::{Assets, Wanted};
use language::Source;
use memory::OutOfMemory;

/// Starts the thread, which may read files of scenes in `folders` and calls `send`. Nothing waits for its
/// end, as it has no work that could be lost.
pub(crate) fn history_scenes(
    folders: &[PathBuf],
    send: impl Fn(Msg) + Send + 'static,
) -> io::Result<Answering<HistoryText>> {
    let folders = folders.to_vec();
    let answer = move |text: HistoryText| {
        // Files of other texts are rarely named twice, and may be large.
        let derived = derive(&text, &mut Assets::new(&folders));
        let derived = derived.unwrap_or_else(|refused| Err(NoPicture::Failed(refused.to_string())));
        send(Msg::Derived(text.ticket, derived));
    };
    Answering::latest("history", "derives earlier scenes", answer)
}

/// The scene of a text of the history. Files that the present text names as well are not read again.
fn derive(
    past: &HistoryText,
    assets: &mut Assets,
) -> Result<Result<HistoryScene, NoPicture>, OutOfMemory> {
    let language = past.timeline.language;
    let text = past.timeline.text(past.at);
    language::fits(language, &text, 0)?;
    let mut source = Source::new(language, text);
    let mut files = past.files.clone();
    let mut lowered = source.lower(&files.meshes)?;
    // Meshes that are read may name pictures in turn.
    for _ in 0..2 {
        let names = source.files();
        let scene = past.scene.as_deref().filter(|_| !names.is_empty());
        let Some(wanted) = scene.map(|scene| Wanted::new(scene, &names)) else {
            break;
        };
        let known = files.names.as_ref();
        if known.is_some_and(|known| wanted.is_among(known)) {
            break;
        }
        let loaded = assets.read(&wanted);
        (files.images, files.meshes) = (loaded.images, loaded.meshes);
        files.names = Some(wanted);
        lowered = source.lower(&files.meshes)?;
    }
    Ok(match lowered.scene {
        Some(scene) => Ok(HistoryScene {
            scene: Arc::new(scene),
            images: files.images,
        }),
        None => Err(NoPicture::Errors),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history_scene::KnownFiles;
    use document::Document;
    use language::{Language, Node};
    use text::{Edit, Span};

    fn derived(document: &Document, at: usize) -> Result<HistoryScene, NoPicture> {
        let past = HistoryText {
            ticket: 1,
            timeline: document.timeline(),
            at,
            scene: None,
            files: KnownFiles::default(),
        };
        derive(&past, &mut Assets::new(&[])).expect("there is memory")
    }

    #[test]
    fn the_scene_is_that_of_the_text_at_its_step() {
        let text = Language::Ray.template().to_owned();
        let mut document = Document::new(Language::Ray, text);
        let meshes = scene::Meshes::default();
        document.lower(&meshes).expect("there is memory");
        let removed = document.source().removal(&[Node::Object(0)]);
        document.edit(&removed.expect("it can be deleted"));
        document.edit(&[Edit {
            span: Span::at(0),
            text: "broken ".to_owned(),
        }]);
        document.undo();
        let objects = |at| derived(&document, at).map(|past| past.scene.objects.len());
        let first = objects(0).expect("it is valid");
        assert_eq!(objects(1), Ok(first - 1));
        assert_eq!(objects(2), Err(NoPicture::Errors));
        assert_eq!(document.present(), 1, "the document stays where it is");
    }
}
