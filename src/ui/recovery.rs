//! Unsaved edits kept from one run to the next, one file a scene, readable by its owner only.

use std::ffi::OsStr;
use std::fs::{self, DirBuilder, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The name under which the edits of a scene without a file are kept.
const NAMELESS: &str = "unsaved.ray";

/// Keeps a text for the next run with this scene; `None` is the scene without a file.
pub(crate) fn write(scene: Option<&Path>, text: &str) -> io::Result<()> {
    let place = place(scene)?;
    if let Some(folder) = place.parent() {
        let mut builder = DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.recursive(true).create(folder)?;
    }
    let mut options = OpenOptions::new();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(place)?.write_all(text.as_bytes())
}

/// What was kept for this scene.
pub(crate) fn read(scene: Option<&Path>) -> Option<String> {
    fs::read_to_string(place(scene).ok()?).ok()
}

/// Forgets what was kept for this scene.
pub(crate) fn remove(scene: Option<&Path>) -> io::Result<()> {
    match fs::remove_file(place(scene)?) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Where a scene's edits are kept: `$XDG_STATE_HOME/halflight/recovery/NAME-HASH.ray`.
fn place(scene: Option<&Path>) -> io::Result<PathBuf> {
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let state = set("XDG_STATE_HOME").map(PathBuf::from);
    let state = state.or_else(|| Some(PathBuf::from(set("HOME")?).join(".local/state")));
    let state = state.ok_or_else(|| io::Error::other("no home folder is known"))?;
    let name = match scene {
        Some(path) => name_of(&std::path::absolute(path)?),
        None => NAMELESS.to_owned(),
    };
    Ok(state.join("halflight").join("recovery").join(name))
}

/// A name that tells scenes of the same name in different folders apart.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_else(|| OsStr::new("scene"));
    let stem: String = stem.to_string_lossy().chars().take(40).collect();
    let hash = fnv1a(path.as_os_str().as_encoded_bytes());
    format!("{stem}-{hash:016x}.ray")
}

/// The hash of Fowler, Noll and Vo, variant 1a, 64 bits: the same in every build, which the
/// standard library's is not.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        // From the authors' test vectors.
        for (text, hash) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(fnv1a(text.as_bytes()), hash, "{text}");
        }
    }

    #[test]
    fn scenes_of_the_same_name_are_told_apart() {
        let names = ["/a/scene.ray", "/b/scene.ray"].map(|path| name_of(Path::new(path)));
        assert_ne!(names[0], names[1]);
        assert!(names.iter().all(|name| name.starts_with("scene-")));
    }
}
