//! Makes every system call of a write fail in turn, and checks that nothing is lost or left behind.

use rustix::io::Errno;

use super::*;
use crate::faults::{Calls, Fault, during};

pub(super) const OLD: &str = "the old content, which is longer than the new one";
pub(super) const NEW: &str = "the new content";

/// More calls than any write makes.
pub(super) const MOST: usize = 100;

const ERRORS: [Errno; 4] = [Errno::NOSPC, Errno::IO, Errno::DQUOT, Errno::INTR];

/// A file to write, in a folder of its own.
pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) directory: TempDir,
    pub(super) path: PathBuf,
    /// The initial names in the folder.
    pub(super) names: Vec<String>,
    pub(super) old: Option<&'static str>,
    pub(super) new: &'static str,
}

impl Case {
    fn new(name: &'static str, prepare: fn(&Path) -> Option<&'static str>) -> Self {
        // In memory if possible: syncing to a disk is slow.
        let directory = tempfile::tempdir_in("/dev/shm").unwrap_or_else(|_| directory());
        let old = prepare(directory.path());
        Self {
            name,
            path: directory.path().join("s"),
            names: names(directory.path()),
            directory,
            old,
            new: NEW,
        }
    }

    /// One case of each kind.
    pub(super) fn all() -> Vec<Self> {
        vec![
            Self::new("new", |_| None),
            Self::new("replaced", |folder| {
                fs::write(folder.join("s"), OLD).expect("written");
                Some(OLD)
            }),
            Self::new("through a link", |folder| {
                fs::write(folder.join("end"), OLD).expect("written");
                symlink("end", folder.join("s")).expect("linked");
                Some(OLD)
            }),
            Self::new("hard-linked", |folder| Some(hard_linked(folder))),
            Self {
                new: "",
                ..Self::new("emptied through a hard link", |folder| {
                    Some(hard_linked(folder))
                })
            },
        ]
    }

    /// What remains in the folder after another write there, except reported backup copies.
    pub(super) fn left_behind(&self) -> Vec<String> {
        let other = self.directory.path().join("other");
        replace_with(&other, "").expect("nothing is wrong by now");
        fs::remove_file(&other).expect("removed");
        replace_with(&self.path, self.new).expect("nothing is wrong by now");
        let mut left = names(self.directory.path());
        let reported = backups(&self.path);
        left.retain(|name| {
            let is_own = self.names.contains(name) || name == "s";
            !is_own && !reported.iter().any(|copy| copy.ends_with(name))
        });
        left
    }

    /// Writes with a fault, and checks the outcome.
    fn write(&self, fault: Fault, at: usize) -> Calls {
        let (outcome, calls) = during(fault, at, || replace_with(&self.path, self.new));
        let case = format!("{}, {fault:?} at {at}: {calls:?}: {outcome:?}", self.name);
        let found = fs::read_to_string(&self.path).ok();
        let copies = backups(&self.path);
        match &outcome {
            Ok(()) => assert_eq!(found.as_deref(), Some(self.new), "{case}"),
            Err(error) => {
                assert!(!fault.is_harmless(), "{case}");
                // The first error is the one reported.
                let (Fault::Once(cause) | Fault::Ever(cause)) = fault else {
                    panic!("{case}");
                };
                let cause = io::Error::from(cause).to_string();
                assert!(error.to_string().ends_with(&cause), "{case}");
                assert!(!error.to_string().contains(".halflight-0"), "{case}");
                let is_damaged = error.to_string().contains("is damaged");
                assert!(is_damaged || found.as_deref() == self.old, "{case}");
                if is_damaged {
                    let [copy] = copies.as_slice() else {
                        panic!("{case}: {copies:?}");
                    };
                    let name = copy.file_name().expect("a name").to_string_lossy();
                    assert!(error.to_string().contains(&*name), "{case}");
                    assert_eq!(Some(content(copy).as_str()), self.old, "{case}");
                }
            }
        }
        assert_eq!(self.left_behind(), [""; 0], "{case}");
        calls
    }
}

