//! The scene that a journal belongs to.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use language::Language;

/// The stem of journals of the scene without a file.
const NAMELESS: &str = "unsaved";

/// The maximum number of journals of one scene.
const MOST: usize = 100;

/// A scene, independent of the name that it is opened by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Identity {
    /// The common prefix of its journals' names.
    stem: String,
    /// The extension of its language.
    pub(super) extension: &'static str,
    /// Its canonical path in ASCII, or `-`.
    pub(super) label: String,
}

impl Identity {
    /// Identifies the scene at a path, or the one without a file.
    pub(super) fn of(scene: Option<&Path>, language: Language) -> Self {
        let extension = language.extension();
        let Some(path) = scene.map(canonical) else {
            return Self {
                stem: NAMELESS.to_owned(),
                extension,
                label: "-".to_owned(),
            };
        };
        let stem = path.file_stem().unwrap_or_else(|| OsStr::new("scene"));
        let shown = |c: char| if c.is_control() { '_' } else { c };
        let stem: String = stem.to_string_lossy().chars().take(40).map(shown).collect();
        let bytes = path.as_os_str().as_encoded_bytes();
        Self {
            stem: format!("{stem}-{:016x}", fnv1a(bytes)),
            extension,
            label: bytes.escape_ascii().to_string(),
        }
    }

    /// The possible names of its journals.
    pub(super) fn names(&self) -> impl Iterator<Item = String> + use<'_> {
        (0..MOST).map(|number| format!("{}-{number}.{}", self.stem, self.extension))
    }
}

/// Resolves links, `.` and `..` as far as the path exists.
fn canonical(path: &Path) -> PathBuf {
    let in_folder = || {
        // A link may lead to a missing file.
        let path = file::end_of_links(path).ok()?;
        let folder = path.parent()?;
        let folder = Some(folder).filter(|folder| !folder.as_os_str().is_empty());
        let folder = fs::canonicalize(folder.unwrap_or_else(|| Path::new("."))).ok()?;
        Some(folder.join(path.file_name()?))
    };
    fs::canonicalize(path)
        .ok()
        .or_else(in_folder)
        .unwrap_or_else(|| file::absolute(path))
}

/// The 64-bit FNV-1a hash (Fowler, Noll, Vo). Unlike the standard library's, it is the same in
/// every build.
pub(super) fn fnv1a<'b>(bytes: impl IntoIterator<Item = &'b u8>) -> u64 {
    let bytes = bytes.into_iter();
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_matches_the_published_test_vectors() {
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
    fn scenes_are_distinguished_by_path_and_language() {
        let of = |path: &str, language| Identity::of(Some(Path::new(path)), language);
        let names = [
            of("/a/scene.ray", Language::Ray),
            of("/b/scene.ray", Language::Ray),
            of("/b/scene.ray", Language::Dat),
            Identity::of(None, Language::Ray),
        ];
        let first = names.each_ref().map(|name| name.names().next());
        for (at, name) in first.iter().enumerate() {
            assert!(!first[..at].contains(name), "{name:?}");
        }
        let last = names[2].names().last().expect("there are some");
        assert!(last.starts_with("scene-") && last.ends_with("-99.dat"));
    }

    #[test]
    fn a_scene_is_the_same_under_all_its_names() {
        let place = tempfile::tempdir().expect("a folder");
        let at = |name: &str| place.path().join(name);
        fs::create_dir(at("x")).expect("the folder is new");
        fs::write(at("b.ray"), "").expect("the folder is new");
        std::os::unix::fs::symlink("../b.ray", at("x/link.ray")).expect("the folder is new");
        std::os::unix::fs::symlink("x", at("y")).expect("the folder is new");
        let of = |name: &str| Identity::of(Some(&at(name)), Language::Ray);
        for name in ["x/../b.ray", "./b.ray", "x/link.ray", "y/link.ray"] {
            assert_eq!(of(name), of("b.ray"), "{name}");
        }
        // A file that does not exist, or no longer does.
        assert_eq!(of("y/none.ray"), of("x/none.ray"));
        assert_ne!(of("none.ray"), of("x/none.ray"));
        let before = of("b.ray");
        fs::remove_file(at("b.ray")).expect("it is there");
        assert_eq!(of("y/link.ray"), before);
    }
}
