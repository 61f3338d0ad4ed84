//! Tracks: values over frames, written in TOML. A track sets fields of a scene, named as the interface
//! names them, and the camera, at some frames; between these the values are interpolated.
//!
//! A [`Track`] is what its file says, [`bind()`] relates it to a scene's text, and a [`Bound`] track makes
//! the edits of that text that show a frame. So a frame is a scene like any other. Values are also keyed
//! in the track's own text. Knows no files, and not how frames are rendered or shown.

mod bind;
mod camera;
mod easing;
mod field;
mod keying;
mod keys;
mod read;
mod table;
#[cfg(test)]
mod tests;
mod thing;
mod written;

use std::collections::BTreeSet;

use text::Span;

pub use bind::{Bound, bind};
pub use camera::{CameraTrack, Movement, Parameter};
pub use easing::Easing;
pub use keying::{BEGUN, Keyed, key_camera, key_field};
pub use keys::{Key, Keys, Value};
pub use read::{MAX_FRAMES, RATES, read};
pub use written::Unkeyed;

/// The content of a track file. Frames are numbered from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// The number of frames.
    pub frames: u32,
    /// Frames per second, if the file says so.
    pub rate: Option<u32>,
    /// The fields that it sets.
    pub fields: Vec<FieldTrack>,
    /// How it moves the camera.
    pub camera: Option<CameraTrack>,
}

/// The values of a field over the frames.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldTrack {
    /// The name of what has the field: `light 1`.
    pub thing: Named,
    /// The name of the field, and of its component if only that is set: `position y`.
    pub field: Named,
    /// Its values.
    pub keys: Keys,
}

impl Track {
    /// The names of what it sets, each with the frames that have keys, ascending.
    pub fn rows(&self) -> impl Iterator<Item = (String, Vec<u32>)> {
        let frames = |keys: &Keys| keys.iter().map(|key| key.frame).collect();
        let camera = self.camera.iter().map(|camera| {
            let keys = camera.parameters.iter().flat_map(|(_, keys)| keys.iter());
            let frames: BTreeSet<u32> = keys.map(|key| key.frame).collect();
            ("camera".to_owned(), frames.into_iter().collect())
        });
        let fields = self.fields.iter().map(move |track| {
            let name = format!("{} {}", track.thing.name, track.field.name);
            (name, frames(&track.keys))
        });
        camera.chain(fields)
    }
}

/// A name with its place in the track file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// The name.
    pub name: String,
    /// Its place.
    pub span: Span,
}