fn hard_linked(folder: &Path) -> &'static str {
    fs::write(folder.join("s"), OLD).expect("written");
    fs::hard_link(folder.join("s"), folder.join("t")).expect("linked");
    OLD
}

/// Writes each kind of file with the fault at the k-th call, for every k. Returns the names of the
/// affected calls.
fn fail_each(fault: Fault) -> Vec<&'static str> {
    let mut hit = Vec::new();
    for number in 0..Case::all().len() {
        let last = (0..MOST).find(|&at| {
            let case = Case::all().swap_remove(number);
            let calls = case.write(fault, at);
            hit.extend(calls.hit);
            calls.hit.is_none()
        });
        assert!(last.is_some_and(|last| 0 < last), "each was hit");
    }
    hit.sort_unstable();
    hit.dedup();
    hit
}

#[test]
fn a_failing_call_loses_nothing() {
    for error in ERRORS {
        let hit = fail_each(Fault::Once(error));
        #[cfg(target_os = "linux")]
        for name in [
            "chmod",
            "create",
            "flock",
            "fsync",
            "ftruncate",
            "link",
            "open",
            "read",
            "rename",
            "unlink",
            "write",
        ] {
            assert!(hit.contains(&name), "{name}");
        }
    }
}

#[test]
fn persistent_failures_lose_nothing_without_an_error() {
    for error in [Errno::NOSPC, Errno::IO, Errno::DQUOT] {
        fail_each(Fault::Ever(error));
    }
}

#[test]
fn short_writes_are_continued() {
    fail_each(Fault::Short);
}

/// Runs `work` on a thread without root privileges.
#[cfg(target_os = "linux")]
fn without_privileges<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    use rustix::process::{Uid, geteuid};
    use rustix::thread::set_thread_uid;
    let thread = std::thread::spawn(|| {
        if geteuid().is_root() {
            set_thread_uid(Uid::from_raw(65534)).expect("an administrator may");
        }
        work()
    });
    thread.join().expect("no panic")
}

#[test]
#[cfg(target_os = "linux")]
fn a_file_in_a_read_only_folder_is_never_half_written() {
    use std::fs::Permissions;
    use std::os::unix::fs::PermissionsExt;
    let directory = directory();
    let name = directory.path().file_name().expect("a name").to_owned();
    let path = directory.path().join(name);
    fs::write(&path, "").expect("written");
    fs::set_permissions(&path, Permissions::from_mode(0o666)).expect("changed");
    fs::set_permissions(directory.path(), Permissions::from_mode(0o555)).expect("changed");
    let last = (0..MOST).find(|&at| {
        fs::write(&path, OLD).expect("written");
        let place = path.clone();
        let fault = Fault::Once(Errno::NOSPC);
        let (outcome, calls) =
            without_privileges(move || during(fault, at, || replace_with(&place, NEW)));
        let expected = if outcome.is_ok() { NEW } else { OLD };
        assert_eq!(content(&path), expected, "{calls:?}: {outcome:?}");
        if let Err(error) = outcome {
            let message = error.to_string();
            let cause = io::Error::from(Errno::NOSPC).to_string();
            assert!(message.ends_with(&cause), "{message}");
        }
        assert_eq!(backups(&path), [] as [PathBuf; 0]);
        calls.hit.is_none()
    });
    assert!(last.is_some_and(|last| 0 < last), "each was hit");
    fs::set_permissions(directory.path(), Permissions::from_mode(0o755)).expect("changed");
}

