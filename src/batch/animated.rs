//! The frames of a track over a scene: edits of its text, each lowered with the files read once.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::still::Still;
use super::{Error, Messages, Tracing, Warnings, load};
use assets::Edited;
use render::Frames;
use text::{Diagnostic, Findings};
use track::Bound;

/// Where an animated scene comes from, and how it is read.
pub(super) struct Origin<'w> {
    /// The scene file.
    pub(super) scene: &'w Path,
    /// The track file.
    pub(super) track: &'w Path,
    /// Additional folders that pictures and meshes may be read from.
    pub(super) folders: &'w [PathBuf],
    /// How the warnings of both files are treated.
    pub(super) warnings: Warnings,
    /// How findings in them are told.
    pub(super) messages: Messages,
}

/// A scene whose text a track changes from frame to frame.
pub(super) struct Animated<'w> {
    origin: Origin<'w>,
    track: Bound,
    /// The number of frames.
    pub(super) count: u32,
    /// Frames per second, if the track says so.
    pub(super) rate: Option<u32>,
    text: Edited,
    /// The messages of warnings that were printed.
    told: BTreeSet<String>,
}

impl<'w> Animated<'w> {
    /// Reads a track and its scene, and prints all findings in both.
    pub(super) fn new(origin: Origin<'w>) -> Result<Self, Error> {
        let text = file::read_small_text(origin.track)?;
        let (track, mut findings) = track::read(&text);
        let loaded = load(
            origin.messages,
            origin.scene,
            origin.folders,
            origin.warnings,
            None,
        );
        let scene = loaded.as_ref().ok().and_then(|loaded| {
            let scene = loaded.scene.as_ref()?;
            Some((&loaded.source, &scene.camera))
        });
        let bound = scene.map(|(source, camera)| {
            let (bound, more) = track::bind(&track, source, camera);
            findings.append(more);
            bound
        });
        let findings = origin.warnings.apply(findings.sorted());
        let messages = origin.messages;
        messages.all_findings(origin.track, &text, &findings);
        let loaded = loaded?;
        let (Some(scene), Some(bound)) = (loaded.scene, bound) else {
            let errors = loaded.findings.errors();
            return Err(Error::Invalid { errors });
        };
        if 0 < findings.errors() {
            let errors = findings.errors();
            return Err(Error::InvalidTrack { errors });
        }
        let warnings = loaded.findings.iter();
        Ok(Self {
            track: bound,
            count: track.frames,
            rate: track.rate,
            told: warnings.map(Diagnostic::message_with_file).collect(),
            text: Edited::new(
                (origin.scene, origin.folders),
                loaded.source,
                (scene, loaded.findings),
                loaded.read,
            )?,
            origin,
        })
    }

    /// A frame, ready to trace. Prints what was not found in a frame before.
    pub(super) fn still(
        &mut self,
        number: u32,
        tracing: &Tracing,
        frames: Frames,
    ) -> Result<Still, Error> {
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
        Ok(Still {
            job: tracing.job(scene, read.images.clone(), frames)?,
            scene: self.text.fingerprint(),
            files: read.files.clone(),
        })
    }

    /// Prints the findings in a frame, but no warnings that are the same as before.
    fn print_findings(&mut self, number: u32, findings: Findings) -> Result<(), Error> {
        let findings = self.origin.warnings.apply(findings);
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
        let messages = self.origin.messages;
        messages.all_findings(self.origin.scene, self.text.text(), &new);
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
    use crate::ProgressStyle;
    use geometry::{Mesh, Shape};
    use scene::{Rendering, Viewpoint};

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
            size: None,
            view: Viewpoint::default(),
            region: None,
            rendering: Rendering {
                spp: Some(1),
                ..Rendering::default()
            },
            time: None,
            seed: None,
            aov: None,
            layers: Vec::new(),
            denoise: false,
            threads: 1,
            progress: ProgressStyle::Off,
        }
    }

    fn mesh(still: &Still) -> Arc<Mesh> {
        let mut objects = still.job.scene.objects.iter();
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
        let origin = Origin {
            scene: &scene,
            track: &track,
            folders: &[],
            warnings: Warnings::Allowed,
            messages: Messages::Text,
        };
        let mut animated = Animated::new(origin).expect("it is valid");
        fs::remove_file(at("a.obj")).expect("it is there");
        let mut still = |number| {
            let still = animated.still(number, &tracing(), Frames::Last);
            still.expect("it is valid")
        };
        let [first, last] = [still(0), still(2)];
        assert!(Arc::ptr_eq(&mesh(&first), &mesh(&last)));
        assert_ne!(first.job.scene.lights, last.job.scene.lights);
        assert_ne!(first.scene, last.scene);
        assert_eq!(still(0).scene, first.scene);
    }
}
