//! The scenes that are measured, and what is asked of them.

use std::path::{Path, PathBuf};

use halflight::language::Language;
use halflight::scene::Size;

use crate::SCRATCH;
use crate::table::Wanted;
use crate::{meshes, scenes};

/// A scene and how it is traced.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// What it is called in the table.
    pub(crate) name: String,
    /// In our language.
    pub(crate) scene: PathBuf,
    /// What peers' files of it begin with, their folder included; none if there are none.
    pub(crate) stem: Option<PathBuf>,
    /// Samples a pixel.
    pub(crate) spp: u32,
    /// Bounces; the default if `None`.
    pub(crate) depth: Option<u32>,
    /// What its picture is to reach.
    pub(crate) wanted: Wanted,
    /// What its tracing alone is to reach, where peers tell theirs.
    pub(crate) frame_wanted: Wanted,
    /// What a small first picture is to reach.
    pub(crate) first_wanted: Wanted,
}

/// What is asked of a program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) size: Size,
    pub(crate) spp: u32,
}

impl Case {
    /// The picture of so many pixels.
    pub(crate) fn picture(&self, size: Size) -> Picture {
        Picture {
            size,
            spp: self.spp,
        }
    }

    /// A scene of which nothing is asked.
    pub(crate) fn plain(name: &str, scene: PathBuf) -> Self {
        Self {
            name: name.to_owned(),
            scene,
            stem: None,
            spp: 1,
            depth: None,
            wanted: Wanted::Nothing,
            frame_wanted: Wanted::Nothing,
            first_wanted: Wanted::Nothing,
        }
    }
}

/// Next to nothing: three spheres of the project's own.
pub(crate) fn bare() -> Case {
    Case::plain("bare", own_folder().join("spheres.xml"))
}

/// All scenes: S1 to S5 from a folder, or what stands in for them, then the project's own.
pub(crate) fn all(folder: Option<&Path>) -> Vec<Case> {
    let mut cases = match folder {
        Some(folder) => of_folder(folder),
        None => made_up(),
    };
    let entries = std::fs::read_dir(own_folder()).expect("the scenes are there");
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

/// The scenes of the folder with peers' files, and what is to be reached beside the best peer.
fn of_folder(folder: &Path) -> Vec<Case> {
    let cases = [
        ("S1", "s1", "ray", 1, 5, Wanted::Ratio(0.5)),
        ("S1, 16 spp", "s1", "ray", 16, 5, Wanted::Ratio(0.5)),
        ("S2", "s2", "ray", 1, 4, Wanted::Ratio(0.8)),
        ("S2b", "s2b", "ray", 1, 4, Wanted::Ratio(0.8)),
        ("S3", "s3", "ray", 1, 0, Wanted::Ratio(0.6)),
        ("S4", "s4", "xml", 1, 0, Wanted::Milliseconds(600.0)),
        ("S5", "s5", "bu.dat", 1, 3, Wanted::Ratio(0.1)),
    ];
    let cases = cases.map(|(name, stem, extension, spp, depth, wanted)| Case {
        stem: Some(folder.join(stem)),
        spp,
        depth: Some(depth),
        wanted,
        // The mesh of the reference is a binary file: what can be compared is the tracing.
        frame_wanted: match name {
            "S4" => Wanted::Ratio(1.0),
            _ => Wanted::Nothing,
        },
        first_wanted: match name {
            "S1" => Wanted::Milliseconds(12.0),
            "S2" => Wanted::Milliseconds(15.0),
            _ => Wanted::Nothing,
        },
        ..Case::plain(name, folder.join(format!("{stem}.{extension}")))
    });
    cases
        .into_iter()
        .filter(|case| case.scene.exists())
        .collect()
}

/// Scenes like those of the folder.
fn made_up() -> Vec<Case> {
    let write = |name: &str, text: &str| {
        let path = Path::new(SCRATCH).join(name);
        std::fs::write(&path, text).expect("the scratch folder takes a file");
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
        ..Case::plain(&format!("{name}, made up"), write(file, &text))
    });
    cases.into()
}

fn own_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}
