//! Writes the sample scenes that the program carries.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::{Error, Messages, stdout};
use assets::SAMPLES;
use text::{counted, visible};

/// The sample scenes, to be written into a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Samples {
    /// The folder, which is made if it is missing.
    pub folder: PathBuf,
}

/// Writes the sample scenes and the files that they name, and prints what was written. A file that
/// exists is never replaced; what was kept is printed, too.
pub fn write_samples(work: &Samples) -> Result<(), Error> {
    try_write(&work.folder).inspect_err(|error| Messages::Text.error(error))
}

fn try_write(folder: &Path) -> Result<(), Error> {
    let failed = |path: &Path, source| Error::Create {
        path: path.to_owned(),
        source,
    };
    fs::create_dir_all(folder).map_err(|source| failed(folder, source))?;
    let (mut written, mut kept) = (0, Vec::new());
    for (name, bytes) in files() {
        let path = folder.join(name);
        match create(&path, bytes) {
            Ok(()) => written += 1,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => kept.push(name),
            Err(error) => return Err(failed(&path, error)),
        }
    }
    stdout::print(&summary(folder, written, &kept)).map_err(stdout::error)
}

/// All files, each once.
fn files() -> BTreeMap<&'static str, &'static [u8]> {
    let scenes = SAMPLES
        .iter()
        .map(|sample| (sample.name, sample.text.as_bytes()));
    let named = SAMPLES.iter().flat_map(|sample| sample.files);
    scenes.chain(named.copied()).collect::<BTreeMap<_, _>>()
}

/// Creates a file. Nothing is left of it if it cannot be written whole.
fn create(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
    file.write_all(bytes).inspect_err(|_| {
        // What is left is less than the error that is reported.
        let _ = fs::remove_file(path);
    })
}

/// What was written, a line for each scene, and what was kept.
fn summary(folder: &Path, written: usize, kept: &[&str]) -> String {
    let folder = folder.to_string_lossy();
    let folder = visible(&folder);
    let mut lines = vec![format!("wrote {} to {folder}", counted(written, "file"))];
    if !kept.is_empty() {
        let kept = kept.join(", ");
        lines.push(format!("kept what was there: {kept}"));
    }
    lines.extend(SAMPLES.iter().map(|sample| {
        let (name, words) = (sample.name, sample.words);
        format!("  {name:15} {words}")
    }));
    lines.push(String::new());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use language::{Language, Source};
    use scene::Meshes;

    #[test]
    fn files_are_written_once_and_none_is_replaced() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = place.path().join("a/b");
        let own = folder.join("glass.ray");
        fs::create_dir_all(&folder).expect("the folder is new");
        fs::write(&own, "mine").expect("the folder is new");
        let elsewhere = place.path().join("elsewhere");
        std::os::unix::fs::symlink(&elsewhere, folder.join("sky.png")).expect("it is new");
        for _ in 0..2 {
            try_write(&folder).expect("it can be written");
            assert_eq!(fs::read_to_string(&own).expect("a text"), "mine");
            assert!(!elsewhere.exists());
            let count = fs::read_dir(&folder).expect("a folder").count();
            assert_eq!(count, files().len());
        }
        let file = place.path().join("elsewhere/scenes");
        fs::write(&elsewhere, "").expect("it is new");
        try_write(&file).expect_err("it is in a file");
    }

    #[test]
    fn samples_have_no_errors_and_carry_the_files_that_they_name() {
        for sample in SAMPLES {
            let language = Language::of_path(Path::new(sample.name)).expect("a scene's name");
            let mut source = Source::new(language, Arc::new(sample.text.to_owned()));
            let lowered = source.lower(&Meshes::default()).expect("there is memory");
            let errors: Vec<_> = lowered
                .diagnostics
                .iter()
                .filter(|found| found.is_error())
                .collect();
            assert!(errors.is_empty(), "{}: {errors:?}", sample.name);
            for named in source.files() {
                let is_it = |(name, _): &(&str, &[u8])| named.path == *name;
                let is_carried = sample.files.iter().any(is_it);
                assert!(is_carried, "{}: {}", sample.name, named.path);
            }
        }
    }
}
