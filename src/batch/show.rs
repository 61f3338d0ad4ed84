//! Shows what a picture is made from, as its file says.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::{Error, Messages, Reading, Verdict, stdout};
use assets::fingerprint;
use image_file::{ImageFormat, Unreadable};
use render::{Aov, Provenance};
use text::{shell_path, shell_word, visible};

/// A picture to show the origin of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Show {
    /// The picture file.
    pub picture: PathBuf,
    /// The scene that it may be made from.
    pub scene: Option<PathBuf>,
    /// How the scene is read.
    pub reading: Reading,
}

/// Prints what a picture is made from, and whether that is the scene given.
pub fn show(work: &Show) -> Result<Verdict, Error> {
    try_show(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_show(work: &Show) -> Result<Verdict, Error> {
    work.reading.begin()?;
    let path = &work.picture;
    let record = match image_file::record(&mut file::open(path)?) {
        Ok(Some(record)) => record,
        Ok(None) => return Err(Error::NoProvenance(path.clone())),
        Err(Unreadable::Unknown) => return Err(Error::NeverRecorded(path.clone())),
        Err(source) => {
            let path = path.clone();
            return Err(Error::Picture { path, source });
        }
    };
    let is_same = match &work.scene {
        None => None,
        Some(scene) => {
            let loaded = work.reading.load(Messages::Text, scene, None)?;
            let digest = fingerprint(loaded.source.text(), &loaded.read.found)?;
            Some(record.scene.as_ref() == Some(&digest))
        }
    };
    let mut text = String::new();
    for (name, value) in record.entries() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<12}{}", visible(value));
    }
    if is_same != Some(false)
        && let Some(line) = record
            .provenance()
            .and_then(|made| command_line(work, &made))
    {
        text += &line;
    }
    if let (Some(scene), Some(is_same)) = (&work.scene, is_same) {
        let is = if is_same {
            "is the scene of this picture"
        } else {
            "is not the scene of this picture: it is another one, or its text or a file that it names \
             has changed, or the picture is a frame of a track"
        };
        let _ = writeln!(text, "{} {is}", visible(&scene.to_string_lossy()));
    }
    if let Some(unused) = record.unused() {
        let picture = path.display();
        Messages::Text.note(&format!("{picture}: problems in its record: {unused}"));
    }
    stdout::print(&text).map_err(stdout::error)?;
    Ok(match is_same {
        Some(false) => Verdict::Different,
        None | Some(true) => Verdict::Alike,
    })
}

/// The command that renders the picture again; `None` if it was made in the interface and the
/// command line has no option for its AOV.
fn command_line(work: &Show, provenance: &Provenance) -> Option<String> {
    if matches!(provenance.settings.aov, Some(Aov::Direct(_))) {
        return None;
    }
    let scene = work.scene.as_deref();
    let scene = scene
        .and_then(argument)
        .unwrap_or_else(|| "SCENE".to_owned());
    let is_named = ImageFormat::of_path(&work.picture).is_some();
    let picture = argument(&work.picture).filter(|_| is_named);
    let picture = picture.unwrap_or_else(|| "PICTURE".to_owned());
    let mut line = format!("again       halflight render {scene} -o {picture}");
    for folder in &work.reading.assets {
        let folder = argument(folder).unwrap_or_else(|| "FOLDER".to_owned());
        let _ = write!(line, " --assets {folder}");
    }
    let spp = ("spp", provenance.settings.spp.to_string());
    for (option, value) in provenance.written().into_iter().chain([spp]) {
        let is_default = matches!(
            (option, value.as_str()),
            ("version" | "scene", _) | ("view", "own") | ("layers" | "region" | "aov", "none")
        );
        if is_default {
            continue;
        }
        if option == "denoise" {
            line += " --denoise";
            continue;
        }
        // Others are of letters, digits and what means nothing to a shell.
        let value = if value.contains(' ') {
            shell_word(&value)
        } else {
            value.as_str().into()
        };
        let _ = write!(line, " --{option} {value}");
    }
    Some(line + "\n")
}

/// A path as an argument in a shell; `None` if it cannot be printed as it is.
fn argument(path: &Path) -> Option<String> {
    let path = path.to_str().filter(|path| visible(path) == *path)?;
    Some(shell_path(path))
}