/// Covers file systems that cannot name unnamed files, and systems without unnamed files.
#[test]
#[cfg(target_os = "linux")]
fn without_unnamed_files_the_attributes_are_kept_too() {
    use rustix::fs::{XattrFlags, getxattr, setxattr};
    use std::fs::Permissions;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    for (call, error) in [
        ("link", Errno::OPNOTSUPP),
        ("link", Errno::PERM),
        ("link", Errno::XDEV),
        ("link", Errno::MLINK),
        ("create", Errno::NOSYS),
    ] {
        let case = Case::all().swap_remove(1);
        fs::set_permissions(&case.path, Permissions::from_mode(0o640)).expect("ours");
        // Only an administrator can give a file away, and not every file system has attributes.
        let _ = chown(&case.path, Some(1), Some(1));
        let has_note = setxattr(&case.path, "user.note", b"mine", XattrFlags::empty()).is_ok();
        let of = |metadata: fs::Metadata| (metadata.uid(), metadata.gid(), metadata.mode());
        let before = fs::metadata(&case.path).map(of).expect("there");

        let calls = during(Fault::Short, MOST, || replace_with(&case.path, NEW)).1;
        let at = calls.names.iter().position(|name| *name == call);
        let Some(at) = at else {
            // This file system has no unnamed files.
            continue;
        };
        let (outcome, calls) = during(Fault::Once(error), at, || replace_with(&case.path, "other"));
        assert_eq!(calls.hit, Some(call));
        outcome.expect("there is another way");
        assert_eq!(content(&case.path), "other");
        let after = fs::metadata(&case.path).map(of).expect("there");
        assert_eq!(after, before, "{call}: {error}");
        if has_note {
            let mut value = [0; 4];
            let length = getxattr(&case.path, "user.note", &mut value).expect(call);
            assert_eq!(&value[..length], b"mine");
        }
        assert_eq!(case.left_behind(), [""; 0], "{call}: {error}");
    }
}

/// The system reuses the inode of a deleted file.
#[test]
fn a_backup_of_a_deleted_file_is_not_mistaken_for_one_of_another_file() {
    use std::os::unix::fs::MetadataExt;
    let directory = directory();
    let place = |name: &str| directory.path().join(name);
    fs::write(place("copy"), OLD).expect("written");
    let born = |name: &str| fs::metadata(place(name)).and_then(|found| found.created());
    let copied = fs::metadata(place("copy")).and_then(|copy| copy.modified());
    let copied = copied.expect("a time");
    loop {
        fs::write(place("s"), "another file").expect("written");
        match born("s") {
            Ok(born) if born <= copied => fs::remove_file(place("s")).expect("ours"),
            Ok(_) => break,
            // This file system has no creation times.
            Err(_) => return,
        }
    }
    let inode = fs::metadata(place("s")).expect("there").ino();
    let copy = |name| place(&format!(".halflight-backup-{inode:x}-00c0ffee-{name}"));
    fs::rename(place("copy"), copy("gone")).expect("renamed");
    assert_eq!(backups(&place("s")), [] as [PathBuf; 0]);
    // A copy whose name matches too is found.
    fs::rename(copy("gone"), copy("s")).expect("renamed");
    assert_eq!(backups(&place("s")), [copy("s")]);
}

#[test]
fn the_backup_of_an_interrupted_save_is_found() {
    let directory = directory();
    let place = |name: &str| directory.path().join(name);
    fs::write(place("s"), "half of the ne").expect("written");
    fs::hard_link(place("s"), place("t")).expect("linked");
    let inode = fs::metadata(place("s")).expect("there").ino();
    let copy = place(&format!(".halflight-backup-{inode:x}-00c0ffee-s"));
    fs::write(&copy, OLD).expect("written");
    assert_eq!(backups(&place("s")), [copy.as_path()]);
    // Also by the file's other name.
    assert_eq!(backups(&place("t")), [copy.as_path()]);
    // Later writes keep the copy unless it equals the content.
    replace_with(&place("s"), NEW).expect("written");
    assert_eq!(backups(&place("s")), [copy.as_path()]);
    replace_with(&place("s"), OLD).expect("written");
    assert_eq!(backups(&place("s")), [] as [PathBuf; 0]);
    replace_with(&place("s"), NEW).expect("written");
    assert!(!copy.exists());
}
