//! The frames of a track over a scene: edits of its text, each lowered with the files read once.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::shot::Shot;
use crate::{Error, Messages, Reading, Tracing, Warnings};
use assets::Edited;
use render::Frames;
use text::{Diagnostic, Findings};
use track::Bound;

/// A scene whose text a track changes from frame to frame.
pub(super) struct Animated {
    /// The scene file.
    path: PathBuf,
    /// How findings in a frame are treated, and told.
    warnings: Warnings,
    messages: Messages,
    track: Bound,
    /// The number of frames.
    pub(super) count: u32,
    /// Frames per second, if the track says so.
    pub(super) rate: Option<u32>,
    text: Edited,
    /// The messages of warnings that were printed.
    told: BTreeSet<String>,
}

impl Animated {
    /// Reads a scene and a track over it, and prints all findings in both.
    pub(super) fn new(
        [path, track_path]: [&Path; 2],
        reading: &Reading,
        messages: Messages,
    ) -> Result<Self, Error> {
        let text = file::read_small_text(track_path)?;
        let (track, mut findings) = track::read(&text);
        let loaded = reading.load(messages, path, None);
        let scene = loaded.as_ref().ok().and_then(|loaded| {
            let scene = loaded.scene.as_ref()?;
            Some((&loaded.source, &scene.camera))
        });
        let bound = scene.map(|(source, camera)| {
            let (bound, more) = track::bind(&track, source, camera);
            findings.append(more);
            bound
        });
        let findings = reading.warnings.apply(findings.sorted());
        messages.all_findings(track_path, &text, &findings);
        let mut loaded = loaded?;
        let scene = loaded.take_scene()?;
        let errors = findings.errors();
        let bound = bound.filter(|_| errors == 0);
        let bound = bound.ok_or(Error::InvalidTrack { errors })?;
        let warnings = loaded.findings.iter();
        Ok(Self {
            track: bound,
            count: track.frames,
            rate: track.rate,
            told: warnings.map(Diagnostic::message_with_file).collect(),
            text: Edited::new(
                (path, &reading.assets),
                loaded.source,
                (scene, loaded.findings),
                loaded.read,
            )?,
            path: path.to_owned(),
            warnings: reading.warnings,
            messages,
        })
    }

    /// A frame, ready to trace. Prints what was not found in a frame before.
    pub(super) fn shot(
        &mut self,
        number: u32,
        tracing: &Tracing,
        frames: Frames,
    ) -> Result<Shot, Error> {
        let edits = self.track.edits(self.text.plain(), number);
        let lowered = self.text.lower(&edits)?;
        self.print_findings(number, lowered.diagnostics)?;
        let scene = lowered.scene.ok_or(Error::Invalid { errors: 1 })?;
        let read = self.text.read();
        if !read.is_whole() {
            return Err(Error::Incomplete {
                needed_by: "a sequence needs",
            });
        }
        Ok(Shot {
            still: tracing.still(scene, read.images.clone(), frames)?,
            digest: self.text.fingerprint(),
            files: read.files.clone(),
        })
    }

    /// Prints the findings in a frame, but no warnings that are the same as before.
    fn print_findings(&mut self, number: u32, findings: Findings) -> Result<(), Error> {
        let findings = self.warnings.apply(findings);
        let mut new = Findings::default();
        for found in findings.iter() {
            if found.is_error() || self.told.insert(found.message_with_file()) {
                let message = format!("frame {number}: {}", found.message);
                let found = Diagnostic {
                    message,
                    ..found.clone()
                };
                if found.is_error() {
                    new.error(|| found);
                } else {
                    new.warning(|| found);
                }
            }
        }
        self.messages
            .all_findings(&self.path, self.text.text(), &new);
        match findings.errors() {
            0 => Ok(()),
            errors => Err(Error::Invalid { errors }),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::sync::Arc;

    use super::*;
    use geometry::{Mesh, Shape};
    use scene::Rendering;

    const SCENE: &str = "\
<xml><scene><object type=\"obj\" name=\"a.obj\"/><object type=\"sphere\" name=\"ball\"/>
<light type=\"point\" name=\"key\"/></scene><camera><position z=\"9\"/></camera></xml>";

    const TRACK: &str = "\
frames = 3
[[track]]
thing = 'key'
field = 'intensity'
keys = [{ frame = 0, value = [0, 0, 0] }, { frame = 2, value = [1, 1, 1] }]";

    const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    fn tracing() -> Tracing {
        Tracing {
            rendering: Rendering {
                spp: Some(1),
                ..Rendering::default()
            },
            ..Tracing::of_scene()
        }
    }

    fn mesh(shot: &Shot) -> Arc<Mesh> {
        let mut objects = shot.still.job.scene.objects.iter();
        let mesh = objects.find_map(|object| match &object.shape {
            Shape::Mesh(instance) => Some(Arc::clone(instance.mesh())),
            _ => None,
        });
        mesh.expect("the scene has a mesh")
    }

    /// The renderer keeps the structure of a mesh that is the same value.
    #[test]
    fn the_files_of_a_scene_are_read_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for (name, text) in [("a.xml", SCENE), ("a.toml", TRACK), ("a.obj", MESH)] {
            fs::write(at(name), text).expect("written");
        }
        let (scene, track) = (at("a.xml"), at("a.toml"));
        let reading = Reading::default();
        let animated = Animated::new([&scene, &track], &reading, Messages::Text);
        let mut animated = animated.expect("it is valid");
        fs::remove_file(at("a.obj")).expect("it is there");
        let mut shot = |number| {
            let shot = animated.shot(number, &tracing(), Frames::Last);
            shot.expect("it is valid")
        };
        let [first, last] = [shot(0), shot(2)];
        assert!(Arc::ptr_eq(&mesh(&first), &mesh(&last)));
        let [one, other] = [&first, &last].map(|shot| &shot.still.job.scene.lights);
        assert_ne!(one, other);
        assert_ne!(first.digest, last.digest);
        assert_eq!(shot(0).digest, first.digest);
    }
}
