//! The measured scenes and their targets.

use std::path::{Path, PathBuf};

use halflight::language::Language;
use halflight::scene::Size;

use crate::setting::SCRATCH;
use crate::{meshes, scenes};

/// The target of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    Nothing,
    /// At most this fraction of the best peer's time.
    Ratio(f64),
}

/// A scene, how it is traced, and its targets.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// The name in the table.
    pub(crate) name: String,
    /// The scene file in one of our languages.
    pub(crate) scene: PathBuf,
    /// The path of the peers' scene files without extension, if any.
    pub(crate) stem: Option<PathBuf>,
    /// Samples per pixel.
    pub(crate) spp: u32,
    /// The maximum depth; the default if `None`.
    pub(crate) depth: Option<u32>,
    /// The target of the whole process.
    pub(crate) target: Target,
    /// The target of the tracing alone, compared with peers that report theirs.
    pub(crate) frame_target: Target,
    /// The target of a small first picture.
    pub(crate) first_target: Target,
}

/// A picture to be rendered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) size: Size,
    pub(crate) spp: u32,
}

impl Case {
    /// The picture of the given size.
    pub(crate) fn picture(&self, size: Size) -> Picture {
        Picture {
            size,
            spp: self.spp,
        }
    }

    /// A scene without targets.
    pub(crate) fn plain(name: &str, scene: PathBuf) -> Self {
        Self {
            name: name.to_owned(),
            scene,
            stem: None,
            spp: 1,
            depth: None,
            target: Target::Nothing,
            frame_target: Target::Nothing,
            first_target: Target::Nothing,
        }
    }
}

/// A minimal scene, three spheres, whose memory is subtracted.
pub(crate) fn bare() -> Case {
    Case::plain("bare", own_folder().join("spheres.xml"))
}

/// All scenes: S1 to S5 from a folder, or generated substitutes, then the project's own.
pub(crate) fn all(folder: Option<&Path>) -> Vec<Case> {
    let mut cases = match folder {
        Some(folder) => of_folder(folder),
        None => generated(),
    };
    let entries = std::fs::read_dir(own_folder()).expect("the project has scenes");
    let mut own: Vec<_> = entries
        .map(|entry| entry.expect("a scene").path())
        .filter(|path| Language::of_path(path).is_ok())
        .collect();
    own.sort();
    cases.extend(own.into_iter().map(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Case::plain(&name, path.clone())
    }));
    cases
}

/// The scenes of the folder with the peers' files, with targets relative to the best peer.
fn of_folder(folder: &Path) -> Vec<Case> {
    let cases = [
        ("S1", "s1", "ray", 1, 5, Target::Ratio(0.45)),
        ("S1, 16 spp", "s1", "ray", 16, 5, Target::Ratio(0.4)),
        ("S2", "s2", "ray", 1, 4, Target::Ratio(0.65)),
        ("S2b", "s2b", "ray", 1, 4, Target::Ratio(0.75)),
        ("S3", "s3", "ray", 1, 0, Target::Ratio(0.45)),
        ("S4", "s4", "xml", 1, 0, Target::Ratio(1.0)),
        ("S5", "s5", "bu.dat", 1, 3, Target::Ratio(0.1)),
    ];
    let cases = cases.map(|(name, stem, extension, spp, depth, target)| Case {
        stem: Some(folder.join(stem)),
        spp,
        depth: Some(depth),
        target,
        frame_target: match name {
            "S4" => Target::Ratio(1.0),
            _ => Target::Nothing,
        },
        first_target: match name {
            "S1" => Target::Ratio(0.5),
            "S2" => Target::Ratio(0.6),
            "S3" => Target::Ratio(0.35),
            _ => Target::Nothing,
        },
        ..Case::plain(name, folder.join(format!("{stem}.{extension}")))
    });
    cases
        .into_iter()
        .filter(|case| case.scene.exists())
        .collect()
}

/// Generated scenes similar to those of the folder.
fn generated() -> Vec<Case> {
    let write = |name: &str, text: &str| {
        let path = Path::new(SCRATCH).join(name);
        std::fs::write(&path, text).expect("the scratch folder is writable");
        path
    };
    let texts = [
        ("S2", "flake4.ray", scenes::sphereflake(4), 4),
        ("S2b", "flake5.ray", scenes::sphereflake(5), 4),
        ("S3", "million.ray", scenes::random_spheres(1_000_000, 1), 0),
        ("S4", "ball.xml", meshes::BALL_SCENE.to_owned(), 0),
        ("S5", "sets.dat", scenes::set_operations(200), 3),
    ];
    write("ball.obj", &meshes::bumpy_ball(1_000_000));
    let cases = texts.map(|(name, file, text, depth)| Case {
        depth: Some(depth),
        ..Case::plain(&format!("{name}, generated"), write(file, &text))
    });
    cases.into()
}

fn own_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}
