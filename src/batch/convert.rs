//! Converts a scene to another language.

use std::path::{Path, PathBuf};

use super::output::Output;
use super::{Error, Loaded, Warnings, load, print_all_findings, print_error, print_message};
use crate::assets;
use crate::file;
use crate::language::{self, Converted, Language};
use crate::memory;

/// A scene to convert.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Convert {
    /// The scene file.
    pub scene: PathBuf,
    /// The language of the new text.
    pub to: Language,
    /// Where the new text goes.
    pub output: Output,
    /// How warnings of the scene and losses are treated.
    pub warnings: Warnings,
    /// Additional folders that pictures and meshes may be read from.
    pub assets: Vec<PathBuf>,
}

/// Converts a scene and prints what it loses.
pub fn convert(work: &Convert) -> Result<(), Error> {
    try_convert(work).inspect_err(print_error)
}

fn try_convert(work: &Convert) -> Result<(), Error> {
    work.output.check_spares(&work.scene, &[])?;
    work.output.check()?;
    assets::check_folders(&work.assets)?;
    memory::start_threads_or_none();
    let loaded = load(&work.scene, &work.assets, work.warnings)?;
    let scene = loaded.scene.as_ref().ok_or_else(|| Error::Unconverted {
        errors: loaded.findings.errors(),
    })?;
    work.output.check_spares(&work.scene, &loaded.read.files)?;
    let Converted { text, losses } = language::convert(&loaded.source, scene, work.to)
        .map_err(|reason| Error::Refused(reason.to_string()))?;
    let losses = work.warnings.apply(losses);
    print_all_findings(&work.scene, loaded.source.text(), &losses);
    match losses.errors() {
        0 => {}
        errors => return Err(Error::Unconverted { errors }),
    }
    work.output.write(|out| out.write_all(text.as_bytes()))?;
    if let Output::File(path) = &work.output {
        note_folder(work, path, &loaded);
    }
    Ok(())
}

/// Says that the files a scene names may not be found from another folder.
fn note_folder(work: &Convert, path: &Path, loaded: &Loaded) {
    let folders = [&work.scene, path].map(|file| file::directory_of(file).canonicalize().ok());
    if folders[0] != folders[1] && work.to != Language::Ray && !loaded.read.files.is_empty() {
        let message = format!(
            "{} names pictures or meshes as {} does, but is in another folder",
            path.display(),
            work.scene.display()
        );
        print_message("note", &message);
    }
}
