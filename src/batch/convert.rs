//! Converts a scene to another language.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::output::Output;
use super::reading::Loaded;
use super::{Error, Messages, Reading};
use language::{Converted, Language, Source};
use scene::Meshes;
use text::{Diagnostic, Findings};

/// A scene to convert.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Convert {
    /// The scene file.
    pub scene: PathBuf,
    /// The language of the new text.
    pub to: Language,
    /// Where the new text goes.
    pub output: Output,
    /// How the scene is read. Losses are treated as warnings.
    pub reading: Reading,
}

/// Converts a scene and prints what it loses.
pub fn convert(work: &Convert) -> Result<(), Error> {
    try_convert(work).inspect_err(|error| Messages::Text.error(error))
}

fn try_convert(work: &Convert) -> Result<(), Error> {
    work.output.check_spares(&work.scene, &[])?;
    work.output.check()?;
    work.reading.begin()?;
    let loaded = work.reading.load(Messages::Text, &work.scene, None)?;
    let scene = loaded.scene.as_ref().ok_or_else(|| Error::Unconverted {
        errors: loaded.findings.errors(),
    })?;
    work.output.check_spares(&work.scene, &loaded.read.files)?;
    let Converted { text, mut losses } = language::convert(&loaded.source, scene, work.to)
        .map_err(|reason| Error::Refused(reason.to_string()))?;
    if let Output::File(path) = &work.output {
        losses.append(unreachable_files(work, path, &loaded, &text));
    }
    let losses = work.reading.warnings.apply(losses.sorted());
    Messages::Text.all_findings(&loaded.path, loaded.source.text(), &losses);
    match losses.errors() {
        0 => {}
        errors => return Err(Error::Unconverted { errors }),
    }
    work.output.write(&mut |out| out.write_all(text.as_bytes()))
}

fn has_same_bytes(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(|path| fs::read(path).ok());
    one.is_some() && one == other
}

/// Warnings for the files that both a scene and its new text name, if they are looked for in another folder.
fn unreachable_files(work: &Convert, path: &Path, loaded: &Loaded, text: &str) -> Findings {
    let mut found = Findings::default();
    let folders = [work.scene.as_path(), path].map(file::directory_of);
    let [old, new] = folders.each_ref().map(|folder| folder.canonicalize().ok());
    let named = loaded.source.files();
    if old == new || named.is_empty() {
        return found;
    }
    let mut converted = Source::new(work.to, Arc::new(text.to_owned()));
    if converted.lower(&Meshes::default()).is_err() {
        return found;
    }
    let kept: HashSet<_> = converted
        .files()
        .into_iter()
        .map(|named| named.path)
        .collect();
    for named in named.into_iter().filter(|named| kept.contains(&named.path)) {
        let [old, new] = folders.each_ref().map(|folder| folder.join(&named.path));
        if !file::is_same(&old, &new) && !has_same_bytes(&old, &new) {
            found.warning(|| {
                let message = format!(
                    "{}: the new scene looks for it in its own folder",
                    named.what
                );
                let hint = "copy the file there, or write the scene into the folder of the old one";
                Diagnostic::warning(named.span, message, "a scene in the same folder")
                    .with_hint(hint)
            });
        }
    }
    found
}
