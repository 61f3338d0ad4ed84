//! What the program keeps or is given beside scenes: tracks, configurations, parts, and what a picture
//! says that it is made from.

use std::io::{Cursor, Write};
use std::sync::Arc;

use halflight::image_file;
use halflight::language::{Language, Source};
use halflight::render::Frames;
use halflight::scene::Meshes;
use halflight::shards;
use halflight::text::Diagnostic;
use halflight::{config, track};
use tempfile::NamedTempFile;

/// A scene that tracks can move.
const SCENE: &str = "<xml><scene><object type='sphere' name='a' material='m'><scale value='2'/>\
    <translate x='1'/></object><material type='blinn' name='m'><diffuse r='1'/></material>\
    <light type='point' name='l'><position z='5'/></light></scene><camera><fov value='40'/></camera></xml>";

/// Reads a track, relates it to a scene and shows its frames.
pub fn track(input: &[u8]) {
    let text = String::from_utf8_lossy(input);
    let (track, findings) = track::read(&text);
    for found in findings.iter() {
        check(&text, found);
    }
    let mut source = Source::new(Language::Xml, Arc::new(SCENE.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = lowered.scene.expect("the scene is valid");
    let (bound, findings) = track::bind(&track, &source, &scene.camera);
    for found in findings.iter() {
        check(&text, found);
    }
    for frame in [0, 1, track.frames / 2, track.frames.saturating_sub(1)] {
        for edit in bound.edits(&source, frame) {
            assert!(SCENE.get(edit.span.start()..edit.span.end()).is_some());
        }
    }
}

/// Reads a configuration.
pub fn config(input: &[u8]) {
    let text = String::from_utf8_lossy(input);
    if let Err(errors) = config::read(&text) {
        assert!(!errors.is_empty());
        for error in &errors {
            check(&text, error);
        }
    }
}

/// Merges a part with itself: what it declares is not believed.
pub fn part(input: &[u8]) {
    let mut file = NamedTempFile::new().expect("there is a temporary folder");
    file.write_all(input).expect("the file can be written");
    let paths = [file.path().to_path_buf()];
    if let Err(error) = shards::merge(&paths, Frames::Last) {
        assert!(!error.to_string().is_empty());
    }
}

/// Reads what a picture is made from, and writes it again.
pub fn record(input: &[u8]) {
    if let Ok(Some(made_from)) = image_file::record(&mut Cursor::new(input)) {
        assert!(!made_from.entries().is_empty() || made_from.unused().is_some());
    }
}

fn check(text: &str, found: &Diagnostic) {
    assert!(
        text.get(found.span.start()..found.span.end()).is_some(),
        "{found:?}"
    );
    assert!(!found.message.is_empty());
}
