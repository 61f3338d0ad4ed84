//! Shows what a picture is made from, as its file says.

use std::fmt::Write;
use std::path::PathBuf;

use super::{Error, Verdict, Warnings, load, print_error, stdout};
use crate::assets::{self, fingerprint};
use crate::file;
use crate::image_file;
use crate::memory;
use crate::render::{Aov, Provenance};
use crate::text::visible;

/// A picture to show the origin of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Show {
    /// The picture file.
    pub picture: PathBuf,
    /// The scene that it may be made from.
    pub scene: Option<PathBuf>,
    /// Additional folders that pictures and meshes of the scene may be read from.
    pub assets: Vec<PathBuf>,
}

/// Prints what a picture is made from, and whether that is the scene given.
pub fn show(work: &Show) -> Result<Verdict, Error> {
    try_show(work).inspect_err(print_error)
}

fn try_show(work: &Show) -> Result<Verdict, Error> {
    assets::check_folders(&work.assets)?;
    let path = &work.picture;
    let file = file::open(path)?;
    let provenance = image_file::provenance(file).map_err(|source| Error::Picture {
        path: path.clone(),
        source,
    })?;
    let provenance = provenance.ok_or_else(|| Error::NoProvenance(path.clone()))?;
    let mut text = entries(&provenance);
    if let Some(line) = command_line(work, &provenance) {
        text += &line;
    }
    let mut verdict = Verdict::Alike;
    if let Some(scene) = &work.scene {
        memory::start_threads_or_none();
        let loaded = load(scene, &work.assets, Warnings::Allowed)?;
        let digest = fingerprint(loaded.source.text(), &loaded.read.found)?;
        let is = if digest == provenance.scene {
            "is the scene of this picture"
        } else {
            verdict = Verdict::Different;
            "is another scene, or its text or a file that it names has changed"
        };
        let _ = writeln!(text, "{} {is}", visible(&scene.to_string_lossy()));
    }
    stdout::print(&text).map_err(stdout::error)?;
    Ok(verdict)
}

/// All entries, a line each.
fn entries(provenance: &Provenance) -> String {
    let spp = ("spp", provenance.settings.spp.to_string());
    let mut text = String::new();
    for (name, value) in provenance.written().into_iter().chain([spp]) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<12}{value}");
    }
    text
}

/// The command that renders the picture again; `None` if it was made in the interface and the
/// command line has no option for its AOV.
fn command_line(work: &Show, provenance: &Provenance) -> Option<String> {
    if matches!(provenance.settings.aov, Some(Aov::Direct(_))) {
        return None;
    }
    let name = |path: &PathBuf| visible(&path.to_string_lossy()).into_owned();
    let scene = work.scene.as_ref().map_or_else(|| "SCENE".to_owned(), name);
    let mut line = format!(
        "again       halflight render {scene} -o {}",
        name(&work.picture)
    );
    let spp = ("spp", provenance.settings.spp.to_string());
    for (option, value) in provenance.written().into_iter().chain([spp]) {
        let is_default = matches!(
            (option, value.as_str()),
            ("version" | "scene", _) | ("view", "own") | ("layers" | "region" | "aov", "none")
        );
        if is_default {
            continue;
        }
        let value = if value.contains(' ') {
            format!("\"{value}\"")
        } else {
            value
        };
        let _ = write!(line, " --{option} {value}");
    }
    Some(line + "\n")
}
