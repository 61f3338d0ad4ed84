//! What pictures are compared with: a picture file, or a scene from a file or from a git repository.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::revision;
use assets::{Assets, Up, is_mesh};
use compare::{Comparison, SizesDiffer};
use image_file::Recorded;
use language::{Language, Source, errors_of_beginning};
use memory::OutOfMemory;
use render::{Frame, PictureMetadata};
use scene::{Image, Images, Scene, Size};
use text::Findings;

/// Identifies a request of the session; starts at 1 and increases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReferenceId(pub u32);

/// Where to read a reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReferenceSource {
    /// A scene file by its extension, otherwise a picture file.
    File(PathBuf),
    /// The file of a scene in a revision of its git repository.
    Revision(String, PathBuf),
}

/// A reference that was read.
#[derive(Clone, Debug)]
pub enum ReferenceRead {
    /// A picture, and how it was made.
    Picture(Arc<Frame>, Made),
    /// A scene, which is still to be traced, and the images of its textures.
    Scene(Arc<Scene>, Images),
}

/// How the picture of a file was made.
#[derive(Clone, Debug, Default)]
pub struct Made {
    /// What the file says of it; `None` if it says nothing.
    pub record: Option<Box<PictureMetadata>>,
    /// Whether the file holds light without a transfer curve, as [`Recorded::holds_light`] says.
    pub holds_light: bool,
}

/// Two pictures to compare.
#[derive(Clone, Debug)]
pub struct Pair {
    /// The present picture.
    pub live: Arc<Frame>,
    /// What it is compared with.
    pub reference: Arc<Frame>,
}

impl Pair {
    /// Whether both have the same pixels and progress, because they are the same frames.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.live, &other.live) && Arc::ptr_eq(&self.reference, &other.reference)
    }

    /// The size of both, if it is the same.
    pub fn size(&self) -> Option<Size> {
        (self.live.size == self.reference.size).then_some(self.live.size)
    }

    /// Measures the difference; the present picture is the first of the two.
    pub(crate) fn compare(&self) -> Result<Comparison, SizesDiffer> {
        let image = |frame: &Frame| Image::new(frame.size, frame.pixels.clone());
        let sizes = SizesDiffer([self.live.size, self.reference.size]);
        let images = image(&self.live).zip(image(&self.reference));
        let (live, reference) = images.ok_or(sizes)?;
        Comparison::of(&live, &reference, 0)
    }
}

impl ReferenceSource {
    /// Reads the reference, a mesh with this upward axis; the error says why it cannot be read.
    pub(crate) fn read(
        &self,
        assets: &mut Assets,
        up: Option<Up>,
    ) -> Result<ReferenceRead, String> {
        match self {
            Self::File(path) if is_mesh(path) => {
                file::open(path).map_err(|error| error.to_string())?;
                let made = assets.scene_of_mesh(path, up);
                scene(&made.path, Language::Xml, made.text, assets)
            }
            Self::File(path) => match Language::of_path(path) {
                Ok(language) => {
                    let beginning =
                        file::read_beginning(path).map_err(|error| error.to_string())?;
                    beginning.map_or(Ok(()), |text| check_beginning(path, language, &text))?;
                    let text = file::read_text(path).map_err(|error| error.to_string())?;
                    scene(path, language, text, assets)
                }
                Err(_) => picture(path),
            },
            Self::Revision(revision, path) => {
                let language = Language::of_path(path).map_err(|error| error.to_string())?;
                let sound = |beginning: &str| check_beginning(path, language, beginning);
                let text = revision::text_in(revision, path, sound)?;
                scene(path, language, text, assets)
            }
        }
    }
}

fn picture(path: &Path) -> Result<ReferenceRead, String> {
    let mut file = file::open(path).map_err(|error| error.to_string())?;
    let read = Recorded::read(&mut file).map_err(|error| format!("{} {error}", path.display()))?;
    let frame = Frame::drawn(read.image.size(), read.image.pixels().to_vec());
    let made = Made {
        record: read.record.map(Box::new),
        holds_light: read.holds_light,
    };
    Ok(ReferenceRead::Picture(Arc::new(frame), made))
}

fn scene(
    path: &Path,
    language: Language,
    text: String,
    assets: &mut Assets,
) -> Result<ReferenceRead, String> {
    let name = path.display();
    let no_memory = |reason: OutOfMemory| format!("{name}: {reason}");
    language::fits(language, &text, 0).map_err(no_memory)?;
    let mut source = Source::new(language, Arc::new(text));
    let (lowered, loaded) = assets.lower(path, &mut source).map_err(no_memory)?;
    let faults = || faults(path, source.text(), &lowered.diagnostics);
    let scene = lowered.scene.ok_or_else(faults)?;
    Ok(ReferenceRead::Scene(Arc::new(scene), loaded.images))
}

/// Fails if the beginning of a long scene has errors that nothing behind it can correct.
fn check_beginning(path: &Path, language: Language, text: &str) -> Result<(), String> {
    let findings = errors_of_beginning(language, text);
    match findings.errors() {
        0 => Ok(()),
        _ => Err(faults(path, text, &findings)),
    }
}

fn faults(path: &Path, text: &str, findings: &Findings) -> String {
    format!("{} has {}", path.display(), findings.errors_in(text))
}
