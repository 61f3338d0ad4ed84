//! Unsaved edits kept from one run to the next, readable by their owner only.
//!
//! Every run keeps its edits in a file of its own, `NAME-HASH-N.ray`, locked while it runs: edits
//! that nobody has decided about stay, and those of a run that is not over are not offered.

use std::ffi::OsStr;
use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::msg::Kept;

/// The name under which the edits of a scene without a file are kept.
const NAMELESS: &str = "unsaved";

/// The most files kept of one scene.
const MOST: usize = 100;

/// The edits of this run, as they are kept for the next one.
#[derive(Debug, Default)]
pub(crate) struct Journal {
    held: Option<Held>,
}

#[derive(Debug)]
struct Held {
    scene: Option<PathBuf>,
    place: PathBuf,
    /// Has the lock.
    _file: File,
}

impl Journal {
    /// Keeps a text in place of the last one; `None` is the scene without a file. At every moment
    /// one of the two is kept whole.
    pub(crate) fn write(&mut self, scene: Option<PathBuf>, text: &str) -> io::Result<()> {
        let (place, _claimed) = match &self.held {
            Some(held) if held.scene == scene => (held.place.clone(), None),
            _ => {
                let (place, file) = claim(scene.as_deref())?;
                (place, Some(file))
            }
        };
        let written = place.with_extension("new");
        let mut file = options().truncate(true).create(true).open(&written)?;
        lock(&file);
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&written, &place)?;
        self.hold(scene, place, file)
    }

    /// Keeps from here on what an earlier run kept.
    pub(crate) fn adopt(&mut self, scene: Option<PathBuf>, place: PathBuf) -> io::Result<()> {
        let file = File::open(&place)?;
        lock(&file);
        self.hold(scene, place, file)
    }

    /// Forgets what is kept.
    pub(crate) fn forget(&mut self) -> io::Result<()> {
        self.held.take().map_or(Ok(()), |held| remove(&held.place))
    }

    /// Whether anything is kept.
    pub(crate) fn is_kept(&self) -> bool {
        self.held.is_some()
    }

    fn hold(&mut self, scene: Option<PathBuf>, place: PathBuf, file: File) -> io::Result<()> {
        let before = self.held.take();
        let held = self.held.insert(Held {
            scene,
            place,
            _file: file,
        });
        match before {
            Some(before) if before.place != held.place => remove(&before.place),
            _ => Ok(()),
        }
    }
}

/// What was kept for this scene last, by a run that is over.
pub(crate) fn find(scene: Option<&Path>) -> Option<Kept> {
    newest(places(scene).ok()?)
}

fn newest(places: impl Iterator<Item = PathBuf>) -> Option<Kept> {
    let kept = places.filter_map(|place| {
        let mut file = File::open(&place).ok()?;
        let at = file.metadata().and_then(|metadata| metadata.modified());
        let mut text = String::new();
        if !lock(&file) {
            return None;
        }
        if file.read_to_string(&mut text).ok()? == 0 {
            // A run that claimed it has crashed before it had written anything.
            let _ = remove(&place);
            return None;
        }
        Some((at.ok(), Kept { place, text }))
    });
    kept.max_by_key(|&(at, _)| at).map(|(_, kept)| kept)
}

/// Removes a file of kept edits.
pub(crate) fn remove(place: &Path) -> io::Result<()> {
    match fs::remove_file(place) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes the file that the scene's edits are kept in: an empty one, until there is a whole text.
fn claim(scene: Option<&Path>) -> io::Result<(PathBuf, File)> {
    for place in places(scene)? {
        if let Some(folder) = place.parent() {
            let mut builder = DirBuilder::new();
            #[cfg(unix)]
            std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
            builder.recursive(true).create(folder)?;
        }
        match options().create_new(true).open(&place) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            made => {
                let file = made?;
                lock(&file);
                return Ok((place, file));
            }
        }
    }
    Err(io::Error::other("too many were kept before"))
}

fn options() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.write(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options
}

/// Locks a file until it is closed, by the end of the process at the latest; `false` if another
/// run has the lock. Where files can't be locked, no run is known to go on.
fn lock(file: &File) -> bool {
    #[cfg(unix)]
    {
        use rustix::fs::{FlockOperation, flock};
        use rustix::io::Errno;
        flock(file, FlockOperation::NonBlockingLockExclusive) != Err(Errno::WOULDBLOCK)
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        true
    }
}

/// The folder of edits that are kept.
pub(super) fn folder() -> io::Result<PathBuf> {
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let state = set("XDG_STATE_HOME").map(PathBuf::from);
    let state = state.or_else(|| Some(PathBuf::from(set("HOME")?).join(".local/state")));
    let state = state.ok_or_else(|| io::Error::other("no home folder is known"))?;
    Ok(state.join("halflight").join("recovery"))
}

/// Where a scene's edits may be kept: `$XDG_STATE_HOME/halflight/recovery/NAME-HASH-N.ray`.
fn places(scene: Option<&Path>) -> io::Result<impl Iterator<Item = PathBuf>> {
    let folder = folder()?;
    let name = match scene {
        Some(path) => name_of(&std::path::absolute(path)?),
        None => NAMELESS.to_owned(),
    };
    Ok((0..MOST).map(move |number| folder.join(format!("{name}-{number}.ray"))))
}

/// A name that tells scenes of the same name in different folders apart.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_else(|| OsStr::new("scene"));
    let stem: String = stem.to_string_lossy().chars().take(40).collect();
    let hash = fnv1a(path.as_os_str().as_encoded_bytes());
    format!("{stem}-{hash:016x}")
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

    /// A journal's file in a folder of the test's own.
    fn kept_at(place: &Path, text: &str) -> Journal {
        fs::write(place, text).expect("written");
        let mut journal = Journal::default();
        let adopted = journal.adopt(None, place.to_owned());
        adopted.expect("the file is there");
        journal
    }

    #[test]
    #[cfg(unix)]
    fn edits_of_a_run_that_goes_on_are_not_offered() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = |name| folder.path().join(name);
        let mut journal = kept_at(&place("a-0.ray"), "old");
        let offered = || newest([place("a-0.ray"), place("a-1.ray")].into_iter());
        assert_eq!(offered(), None);
        journal.write(None, "new").expect("written");
        assert_eq!(offered(), None, "the lock is on the newer file too");
        drop(journal);
        assert_eq!(offered().expect("its run is over").text, "new");
        kept_at(&place("a-1.ray"), "other")
            .forget()
            .expect("removed");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }

    #[test]
    fn scenes_of_the_same_name_are_told_apart() {
        let names = ["/a/scene.ray", "/b/scene.ray"].map(|path| name_of(Path::new(path)));
        assert_ne!(names[0], names[1]);
        assert!(names.iter().all(|name| name.starts_with("scene-")));
    }
}
